//! Passes that pose and shade scenes of files, and passes that make images of a frame's samples. Each pass has the name
//! of its shader in `shaders/`.

mod attributes;
mod box_filter;
mod crossings;
mod encode;
mod multisample;
mod neighbours;
mod pose;
pub mod prefilter;
mod receivers;
mod shade;
mod shadow;
mod spans;
mod stroke;

pub use attributes::Attributes;
pub use box_filter::BoxFilter;
pub use crossings::{Crossings, MarkedOutput, SeenLocation};
pub use encode::{Encode, Encoding};
pub use multisample::Multisample;
pub use neighbours::Neighbours;
pub use pose::Pose;
pub use receivers::{LightPlane, Receivers, Receiving};
pub use shade::{Shade, ShadeSource};
pub use shadow::{Shadow, ShadowTarget};
pub use spans::Spans;
pub use stroke::{Stroke, StrokeSizes};
