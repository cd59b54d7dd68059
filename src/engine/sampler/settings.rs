//! What to render and how.

use super::RenderError;
use crate::sampling::Pattern;
use crate::vulkan::Limits;
use ash::vk;

/// How edges are antialiased.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// One sample a pixel.
    None,
    /// Many samples in the pixels that alias, one in the others.
    Superpixel,
    /// Every pixel rendered at k x k times the resolution and box-filtered: brute force.
    Ssaa,
    /// The device's own multisampling.
    Msaa,
}

/// What makes a pixel a superpixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detection {
    /// A contrasting colour beside it, of another triangle or of the same one; also that which a superpixel beside it
    /// was found to show.
    Contrast,
    /// Another triangle in a contrasting colour beside it: the rule of the sources.
    Edges,
    /// Another triangle beside it.
    Exact,
    /// Every pixel is one; to measure with.
    Every,
}

/// How the coverage of a triangle in a superpixel is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coverage {
    /// Exactly where the triangle is seen whole, and by samples elsewhere. Superpixels that 64 samples settle take no
    /// more; where most triangles may be shaded in several parts of a pixel, which takes all samples, areas are measured
    /// up to 64 samples only.
    Area,
    /// By counting samples.
    Samples,
}

/// How often the inside of a superpixel is shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shading {
    /// Once a visible triangle and block of 64 samples, at the centroid of what is seen of it.
    Triangle,
    /// Once a visible triangle, but where the colours around it vary in up to 32 parts of the pixel, at 256 samples in up
    /// to 128, at 1,024 in up to 256.
    Part,
    /// Once a sub-sample.
    Sample,
}

/// The part of the image that texture levels, those of MASK alpha included, are chosen for. [`Method::None`] and
/// [`Method::Msaa`] choose them for the output pixel with either of the first two.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// [`RenderError::Region`] if it has no pixels or leaves an image of that size.
    pub fn end(&self, image: [u32; 2]) -> Result<[u32; 2], RenderError> {
        let outside = RenderError::Region {
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
pub struct Settings {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The part of the image that is rendered, as if all of it were: to the same numbers, unless `max_memory` has the image
    /// drawn in other parts, whose vertices the device may round otherwise. `None` is all of it.
    pub region: Option<PixelRect>,
    /// How edges are antialiased.
    pub method: Method,
    /// Samples a pixel: 1 to 1,024; squares for supersampling, what the device has for multisampling.
    pub samples: u32,
    /// Where sub-samples lie in a superpixel.
    pub pattern: Pattern,
    /// How they become coverage.
    pub coverage: Coverage,
    /// How often they are shaded.
    pub shading: Shading,
    /// What makes a superpixel.
    pub detection: Detection,
    /// Differences above this, in 8-bit sRGB code values of any channel, are a contrast; `None` is
    /// [that of the samples](Self::default_contrast).
    pub contrast: Option<u8>,
    /// Whether triangles, and shadows, too thin for a pixel's centre to see make superpixels too.
    pub thin: bool,
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

    /// The contrast threshold of so many samples unless another is given, in code values: the more samples, the more of the error
    /// is left in pixels that are no superpixels.
    #[must_use]
    pub fn default_contrast(samples: u32) -> u8 {
        if samples < 128 { 6 } else { 1 }
    }

    /// Superpixel antialiasing with the defaults, at a size.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            size: [width, height],
            region: None,
            method: Method::Superpixel,
            samples: Self::DEFAULT_SAMPLES,
            pattern: Pattern::Sobol,
            coverage: Coverage::Area,
            shading: Shading::Part,
            detection: Detection::Contrast,
            contrast: None,
            thin: true,
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

    /// Differences above this, in code values, are a contrast.
    #[must_use]
    pub fn threshold(&self) -> u8 {
        self.contrast
            .unwrap_or_else(|| Self::default_contrast(self.samples))
    }

    /// Width and height in pixels of what is rendered: the region, or the whole image.
    #[must_use]
    pub fn output_size(&self) -> [u32; 2] {
        self.region.map_or(self.size, |region| region.size)
    }

    /// These, with superpixels that are shaded at every sample where it is asked which lights reach them.
    pub(crate) fn with_shadowed_samples(&self) -> Self {
        let settings = self.clone();
        match self.shadows {
            Shadows::None => settings,
            Shadows::Exact => Self {
                shading: Shading::Sample,
                coverage: Coverage::Samples,
                ..settings
            },
        }
    }

    /// Whether superpixels are shaded as brute force is: each sample with the texture levels of the samples' distance.
    pub(crate) fn shades_samples(&self) -> bool {
        self.method == Method::Superpixel
            && self.footprint == Footprint::Sample
            && self.shading == Shading::Sample
    }

    /// Whether textures are filtered by boxes: over what each shading place stands for, along both of its axes.
    pub(crate) fn filters_boxes(&self) -> bool {
        self.method == Method::Superpixel
            && self.footprint == Footprint::Sample
            && self.shading != Shading::Sample
    }

    /// How often pixels beside superpixels are looked at again, by what these were found to show.
    pub(crate) fn growths(&self) -> u32 {
        match self.detection {
            Detection::Contrast if self.method == Method::Superpixel => {
                if self.samples < 128 {
                    1
                } else {
                    2
                }
            }
            _ => 0,
        }
    }

    /// Side of a pixel's grid under supersampling, otherwise 1.
    #[must_use]
    pub(crate) fn side(&self) -> u32 {
        if self.method == Method::Ssaa {
            self.samples.isqrt()
        } else {
            1
        }
    }

    /// Offsets of the sub-samples, relative to the pixel's centre.
    pub(crate) fn offsets(&self) -> Result<Vec<[f32; 2]>, RenderError> {
        match self.method {
            Method::None | Method::Ssaa => Ok(vec![[0.0, 0.0]]),
            Method::Superpixel => Ok(self.pattern.offsets(self.samples)?),
            Method::Msaa => Ok(Pattern::Rotated.offsets(self.samples)?),
        }
    }

    /// Checks what does not depend on the scene.
    pub(crate) fn check(&self, limits: &Limits) -> Result<(), RenderError> {
        const LARGEST_SIDE: u32 = 65_535;
        if let Footprint::Side(side) = self.footprint
            && !(side > 0.0 && side <= 1.0)
        {
            return Err(RenderError::Footprint(side));
        }
        if let Some(light) = self.background
            && !light.iter().all(|light| light.is_finite())
        {
            return Err(RenderError::Background(light));
        }
        for size in [self.line_width, self.point_size, self.edge_width] {
            if !(size > 0.0 && size <= Self::LARGEST_STROKE) {
                return Err(RenderError::Stroke(size));
            }
        }
        let [width, height] = self.size;
        if !(1..=LARGEST_SIDE).contains(&width) || !(1..=LARGEST_SIDE).contains(&height) {
            return Err(RenderError::Size {
                width,
                height,
                limit: LARGEST_SIDE,
            });
        }
        if let Some(region) = self.region {
            region.end(self.size)?;
        }
        let refuse = |method, possible| {
            Err(RenderError::Samples {
                method,
                asked: self.samples,
                possible,
            })
        };
        match self.method {
            Method::None => Ok(()),
            Method::Superpixel if !(1..=1024).contains(&self.samples) => {
                refuse("superpixel", "1 to 1024".to_owned())
            }
            Method::Superpixel => self.offsets().map(|_| ()),
            Method::Ssaa => {
                let side = self.samples.isqrt();
                if side == 0 || side > 32 || side * side != self.samples {
                    return refuse(
                        "ssaa",
                        "the squares of 1 to 32: 1, 4, 9, 16, ..., 1024".to_owned(),
                    );
                }
                Ok(())
            }
            Method::Msaa if self.attributes => Err(RenderError::Attributes),
            Method::Msaa => {
                let possible: Vec<u32> = [2, 4, 8, 16]
                    .into_iter()
                    .filter(|n| {
                        limits
                            .sample_counts
                            .contains(vk::SampleCountFlags::from_raw(*n))
                    })
                    .collect();
                if !possible.contains(&self.samples) {
                    let names: Vec<String> = possible.iter().map(ToString::to_string).collect();
                    return refuse("msaa on this device", names.join(", "));
                }
                Ok(())
            }
        }
    }
}
