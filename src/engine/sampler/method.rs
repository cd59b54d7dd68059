//! Methods of antialiasing.

use super::EngineError;
use crate::engine::spirv;
use crate::sampling::Pattern;
use crate::vulkan::Limits;
use ash::vk;
use std::fmt;

/// Method of antialiasing, with its options.
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
    /// The mean of frames of one sample a pixel, whose cameras are moved within the pixel. Only
    /// [`Headless`](crate::render::Headless) makes all of them; a recorded frame is one of them, unmoved.
    Accumulate {
        /// Number of frames, 1 to 1,024.
        samples: u32,
        /// Pattern of the offsets within the pixel.
        pattern: Pattern,
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
    /// [`Method::Accumulate`] at points of a Sobol sequence.
    Accumulate,
    /// [`Method::Accumulate`] at the points of a rotated grid: [`Pattern::Lattice`].
    Rotated,
}

impl MethodKind {
    /// Method with `samples` samples a pixel, and otherwise the default options. [`Method::None`] has one sample, and
    /// ignores `samples`.
    #[must_use]
    pub fn with_samples(self, samples: u32) -> Method {
        match self {
            Self::None => Method::None,
            Self::Superpixel => Method::Superpixel(SuperpixelOptions::new(samples)),
            Self::Ssaa => Method::Ssaa { samples },
            Self::Msaa => Method::Msaa { samples },
            Self::Accumulate => Method::Accumulate { samples, pattern: Pattern::Sobol },
            Self::Rotated => Method::Accumulate { samples, pattern: Pattern::Lattice },
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
            Self::Accumulate => "accumulate",
            Self::Rotated => "rotated",
        })
    }
}

/// Rule by which a pixel becomes a superpixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Detection {
    /// A neighbour with a contrasting colour, on the same or another triangle. With growth, the resolved colour of a
    /// neighbouring superpixel is compared as well. From 128 samples on, three pixels in a line, among the pixel and its
    /// 8 neighbours, are enough if their colours have a second difference above the threshold.
    Contrast,
    /// A neighbour with another triangle and a contrasting colour: the rule with which the method was published.
    Edges,
    /// A neighbour with another triangle.
    Exact,
    /// No condition: every pixel is a superpixel. For measurements.
    Every,
}

/// Rate of shading within a superpixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Shading {
    /// One shading for each visible triangle and block of 64 samples, at the centroid of the samples that see the
    /// triangle.
    Triangle,
    /// One shading for each visible triangle, or several in different parts of the pixel if the colours around the
    /// pixel vary: up to 32 parts, up to 128 at 256 samples, and up to 256 at 1,024 samples.
    Part,
    /// One shading for each sample.
    Sample,
}

/// Options of sampling a cell: a superpixel, or the surroundings of a sample location.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CellOptions {
    /// Number of samples of the cell, 1 to 1,024.
    pub samples: u32,
    /// Pattern of the sample locations in the cell.
    pub pattern: Pattern,
    /// Rate of shading within the cell.
    pub shading: Shading,
}

impl CellOptions {
    /// Default number of samples of a superpixel.
    pub const DEFAULT_SAMPLES: u32 = 64;

    /// Default options with `samples` samples of a cell.
    #[must_use]
    pub fn new(samples: u32) -> Self {
        Self { samples, pattern: Pattern::Lines, shading: Shading::Part }
    }

    /// Checks the number of samples, and that the pattern can have it.
    pub(crate) fn check(&self) -> Result<(), EngineError> {
        if !(1..=1024).contains(&self.samples) {
            return Err(EngineError::Samples {
                method: "superpixel",
                asked: self.samples,
                possible: "1 to 1024".to_owned(),
            });
        }
        self.pattern.offsets(self.samples)?;
        Ok(())
    }
}

setters! {
    CellOptions in SuperpixelOptions.cells {
        samples: u32 = "the number of samples of the cell",
        pattern: Pattern = "the pattern of the sample locations in the cell",
        shading: Shading = "the rate of shading within the cell",
    }
}

/// Options of detecting and sampling superpixels.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SuperpixelOptions {
    /// Options of sampling a superpixel.
    pub cells: CellOptions,
    /// Rule by which a pixel becomes a superpixel.
    pub detection: Detection,
    /// Contrast threshold in 8-bit sRGB code values: two colours contrast if any channel differs by more. `None` is
    /// [the default for the number of samples](Self::default_contrast).
    pub contrast: Option<u8>,
    /// Number of growths, with [`Detection::Contrast`]. In each growth, pixels that contrast with a neighbouring
    /// superpixel become superpixels too. `None` is [the default for the number of samples](Self::default_growths).
    pub growths: Option<u8>,
    /// Whether triangles and shadows that are too thin to cover a pixel's centre make the pixel a superpixel.
    pub thin: bool,
}

impl SuperpixelOptions {
    /// Largest number of growths. Each growth records further rounds.
    pub const MOST_GROWTHS: u8 = 8;

    /// Default options with `samples` samples of a superpixel.
    #[must_use]
    pub fn new(samples: u32) -> Self {
        Self {
            cells: CellOptions::new(samples),
            detection: Detection::Contrast,
            contrast: None,
            growths: None,
            thin: true,
        }
    }

    /// Default contrast threshold for `samples` samples, in code values. With more samples, pixels that are not
    /// superpixels have a larger part in the error, so the threshold is lower.
    #[must_use]
    pub fn default_contrast(samples: u32) -> u8 {
        if samples < spirv::MANY_SAMPLES { 6 } else { 1 }
    }

    /// Default number of growths for `samples` samples.
    #[must_use]
    pub fn default_growths(samples: u32) -> u8 {
        if samples < spirv::MANY_SAMPLES { 1 } else { 4 }
    }

    /// Number of growths; 0 unless [`Self::detection`] is [`Detection::Contrast`].
    #[must_use]
    pub fn growth_count(&self) -> u32 {
        match self.detection {
            Detection::Contrast => {
                let default = || Self::default_growths(self.cells.samples);
                u32::from(self.growths.unwrap_or_else(default))
            }
            _ => 0,
        }
    }

    /// Whether superpixels have so many samples that more pixels become superpixels: by a lower contrast, second
    /// differences of colours, more growths, and thin triangles at an angle to the surface around them.
    pub(crate) fn has_many_samples(&self) -> bool {
        self.cells.samples >= spirv::MANY_SAMPLES
    }

    /// Contrast threshold in code values: two colours contrast if any channel differs by more.
    #[must_use]
    pub fn threshold(&self) -> u8 {
        self.contrast.unwrap_or_else(|| Self::default_contrast(self.cells.samples))
    }

    /// Checks the numbers of samples and growths.
    pub(crate) fn check(&self) -> Result<(), EngineError> {
        match self.growths {
            Some(asked) if asked > Self::MOST_GROWTHS => Err(EngineError::Growths { asked, most: Self::MOST_GROWTHS }),
            _ => self.cells.check(),
        }
    }
}

setters! {
    SuperpixelOptions {
        cells: CellOptions = "the options of sampling a superpixel",
        detection: Detection = "the rule by which a pixel becomes a superpixel",
        contrast: Option<u8> = "the contrast threshold in 8-bit sRGB code values; `None` for the default",
        growths: Option<u8> = "the number of growths; `None` for the default",
        thin: bool = "whether triangles and shadows that are too thin to cover a pixel's centre make the pixel a superpixel",
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
            Self::Accumulate { pattern: Pattern::Lattice, .. } => MethodKind::Rotated,
            Self::Accumulate { .. } => MethodKind::Accumulate,
        }
    }

    /// Side of a pixel's grid under supersampling, otherwise 1.
    pub(crate) fn side(&self) -> u32 {
        match self {
            Self::Ssaa { samples } => samples.isqrt(),
            _ => 1,
        }
    }

    /// Number of samples of a pixel that is sampled more than once; 1 if the method has no such pixels.
    #[must_use]
    pub fn samples(&self) -> u32 {
        match self {
            Self::None => 1,
            Self::Superpixel(options) => options.cells.samples,
            Self::Ssaa { samples } | Self::Msaa { samples } | Self::Accumulate { samples, .. } => *samples,
        }
    }

    /// Number of samples of such a pixel within one frame.
    pub(crate) fn samples_a_frame(&self) -> u32 {
        match self {
            Self::Accumulate { .. } => 1,
            _ => self.samples(),
        }
    }

    /// Offsets of the samples, relative to the pixel's centre.
    pub(crate) fn offsets(&self) -> Result<Vec<[f32; 2]>, EngineError> {
        match self {
            Self::None | Self::Ssaa { .. } | Self::Accumulate { .. } => Ok(vec![[0.0, 0.0]]),
            Self::Superpixel(options) => Ok(options.cells.pattern.offsets(options.cells.samples)?),
            Self::Msaa { samples } => Ok(Pattern::Rotated.offsets(*samples)?),
        }
    }

    /// Checks the number of samples.
    pub(super) fn check(&self, limits: &Limits) -> Result<(), EngineError> {
        let refuse = |method, possible| Err(EngineError::Samples { method, asked: self.samples(), possible });
        match self {
            Self::None => Ok(()),
            Self::Superpixel(options) => options.check(),
            Self::Accumulate { samples, pattern } => {
                if !(1..=1024).contains(samples) {
                    return refuse("accumulate", "1 to 1024".to_owned());
                }
                pattern.offsets(*samples)?;
                Ok(())
            }
            Self::Ssaa { samples } => {
                let side = samples.isqrt();
                if side == 0 || side > 32 || side * side != *samples {
                    return refuse("ssaa", "the squares of 1 to 32: 1, 4, 9, 16, ..., 1024".to_owned());
                }
                Ok(())
            }
            Self::Msaa { samples } => {
                let possible: Vec<u32> = [2, 4, 8, 16]
                    .into_iter()
                    .filter(|n| limits.sample_counts.contains(vk::SampleCountFlags::from_raw(*n)))
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
