//! Shader modules, specialisation and pipelines.

use super::{Gpu, Interface, Invocations, PassLayout, VulkanError};
use ash::vk;
use std::sync::Arc;

/// A shader module.
struct Shader {
    gpu: Arc<Gpu>,
    raw: vk::ShaderModule,
}

impl Shader {
    /// Makes a module from SPIR-V bytes of the crate.
    ///
    /// # Errors
    /// [`VulkanError::Call`] if the bytes are not SPIR-V or the driver refuses them.
    fn new(gpu: &Arc<Gpu>, spirv: &[u8]) -> Result<Self, VulkanError> {
        let words = ash::util::read_spv(&mut std::io::Cursor::new(spirv))
            .map_err(|_| VulkanError::Call { call: "reading SPIR-V", result: vk::Result::ERROR_INVALID_SHADER_NV })?;
        let info = vk::ShaderModuleCreateInfo::default().code(&words);
        // SAFETY: the words are the crate's own SPIR-V for Vulkan 1.3.
        let raw =
            unsafe { gpu.device.create_shader_module(&info, None) }.map_err(VulkanError::of("vkCreateShaderModule"))?;
        Ok(Self { gpu: gpu.clone(), raw })
    }
}

impl Drop for Shader {
    fn drop(&mut self) {
        // SAFETY: pipelines keep no reference to their modules.
        unsafe { self.gpu.device.destroy_shader_module(self.raw, None) };
    }
}

/// Values of specialisation constants by ID; every value has 4 bytes.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Constants {
    entries: Vec<(u32, u32)>,
}

impl Constants {
    /// Makes an empty list of constants.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an unsigned constant.
    #[must_use]
    pub fn with(mut self, id: u32, value: u32) -> Self {
        self.entries.push((id, value));
        self
    }

    /// Adds a boolean constant.
    #[must_use]
    pub fn flag(self, id: u32, value: bool) -> Self {
        self.with(id, u32::from(value))
    }

    /// Layout and data of the constants, as Vulkan takes them.
    pub(crate) fn packed(&self) -> (Vec<vk::SpecializationMapEntry>, Vec<u8>) {
        let map = self
            .entries
            .iter()
            .enumerate()
            .map(|(i, (id, _))| vk::SpecializationMapEntry { constant_id: *id, offset: 4 * i as u32, size: 4 })
            .collect();
        let data = self.entries.iter().flat_map(|(_, value)| value.to_ne_bytes()).collect();
        (map, data)
    }
}

/// A compute or graphics pipeline.
pub struct Pipeline {
    gpu: Arc<Gpu>,
    pub(crate) raw: vk::Pipeline,
    pub(crate) bind_point: vk::PipelineBindPoint,
    pub(super) layout: Arc<PassLayout>,
    interface: &'static Interface,
}

impl Pipeline {
    /// A pipeline of a shader with this interface; for debuggers, it is named like the shader.
    fn new(
        layout: &Arc<PassLayout>,
        raw: vk::Pipeline,
        bind_point: vk::PipelineBindPoint,
        interface: &'static Interface,
    ) -> Self {
        let gpu = &layout.gpu;
        gpu.name(raw, interface.name);
        Self { gpu: gpu.clone(), raw, bind_point, layout: layout.clone(), interface }
    }

    /// Interface of the shader.
    pub(crate) fn interface(&self) -> &'static Interface {
        self.interface
    }

    /// Number of invocations of a workgroup, for shaders that declare it or work by teams; 1 for others.
    pub(crate) fn workgroup(&self) -> u64 {
        match self.interface.invocations {
            Invocations::Fixed(invocations) => invocations.into(),
            Invocations::Constant if self.interface.by_teams => self.gpu.limits().teams.workgroup().into(),
            _ => 1,
        }
    }
}

impl Drop for Pipeline {
    fn drop(&mut self) {
        // SAFETY: owners drop a pipeline only after the frames that use it have run.
        unsafe { self.gpu.device.destroy_pipeline(self.raw, None) };
    }
}

/// Makes a compute pipeline of a shader of the crate, with subgroups of the size `subgroup` if there is one, which the device
/// must allow to be chosen.
///
/// # Errors
/// [`VulkanError::Pipeline`] if the driver refuses it.
pub(crate) fn compute_pipeline(
    layout: &Arc<PassLayout>,
    spirv: &[u8],
    interface: &'static Interface,
    constants: &Constants,
    subgroup: Option<u32>,
) -> Result<Pipeline, VulkanError> {
    let gpu = &layout.gpu;
    let shader = Shader::new(gpu, spirv)?;
    let (map, data) = constants.packed();
    let specialization = vk::SpecializationInfo::default().map_entries(&map).data(&data);
    let mut size =
        vk::PipelineShaderStageRequiredSubgroupSizeCreateInfo::default().required_subgroup_size(subgroup.unwrap_or(0));
    let mut stage = vk::PipelineShaderStageCreateInfo::default()
        .stage(vk::ShaderStageFlags::COMPUTE)
        .module(shader.raw)
        .name(c"main")
        .specialization_info(&specialization);
    if subgroup.is_some() {
        stage = stage.push_next(&mut size);
    }
    let info = vk::ComputePipelineCreateInfo::default().layout(layout.raw).stage(stage);
    // SAFETY: the layout follows from the shader's interface; all structures live until after the call.
    let pipelines = unsafe { gpu.device.create_compute_pipelines(gpu.pipeline_cache, &[info], None) }
        .map_err(|(_, e)| VulkanError::of_pipeline("vkCreateComputePipelines")(e))?;
    let raw = pipelines.first().copied().unwrap_or_default();
    let point = vk::PipelineBindPoint::COMPUTE;
    Ok(Pipeline::new(layout, raw, point, interface))
}

/// Graphics pipeline of triangles without vertex buffers, into one image and, if it has a format, a depth image in
/// which larger values are nearer. Viewport and scissor are dynamic.
pub(crate) struct GraphicsPipeline<'a> {
    /// SPIR-V of the vertex and the fragment shader.
    pub vertex: &'a [u8],
    pub fragment: &'a [u8],
    /// Interface of the fragment shader.
    pub interface: &'static Interface,
    /// Constants of both shaders; each shader takes those that it declares.
    pub constants: &'a Constants,
    pub samples: vk::SampleCountFlags,
    pub color: vk::Format,
    /// Channels of the image that are written.
    pub channels: vk::ColorComponentFlags,
    pub depth: Option<vk::Format>,
    /// Dynamic state besides viewport and scissor.
    pub dynamic: &'a [vk::DynamicState],
}

impl GraphicsPipeline<'_> {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// [`VulkanError::Pipeline`] if the driver refuses it.
    pub fn make(&self, layout: &Arc<PassLayout>) -> Result<Pipeline, VulkanError> {
        let gpu = &layout.gpu;
        let vertex = Shader::new(gpu, self.vertex)?;
        let fragment = Shader::new(gpu, self.fragment)?;
        let (map, data) = self.constants.packed();
        let specialization = vk::SpecializationInfo::default().map_entries(&map).data(&data);
        let stage = |stage, shader: &Shader| {
            vk::PipelineShaderStageCreateInfo::default()
                .stage(stage)
                .module(shader.raw)
                .name(c"main")
                .specialization_info(&specialization)
        };
        let stages = [stage(vk::ShaderStageFlags::VERTEX, &vertex), stage(vk::ShaderStageFlags::FRAGMENT, &fragment)];
        let input = vk::PipelineVertexInputStateCreateInfo::default();
        let assembly =
            vk::PipelineInputAssemblyStateCreateInfo::default().topology(vk::PrimitiveTopology::TRIANGLE_LIST);
        let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
        let rasterization = vk::PipelineRasterizationStateCreateInfo::default()
            .polygon_mode(vk::PolygonMode::FILL)
            .front_face(vk::FrontFace::COUNTER_CLOCKWISE)
            .line_width(1.0);
        let multisample = vk::PipelineMultisampleStateCreateInfo::default().rasterization_samples(self.samples);
        let depth = vk::PipelineDepthStencilStateCreateInfo::default()
            .depth_test_enable(self.depth.is_some())
            .depth_write_enable(self.depth.is_some())
            .depth_compare_op(vk::CompareOp::GREATER);
        let attachments = [vk::PipelineColorBlendAttachmentState::default().color_write_mask(self.channels)];
        let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments);
        let dynamic = [&[vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR], self.dynamic].concat();
        let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&dynamic);
        let formats = [self.color];
        let mut rendering = vk::PipelineRenderingCreateInfo::default()
            .color_attachment_formats(&formats)
            .depth_attachment_format(self.depth.unwrap_or(vk::Format::UNDEFINED));
        let info = vk::GraphicsPipelineCreateInfo::default()
            .stages(&stages)
            .vertex_input_state(&input)
            .input_assembly_state(&assembly)
            .viewport_state(&viewport)
            .rasterization_state(&rasterization)
            .multisample_state(&multisample)
            .depth_stencil_state(&depth)
            .color_blend_state(&blend)
            .dynamic_state(&dynamic)
            .layout(layout.raw)
            .push_next(&mut rendering);
        // SAFETY: all structures live until after the call; the layout follows from the shaders' interfaces.
        let pipelines = unsafe { gpu.device.create_graphics_pipelines(gpu.pipeline_cache, &[info], None) }
            .map_err(|(_, e)| VulkanError::of_pipeline("vkCreateGraphicsPipelines")(e))?;
        let raw = pipelines.first().copied().unwrap_or_default();
        let point = vk::PipelineBindPoint::GRAPHICS;
        Ok(Pipeline::new(layout, raw, point, self.interface))
    }
}
