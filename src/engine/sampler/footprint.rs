//! Sizes of the squares over which textures are filtered.

use super::{EngineError, Footprint, Shading};

/// Side of the square over which alpha is filtered before its test, in distances between samples. Small squares are
/// best, because testing filtered alpha is not the same as filtering the results of tests. With a small square, leaves
/// keep their holes and tips.
const ALPHA_SIDE: f32 = 0.125;

/// Areas over which textures are filtered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum TextureFilter {
    /// Boxes over the area that each shading represents, along both of its axes.
    Boxes,
    /// Squares whose side is the distance between samples, for cells that are shaded at each sample.
    Samples,
    /// Squares with this side, in rendered pixels.
    Squares(f32),
}

impl TextureFilter {
    /// Filter for cells that are shaded at this rate.
    pub fn of_cells(footprint: Footprint, shading: Shading) -> Self {
        match footprint {
            Footprint::Sample if shading == Shading::Sample => Self::Samples,
            Footprint::Sample => Self::Boxes,
            Footprint::Pixel => Self::Squares(1.0),
            Footprint::Side(side) => Self::Squares(side),
        }
    }

    /// Filter for pixels that are not superpixels: the centres of squares of `side` x `side` rendered pixels for each
    /// output pixel.
    pub fn of_pixels(footprint: Footprint, side: u32) -> Self {
        Self::Squares(match footprint {
            Footprint::Sample => 1.0,
            Footprint::Pixel => side as f32,
            Footprint::Side(part) => part * side as f32,
        })
    }
}

impl Footprint {
    /// Checks the side of a square.
    pub(crate) fn check(self) -> Result<(), EngineError> {
        match self {
            Self::Side(side) if !(side > 0.0 && side <= 1.0) => Err(EngineError::Footprint(side)),
            _ => Ok(()),
        }
    }
}

/// Sides of the squares over which textures are filtered.
pub(crate) struct Footprints {
    /// Side at the centre of a pixel, in pixels of the region.
    pub centre: f32,
    /// Side at the place of a visibility sample, in pixels of the region. With [`TextureFilter::Boxes`], the value is
    /// the side divided by the root of the sample's share of a cell.
    pub place: f32,
    /// Side at a sample that tests alpha, in pixels of the region.
    pub sample: f32,
}

impl Footprints {
    /// Footprints for cells of `samples` samples.
    pub fn new(filter: TextureFilter, samples: u32) -> Self {
        // The distance between samples, in pixels.
        let sample = 1.0 / (samples as f32).sqrt();
        match filter {
            TextureFilter::Squares(side) => Self { centre: side, place: side, sample: side },
            TextureFilter::Samples => {
                Self { centre: 0.5, place: sample, sample: if samples > 1 { sample } else { ALPHA_SIDE } }
            }
            TextureFilter::Boxes => Self { centre: 1.0, place: 1.0, sample: ALPHA_SIDE * sample },
        }
    }
}
