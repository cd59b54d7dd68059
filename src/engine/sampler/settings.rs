//! Settings of a rendering: method, samples, colours and limits.

use super::{Coverage, EngineError, Method, Shading, SuperpixelOptions};
use crate::vulkan::Limits;

/// Area of the image for which texture levels are chosen, also for the alpha of MASK materials. [`Method::None`] and
/// [`Method::Msaa`] use the output pixel with either of the first two variants.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Footprint {
    /// The part of the pixel that a shading represents: with supersampling by k x k samples, 1/k of the pixel's side;
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

/// Shadows of the scene's lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Shadows {
    /// No shadows: lights shine through everything.
    None,
    /// Exact shadows: every shaded point tests for every light whether another triangle occludes it, by sampling on
    /// the light's image plane, without the aliasing of a shadow map. Superpixels are then shaded at every sample,
    /// whatever [`SuperpixelOptions::shading`] says. The scene has to be prepared for shadows: see `SceneRequest::shadows`.
    Exact,
}

/// Meaning of the numbers in the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// Linear light of 0 to 1, tone-mapped by Khronos PBR Neutral, for a display.
    Display,
    /// Scene-linear radiance times exposure, unbounded.
    Scene,
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
        let outside = EngineError::Region {
            region: *self,
            image,
        };
        let end = |axis: usize| {
            self.corner[axis]
                .checked_add(self.size[axis])
                .filter(|end| self.size[axis] > 0 && *end <= image[axis])
        };
        match (end(0), end(1)) {
            (Some(right), Some(bottom)) => Ok([right, bottom]),
            _ => Err(outside),
        }
    }
}

/// Settings of a rendering: everything that determines an image besides scene and camera, and how it is timed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Settings {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Part of the image to render; `None` for the whole image. Its pixels equal those of the whole image, unless
    /// `max_memory` divides the image differently, so that the device may round vertices differently.
    pub region: Option<PixelRect>,
    /// Method of antialiasing.
    pub method: Method,
    /// Linear colour of the background; `None` leaves it transparent.
    pub background: Option<[f32; 3]>,
    /// Exposure in stops: 1 is twice as bright.
    pub exposure: f32,
    /// Meaning of the numbers in the image.
    pub reference: Reference,
    /// Whether detection compares tone-mapped colours even if the image is scene-referred.
    pub tonemapped_detection: bool,
    /// Whether to output depth, ID, normal and number of samples of every pixel too.
    pub attributes: bool,
    /// Area for which texture levels are chosen.
    pub footprint: Footprint,
    /// Shadows of the scene's lights.
    pub shadows: Shadows,
    /// Width of lines in output pixels, above 0 and at most [`Self::LARGEST_STROKE`]. For sampling locations, these
    /// are pixels of the pinhole's plane.
    pub line_width: f32,
    /// Diameter of points in output pixels, with the same limits.
    pub point_size: f32,
    /// Width of [edges](crate::scene::Scene::add_edges) of meshes in output pixels, with the same limits.
    pub edge_width: f32,
    /// Limit for device memory in bytes, including uploads and read-back; `None` for no limit.
    pub max_memory: Option<u64>,
    /// Whether the passes of all rounds are timed one by one, instead of those of the first round alone and the other rounds as a
    /// whole. It does not change the image. On CPU devices, timestamps take time: a round that has nothing to do takes ten times as
    /// long with them.
    pub time_rounds: bool,
}

impl Settings {
    /// Default number of samples of a superpixel.
    pub const DEFAULT_SAMPLES: u32 = 64;

    /// Largest width of lines and size of points, in output pixels.
    pub const LARGEST_STROKE: f32 = 1024.0;

    /// Superpixel antialiasing with the default settings, for an image of `width` x `height` pixels.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            size: [width, height],
            region: None,
            method: SuperpixelOptions::new(Self::DEFAULT_SAMPLES).into(),
            background: None,
            exposure: 0.0,
            reference: Reference::Display,
            tonemapped_detection: true,
            attributes: false,
            footprint: Footprint::Sample,
            shadows: Shadows::None,
            line_width: 1.0,
            point_size: 3.0,
            edge_width: 1.0,
            max_memory: None,
            time_rounds: false,
        }
    }

    /// Sets the method of antialiasing.
    #[must_use]
    pub fn method(self, method: impl Into<Method>) -> Self {
        Self {
            method: method.into(),
            ..self
        }
    }

    /// Changes the options of superpixels, if the method has them.
    #[must_use]
    pub fn map_superpixels(
        self,
        change: impl FnOnce(SuperpixelOptions) -> SuperpixelOptions,
    ) -> Self {
        match self.method {
            Method::Superpixel(options) => Self {
                method: change(options).into(),
                ..self
            },
            _ => self,
        }
    }

    /// Width and height in pixels of the rendered image: the region, or the whole image.
    #[must_use]
    pub fn output_size(&self) -> [u32; 2] {
        self.region.map_or(self.size, |region| region.size)
    }

    /// How superpixels are found and sampled; of another method, what cells have whose samples are no superpixels.
    pub(crate) fn superpixels(&self) -> SuperpixelOptions {
        match (&self.method, self.shadows) {
            (Method::Superpixel(options), _) => options.clone(),
            (method, Shadows::None) => SuperpixelOptions::new(method.samples()),
            (method, Shadows::Exact) => shadowed(SuperpixelOptions::new(method.samples())),
        }
    }

    /// These settings, with superpixels shaded at every sample if shadows are on.
    pub(crate) fn with_shadowed_samples(&self) -> Self {
        let settings = self.clone();
        match (&self.method, self.shadows) {
            (Method::Superpixel(options), Shadows::Exact) => Self {
                method: shadowed(options.clone()).into(),
                ..settings
            },
            _ => settings,
        }
    }

    /// Whether superpixels are shaded like supersampling: each sample with texture levels for the distance between
    /// samples.
    pub(crate) fn shades_samples(&self) -> bool {
        let of_samples = self.footprint == Footprint::Sample;
        matches!(&self.method, Method::Superpixel(options) if of_samples && options.shading == Shading::Sample)
    }

    /// Whether textures are filtered by boxes over the area that each shading represents, along both of its axes.
    pub(crate) fn filters_boxes(&self) -> bool {
        let of_samples = self.footprint == Footprint::Sample;
        matches!(&self.method, Method::Superpixel(options) if of_samples && options.shading != Shading::Sample)
    }

    /// Number of times that pixels beside superpixels are examined again, by the colours that sampling these revealed.
    pub(crate) fn growths(&self) -> u32 {
        match &self.method {
            Method::Superpixel(options) => options.growth_count(),
            _ => 0,
        }
    }

    /// Side of a pixel's grid under supersampling, otherwise 1.
    #[must_use]
    pub(crate) fn side(&self) -> u32 {
        match self.method {
            Method::Ssaa { samples } => samples.isqrt(),
            _ => 1,
        }
    }

    /// Checks the settings as far as that is independent of the scene.
    pub(crate) fn check(&self, limits: &Limits) -> Result<(), EngineError> {
        const LARGEST_SIDE: u32 = 65_535;
        if let Footprint::Side(side) = self.footprint
            && !(side > 0.0 && side <= 1.0)
        {
            return Err(EngineError::Footprint(side));
        }
        if let Some(light) = self.background
            && !light.iter().all(|light| light.is_finite())
        {
            return Err(EngineError::Background(light));
        }
        for size in [self.line_width, self.point_size, self.edge_width] {
            if !(size > 0.0 && size <= Self::LARGEST_STROKE) {
                return Err(EngineError::Stroke(size));
            }
        }
        let [width, height] = self.size;
        if !(1..=LARGEST_SIDE).contains(&width) || !(1..=LARGEST_SIDE).contains(&height) {
            return Err(EngineError::Size {
                width,
                height,
                limit: LARGEST_SIDE,
            });
        }
        if let Some(region) = self.region {
            region.end(self.size)?;
        }
        if self.attributes && matches!(self.method, Method::Msaa { .. }) {
            return Err(EngineError::Attributes);
        }
        self.method.check(limits)
    }
}

/// These options with each sample shaded by itself.
fn shadowed(options: SuperpixelOptions) -> SuperpixelOptions {
    SuperpixelOptions {
        shading: Shading::Sample,
        coverage: Coverage::Samples,
        ..options
    }
}

setters! {
    Settings {
        size: [u32; 2] = "the width and height in pixels",
        region: Option<PixelRect> = "the part of the image to render; `None` for the whole image",
        background: Option<[f32; 3]> = "the linear colour of the background; `None` for transparent",
        exposure: f32 = "the exposure in stops: 1 is twice as bright",
        reference: Reference = "the meaning of the numbers in the image",
        tonemapped_detection: bool = "whether detection compares tone-mapped colours even if the image is scene-referred",
        attributes: bool = "whether depth, ID, normal and number of samples of every pixel are output too",
        footprint: Footprint = "the area for which texture levels are chosen",
        shadows: Shadows = "the shadows of the scene's lights",
        line_width: f32 = "the width of lines in output pixels",
        point_size: f32 = "the diameter of points in output pixels",
        edge_width: f32 = "the width of edges of meshes in output pixels",
        max_memory: Option<u64> = "the limit for device memory in bytes; `None` for no limit",
        time_rounds: bool = "whether the passes of all rounds are timed one by one",
    }
}
