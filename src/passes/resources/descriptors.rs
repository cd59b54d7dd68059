//! Which buffer or image each binding of a frame's descriptor set shows.

use super::{Resources, SampleSet};
use crate::passes::layout::descriptor_type;
use crate::passes::{GpuScene, RasterTargets};
use crate::vulkan::Buffer;
use ash::vk;

impl Resources {
    /// Writes a set that was just allocated.
    pub(super) fn write_set(&self, set: &SampleSet, scene: &GpuScene, targets: &RasterTargets) {
        let geometry = &scene.geometry;
        let (positions, normals, tangents) = match &self.moving {
            Some(moving) => (&moving.positions, &moving.normals, &moving.tangents),
            None => (&geometry.positions, &geometry.normals, &geometry.tangents),
        };
        let mut texels = vec![
            (1, positions),
            (2, &geometry.triangles),
            (3, normals),
            (4, tangents),
            (5, &scene.geometry.uvs),
            (6, &scene.geometry.colors),
            (7, &scene.materials),
            (9, &scene.alpha_atlas),
            (10, &scene.geometry.blocks),
            (11, &self.placed.buffer),
            (16, &self.display),
            (24, &self.candidates),
            (27, &self.records),
            (29, &self.shaded),
            (32, &set.locations),
            (35, &self.filtered),
            (38, &self.pairs),
            (42, &self.sites.sites),
            (43, &self.sites.cells),
            (44, &self.sites.groups),
        ];
        if let (Some(moving), Some(motion)) = (&self.moving, &geometry.motion) {
            texels.extend([
                (46, &moving.moment),
                (47, &motion.resting),
                (48, &motion.influences),
                (49, &motion.displacements),
                (50, &moving.positions),
                (51, &moving.normals),
                (52, &moving.tangents),
            ]);
        }
        let texels: Vec<_> = texels
            .into_iter()
            .map(|(binding, view)| (binding, [view.view]))
            .collect();
        let whole = |buffer: &Buffer| {
            [vk::DescriptorBufferInfo::default()
                .buffer(buffer.raw)
                .range(vk::WHOLE_SIZE)]
        };
        let buffers = [
            (0, &set.uniform),
            (8, &scene.lights),
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
            (45, &self.sites.loads),
        ]
        .map(|(binding, buffer)| (binding, whole(buffer)));
        // A set shows either single-sampled or multisampled IDs; pipelines that could read the former but are
        // specialised not to see a placeholder. Without BLEND its binding shows the opaque IDs, which is not read either.
        let ids = targets.ids.view;
        let blend_ids = targets.blend_ids.as_ref().map_or(ids, |image| image.view);
        let images = match &targets.placeholder {
            Some(placeholder) => {
                let unread = placeholder.view;
                vec![(12, unread), (13, unread), (14, ids), (15, blend_ids)]
            }
            None => vec![(12, ids), (13, blend_ids), (40, targets.depth.view)],
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
        let writes: Vec<_> = texels.chain(buffers).chain(images).collect();
        // SAFETY: the set was just allocated and no frame uses it; every handle is alive and outlives the set.
        unsafe { self.layout.gpu.device.update_descriptor_sets(&writes, &[]) };
    }
}
