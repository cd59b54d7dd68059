//! Pipelines of any host, and changes of its images between them.

use crate::Failure;
use crate::device::{Device, Texture};
use ash::vk;
use gpc::host::ImageState;

impl Device {
    /// # Safety
    /// The words are SPIR-V.
    unsafe fn module(&self, spirv: &[u8]) -> Result<vk::ShaderModule, Failure> {
        let words = ash::util::read_spv(&mut std::io::Cursor::new(spirv))?;
        let info = vk::ShaderModuleCreateInfo::default().code(&words);
        // SAFETY: guaranteed by the caller.
        Ok(unsafe { self.raw.create_shader_module(&info, None) }?)
    }

    /// Makes a compute pipeline; its constant 0, if it has one, is `key`.
    ///
    /// # Safety
    /// Code and layout match.
    pub unsafe fn compute(&self, code: &[u8], layout: vk::PipelineLayout, key: u32) -> Result<vk::Pipeline, Failure> {
        let map = [vk::SpecializationMapEntry { constant_id: 0, offset: 0, size: 4 }];
        let data = key.to_ne_bytes();
        let specialization = vk::SpecializationInfo::default().map_entries(&map).data(&data);
        // SAFETY: guaranteed by the caller; a module may be destroyed once its pipeline is made.
        unsafe {
            let module = self.module(code)?;
            let stage = vk::PipelineShaderStageCreateInfo::default()
                .stage(vk::ShaderStageFlags::COMPUTE)
                .module(module)
                .name(c"main")
                .specialization_info(&specialization);
            let info = [vk::ComputePipelineCreateInfo::default().layout(layout).stage(stage)];
            let made = self.raw.create_compute_pipelines(vk::PipelineCache::null(), &info, None);
            self.raw.destroy_shader_module(module, None);
            Ok(made.map_err(|(_, error)| error)?[0])
        }
    }

    /// Makes a graphics pipeline without vertex attributes; with `depth`, it tests and writes reversed depth.
    ///
    /// # Safety
    /// Code and layout match.
    pub unsafe fn graphics(
        &self,
        layout: vk::PipelineLayout,
        [vertex, fragment]: [&[u8]; 2],
        color: vk::Format,
        depth: Option<vk::Format>,
        cull: vk::CullModeFlags,
    ) -> Result<vk::Pipeline, Failure> {
        // SAFETY: guaranteed by the caller.
        let modules = unsafe { [self.module(vertex)?, self.module(fragment)?] };
        let stage =
            |stage, module| vk::PipelineShaderStageCreateInfo::default().stage(stage).module(module).name(c"main");
        let stages =
            [stage(vk::ShaderStageFlags::VERTEX, modules[0]), stage(vk::ShaderStageFlags::FRAGMENT, modules[1])];
        let input = vk::PipelineVertexInputStateCreateInfo::default();
        let assembly =
            vk::PipelineInputAssemblyStateCreateInfo::default().topology(vk::PrimitiveTopology::TRIANGLE_LIST);
        let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
        let rasterization = vk::PipelineRasterizationStateCreateInfo::default()
            .cull_mode(cull)
            .front_face(vk::FrontFace::COUNTER_CLOCKWISE)
            .line_width(1.0);
        let multisample =
            vk::PipelineMultisampleStateCreateInfo::default().rasterization_samples(vk::SampleCountFlags::TYPE_1);
        let tests = vk::PipelineDepthStencilStateCreateInfo::default()
            .depth_test_enable(depth.is_some())
            .depth_write_enable(depth.is_some())
            .depth_compare_op(vk::CompareOp::GREATER);
        let attachments =
            [vk::PipelineColorBlendAttachmentState::default().color_write_mask(vk::ColorComponentFlags::RGBA)];
        let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments);
        let dynamic = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
        let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&dynamic);
        let formats = [color];
        let mut rendering = vk::PipelineRenderingCreateInfo::default()
            .color_attachment_formats(&formats)
            .depth_attachment_format(depth.unwrap_or(vk::Format::UNDEFINED));
        let info = [vk::GraphicsPipelineCreateInfo::default()
            .stages(&stages)
            .vertex_input_state(&input)
            .input_assembly_state(&assembly)
            .viewport_state(&viewport)
            .rasterization_state(&rasterization)
            .multisample_state(&multisample)
            .depth_stencil_state(&tests)
            .color_blend_state(&blend)
            .dynamic_state(&dynamic)
            .layout(layout)
            .push_next(&mut rendering)];
        // SAFETY: guaranteed by the caller; modules may be destroyed once their pipeline is made.
        unsafe {
            let raw = &self.raw;
            let made = raw.create_graphics_pipelines(vk::PipelineCache::null(), &info, None);
            for module in modules {
                raw.destroy_shader_module(module, None);
            }
            Ok(made.map_err(|(_, error)| error)?[0])
        }
    }

    /// Records the transition of a texture with one level from one state to another.
    ///
    /// # Safety
    /// `commands` is being recorded for the device outside of a render pass; the texture outlives their execution and is in the
    /// first state, unless that is undefined.
    pub unsafe fn change(&self, commands: vk::CommandBuffer, texture: &Texture<'_>, from: ImageState, to: ImageState) {
        let barriers = [vk::ImageMemoryBarrier2::default()
            .src_stage_mask(from.stage)
            .src_access_mask(from.access)
            .dst_stage_mask(to.stage)
            .dst_access_mask(to.access)
            .old_layout(from.layout)
            .new_layout(to.layout)
            .image(texture.raw)
            .subresource_range(texture.range(1))];
        let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
        // SAFETY: guaranteed by the caller.
        unsafe { self.raw.cmd_pipeline_barrier2(commands, &info) };
    }
}

impl Texture<'_> {
    /// The first levels of the texture.
    pub fn range(&self, levels: u32) -> vk::ImageSubresourceRange {
        vk::ImageSubresourceRange {
            aspect_mask: self.aspect,
            base_mip_level: 0,
            level_count: levels,
            base_array_layer: 0,
            layer_count: 1,
        }
    }
}
