//! detect: decides which pixels are superpixels.

use crate::engine::pipelines::{FrameLayout, Pass, Size};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Rule that makes a pixel a superpixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub(crate) enum DetectMode {
    /// A neighbour with a contrasting colour.
    Contrast = spirv::DETECT_CONTRAST,
    /// A neighbour with another triangle and a contrasting colour.
    Edges = spirv::DETECT_EDGES,
    /// A neighbour with another triangle.
    Exact = spirv::DETECT_EXACT,
    /// A BLEND triangle at the pixel's centre.
    Blended = spirv::DETECT_BLENDED,
    /// Every pixel is a superpixel.
    Every = spirv::DETECT_EVERY,
    /// A neighbour with a contrasting colour, or three pixels in a line, around the pixel, whose colours have a second
    /// difference above the threshold.
    SecondDifferences = spirv::DETECT_SECOND_DIFFERENCES,
}

/// Options of the pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct DetectOptions {
    /// Rule that makes a pixel a superpixel.
    pub mode: DetectMode,
    /// Whether IDs of the nearest BLEND triangles are compared too.
    pub blend_ids: bool,
    /// Whether pixels that [`thin`](super::thin) marked become superpixels too.
    pub thin: bool,
    /// Whether alpha is compared too.
    pub transparent: bool,
    /// Whether to read the IDs of a multisampled raster, for [`DetectMode::Blended`].
    pub multisampled: bool,
    /// Number of shadow words of each place; their bits say which lights reach it. Neighbours with different words are
    /// compared like neighbours with different triangles.
    pub shadow_words: u32,
    /// Width in pixels of a border around the region whose pixels become superpixels too, for [`grow`](super::grow).
    pub beyond: u32,
}

/// Writes the masks of superpixels, for the tiles of a region.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(layout: &FrameLayout, options: &DetectOptions) -> Result<Pass, VulkanError> {
    let shader = spirv::Detect {
        mode: options.mode as u32,
        blend_ids: options.blend_ids,
        thin: options.thin,
        transparent: options.transparent,
        beyond: options.beyond,
        shadow_words: options.shadow_words,
    };
    let code = if options.multisampled { spirv::DETECT_MULTISAMPLED } else { spirv::DETECT };
    let detect = layout.kernel_variant(code, &shader)?;
    Ok(Pass::named(spirv::Detect::INTERFACE).dispatch(detect.dispatch((), Size::Items(1))))
}
