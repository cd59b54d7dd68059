//! What to render and how.

use super::{Coverage, Detection, EngineError, Method, Shading, SuperpixelOptions};
use crate::vulkan::Limits;

/// The part of the image that texture levels, those of MASK alpha included, are chosen for. [`Method::None`] and
/// [`Method::Msaa`] choose them for the output pixel with either of the first two.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Footprint {
    /// What each shading place stands for: the k-th part of the pixel's side under supersampling by k x k samples; in
    /// superpixels the triangle's share of the pixel that is shaded there. The more samples, the sharper the textures,
    /// and the image converges to the scene as it is.
    Sample,
    /// The output pixel, whatever the number of samples: the image converges to one of textures that are filtered twice.
    /// Methods then differ by geometry alone.
    Pixel,
    /// A square of this side, in output pixels, above 0 and at most 1, wherever it is shaded. References are made so.
    Side(f32),
}

/// Whether surfaces keep the light from others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Shadows {
    /// Lights shine through everything.
    None,
    /// Every point that is shaded asks every light whether another triangle lies before it: a sampling set on the light's
    /// own image plane, without the aliasing of a map of depths. Superpixels then are shaded at every sample, whatever
    /// [`Settings::shading`] says. The scene has to be prepared for it: see `SceneRequest::shadows`.
    Exact,
}

/// What the numbers in the image refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// Tone-mapped (Khronos PBR Neutral) linear light in 0 to 1, for a display.
    Display,
    /// Linear radiance times exposure, unbounded.
    Scene,
}

/// A part of an image, in its pixels.
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

/// All that decides an image beside scene and camera.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Settings {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The part of the image that is rendered, as if all of it were: to the same numbers, unless `max_memory` has the image
    /// drawn in other parts, whose vertices the device may round otherwise. `None` is all of it.
    pub region: Option<PixelRect>,
    /// How edges are antialiased.
    pub method: Method,
    /// Linear light behind the scene; `None` leaves it transparent.
    pub background: Option<[f32; 3]>,
    /// Exposure in stops.
    pub exposure: f32,
    /// What the numbers in the image refer to.
    pub reference: Reference,
    /// Whether detection compares tone-mapped colours although the image holds scene-referred ones.
    pub tonemapped_detection: bool,
    /// Whether depth, ID, normal and sampling of every pixel are wanted too.
    pub attributes: bool,
    /// What texture levels are chosen for.
    pub footprint: Footprint,
    /// Whether surfaces keep the light from others.
    pub shadows: Shadows,
    /// Width of lines in output pixels, above 0 and at most [`Self::LARGEST_STROKE`]. Where locations are sampled, these are the
    /// pixels of their pinhole's plane.
    pub line_width: f32,
    /// Diameter of points in output pixels, with the same bounds.
    pub point_size: f32,
    /// Width of [edges](crate::scene::Scene::add_edges) of meshes in output pixels, with the same bounds.
    pub edge_width: f32,
    /// Bound on device memory in bytes, uploads and read-back included.
    pub max_memory: Option<u64>,
}

impl Settings {
    /// Default number of sub-samples.
    pub const DEFAULT_SAMPLES: u32 = 64;

    /// Largest width of lines and size of points.
    pub const LARGEST_STROKE: f32 = 1024.0;

    /// Superpixel antialiasing with the defaults, at a size.
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
        }
    }

    /// The same with another method.
    #[must_use]
    pub fn method(self, method: impl Into<Method>) -> Self {
        Self {
            method: method.into(),
            ..self
        }
    }

    /// The same with other options of superpixels, where the method has them.
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

    /// Width and height in pixels of what is rendered: the region, or the whole image.
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

    /// These, with superpixels that are shaded at every sample where it is asked which lights reach them.
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

    /// Whether superpixels are shaded as brute force is: each sample with the texture levels of the samples' distance.
    pub(crate) fn shades_samples(&self) -> bool {
        let of_samples = self.footprint == Footprint::Sample;
        matches!(&self.method, Method::Superpixel(options) if of_samples && options.shading == Shading::Sample)
    }

    /// Whether textures are filtered by boxes: over what each shading place stands for, along both of its axes.
    pub(crate) fn filters_boxes(&self) -> bool {
        let of_samples = self.footprint == Footprint::Sample;
        matches!(&self.method, Method::Superpixel(options) if of_samples && options.shading != Shading::Sample)
    }

    /// How often pixels beside superpixels are looked at again, by what these were found to show.
    pub(crate) fn growths(&self) -> u32 {
        match &self.method {
            Method::Superpixel(options) if options.detection == Detection::Contrast => {
                if options.samples < 128 { 1 } else { 2 }
            }
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

    /// Checks what does not depend on the scene.
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
        size: [u32; 2],
        region: Option<PixelRect>,
        background: Option<[f32; 3]>,
        exposure: f32,
        reference: Reference,
        tonemapped_detection: bool,
        attributes: bool,
        footprint: Footprint,
        shadows: Shadows,
        line_width: f32,
        point_size: f32,
        edge_width: f32,
        max_memory: Option<u64>,
    }
}
