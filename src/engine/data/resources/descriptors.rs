//! Buffers and images of a frame's descriptor sets.

use super::{Resources, SampleSet};
use crate::engine::spirv::frame_set;
use crate::vulkan::{BoundDescriptor, Descriptor, read_image};
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

impl Resources {
    /// Writes sets that were just allocated, except the images of triangle IDs and depth; `others` belong to the scene,
    /// or to the frame's view of the scene.
    pub(super) fn write_set(&self, set: &mut SampleSet, others: &[BoundDescriptor]) {
        let own_texels = [
            (frame_set::DISPLAY, &self.display),
            (frame_set::CANDIDATES, &self.candidates),
            (frame_set::RECORDS, &self.records),
            (frame_set::SHADED, &self.shaded),
            (frame_set::PATTERN_OFFSETS, &set.offsets),
            (frame_set::FILTERED, &self.filtered),
            (frame_set::PAIRS, &self.pairs),
            (frame_set::LOCATION_ORDER, &self.locations.order),
            (frame_set::LOCATION_CELLS, &self.locations.cells),
            (frame_set::LOCATION_GROUPS, &self.locations.groups),
            (frame_set::SHADOW_WORDS, &self.shadow_words),
        ]
        .map(|(binding, texels)| (binding, texels.texels()));
        let listed = self.locations.locations.as_ref();
        let listed = listed.map(|listed| (frame_set::LOCATIONS, listed.texels()));
        let texels = own_texels.into_iter().chain(listed);
        let texels = texels.map(|(binding, texels)| (binding, Descriptor::from(texels)));
        let buffers = [
            (frame_set::FRAME, &set.uniform),
            (frame_set::DISPLAY_OUT, &self.display.buffer),
            (frame_set::COLOR, &self.color.buffer),
            (frame_set::CANDIDATES_OUT, &self.candidates.buffer),
            (frame_set::RECORDS_OUT, &self.records.buffer),
            (frame_set::SHADED_OUT, &self.shaded.buffer),
            (frame_set::PAIRS_OUT, &self.pairs.buffer),
            (frame_set::COUNTERS, &self.counters),
            (frame_set::MASKS, &self.masks),
            (frame_set::TILES, &self.tiles),
            (frame_set::TILE_LISTS, &self.tile_lists),
            (frame_set::SURVIVORS, &self.survivors),
            (frame_set::CORNERS_OUT, &self.corners),
            (frame_set::INDEXED_DRAWS_OUT, &self.indexed_draws),
            (frame_set::HEADERS, &self.headers),
            (frame_set::SHADE_ORDER, &self.shade_order),
            (frame_set::BINS, &self.bins),
            (frame_set::ARGUMENTS, &self.arguments),
            (frame_set::ATTRIBUTES_OUT, &self.attributes),
            (frame_set::ENCODED, &self.encoded),
            (frame_set::MARKS, &self.marks),
            (frame_set::TILE_LOADS, &self.locations.tile_loads),
        ]
        .map(|(binding, buffer)| (binding, Descriptor::from(buffer)));
        let shown: Vec<_> = others.iter().copied().chain(texels).chain(buffers).collect();
        // SAFETY: the sets were just allocated and no frame uses them; every handle is alive and outlives them.
        unsafe { set.sets.write(&shown) };
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
