//! Layouts of descriptor sets beside the frame's, and of pipelines that bind them.

use super::pool::DescriptorPool;
use crate::vulkan::{Buffer, Gpu, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// The layout of a set whose bindings count from 0, for compute shaders.
pub(crate) struct SetLayout {
    gpu: Arc<Gpu>,
    pub(crate) raw: vk::DescriptorSetLayout,
    kinds: Vec<vk::DescriptorType>,
}

impl SetLayout {
    pub fn new(gpu: &Arc<Gpu>, kinds: &[vk::DescriptorType]) -> Result<Self, VulkanError> {
        let bindings: Vec<_> = (0..)
            .zip(kinds)
            .map(|(binding, kind)| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding)
                    .descriptor_type(*kind)
                    .descriptor_count(1)
                    .stage_flags(vk::ShaderStageFlags::COMPUTE)
            })
            .collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: plain creation on a live device.
        let raw = unsafe { gpu.device.create_descriptor_set_layout(&info, None) }
            .map_err(VulkanError::of("vkCreateDescriptorSetLayout"))?;
        Ok(Self {
            gpu: gpu.clone(),
            raw,
            kinds: kinds.to_vec(),
        })
    }

    /// A set of this layout in a pool of its own.
    pub fn allocate(&self) -> Result<OwnSet, VulkanError> {
        let sizes: Vec<_> = self
            .kinds
            .iter()
            .map(|kind| vk::DescriptorPoolSize {
                ty: *kind,
                descriptor_count: 1,
            })
            .collect();
        let pool = DescriptorPool::new(&self.gpu, 1, &sizes)?;
        Ok(OwnSet {
            gpu: self.gpu.clone(),
            raw: pool.allocate(self.raw)?,
            kinds: self.kinds.clone(),
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

/// A descriptor set and the pool that it is of.
pub(crate) struct OwnSet {
    gpu: Arc<Gpu>,
    pub(crate) raw: vk::DescriptorSet,
    kinds: Vec<vk::DescriptorType>,
    _pool: DescriptorPool,
}

impl OwnSet {
    /// Shows buffers at the set's bindings from one on, in their order.
    ///
    /// # Safety
    /// The set is not in use, and its bindings are those of buffers, which outlive its use.
    pub unsafe fn write_buffers(&self, first: u32, buffers: &[vk::DescriptorBufferInfo]) {
        // SAFETY: passed on to the caller.
        unsafe { self.write(first, buffers, vk::WriteDescriptorSet::buffer_info) };
    }

    /// Shows texel buffers at the set's bindings from one on, in their order.
    ///
    /// # Safety
    /// The set is not in use, and its bindings are those of texel buffers, which outlive its use.
    pub unsafe fn write_texels(&self, first: u32, views: &[vk::BufferView]) {
        // SAFETY: passed on to the caller.
        unsafe { self.write(first, views, vk::WriteDescriptorSet::texel_buffer_view) };
    }

    /// # Safety
    /// The set is not in use, and its bindings are of what `show` shows there, which outlives its use.
    unsafe fn write<'a, T>(
        &self,
        first: u32,
        shown: &'a [T],
        show: impl Fn(vk::WriteDescriptorSet<'a>, &'a [T]) -> vk::WriteDescriptorSet<'a>,
    ) {
        let kinds = self.kinds.iter().skip(first as usize);
        let writes: Vec<_> = (first..)
            .zip(shown.chunks(1).zip(kinds))
            .map(|(binding, (one, kind))| {
                let write = vk::WriteDescriptorSet::default()
                    .dst_set(self.raw)
                    .dst_binding(binding)
                    .descriptor_type(*kind);
                show(write, one)
            })
            .collect();
        // SAFETY: passed on to the caller.
        unsafe { self.gpu.device.update_descriptor_sets(&writes, &[]) };
    }

    /// Shows an image, in the layout `SHADER_READ_ONLY_OPTIMAL`, at binding 0.
    ///
    /// # Safety
    /// The set is not in use, and its binding is that of an image, which outlives its use.
    pub unsafe fn write_image(&self, view: vk::ImageView) {
        let info = [vk::DescriptorImageInfo::default()
            .image_view(view)
            .image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)];
        // SAFETY: passed on to the caller.
        unsafe { self.write(0, &info, vk::WriteDescriptorSet::image_info) };
    }
}

/// The layout of a pipeline.
pub(crate) struct PipelineLayout {
    gpu: Arc<Gpu>,
    pub(crate) raw: vk::PipelineLayout,
}

impl PipelineLayout {
    /// With these sets, and so many bytes of push constants for compute.
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
        let ranges = if push_bytes > 0 { &push[..] } else { &[] };
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
    /// Binds sets and pushes constants; both are of this layout.
    pub fn bind(
        &self,
        recorder: &Recorder<'_>,
        sets: &[vk::DescriptorSet],
        push: &impl bytemuck::NoUninit,
    ) {
        let (device, raw) = (recorder.device(), recorder.bindings());
        // SAFETY: the recorder's contract; sets and constants are of this layout.
        unsafe {
            device.cmd_bind_descriptor_sets(
                raw,
                vk::PipelineBindPoint::COMPUTE,
                self.raw,
                0,
                sets,
                &[],
            );
            device.cmd_push_constants(
                raw,
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
        // SAFETY: owners drop the layout after the pipelines that were made with it are done.
        unsafe { self.gpu.device.destroy_pipeline_layout(self.raw, None) };
    }
}

/// All of a buffer, for a descriptor.
pub(crate) fn whole(buffer: &Buffer) -> vk::DescriptorBufferInfo {
    vk::DescriptorBufferInfo::default()
        .buffer(buffer.handle())
        .range(vk::WHOLE_SIZE)
}
