//! Layouts of descriptor sets besides the frame's, and of pipelines that bind them.

use super::FrameLayout;
use super::pool::DescriptorPool;
use crate::vulkan::{
    Binding, Compiled, DescriptorSet, Gpu, Pipeline, Recorder, VulkanError, compute_pipeline,
};
use ash::vk;
use std::sync::Arc;

/// Layout of a descriptor set that belongs to one compute shader.
pub(crate) struct SetLayout {
    gpu: Arc<Gpu>,
    pub(crate) raw: vk::DescriptorSetLayout,
    bindings: &'static [Binding],
}

impl SetLayout {
    pub fn new(gpu: &Arc<Gpu>, bindings: &'static [Binding]) -> Result<Self, VulkanError> {
        let layouts: Vec<_> = bindings
            .iter()
            .map(|binding| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding.number)
                    .descriptor_type(binding.kind)
                    .descriptor_count(binding.count)
                    .stage_flags(vk::ShaderStageFlags::COMPUTE)
            })
            .collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&layouts);
        // SAFETY: plain creation on a live device.
        let raw = unsafe { gpu.device.create_descriptor_set_layout(&info, None) }
            .map_err(VulkanError::of("vkCreateDescriptorSetLayout"))?;
        Ok(Self {
            gpu: gpu.clone(),
            raw,
            bindings,
        })
    }

    /// Allocates a set of this layout from its own pool.
    pub fn allocate(&self) -> Result<OwnSet, VulkanError> {
        let sizes: Vec<_> = self
            .bindings
            .iter()
            .map(|binding| vk::DescriptorPoolSize {
                ty: binding.kind,
                descriptor_count: binding.count,
            })
            .collect();
        let pool = DescriptorPool::new(&self.gpu, 1, &sizes)?;
        Ok(OwnSet {
            set: pool.allocate(self.raw)?,
            _pool: pool,
        })
    }
}

impl Drop for SetLayout {
    fn drop(&mut self) {
        // SAFETY: owners drop the layout after the pipelines and sets that were made with it.
        unsafe {
            self.gpu
                .device
                .destroy_descriptor_set_layout(self.raw, None)
        };
    }
}

/// A descriptor set with its own pool.
pub(crate) struct OwnSet {
    pub set: DescriptorSet,
    _pool: DescriptorPool,
}

/// Layout of a pipeline.
pub(crate) struct PipelineLayout {
    gpu: Arc<Gpu>,
    pub(crate) raw: vk::PipelineLayout,
}

impl PipelineLayout {
    /// Makes a layout with these sets and `push_bytes` bytes of push constants for compute shaders.
    pub fn new(
        gpu: &Arc<Gpu>,
        sets: &[vk::DescriptorSetLayout],
        push_bytes: u32,
    ) -> Result<Self, VulkanError> {
        let push = [vk::PushConstantRange {
            stage_flags: vk::ShaderStageFlags::COMPUTE,
            offset: 0,
            size: push_bytes,
        }];
        Self::with_ranges(gpu, sets, if push_bytes > 0 { &push[..] } else { &[] })
    }

    /// Makes a layout with the frame's set and a further set. Both stay bound when pipelines of this layout and of the
    /// frame's layout alternate.
    pub fn beside_frame(frame: &FrameLayout, set: &SetLayout) -> Result<Self, VulkanError> {
        let sets = [frame.frame_set, set.raw];
        Self::with_ranges(&frame.gpu, &sets, &[FrameLayout::PUSH_RANGE])
    }

    fn with_ranges(
        gpu: &Arc<Gpu>,
        sets: &[vk::DescriptorSetLayout],
        ranges: &[vk::PushConstantRange],
    ) -> Result<Self, VulkanError> {
        let info = vk::PipelineLayoutCreateInfo::default()
            .set_layouts(sets)
            .push_constant_ranges(ranges);
        // SAFETY: plain creation on a live device.
        let raw = unsafe { gpu.device.create_pipeline_layout(&info, None) }
            .map_err(VulkanError::of("vkCreatePipelineLayout"))?;
        Ok(Self {
            gpu: gpu.clone(),
            raw,
        })
    }
}

impl PipelineLayout {
    /// Pipeline with this layout, from the cache of a frame's layout. Identically defined layouts are compatible, so
    /// that they share pipelines.
    pub fn compute<S: Compiled>(
        &self,
        frame: &FrameLayout,
        shader: &S,
    ) -> Result<Arc<Pipeline>, VulkanError> {
        let constants = &shader.constants();
        let shader = (S::code(), S::INTERFACE);
        let made = || compute_pipeline(&self.gpu, self.raw, shader, constants, None);
        frame.cached(S::code(), constants, 0, made)
    }

    /// Binds sets and pushes constants of this layout.
    pub fn bind(
        &self,
        recorder: &Recorder<'_>,
        sets: &[&DescriptorSet],
        push: &impl bytemuck::NoUninit,
    ) {
        recorder.bind_sets(self.raw, 0, sets);
        // SAFETY: guaranteed by the recorder's caller; the constants belong to this layout.
        unsafe {
            recorder.device().cmd_push_constants(
                recorder.bindings(),
                self.raw,
                vk::ShaderStageFlags::COMPUTE,
                0,
                bytemuck::bytes_of(push),
            );
        }
    }
}

impl Drop for PipelineLayout {
    fn drop(&mut self) {
        // SAFETY: owners drop the layout after the pipelines that were made with it have run.
        unsafe { self.gpu.device.destroy_pipeline_layout(self.raw, None) };
    }
}
