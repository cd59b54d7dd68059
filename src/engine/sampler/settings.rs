//! Settings of a sampler, and requests for images.

use super::footprint::TextureFilter;
use super::{CellOptions, EngineError, Method, Shading};
use crate::sampling::PixelFilter;
use crate::vulkan::Limits;

/// Area of the image for which texture levels are chosen, also for the alpha of MASK materials. [`Method::None`] and
/// [`Method::Msaa`] use the output pixel with either of the first two variants.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Footprint {
    /// The part of the pixel that a shading represents: with k x k samples of supersampling or accumulation, 1/k of the
    /// pixel's side;
    /// in superpixels, the triangle's share of the pixel that is shaded there. More samples make textures sharper, and
    /// the image converges to the unfiltered scene.
    Sample,
    /// The output pixel, whatever the number of samples. The image converges to one whose textures are filtered twice,
    /// and methods differ by geometry alone.
    Pixel,
    /// A square with this side in output pixels, above 0 and at most 1, for every shading. References are made with
    /// it.
    Side(f32),
}

/// Meaning of the numbers in the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// Linear light of 0 to 1, tone-mapped by Khronos PBR Neutral, for a display.
    Display,
    /// Scene-linear radiance times exposure, unbounded.
    Scene {
        /// Whether detection compares colours after the tone mapping of [`Self::Display`]: right if the image will be tone-mapped
        /// before it is shown.
        tonemapped_detection: bool,
    },
}

/// Rectangle of an image, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelRect {
    /// Column and row of the upper left pixel, from 0.
    pub corner: [u32; 2],
    /// Width and height in pixels, at least 1.
    pub size: [u32; 2],
}

impl PixelRect {
    /// Column and row beyond the lower right pixel.
    ///
    /// # Errors
    /// [`EngineError::Region`] if it has no pixels or leaves an image of that size.
    pub fn end(&self, image: [u32; 2]) -> Result<[u32; 2], EngineError> {
        let outside = EngineError::Region { region: *self, image };
        let end = |axis: usize| {
            self.corner[axis].checked_add(self.size[axis]).filter(|end| self.size[axis] > 0 && *end <= image[axis])
        };
        match (end(0), end(1)) {
            (Some(right), Some(bottom)) => Ok([right, bottom]),
            _ => Err(outside),
        }
    }
}

/// Settings of a [`Sampler`](super::Sampler): how cells are sampled, and which colours they get.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SamplerSettings {
    /// Options of sampling a cell.
    pub cells: CellOptions,
    /// Areas over which textures are filtered.
    pub filter: TextureFilter,
    /// Linear colour of the background; `None` leaves it transparent.
    pub background: Option<[f32; 3]>,
    /// Exposure in stops: 1 is twice as bright.
    pub exposure: f32,
    /// Meaning of the numbers in the image.
    pub reference: Reference,
    /// Rate at which the client merges visibility samples once it knows which lights reach each of them. `None` if it shades them
    /// as they are.
    pub merged: Option<Shading>,
}

impl SamplerSettings {
    /// Checks the options of cells and the colours.
    pub fn check(&self) -> Result<(), EngineError> {
        if let Some(light) = self.background
            && !light.iter().all(|light| light.is_finite())
        {
            return Err(EngineError::Background(light));
        }
        self.cells.check()
    }
}

/// Image whose memory is planned.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ImageRequest<'a> {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Part of the image to render; `None` for the whole image.
    pub region: Option<PixelRect>,
    /// Method of antialiasing.
    pub method: &'a Method,
    /// Filter by which pixels are averaged.
    pub filter: PixelFilter,
    /// Whether to output attributes of every pixel too.
    pub attributes: bool,
    /// Limit for device memory in bytes; `None` for no limit.
    pub max_memory: Option<u64>,
}

impl ImageRequest<'_> {
    /// Checks the request as far as that is independent of the scene.
    pub fn check(&self, limits: &Limits) -> Result<(), EngineError> {
        check_image_size(self.size)?;
        if let Some(region) = self.region {
            region.end(self.size)?;
        }
        if self.attributes && matches!(self.method, Method::Msaa { .. } | Method::Accumulate { .. }) {
            return Err(EngineError::Attributes);
        }
        self.filter.check()?;
        self.method.check(limits)
    }
}

/// Checks the width and height of an image.
pub(crate) fn check_image_size([width, height]: [u32; 2]) -> Result<(), EngineError> {
    const LARGEST_SIDE: u32 = 65_535;
    if !(1..=LARGEST_SIDE).contains(&width) || !(1..=LARGEST_SIDE).contains(&height) {
        return Err(EngineError::Size { width, height, limit: LARGEST_SIDE });
    }
    Ok(())
}
