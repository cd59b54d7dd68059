//! Pools of descriptor sets.

use crate::vulkan::{DescriptorSet, Gpu, VulkanError};
use ash::vk;
use std::sync::Arc;

/// A pool of descriptor sets, which are freed with it.
pub(crate) struct DescriptorPool {
    gpu: Arc<Gpu>,
    raw: vk::DescriptorPool,
}

impl DescriptorPool {
    /// Makes a pool of up to `sets` sets, with the numbers of descriptors in `sizes`.
    pub(crate) fn new(
        gpu: &Arc<Gpu>,
        sets: u32,
        sizes: &[vk::DescriptorPoolSize],
    ) -> Result<Self, VulkanError> {
        let info = vk::DescriptorPoolCreateInfo::default()
            .max_sets(sets)
            .pool_sizes(sizes);
        // SAFETY: plain creation on a live device.
        let raw = unsafe { gpu.device.create_descriptor_pool(&info, None) }
            .map_err(VulkanError::of("vkCreateDescriptorPool"))?;
        Ok(Self {
            gpu: gpu.clone(),
            raw,
        })
    }

    /// Allocates a set of a layout for which the pool has descriptors.
    pub(crate) fn allocate(
        &self,
        layout: vk::DescriptorSetLayout,
    ) -> Result<DescriptorSet, VulkanError> {
        let layouts = [layout];
        let info = vk::DescriptorSetAllocateInfo::default()
            .descriptor_pool(self.raw)
            .set_layouts(&layouts);
        // SAFETY: the pool and the layout are alive.
        let sets = unsafe { self.gpu.device.allocate_descriptor_sets(&info) }
            .map_err(VulkanError::of("vkAllocateDescriptorSets"))?;
        let raw = sets.first().copied().unwrap_or_default();
        Ok(DescriptorSet::new(&self.gpu, raw))
    }
}

impl Drop for DescriptorPool {
    fn drop(&mut self) {
        // SAFETY: owners drop the pool after the frames that use its sets.
        unsafe { self.gpu.device.destroy_descriptor_pool(self.raw, None) };
    }
}
