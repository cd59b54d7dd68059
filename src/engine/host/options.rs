//! How a host's frames are antialiased.

use crate::engine::sampler::{
    Coverage, Detection, Footprint, Reference, Settings, Shading, SuperpixelOptions,
};
use crate::sampling::Pattern;

/// How a host's frames are antialiased.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Width and height in pixels of the images lent.
    pub size: [u32; 2],
    /// Samples of a superpixel, 1 to 1,024.
    pub samples: u32,
    /// Where they lie.
    pub pattern: Pattern,
    /// How often the inside of a superpixel is shaded.
    pub shading: Shading,
    /// What makes a pixel a superpixel.
    pub detection: Detection,
    /// Differences above this, in 8-bit sRGB code values of any channel, are a contrast; `None` is 6, and 1 from 128 samples on.
    pub contrast: Option<u8>,
    /// How often pixels become superpixels because they contrast with a superpixel beside them, 0 to 8, with [`Detection::Contrast`];
    /// `None` is once, and twice from 128 samples on.
    pub growths: Option<u8>,
    /// Whether triangles too thin for a pixel's centre to see make superpixels too; where IDs are lent, this needs depth, too.
    pub thin: bool,
    /// Linear light that shows where neither a triangle nor, unless [`Self::flat_background`] says otherwise, something that the
    /// host has drawn is; `None` is transparent.
    pub background: Option<[f32; 3]>,
    /// Whether [`Self::background`] shows wherever no triangle is. Otherwise, where the host lends its colours, a sample of a
    /// superpixel that sees no triangle shows what the host has drawn, with its alpha: the colour of the pixel if its centre saw no
    /// triangle, else of the nearest one of the 8 pixels around it, then of the 24, whose centre saw none, else the background. It
    /// has to be true with [`Geometry::blended`](super::Geometry::blended), and does not matter with [`Self::shade_all`].
    pub flat_background: bool,
    /// Whether the image holds radiance that is tone-mapped later, so that detection compares tone-mapped colours.
    pub high_dynamic_range: bool,
    /// Whether textures are filtered over what each sample stands for, so that the image converges to the scene as it is;
    /// otherwise over the whole pixel.
    pub sharp: bool,
    /// Whether the host's shading makes the colours of all pixels, so that the colour image may hold anything before;
    /// otherwise of superpixels alone, which are drawn over what it holds.
    pub shade_all: bool,
    /// Bound on the device memory of a frame in bytes.
    pub max_memory: Option<u64>,
    /// Bound on the time that a recording takes: the most rounds of superpixels that are detected, and of each growth of these.
    /// What rounds leave keeps the colours that were drawn, and is counted as left over. With `None` there are as many as an image
    /// may need or, on GPUs with plenty of memory, usually needs; those that it does not need take next to no time on devices with
    /// [`Host::conditional_rendering`](crate::vulkan::Host::conditional_rendering), and little on others.
    pub max_rounds: Option<u32>,
}

impl Options {
    /// Those for images of a size: 64 samples, contrast and thin triangles detected, shading in parts.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            size: [width, height],
            samples: Settings::DEFAULT_SAMPLES,
            pattern: Pattern::Lines,
            shading: Shading::Part,
            detection: Detection::Contrast,
            contrast: None,
            growths: None,
            thin: true,
            background: None,
            flat_background: false,
            high_dynamic_range: false,
            sharp: true,
            shade_all: false,
            max_memory: None,
            max_rounds: None,
        }
    }

    /// Whether samples that see no triangle show what the host has drawn.
    pub(super) fn shows_drawn(&self) -> bool {
        !self.flat_background && !self.shade_all
    }

    pub(super) fn settings(&self) -> Settings {
        let superpixels = SuperpixelOptions {
            samples: self.samples,
            pattern: self.pattern.clone(),
            coverage: Coverage::Area,
            shading: self.shading,
            detection: self.detection,
            contrast: self.contrast,
            growths: self.growths,
            thin: self.thin,
        };
        Settings {
            method: superpixels.into(),
            background: self.background,
            reference: Reference::Scene,
            tonemapped_detection: self.high_dynamic_range,
            footprint: if self.sharp {
                Footprint::Sample
            } else {
                Footprint::Pixel
            },
            max_memory: self.max_memory,
            ..Settings::new(self.size[0], self.size[1])
        }
    }
}

setters! {
    Options {
        samples: u32,
        pattern: Pattern,
        shading: Shading,
        detection: Detection,
        contrast: Option<u8>,
        growths: Option<u8>,
        thin: bool,
        background: Option<[f32; 3]>,
        flat_background: bool,
        high_dynamic_range: bool,
        sharp: bool,
        shade_all: bool,
        max_memory: Option<u64>,
        max_rounds: Option<u32>,
    }
}
