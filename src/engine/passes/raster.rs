//! raster: draws depth and triangle ID of every pixel with the device's rasterizer. It is no
//! [`Pass`](crate::engine::pipelines::Pass), which declares dispatches, because it draws.

use super::filter::{self, Filter, FilteredDraws};
use crate::engine::data::{Content, IdViews};
use crate::engine::pipelines::FrameLayout;
use crate::engine::spirv::{self, frame_set};
use crate::vulkan::{
    Compiled, GraphicsPipeline, Image, Memory, Pipeline, Recorder, Specialized, VulkanError, flat_image,
};
use ash::vk;
use std::sync::Arc;

/// Format of the depth attachment; depth is reversed, so that larger values are nearer.
const DEPTH: vk::Format = vk::Format::D32_SFLOAT;

/// Images that `raster` draws: depth, IDs of the nearest opaque or MASK triangle, and IDs of the nearest BLEND
/// triangle in front of it.
pub struct RasterTargets {
    pub(crate) depth: Image,
    pub(crate) ids: Image,
    pub(crate) blend_ids: Option<Image>,
    /// Image bound instead of the single-sampled IDs if the IDs are multisampled.
    pub(crate) placeholder: Option<Image>,
}

impl RasterTargets {
    /// Makes images of `width` x `height` pixels.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn new(
        memory: &Memory,
        width: u32,
        height: u32,
        samples: vk::SampleCountFlags,
        has_blend: bool,
    ) -> Result<Self, VulkanError> {
        let image = |name, format, usage, aspect| {
            memory.image(name, &flat_image(format, [width, height], usage).samples(samples), aspect)
        };
        let color = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
        let format = id_format(samples);
        let single = vk::SampleCountFlags::TYPE_1;
        Ok(Self {
            depth: image(
                "depth",
                DEPTH,
                vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT | vk::ImageUsageFlags::SAMPLED,
                vk::ImageAspectFlags::DEPTH,
            )?,
            ids: image("triangle IDs", format, color, vk::ImageAspectFlags::COLOR)?,
            blend_ids: has_blend
                .then(|| image("BLEND triangle IDs", format, color, vk::ImageAspectFlags::COLOR))
                .transpose()?,
            placeholder: (samples != single)
                .then(|| {
                    let info = flat_image(id_format(single), [1, 1], color);
                    memory.image("placeholder", &info, vk::ImageAspectFlags::COLOR)
                })
                .transpose()?,
        })
    }

    /// Views of the images for passes.
    #[must_use]
    pub fn views(&self) -> IdViews {
        IdViews {
            ids: self.ids.view,
            blend_ids: self.blend_ids.as_ref().map(|image| image.view),
            depth: Some(self.depth.view),
            placeholder: self.placeholder.as_ref().map(|image| image.view),
        }
    }
}

/// Format of IDs: four bytes. A multisampled attachment need not support integers, so it has four 8-bit channels.
fn id_format(samples: vk::SampleCountFlags) -> vk::Format {
    if samples == vk::SampleCountFlags::TYPE_1 { vk::Format::R32_UINT } else { vk::Format::R8G8B8A8_UNORM }
}

/// Push constants: the matrix to pixel-scaled clip space and, as `instance`, words that map an index to a triangle.
pub(crate) use spirv::RasterVertexPush as RasterPush;

/// Consecutive triangles that are drawn at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RasterRun {
    pub push: RasterPush,
    pub first_index: u32,
    pub triangle_count: u32,
    pub double_sided: bool,
    pub masked: bool,
    /// Whether the triangles are composited; such triangles are drawn after all others.
    pub blended: bool,
}

/// Draws runs of triangles.
pub struct Raster {
    opaque: Arc<Pipeline>,
    masked: Option<Arc<Pipeline>>,
    filter: Option<Filter>,
}

impl Raster {
    /// Makes the pipelines that a scene needs. `filters` says whether long runs are filtered before they are drawn.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        samples: vk::SampleCountFlags,
        scene: &dyn Content,
        filters: bool,
    ) -> Result<Self, VulkanError> {
        let bytes = samples != vk::SampleCountFlags::TYPE_1;
        let (opaque, masked) = if bytes {
            (spirv::RASTER_OPAQUE_BYTES, spirv::RASTER_MASKED_BYTES)
        } else {
            (spirv::RASTER_OPAQUE, spirv::RASTER_MASKED)
        };
        let instanced = scene.is_instanced();
        let constants = &spirv::RasterFragment { instanced }.constants();
        let interface = spirv::RasterFragment::INTERFACE;
        let make = |code| {
            layout.cached(code, constants, samples.as_raw(), || {
                let pipeline = GraphicsPipeline {
                    vertex: spirv::RasterVertex::code(),
                    fragment: code,
                    interface,
                    constants,
                    samples,
                    color: id_format(samples),
                    channels: vk::ColorComponentFlags::RGBA,
                    depth: Some(DEPTH),
                    dynamic: &[vk::DynamicState::CULL_MODE],
                };
                pipeline.make(layout.of(interface))
            })
        };
        Ok(Self {
            opaque: make(opaque)?,
            masked: scene.has_mask().then(|| make(masked)).transpose()?,
            filter: filters.then(|| Filter::new(layout, scene)).transpose()?,
        })
    }

    /// Records the pass for the upper left `size` pixels. Only the pixels from `drawn[0]` to before `drawn[1]` are
    /// drawn; the others stay empty. Shaders can read the IDs afterwards.
    pub(crate) fn record(
        &self,
        recorder: &Recorder<'_>,
        runs: impl Iterator<Item = RasterRun> + Clone,
        targets: &RasterTargets,
        size: [u32; 2],
        drawn: [[u32; 2]; 2],
    ) {
        let runs = || filter::placed(runs.clone(), self.filter.is_some());
        if let Some(filter) = &self.filter {
            filter.record(recorder, runs());
        }
        let area = rectangle([0, 0], size);
        let scissor = rectangle(drawn[0], drawn[1]);
        let read = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        let draw = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
        recorder.pass(spirv::RasterFragment::INTERFACE, || {
            recorder.transition(&targets.depth, vk::ImageLayout::UNDEFINED, vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL);
            if let Some(placeholder) = &targets.placeholder {
                recorder.transition(placeholder, vk::ImageLayout::UNDEFINED, read);
            }
            recorder.transition(&targets.ids, vk::ImageLayout::UNDEFINED, draw);
            self.draw(
                recorder,
                runs().filter(|(run, _)| !run.blended),
                targets,
                &targets.ids,
                [area, scissor],
                vk::AttachmentLoadOp::CLEAR,
            );
            recorder.transition(&targets.ids, draw, read);
            if let Some(blend_ids) = &targets.blend_ids {
                recorder.transition(blend_ids, vk::ImageLayout::UNDEFINED, draw);
                self.draw(
                    recorder,
                    runs().filter(|(run, _)| run.blended),
                    targets,
                    blend_ids,
                    [area, scissor],
                    vk::AttachmentLoadOp::LOAD,
                );
                recorder.transition(blend_ids, draw, read);
            }
            recorder.transition(&targets.depth, vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL, read);
        });
    }

    #[allow(clippy::too_many_arguments)]
    fn draw(
        &self,
        recorder: &Recorder<'_>,
        runs: impl Iterator<Item = (RasterRun, Option<FilteredDraws>)>,
        targets: &RasterTargets,
        ids: &Image,
        [area, scissor]: [vk::Rect2D; 2],
        depth_load: vk::AttachmentLoadOp,
    ) {
        let (device, raw) = (recorder.device(), recorder.raw());
        let color = [vk::RenderingAttachmentInfo::default()
            .image_view(ids.view)
            .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(vk::AttachmentStoreOp::STORE)];
        let depth = vk::RenderingAttachmentInfo::default()
            .image_view(targets.depth.view)
            .image_layout(vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL)
            .load_op(depth_load)
            .store_op(vk::AttachmentStoreOp::STORE);
        let info = vk::RenderingInfo::default()
            .render_area(area)
            .layer_count(1)
            .color_attachments(&color)
            .depth_attachment(&depth);
        let viewport = vk::Viewport {
            x: 0.0,
            y: 0.0,
            width: area.extent.width as f32,
            height: area.extent.height as f32,
            min_depth: 0.0,
            max_depth: 1.0,
        };
        // SAFETY: guaranteed by the recorder's caller; the images are in the named layouts.
        unsafe {
            device.cmd_begin_rendering(raw, &info);
            device.cmd_set_viewport(raw, 0, &[viewport]);
            device.cmd_set_scissor(raw, 0, &[scissor]);
        }
        if self.filter.is_some() {
            let corners = recorder.shown(frame_set::CORNERS_OUT);
            // SAFETY: as above; the buffer was created for indices.
            unsafe { device.cmd_bind_index_buffer(raw, corners, 0, vk::IndexType::UINT32) };
        }
        for (run, filtered) in runs {
            let masked = self.masked.as_ref().filter(|_| run.masked);
            let pipeline = masked.unwrap_or(&self.opaque);
            recorder.bind(pipeline);
            let cull = if run.double_sided { vk::CullModeFlags::NONE } else { vk::CullModeFlags::BACK };
            recorder.push(pipeline, bytemuck::bytes_of(&run.push));
            // SAFETY: as above; the shader reads 3 vertices for each triangle of the run. `filter` has written the draws of its
            // triangles, and their indices.
            unsafe {
                device.cmd_set_cull_mode(raw, cull);
                match filtered {
                    None => device.cmd_draw(raw, 3 * run.triangle_count, 1, 3 * run.first_index, 0),
                    Some(draws) => {
                        let buffer = recorder.shown(frame_set::INDEXED_DRAWS_OUT);
                        for offset in draws.offsets() {
                            device.cmd_draw_indexed_indirect(raw, buffer, offset, 1, 0);
                        }
                    }
                }
            }
        }
        // SAFETY: as above.
        unsafe { device.cmd_end_rendering(raw) };
    }
}

/// Rectangle of the pixels from `low` to before `high`.
fn rectangle(low: [u32; 2], high: [u32; 2]) -> vk::Rect2D {
    vk::Rect2D {
        offset: vk::Offset2D { x: low[0] as i32, y: low[1] as i32 },
        extent: vk::Extent2D { width: high[0] - low[0], height: high[1] - low[1] },
    }
}
