//! sample_masks: finds the nearest triangle of the samples of a pixel, of which a set is a mask.

use super::SampleOptions;
use crate::engine::data::Cells;
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv;
use crate::vulkan::VulkanError;

/// Variants of the kernel, each with the largest number of samples that it supports.
const KERNELS: [(u32, &[u8]); 2] = [(16, spirv::SAMPLE_MASKS_16), (64, spirv::SAMPLE_MASKS_64)];

/// Makes the kernel for cells of `samples` samples, with the constants of the general kernel that it takes the place of.
///
/// # Errors
/// If the driver refuses it.
pub(super) fn kernel(
    layout: &FrameLayout,
    shader: &spirv::Sample,
    samples: u32,
) -> Result<Kernel<spirv::SampleMasks>, VulkanError> {
    let shader = spirv::SampleMasks {
        local_size: shader.local_size,
        lanes: shader.lanes,
        has_mask: shader.has_mask,
        list: shader.list,
        by_part: shader.by_part,
        exact_areas: shader.exact_areas,
        part: shader.part,
        // Compilers of GPU drivers spill registers if loops over samples are unrolled; CPU drivers are slower if they
        // are not.
        rolled: !layout.gpu.limits().is_cpu(),
        locations: shader.locations,
        instanced: shader.instanced,
        unsure: shader.unsure,
    };
    let [few, many] = KERNELS;
    let (_, code) = if samples <= few.0 { few } else { many };
    layout.kernel_variant(code, &shader)
}

impl SampleOptions {
    /// Whether the special kernels store the samples of a pixel as a mask.
    pub(super) fn by_masks(&self) -> bool {
        let few = (2..=64).contains(&self.samples);
        let one_cell = self.long_lists.takes_one_cell();
        self.cells == Cells::Pixels && self.by_cell() && !self.by_lines() && !one_cell && few
    }
}
