//! Layout of the descriptor sets and pipelines that all passes share, and a cache of pipelines.

use super::cache::Pipelines;
use super::pool::DescriptorPool;
use crate::engine::passes::spirv::{self, frame_set};
use crate::vulkan::{
    Compiled, Constants, Gpu, PUSH_STAGES, Pipeline, Specialized, VulkanError, compute_pipeline,
};
use ash::vk;
use std::sync::{Arc, Mutex, PoisonError};

/// Largest number of distinct textures of a material. Together with the environment map, these need 16 samplers, as
/// many as every Vulkan device supports.
pub(crate) const SLOTS: usize = spirv::shade_set::TEXTURES.count as usize;

/// Number of bytes of push constants: a matrix and four words, for `raster`.
pub(crate) const PUSH_BYTES: u32 = 80;

/// Layouts of both descriptor sets and of the pipelines, and a cache of pipelines.
pub struct FrameLayout {
    pub(crate) gpu: Arc<Gpu>,
    pub(crate) frame_set: vk::DescriptorSetLayout,
    pub(crate) texture_set: vk::DescriptorSetLayout,
    pub(crate) pipeline: vk::PipelineLayout,
    /// Sampler of the environment, fixed in the layout so that sets are complete even without an environment.
    environment_sampler: vk::Sampler,
    pipelines: Mutex<Pipelines>,
}

impl FrameLayout {
    /// The push constants of every pipeline.
    pub(crate) const PUSH_RANGE: vk::PushConstantRange = vk::PushConstantRange {
        stage_flags: PUSH_STAGES,
        offset: 0,
        size: PUSH_BYTES,
    };

    /// Makes the layouts.
    ///
    /// # Errors
    /// [`VulkanError::Call`] if the driver refuses them.
    pub(crate) fn new(gpu: &Arc<Gpu>) -> Result<Arc<Self>, VulkanError> {
        let stages = vk::ShaderStageFlags::VERTEX
            | vk::ShaderStageFlags::FRAGMENT
            | vk::ShaderStageFlags::COMPUTE;
        let trilinear = vk::SamplerCreateInfo::default()
            .mag_filter(vk::Filter::LINEAR)
            .min_filter(vk::Filter::LINEAR)
            .mipmap_mode(vk::SamplerMipmapMode::LINEAR)
            .address_mode_u(vk::SamplerAddressMode::CLAMP_TO_EDGE)
            .address_mode_v(vk::SamplerAddressMode::CLAMP_TO_EDGE)
            .address_mode_w(vk::SamplerAddressMode::CLAMP_TO_EDGE)
            .max_lod(vk::LOD_CLAMP_NONE);
        let textures = vk::DescriptorSetLayoutBinding::default()
            .binding(spirv::shade_set::TEXTURES.number)
            .descriptor_type(spirv::shade_set::TEXTURES.kind)
            .descriptor_count(spirv::shade_set::TEXTURES.count)
            .stage_flags(vk::ShaderStageFlags::COMPUTE);
        let mut layout = Self {
            gpu: gpu.clone(),
            frame_set: vk::DescriptorSetLayout::null(),
            texture_set: vk::DescriptorSetLayout::null(),
            pipeline: vk::PipelineLayout::null(),
            environment_sampler: vk::Sampler::null(),
            pipelines: Mutex::new(Pipelines::new(gpu.limits().max_unused_pipelines)),
        };
        // SAFETY: plain creations on a live device; `Drop` destroys handles that were made before a failure.
        unsafe {
            let make = |bindings: &[vk::DescriptorSetLayoutBinding<'_>]| {
                let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(bindings);
                gpu.device
                    .create_descriptor_set_layout(&info, None)
                    .map_err(VulkanError::of("vkCreateDescriptorSetLayout"))
            };
            layout.environment_sampler = gpu
                .device
                .create_sampler(&trilinear, None)
                .map_err(VulkanError::of("vkCreateSampler"))?;
            let samplers = [layout.environment_sampler];
            let frame = frame_set::ALL.map(|binding| {
                let one = vk::DescriptorSetLayoutBinding::default()
                    .binding(binding.number)
                    .descriptor_type(binding.kind)
                    .descriptor_count(binding.count)
                    .stage_flags(stages);
                if binding == frame_set::ENVIRONMENT_MAP {
                    one.immutable_samplers(&samplers)
                } else {
                    one
                }
            });
            layout.frame_set = make(&frame)?;
            layout.texture_set = make(&[textures])?;
            let sets = [layout.frame_set, layout.texture_set];
            let push = [Self::PUSH_RANGE];
            let info = vk::PipelineLayoutCreateInfo::default()
                .set_layouts(&sets)
                .push_constant_ranges(&push);
            layout.pipeline = gpu
                .device
                .create_pipeline_layout(&info, None)
                .map_err(VulkanError::of("vkCreatePipelineLayout"))?;
        }
        Ok(Arc::new(layout))
    }

    /// Subgroup size of kernels that depend on it.
    pub(crate) fn subgroup(&self) -> Option<u32> {
        Some(self.gpu.limits().subgroup_size)
    }

    /// Whether kernels that use `lanes` invocations of a subgroup have to check the subgroup size: the constant
    /// `UNSURE` of `shaders/include/lanes.glsl`.
    pub(crate) fn is_unsure(&self, lanes: u32) -> bool {
        let limits = self.gpu.limits();
        !(limits.can_require_subgroup_size && lanes == limits.subgroup_size)
    }

    /// Pipeline of a compute shader of the crate; `subgroup` fixes the size of its subgroups.
    pub(crate) fn compute<S: Compiled>(
        &self,
        shader: &S,
        subgroup: Option<u32>,
    ) -> Result<Arc<Pipeline>, VulkanError> {
        self.compute_variant(S::code(), shader, subgroup)
    }

    /// Pipeline of a variant of a compute shader of the crate; `subgroup` fixes the size of its subgroups.
    pub(crate) fn compute_variant<S: Specialized>(
        &self,
        code: &'static [u8],
        shader: &S,
        subgroup: Option<u32>,
    ) -> Result<Arc<Pipeline>, VulkanError> {
        let constants = &shader.constants();
        let shader = (code, S::INTERFACE);
        let made = || compute_pipeline(&self.gpu, self.pipeline, shader, constants, subgroup);
        self.cached(code, constants, subgroup.unwrap_or(0), made)
    }

    /// Pipeline for a shader, constants and variant, from the cache or made by `make`.
    pub(crate) fn cached(
        &self,
        code: &'static [u8],
        constants: &Constants,
        variant: u32,
        make: impl FnOnce() -> Result<Pipeline, VulkanError>,
    ) -> Result<Arc<Pipeline>, VulkanError> {
        let key = (code.as_ptr() as usize, constants.clone(), variant);
        let known = || {
            self.pipelines
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
        };
        if let Some(pipeline) = known().get(&key) {
            return Ok(pipeline);
        }
        // The lock is not held here, so that several threads can make pipelines in parallel.
        let made = make()?;
        Ok(known().add(key, made))
    }

    /// Pool for `frames` sets 0 and `bins` sets 1.
    pub(crate) fn pool(&self, frames: u32, bins: u32) -> Result<DescriptorPool, VulkanError> {
        let mut sizes: Vec<vk::DescriptorPoolSize> = Vec::new();
        for binding in frame_set::ALL {
            let count = frames * binding.count;
            match sizes.iter_mut().find(|size| size.ty == binding.kind) {
                Some(size) => size.descriptor_count += count,
                None => sizes.push(vk::DescriptorPoolSize {
                    ty: binding.kind,
                    descriptor_count: count,
                }),
            }
        }
        sizes.retain(|size| size.descriptor_count > 0);
        if bins > 0 {
            sizes.push(vk::DescriptorPoolSize {
                ty: vk::DescriptorType::COMBINED_IMAGE_SAMPLER,
                descriptor_count: bins * SLOTS as u32,
            });
        }
        DescriptorPool::new(&self.gpu, frames + bins, &sizes)
    }
}

impl Drop for FrameLayout {
    fn drop(&mut self) {
        // SAFETY: owners drop the layout after the frames that use it; null handles are ignored.
        unsafe {
            self.gpu.device.destroy_pipeline_layout(self.pipeline, None);
            self.gpu
                .device
                .destroy_descriptor_set_layout(self.texture_set, None);
            self.gpu
                .device
                .destroy_descriptor_set_layout(self.frame_set, None);
            self.gpu
                .device
                .destroy_sampler(self.environment_sampler, None);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vulkan::Requirements;

    #[test]
    fn devices_are_asked_for_as_many_descriptors_as_there_are() {
        use vk::DescriptorType as T;
        let slots = std::iter::repeat_n(T::COMBINED_IMAGE_SAMPLER, SLOTS);
        let all: Vec<_> = frame_set::ALL
            .iter()
            .map(|binding| binding.kind)
            .chain(slots)
            .collect();
        let count = |kinds: &[T]| all.iter().filter(|kind| kinds.contains(kind)).count() as u32;
        assert_eq!(count(&[T::STORAGE_BUFFER]), Requirements::STORAGE_BUFFERS);
        assert_eq!(
            count(&[
                T::SAMPLED_IMAGE,
                T::COMBINED_IMAGE_SAMPLER,
                T::UNIFORM_TEXEL_BUFFER
            ]),
            Requirements::SAMPLED_IMAGES
        );
        assert_eq!(all.len() as u32 + 1, Requirements::RESOURCES);
        // Every device supports 4 storage images, 12 uniform buffers and 16 samplers.
        assert!(count(&[T::STORAGE_TEXEL_BUFFER]) <= 4);
        assert!(count(&[T::UNIFORM_BUFFER]) <= 12);
        assert!(count(&[T::COMBINED_IMAGE_SAMPLER]) <= 16);
    }
}
