//! Rectangle of tiles on a pinhole's plane, as passes see it.

use crate::camera::Pinhole;
use crate::engine::data::{Cells, FrameUniform, ResourceSizes, tiles};
use crate::engine::passes::ListRegion;
use crate::engine::sampler::SamplerSettings;
use crate::engine::sampler::footprint::Footprints;
use crate::engine::sampler::uniform::{PlaneBlock, SceneBlock, frame_uniform};
use crate::render::data::GpuScene;
use glam::{DMat4, DVec2};

/// Width and height of a tile in pixels.
pub(super) const TILE: [i64; 2] = [tiles::WIDTH as i64, tiles::HEIGHT as i64];

/// Part of a plane in which sampling locations lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlaneWindow {
    /// Column and row of the window's upper left pixel.
    pub low: [i64; 2],
    /// Width and height in tiles.
    pub tiles: [u32; 2],
    /// Place on the plane, in pixels, to which clip-space positions are relative.
    pub middle: [f64; 2],
}

impl PlaneWindow {
    /// Number of tiles.
    pub fn tile_count(&self) -> u32 {
        self.tiles[0] * self.tiles[1]
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        [0, 1].map(|axis| self.tiles[axis] * TILE[axis] as u32)
    }

    /// Upper left and lower right corner, extended by `beyond` pixels on each side.
    pub fn rectangle(&self, beyond: f64) -> [DVec2; 2] {
        let low = DVec2::from_array(self.low.map(|pixel| pixel as f64));
        let size = DVec2::from_array(self.size().map(f64::from));
        [low - beyond, low + size + beyond]
    }

    /// This window as the region of a list of `count` locations.
    pub fn region(&self, count: usize) -> ListRegion {
        ListRegion { tiles: self.tiles, count: count as u32 }
    }

    /// Matrix from the scene's coordinates to clip space around the window's middle.
    pub fn to_clip(self, scene: &GpuScene, pinhole: &Pinhole) -> DMat4 {
        pinhole.pixel_matrix(scene.geometry.origin, DVec2::from_array(self.middle))
    }

    /// Uniform block for a list of cells in this window, each with a number of samples.
    pub fn uniform(
        &self,
        scene: &GpuScene,
        pinhole: &Pinhole,
        settings: &SamplerSettings,
        cells: Cells,
        samples: u32,
        sizes: &ResourceSizes,
    ) -> FrameUniform {
        let of_cell = if cells.are_points() { 1 } else { samples };
        let footprints = Footprints::new(settings.filter, of_cell);
        let plane = PlaneBlock {
            transform: self.to_clip(scene, pinhole).as_mat4().to_cols_array(),
            corner: [0, 1].map(|axis| self.low[axis] as f64 - self.middle[axis]),
            size: self.size(),
            ..PlaneBlock::default()
        };
        let scene = SceneBlock::of(scene, &pinhole.into());
        frame_uniform(&scene, &plane, settings, samples, &footprints, sizes)
    }
}
