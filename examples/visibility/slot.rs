//! A frame in flight of the host: its buffers, images and commands, and the library's frame for it.

use crate::Failure;
use crate::device::{Buffer, Device, Image, Texture};
use crate::meshes::{Instance, KEYS, World};
use crate::pipelines::{BINDINGS, COLOR, DEPTH, IDS, Materials, Pipelines};
use ash::vk;
use glam::Mat4;
use gpc::host::{
    Antialiaser, ClipSpace, Coordinates, Frame, Geometry, ImageKinds, ImageState, Images, Indices, LentImage, Mesh,
    Options, PositionSpace, Scenery, VertexFormat,
};

/// The library's frame for a slot.
pub struct Antialiasing {
    pub frame: Frame,
    projection: Mat4,
}

pub struct Slot<'a> {
    device: &'a Device,
    size: [u32; 2],
    antialiasing: Option<Antialiasing>,
    commands: vk::CommandBuffer,
    fence: vk::Fence,
    /// Whether commands are submitted that were not waited for.
    is_submitted: bool,
    pool: vk::DescriptorPool,
    set: vk::DescriptorSet,
    instances: Buffer<'a>,
    positions: Buffer<'a>,
    _posed: Buffer<'a>,
    targets: Targets<'a>,
}

/// Images of one size, and what the colours are copied to.
struct Targets<'a> {
    ids: Texture<'a>,
    depth: Texture<'a>,
    color: Texture<'a>,
    read_back: Buffer<'a>,
}

/// An image of a window, in which a frame is shown.
#[derive(Clone, Copy)]
pub struct Shown {
    pub image: vk::Image,
    pub size: [u32; 2],
    /// Semaphore that is signalled when the image may be written.
    pub free: vk::Semaphore,
    /// Semaphore to signal when the image is written.
    pub written: vk::Semaphore,
}

impl<'a> Targets<'a> {
    fn new(device: &'a Device, size: [u32; 2]) -> Result<Self, Failure> {
        let sampled = vk::ImageUsageFlags::SAMPLED;
        let drawn = sampled | vk::ImageUsageFlags::COLOR_ATTACHMENT;
        let plain = vk::ImageAspectFlags::COLOR;
        let depth_usage = sampled | vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT;
        let copied = drawn | vk::ImageUsageFlags::TRANSFER_SRC;
        let pixels = u64::from(size[0]) * u64::from(size[1]);
        Ok(Self {
            ids: device.image(IDS, size, 1, drawn, plain)?,
            depth: device.image(DEPTH, size, 1, depth_usage, vk::ImageAspectFlags::DEPTH)?,
            color: device.image(COLOR, size, 1, copied, plain)?,
            read_back: device.buffer(16 * pixels, vk::BufferUsageFlags::TRANSFER_DST)?,
        })
    }
}

/// The kinds of images that the library is lent.
const KINDS: ImageKinds =
    ImageKinds { ids: true, depth: true, color_format: COLOR, color_encoded: false, color_copied: false };
/// Background that the host draws. The lens, which has no image with a background, gets it as an option.
pub const SKY: [f32; 3] = [0.2, 0.35, 0.6];

/// State of an image that the host has drawn and samples.
const SHOWN: ImageState = ImageState {
    layout: vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL,
    stage: vk::PipelineStageFlags2::FRAGMENT_SHADER,
    access: vk::AccessFlags2::SHADER_READ,
};

impl<'a> Slot<'a> {
    /// Makes a slot for images in the size of the options. Without an antialiaser, the host draws alone.
    pub fn new(
        device: &'a Device,
        world: &World<'a>,
        pipelines: &Pipelines<'_>,
        size: [u32; 2],
        antialiasing: Option<(&Antialiaser, &Options)>,
    ) -> Result<Self, Failure> {
        let storage = vk::BufferUsageFlags::STORAGE_BUFFER;
        let posed_count = u64::from(world.posed_count);
        let texels = storage | vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER;
        let instance_bytes = (world.draws.len() * size_of::<Instance>()) as u64;
        let instances = device.buffer(instance_bytes, storage)?;
        let positions = device.buffer(16 * posed_count, texels)?;
        let posed = device.buffer(32 * posed_count, storage)?;
        let targets = Targets::new(device, size)?;
        let raw = &device.raw;
        // SAFETY: plain creations on a live device. Handles that were made before a failure leak, but the program ends
        // then.
        let (commands, fence, pool, set) = unsafe {
            let info = vk::CommandBufferAllocateInfo::default().command_pool(device.pool).command_buffer_count(1);
            let commands = raw.allocate_command_buffers(&info)?[0];
            let fence = raw.create_fence(&vk::FenceCreateInfo::default(), None)?;
            let sizes = BINDINGS.map(|ty| vk::DescriptorPoolSize { ty, descriptor_count: 1 });
            let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
            let pool = raw.create_descriptor_pool(&info, None)?;
            let layouts = [pipelines.set_layout];
            let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
            let set = raw.allocate_descriptor_sets(&info)?[0];
            (commands, fence, pool, set)
        };
        let buffers = [
            &world.vertices,
            &instances,
            &world.indices,
            &world.draw_table,
            &world.draw_of,
            &positions,
            &posed,
            &world.coordinates,
        ]
        .map(|buffer| [vk::DescriptorBufferInfo::default().buffer(buffer.raw).range(vk::WHOLE_SIZE)]);
        let images = [&world.bricks, &world.fence, &targets.ids].map(|texture| {
            [vk::DescriptorImageInfo::default()
                .sampler(pipelines.sampler)
                .image_view(texture.view)
                .image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)]
        });
        let write = |binding: usize| {
            vk::WriteDescriptorSet::default()
                .dst_set(set)
                .dst_binding(binding as u32)
                .descriptor_type(BINDINGS[binding])
        };
        let writes: Vec<_> = (0..)
            .zip(&buffers)
            .map(|(binding, info)| write(binding).buffer_info(info))
            .chain((buffers.len()..).zip(&images).map(|(binding, info)| write(binding).image_info(info)))
            .collect();
        // SAFETY: the set is new; its buffers and images live as long as the slot.
        unsafe { raw.update_descriptor_sets(&writes, &[]) };
        let mut slot = Self {
            device,
            size,
            antialiasing: None,
            commands,
            fence,
            is_submitted: false,
            pool,
            set,
            instances,
            positions,
            _posed: posed,
            targets,
        };
        if let Some((antialiaser, options)) = antialiasing {
            let geometry = slot.geometry(world);
            // SAFETY: buffers and alpha maps are as they say, and live as long as the slot.
            let frame = unsafe { antialiaser.prepare(&geometry, &KINDS, options) }?;
            slot.antialiasing = Some(Antialiasing { frame, projection: Mat4::IDENTITY });
        }
        Ok(slot)
    }

    /// Replaces the images by images of another size. The slot's previous commands must have run.
    pub fn resize(&mut self, pipelines: &Pipelines<'_>, size: [u32; 2]) -> Result<(), Failure> {
        let targets = Targets::new(self.device, size)?;
        if let Some(antialiasing) = &mut self.antialiasing {
            // SAFETY: the frame's commands have run; its buffers stay.
            unsafe { antialiasing.frame.resize(size) }?;
        }
        let ids = [vk::DescriptorImageInfo::default()
            .sampler(pipelines.sampler)
            .image_view(targets.ids.view)
            .image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)];
        let last = BINDINGS.len() - 1;
        let write = vk::WriteDescriptorSet::default()
            .dst_set(self.set)
            .dst_binding(last as u32)
            .descriptor_type(BINDINGS[last])
            .image_info(&ids);
        // SAFETY: no commands use the set.
        unsafe { self.device.raw.update_descriptor_sets(&[write], &[]) };
        self.targets = targets;
        self.size = size;
        Ok(())
    }

    /// Buffers that the library is lent.
    pub fn geometry(&self, world: &World<'_>) -> Geometry {
        let mesh = Mesh {
            positions: self.positions.raw,
            positions_offset: 0,
            position_stride: 16,
            position_format: VertexFormat::FLOAT,
            vertex_capacity: world.posed_count,
            coordinates: Some(Coordinates {
                buffer: world.coordinates.raw,
                offset: 0,
                stride: 8,
                format: VertexFormat::FLOAT,
            }),
            indices: Some(Indices {
                buffer: world.indices.raw,
                offset: 0,
                index_type: vk::IndexType::UINT32,
                capacity: world.index_count,
            }),
        };
        Geometry {
            meshes: vec![mesh],
            position_space: PositionSpace::Clip,
            indirect: Vec::new(),
            triangle_capacity: world.triangle_count,
            draw_capacity: world.draws.len() as u32,
            keys: KEYS,
            alpha_maps: vec![world.alpha_map()],
            blended: false,
            clip: ClipSpace { y_up: true, reversed_depth: true, ..ClipSpace::default() },
        }
    }

    /// Images that the library is lent, with their states after the host's drawing and before the host's next use.
    fn images(&self) -> Images {
        let lent = |texture: &Texture<'_>, before, after| LentImage {
            image: texture.raw,
            view: texture.view,
            aspects: texture.aspect,
            before,
            after,
        };
        Images {
            ids: Some(lent(&self.targets.ids, SHOWN, SHOWN)),
            depth: Some(lent(&self.targets.depth, DEPTH_DRAWN, SHOWN)),
            color: lent(&self.targets.color, COLOR_DRAWN, COPIED),
            corner: [0, 0],
            layer: 0,
        }
    }

    /// Materials that read the slot's buffers and images.
    pub fn materials<'p>(&self, pipelines: &'p Pipelines<'p>) -> Materials<'p> {
        pipelines.materials(self.set)
    }

    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    pub fn antialiasing(&self) -> Option<&Antialiasing> {
        self.antialiasing.as_ref()
    }

    /// Sets the scene's time and view for the next frame. The slot's previous commands must have run.
    pub fn show(&mut self, world: &World<'_>, time: f32, (camera, projection): (Mat4, Mat4)) -> Result<(), Failure> {
        let instances = world.instances(time, camera);
        let bytes: &[u8] = bytemuck::cast_slice(&instances);
        self.instances.bytes_mut()?[..bytes.len()].copy_from_slice(bytes);
        if let Some(antialiasing) = &mut self.antialiasing {
            antialiasing.projection = projection;
        }
        Ok(())
    }

    /// Records the host's frame, which includes the library's part, and submits it: its colours are copied to the CPU.
    pub fn submit(&mut self, world: &World<'_>, pipelines: &Pipelines<'_>) -> Result<(), Failure> {
        self.submit_to(world, pipelines, None)
    }

    /// Records and submits the host's frame, like [`Self::submit`]. With an image of a window, shows the frame in it.
    pub fn submit_to(
        &mut self,
        world: &World<'_>,
        pipelines: &Pipelines<'_>,
        shown: Option<Shown>,
    ) -> Result<(), Failure> {
        let (raw, commands) = (&self.device.raw, self.commands);
        // SAFETY: the slot's previous commands have run; all handles live as long as the slot, whose drop waits.
        unsafe {
            raw.begin_command_buffer(commands, &vk::CommandBufferBeginInfo::default())?;
            self.record_pose(world, pipelines);
            self.record_ids(world, pipelines);
            self.record_screen(pipelines);
            let (materials, images) = (self.materials(pipelines), self.images());
            if let Some(Antialiasing { frame, projection }) = &mut self.antialiasing {
                let scenery = Scenery::new(&world.draws, projection.to_cols_array_2d());
                frame.record(commands, &images, &scenery, &materials)?;
            } else {
                self.device.change(self.commands, &self.targets.color, COLOR_DRAWN, COPIED);
            }
            match shown {
                Some(shown) => self.record_show(&shown),
                None => self.record_read_back(),
            }
            raw.end_command_buffer(commands)?;
            let buffers = [commands];
            let (free, written) = match shown {
                Some(shown) => (vec![shown.free], vec![shown.written]),
                None => (Vec::new(), Vec::new()),
            };
            // The window's image is first used by the copy to it.
            let stages = vec![vk::PipelineStageFlags::TRANSFER; free.len()];
            let submitted = [vk::SubmitInfo::default()
                .command_buffers(&buffers)
                .wait_semaphores(&free)
                .wait_dst_stage_mask(&stages)
                .signal_semaphores(&written)];
            raw.queue_submit(self.device.queue, &submitted, self.fence)?;
        }
        self.is_submitted = true;
        Ok(())
    }

    /// Waits for the submitted commands, if there are any.
    pub fn wait(&mut self) -> Result<(), Failure> {
        if !std::mem::take(&mut self.is_submitted) {
            return Ok(());
        }
        // SAFETY: the fence was submitted.
        unsafe {
            let fences = [self.fence];
            self.device.raw.wait_for_fences(&fences, true, u64::MAX)?;
            self.device.raw.reset_fences(&fences)?;
        }
        Ok(())
    }

    /// Picture of the slot's colours. Each of its pixels is the mean of `side` x `side` colours.
    pub fn pixels(&self, side: u32) -> Result<Image, Failure> {
        let size = self.size.map(|pixels| pixels / side);
        Ok(Image::means(self.targets.read_back.colors()?, size, side))
    }

    unsafe fn bind(&self, point: vk::PipelineBindPoint, pipelines: &Pipelines<'_>, pipeline: vk::Pipeline) {
        let (raw, commands) = (&self.device.raw, self.commands);
        // SAFETY: guaranteed by the caller.
        unsafe {
            raw.cmd_bind_pipeline(commands, point, pipeline);
            raw.cmd_bind_descriptor_sets(commands, point, pipelines.layout, 0, &[self.set], &[]);
        }
    }

    unsafe fn push<T: bytemuck::NoUninit>(&self, pipelines: &Pipelines<'_>, values: &[T]) {
        let bytes = bytemuck::cast_slice(values);
        // SAFETY: guaranteed by the caller.
        unsafe {
            self.device.raw.cmd_push_constants(self.commands, pipelines.layout, vk::ShaderStageFlags::ALL, 0, bytes);
        }
    }

    /// Records the computation of the vertices of all instances, in clip space.
    unsafe fn record_pose(&self, world: &World<'_>, pipelines: &Pipelines<'_>) {
        let (raw, commands) = (&self.device.raw, self.commands);
        // SAFETY: guaranteed by the caller.
        unsafe {
            self.bind(vk::PipelineBindPoint::COMPUTE, pipelines, pipelines.pose);
            for (number, (mesh, draw)) in (0_u32..).zip(world.meshes.iter().zip(&world.draws)) {
                let posed = draw.vertex_offset.cast_unsigned();
                let push = [mesh.first_vertex, mesh.vertex_count, posed, number];
                self.push(pipelines, &push);
                raw.cmd_dispatch(commands, mesh.vertex_count.div_ceil(64), 1, 1);
            }
            let barriers = [vk::MemoryBarrier2::default()
                .src_stage_mask(vk::PipelineStageFlags2::COMPUTE_SHADER)
                .src_access_mask(vk::AccessFlags2::SHADER_WRITE)
                .dst_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
                .dst_access_mask(vk::AccessFlags2::SHADER_READ)];
            let info = vk::DependencyInfo::default().memory_barriers(&barriers);
            raw.cmd_pipeline_barrier2(commands, &info);
        }
    }

    /// Records the drawing of the visibility buffer: triangle IDs and depth.
    unsafe fn record_ids(&self, world: &World<'_>, pipelines: &Pipelines<'_>) {
        let (raw, commands) = (&self.device.raw, self.commands);
        // SAFETY: guaranteed by the caller.
        unsafe {
            self.device.change(self.commands, &self.targets.ids, UNDEFINED, COLOR_DRAWN);
            self.device.change(self.commands, &self.targets.depth, UNDEFINED, DEPTH_DRAWN);
            self.begin_rendering(&self.targets.ids, Some(&self.targets.depth));
            raw.cmd_bind_index_buffer(commands, world.indices.raw, 0, vk::IndexType::UINT32);
            let mut first_triangle = 0_u32;
            for draw in &world.draws {
                let pipeline = match draw.alpha_map {
                    Some(_) => pipelines.ids_masked,
                    None => pipelines.ids,
                };
                self.bind(vk::PipelineBindPoint::GRAPHICS, pipelines, pipeline);
                self.push(pipelines, &[first_triangle]);
                raw.cmd_draw_indexed(commands, 3 * draw.triangle_count, 1, draw.first_index, draw.vertex_offset, 0);
                first_triangle += draw.triangle_count;
            }
            raw.cmd_end_rendering(commands);
            self.device.change(self.commands, &self.targets.ids, COLOR_DRAWN, SHOWN);
        }
    }

    /// Records the shading of the pixels' centres.
    unsafe fn record_screen(&self, pipelines: &Pipelines<'_>) {
        let (raw, commands) = (&self.device.raw, self.commands);
        // SAFETY: guaranteed by the caller.
        unsafe {
            self.device.change(self.commands, &self.targets.color, UNDEFINED, COLOR_DRAWN);
            self.begin_rendering(&self.targets.color, None);
            self.bind(vk::PipelineBindPoint::GRAPHICS, pipelines, pipelines.screen);
            self.push(pipelines, &self.size.map(|side| 0.5 * side as f32));
            raw.cmd_draw(commands, 3, 1, 0, 0);
            raw.cmd_end_rendering(commands);
        }
    }

    /// Begins drawing over a whole image, cleared first; y points up.
    unsafe fn begin_rendering(&self, color: &Texture<'_>, depth: Option<&Texture<'_>>) {
        let (raw, commands) = (&self.device.raw, self.commands);
        let [width, height] = self.size;
        let area = vk::Rect2D { offset: vk::Offset2D::default(), extent: vk::Extent2D { width, height } };
        let attachment = |texture: &Texture<'_>, layout| {
            vk::RenderingAttachmentInfo::default()
                .image_view(texture.view)
                .image_layout(layout)
                .load_op(vk::AttachmentLoadOp::CLEAR)
                .store_op(vk::AttachmentStoreOp::STORE)
        };
        let colors = [attachment(color, COLOR_DRAWN.layout)];
        let depth = depth.map(|depth| attachment(depth, DEPTH_DRAWN.layout));
        let mut info = vk::RenderingInfo::default().render_area(area).layer_count(1).color_attachments(&colors);
        if let Some(depth) = &depth {
            info = info.depth_attachment(depth);
        }
        let viewport = vk::Viewport {
            x: 0.0,
            y: height as f32,
            width: width as f32,
            height: -(height as f32),
            min_depth: 0.0,
            max_depth: 1.0,
        };
        // SAFETY: guaranteed by the caller.
        unsafe {
            raw.cmd_begin_rendering(commands, &info);
            raw.cmd_set_viewport(commands, 0, &[viewport]);
            raw.cmd_set_scissor(commands, 0, &[area]);
        }
    }

    unsafe fn record_read_back(&self) {
        let (raw, commands) = (&self.device.raw, self.commands);
        let [width, height] = self.size;
        let region = vk::BufferImageCopy::default()
            .image_subresource(vk::ImageSubresourceLayers {
                aspect_mask: vk::ImageAspectFlags::COLOR,
                mip_level: 0,
                base_array_layer: 0,
                layer_count: 1,
            })
            .image_extent(vk::Extent3D { width, height, depth: 1 });
        let (from, to) = (self.targets.color.raw, self.targets.read_back.raw);
        // SAFETY: guaranteed by the caller; image and buffer have the same size.
        unsafe {
            raw.cmd_copy_image_to_buffer(commands, from, COPIED.layout, to, &[region]);
            self.device.show_to_host(commands);
        }
    }

    /// Records the copy of the colours to an image of a window, which encodes them.
    unsafe fn record_show(&self, shown: &Shown) {
        let (raw, commands) = (&self.device.raw, self.commands);
        let corners = |[width, height]: [u32; 2]| {
            let end = vk::Offset3D { x: width as i32, y: height as i32, z: 1 };
            [vk::Offset3D::default(), end]
        };
        let layers = vk::ImageSubresourceLayers {
            aspect_mask: vk::ImageAspectFlags::COLOR,
            mip_level: 0,
            base_array_layer: 0,
            layer_count: 1,
        };
        let region = [vk::ImageBlit::default()
            .src_subresource(layers)
            .src_offsets(corners(self.size))
            .dst_subresource(layers)
            .dst_offsets(corners(shown.size))];
        let (from, to) = (self.targets.color.raw, shown.image);
        let written = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        // SAFETY: guaranteed by the caller.
        unsafe {
            self.change_shown(shown.image, UNDEFINED.layout, written);
            let filter = vk::Filter::NEAREST;
            raw.cmd_blit_image(commands, from, COPIED.layout, to, written, &region, filter);
            self.change_shown(shown.image, written, vk::ImageLayout::PRESENT_SRC_KHR);
        }
    }

    /// Records the change of a window's image around the copy to it.
    unsafe fn change_shown(&self, image: vk::Image, from: vk::ImageLayout, to: vk::ImageLayout) {
        let transfer = vk::PipelineStageFlags2::ALL_TRANSFER;
        let barriers = [vk::ImageMemoryBarrier2::default()
            .src_stage_mask(transfer)
            .src_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
            .dst_stage_mask(transfer)
            .dst_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
            .old_layout(from)
            .new_layout(to)
            .image(image)
            .subresource_range(vk::ImageSubresourceRange {
                aspect_mask: vk::ImageAspectFlags::COLOR,
                base_mip_level: 0,
                level_count: 1,
                base_array_layer: 0,
                layer_count: 1,
            })];
        let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
        // SAFETY: guaranteed by the caller.
        unsafe { self.device.raw.cmd_pipeline_barrier2(self.commands, &info) };
    }
}

impl Drop for Slot<'_> {
    fn drop(&mut self) {
        let raw = &self.device.raw;
        // SAFETY: the device is idle afterwards, so that nothing uses the slot's objects.
        unsafe {
            let _ = raw.device_wait_idle();
            raw.destroy_fence(self.fence, None);
            raw.destroy_descriptor_pool(self.pool, None);
            raw.free_command_buffers(self.device.pool, &[self.commands]);
        }
    }
}

const UNDEFINED: ImageState = ImageState {
    layout: vk::ImageLayout::UNDEFINED,
    stage: vk::PipelineStageFlags2::ALL_COMMANDS,
    access: vk::AccessFlags2::NONE,
};
const COLOR_DRAWN: ImageState = ImageState {
    layout: vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
    stage: vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT,
    access: vk::AccessFlags2::COLOR_ATTACHMENT_WRITE,
};
const DEPTH_DRAWN: ImageState = ImageState {
    layout: vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL,
    stage: vk::PipelineStageFlags2::LATE_FRAGMENT_TESTS,
    access: vk::AccessFlags2::DEPTH_STENCIL_ATTACHMENT_WRITE,
};
const COPIED: ImageState = ImageState {
    layout: vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
    stage: vk::PipelineStageFlags2::ALL_TRANSFER,
    access: vk::AccessFlags2::TRANSFER_READ,
};

/// Moves all levels of a texture to another layout, after all earlier and before all later commands.
pub fn change(
    device: &Device,
    commands: vk::CommandBuffer,
    texture: &Texture<'_>,
    levels: u32,
    from: vk::ImageLayout,
    to: vk::ImageLayout,
) {
    let all = vk::PipelineStageFlags2::ALL_COMMANDS;
    let barriers = [vk::ImageMemoryBarrier2::default()
        .src_stage_mask(all)
        .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
        .dst_stage_mask(all)
        .dst_access_mask(vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE)
        .old_layout(from)
        .new_layout(to)
        .image(texture.raw)
        .subresource_range(texture.range(levels))];
    let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
    // SAFETY: the command buffer is being recorded for the device.
    unsafe { device.raw.cmd_pipeline_barrier2(commands, &info) };
}
