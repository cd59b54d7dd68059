//! The uniform block of a region of an image.

use super::recording::Recording;
use crate::camera::{Camera, Projection};
use crate::engine::sampler::footprint::Footprints;
use crate::engine::sampler::plan::Region;
use crate::passes::FrameUniform;
use crate::render::Settings;
use crate::render::passes::GpuScene;
use crate::render::uniform::{Looking, uniform};
use glam::DMat4;

impl Recording<'_> {
    /// The uniform block of a region and of cells of so many samples; with `owned`, only pixels that are wanted of
    /// the region become cells.
    pub(super) fn uniform(&self, region: &Region, samples: u32, owned: bool) -> FrameUniform {
        let (scene, camera) = (self.scene, self.camera);
        let side = self.settings.side();
        let scale = f64::from(side);
        let [image_width, image_height] =
            self.settings.size.map(|pixels| f64::from(pixels) * scale);
        let [width, height] = region.outer().map(|pixels| pixels * side);
        let corner = region.corner().map(|pixel| f64::from(pixel) * scale);
        let left_top = [
            corner[0] - 0.5 * image_width,
            corner[1] - 0.5 * image_height,
        ];
        let to_device = [2.0 / f64::from(width), 2.0 / f64::from(height)];
        let low = region.first_wanted().map(|place| place * side);
        let [own_width, own_height] = region.size().map(|pixels| pixels * side);
        let (interior_low, interior_high) = if owned {
            (low, [low[0] + own_width, low[1] + own_height])
        } else {
            ([0, 0], [width, height])
        };
        let looking = Looking {
            eye: camera.eye,
            direction: camera.direction(),
            is_parallel: camera.is_orthographic(),
        };
        let footprints = Footprints::new(self.settings, samples);
        FrameUniform {
            transform: to_clip(scene, camera, self.settings)
                .as_mat4()
                .to_cols_array(),
            raster_scale: to_device.map(|scale| scale as f32),
            raster_offset: [0, 1].map(|axis| (-left_top[axis] * to_device[axis] - 1.0) as f32),
            origin: left_top.map(|position| (position + 0.5) as f32),
            size: [width, height],
            tiles: [width.div_ceil(8), height.div_ceil(4)],
            interior_low,
            interior_high,
            gap: gap(camera, image_height),
            contrast: u32::from(self.settings.contrast),
            alike: u32::from(self.settings.contrast),
            side,
            reach: 0.5,
            ..uniform(
                scene,
                self.settings,
                &looking,
                (samples, &footprints),
                &self.plan.sizes,
            )
        }
    }
}

/// From the space of a scene's geometry to the image's clip space, in pixels.
pub(super) fn to_clip(scene: &GpuScene, camera: &Camera, settings: &Settings) -> DMat4 {
    let [width, height] = settings.size.map(|side| f64::from(side * settings.side()));
    camera.pixel_matrix(scene.origin(), width, height)
}

/// Factor on a depth, and constant, by which a surface nearer by a pixel's width has a larger depth.
fn gap(camera: &Camera, image_height: f64) -> [f32; 2] {
    match camera.projection {
        // Depth is near / distance, so that a relative difference is one of distances.
        Projection::Perspective { fov, .. } => {
            [(2.0 * (0.5 * fov).tan() / image_height) as f32, 0.0]
        }
        Projection::Orthographic {
            half_height,
            near,
            far,
        } => [
            0.0,
            (2.0 * half_height / image_height / (far - near)) as f32,
        ],
    }
}
