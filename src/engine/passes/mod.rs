//! The passes of a frame: one file for each, with the name of its shader in `shaders/`. `tally` and `enlist` are in `schedule.rs`;
//! passes that only the renderer needs are in `src/render/passes`.
//!
//! `docs/architecture.md` has drawings of the order of passes, made from what the library records.
//! Some passes run only in some frames:
//!
//! - `prefilter` runs once for a scene with an environment, before the scene's first frame.
//! - If the frame samples a list of locations, `distribute` replaces the passes from `raster` to `detect`, and `crossings` replaces
//!   `thin`. `groups` runs after `enlist`, and `points` may replace `resolve`.
//! - For each light that may be hidden, `receivers` runs before `shade` and lists the locations that the light may illuminate. `shadow`
//!   runs after the `sample` pass of that list.
//!
//! Every pass records commands into a caller's command buffer and reads the results of the pass before it from device memory. The memory
//! for the results is in [`super::data`], the layouts of descriptors and pipelines in [`super::pipelines`].

mod adopt;
mod alpha_map;
pub(crate) mod arguments;
mod bin;
mod centres;
mod composite;
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
mod scatter;
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
pub use composite::Composite;
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
pub use sample::{LongLists, RecordRate, Sample, SampleOptions, TileList};
pub use scatter::Scatter;
pub use schedule::Schedule;
pub use setup::Setup;
pub use sort::Sort;
pub(crate) use take::Take;
pub use thin::Thin;
pub(crate) use transform::{Transform, VertexCounts};
