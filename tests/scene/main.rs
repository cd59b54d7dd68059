//! Scene files: their contents, and files that are refused. No test here needs a device.

mod assets;
#[cfg(all(feature = "draco", feature = "basisu"))]
mod compressed;
mod edges;
mod formats;
mod geometry;
mod hostile;
mod indexed;
mod kinds;
mod left_out;
mod look;
mod malformed;
mod motion;
mod reports;
#[path = "../common/scene_builder.rs"]
mod scene_builder;
#[path = "../common/shared.rs"]
mod shared;
