//! Buffers and images of a frame's descriptor sets.

use super::Resources;
use crate::engine::spirv::frame_set;
use crate::vulkan::{BoundDescriptor, Image, Memory, VulkanError, flat_image, read_image};
use ash::vk;

/// Views of triangle IDs and depth for passes, in the layout `SHADER_READ_ONLY_OPTIMAL`.
#[derive(Clone, Copy, Debug)]
pub struct IdViews {
    /// Triangle IDs.
    pub ids: vk::ImageView,
    /// IDs of the nearest BLEND triangles, if there are any.
    pub blend_ids: Option<vk::ImageView>,
    /// Depth, if `thin` reads it.
    pub depth: Option<vk::ImageView>,
    /// View bound instead of the single-sampled IDs if the IDs are multisampled.
    pub placeholder: Option<vk::ImageView>,
}

impl IdViews {
    /// Triangle IDs alone.
    pub(super) fn of_ids(ids: vk::ImageView) -> Self {
        Self { ids, blend_ids: None, depth: None, placeholder: None }
    }
}

/// Images of triangle IDs and depth that descriptor sets show.
#[derive(Clone, Copy, Debug)]
pub enum ShownIds {
    /// These, which outlive the sets.
    Drawn(IdViews),
    /// Those of `Resources::show_ids`, which is called before each recording.
    Later,
    /// No pass reads them.
    Unread,
}

/// Image of a pixel, which no pass reads.
pub(super) fn unread(memory: &Memory) -> Result<Image, VulkanError> {
    let info = flat_image(vk::Format::R32_UINT, [1, 1], vk::ImageUsageFlags::SAMPLED);
    memory.image("unread IDs", &info, vk::ImageAspectFlags::COLOR)
}

impl Resources {
    /// Writes sets that were just allocated, except the images of triangle IDs and depth; `others` belong to the scene,
    /// or to the frame's view of the scene.
    pub(super) fn write_sets(&mut self, others: &[BoundDescriptor]) {
        let Self { sets, scratch, .. } = self;
        for set in sets {
            let own =
                [(frame_set::FRAME, (&set.uniform).into()), (frame_set::PATTERN_OFFSETS, set.offsets.texels().into())];
            let shown: Vec<_> = others.iter().copied().chain(scratch.shown()).chain(own).collect();
            // SAFETY: the sets were just allocated and no frame uses them; every handle is alive and outlives them.
            unsafe { set.sets.write(&shown) };
        }
    }

    /// Sets the images of triangle IDs and depth that the descriptor sets show.
    ///
    /// # Safety
    /// No commands that use the sets are pending, and the views outlive those that are recorded from now on.
    pub(crate) unsafe fn show_ids(&self, shown: &IdViews) {
        // Pipelines read either the single-sampled or the multisampled IDs. With multisampled IDs, the bindings of
        // single-sampled IDs hold a placeholder, which no pipeline reads. Without BLEND IDs, their bindings hold the
        // opaque IDs, which no pipeline reads there either.
        let IdViews { ids, .. } = *shown;
        let blend_ids = shown.blend_ids.unwrap_or(ids);
        let images = match (shown.placeholder, shown.depth) {
            (Some(unread), _) => vec![
                (frame_set::IDS, unread),
                (frame_set::BLEND_IDS, unread),
                (frame_set::IDS_MS, ids),
                (frame_set::BLEND_IDS_MS, blend_ids),
            ],
            (None, Some(depth)) => {
                vec![(frame_set::IDS, ids), (frame_set::BLEND_IDS, blend_ids), (frame_set::RASTER_DEPTH, depth)]
            }
            (None, None) => vec![(frame_set::IDS, ids), (frame_set::BLEND_IDS, blend_ids)],
        };
        for set in &self.sets {
            for &(binding, view) in &images {
                // SAFETY: passed on to the caller.
                unsafe { set.sets.write_images(binding, &[read_image(view)]) };
            }
        }
    }
}
