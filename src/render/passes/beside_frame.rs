//! Kernels of 64 invocations that bind a set of their own beside the frame's.

use crate::passes::own_layout::{OwnSet, PipelineLayout, SetLayout};
use crate::passes::{FrameLayout, SampleSet};
use crate::vulkan::{Constants, Pipeline, Recorder, VulkanError, compute_pipeline};
use ash::vk;
use std::marker::PhantomData;
use std::sync::Arc;

/// A set of storage buffers, and the layouts of kernels that bind it as set 1; `C` is what is pushed.
pub(super) struct BesideFrame<C> {
    layout: PipelineLayout,
    set: OwnSet,
    _set_layout: SetLayout,
    pushed: PhantomData<C>,
}

impl<C: bytemuck::NoUninit> BesideFrame<C> {
    /// Makes the layouts, and a set that shows buffers in the order of its bindings.
    ///
    /// # Errors
    /// If the driver refuses one.
    ///
    /// # Safety
    /// The buffers outlive the set's use.
    pub unsafe fn new(
        layout: &FrameLayout,
        buffers: &[vk::DescriptorBufferInfo],
    ) -> Result<Self, VulkanError> {
        let gpu = &layout.gpu;
        let kinds = vec![vk::DescriptorType::STORAGE_BUFFER; buffers.len()];
        let set_layout = SetLayout::new(gpu, &kinds)?;
        let sets = [layout.frame_set, set_layout.raw];
        let own_layout = PipelineLayout::new(gpu, &sets, size_of::<C>() as u32)?;
        let set = set_layout.allocate()?;
        // SAFETY: the set is new; of the buffers as the caller says.
        unsafe { set.write_buffers(0, buffers) };
        Ok(Self {
            layout: own_layout,
            set,
            _set_layout: set_layout,
            pushed: PhantomData,
        })
    }

    /// The pipeline of a shader.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline(
        &self,
        layout: &FrameLayout,
        shader: &'static [u8],
        constants: &Constants,
    ) -> Result<Arc<Pipeline>, VulkanError> {
        // Layouts that are made alike are one and the same to pipelines.
        layout.cached(shader, constants, 0, || {
            compute_pipeline(&layout.gpu, self.layout.raw, shader, constants, None)
        })
    }

    /// Binds a frame's set and this one; afterwards the former is no longer bound as other passes bind it.
    pub fn bind(&self, recorder: &Recorder<'_>, frame: &SampleSet, pushed: &C) {
        let sets = [frame.descriptor(), self.set.raw];
        self.layout.bind(recorder, &sets, pushed);
    }
}
