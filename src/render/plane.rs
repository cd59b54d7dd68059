//! A rectangle of tiles of a pinhole's plane, as passes see it.

use super::Settings;
use crate::camera::Pinhole;
use crate::engine::sampler::footprint::Footprints;
use crate::engine::sampler::uniform::{PlaneBlock, SceneBlock, frame_uniform};
use crate::passes::{Cells, FrameUniform, ListRegion, ResourceSizes};
use crate::render::passes::GpuScene;
use glam::{DMat4, DVec2};

/// Pixels of a tile.
pub(super) const TILE: [i64; 2] = [8, 4];

/// The part of a plane that sample locations lie in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Window {
    /// Its upper left pixel.
    pub low: [i64; 2],
    /// Its size in tiles.
    pub tiles: [u32; 2],
    /// The place on the plane that clip-space positions are relative to, in pixels.
    pub middle: [f64; 2],
}

impl Window {
    /// Tiles that it has.
    pub fn tile_count(&self) -> u32 {
        self.tiles[0] * self.tiles[1]
    }

    /// Its size in pixels.
    pub fn size(&self) -> [u32; 2] {
        [0, 1].map(|axis| self.tiles[axis] * TILE[axis] as u32)
    }

    /// Its corners, and so many pixels more on each side.
    pub fn rectangle(&self, beyond: f64) -> [DVec2; 2] {
        let low = DVec2::from_array(self.low.map(|pixel| pixel as f64));
        let size = DVec2::from_array(self.size().map(f64::from));
        [low - beyond, low + size + beyond]
    }

    /// It, as what a list of so many locations is of.
    pub fn region(&self, count: usize) -> ListRegion {
        ListRegion {
            tiles: self.tiles,
            count: count as u32,
        }
    }

    /// From the space of a scene's geometry to clip space around its middle.
    pub fn to_clip(self, scene: &GpuScene, pinhole: &Pinhole) -> DMat4 {
        pinhole.pixel_matrix(scene.origin(), DVec2::from_array(self.middle))
    }

    /// The uniform block of a list of such cells in it, each with so many samples.
    pub fn uniform(
        &self,
        scene: &GpuScene,
        pinhole: &Pinhole,
        settings: &Settings,
        (cells, samples): (Cells, u32),
        sizes: &ResourceSizes,
    ) -> FrameUniform {
        let footprints = Footprints::new(settings, if cells.are_points() { 1 } else { samples });
        let plane = PlaneBlock {
            transform: self.to_clip(scene, pinhole).as_mat4().to_cols_array(),
            corner: [0, 1].map(|axis| self.low[axis] as f64 - self.middle[axis]),
            size: self.size(),
            ..PlaneBlock::default()
        };
        let scene = SceneBlock::of(scene, &pinhole.into());
        frame_uniform(&scene, &plane, settings, (samples, &footprints), sizes)
    }
}
