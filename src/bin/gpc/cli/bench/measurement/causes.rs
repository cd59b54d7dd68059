//! Causes of the errors that antialiasing leaves.

use super::Yardstick;
use glam::DVec2;
use gpc::camera::Camera;
use gpc::compare::CompareError;
use gpc::output::Picture;
use gpc::render::{Headless, Method, PixelAttributes, PreparedScene, RenderError, Settings, SuperpixelOptions};
use gpc::sampling::owen_sobol;
use serde::Serialize;
use std::ops::RangeInclusive;

/// Places in a pixel, besides its centre, at which IDs are looked up.
pub const LOOKS: u32 = 64;

/// Scrambling seed of these places, another one than those of the patterns.
const SEED: u32 = 2;

/// Cause of a pixel's error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// Superpixel: the error comes from the number of its samples and shadings.
    Superpixel,
    /// Pixel that is no superpixel and holds several triangles, each of which some centre of the 3 x 3 pixels around it
    /// shows: their colours contrast too little.
    BelowThreshold,
    /// Pixel that is no superpixel and holds a triangle, or a gap between triangles, that no centre of the 3 x 3
    /// pixels around it shows.
    Unseen,
    /// Pixel that is no superpixel and holds one triangle: its error comes from shading or texture.
    Inside,
}

/// Squared error of an image by cause. Each part is a share of the squared error of one sample a pixel, of sRGB-encoded
/// colours; they add up to 1 - [`super::Accuracy::removed`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Split {
    /// Share in superpixels.
    pub superpixels: f64,
    /// Share in pixels that contrast too little to become superpixels.
    pub below_threshold: f64,
    /// Share in pixels with features that no centre shows and that did not become superpixels.
    pub unseen: f64,
    /// Share in pixels of one triangle.
    pub inside: f64,
}

/// Triangles in each pixel, found at [`LOOKS`] places and at the centre.
///
/// IDs are those of opaque and MASK triangles; a BLEND triangle counts as what lies behind it.
pub struct PixelTriangles<'a> {
    pub(super) scene: &'a PreparedScene,
    pub(super) camera: Camera,
    unseen: Vec<bool>,
    several: Vec<bool>,
}

impl<'a> PixelTriangles<'a> {
    /// Finds the triangle IDs in each pixel of an image with these settings. `progress` is called after each of
    /// [`LOOKS`] renderings.
    ///
    /// # Errors
    /// As [`Headless::render`].
    pub fn new(
        headless: &mut Headless,
        scene: &'a PreparedScene,
        camera: &Camera,
        settings: &Settings,
        mut progress: impl FnMut(),
    ) -> Result<Self, RenderError> {
        let plain = with_attributes(settings, Method::None);
        let mut frame = headless.prepare(scene, &plain)?;
        let centres = headless.render(&mut frame, camera)?.attributes;
        let mut unseen = vec![false; centres.len()];
        let mut several = unseen.clone();
        let size = DVec2::from(settings.size.map(f64::from));
        for place in owen_sobol(LOOKS, SEED) {
            let camera = Camera { shift: camera.shift + DVec2::from(place.map(f64::from)) / size, ..*camera };
            let seen = headless.render(&mut frame, &camera)?.attributes;
            for (pixel, (unseen, looked)) in unseen.iter_mut().zip(&seen).enumerate() {
                *unseen = *unseen || !around(&centres, settings.size, pixel).any(|id| id == looked.id);
            }
            for (several, (centre, looked)) in several.iter_mut().zip(centres.iter().zip(&seen)) {
                *several = *several || centre.id != looked.id;
            }
            progress();
        }
        Ok(Self { scene, camera: *camera, unseen, several })
    }

    /// Whether a pixel holds several triangles, or a triangle and background.
    pub(super) fn holds_several(&self, pixel: usize) -> bool {
        self.several.get(pixel).copied().unwrap_or_default()
    }

    /// Cause of each pixel's error under superpixel antialiasing with these settings, rows from the top. The size must be
    /// that which [`PixelTriangles::new`] was given.
    ///
    /// # Errors
    /// As [`Headless::render`].
    pub fn causes(&self, headless: &mut Headless, settings: &Settings) -> Result<Vec<Cause>, RenderError> {
        // Which pixels become superpixels depends on the number of samples.
        let superpixels = match &settings.method {
            Method::Superpixel(options) => options.clone(),
            _ => SuperpixelOptions::new(1),
        };
        let mut frame = headless.prepare(self.scene, &with_attributes(settings, superpixels.into()))?;
        let centres = headless.render(&mut frame, &self.camera)?.attributes;
        let holds = self.unseen.iter().zip(&self.several);
        Ok(centres.iter().zip(holds).map(|(centre, (unseen, several))| cause(centre, *unseen, *several)).collect())
    }
}

/// Cause of the error of a pixel that holds a triangle which no centre shows, or several triangles.
fn cause(centre: &PixelAttributes, unseen: bool, several: bool) -> Cause {
    match (unseen, several) {
        _ if centre.superpixel != 0 => Cause::Superpixel,
        (true, _) => Cause::Unseen,
        (false, true) => Cause::BelowThreshold,
        (false, false) => Cause::Inside,
    }
}

/// Settings for a frame with IDs and superpixels.
fn with_attributes(settings: &Settings, method: Method) -> Settings {
    settings.clone().attributes(true).method(method)
}

/// IDs at the centres of a pixel and its neighbours.
fn around(centres: &[PixelAttributes], [width, height]: [u32; 2], pixel: usize) -> impl Iterator<Item = u32> {
    let [width, height] = [width, height].map(|side| side as usize);
    let beside = |at: usize, side: usize| -> RangeInclusive<usize> {
        at.saturating_sub(1)..=(at + 1).min(side.saturating_sub(1))
    };
    let columns = beside(pixel % width, width);
    beside(pixel / width, height)
        .flat_map(move |row| columns.clone().map(move |column| row * width + column))
        .filter_map(|index| centres.get(index))
        .map(|centre| centre.id)
}

impl Yardstick {
    /// Splits an image's error by cause; all parts are zero if one sample a pixel has no error.
    ///
    /// # Errors
    /// [`CompareError::Size`] if the image does not have the reference's size.
    pub fn split(&self, picture: &Picture<'_>, causes: &[Cause]) -> Result<Split, CompareError> {
        let mut split = Split::default();
        for (share, cause) in self.shares(picture)?.iter().zip(causes) {
            *split.of_mut(*cause) += share;
        }
        Ok(split)
    }
}

impl Split {
    /// Mutable share of a cause.
    fn of_mut(&mut self, cause: Cause) -> &mut f64 {
        match cause {
            Cause::Superpixel => &mut self.superpixels,
            Cause::BelowThreshold => &mut self.below_threshold,
            Cause::Unseen => &mut self.unseen,
            Cause::Inside => &mut self.inside,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_cause_is_told_from_the_others() {
        let cause = |superpixel: u32, unseen: bool, several: bool| {
            cause(&PixelAttributes { superpixel, ..PixelAttributes::default() }, unseen, several)
        };
        assert_eq!(cause(1, true, true), Cause::Superpixel);
        assert_eq!(cause(0, false, false), Cause::Inside);
        assert_eq!(cause(0, false, true), Cause::BelowThreshold);
        assert_eq!(cause(0, true, true), Cause::Unseen);
    }

    #[test]
    fn neighbours_end_at_the_image() {
        let centres: Vec<_> = (0..12).map(|id| PixelAttributes { id, ..PixelAttributes::default() }).collect();
        let at = |pixel| around(&centres, [4, 3], pixel).collect::<Vec<_>>();
        assert_eq!(at(0), [0, 1, 4, 5]);
        assert_eq!(at(5), [0, 1, 2, 4, 5, 6, 8, 9, 10]);
        assert_eq!(at(7), [2, 3, 6, 7, 10, 11]);
    }

    #[test]
    fn shares_add_up_to_what_is_left() {
        let pixels = |codes: [f32; 4]| codes.map(|v| [v, v, v, 1.0]);
        let [reference, one, image] = [[0.2, 0.4, 0.6, 0.8], [0.1, 0.5, 0.4, 0.9], [0.2, 0.45, 0.7, 0.8]].map(pixels);
        let picture = |pixels| Picture::new([4, 1], pixels).unwrap();
        let yardstick = Yardstick::new(&picture(&reference), &picture(&one)).unwrap();
        let causes = [Cause::Superpixel, Cause::BelowThreshold, Cause::Unseen, Cause::Inside];
        let image = picture(&image);
        let split = yardstick.split(&image, &causes).unwrap();
        let removed = yardstick.measure(&image).unwrap().removed;
        let sum = split.superpixels + split.below_threshold + split.unseen + split.inside;
        assert!((sum - (1.0 - removed)).abs() < 1e-9, "{split:?} {removed}");
        assert!(split.superpixels == 0.0 && split.inside == 0.0, "{split:?}");
        assert!(split.below_threshold > 0.0 && split.unseen > split.below_threshold);
    }
}
