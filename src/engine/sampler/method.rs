//! How edges are antialiased.

use super::EngineError;
use crate::sampling::Pattern;
use crate::vulkan::Limits;
use ash::vk;
use std::fmt;

/// How edges are antialiased, and with how many samples.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Method {
    /// One sample a pixel.
    None,
    /// Many samples in the pixels that alias, one in the others.
    Superpixel(SuperpixelOptions),
    /// Every pixel rendered at k x k times the resolution and box-filtered: brute force.
    Ssaa {
        /// Samples a pixel: the square of a number from 1 to 32.
        samples: u32,
    },
    /// The device's own multisampling.
    Msaa {
        /// Samples a pixel: 2, 4, 8 or 16, as far as the device has them.
        samples: u32,
    },
}

/// A [`Method`] without its options.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MethodKind {
    /// [`Method::None`].
    None,
    /// [`Method::Superpixel`].
    Superpixel,
    /// [`Method::Ssaa`].
    Ssaa,
    /// [`Method::Msaa`].
    Msaa,
}

impl MethodKind {
    /// The method with so many samples a pixel, and otherwise the default options. [`Method::None`] has one sample, whatever is
    /// given.
    #[must_use]
    pub fn with_samples(self, samples: u32) -> Method {
        match self {
            Self::None => Method::None,
            Self::Superpixel => Method::Superpixel(SuperpixelOptions::new(samples)),
            Self::Ssaa => Method::Ssaa { samples },
            Self::Msaa => Method::Msaa { samples },
        }
    }
}

impl fmt::Display for MethodKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::None => "none",
            Self::Superpixel => "superpixel",
            Self::Ssaa => "ssaa",
            Self::Msaa => "msaa",
        })
    }
}

/// What makes a pixel a superpixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
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

/// How superpixels are found and sampled.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SuperpixelOptions {
    /// Samples of a superpixel: 1 to 1,024.
    pub samples: u32,
    /// Where samples lie in a superpixel.
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
    /// How often pixels become superpixels because they contrast with a superpixel beside them, where colours are compared; `None` is
    /// [that of the samples](Self::default_growths).
    pub growths: Option<u8>,
    /// Whether triangles, and shadows, too thin for a pixel's centre to see make superpixels too.
    pub thin: bool,
}

impl SuperpixelOptions {
    /// Most growths: each records as many rounds as the superpixels that are detected.
    pub const MOST_GROWTHS: u8 = 8;

    /// The defaults with so many samples of a superpixel.
    #[must_use]
    pub fn new(samples: u32) -> Self {
        Self {
            samples,
            pattern: Pattern::Lines,
            coverage: Coverage::Area,
            shading: Shading::Part,
            detection: Detection::Contrast,
            contrast: None,
            growths: None,
            thin: true,
        }
    }

    /// The contrast threshold of so many samples unless another is given, in code values: the more samples, the more of the error
    /// is left in pixels that are no superpixels.
    #[must_use]
    pub fn default_contrast(samples: u32) -> u8 {
        if samples < 128 { 6 } else { 1 }
    }

    /// How often superpixels of so many samples grow unless another number is given.
    #[must_use]
    pub fn default_growths(samples: u32) -> u8 {
        if samples < 128 { 1 } else { 2 }
    }

    /// How often superpixels grow.
    #[must_use]
    pub fn growth_count(&self) -> u32 {
        match self.detection {
            Detection::Contrast => {
                let default = || Self::default_growths(self.samples);
                u32::from(self.growths.unwrap_or_else(default))
            }
            _ => 0,
        }
    }

    /// Differences above this, in code values, are a contrast.
    #[must_use]
    pub fn threshold(&self) -> u8 {
        self.contrast
            .unwrap_or_else(|| Self::default_contrast(self.samples))
    }
}

setters! {
    SuperpixelOptions {
        samples: u32,
        pattern: Pattern,
        coverage: Coverage,
        shading: Shading,
        detection: Detection,
        contrast: Option<u8>,
        growths: Option<u8>,
        thin: bool,
    }
}

impl From<SuperpixelOptions> for Method {
    fn from(options: SuperpixelOptions) -> Self {
        Self::Superpixel(options)
    }
}

impl Method {
    /// The method without its options.
    #[must_use]
    pub fn kind(&self) -> MethodKind {
        match self {
            Self::None => MethodKind::None,
            Self::Superpixel(_) => MethodKind::Superpixel,
            Self::Ssaa { .. } => MethodKind::Ssaa,
            Self::Msaa { .. } => MethodKind::Msaa,
        }
    }

    /// Samples of a pixel that is sampled more than once; 1 where none is.
    #[must_use]
    pub fn samples(&self) -> u32 {
        match self {
            Self::None => 1,
            Self::Superpixel(options) => options.samples,
            Self::Ssaa { samples } | Self::Msaa { samples } => *samples,
        }
    }

    /// Offsets of the samples, relative to the pixel's centre.
    pub(crate) fn offsets(&self) -> Result<Vec<[f32; 2]>, EngineError> {
        match self {
            Self::None | Self::Ssaa { .. } => Ok(vec![[0.0, 0.0]]),
            Self::Superpixel(options) => Ok(options.pattern.offsets(options.samples)?),
            Self::Msaa { samples } => Ok(Pattern::Rotated.offsets(*samples)?),
        }
    }

    /// Checks the number of samples.
    pub(super) fn check(&self, limits: &Limits) -> Result<(), EngineError> {
        let refuse = |method, possible| {
            Err(EngineError::Samples {
                method,
                asked: self.samples(),
                possible,
            })
        };
        match self {
            Self::None => Ok(()),
            Self::Superpixel(SuperpixelOptions { samples, .. })
                if !(1..=1024).contains(samples) =>
            {
                refuse("superpixel", "1 to 1024".to_owned())
            }
            Self::Superpixel(SuperpixelOptions {
                growths: Some(asked),
                ..
            }) if *asked > SuperpixelOptions::MOST_GROWTHS => Err(EngineError::Growths {
                asked: *asked,
                most: SuperpixelOptions::MOST_GROWTHS,
            }),
            Self::Superpixel(_) => self.offsets().map(|_| ()),
            Self::Ssaa { samples } => {
                let side = samples.isqrt();
                if side == 0 || side > 32 || side * side != *samples {
                    return refuse(
                        "ssaa",
                        "the squares of 1 to 32: 1, 4, 9, 16, ..., 1024".to_owned(),
                    );
                }
                Ok(())
            }
            Self::Msaa { samples } => {
                let possible: Vec<u32> = [2, 4, 8, 16]
                    .into_iter()
                    .filter(|n| {
                        limits
                            .sample_counts
                            .contains(vk::SampleCountFlags::from_raw(*n))
                    })
                    .collect();
                if !possible.contains(samples) {
                    let names: Vec<String> = possible.iter().map(ToString::to_string).collect();
                    return refuse("msaa on this device", names.join(", "));
                }
                Ok(())
            }
        }
    }
}
