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
mod arguments;
mod attributes;
#[cfg(feature = "gltf")]
mod beside_frame;
mod bin;
mod box_filter;
mod centres;
mod content;
mod coordinates;
mod counters;
#[cfg(feature = "gltf")]
mod crossings;
mod cull;
mod detect;
mod distribute;
mod draws;
mod encode;
mod frame;
#[cfg(feature = "gltf")]
mod geometry;
mod groups;
mod grow;
mod layout;
mod lent_kernel;
mod locations;
mod multisample;
#[cfg(feature = "gltf")]
mod output;
mod own_layout;
mod patch;
mod pipelines;
mod points;
mod pool;
#[cfg(feature = "gltf")]
mod pose;
#[cfg(feature = "gltf")]
pub mod prefilter;
mod raster;
#[cfg(feature = "gltf")]
mod receivers;
mod resolve;
mod resources;
mod sample;
#[cfg(feature = "gltf")]
mod scene;
mod schedule;
mod setup;
#[cfg(feature = "gltf")]
mod shade;
#[cfg(feature = "gltf")]
mod shadow;
mod shadow_words;
mod sort;
mod spans;
#[cfg(feature = "gltf")]
mod stroke;
mod take;
mod thin;
mod transform;
mod triangle_word;
mod upload;
mod visibility;

/// The compiled shaders.
#[allow(missing_docs)]
mod spirv {
    include!(concat!(env!("OUT_DIR"), "/spirv.rs"));
}

pub(crate) use adopt::{Adopt, AdoptedCounts};
pub(crate) use alpha_map::{AlphaLevel, AlphaMaps};
pub use attributes::Attributes;
pub use bin::Bin;
pub use box_filter::BoxFilter;
pub(crate) use centres::Centres;
pub use content::Content;
pub(crate) use coordinates::Coordinates;
pub(crate) use counters::STRETCH;
pub use counters::{Argument, Counter};
#[cfg(feature = "gltf")]
pub use crossings::{Crossings, MarkedOutput, SeenLocation};
pub use cull::{Cull, Kept};
pub use detect::{Detect, DetectMode, DetectOptions};
pub use distribute::{Distribute, ListLength, ListRegion};
pub(crate) use draws::{Draws, HostDraw};
pub use encode::{Encode, Encoding};
pub use frame::FrameUniform;
#[cfg(feature = "gltf")]
pub use geometry::FrameGeometry;
pub use groups::Groups;
pub use grow::Grow;
pub use layout::FrameLayout;
pub use locations::{CellSizes, Cells, ListedLocation, LocationSizes};
pub use multisample::Multisample;
#[cfg(feature = "gltf")]
pub use output::{Output, Shown};
pub(crate) use own_layout::{OwnSet, SetLayout};
pub(crate) use patch::{Patch, Patched};
pub use points::Points;
#[cfg(feature = "gltf")]
pub use pose::Pose;
pub use raster::{Raster, RasterTargets};
pub(crate) use raster::{RasterPush, RasterRun};
#[cfg(feature = "gltf")]
pub use receivers::{LightPlane, Receivers, Receiving};
pub use resolve::{Resolve, Then};
pub use resources::{IdViews, Offsets, ResourceSizes, Resources, SampleSet};
pub use sample::{RecordRate, Sample, SampleOptions, TileList};
#[cfg(feature = "gltf")]
pub use scene::{FrameLook, GpuScene, SceneUploads};
pub use schedule::Schedule;
pub use setup::Setup;
#[cfg(feature = "gltf")]
pub use shade::{Shade, ShadeSource};
#[cfg(feature = "gltf")]
pub use shadow::{Found, Shadow};
pub use sort::Sort;
pub use spans::Spans;
#[cfg(feature = "gltf")]
pub use stroke::{Stroke, StrokeSizes};
pub(crate) use take::Take;
pub use thin::Thin;
pub(crate) use transform::{Transform, VertexCounts};
pub(crate) use triangle_word::TriangleWord;
pub(crate) use visibility::{VisibilityUniform, VisibleGeometry, visibility_layout};
