//! Accumulation: the mean of frames whose cameras are moved within a pixel.

use super::{Headless, Pixel, RenderError, Rendered, SceneFrame, Settings};
use crate::camera::Camera;
use crate::engine::sampler::Statistics;
use crate::sampling::PixelFilter;
use glam::DVec2;

/// Pixels that an image shows of the whole image.
struct Seen {
    corner: [u32; 2],
    size: [u32; 2],
    whole: [u32; 2],
}

impl Seen {
    fn of(settings: &Settings) -> Self {
        let corner = settings.region.map_or([0, 0], |region| region.corner);
        Self { corner, size: settings.output_size(), whole: settings.size }
    }

    /// For each column (axis 0) or row (axis 1) of pixels, whether the place at this offset from their centres lies in the
    /// whole image.
    fn within(&self, axis: usize, offset: f64) -> Vec<bool> {
        let end = f64::from(self.whole[axis]);
        let places = (0..self.size[axis]).map(|i| f64::from(self.corner[axis] + i) + 0.5 + offset);
        places.map(|place| (0.0..=end).contains(&place)).collect()
    }
}

impl Headless {
    /// Renders the frame once for each of the `offsets`, with the camera moved by so many pixels to the right and down, and
    /// returns the mean of the images, weighted by the settings' pixel filter at the offsets. What lies beyond the image's
    /// edge has no weight. The statistics are the sums over all frames. `progress` is called after each frame.
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
        let filter = frame.settings().pixel_filter;
        let weighted = offsets.iter().map(|offset| (offset.to_array(), filter.at((*offset).into())));
        self.mean(frame, camera, &weighted.collect::<Vec<_>>(), progress)
    }

    /// As [`Self::accumulate`], for a type of pixel that holds light, and with a weight for each offset.
    pub(super) fn mean<P: Pixel>(
        &mut self,
        frame: &mut SceneFrame,
        camera: &Camera,
        samples: &[([f64; 2], f64)],
        mut progress: impl FnMut(),
    ) -> Result<Rendered<P>, RenderError> {
        let size = DVec2::from(frame.settings().size.map(f64::from));
        let filter = frame.settings().pixel_filter;
        let seen = Seen::of(frame.settings());
        let mut sums: Vec<[f64; 5]> = Vec::new();
        let mut statistics = Statistics::default();
        for (offset, weight) in samples {
            let moved = Camera { shift: camera.shift + DVec2::from(*offset) / size, ..*camera };
            let image = self.render_one::<P>(frame, &moved)?;
            let colors: &[[f32; 4]] = bytemuck::cast_slice(&image.colors);
            sums.resize(colors.len(), [0.0; 5]);
            let [columns, rows] = [0, 1].map(|axis| seen.within(axis, offset[axis]));
            let places = rows.iter().flat_map(|row| columns.iter().map(move |column| *row && *column));
            for ((sum, color), _) in sums.iter_mut().zip(colors).zip(places).filter(|(_, is_within)| *is_within) {
                for (sum, value) in sum.iter_mut().zip(color) {
                    *sum += weight * f64::from(*value);
                }
                sum[4] += *weight;
            }
            statistics.append(image.statistics);
            progress();
        }
        let mean = |[r, g, b, a, weight]: [f64; 5]| {
            let share = 1.0 / weight;
            let mean = [r, g, b, a].map(|sum| sum * share);
            if filter.is_box() { mean } else { PixelFilter::clip(mean) }
        };
        let colors: Vec<[f32; 4]> = sums.into_iter().map(|sum| mean(sum).map(|value| value as f32)).collect();
        Ok(Rendered {
            size: frame.settings().output_size(),
            colors: bytemuck::cast_slice(&colors).to_vec(),
            attributes: Vec::new(),
            statistics,
        })
    }
}
