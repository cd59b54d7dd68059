//! adopt: a host's triangles as the other passes read them.

use super::spirv::{self, adopt_set};
use crate::engine::data::Draws;
use crate::engine::pipelines::lent_kernel::LentKernel;
use crate::engine::pipelines::own_layout::{OwnSet, whole};
use crate::vulkan::{Buffer, Gpu, Pipeline, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// How much there is of what a frame adopts; indices begin in the buffer that the set shows at `first_index`, in indices.
pub(crate) use spirv::AdoptPush as AdoptedCounts;

/// Expands indices into triangles.
pub(crate) struct Adopt(LentKernel<spirv::Adopt, AdoptedCounts>);

impl Adopt {
    /// Makes the layouts.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(gpu: &Arc<Gpu>) -> Result<Self, VulkanError> {
        Ok(Self(LentKernel::new(gpu, &adopt_set::ALL)?))
    }

    /// The pipeline for indices of 32 bits or, `short`, 16.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline(&self, gpu: &Arc<Gpu>, short: bool) -> Result<Pipeline, VulkanError> {
        self.0.pipeline(gpu, &spirv::Adopt { short })
    }

    /// A set that shows draws, the host's indices, triangles and the draw of each.
    ///
    /// # Safety
    /// The host's buffer outlives the set's use.
    pub unsafe fn set(
        &self,
        draws: &Draws,
        indices: vk::DescriptorBufferInfo,
        triangles: &Buffer,
        draw_of: &Buffer,
    ) -> Result<OwnSet, VulkanError> {
        let buffers = [
            (adopt_set::DRAWS, whole(&draws.table)),
            (adopt_set::INDICES, indices),
            (adopt_set::TRIANGLES_OUT, whole(triangles)),
            (adopt_set::DRAW_OF_OUT, whole(draw_of)),
        ];
        // SAFETY: of the host's buffer as the caller says; ours go with the frame.
        unsafe { self.0.set(&buffers) }
    }

    /// Records it, where there are triangles.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        pipeline: &Pipeline,
        set: &OwnSet,
        counts: AdoptedCounts,
    ) {
        let invocations = counts.triangle_count;
        self.0.record(recorder, pipeline, set, &counts, invocations);
    }
}
