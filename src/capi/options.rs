//! How frames are antialiased.

use super::error::{Error, GpcResult};
use super::input::{Element, GpcStructType, Struct, choice, flag, init, sizes};
use crate::engine::sampler::{Detection, Shading};
use crate::host::Options;
use crate::sampling::Pattern;
use ash::vk;
use std::ffi::c_void;

/// Where in a superpixel the samples lie.
#[derive(Clone, Copy)]
#[repr(u32)]
pub enum GpcPattern {
    /// The first points of a scrambled Sobol sequence: any count.
    Sobol = 0,
    /// A turned lattice; of counts that are no square, as GPC_PATTERN_KOROBOV.
    Lattice = 1,
    /// The best lattice of rank 1: any count.
    Korobov = 2,
    /// The centres of a square grid: square counts only.
    Grid = 3,
    /// The standard locations of Vulkan: 1, 2, 4, 8 or 16 samples.
    Rotated = 4,
    /// GpcOptions.locations.
    List = 5,
    /// 512 or 1,024 samples on straight lines; the count decides in how many places a superpixel is shaded. Below 16 samples, and
    /// where each sample is shaded, as GPC_PATTERN_SOBOL. Any count.
    Lines = 6,
}

/// How often the inside of a superpixel is shaded.
#[derive(Clone, Copy)]
#[repr(u32)]
pub enum GpcShading {
    /// Once a visible triangle.
    Triangle = 0,
    /// Once a visible triangle, but in several parts of the pixel where the colours around it vary.
    Part = 1,
    /// Once a sample.
    Sample = 2,
}

/// What makes a pixel a superpixel.
#[derive(Clone, Copy)]
#[repr(u32)]
pub enum GpcDetection {
    /// A contrasting colour beside it.
    Contrast = 0,
    /// Another triangle in a contrasting colour beside it.
    Edges = 1,
    /// Another triangle beside it.
    Exact = 2,
    /// Nothing: every pixel is one. To measure with.
    Every = 3,
}

/// The value of GpcOptions.contrast for the threshold that suits the samples: 6, and 1 from 128 samples on.
pub const GPC_CONTRAST_OF_SAMPLES: u32 = u32::MAX;

/// The value of GpcOptions.growths for the number that suits the samples: 1, and 2 from 128 samples on.
pub const GPC_GROWTHS_OF_SAMPLES: u32 = u32::MAX;

/// What GpcOptions.growths can be.
pub(super) const GROWTHS: &str = "0 to 8, or GPC_GROWTHS_OF_SAMPLES";

/// How a frame is antialiased; gpc_init_options gives defaults.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcOptions {
    /// sizeof(GpcOptions).
    pub size: u32,
    /// GPC_STRUCT_TYPE_OPTIONS.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Width in pixels of the images lent.
    pub width: u32,
    /// Their height.
    pub height: u32,
    /// Samples of a superpixel, 1 to 1,024.
    pub samples: u32,
    /// Where they lie: a GpcPattern.
    pub pattern: u32,
    /// How often a superpixel is shaded: a GpcShading.
    pub shading: u32,
    /// What makes a superpixel: a GpcDetection.
    pub detection: u32,
    /// Differences above this, in 8-bit sRGB code values of any channel, are a contrast: 0 to 255, or GPC_CONTRAST_OF_SAMPLES.
    pub contrast: u32,
    /// VK_TRUE if triangles too thin for a pixel's centre to see make superpixels too; where IDs are lent, this needs depth,
    /// too.
    pub thin: vk::Bool32,
    /// VK_TRUE if the image holds radiance that is tone-mapped later, so that detection compares tone-mapped colours.
    pub high_dynamic_range: vk::Bool32,
    /// VK_TRUE if textures are filtered over what each sample stands for, VK_FALSE if over the whole pixel.
    pub sharp: vk::Bool32,
    /// VK_TRUE if the application's shading makes the colours of all pixels, so that the colour image may hold anything before;
    /// VK_FALSE if of superpixels alone, which are drawn over what it holds.
    pub shade_all: vk::Bool32,
    /// VK_TRUE if `background` shows where neither a triangle nor, unless `flat_background` says otherwise, something that the
    /// application has drawn is; VK_FALSE if that is transparent.
    pub has_background: vk::Bool32,
    /// Linear light.
    pub background: [f32; 3],
    /// VK_TRUE if `background`, or nothing, shows wherever no triangle is. With VK_FALSE, where the application lends its colours,
    /// a sample of a superpixel that sees no triangle shows what the application has drawn, with its alpha: the colour of the pixel
    /// if its centre saw no triangle, else of the nearest one of the 8 pixels around it, then of the 24, whose centre saw none, else
    /// the background. It has to be VK_TRUE with GpcGeometry.blended, and does not matter with `shade_all`.
    pub flat_background: vk::Bool32,
    /// Bound on the time that a recording takes: the most rounds of superpixels that are detected, and of each growth of these. What
    /// rounds leave keeps the colours that were drawn, and is counted as left over. 0 for as many as an image may need or, on GPUs
    /// with plenty of memory, usually needs; those that it does not need take next to no time on devices with
    /// GpcDevice.conditional_rendering, and little on others.
    pub max_rounds: u32,
    /// How many pairs `locations` has: `samples`, with GPC_PATTERN_LIST.
    pub location_count: u32,
    /// With GPC_PATTERN_LIST, offsets of the samples from the pixel's centre in pixels, x to the right and y down, each from
    /// -0.5 up to 0.5, read during the call alone. Otherwise ignored.
    pub locations: *const [f32; 2],
    /// Bound on the device memory of a frame in bytes, 0 for none.
    pub max_memory: u64,
    /// How often pixels become superpixels because they contrast with a superpixel beside them, with GPC_DETECTION_CONTRAST: 0 to 8, or
    /// GPC_GROWTHS_OF_SAMPLES.
    pub growths: u32,
    /// 0.
    pub reserved: u32,
}

// SAFETY: `repr(C)`; integers, raw handles and pointers may have any bytes.
unsafe impl Element for GpcOptions {
    const NAME: &'static str = "GpcOptions";
    const SIZES: &'static [usize] = sizes!(GpcOptions, max_memory, reserved);

    fn defaults() -> Self {
        let defaults = Options::new(0, 0);
        Self {
            samples: defaults.samples,
            pattern: GpcPattern::Lines as u32,
            shading: GpcShading::Part as u32,
            detection: GpcDetection::Contrast as u32,
            contrast: defaults.contrast.map_or(GPC_CONTRAST_OF_SAMPLES, u32::from),
            growths: defaults.growths.map_or(GPC_GROWTHS_OF_SAMPLES, u32::from),
            thin: u32::from(defaults.thin),
            high_dynamic_range: u32::from(defaults.high_dynamic_range),
            sharp: u32::from(defaults.sharp),
            shade_all: u32::from(defaults.shade_all),
            // SAFETY: any bytes are a value of it.
            ..unsafe { std::mem::zeroed() }
        }
    }
}

// SAFETY: it begins with size, type and next.
unsafe impl Struct for GpcOptions {
    const TYPE: GpcStructType = GpcStructType::Options;
}

/// Fills a GpcOptions of `size` bytes, which is sizeof(GpcOptions), with defaults: 64 samples, contrast and thin
/// triangles detected, shading in parts. Width and height are still to be set.
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_options(options: *mut GpcOptions, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(options, size) }
}

impl GpcOptions {
    /// # Safety
    /// With `GpcPattern::List`, `locations` shows as many as are counted.
    pub(super) unsafe fn options(&self) -> Result<Options, Error> {
        let shadings = [
            (
                GpcShading::Triangle as u32,
                "GPC_SHADING_TRIANGLE",
                Shading::Triangle,
            ),
            (GpcShading::Part as u32, "GPC_SHADING_PART", Shading::Part),
            (
                GpcShading::Sample as u32,
                "GPC_SHADING_SAMPLE",
                Shading::Sample,
            ),
        ];
        let detections = [
            (
                GpcDetection::Contrast as u32,
                "GPC_DETECTION_CONTRAST",
                Detection::Contrast,
            ),
            (
                GpcDetection::Edges as u32,
                "GPC_DETECTION_EDGES",
                Detection::Edges,
            ),
            (
                GpcDetection::Exact as u32,
                "GPC_DETECTION_EXACT",
                Detection::Exact,
            ),
            (
                GpcDetection::Every as u32,
                "GPC_DETECTION_EVERY",
                Detection::Every,
            ),
        ];
        let has_background = flag("GpcOptions.has_background", self.has_background)?;
        Ok(Options {
            size: [self.width, self.height],
            samples: self.samples,
            // SAFETY: passed on to the caller.
            pattern: unsafe { self.sample_pattern() }?,
            shading: choice("GpcOptions.shading", self.shading, &shadings)?,
            detection: choice("GpcOptions.detection", self.detection, &detections)?,
            contrast: match self.contrast {
                GPC_CONTRAST_OF_SAMPLES => None,
                asked => Some(u8::try_from(asked).map_err(|_| Error::Value {
                    name: "GpcOptions.contrast",
                    found: asked,
                    possible: "0 to 255, or GPC_CONTRAST_OF_SAMPLES".to_owned(),
                })?),
            },
            growths: match self.growths {
                GPC_GROWTHS_OF_SAMPLES => None,
                asked => Some(u8::try_from(asked).map_err(|_| Error::Value {
                    name: "GpcOptions.growths",
                    found: asked,
                    possible: GROWTHS.to_owned(),
                })?),
            },
            thin: flag("GpcOptions.thin", self.thin)?,
            background: has_background.then_some(self.background),
            flat_background: flag("GpcOptions.flat_background", self.flat_background)?,
            high_dynamic_range: flag("GpcOptions.high_dynamic_range", self.high_dynamic_range)?,
            sharp: flag("GpcOptions.sharp", self.sharp)?,
            shade_all: flag("GpcOptions.shade_all", self.shade_all)?,
            max_memory: (self.max_memory != 0).then_some(self.max_memory),
            max_rounds: (self.max_rounds != 0).then_some(self.max_rounds),
        })
    }

    /// # Safety
    /// As [`GpcOptions::options`].
    unsafe fn sample_pattern(&self) -> Result<Pattern, Error> {
        let patterns = [
            (
                GpcPattern::Sobol as u32,
                "GPC_PATTERN_SOBOL",
                Pattern::Sobol,
            ),
            (
                GpcPattern::Lattice as u32,
                "GPC_PATTERN_LATTICE",
                Pattern::Lattice,
            ),
            (
                GpcPattern::Korobov as u32,
                "GPC_PATTERN_KOROBOV",
                Pattern::Korobov,
            ),
            (GpcPattern::Grid as u32, "GPC_PATTERN_GRID", Pattern::Grid),
            (
                GpcPattern::Rotated as u32,
                "GPC_PATTERN_ROTATED",
                Pattern::Rotated,
            ),
            (
                GpcPattern::List as u32,
                "GPC_PATTERN_LIST",
                Pattern::List(Vec::new()),
            ),
            (
                GpcPattern::Lines as u32,
                "GPC_PATTERN_LINES",
                Pattern::Lines,
            ),
        ];
        match choice("GpcOptions.pattern", self.pattern, &patterns)? {
            Pattern::List(_) if self.locations.is_null() => {
                Err(Error::Null("GpcOptions.locations"))
            }
            Pattern::List(_) => {
                let count = self.location_count as usize;
                // SAFETY: passed on to the caller; the pointer is not null.
                let found = unsafe { std::slice::from_raw_parts(self.locations, count) };
                Ok(Pattern::List(found.to_vec()))
            }
            pattern => Ok(pattern),
        }
    }
}
