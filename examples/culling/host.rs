//! The host: its buffers, pipelines and commands, and what it passes to the library.

use crate::Failure;
use crate::device::{Buffer, Device, Image, Texture};
use crate::scene::{self, Object};
use ash::vk;
use glam::Mat4;
use gpc::host::{
    Antialiaser, ClipSpace, Frame, Geometry, ImageKinds, ImageState, Images, Indices, IndirectDraws, Instance,
    LentImage, Mesh, Options, PositionSpace, Scenery, ShadeSamples, Topology, VertexFormat, Viewport,
    VisibilitySamples, check_shader,
};

const COLOR: vk::Format = vk::Format::R32G32B32A32_SFLOAT;
const DEPTH: vk::Format = vk::Format::D32_SFLOAT;
const SKY: [f32; 3] = [0.35, 0.5, 0.75];
/// Largest number of objects in the view; the others of the 20,000 are outside.
const CAPACITY: u32 = 6_000;
const INDICES: u32 = 36;
const VERTICES: u32 = 24;
/// Objects, vertices, commands, their number, and instances, as in the shaders.
const BINDINGS: u32 = 5;

macro_rules! spirv {
    ($name:literal) => {
        include_bytes!(concat!("shaders/spirv/", $name, ".spv"))
    };
}

/// Push constants of `cull`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Cull {
    to_clip: [[f32; 4]; 4],
    object_count: u32,
    capacity: u32,
}

pub struct Host<'a> {
    device: &'a Device,
    object_count: u32,
    _objects: Buffer<'a>,
    vertices: Buffer<'a>,
    indices: Buffer<'a>,
    commands: Buffer<'a>,
    count: Buffer<'a>,
    instances: Buffer<'a>,
    set_layout: vk::DescriptorSetLayout,
    pool: vk::DescriptorPool,
    set: vk::DescriptorSet,
    /// Layouts of the host's own passes, and of its shading of samples.
    layout: vk::PipelineLayout,
    samples_layout: vk::PipelineLayout,
    cull: vk::Pipeline,
    draw: vk::Pipeline,
    samples: vk::Pipeline,
}

impl<'a> Host<'a> {
    pub fn new(device: &'a Device, samples_set: vk::DescriptorSetLayout, objects: &[Object]) -> Result<Self, Failure> {
        use vk::BufferUsageFlags as Usage;
        let raw = &device.raw;
        let (corners, indices) = scene::cube();
        let indirect = Usage::STORAGE_BUFFER | Usage::INDIRECT_BUFFER | Usage::TRANSFER_DST;
        let command_bytes = u64::from(CAPACITY) * size_of::<vk::DrawIndexedIndirectCommand>() as u64;
        let instance_bytes = u64::from(CAPACITY) * size_of::<Instance>() as u64;
        let mut index_buffer = device.buffer(2 * indices.len() as u64, Usage::STORAGE_BUFFER | Usage::INDEX_BUFFER)?;
        let bytes: &[u8] = bytemuck::cast_slice(&indices);
        index_buffer.bytes_mut()?[..bytes.len()].copy_from_slice(bytes);
        let objects_buffer = device.filled(objects)?;
        let vertices = device.filled(&corners)?;
        let commands = device.buffer(command_bytes, indirect)?;
        let count = device.buffer(4, indirect)?;
        let instances = device.buffer(instance_bytes, Usage::STORAGE_BUFFER)?;
        // SAFETY: plain creations whose structures live until after the calls. Handles that were made before a failure
        // leak, but the program ends then.
        unsafe {
            let bindings: Vec<_> = (0..BINDINGS)
                .map(|binding| {
                    vk::DescriptorSetLayoutBinding::default()
                        .binding(binding)
                        .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                        .descriptor_count(1)
                        .stage_flags(vk::ShaderStageFlags::COMPUTE | vk::ShaderStageFlags::VERTEX)
                })
                .collect();
            let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
            let set_layout = raw.create_descriptor_set_layout(&info, None)?;
            let sizes = [vk::DescriptorPoolSize { ty: vk::DescriptorType::STORAGE_BUFFER, descriptor_count: BINDINGS }];
            let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
            let pool = raw.create_descriptor_pool(&info, None)?;
            let layouts = [set_layout];
            let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
            let set = raw.allocate_descriptor_sets(&info)?[0];
            let shown = [&objects_buffer, &vertices, &commands, &count, &instances];
            let infos =
                shown.map(|buffer| vk::DescriptorBufferInfo::default().buffer(buffer.raw).range(vk::WHOLE_SIZE));
            let write = vk::WriteDescriptorSet::default()
                .dst_set(set)
                .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                .buffer_info(&infos);
            raw.update_descriptor_sets(&[write], &[]);
            let push = [vk::PushConstantRange {
                stage_flags: vk::ShaderStageFlags::COMPUTE,
                offset: 0,
                size: size_of::<Cull>() as u32,
            }];
            let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts).push_constant_ranges(&push);
            let layout = raw.create_pipeline_layout(&info, None)?;
            let both = [samples_set, set_layout];
            let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&both);
            let samples_layout = raw.create_pipeline_layout(&info, None)?;
            // The library takes the version of the includes that the shader was compiled with.
            check_shader(&ash::util::read_spv(&mut std::io::Cursor::new(spirv!("samples")))?)?;
            Ok(Self {
                device,
                object_count: objects.len() as u32,
                _objects: objects_buffer,
                vertices,
                indices: index_buffer,
                commands,
                count,
                instances,
                set_layout,
                pool,
                set,
                layout,
                samples_layout,
                cull: device.compute(spirv!("cull"), layout, 0)?,
                draw: device.graphics(
                    layout,
                    [&spirv!("object_vertex")[..], &spirv!("object_fragment")[..]],
                    COLOR,
                    Some(DEPTH),
                    vk::CullModeFlags::BACK,
                )?,
                samples: device.compute(spirv!("samples"), samples_layout, 0)?,
            })
        }
    }

    /// The library's frame for pictures of a size.
    pub fn frame(&self, antialiaser: &Antialiaser, [width, height]: [u32; 2]) -> Result<Frame, Failure> {
        let mesh = Mesh {
            positions: self.vertices.raw,
            positions_offset: 0,
            position_stride: 8,
            position_format: VertexFormat::of(vk::Format::R16G16B16A16_SNORM),
            vertex_capacity: VERTICES,
            coordinates: None,
            indices: Some(Indices {
                buffer: self.indices.raw,
                offset: 0,
                index_type: vk::IndexType::UINT16,
                capacity: INDICES,
            }),
        };
        let culled = IndirectDraws {
            commands: self.commands.raw,
            commands_offset: 0,
            command_stride: size_of::<vk::DrawIndexedIndirectCommand>() as u32,
            command_capacity: CAPACITY,
            count: Some((self.count.raw, 0)),
            instances: self.instances.raw,
            instances_offset: 0,
            instance_capacity: CAPACITY,
            draw_capacity: CAPACITY,
            triangle_capacity: CAPACITY * INDICES / 3,
            position_capacity: CAPACITY * VERTICES,
            mesh: 0,
            topology: Topology::List,
            front_face: vk::FrontFace::COUNTER_CLOCKWISE,
            double_sided: false,
            alpha_tested: false,
            blended: false,
        };
        let geometry = Geometry {
            meshes: vec![mesh],
            // There are no draws of the CPU.
            position_space: PositionSpace::Object { capacity: 0 },
            indirect: vec![culled],
            triangle_capacity: 0,
            draw_capacity: 0,
            keys: 1,
            alpha_maps: Vec::new(),
            blended: false,
            clip: ClipSpace { y_up: true, reversed_depth: true, ..ClipSpace::default() },
        };
        let kinds =
            ImageKinds { ids: false, depth: false, color_format: COLOR, color_encoded: false, color_copied: false };
        // SAFETY: the buffers have the sizes and usages named, and outlive the frame.
        Ok(unsafe { antialiaser.prepare(&geometry, &kinds, &Options::new(width, height)) }?)
    }

    /// Culls and draws the objects with `side` x `side` samples a pixel, has the library antialias the picture if there is a
    /// frame, and returns it.
    pub fn picture(&self, size: [u32; 2], side: u32, frame: Option<&mut Frame>) -> Result<Image, Failure> {
        let (device, raw) = (self.device, &self.device.raw);
        let drawn = size.map(|pixels| pixels * side);
        let [width, height] = drawn;
        let (plain, deep) = (vk::ImageAspectFlags::COLOR, vk::ImageAspectFlags::DEPTH);
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
        let color = device.image(COLOR, drawn, 1, usage | vk::ImageUsageFlags::TRANSFER_SRC, plain)?;
        let depth = device.image(DEPTH, drawn, 1, vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT, deep)?;
        let pixels = u64::from(width) * u64::from(height);
        let read_back = device.buffer(16 * pixels, vk::BufferUsageFlags::TRANSFER_DST)?;
        let (to_clip, projection) = scene::camera(size);
        device.run(|commands| {
            // SAFETY: the commands are waited for; all handles outlive them, and images are in the layouts named.
            unsafe {
                self.record_cull(commands, to_clip);
                self.record_drawing(commands, [&color, &depth], drawn);
                if let Some(frame) = frame {
                    let viewport = viewport(drawn);
                    let viewport =
                        Viewport { x: viewport.x, y: viewport.y, width: viewport.width, height: viewport.height };
                    let scenery = Scenery::new(&[], projection.to_cols_array_2d()).viewport(Some(viewport));
                    frame.record(commands, &images(&color), &scenery, self)?;
                } else {
                    device.change(commands, &color, DRAWN, COPIED);
                }
                let region = vk::BufferImageCopy::default()
                    .image_subresource(vk::ImageSubresourceLayers {
                        aspect_mask: plain,
                        mip_level: 0,
                        base_array_layer: 0,
                        layer_count: 1,
                    })
                    .image_extent(vk::Extent3D { width, height, depth: 1 });
                raw.cmd_copy_image_to_buffer(commands, color.raw, COPIED.layout, read_back.raw, &[region]);
                device.show_to_host(commands);
            }
            Ok(())
        })?;
        Ok(Image::means(read_back.colors()?, size, side))
    }

    /// Records the culling of all objects.
    unsafe fn record_cull(&self, commands: vk::CommandBuffer, to_clip: Mat4) {
        let raw = &self.device.raw;
        let compute = vk::PipelineBindPoint::COMPUTE;
        let push = Cull { to_clip: to_clip.to_cols_array_2d(), object_count: self.object_count, capacity: CAPACITY };
        let barrier = |from, to| {
            let barriers = [vk::MemoryBarrier2::default()
                .src_stage_mask(from)
                .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
                .dst_stage_mask(to)
                .dst_access_mask(vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE)];
            let info = vk::DependencyInfo::default().memory_barriers(&barriers);
            // SAFETY: guaranteed by the caller.
            unsafe { raw.cmd_pipeline_barrier2(commands, &info) };
        };
        let (fill, cull) = (vk::PipelineStageFlags2::ALL_TRANSFER, vk::PipelineStageFlags2::COMPUTE_SHADER);
        let draw = vk::PipelineStageFlags2::DRAW_INDIRECT | vk::PipelineStageFlags2::VERTEX_SHADER;
        // SAFETY: guaranteed by the caller.
        unsafe {
            // Commands that are not written draw nothing.
            raw.cmd_fill_buffer(commands, self.commands.raw, 0, vk::WHOLE_SIZE, 0);
            raw.cmd_fill_buffer(commands, self.count.raw, 0, vk::WHOLE_SIZE, 0);
            barrier(fill, cull);
            raw.cmd_bind_pipeline(commands, compute, self.cull);
            raw.cmd_bind_descriptor_sets(commands, compute, self.layout, 0, &[self.set], &[]);
            let bytes = bytemuck::bytes_of(&push);
            raw.cmd_push_constants(commands, self.layout, vk::ShaderStageFlags::COMPUTE, 0, bytes);
            raw.cmd_dispatch(commands, self.object_count.div_ceil(64), 1, 1);
            barrier(cull, draw);
        }
    }

    /// Records the drawing of what is left.
    unsafe fn record_drawing(&self, commands: vk::CommandBuffer, [color, depth]: [&Texture<'_>; 2], size: [u32; 2]) {
        let raw = &self.device.raw;
        let graphics = vk::PipelineBindPoint::GRAPHICS;
        let [width, height] = size;
        let area = vk::Rect2D { offset: vk::Offset2D::default(), extent: vk::Extent2D { width, height } };
        let [r, g, b] = SKY;
        let attachment = |texture: &Texture<'_>, layout| {
            vk::RenderingAttachmentInfo::default()
                .image_view(texture.view)
                .image_layout(layout)
                .load_op(vk::AttachmentLoadOp::CLEAR)
                .store_op(vk::AttachmentStoreOp::STORE)
        };
        let sky = vk::ClearValue { color: vk::ClearColorValue { float32: [r, g, b, 1.0] } };
        let colors = [attachment(color, DRAWN.layout).clear_value(sky)];
        let depths = attachment(depth, DEPTH_DRAWN.layout);
        let info = vk::RenderingInfo::default()
            .render_area(area)
            .layer_count(1)
            .color_attachments(&colors)
            .depth_attachment(&depths);
        let stride = size_of::<vk::DrawIndexedIndirectCommand>() as u32;
        // SAFETY: guaranteed by the caller.
        unsafe {
            self.device.change(commands, color, UNDEFINED, DRAWN);
            self.device.change(commands, depth, UNDEFINED, DEPTH_DRAWN);
            raw.cmd_begin_rendering(commands, &info);
            raw.cmd_set_viewport(commands, 0, &[viewport(size)]);
            raw.cmd_set_scissor(commands, 0, &[area]);
            raw.cmd_bind_pipeline(commands, graphics, self.draw);
            raw.cmd_bind_descriptor_sets(commands, graphics, self.layout, 0, &[self.set], &[]);
            raw.cmd_bind_index_buffer(commands, self.indices.raw, 0, vk::IndexType::UINT16);
            raw.cmd_draw_indexed_indirect(commands, self.commands.raw, 0, CAPACITY, stride);
            raw.cmd_end_rendering(commands);
        }
    }
}

impl ShadeSamples for Host<'_> {
    fn record(&self, commands: vk::CommandBuffer, samples: &VisibilitySamples) {
        let raw = &self.device.raw;
        let compute = vk::PipelineBindPoint::COMPUTE;
        let sets = [samples.descriptor_set(), self.set];
        let skipping = self.device.conditional_rendering.as_ref().zip(samples.condition());
        // SAFETY: the command buffer is being recorded; sets and pipeline have compatible layouts and outlive its
        // execution. Conditional rendering that is begun is ended.
        unsafe {
            if let Some((functions, word)) = skipping {
                let info = vk::ConditionalRenderingBeginInfoEXT::default().buffer(word);
                (functions.fp().cmd_begin_conditional_rendering_ext)(commands, &info);
            }
            raw.cmd_bind_descriptor_sets(commands, compute, self.samples_layout, 0, &sets, &[]);
            raw.cmd_bind_pipeline(commands, compute, self.samples);
            if let Some((arguments, offset)) = samples.dispatch(0) {
                raw.cmd_dispatch_indirect(commands, arguments, offset);
            }
            if let Some((functions, _)) = skipping {
                (functions.fp().cmd_end_conditional_rendering_ext)(commands);
            }
        }
    }
}

impl Drop for Host<'_> {
    fn drop(&mut self) {
        let raw = &self.device.raw;
        // SAFETY: every submission was waited for.
        unsafe {
            for pipeline in [self.cull, self.draw, self.samples] {
                raw.destroy_pipeline(pipeline, None);
            }
            for layout in [self.layout, self.samples_layout] {
                raw.destroy_pipeline_layout(layout, None);
            }
            raw.destroy_descriptor_pool(self.pool, None);
            raw.destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}

/// Viewport of a whole image, with y up.
fn viewport([width, height]: [u32; 2]) -> vk::Viewport {
    let [width, height] = [width, height].map(|side| side as f32);
    vk::Viewport { x: 0.0, y: height, width, height: -height, min_depth: 0.0, max_depth: 1.0 }
}

/// Images that the library is passed.
fn images(color: &Texture<'_>) -> Images {
    let color = LentImage { image: color.raw, view: color.view, aspects: color.aspect, before: DRAWN, after: COPIED };
    Images { ids: None, depth: None, color, corner: [0, 0], layer: 0 }
}

const UNDEFINED: ImageState = ImageState {
    layout: vk::ImageLayout::UNDEFINED,
    stage: vk::PipelineStageFlags2::NONE,
    access: vk::AccessFlags2::NONE,
};
const DRAWN: ImageState = ImageState {
    layout: vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
    stage: vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT,
    access: vk::AccessFlags2::COLOR_ATTACHMENT_WRITE,
};
const DEPTH_DRAWN: ImageState = ImageState {
    layout: vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL,
    stage: vk::PipelineStageFlags2::EARLY_FRAGMENT_TESTS,
    access: vk::AccessFlags2::DEPTH_STENCIL_ATTACHMENT_WRITE,
};
const COPIED: ImageState = ImageState {
    layout: vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
    stage: vk::PipelineStageFlags2::ALL_TRANSFER,
    access: vk::AccessFlags2::TRANSFER_READ,
};
