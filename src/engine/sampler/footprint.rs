//! Sizes of the squares over which textures are filtered.

use super::{Footprint, Method, Settings};

/// Side of the square over which alpha is filtered before its test, in distances between samples. Small squares are
/// best, because testing filtered alpha is not the same as filtering the results of tests. With a small square, leaves
/// keep their holes and tips.
const ALPHA_SIDE: f32 = 0.125;

/// Sides of the squares over which textures are filtered.
pub(crate) struct Footprints {
    /// Side at the centre of a pixel, in pixels of the region.
    pub centre: f32,
    /// Side at the place of a visibility sample, in pixels of the region. With [`Footprint::Sample`], the value is the
    /// side divided by the root of the sample's share of a cell.
    pub place: f32,
    /// Side at a sample that tests alpha, in pixels of the region.
    pub sample: f32,
}

impl Footprints {
    /// Footprints for cells of `samples` samples.
    pub fn new(settings: &Settings, samples: u32) -> Self {
        let everywhere = |side: f32| Self {
            centre: side,
            place: side,
            sample: side,
        };
        // The distance between samples, in pixels.
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
