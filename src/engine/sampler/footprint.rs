//! How large the squares are that textures are filtered over.

use super::{Footprint, Method, Settings};

/// Side of the square that alpha is filtered over before it is tested, in distances between samples. What a test makes of
/// filtered alpha is not the filtered outcome of tests, so that the finest is best: leaves keep their holes and tips.
const ALPHA_SIDE: f32 = 0.125;

/// Sides of these squares.
pub(crate) struct Footprints {
    /// At the centre of a pixel, in pixels of the region.
    pub centre: f32,
    /// At the place of a visibility sample, in pixels of the region; of [`Footprint::Sample`], over the root of the
    /// record's share of a cell.
    pub place: f32,
    /// At a sub-sample that tests alpha, in pixels of the region.
    pub sample: f32,
}

impl Footprints {
    /// Those of cells of so many samples.
    pub fn new(settings: &Settings, samples: u32) -> Self {
        let everywhere = |side: f32| Self {
            centre: side,
            place: side,
            sample: side,
        };
        // The distance between samples.
        let sample = 1.0 / (samples as f32).sqrt();
        match settings.footprint {
            Footprint::Pixel => everywhere(settings.side() as f32),
            Footprint::Side(side) => everywhere(side * settings.side() as f32),
            Footprint::Sample if settings.shades_samples() => Self {
                centre: 0.5,
                place: sample,
                sample: if samples > 1 { sample } else { ALPHA_SIDE },
            },
            Footprint::Sample if matches!(settings.method, Method::Superpixel(_)) => Self {
                centre: 1.0,
                place: 1.0,
                sample: ALPHA_SIDE * sample,
            },
            Footprint::Sample => everywhere(1.0),
        }
    }
}
