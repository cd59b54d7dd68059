//! centres: turns the centres of pixels into visibility samples. It is no [`Pass`](crate::engine::pipelines::Pass), because
//! its client sorts and shades a band of pixels between the two dispatches for it.

use crate::engine::data::{ColorConstants, Resources};
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv;
use crate::vulkan::{Recorder, VulkanError};
use std::ops::Range;

/// Lists pixels that need shading, and gathers their colours.
pub(crate) struct Centres {
    list: Kernel<spirv::Centres>,
    gather: Kernel<spirv::Centres>,
}

impl Centres {
    /// Makes the pipelines; `output` holds the colour constants of `shaders/include/color.glsl`.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout, output: &ColorConstants) -> Result<Self, VulkanError> {
        let make = |gather| {
            let shader = spirv::Centres { gather, tonemap: output.tonemap, tonemap_codes: output.tonemap_codes };
            layout.kernel(&shader)
        };
        Ok(Self { list: make(false)?, gather: make(true)? })
    }

    /// Records the pass for an image of `pixels` pixels, in bands that fit into the room for fragments. `shade` records
    /// sorting and shading of each band.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        resources: &Resources,
        pixels: u32,
        mut shade: impl FnMut(&Recorder<'_>),
    ) {
        for band in Self::bands(pixels, resources.sizes().fragment_capacity) {
            let count = band.end - band.start;
            let push = spirv::CentresPush { first: band.start, count };
            self.list.record(recorder, &push, count);
            shade(recorder);
            self.gather.record(recorder, &push, count);
        }
    }

    /// Bands of pixels in which an image of `pixels` pixels is shaded; a band fits into the room for `room` fragments.
    fn bands(pixels: u32, room: u32) -> impl ExactSizeIterator<Item = Range<u32>> {
        let room = room.max(1);
        (0..pixels.div_ceil(room)).map(move |n| n * room..pixels.min((n + 1).saturating_mul(room)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_cover_all_pixels_once() {
        let bands = |pixels, room| -> Vec<_> {
            let bands = Centres::bands(pixels, room);
            bands.map(|band| (band.start, band.end)).collect()
        };
        assert_eq!(bands(10, 20), [(0, 10)]);
        assert_eq!(bands(10, 4), [(0, 4), (4, 8), (8, 10)]);
        let half = 1 << 31;
        assert_eq!(bands(u32::MAX, half), [(0, half), (half, u32::MAX)]);
    }
}
