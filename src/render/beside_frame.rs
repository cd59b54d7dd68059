//! Compute kernels, of 64 invocations a workgroup, that bind a descriptor set of their own in addition to the frame's.

use crate::engine::data::SampleSet;
use crate::engine::pipelines::FrameLayout;
use crate::engine::pipelines::own_layout::{OwnSet, PipelineLayout, SetLayout};
use crate::vulkan::{Binding, Compiled, Pipeline, Recorder, ShownBinding, VulkanError};
use std::marker::PhantomData;
use std::sync::Arc;

/// Descriptor set of storage buffers, and the layouts of kernels that bind it as set 1; `C` is the type of the push
/// constants.
pub(super) struct BesideFrame<C> {
    layout: PipelineLayout,
    own: OwnSet,
    _set_layout: SetLayout,
    pushed: PhantomData<C>,
}

impl<C: bytemuck::NoUninit> BesideFrame<C> {
    /// Makes the layouts, and a descriptor set in which `bindings` refer to `buffers`.
    ///
    /// # Errors
    /// If the driver refuses one.
    ///
    /// # Safety
    /// The buffers outlive the use of the set.
    pub unsafe fn new(
        layout: &FrameLayout,
        bindings: &'static [Binding],
        buffers: &[ShownBinding],
    ) -> Result<Self, VulkanError> {
        let gpu = &layout.gpu;
        let set_layout = SetLayout::new(gpu, bindings)?;
        let sets = [layout.frame_set, set_layout.raw];
        let own_layout = PipelineLayout::new(gpu, &sets, size_of::<C>() as u32)?;
        let mut own = set_layout.allocate()?;
        // SAFETY: the set is new, and the caller guarantees the buffers.
        unsafe { own.set.write(buffers) };
        Ok(Self {
            layout: own_layout,
            own,
            _set_layout: set_layout,
            pushed: PhantomData,
        })
    }

    /// Makes the pipeline of a shader.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline<S: Compiled>(
        &self,
        layout: &FrameLayout,
        shader: &S,
    ) -> Result<Arc<Pipeline>, VulkanError> {
        self.layout.compute(layout, shader)
    }

    /// Binds a frame's descriptor set and this object's. Other passes must bind the frame's set again afterwards,
    /// because their layouts differ.
    pub fn bind(&self, recorder: &Recorder<'_>, frame: &SampleSet, pushed: &C) {
        let sets = [&frame.set, &self.own.set];
        self.layout.bind(recorder, &sets, pushed);
    }
}
