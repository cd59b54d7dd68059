//! patch: draws the colours of superpixels, or of all pixels, into a host's image. It is no
//! [`Pass`](crate::engine::pipelines::Pass), which declares dispatches, because it draws.

use crate::engine::pipelines::FrameLayout;
use crate::engine::spirv;
use crate::vulkan::{Compiled, GraphicsPipeline, Pipeline, Recorder, Specialized, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Pixels that [`Patch`] draws; all others stay unchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Patched {
    /// Superpixels.
    Superpixels,
    /// Superpixels, some of which [`grow`](super::grow) has added.
    Grown,
    /// All pixels.
    All,
}

/// Draws colours into an image.
pub(crate) struct Patch {
    pipeline: Arc<Pipeline>,
}

impl Patch {
    /// Makes the pipeline for images of a format, which hold linear light or, if `encoded`, sRGB codes as plain
    /// numbers. With `keep_alpha`, the image keeps its alpha.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(
        layout: &FrameLayout,
        format: vk::Format,
        encoded: bool,
        keep_alpha: bool,
        patched: Patched,
    ) -> Result<Self, VulkanError> {
        let shader = spirv::PatchFragment { encoded, grown: patched == Patched::Grown, all: patched == Patched::All };
        let (code, interface) = (spirv::PatchFragment::code(), spirv::PatchFragment::INTERFACE);
        let constants = &shader.constants();
        // The numbers of formats are below 2^31.
        let variant = format.as_raw() as u32 | u32::from(keep_alpha) << 31;
        let all = vk::ColorComponentFlags::RGBA;
        let pipeline = layout.cached(code, constants, variant, || {
            let pipeline = GraphicsPipeline {
                vertex: spirv::PatchVertex::code(),
                fragment: code,
                interface,
                constants,
                samples: vk::SampleCountFlags::TYPE_1,
                color: format,
                channels: if keep_alpha { all & !vk::ColorComponentFlags::A } else { all },
                depth: None,
                dynamic: &[],
            };
            pipeline.make(layout.of(interface))
        })?;
        Ok(Self { pipeline })
    }

    /// Records the pass for a part of a view, whose image has the layout `COLOR_ATTACHMENT_OPTIMAL`.
    pub fn record(&self, recorder: &Recorder<'_>, view: vk::ImageView, area: vk::Rect2D) {
        recorder.pass(spirv::PatchFragment::INTERFACE, || {
            self.draw(recorder, view, area);
        });
    }

    fn draw(&self, recorder: &Recorder<'_>, view: vk::ImageView, area: vk::Rect2D) {
        let (device, raw) = (recorder.device(), recorder.raw());
        let color = [vk::RenderingAttachmentInfo::default()
            .image_view(view)
            .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
            .load_op(vk::AttachmentLoadOp::LOAD)
            .store_op(vk::AttachmentStoreOp::STORE)];
        let info = vk::RenderingInfo::default().render_area(area).layer_count(1).color_attachments(&color);
        let viewport = vk::Viewport {
            x: area.offset.x as f32,
            y: area.offset.y as f32,
            width: area.extent.width as f32,
            height: area.extent.height as f32,
            min_depth: 0.0,
            max_depth: 1.0,
        };
        // SAFETY: guaranteed by the recorder's caller; the view's image has the named layout.
        unsafe { device.cmd_begin_rendering(raw, &info) };
        recorder.bind(&self.pipeline);
        // SAFETY: as above.
        unsafe {
            device.cmd_set_viewport(raw, 0, &[viewport]);
            device.cmd_set_scissor(raw, 0, &[area]);
            device.cmd_draw(raw, 3, 1, 0, 0);
            device.cmd_end_rendering(raw);
        }
    }
}
