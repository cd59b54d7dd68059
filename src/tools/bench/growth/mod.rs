//! Benchmark of growth: series of scenes in each of which one quantity grows, to see what it costs.

mod mesh;
mod scenes;

use crate::camera::Camera;
use crate::scene::{Pose, Scene};
use std::fmt;

/// Quantity that grows in a series of scenes while all others stay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// Triangles of a landscape of hills, 10^3 to 10^7.
    Triangles,
    /// Pixels of an image of a landscape of 10^5 triangles, 0.1 to 33 megapixels.
    Pixels,
    /// Superpixels' share of the pixels, 0 to 100 %: upright strips two pixels wide, of which this share alternates
    /// between two colours.
    Superpixels,
    /// Layers that fill the image, 1 to 64, the nearest last: triangles that cover each sample.
    Depth,
}

/// One scene of a series.
#[derive(Clone, Debug)]
pub struct GrowthStep {
    /// Value of the quantity: a number of triangles, megapixels, a percentage or a number of layers.
    pub value: f64,
    /// Width and height of the image in pixels.
    pub size: [u32; 2],
    /// Scene with its materials.
    pub scene: Scene,
    /// Pose with its triangles.
    pub pose: Pose,
    /// Camera of the scene.
    pub camera: Camera,
}

impl Growth {
    /// All quantities.
    pub const ALL: [Self; 4] = [
        Self::Triangles,
        Self::Pixels,
        Self::Superpixels,
        Self::Depth,
    ];

    /// Number of scenes in the series.
    #[must_use]
    pub fn steps(self) -> usize {
        match self {
            Self::Triangles => scenes::TRIANGLES.len(),
            Self::Pixels => scenes::SIZES.len(),
            Self::Superpixels => scenes::PERCENTAGES.len(),
            Self::Depth => scenes::LAYERS.len(),
        }
    }

    /// Makes scene number `index`, 0 being the least, for an image of `size` pixels unless the size is what grows;
    /// `None` after the last.
    #[must_use]
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
