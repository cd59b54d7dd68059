//! Passes that pose and shade scenes of files, and passes that make images of a frame's samples. Each pass has the name
//! of its shader in `shaders/`.

pub(crate) mod attributes;
pub(crate) mod box_filter;
pub(crate) mod crossings;
pub(crate) mod encode;
pub(crate) mod merge;
pub(crate) mod multisample;
pub(crate) mod neighbours;
mod occlude;
mod pose;
pub mod prefilter;
mod receivers;
pub(crate) mod shade;
pub(crate) mod spans;
mod stroke;
mod unshadowed;

pub use crossings::{MarkedOutput, SeenLocation};
pub use encode::Encoding;
pub use occlude::{LightPlane, Occlude};
pub use pose::PosePass;
pub use receivers::{PROBES, Receivers, Receiving, SHADOW_POINTS};
pub(crate) use shade::ShadeSource;
pub use stroke::{StrokePass, StrokeSizes};
pub use unshadowed::Unshadowed;
