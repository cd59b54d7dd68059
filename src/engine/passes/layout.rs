//! The layout of the descriptor sets and pipelines that all passes share, and the pipelines made so far.

use super::pipelines::Pipelines;
use super::pool::DescriptorPool;
use crate::vulkan::{Constants, Gpu, Limits, PUSH_STAGES, Pipeline, VulkanError, compute_pipeline};
use ash::vk;
use std::sync::{Arc, Mutex, PoisonError};

/// Textures of a material that differ, at the most. With one for the environment, these are the samplers that every Vulkan
/// device has.
pub(crate) const SLOTS: usize = 15;

/// Bytes of push constants: a matrix and four words, as `raster` has them.
pub(crate) const PUSH_BYTES: u32 = 80;

/// The bindings of set 0.
const BINDINGS: [(u32, vk::DescriptorType); 58] = {
    use vk::DescriptorType as T;
    [
        (0, T::UNIFORM_BUFFER),
        (1, T::UNIFORM_TEXEL_BUFFER),
        (2, T::UNIFORM_TEXEL_BUFFER),
        (3, T::UNIFORM_TEXEL_BUFFER),
        (4, T::UNIFORM_TEXEL_BUFFER),
        (5, T::UNIFORM_TEXEL_BUFFER),
        (6, T::UNIFORM_TEXEL_BUFFER),
        (7, T::UNIFORM_TEXEL_BUFFER),
        (8, T::STORAGE_BUFFER),
        (9, T::UNIFORM_TEXEL_BUFFER),
        (10, T::UNIFORM_TEXEL_BUFFER),
        (11, T::UNIFORM_TEXEL_BUFFER),
        (12, T::SAMPLED_IMAGE),
        (13, T::SAMPLED_IMAGE),
        (14, T::SAMPLED_IMAGE),
        (15, T::SAMPLED_IMAGE),
        (16, T::UNIFORM_TEXEL_BUFFER),
        (17, T::STORAGE_BUFFER),
        (18, T::STORAGE_BUFFER),
        (19, T::STORAGE_BUFFER),
        (20, T::STORAGE_BUFFER),
        (21, T::STORAGE_BUFFER),
        (22, T::STORAGE_BUFFER),
        (23, T::STORAGE_BUFFER),
        (24, T::UNIFORM_TEXEL_BUFFER),
        (25, T::STORAGE_BUFFER),
        (26, T::STORAGE_BUFFER),
        (27, T::UNIFORM_TEXEL_BUFFER),
        (28, T::STORAGE_BUFFER),
        (29, T::UNIFORM_TEXEL_BUFFER),
        (30, T::STORAGE_BUFFER),
        (31, T::STORAGE_BUFFER),
        (32, T::UNIFORM_TEXEL_BUFFER),
        (33, T::STORAGE_BUFFER),
        (34, T::STORAGE_BUFFER),
        (35, T::STORAGE_TEXEL_BUFFER),
        (36, T::STORAGE_BUFFER),
        (37, T::STORAGE_BUFFER),
        (38, T::UNIFORM_TEXEL_BUFFER),
        (39, T::STORAGE_BUFFER),
        (40, T::SAMPLED_IMAGE),
        (41, T::STORAGE_BUFFER),
        (42, T::UNIFORM_TEXEL_BUFFER),
        (43, T::UNIFORM_TEXEL_BUFFER),
        (44, T::UNIFORM_TEXEL_BUFFER),
        (45, T::STORAGE_BUFFER),
        (46, T::UNIFORM_TEXEL_BUFFER),
        (47, T::UNIFORM_TEXEL_BUFFER),
        (48, T::UNIFORM_TEXEL_BUFFER),
        (49, T::UNIFORM_TEXEL_BUFFER),
        (50, T::STORAGE_TEXEL_BUFFER),
        (51, T::STORAGE_TEXEL_BUFFER),
        (52, T::STORAGE_TEXEL_BUFFER),
        (53, T::COMBINED_IMAGE_SAMPLER),
        (54, T::UNIFORM_BUFFER),
        (55, T::UNIFORM_TEXEL_BUFFER),
        (56, T::UNIFORM_TEXEL_BUFFER),
        (57, T::UNIFORM_TEXEL_BUFFER),
    ]
};

/// What a binding of set 0 shows.
pub(crate) fn descriptor_type(binding: u32) -> vk::DescriptorType {
    BINDINGS
        .iter()
        .find(|(known, _)| *known == binding)
        .map_or(vk::DescriptorType::default(), |(_, kind)| *kind)
}

/// The layout of both descriptor sets and of every pipeline, and the pipelines made so far.
pub struct FrameLayout {
    pub(crate) gpu: Arc<Gpu>,
    pub(crate) frame_set: vk::DescriptorSetLayout,
    pub(crate) texture_set: vk::DescriptorSetLayout,
    pub(crate) pipeline: vk::PipelineLayout,
    /// Fixed in the layout, so that sets are whole where nothing has an environment.
    environment_sampler: vk::Sampler,
    pipelines: Mutex<Pipelines>,
}

impl FrameLayout {
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
            .binding(0)
            .descriptor_type(vk::DescriptorType::COMBINED_IMAGE_SAMPLER)
            .descriptor_count(SLOTS as u32)
            .stage_flags(vk::ShaderStageFlags::COMPUTE);
        let mut layout = Self {
            gpu: gpu.clone(),
            frame_set: vk::DescriptorSetLayout::null(),
            texture_set: vk::DescriptorSetLayout::null(),
            pipeline: vk::PipelineLayout::null(),
            environment_sampler: vk::Sampler::null(),
            pipelines: Mutex::new(Pipelines::new(gpu.limits().max_unused_pipelines)),
        };
        // SAFETY: plain creations on a live device; handles made before a failure are destroyed by `Drop`.
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
            let frame = BINDINGS.map(|(binding, kind)| {
                let one = vk::DescriptorSetLayoutBinding::default()
                    .binding(binding)
                    .descriptor_type(kind)
                    .descriptor_count(1)
                    .stage_flags(stages);
                if kind == vk::DescriptorType::COMBINED_IMAGE_SAMPLER {
                    one.immutable_samplers(&samplers)
                } else {
                    one
                }
            });
            layout.frame_set = make(&frame)?;
            layout.texture_set = make(&[textures])?;
            let sets = [layout.frame_set, layout.texture_set];
            let push = [vk::PushConstantRange {
                stage_flags: PUSH_STAGES,
                offset: 0,
                size: PUSH_BYTES,
            }];
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

    /// The size of the subgroups of kernels that count on them.
    pub(crate) fn subgroup(&self) -> Option<u32> {
        Some(self.gpu.limits().subgroup_size)
    }

    /// Adds the constants of `shaders/include/lanes.glsl`, where `lanes` invocations of a subgroup are used.
    pub(crate) fn lane_constants(&self, constants: Constants, lanes: u32) -> Constants {
        let Limits {
            subgroup_size,
            can_require_subgroup_size,
            ..
        } = *self.gpu.limits();
        let sure = can_require_subgroup_size && lanes == subgroup_size;
        constants.with(1, lanes).flag(24, !sure)
    }

    /// A compute pipeline of one of the crate's shaders; `subgroup` fixes the size of its subgroups.
    pub(crate) fn compute(
        &self,
        code: &'static [u8],
        constants: &Constants,
        subgroup: Option<u32>,
    ) -> Result<Arc<Pipeline>, VulkanError> {
        self.cached(code, constants, subgroup.unwrap_or(0), || {
            compute_pipeline(&self.gpu, self.pipeline, code, constants, subgroup)
        })
    }

    /// The pipeline of a shader, constants and variant, made where it is not known yet.
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
        // Not under the lock, so that several threads make theirs at once.
        let made = make()?;
        Ok(known().add(key, made))
    }

    /// A pool for `frames` sets 0 and `bins` sets 1.
    pub(crate) fn pool(&self, frames: u32, bins: u32) -> Result<DescriptorPool, VulkanError> {
        let mut sizes: Vec<vk::DescriptorPoolSize> = Vec::new();
        for (_, kind) in BINDINGS {
            match sizes.iter_mut().find(|size| size.ty == kind) {
                Some(size) => size.descriptor_count += frames,
                None => sizes.push(vk::DescriptorPoolSize {
                    ty: kind,
                    descriptor_count: frames,
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
        let all: Vec<_> = BINDINGS
            .iter()
            .map(|(_, kind)| *kind)
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
        // Every device has 4 storage images, 12 uniform buffers and 16 samplers.
        assert!(count(&[T::STORAGE_TEXEL_BUFFER]) <= 4);
        assert!(count(&[T::UNIFORM_BUFFER]) <= 12);
        assert!(count(&[T::COMBINED_IMAGE_SAMPLER]) <= 16);
    }
}
