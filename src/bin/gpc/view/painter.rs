//! Drawing of the panel: egui's layout, recorded into the viewer's command buffers.

use super::device::Device;
use super::slot::SLOTS;
use ash::vk;
use egui_ash_renderer::{DynamicRendering, Options, Renderer, RendererError};
use gpc::vulkan::VulkanError;
use std::sync::Arc;

/// Renderer of egui's layouts.
pub struct Painter {
    renderer: Renderer,
    pool: vk::CommandPool,
    device: Arc<Device>,
}

/// A layout of egui that is ready to be drawn.
pub struct Painting {
    pub textures: egui::TexturesDelta,
    pub primitives: Vec<egui::ClippedPrimitive>,
    pub pixels_per_point: f32,
}

impl Painter {
    /// Makes a painter for images in this format.
    pub fn new(device: &Arc<Device>, format: vk::Format) -> anyhow::Result<Self> {
        let renderer = Renderer::with_gpu_allocator(
            device.allocator()?,
            device.handle.clone(),
            DynamicRendering { color_attachment_format: format, depth_attachment_format: None },
            Options { in_flight_frames: SLOTS, ..Options::default() },
        )?;
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(device.queue_family);
        // SAFETY: a plain creation on a live device.
        let pool = unsafe { device.handle.create_command_pool(&info, None) }
            .map_err(VulkanError::of("vkCreateCommandPool"))?;
        Ok(Self { renderer, pool, device: device.clone() })
    }

    /// Uploads changed textures, and waits for the device. The letters come with egui's first layout; later layouts
    /// rarely change a texture.
    pub fn upload(&mut self, painting: &Painting) -> anyhow::Result<()> {
        let changed = &painting.textures.set;
        if !changed.is_empty() {
            let queue = self.device.queue();
            self.renderer.set_textures(*queue, self.pool, changed).map_err(failure)?;
        }
        Ok(())
    }

    /// Frees textures that no commands use any longer.
    pub fn free(&mut self, textures: &[egui::TextureId]) -> anyhow::Result<()> {
        self.renderer.free_textures(textures).map_err(failure)
    }

    /// Records the drawing over an image, which is a colour attachment before and after.
    ///
    /// # Safety
    /// `commands` is being recorded for the device outside of a render pass, in the slot whose turn it is. `view`
    /// belongs to an image of this size and outlives the execution of the commands.
    pub unsafe fn record(
        &mut self,
        commands: vk::CommandBuffer,
        (view, extent): (vk::ImageView, vk::Extent2D),
        painting: &Painting,
    ) -> anyhow::Result<()> {
        let attachments = [vk::RenderingAttachmentInfo::default()
            .image_view(view)
            .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
            .load_op(vk::AttachmentLoadOp::LOAD)
            .store_op(vk::AttachmentStoreOp::STORE)];
        let info =
            vk::RenderingInfo::default().render_area(extent.into()).layer_count(1).color_attachments(&attachments);
        // SAFETY: guaranteed by the caller.
        unsafe { self.device.handle.cmd_begin_rendering(commands, &info) };
        let drawn = self.renderer.cmd_draw(commands, extent, painting.pixels_per_point, &painting.primitives);
        // SAFETY: as above.
        unsafe { self.device.handle.cmd_end_rendering(commands) };
        drawn.map_err(failure)
    }
}

/// Converts an error of egui's renderer, so that a lost device is recognised.
fn failure(error: RendererError) -> anyhow::Error {
    match error {
        RendererError::Vulkan(result) => VulkanError::of("drawing the panel")(result).into(),
        error => error.into(),
    }
}

impl Drop for Painter {
    fn drop(&mut self) {
        self.device.wait();
        // SAFETY: no commands of the pool are being executed.
        unsafe { self.device.handle.destroy_command_pool(self.pool, None) };
    }
}
