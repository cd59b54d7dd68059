//! Cameras, sampling sets and zooms. No test here needs a device.

mod panorama;
mod pinhole;
mod projector;
mod rig;
mod set;
mod zoom;
