//! Which buffer or image each binding of a frame's descriptor set shows.

use super::{Resources, SampleSet};
use crate::passes::Content;
use crate::passes::layout::descriptor_type;
use crate::vulkan::Buffer;
use ash::vk;

/// What shows triangle IDs and depth to passes, in the layout `SHADER_READ_ONLY_OPTIMAL`.
#[derive(Clone, Copy, Debug)]
pub struct IdViews {
    /// Triangle IDs.
    pub ids: vk::ImageView,
    /// IDs of the nearest BLEND triangles, where there are any.
    pub blend_ids: Option<vk::ImageView>,
    /// Depth, where `thin` reads it.
    pub depth: Option<vk::ImageView>,
    /// Stands for the single-sampled IDs where these are multisampled.
    pub placeholder: Option<vk::ImageView>,
}

impl Resources {
    /// Writes a set that was just allocated; `texels` by binding, and `lights`, belong to a scene or to what a frame sees of
    /// it: see `shaders/include/frame.glsl`.
    pub(crate) fn write_set(
        &self,
        set: &SampleSet,
        scene: &dyn Content,
        (texels, lights): (&[(u32, vk::BufferView)], &Buffer),
        shown: &IdViews,
    ) {
        let own_texels = [
            (16, &self.display),
            (24, &self.candidates),
            (27, &self.records),
            (29, &self.shaded),
            (32, &set.offsets),
            (35, &self.filtered),
            (38, &self.pairs),
            (57, &self.locations.order),
            (43, &self.locations.cells),
            (44, &self.locations.groups),
            (56, &self.shadow_words),
        ]
        .map(|(binding, texels)| (binding, texels.view));
        let listed = self.locations.locations.as_ref();
        let listed = listed.map(|listed| (42, listed.view));
        let texels: Vec<_> = texels
            .iter()
            .copied()
            .chain(own_texels)
            .chain(listed)
            .map(|(binding, view)| (binding, [view]))
            .collect();
        let whole = |buffer: &Buffer| {
            [vk::DescriptorBufferInfo::default()
                .buffer(buffer.raw)
                .range(vk::WHOLE_SIZE)]
        };
        let buffers = [
            (0, &set.uniform),
            (8, lights),
            (17, &self.display.buffer),
            (18, &self.color.buffer),
            (25, &self.candidates.buffer),
            (28, &self.records.buffer),
            (30, &self.shaded.buffer),
            (39, &self.pairs.buffer),
            (19, &self.counters),
            (20, &self.masks),
            (21, &self.tiles),
            (22, &self.tile_lists),
            (23, &self.survivors),
            (26, &self.headers),
            (31, &self.shade_order),
            (33, &self.bins),
            (34, &self.arguments),
            (36, &self.attributes),
            (37, &self.encoded),
            (41, &self.marks),
            (45, &self.locations.tile_loads),
            (54, &set.offsets.buffer),
        ]
        .map(|(binding, buffer)| (binding, whole(buffer)));
        // A set shows either single-sampled or multisampled IDs; pipelines that could read the former but are
        // specialised not to see a placeholder. Without BLEND its binding shows the opaque IDs, which is not read either.
        let IdViews { ids, .. } = *shown;
        let blend_ids = shown.blend_ids.unwrap_or(ids);
        let images = match (shown.placeholder, shown.depth) {
            (Some(unread), _) => vec![(12, unread), (13, unread), (14, ids), (15, blend_ids)],
            (None, Some(depth)) => vec![(12, ids), (13, blend_ids), (40, depth)],
            (None, None) => vec![(12, ids), (13, blend_ids)],
        };
        let images: Vec<_> = images
            .into_iter()
            .map(|(binding, view)| {
                let info = vk::DescriptorImageInfo::default()
                    .image_view(view)
                    .image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL);
                (binding, [info])
            })
            .collect();
        let environment = scene.environment_map().map(|map| [map]);
        let write = |binding: u32| {
            vk::WriteDescriptorSet::default()
                .dst_set(set.descriptor())
                .dst_binding(binding)
                .descriptor_type(descriptor_type(binding))
        };
        let texels = texels
            .iter()
            .map(|(binding, view)| write(*binding).texel_buffer_view(view));
        let buffers = buffers
            .iter()
            .map(|(binding, info)| write(*binding).buffer_info(info));
        let images = images
            .iter()
            .map(|(binding, info)| write(*binding).image_info(info));
        let environment = environment.as_ref().map(|map| write(53).image_info(map));
        let writes: Vec<_> = texels
            .chain(buffers)
            .chain(images)
            .chain(environment)
            .collect();
        // SAFETY: the set was just allocated and no frame uses it; every handle is alive and outlives the set.
        unsafe { self.layout.gpu.device.update_descriptor_sets(&writes, &[]) };
    }
}
