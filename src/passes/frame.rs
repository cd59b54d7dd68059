//! What all passes share: the uniform block, the counters and the descriptor layout of `shaders/include/frame.glsl`.

use crate::vulkan::{Constants, Gpu, Pipeline, VulkanError, compute_pipeline};
use ash::vk;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// The uniform block `Frame`; the shader's comments say what the fields are.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[allow(missing_docs)]
pub struct FrameUniform {
    pub transform: [f32; 16],
    pub eye: [f32; 4],
    pub view_direction: [f32; 4],
    pub background: [f32; 4],
    pub raster_scale: [f32; 2],
    pub raster_offset: [f32; 2],
    pub origin: [f32; 2],
    pub size: [u32; 2],
    pub tiles: [u32; 2],
    pub interior_low: [u32; 2],
    pub interior_high: [u32; 2],
    pub gap: [f32; 2],
    pub vertex_count: u32,
    pub triangle_count: u32,
    pub first_mask: u32,
    pub first_blend: u32,
    pub sample_count: u32,
    pub pair_capacity: u32,
    pub list_capacity: u32,
    pub record_capacity: u32,
    pub bin_count: u32,
    pub light_count: u32,
    pub contrast: u32,
    pub exposure: f32,
    pub footprint: f32,
    pub reach: f32,
    pub group_count: u32,
}

/// Indices into the buffer of counters, as in `shaders/include/counters.glsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
#[repr(usize)]
pub enum Counter {
    Superpixels,
    Tiles,
    Survivors,
    Large,
    Outside,
    Backfacing,
    Degenerate,
    Untouching,
    RoundFirst,
    NextTile,
    Unfinished,
    Records,
    PlainTiles,
    MaskedTiles,
    BlendedTiles,
    UnlistedTiles,
    Rounds,
    CandidatesTotal,
    RecordsTotal,
    ShadedTotal,
    UnlistedTotal,
    Pairs,
    Thin,
    /// Superpixels that the first few of their samples did not settle.
    Resampled,
    PlainLeft,
    MaskedLeft,
}

impl Counter {
    /// Length of the buffer of counters.
    pub const COUNT: usize = 32;
}

/// Indices of indirect dispatches, as in `shaders/include/counters.glsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
#[repr(u32)]
pub enum Argument {
    Cull,
    BinSmall,
    BinLarge,
    Setup,
    SamplePlain,
    SampleMasked,
    SampleBlended,
    SampleUnlisted,
    Sort,
    Thin,
    Groups,
    PlainLeft,
    MaskedLeft,
    /// The first material bin's; the others follow.
    Shade,
}

/// How a binding of set 0 is used.
const BINDINGS: [(u32, vk::DescriptorType); 46] = {
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
        (11, T::STORAGE_TEXEL_BUFFER),
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
    ]
};

/// Textures of a material bin, set 1.
const TEXTURES: u32 = 5;

/// What tells one pipeline from another: its shader, its constants, and a variant of its fixed state.
type PipelineKey = (usize, Constants, u32);

/// The layout of both descriptor sets and of every pipeline, and the pipelines made so far: frames of other sizes,
/// poses and scenes use them again.
pub struct FrameLayout {
    pub(crate) gpu: Arc<Gpu>,
    pub(crate) frame_set: vk::DescriptorSetLayout,
    pub(crate) texture_set: vk::DescriptorSetLayout,
    pub(crate) pipeline: vk::PipelineLayout,
    pipelines: Mutex<HashMap<PipelineKey, Arc<Pipeline>>>,
}

impl FrameLayout {
    /// Makes the layouts.
    ///
    /// # Errors
    /// [`VulkanError::Call`] if the driver refuses them.
    pub fn new(gpu: &Arc<Gpu>) -> Result<Arc<Self>, VulkanError> {
        let stages = vk::ShaderStageFlags::VERTEX
            | vk::ShaderStageFlags::FRAGMENT
            | vk::ShaderStageFlags::COMPUTE;
        let frame = BINDINGS.map(|(binding, kind)| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(binding)
                .descriptor_type(kind)
                .descriptor_count(1)
                .stage_flags(stages)
        });
        let textures: Vec<_> = (0..TEXTURES)
            .map(|binding| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding)
                    .descriptor_type(vk::DescriptorType::COMBINED_IMAGE_SAMPLER)
                    .descriptor_count(1)
                    .stage_flags(vk::ShaderStageFlags::COMPUTE)
            })
            .collect();
        let mut layout = Self {
            gpu: gpu.clone(),
            frame_set: vk::DescriptorSetLayout::null(),
            texture_set: vk::DescriptorSetLayout::null(),
            pipeline: vk::PipelineLayout::null(),
            pipelines: Mutex::default(),
        };
        // SAFETY: plain creations on a live device; handles made before a failure are destroyed by `Drop`.
        unsafe {
            let make = |bindings: &[vk::DescriptorSetLayoutBinding<'_>]| {
                let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(bindings);
                gpu.device
                    .create_descriptor_set_layout(&info, None)
                    .map_err(VulkanError::of("vkCreateDescriptorSetLayout"))
            };
            layout.frame_set = make(&frame)?;
            layout.texture_set = make(&textures)?;
            let sets = [layout.frame_set, layout.texture_set];
            let push = [vk::PushConstantRange {
                stage_flags: vk::ShaderStageFlags::COMPUTE,
                offset: 0,
                size: 16,
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
        let mut known = self
            .pipelines
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        if let Some(pipeline) = known.get(&key) {
            return Ok(pipeline.clone());
        }
        let pipeline = Arc::new(make()?);
        known.insert(key, pipeline.clone());
        Ok(pipeline)
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
                descriptor_count: bins * TEXTURES,
            });
        }
        let info = vk::DescriptorPoolCreateInfo::default()
            .max_sets(frames + bins)
            .pool_sizes(&sizes);
        // SAFETY: plain creation on a live device.
        let raw = unsafe { self.gpu.device.create_descriptor_pool(&info, None) }
            .map_err(VulkanError::of("vkCreateDescriptorPool"))?;
        Ok(DescriptorPool {
            gpu: self.gpu.clone(),
            raw,
        })
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
        }
    }
}

/// A pool whose sets go with it.
pub(crate) struct DescriptorPool {
    gpu: Arc<Gpu>,
    raw: vk::DescriptorPool,
}

impl DescriptorPool {
    pub(crate) fn allocate(
        &self,
        layout: vk::DescriptorSetLayout,
    ) -> Result<vk::DescriptorSet, VulkanError> {
        let layouts = [layout];
        let info = vk::DescriptorSetAllocateInfo::default()
            .descriptor_pool(self.raw)
            .set_layouts(&layouts);
        // SAFETY: the pool and the layout are alive.
        let sets = unsafe { self.gpu.device.allocate_descriptor_sets(&info) }
            .map_err(VulkanError::of("vkAllocateDescriptorSets"))?;
        Ok(sets.first().copied().unwrap_or_default())
    }
}

impl Drop for DescriptorPool {
    fn drop(&mut self) {
        // SAFETY: owners drop the pool after the frames that use its sets.
        unsafe { self.gpu.device.destroy_descriptor_pool(self.raw, None) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shader_constant(name: &str) -> Option<usize> {
        include_str!("../../shaders/include/counters.glsl")
            .lines()
            .find_map(|line| {
                let mut words = line.split_whitespace();
                (words.next() == Some("#define") && words.next() == Some(name))
                    .then(|| words.next()?.parse().ok())
                    .flatten()
            })
    }

    fn shouted(name: &str) -> String {
        name.chars()
            .enumerate()
            .flat_map(|(i, c)| {
                (i > 0 && c.is_uppercase())
                    .then_some('_')
                    .into_iter()
                    .chain(c.to_uppercase())
            })
            .collect()
    }

    #[test]
    fn counters_and_arguments_are_the_shaders() {
        use Counter as C;
        for counter in [
            C::Superpixels,
            C::Tiles,
            C::Survivors,
            C::Large,
            C::Outside,
            C::Backfacing,
            C::Degenerate,
            C::Untouching,
            C::RoundFirst,
            C::NextTile,
            C::Unfinished,
            C::Records,
            C::PlainTiles,
            C::MaskedTiles,
            C::BlendedTiles,
            C::UnlistedTiles,
            C::Rounds,
            C::CandidatesTotal,
            C::RecordsTotal,
            C::ShadedTotal,
            C::UnlistedTotal,
            C::Pairs,
            C::Thin,
            C::Resampled,
            C::PlainLeft,
            C::MaskedLeft,
        ] {
            let name = format!("COUNTER_{}", shouted(&format!("{counter:?}")));
            assert_eq!(shader_constant(&name), Some(counter as usize), "{name}");
        }
        assert_eq!(shader_constant("COUNTER_COUNT"), Some(Counter::COUNT));
        use Argument as A;
        for argument in [
            A::Cull,
            A::BinSmall,
            A::BinLarge,
            A::Setup,
            A::SamplePlain,
            A::SampleMasked,
            A::SampleBlended,
            A::SampleUnlisted,
            A::Sort,
            A::Thin,
            A::Groups,
            A::PlainLeft,
            A::MaskedLeft,
            A::Shade,
        ] {
            let name = format!("ARGUMENT_{}", shouted(&format!("{argument:?}")));
            assert_eq!(shader_constant(&name), Some(argument as usize), "{name}");
        }
    }

    /// Walks the block by std140's rules and compares each member's offset with the host struct's.
    #[test]
    fn the_uniform_block_is_the_shaders() {
        let text = include_str!("../../shaders/include/frame.glsl");
        let block = text
            .split("uniform Frame {")
            .nth(1)
            .and_then(|rest| rest.split("} frame;").next())
            .unwrap();
        let mut offset = 0_usize;
        let mut offsets = Vec::new();
        for line in block.lines() {
            let code = line
                .split("//")
                .next()
                .unwrap()
                .trim()
                .trim_end_matches(';');
            let Some((kind, name)) = code.split_once(' ') else {
                continue;
            };
            let (size, align) = match kind {
                "mat4" => (64, 16),
                "vec4" => (16, 16),
                "vec2" | "uvec2" => (8, 8),
                "uint" | "float" => (4, 4),
                other => panic!("an unknown type {other}"),
            };
            offset = offset.next_multiple_of(align);
            offsets.push((name.to_owned(), offset));
            offset += size;
        }
        macro_rules! host {
            ($($field:ident),*) => { [$((stringify!($field).to_owned(), std::mem::offset_of!(FrameUniform, $field))),*] };
        }
        let host = host!(
            transform,
            eye,
            view_direction,
            background,
            raster_scale,
            raster_offset,
            origin,
            size,
            tiles,
            interior_low,
            interior_high,
            gap,
            vertex_count,
            triangle_count,
            first_mask,
            first_blend,
            sample_count,
            pair_capacity,
            list_capacity,
            record_capacity,
            bin_count,
            light_count,
            contrast,
            exposure,
            footprint,
            reach,
            group_count
        );
        assert_eq!(offsets, host);
        assert_eq!(offset, size_of::<FrameUniform>());
    }
}
