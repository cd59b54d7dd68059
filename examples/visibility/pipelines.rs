//! The host's pipelines, and its materials, which shade the library's samples.

use crate::Failure;
use crate::device::Device;
use crate::meshes::KEYS;
use ash::vk;
use gpc::host::{ShadeSamples, VisibilitySamples, check_shader};

/// Formats of the images that the host draws.
pub const IDS: vk::Format = vk::Format::R32_UINT;
pub const DEPTH: vk::Format = vk::Format::D32_SFLOAT;
pub const COLOR: vk::Format = vk::Format::R32G32B32A32_SFLOAT;

/// Descriptor type of each binding in `shaders/host.glsl` and `shaders/posed.glsl`.
pub const BINDINGS: [vk::DescriptorType; 11] = {
    let mut kinds = [vk::DescriptorType::STORAGE_BUFFER; 11];
    kinds[8] = vk::DescriptorType::COMBINED_IMAGE_SAMPLER;
    kinds[9] = vk::DescriptorType::COMBINED_IMAGE_SAMPLER;
    kinds[10] = vk::DescriptorType::SAMPLED_IMAGE;
    kinds
};

macro_rules! spirv {
    ($name:literal) => {
        include_bytes!(concat!("shaders/spirv/", $name, ".spv"))
    };
}
pub(crate) use spirv;

pub struct Pipelines<'a> {
    device: &'a Device,
    pub set_layout: vk::DescriptorSetLayout,
    /// Layout of the host's own passes: the host's set, and 16 bytes of push constants.
    pub layout: vk::PipelineLayout,
    /// Layout for shading samples: the library's set, and the host's.
    samples_layout: vk::PipelineLayout,
    pub pose: vk::Pipeline,
    pub ids: vk::Pipeline,
    /// Pipeline for surfaces with holes, seen from both sides.
    pub ids_masked: vk::Pipeline,
    pub screen: vk::Pipeline,
    samples: Vec<vk::Pipeline>,
    pub sampler: vk::Sampler,
}

impl<'a> Pipelines<'a> {
    pub fn new(device: &'a Device, samples_set: vk::DescriptorSetLayout) -> Result<Self, Failure> {
        let raw = &device.raw;
        // SAFETY: plain creations whose structures live until after the calls. Handles that were made before a failure
        // leak, but the program ends then.
        unsafe {
            let all = vk::ShaderStageFlags::ALL;
            let bindings: Vec<_> = (0..)
                .zip(BINDINGS)
                .map(|(binding, kind)| {
                    vk::DescriptorSetLayoutBinding::default()
                        .binding(binding)
                        .descriptor_type(kind)
                        .descriptor_count(1)
                        .stage_flags(all)
                })
                .collect();
            let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
            let set_layout = raw.create_descriptor_set_layout(&info, None)?;
            let push = [vk::PushConstantRange { stage_flags: all, offset: 0, size: 16 }];
            let sets = [set_layout];
            let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets).push_constant_ranges(&push);
            let layout = raw.create_pipeline_layout(&info, None)?;
            let sets = [samples_set, set_layout];
            let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets);
            let samples_layout = raw.create_pipeline_layout(&info, None)?;
            let info = vk::SamplerCreateInfo::default()
                .mag_filter(vk::Filter::LINEAR)
                .min_filter(vk::Filter::LINEAR)
                .mipmap_mode(vk::SamplerMipmapMode::LINEAR)
                .max_lod(vk::LOD_CLAMP_NONE);
            let mut pipelines = Self {
                device,
                set_layout,
                layout,
                samples_layout,
                pose: vk::Pipeline::null(),
                ids: vk::Pipeline::null(),
                ids_masked: vk::Pipeline::null(),
                screen: vk::Pipeline::null(),
                samples: Vec::new(),
                sampler: raw.create_sampler(&info, None)?,
            };
            pipelines.pose = device.compute(spirv!("pose"), layout, 0)?;
            let stages = [&spirv!("ids_vertex")[..], &spirv!("ids_fragment")[..]];
            let back = vk::CullModeFlags::BACK;
            pipelines.ids = device.graphics(pipelines.layout, stages, IDS, Some(DEPTH), back)?;
            let stages = [&spirv!("ids_masked_vertex")[..], &spirv!("ids_masked_fragment")[..]];
            let none = vk::CullModeFlags::NONE;
            pipelines.ids_masked = device.graphics(pipelines.layout, stages, IDS, Some(DEPTH), none)?;
            let stages = [&spirv!("screen_vertex")[..], &spirv!("screen_fragment")[..]];
            pipelines.screen = device.graphics(pipelines.layout, stages, COLOR, None, none)?;
            // The library takes the version of the includes that the shader was compiled with.
            let words = ash::util::read_spv(&mut std::io::Cursor::new(spirv!("samples")))?;
            check_shader(&words)?;
            for key in 0..KEYS {
                let pipeline = device.compute(spirv!("samples"), samples_layout, key)?;
                pipelines.samples.push(pipeline);
            }
            Ok(pipelines)
        }
    }

    /// The host's materials, as the library calls them; `set` is the host's.
    pub fn materials(&self, set: vk::DescriptorSet) -> Materials<'_> {
        Materials { pipelines: self, set }
    }
}

impl Drop for Pipelines<'_> {
    fn drop(&mut self) {
        let raw = &self.device.raw;
        // SAFETY: every submission was waited for.
        unsafe {
            let all = self.samples.iter().copied();
            for pipeline in all.chain([self.pose, self.ids, self.ids_masked, self.screen]) {
                raw.destroy_pipeline(pipeline, None);
            }
            raw.destroy_pipeline_layout(self.samples_layout, None);
            raw.destroy_pipeline_layout(self.layout, None);
            raw.destroy_descriptor_set_layout(self.set_layout, None);
            raw.destroy_sampler(self.sampler, None);
        }
    }
}

/// The host's materials with the descriptor set of one frame.
pub struct Materials<'a> {
    pipelines: &'a Pipelines<'a>,
    set: vk::DescriptorSet,
}

impl ShadeSamples for Materials<'_> {
    fn record(&self, commands: vk::CommandBuffer, samples: &VisibilitySamples) {
        let Pipelines { device, samples_layout, samples: pipelines, .. } = self.pipelines;
        let raw = &device.raw;
        let sets = [samples.descriptor_set(), self.set];
        let compute = vk::PipelineBindPoint::COMPUTE;
        // Conditional rendering skips rounds that have nothing to do.
        let skipping = device.conditional_rendering.as_ref().zip(samples.condition());
        // SAFETY: the command buffer is being recorded; sets and pipelines have compatible layouts and outlive its
        // execution. Conditional rendering that is begun is ended.
        unsafe {
            if let Some((functions, word)) = skipping {
                let info = vk::ConditionalRenderingBeginInfoEXT::default().buffer(word);
                (functions.fp().cmd_begin_conditional_rendering_ext)(commands, &info);
            }
            raw.cmd_bind_descriptor_sets(commands, compute, *samples_layout, 0, &sets, &[]);
            for (key, pipeline) in (0..).zip(pipelines) {
                if let Some((arguments, offset)) = samples.dispatch(key) {
                    raw.cmd_bind_pipeline(commands, compute, *pipeline);
                    raw.cmd_dispatch_indirect(commands, arguments, offset);
                }
            }
            if let Some((functions, _)) = skipping {
                (functions.fp().cmd_end_conditional_rendering_ext)(commands);
            }
        }
    }
}
