//! Environments as backgrounds of images.

use super::{Rendered, Settings};
use crate::camera::{Camera, Pinhole, PinholeError};
use crate::color::tonemap;
use crate::scene::Environment;
use glam::DVec2;
use rayon::prelude::*;

/// Places in a pixel, from its corner, at which the environment is looked up.
const LINES: [DVec2; 4] =
    [DVec2::new(0.25, 0.25), DVec2::new(0.75, 0.25), DVec2::new(0.25, 0.75), DVec2::new(0.75, 0.75)];

impl Rendered {
    /// Fills the transparent parts of the image with an environment; the image is opaque afterwards. `camera` and
    /// `settings` are those that the image was rendered with.
    ///
    /// # Errors
    /// [`PinholeError`] if the camera is not finite or out of range, or the image has no pixels.
    pub fn show_behind(
        &mut self,
        environment: &Environment,
        camera: &Camera,
        settings: &Settings,
    ) -> Result<(), PinholeError> {
        let pinhole = Pinhole::from_camera(camera, settings.size)?;
        let corner = settings.region.map_or([0, 0], |region| region.corner);
        let width = self.size[0].max(1);
        let exposure = f64::from(settings.scene.exposure).exp2();
        let tonemaps = settings.sampler().tonemaps();
        let colors = self.colors.par_iter_mut().enumerate();
        colors.filter(|(_, color)| color[3] < 1.0).for_each(|(index, color)| {
            let (x, y) = (index as u32 % width, index as u32 / width);
            let at = DVec2::new(f64::from(corner[0] + x), f64::from(corner[1] + y));
            let mut behind = [0.0; 3];
            for line in LINES {
                let direction = pinhole.ray(at + line).direction;
                let radiance = (environment.radiance(direction) * exposure).to_array();
                let shown = if tonemaps { tonemap::neutral(radiance) } else { radiance };
                behind.iter_mut().zip(shown).for_each(|(sum, light)| *sum += light / 4.0);
            }
            let left = f64::from(1.0 - color[3]);
            for (channel, light) in color.iter_mut().zip(behind) {
                *channel += (left * light) as f32;
            }
            color[3] = 1.0;
        });
        Ok(())
    }
}
