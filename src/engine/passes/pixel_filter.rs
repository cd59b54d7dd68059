//! pixel_filter: averages by a pixel filter that reaches beyond the pixel.

use crate::engine::pipelines::{FrameLayout, Pass, Size};
use crate::engine::spirv;
use crate::sampling::{PixelFilter, SPREAD_SCALES};
use crate::vulkan::{Specialized, VulkanError};

/// Superpixels among the pixels that are filtered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Superpixels {
    /// There are none.
    None,
    /// Those that `detect` has found.
    Detected,
    /// Those, and others that `grow` has added.
    Grown,
}

/// Alpha of the colours that are filtered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Alpha {
    /// Colours are multiplied by it.
    Premultiplied,
    /// It may be anything, and does not change how light is filtered.
    Apart,
}

/// Filters each pixel of the region, which has several rendered pixels if `supersampled` is set.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(
    layout: &FrameLayout,
    filter: &PixelFilter,
    supersampled: bool,
    superpixels: Superpixels,
    alpha: Alpha,
) -> Result<Pass, VulkanError> {
    let fits = filter.fits();
    let reach = filter.reach();
    // The filter's fit at a pixel to the right, which mirrors the one to the left.
    let bits = |away: u32, function: usize| {
        let fit = fits.get((reach + away) as usize).map_or(0.0, |fit| fit[function] * SPREAD_SCALES[function]);
        (fit as f32).to_bits()
    };
    let shader = spirv::PixelFilter {
        reach,
        supersampled,
        superpixels: superpixels != Superpixels::None,
        grown: superpixels == Superpixels::Grown,
        premultiplied: alpha == Alpha::Premultiplied,
        weight_0: bits(0, 0),
        weight_1: bits(1, 0),
        weight_2: bits(2, 0),
        slope_1: bits(1, 1),
        slope_2: bits(2, 1),
        bend_0: bits(0, 2),
        bend_1: bits(1, 2),
        bend_2: bits(2, 2),
    };
    let dispatch = layout.kernel(&shader)?.dispatch((), Size::Items(1));
    Ok(Pass::named(spirv::PixelFilter::INTERFACE).dispatch(dispatch))
}

/// Number of work items for rendered pixels that are not supersampled: the columns of `tiles` tiles.
pub(crate) fn columns(tiles: u32) -> u32 {
    8 * tiles
}

/// The weights that the pass reads for `side` x `side` rendered pixels in an output pixel.
pub(crate) fn weights(filter: &PixelFilter, side: u32) -> Vec<f32> {
    filter.weights(side).into_iter().map(|weight| weight as f32).collect()
}
