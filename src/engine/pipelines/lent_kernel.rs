//! Kernels that read a buffer lent by a host. Their set has only storage buffers, and a count is pushed to them.

use super::own_layout::{OwnSet, PipelineLayout, SetLayout};
use crate::vulkan::{
    Binding, Compiled, Gpu, Pipeline, Recorder, ShownBinding, VulkanError, compute_pipeline,
};
use std::marker::PhantomData;
use std::sync::Arc;

/// Layouts of a kernel with 64 invocations in a workgroup; `S` is its shader, `C` the type of its push constants.
pub(crate) struct LentKernel<S, C> {
    layout: PipelineLayout,
    set_layout: SetLayout,
    pushed: PhantomData<(S, C)>,
}

impl<S: Compiled, C: bytemuck::NoUninit> LentKernel<S, C> {
    /// Makes the layouts for a set with these bindings.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(gpu: &Arc<Gpu>, bindings: &'static [Binding]) -> Result<Self, VulkanError> {
        let set_layout = SetLayout::new(gpu, bindings)?;
        Ok(Self {
            layout: PipelineLayout::new(gpu, &[set_layout.raw], size_of::<C>() as u32)?,
            set_layout,
            pushed: PhantomData,
        })
    }

    /// Makes the pipeline for a shader with its constants.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline(&self, gpu: &Arc<Gpu>, shader: &S) -> Result<Pipeline, VulkanError> {
        let (code, constants) = ((S::code(), S::INTERFACE), shader.constants());
        compute_pipeline(gpu, self.layout.raw, code, &constants, None)
    }

    /// Makes a set with these buffers.
    ///
    /// # Errors
    /// If the driver refuses it.
    ///
    /// # Safety
    /// The buffers outlive the use of the set.
    pub unsafe fn set(&self, buffers: &[ShownBinding]) -> Result<OwnSet, VulkanError> {
        let mut own = self.set_layout.allocate()?;
        // SAFETY: the set is new; the caller guarantees the buffers.
        unsafe { own.set.write(buffers) };
        Ok(own)
    }

    /// Records a dispatch over `invocations` invocations.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        pipeline: &Pipeline,
        own: &OwnSet,
        pushed: &C,
        invocations: u32,
    ) {
        self.layout.bind(recorder, &[&own.set], pushed);
        recorder.dispatch_each(pipeline, u64::from(invocations));
    }
}
