//! Accumulation: the mean of frames whose cameras are moved within a pixel.

use super::{Headless, Pixel, RenderError, Rendered, SceneFrame};
use crate::camera::Camera;
use crate::engine::sampler::Statistics;
use glam::DVec2;

impl Headless {
    /// Renders the frame once for each of the `offsets`, with the camera moved by so many pixels to the right and down, and
    /// returns the mean of the images. The statistics are the sums over all frames. `progress` is called after each frame.
    ///
    /// # Errors
    /// As [`Headless::render`].
    pub fn accumulate(
        &mut self,
        frame: &mut SceneFrame,
        camera: &Camera,
        offsets: &[DVec2],
        progress: impl FnMut(),
    ) -> Result<Rendered, RenderError> {
        self.mean(frame, camera, offsets, progress)
    }

    /// As [`Self::accumulate`], for a type of pixel that holds light.
    pub(super) fn mean<P: Pixel>(
        &mut self,
        frame: &mut SceneFrame,
        camera: &Camera,
        offsets: &[DVec2],
        mut progress: impl FnMut(),
    ) -> Result<Rendered<P>, RenderError> {
        let size = DVec2::from(frame.settings().size.map(f64::from));
        let weight = 1.0 / offsets.len() as f64;
        let mut sums: Vec<[f64; 4]> = Vec::new();
        let mut statistics = Statistics::default();
        for offset in offsets {
            let moved = Camera { shift: camera.shift + *offset / size, ..*camera };
            let image = self.render_one::<P>(frame, &moved)?;
            let colors: &[[f32; 4]] = bytemuck::cast_slice(&image.colors);
            sums.resize(colors.len(), [0.0; 4]);
            for (sum, color) in sums.iter_mut().zip(colors) {
                for (sum, value) in sum.iter_mut().zip(color) {
                    *sum += f64::from(*value);
                }
            }
            statistics.append(image.statistics);
            progress();
        }
        let colors: Vec<[f32; 4]> = sums.into_iter().map(|sum| sum.map(|value| (value * weight) as f32)).collect();
        Ok(Rendered {
            size: frame.settings().output_size(),
            colors: bytemuck::cast_slice(&colors).to_vec(),
            attributes: Vec::new(),
            statistics,
        })
    }
}
