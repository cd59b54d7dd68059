//! Options of antialiasing.

use super::error::{Error, GpcResult};
use super::input::{Element, choice, flag, init, unused};
use crate::engine::sampler::{Detection, Shading, SuperpixelOptions};
use crate::host::Options;
use crate::sampling::{FilterShape, Pattern, PixelFilter};
use ash::vk;
use std::ffi::c_void;

/// Pattern of the sample locations in a superpixel.
#[derive(Clone, Copy)]
#[repr(u32)]
pub enum GpcPattern {
    /// First points of a scrambled Sobol sequence. Any number of samples.
    Sobol = 0,
    /// Rotated square lattice. Any number of samples; for a number that is no square, the same as GPC_PATTERN_KOROBOV.
    Lattice = 1,
    /// Best rank-1 lattice. Any number of samples.
    Korobov = 2,
    /// Centres of a square grid. Square numbers of samples only.
    Grid = 3,
    /// Standard sample locations of Vulkan: 1, 2, 4, 8 or 16 samples.
    Rotated = 4,
    /// Offsets of the application, in GpcOptions.locations.
    List = 5,
    /// Samples on straight lines, 64 on each: 8 lines up to 64 samples, 32 up to 256, and 64 above (32 if any draw has
    /// an alpha map). Any number of samples; the number determines in how many places a superpixel is shaded. Below 4
    /// samples, and if each sample is shaded, the same as GPC_PATTERN_SOBOL.
    Lines = 6,
}

/// Rate of shading within a superpixel.
#[derive(Clone, Copy)]
#[repr(u32)]
pub enum GpcShading {
    /// One shading for each visible triangle.
    Triangle = 0,
    /// One shading for each visible triangle; several, in different parts of the pixel, where the surrounding colours
    /// vary.
    Part = 1,
    /// One shading for each sample.
    Sample = 2,
}

/// Rule by which a pixel becomes a superpixel.
#[derive(Clone, Copy)]
#[repr(u32)]
pub enum GpcDetection {
    /// A neighbour with a contrasting colour.
    Contrast = 0,
    /// A neighbour with another triangle and a contrasting colour.
    Edges = 1,
    /// A neighbour with another triangle.
    Exact = 2,
    /// No condition: every pixel is a superpixel. For measurements.
    Every = 3,
}

/// Filter by which pixels are averaged; docs/filters.md compares them.
#[derive(Clone, Copy)]
#[repr(u32)]
pub enum GpcFilter {
    /// The pixel: no pixel depends on others.
    Box = 0,
    /// A triangle. The default radius is 1 pixel.
    Tent = 1,
    /// A Gaussian whose standard deviation is a quarter of the radius. The default radius is 2 pixels.
    Gaussian = 2,
    /// The spline of Mitchell and Netravali, which has negative lobes. The default radius is 2 pixels.
    Mitchell = 3,
    /// The window of Blackman and Harris with four terms. The default radius is 1.5 pixels.
    BlackmanHarris = 4,
}

/// Value of GpcOptions.contrast for the default threshold: 6, or 1 from 128 samples on.
pub const GPC_CONTRAST_OF_SAMPLES: u32 = u32::MAX;

/// Value of GpcOptions.growths for the default number: 1, or 4 from 128 samples on.
pub const GPC_GROWTHS_OF_SAMPLES: u32 = u32::MAX;

/// Options of antialiasing a frame; gpc_init_options sets defaults.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcOptions {
    /// sizeof(GpcOptions).
    pub size: u32,
    /// GPC_STRUCT_TYPE_OPTIONS.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Width of the frame in pixels: of the part of the lent images that is antialiased.
    pub width: u32,
    /// Height of the frame in pixels: of the part of the lent images that is antialiased.
    pub height: u32,
    /// Number of samples of a superpixel, 1 to 1,024.
    pub samples: u32,
    /// Pattern of the sample locations: a GpcPattern.
    pub pattern: u32,
    /// Rate of shading within a superpixel: a GpcShading.
    pub shading: u32,
    /// Rule by which a pixel becomes a superpixel: a GpcDetection.
    pub detection: u32,
    /// Contrast threshold in 8-bit sRGB code values, 0 to 255, or GPC_CONTRAST_OF_SAMPLES: two colours contrast if any
    /// channel differs by more.
    pub contrast: u32,
    /// VK_TRUE if a triangle that is too thin to cover a pixel's centre makes the pixel a superpixel. If IDs are lent,
    /// depth is needed too.
    pub thin: vk::Bool32,
    /// VK_TRUE if the image holds radiance that is tone-mapped later; detection then compares tone-mapped colours.
    pub high_dynamic_range: vk::Bool32,
    /// VK_TRUE if textures are filtered over the area that each sample represents; VK_FALSE if over the whole pixel.
    pub sharp: vk::Bool32,
    /// VK_TRUE if the application's shading computes the colours of all pixels, so that the colour image may have any
    /// contents before; VK_FALSE if only superpixels are shaded, and drawn over the image's contents.
    pub shade_all: vk::Bool32,
    /// VK_TRUE if the background has the colour `background`; VK_FALSE if it is transparent. The background is visible
    /// where there is no triangle and, unless `flat_background` is set, where the application has drawn nothing either.
    pub has_background: vk::Bool32,
    /// Background as linear light.
    pub background: [f32; 3],
    /// VK_TRUE if the background is visible wherever there is no triangle.
    ///
    /// With VK_FALSE, if the application lends its colours, a sample of a superpixel that meets no triangle takes the
    /// colour and alpha that the application has drawn: of the pixel if its centre shows no triangle, else of the
    /// nearest such pixel among the 8 around it, then among the 24 around it, else the background.
    ///
    /// GpcGeometry.blended requires VK_TRUE. With `shade_all`, the flag is ignored.
    pub flat_background: vk::Bool32,
    /// Largest number of rounds for the detected superpixels, and for each growth; this bounds the time of a recording.
    /// Superpixels that these rounds leave keep their drawn colours and are counted as left over.
    ///
    /// 0 allows as many rounds as any image may need. Rounds without work take next to no time on devices with
    /// GpcDevice.conditional_rendering. On others each takes a little, and the time of the callback's commands.
    pub max_rounds: u32,
    /// Number of pairs in `locations`: equal to `samples`, with GPC_PATTERN_LIST.
    pub location_count: u32,
    /// Offsets of the samples from the pixel's centre in pixels, with GPC_PATTERN_LIST; otherwise ignored. x points to
    /// the right and y down, each at least -0.5 and below 0.5. Read during the call only.
    pub locations: *const [f32; 2],
    /// Largest number of bytes of device memory for a frame. With 0, a first frame takes at most 960 MiB besides its
    /// triangles on GPUs with memory of their own, if the image has up to 3840 x 2160 pixels, and as much as it needs otherwise.
    pub max_memory: u64,
    /// Number of growths, with GPC_DETECTION_CONTRAST: 0 to 8, or GPC_GROWTHS_OF_SAMPLES. In each growth, pixels that
    /// contrast with a neighbouring superpixel become superpixels too.
    pub growths: u32,
    /// VK_TRUE if the memory of a frame or list stays as it is; VK_FALSE if gpc_frame_record and gpc_list_record make
    /// more after a recording that was left unfinished.
    pub fixed_memory: vk::Bool32,
    /// VK_TRUE if the alpha of the colour image stays as it is. With VK_FALSE, each pixel that the library draws gets the
    /// mean opacity of its samples: 1 where a triangle that is not blended is seen, whatever the shading stores, and the
    /// drawn alpha, or that of the background, where none is. With `shade_all`, the image has to hold something before.
    pub keep_alpha: vk::Bool32,
    /// 0.
    pub reserved: u32,
    /// Filter by which pixels are averaged: a GpcFilter. With filters other than GPC_FILTER_BOX, the library draws all pixels of
    /// the frame: each is an average of the superpixels and of the application's pixels around it, also where the application has
    /// drawn what the library does not know. Pixels beyond the frame's edge have no weight. Alpha is filtered as a channel of its
    /// own, and limited to 0 to 1. Lists have GPC_FILTER_BOX only.
    pub filter: u32,
    /// Distance from the pixel's centre at which the filter ends, along x and along y: 0.5 to 2.5 pixels, or 0 for the default of
    /// `filter`. With GPC_FILTER_BOX, 0 or 0.5.
    pub filter_radius: f32,
}

/// Fills a GpcOptions of `size` bytes, which is sizeof(GpcOptions), with defaults: 64 samples, detection of contrast
/// and thin triangles, shading in parts. `width` and `height` still have to be set.
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_options(options: *mut GpcOptions, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(options, size) }
}

impl GpcOptions {
    /// What gpc_init_options sets.
    pub(super) fn initial() -> Self {
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
            ..Self::zeroed()
        }
    }

    /// # Safety
    /// With `GpcPattern::List`, `locations` points to as many pairs as `location_count` says.
    pub(super) unsafe fn options(&self) -> Result<Options, Error> {
        let shadings = [
            (GpcShading::Triangle as u32, "GPC_SHADING_TRIANGLE", Shading::Triangle),
            (GpcShading::Part as u32, "GPC_SHADING_PART", Shading::Part),
            (GpcShading::Sample as u32, "GPC_SHADING_SAMPLE", Shading::Sample),
        ];
        let detections = [
            (GpcDetection::Contrast as u32, "GPC_DETECTION_CONTRAST", Detection::Contrast),
            (GpcDetection::Edges as u32, "GPC_DETECTION_EDGES", Detection::Edges),
            (GpcDetection::Exact as u32, "GPC_DETECTION_EXACT", Detection::Exact),
            (GpcDetection::Every as u32, "GPC_DETECTION_EVERY", Detection::Every),
        ];
        unused("GpcOptions.reserved", self.reserved)?;
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
                asked => {
                    let most = SuperpixelOptions::MOST_GROWTHS;
                    let possible = u8::try_from(asked).ok().filter(|&count| count <= most);
                    Some(possible.ok_or_else(|| Error::Value {
                        name: "GpcOptions.growths",
                        found: asked,
                        possible: format!("0 to {most}, or GPC_GROWTHS_OF_SAMPLES"),
                    })?)
                }
            },
            thin: flag("GpcOptions.thin", self.thin)?,
            background: has_background.then_some(self.background),
            flat_background: flag("GpcOptions.flat_background", self.flat_background)?,
            high_dynamic_range: flag("GpcOptions.high_dynamic_range", self.high_dynamic_range)?,
            pixel_filter: self.pixel_filter()?,
            keep_alpha: flag("GpcOptions.keep_alpha", self.keep_alpha)?,
            sharp: flag("GpcOptions.sharp", self.sharp)?,
            shade_all: flag("GpcOptions.shade_all", self.shade_all)?,
            max_memory: (self.max_memory != 0).then_some(self.max_memory),
            fixed_memory: flag("GpcOptions.fixed_memory", self.fixed_memory)?,
            max_rounds: (self.max_rounds != 0).then_some(self.max_rounds),
        })
    }

    fn pixel_filter(&self) -> Result<PixelFilter, Error> {
        let shapes = [
            (GpcFilter::Box as u32, "GPC_FILTER_BOX", FilterShape::Box),
            (GpcFilter::Tent as u32, "GPC_FILTER_TENT", FilterShape::Tent),
            (GpcFilter::Gaussian as u32, "GPC_FILTER_GAUSSIAN", FilterShape::Gaussian),
            (GpcFilter::Mitchell as u32, "GPC_FILTER_MITCHELL", FilterShape::Mitchell),
            (GpcFilter::BlackmanHarris as u32, "GPC_FILTER_BLACKMAN_HARRIS", FilterShape::BlackmanHarris),
        ];
        let shape = choice("GpcOptions.filter", self.filter, &shapes)?;
        let radius = (self.filter_radius != 0.0).then_some(f64::from(self.filter_radius));
        Ok(PixelFilter::new(shape, radius))
    }

    /// Checks that the filter is the box, the only one that lists have.
    pub(super) fn check_filter_of_list(&self) -> Result<(), Error> {
        let only = [(GpcFilter::Box as u32, "GPC_FILTER_BOX", ())];
        choice("GpcOptions.filter of a list", self.filter, &only)
    }

    /// # Safety
    /// As [`GpcOptions::options`].
    unsafe fn sample_pattern(&self) -> Result<Pattern, Error> {
        let patterns = [
            (GpcPattern::Sobol as u32, "GPC_PATTERN_SOBOL", Pattern::Sobol),
            (GpcPattern::Lattice as u32, "GPC_PATTERN_LATTICE", Pattern::Lattice),
            (GpcPattern::Korobov as u32, "GPC_PATTERN_KOROBOV", Pattern::Korobov),
            (GpcPattern::Grid as u32, "GPC_PATTERN_GRID", Pattern::Grid),
            (GpcPattern::Rotated as u32, "GPC_PATTERN_ROTATED", Pattern::Rotated),
            (GpcPattern::List as u32, "GPC_PATTERN_LIST", Pattern::List(Vec::new())),
            (GpcPattern::Lines as u32, "GPC_PATTERN_LINES", Pattern::Lines),
        ];
        match choice("GpcOptions.pattern", self.pattern, &patterns)? {
            Pattern::List(_) if self.locations.is_null() => Err(Error::Null("GpcOptions.locations")),
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
