//! patch: the colours of superpixels, drawn into a host's image.

use super::{FrameLayout, spirv};
use crate::vulkan::{Constants, Pipeline, Recorder, Shader, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Draws superpixels and leaves all other pixels as they are.
pub(crate) struct Patch {
    layout: Arc<FrameLayout>,
    pipeline: Arc<Pipeline>,
}

impl Patch {
    /// Makes the pipeline for images of a format that hold linear light or, `encoded`, sRGB codes as plain numbers.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(
        layout: &Arc<FrameLayout>,
        format: vk::Format,
        encoded: bool,
    ) -> Result<Self, VulkanError> {
        let constants = Constants::new().flag(0, encoded);
        let variant = format.as_raw() as u32;
        let pipeline = layout.cached(spirv::PATCH_FRAGMENT, &constants, variant, || {
            pipeline(layout, &constants, format)
        })?;
        Ok(Self {
            layout: layout.clone(),
            pipeline,
        })
    }

    /// Records it into a view of so many pixels, in the layout `COLOR_ATTACHMENT_OPTIMAL`.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        set: vk::DescriptorSet,
        view: vk::ImageView,
        [width, height]: [u32; 2],
    ) {
        let (device, raw) = (recorder.device(), recorder.raw());
        let area = vk::Rect2D {
            offset: vk::Offset2D::default(),
            extent: vk::Extent2D { width, height },
        };
        let color = [vk::RenderingAttachmentInfo::default()
            .image_view(view)
            .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
            .load_op(vk::AttachmentLoadOp::LOAD)
            .store_op(vk::AttachmentStoreOp::STORE)];
        let info = vk::RenderingInfo::default()
            .render_area(area)
            .layer_count(1)
            .color_attachments(&color);
        let viewport = vk::Viewport {
            width: width as f32,
            height: height as f32,
            max_depth: 1.0,
            ..vk::Viewport::default()
        };
        // SAFETY: the recorder's contract; the view is in the layout named, the set of the pipeline's layout.
        unsafe { device.cmd_begin_rendering(raw, &info) };
        recorder.bind(&self.pipeline);
        // SAFETY: as above.
        unsafe {
            device.cmd_set_viewport(raw, 0, &[viewport]);
            device.cmd_set_scissor(raw, 0, &[area]);
            device.cmd_bind_descriptor_sets(
                raw,
                vk::PipelineBindPoint::GRAPHICS,
                self.layout.pipeline,
                0,
                &[set],
                &[],
            );
            device.cmd_draw(raw, 3, 1, 0, 0);
            device.cmd_end_rendering(raw);
        }
    }
}

fn pipeline(
    layout: &FrameLayout,
    constants: &Constants,
    format: vk::Format,
) -> Result<Pipeline, VulkanError> {
    let gpu = &layout.gpu;
    let vertex = Shader::new(gpu, spirv::PATCH_VERTEX)?;
    let fragment = Shader::new(gpu, spirv::PATCH_FRAGMENT)?;
    let (map, data) = constants.packed();
    let specialization = vk::SpecializationInfo::default()
        .map_entries(&map)
        .data(&data);
    let stage = |stage, shader: &Shader| {
        vk::PipelineShaderStageCreateInfo::default()
            .stage(stage)
            .module(shader.raw)
            .name(c"main")
    };
    let stages = [
        stage(vk::ShaderStageFlags::VERTEX, &vertex),
        stage(vk::ShaderStageFlags::FRAGMENT, &fragment).specialization_info(&specialization),
    ];
    let input = vk::PipelineVertexInputStateCreateInfo::default();
    let assembly = vk::PipelineInputAssemblyStateCreateInfo::default()
        .topology(vk::PrimitiveTopology::TRIANGLE_LIST);
    let viewport = vk::PipelineViewportStateCreateInfo::default()
        .viewport_count(1)
        .scissor_count(1);
    let rasterization = vk::PipelineRasterizationStateCreateInfo::default().line_width(1.0);
    let multisample = vk::PipelineMultisampleStateCreateInfo::default()
        .rasterization_samples(vk::SampleCountFlags::TYPE_1);
    let attachments = [vk::PipelineColorBlendAttachmentState::default()
        .color_write_mask(vk::ColorComponentFlags::RGBA)];
    let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments);
    let dynamic = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
    let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&dynamic);
    let formats = [format];
    let mut rendering =
        vk::PipelineRenderingCreateInfo::default().color_attachment_formats(&formats);
    let info = vk::GraphicsPipelineCreateInfo::default()
        .stages(&stages)
        .vertex_input_state(&input)
        .input_assembly_state(&assembly)
        .viewport_state(&viewport)
        .rasterization_state(&rasterization)
        .multisample_state(&multisample)
        .color_blend_state(&blend)
        .dynamic_state(&dynamic)
        .layout(layout.pipeline)
        .push_next(&mut rendering);
    // SAFETY: all structures live until after the call; the layout covers what the shaders bind.
    let pipelines = unsafe {
        gpu.device
            .create_graphics_pipelines(vk::PipelineCache::null(), &[info], None)
    }
    .map_err(|(_, e)| VulkanError::of("vkCreateGraphicsPipelines")(e))?;
    Ok(Pipeline::from_raw(
        gpu,
        pipelines.first().copied().unwrap_or_default(),
        vk::PipelineBindPoint::GRAPHICS,
    ))
}
