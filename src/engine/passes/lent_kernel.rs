//! Kernels that read a buffer that a host lends: their set shows storage buffers alone, and a count is pushed to them.

use super::own_layout::{OwnSet, PipelineLayout, SetLayout};
use crate::vulkan::{Constants, Gpu, Pipeline, Recorder, VulkanError, compute_pipeline};
use ash::vk;
use std::marker::PhantomData;
use std::sync::Arc;

/// The layouts of a kernel of 64 invocations a workgroup; `C` is what is pushed.
pub(crate) struct LentKernel<C> {
    layout: PipelineLayout,
    set_layout: SetLayout,
    shader: &'static [u8],
    pushed: PhantomData<C>,
}

impl<C: bytemuck::NoUninit> LentKernel<C> {
    /// Makes the layouts, for a set of so many buffers.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(gpu: &Arc<Gpu>, shader: &'static [u8], buffers: usize) -> Result<Self, VulkanError> {
        let kinds = vec![vk::DescriptorType::STORAGE_BUFFER; buffers];
        let set_layout = SetLayout::new(gpu, &kinds)?;
        Ok(Self {
            layout: PipelineLayout::new(gpu, &[set_layout.raw], size_of::<C>() as u32)?,
            set_layout,
            shader,
            pushed: PhantomData,
        })
    }

    /// The pipeline of one of its two variants.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline(&self, gpu: &Arc<Gpu>, variant: bool) -> Result<Pipeline, VulkanError> {
        let constants = Constants::new().flag(0, variant);
        compute_pipeline(gpu, self.layout.raw, self.shader, &constants, None)
    }

    /// A set that shows buffers, in the order of its bindings.
    ///
    /// # Errors
    /// If the driver refuses it.
    ///
    /// # Safety
    /// The buffers outlive the set's use.
    pub unsafe fn set(&self, buffers: &[vk::DescriptorBufferInfo]) -> Result<OwnSet, VulkanError> {
        let set = self.set_layout.allocate()?;
        // SAFETY: the set is new; of the buffers as the caller says.
        unsafe { set.write_buffers(0, buffers) };
        Ok(set)
    }

    /// Records so many invocations.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        pipeline: &Pipeline,
        set: &OwnSet,
        pushed: &C,
        invocations: u32,
    ) {
        self.layout.bind(recorder, &[set.raw], pushed);
        recorder.dispatch(pipeline, u64::from(invocations.div_ceil(64)));
    }
}
