//! The uniform block of a region of an image.

use super::recording::FrameRecording;
use crate::camera::{Camera, Projection};
use crate::engine::data::FrameUniform;
use crate::engine::sampler::footprint::Footprints;
use crate::engine::sampler::plan::Region;
use crate::engine::sampler::uniform::{PlaneBlock, SceneBlock, frame_uniform};
use crate::render::Settings;
use crate::render::data::GpuScene;
use glam::DMat4;

impl FrameRecording<'_> {
    /// Uniform block of a region whose superpixels have `samples` samples. With `owned`, only the wanted pixels of the
    /// region can become superpixels; the pixels of its halo can't.
    pub(super) fn uniform(&self, region: &Region, samples: u32, owned: bool) -> FrameUniform {
        let (scene, camera) = (self.scene, self.camera);
        let side = self.settings.method.side();
        let image = self.settings.size.map(|pixels| f64::from(pixels * side));
        let corner = region.corner().map(|pixel| f64::from(pixel * side));
        let size = region.outer().map(|pixels| pixels * side);
        let low = region.first_wanted().map(|place| place * side);
        let wanted = region.size().map(|pixels| pixels * side);
        let threshold = u32::from(self.settings.superpixels().threshold());
        let plane = PlaneBlock {
            transform: to_clip(scene, camera, self.settings).as_mat4().to_cols_array(),
            corner: [0, 1].map(|axis| corner[axis] - 0.5 * image[axis]),
            size,
            interior: if owned { [low, [0, 1].map(|axis| low[axis] + wanted[axis])] } else { [[0, 0], size] },
            gap: gap(camera, image[1]),
            contrast: threshold,
            alike: threshold,
            side,
            ..PlaneBlock::default()
        };
        let footprints = Footprints::new(self.sampler.filter, samples);
        frame_uniform(
            &SceneBlock::of(scene, &camera.into()),
            &plane,
            self.sampler,
            samples,
            &footprints,
            &self.plan.sizes,
        )
    }
}

/// Matrix from a scene's coordinates to the image's clip space, with x and y in pixels.
pub(super) fn to_clip(scene: &GpuScene, camera: &Camera, settings: &Settings) -> DMat4 {
    let side = settings.method.side();
    let [width, height] = settings.size.map(|pixels| f64::from(pixels * side));
    camera.pixel_matrix(scene.geometry.origin, width, height)
}

/// Difference in depth of two surfaces whose distances differ by a pixel's width: a factor that is multiplied by the
/// depth, and a constant that is added.
fn gap(camera: &Camera, image_height: f64) -> [f32; 2] {
    match camera.projection {
        // Depth is near / distance, so that relative differences of depth and of distance are equal.
        Projection::Perspective { fov, .. } => [(2.0 * (0.5 * fov).tan() / image_height) as f32, 0.0],
        Projection::Orthographic { half_height, near, far } => {
            [0.0, (2.0 * half_height / image_height / (far - near)) as f32]
        }
    }
}
