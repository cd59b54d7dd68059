//! Arbitrary output variables (AOVs): values of a pixel other than its colour.

use crate::render::PixelAttributes;

/// Kind of an AOV.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AovKind {
    /// Distance from the eye along the direction of view, in the scene's unit.
    Depth,
    /// ID of the triangle at the pixel's centre.
    Id,
    /// World-space normal at the pixel's centre.
    Normal,
    /// Whether the pixel is a superpixel.
    Superpixels,
    /// Number of samples that the pixel's colour is the mean of.
    Samples,
}

/// Values of one kind for every pixel, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub enum Aov {
    /// Distances from the eye along the direction of view, in the scene's unit; infinite for background.
    Depth(Vec<f32>),
    /// Triangle IDs: the index of the triangle in the scene plus 1; 0 for background.
    Id(Vec<u32>),
    /// Unit normals in world space; zero for background.
    Normal(Vec<[f32; 3]>),
    /// Whether each pixel is a superpixel.
    Superpixels(Vec<bool>),
    /// Numbers of samples; 1 outside of superpixels.
    Samples(Vec<u32>),
}

impl Aov {
    /// Extracts one kind of values from [`Rendered::attributes`](crate::render::Rendered::attributes).
    #[must_use]
    pub fn from_attributes(kind: AovKind, attributes: &[PixelAttributes]) -> Self {
        let pixels = attributes.iter();
        match kind {
            AovKind::Depth => {
                Self::Depth(pixels.map(|pixel| if pixel.id == 0 { f32::INFINITY } else { pixel.depth }).collect())
            }
            AovKind::Id => Self::Id(pixels.map(|pixel| pixel.id).collect()),
            AovKind::Normal => Self::Normal(pixels.map(|pixel| pixel.normal).collect()),
            AovKind::Superpixels => Self::Superpixels(pixels.map(|pixel| pixel.superpixel != 0).collect()),
            AovKind::Samples => Self::Samples(pixels.map(|pixel| pixel.samples).collect()),
        }
    }

    /// Kind of these values.
    #[must_use]
    pub fn kind(&self) -> AovKind {
        match self {
            Self::Depth(_) => AovKind::Depth,
            Self::Id(_) => AovKind::Id,
            Self::Normal(_) => AovKind::Normal,
            Self::Superpixels(_) => AovKind::Superpixels,
            Self::Samples(_) => AovKind::Samples,
        }
    }

    /// Number of pixels.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Depth(values) => values.len(),
            Self::Id(values) | Self::Samples(values) => values.len(),
            Self::Normal(values) => values.len(),
            Self::Superpixels(values) => values.len(),
        }
    }
}
