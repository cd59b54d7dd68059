//! Benchmark of growth: series of scenes in which one quantity grows, to measure how the time grows with it.

mod mesh;
mod scenes;

use gpc::camera::Camera;
use gpc::scene::{Pose, Scene};
use std::fmt;

/// Quantity that grows in a series of scenes while all others stay constant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// Triangles of a landscape of hills, 10^3 to 10^7.
    Triangles,
    /// Pixels of an image of a landscape of 10^5 triangles, 0.1 to 33 megapixels.
    Pixels,
    /// Share of superpixels among the pixels, 0 to 100 %: upright strips two pixels wide, of which this share
    /// alternates between two colours.
    Superpixels,
    /// Number of layers that fill the image, 1 to 64, the nearest drawn last: the triangles that cover each sample.
    Depth,
}

/// One scene of a series.
#[derive(Clone, Debug)]
pub struct GrowthStep {
    /// Value of the quantity: number of triangles, megapixels, percentage or number of layers.
    pub value: f64,
    /// Width and height of the image in pixels.
    pub size: [u32; 2],
    /// Scene with its materials.
    pub scene: Scene,
    /// Pose of the scene, with its triangles.
    pub pose: Pose,
    /// Camera of the scene.
    pub camera: Camera,
}

impl Growth {
    /// All quantities, each with a series of its own.
    pub const ALL: [Self; 4] = [Self::Triangles, Self::Pixels, Self::Superpixels, Self::Depth];

    /// Number of scenes in the series.
    pub fn steps(self) -> usize {
        match self {
            Self::Triangles => scenes::TRIANGLES.len(),
            Self::Pixels => scenes::SIZES.len(),
            Self::Superpixels => scenes::PERCENTAGES.len(),
            Self::Depth => scenes::LAYERS.len(),
        }
    }

    /// Makes scene number `index`, 0 being the smallest; `None` after the last. `size` is the width and height of the
    /// image in pixels, unless the size is the quantity that grows.
    pub fn step(self, index: usize, size: [u32; 2]) -> Option<GrowthStep> {
        match self {
            Self::Triangles => {
                let count = *scenes::TRIANGLES.get(index)?;
                Some(scenes::landscape(count, size, f64::from(count)))
            }
            Self::Pixels => {
                let size = *scenes::SIZES.get(index)?;
                let megapixels = f64::from(size[0]) * f64::from(size[1]) / 1e6;
                Some(scenes::landscape(100_000, size, megapixels))
            }
            Self::Superpixels => Some(scenes::strips(*scenes::PERCENTAGES.get(index)?, size)),
            Self::Depth => Some(scenes::layers(*scenes::LAYERS.get(index)?, size)),
        }
    }
}

impl fmt::Display for Growth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Triangles => "triangles",
            Self::Pixels => "megapixels",
            Self::Superpixels => "superpixels, %",
            Self::Depth => "depth complexity",
        })
    }
}
