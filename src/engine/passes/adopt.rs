//! adopt: converts a host's triangles to the form that the other passes read.

use super::spirv::{self, adopt_set};
use crate::engine::data::Draws;
use crate::engine::pipelines::OwnSet;
use crate::engine::pipelines::lent_kernel::LentKernel;
use crate::vulkan::{Buffer, Gpu, Pipeline, Recorder, Shown, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Push constants of a dispatch: ranges of triangles and indices, the number of draws, and the topology.
pub(crate) use spirv::AdoptPush as AdoptedCounts;

/// Makes triangles from indices.
pub(crate) struct Adopt(LentKernel<spirv::Adopt, AdoptedCounts>);

impl Adopt {
    /// Makes the layouts.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(gpu: &Arc<Gpu>) -> Result<Self, VulkanError> {
        Ok(Self(LentKernel::new(gpu, &adopt_set::ALL)?))
    }

    /// Makes the pipeline: for 16-bit indices if `are_short` is true, for 32-bit indices if it is false, and for
    /// vertices without indices if it is `None`.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline(
        &self,
        gpu: &Arc<Gpu>,
        are_short: Option<bool>,
    ) -> Result<Pipeline, VulkanError> {
        let shader = spirv::Adopt {
            short: are_short.unwrap_or_default(),
            indexed: are_short.is_some(),
        };
        self.0.pipeline(gpu, &shader)
    }

    /// Makes a set with the draws, the host's indices if there are any, the triangles, and the draw of each triangle.
    ///
    /// # Safety
    /// The host's buffer outlives the use of the set.
    pub unsafe fn set(
        &self,
        draws: &Draws,
        indices: Option<vk::DescriptorBufferInfo>,
        triangles: &Buffer,
        draw_of: &Buffer,
    ) -> Result<OwnSet, VulkanError> {
        let buffers = [
            (adopt_set::DRAWS, (&draws.table).into()),
            (
                adopt_set::INDICES,
                indices.map_or_else(|| (&draws.table).into(), Shown::from),
            ),
            (adopt_set::TRIANGLES_OUT, triangles.into()),
            (adopt_set::DRAW_OF_OUT, draw_of.into()),
        ];
        // SAFETY: the caller guarantees the host's buffer; the others live as long as the frame.
        unsafe { self.0.set(&buffers) }
    }

    /// Records the pass, if there are triangles.
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
