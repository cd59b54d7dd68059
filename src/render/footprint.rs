//! How large the squares are that textures are filtered over.

use super::{Footprint, Method, Settings};

/// Sides of these squares.
pub(super) struct Footprints {
    /// At the centre of a pixel, in pixels of the region.
    pub centre: f32,
    /// At the place of a visibility record, in pixels of the region; of [`Footprint::Sample`], over the root of the
    /// record's share of a cell.
    pub place: f32,
    /// At a sub-sample that tests alpha, in pixels of the region.
    pub sample: f32,
}

impl Footprints {
    /// Those of cells of so many samples.
    pub fn new(settings: &Settings, samples: u32) -> Self {
        let env = |name: &str, or: f32| {
            std::env::var(name)
                .ok()
                .and_then(|v| v.parse().ok())
                .unwrap_or(or)
        };
        let everywhere = |side: f32| Self {
            centre: side,
            place: side,
            sample: side,
        };
        match settings.footprint {
            Footprint::Pixel => everywhere(settings.side() as f32),
            Footprint::Side(side) => everywhere(side * settings.side() as f32),
            Footprint::Sample if settings.method == Method::Superpixel => Self {
                centre: 1.0,
                place: 1.0,
                sample: env("K_SAMPLE", 0.125) / (samples as f32).sqrt(),
            },
            Footprint::Sample => everywhere(1.0),
        }
    }
}
