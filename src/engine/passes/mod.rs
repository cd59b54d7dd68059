//! The passes of a frame, one file each, named like their shaders in `shaders/`; `tally` and `enlist` are in that of `schedule`.
//!
//! ```text
//! pose ─▶ stroke ─▶ raster ─▶ spans ─▶ shade ─▶ thin ─▶ detect ─▶ cull ─▶ bin ─▶ tally ─▶ schedule ─▶ enlist ─▶ setup ─▶ sample ─▶ sort ─▶ shade ─▶ resolve
//!                      └─ pixel centres ─┘                          ▲                        └───────── a round, as often as memory needs it ─────────┘│
//!                                                                   └───────────────────────────────────── grow ◀──────────────────────────────────────┘
//! ```
//! `prefilter` runs once for a scene with an environment, before its first frame. Of lists of sample locations, `distribute` takes
//! the place of what finds superpixels, from `raster` to `detect`, and `crossings` that of `thin`; `groups` follows `enlist`, and `points` may stand for `resolve`.
//! Before `shade`, `receivers` makes such a list for each light that may be hidden, and `shadow` follows its `sample`.
//!
//! Every pass records into a caller's command buffer and reads what the pass before left on the device. The memory that passes
//! hand to each other is in [`super::data`], the layouts of descriptors and pipelines are in [`super::pipelines`].

mod adopt;
mod alpha_map;
pub(crate) mod arguments;
mod bin;
mod centres;
mod coordinates;
mod cull;
mod detect;
mod distribute;
mod groups;
mod grow;
mod host_image;
mod patch;
mod points;
mod raster;
mod resolve;
mod sample;
mod schedule;
mod setup;
mod sort;
// Written by `make shaders`; some of what it has is of use to nobody yet.
#[allow(dead_code, missing_docs, clippy::derivable_impls)]
#[rustfmt::skip]
pub(crate) mod spirv;
mod take;
mod thin;
mod transform;

pub(crate) use adopt::{Adopt, AdoptedCounts};
pub(crate) use alpha_map::{AlphaLevel, AlphaMaps};
pub use bin::Bin;
pub(crate) use centres::Centres;
pub(crate) use coordinates::Coordinates;
pub use cull::{Cull, CullFilter};
pub use detect::{Detect, DetectMode, DetectOptions};
pub use distribute::{Distribute, ListLength, ListRegion};
pub use groups::Groups;
pub use grow::Grow;
pub(crate) use host_image::{HostImage, HostImageLayout};
pub(crate) use patch::{Patch, Patched};
pub use points::Points;
pub use raster::{Raster, RasterTargets};
pub(crate) use raster::{RasterPush, RasterRun};
pub use resolve::{Resolve, ResolveTarget};
pub use sample::{RecordRate, Sample, SampleOptions, TileList};
pub use schedule::Schedule;
pub use setup::Setup;
pub use sort::Sort;
pub(crate) use take::Take;
pub use thin::Thin;
pub(crate) use transform::{Transform, VertexCounts};
