//! The camera family's model. Nothing here needs a device.

mod pinhole;
mod rig;
mod set;
mod zoom;
