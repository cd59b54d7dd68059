//! The camera family's model. Nothing here needs a device.

mod panorama;
mod pinhole;
mod projector;
mod rig;
mod set;
mod zoom;
