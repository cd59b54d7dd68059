//! Options of antialiasing a host's frames, and of sampling its lists.

use crate::engine::sampler::footprint::TextureFilter;
use crate::engine::sampler::{
    CellOptions, Detection, Footprint, ImageRequest, Method, Reference, SamplerSettings, Shading, SuperpixelOptions,
};
use crate::sampling::{Pattern, PixelFilter};

/// Options of antialiasing a host's frames.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Width and height of the lent images' part to antialias, in pixels.
    pub size: [u32; 2],
    /// Number of samples of a superpixel, 1 to 1,024.
    pub samples: u32,
    /// Pattern of the sample locations in a superpixel.
    pub pattern: Pattern,
    /// Rate of shading within a superpixel.
    pub shading: Shading,
    /// Rule by which a pixel becomes a superpixel.
    pub detection: Detection,
    /// Contrast threshold in 8-bit sRGB code values: two colours contrast if any channel differs by more. `None` is 6,
    /// or 1 from 128 samples on.
    pub contrast: Option<u8>,
    /// Number of growths, 0 to 8, with [`Detection::Contrast`]. In each growth, pixels that contrast with a
    /// neighbouring superpixel become superpixels too. `None` is 1, or 4 from 128 samples on.
    pub growths: Option<u8>,
    /// Whether a triangle that is too thin to cover a pixel's centre makes the pixel a superpixel. If IDs are lent,
    /// depth is needed too.
    pub thin: bool,
    /// Background as linear light; `None` is transparent. The background is visible where there is no triangle and,
    /// unless [`Self::flat_background`] is set, where the host has drawn nothing either.
    pub background: Option<[f32; 3]>,
    /// Whether [`Self::background`] is visible wherever there is no triangle.
    ///
    /// Otherwise, if the host lends its colours, a sample of a superpixel that meets no triangle takes the colour and
    /// alpha that the host has drawn: of the pixel if its centre shows no triangle, else of the nearest such pixel
    /// among the 8 around it, then among the 24 around it, else the background.
    ///
    /// [`Geometry::blended`](super::Geometry::blended) requires true. With [`Self::shade_all`], the flag is ignored.
    pub flat_background: bool,
    /// Whether the image holds radiance that is tone-mapped later; detection then compares tone-mapped colours.
    pub high_dynamic_range: bool,
    /// Filter by which pixels are averaged. With filters other than the box, the library draws all pixels of the frame: each is an
    /// average of the superpixels and of the host's pixels around it, also where the host has drawn what the library does not know.
    /// Pixels beyond the frame's edge have no weight. Alpha is filtered as a channel of its own, and limited to 0 to 1.
    pub pixel_filter: PixelFilter,
    /// Whether the alpha of the colour image stays as it is. Otherwise each pixel that the library draws gets the mean
    /// opacity of its samples: 1 where a triangle that is not blended is seen, whatever the shading stores, and the drawn
    /// alpha, or that of the background, where none is. With [`Self::shade_all`], the image has to hold something before.
    pub keep_alpha: bool,
    /// Whether textures are filtered over the area that each sample represents, so that the image converges to the
    /// unfiltered scene; otherwise over the whole pixel.
    pub sharp: bool,
    /// Whether the host's shading computes the colours of all pixels, so that the colour image may have any contents
    /// before. Otherwise only superpixels are shaded, and drawn over the image's contents.
    pub shade_all: bool,
    /// Largest number of bytes of device memory for a frame. With `None`, a first frame takes at most 960 MiB besides its
    /// triangles on GPUs with memory of their own, if the image has up to 3840 x 2160 pixels, and as much as it needs otherwise.
    pub max_memory: Option<u64>,
    /// Whether the memory of a frame stays as it is. Otherwise [`Frame::record`](super::Frame::record) makes more if the last
    /// recording was left unfinished.
    pub fixed_memory: bool,
    /// Largest number of rounds for the detected superpixels, and for each growth; this bounds the time of a recording.
    /// Superpixels that these rounds leave keep their drawn colours and are counted as left over.
    ///
    /// `None` allows as many rounds as any image may need. Rounds without work take next to no time on devices with
    /// [`Host::conditional_rendering`](crate::vulkan::Host::conditional_rendering), and little on others.
    pub max_rounds: Option<u32>,
}

impl Options {
    /// Default options for images of a size: 64 samples, detection of contrast and thin triangles, shading in parts.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            size: [width, height],
            samples: CellOptions::DEFAULT_SAMPLES,
            pattern: Pattern::Lines,
            shading: Shading::Part,
            detection: Detection::Contrast,
            contrast: None,
            growths: None,
            thin: true,
            background: None,
            flat_background: false,
            high_dynamic_range: false,
            pixel_filter: PixelFilter::BOX,
            keep_alpha: false,
            sharp: true,
            shade_all: false,
            max_memory: None,
            fixed_memory: false,
            max_rounds: None,
        }
    }

    /// Whether samples that meet no triangle take the colour that the host has drawn.
    pub(super) fn shows_drawn(&self) -> bool {
        !self.flat_background && !self.shade_all
    }

    /// Options of superpixels.
    pub(super) fn superpixels(&self) -> SuperpixelOptions {
        SuperpixelOptions {
            cells: ListOptions::from(self).cells(),
            detection: self.detection,
            contrast: self.contrast,
            growths: self.growths,
            thin: self.thin,
        }
    }

    /// The image to antialias, by a method with [these options](Self::superpixels).
    pub(super) fn image<'a>(&self, method: &'a Method) -> ImageRequest<'a> {
        ImageRequest {
            size: self.size,
            region: None,
            method,
            filter: self.pixel_filter,
            attributes: false,
            max_memory: self.max_memory,
        }
    }

    /// Settings of the sampler.
    pub(super) fn sampler(&self) -> SamplerSettings {
        SamplerSettings {
            reference: Reference::Scene { tonemapped_detection: self.high_dynamic_range },
            ..ListOptions::from(self).sampler()
        }
    }
}

/// Options of sampling a host's lists of locations. A list has no neighbouring pixels, and therefore no pixel filter.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ListOptions {
    /// Width and height of the image in whose pixels locations are given.
    pub size: [u32; 2],
    /// Number of samples of a location, 1 to 1,024. With one sample, a location is sampled at its own position; with
    /// more, as a superpixel around it.
    pub samples: u32,
    /// Pattern of the sample locations in a superpixel.
    pub pattern: Pattern,
    /// Rate of shading within a superpixel.
    pub shading: Shading,
    /// Background as linear light; `None` is transparent.
    pub background: Option<[f32; 3]>,
    /// Whether textures are filtered over the area that each sample represents; otherwise over the whole location.
    pub sharp: bool,
    /// Largest number of bytes of device memory for a list; `None` for no limit.
    pub max_memory: Option<u64>,
    /// Whether the memory of a list stays as it is. Otherwise [`List::record`](super::List::record) makes more if the last
    /// recording was left unfinished.
    pub fixed_memory: bool,
    /// Largest number of rounds; this bounds the time of a recording. Locations that these rounds leave show the
    /// background and are counted as left over. `None` is as in [`Options::max_rounds`].
    pub max_rounds: Option<u32>,
}

impl ListOptions {
    /// Default options for locations in an image of a size: 64 samples, shading in parts.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self::from(&Options::new(width, height))
    }

    /// Options of sampling a location.
    pub(super) fn cells(&self) -> CellOptions {
        CellOptions { samples: self.samples, pattern: self.pattern.clone(), shading: self.shading }
    }

    /// Settings of the sampler.
    pub(super) fn sampler(&self) -> SamplerSettings {
        let footprint = if self.sharp { Footprint::Sample } else { Footprint::Pixel };
        SamplerSettings {
            cells: self.cells(),
            filter: TextureFilter::of_cells(footprint, self.shading),
            background: self.background,
            exposure: 0.0,
            reference: Reference::Scene { tonemapped_detection: false },
            merged: None,
        }
    }
}

impl From<&Options> for ListOptions {
    /// The options of frames that lists have as well.
    fn from(options: &Options) -> Self {
        Self {
            size: options.size,
            samples: options.samples,
            pattern: options.pattern.clone(),
            shading: options.shading,
            background: options.background,
            sharp: options.sharp,
            max_memory: options.max_memory,
            fixed_memory: options.fixed_memory,
            max_rounds: options.max_rounds,
        }
    }
}

setters! {
    ListOptions {
        samples: u32 = "the number of samples of a location",
        pattern: Pattern = "the pattern of the sample locations in a superpixel",
        shading: Shading = "the rate of shading within a superpixel",
        background: Option<[f32; 3]> = "the background as linear light; `None` for transparent",
        sharp: bool = "whether textures are filtered over the area that each sample represents",
        max_memory: Option<u64> = "the largest number of bytes of device memory for a list",
        fixed_memory: bool = "whether the memory of a list stays as it is",
        max_rounds: Option<u32> = "the largest number of rounds",
    }
}

setters! {
    Options {
        samples: u32 = "the number of samples of a superpixel",
        pattern: Pattern = "the pattern of the sample locations in a superpixel",
        shading: Shading = "the rate of shading within a superpixel",
        detection: Detection = "the rule by which a pixel becomes a superpixel",
        contrast: Option<u8> = "the contrast threshold in 8-bit sRGB code values; `None` for the default",
        growths: Option<u8> = "the number of growths; `None` for the default",
        thin: bool = "whether a triangle that is too thin to cover a pixel's centre makes the pixel a superpixel",
        background: Option<[f32; 3]> = "the background as linear light; `None` for transparent",
        flat_background: bool = "whether the background is visible wherever there is no triangle",
        high_dynamic_range: bool = "whether the image holds radiance that is tone-mapped later",
        pixel_filter: PixelFilter = "the filter by which pixels are averaged",
        keep_alpha: bool = "whether the alpha of the colour image stays as it is",
        sharp: bool = "whether textures are filtered over the area that each sample represents",
        shade_all: bool = "whether the host's shading computes the colours of all pixels",
        max_memory: Option<u64> = "the largest number of bytes of device memory for a frame",
        fixed_memory: bool = "whether the memory of a frame stays as it is",
        max_rounds: Option<u32> = "the largest number of rounds for the detected superpixels, and for each growth",
    }
}
