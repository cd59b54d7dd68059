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
//! Every pass records into a caller's command buffer and reads what the pass before left on the device. They share the
//! geometry (`geometry/`) and what else the scene has (`scene/`), the memory that they hand to each other (`resources/`),
//! the layout of descriptors (`layout.rs`), an output's cells (`output.rs`) and the twins of what shaders include (`frame.rs`, `counters.rs`, `locations.rs`,
//! `draws.rs`, `triangle_word.rs`, `alpha_flags.rs`, `shadow_words.rs`).

mod adopt;
pub(crate) mod alpha_flags;
mod alpha_map;
pub(crate) mod arguments;
mod attributes;
mod bin;
mod box_filter;
mod centres;
mod color_constants;
mod content;
mod coordinates;
pub(crate) mod counters;
mod cull;
mod detect;
mod distribute;
mod draws;
mod encode;
pub(crate) mod frame;
mod groups;
mod grow;
mod host_image;
pub(crate) mod layout;
mod lent_kernel;
pub(crate) mod locations;
mod multisample;
pub(crate) mod own_layout;
mod patch;
mod pipelines;
mod points;
pub(crate) mod pool;
pub(crate) mod raster;
mod resolve;
pub(crate) mod resources;
mod sample;
mod schedule;
mod setup;
mod sort;
mod spans;
// Written by `make shaders`; some of what it has is of use to nobody yet.
#[allow(dead_code, missing_docs, clippy::derivable_impls)]
#[rustfmt::skip]
pub(crate) mod spirv;
mod take;
mod thin;
mod transform;
mod triangle_word;
pub(crate) mod upload;
mod visibility;

pub(crate) use adopt::{Adopt, AdoptedCounts};
pub(crate) use alpha_map::{AlphaLevel, AlphaMaps};
pub use attributes::Attributes;
pub use bin::Bin;
pub use box_filter::BoxFilter;
pub(crate) use centres::Centres;
pub use color_constants::ColorConstants;
pub use content::Content;
pub(crate) use coordinates::Coordinates;
pub(crate) use counters::STRETCH;
pub use counters::{Argument, Counter};
pub use cull::{Cull, CullFilter};
pub use detect::{Detect, DetectMode, DetectOptions};
pub use distribute::{Distribute, ListLength, ListRegion};
pub(crate) use draws::{Draws, HostDraw};
pub use encode::{Encode, Encoding};
pub use frame::FrameUniform;
pub use groups::Groups;
pub use grow::Grow;
pub(crate) use host_image::{HostImage, HostImageLayout};
pub use layout::FrameLayout;
pub use locations::{CellSizes, Cells, ListedLocation, LocationSizes};
pub use multisample::Multisample;
pub(crate) use own_layout::{OwnSet, SetLayout};
pub(crate) use patch::{Patch, Patched};
pub use points::Points;
pub use raster::{Raster, RasterTargets};
pub(crate) use raster::{RasterPush, RasterRun};
pub use resolve::{Resolve, ResolveTarget};
pub use resources::{BoundTexels, IdViews, Offsets, ResourceSizes, Resources, SampleSet};
pub use sample::{RecordRate, Sample, SampleOptions, TileList};
pub use schedule::Schedule;
pub use setup::Setup;
pub use sort::Sort;
pub use spans::Spans;
pub(crate) use take::Take;
pub use thin::Thin;
pub(crate) use transform::{Transform, VertexCounts};
pub(crate) use triangle_word::TriangleWord;
pub(crate) use visibility::{VisibilityUniform, VisibleGeometry, visibility_layout};
