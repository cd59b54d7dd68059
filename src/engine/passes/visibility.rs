//! What a host's shaders see of a frame: the set of `shaders/include/gpc_visibility.glsl`.

use super::Resources;
use super::draws::Draws;
use super::own_layout::{OwnSet, SetLayout, whole};
use crate::vulkan::{Buffer, Gpu, VulkanError};
use ash::vk;
use std::sync::Arc;

/// The uniform block `GpcFrame`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct VisibilityUniform {
    pub scale: [f32; 2],
    pub half_size: [f32; 2],
    pub place_side: f32,
    pub boxes: u32,
    pub list: u32,
    pub padding: u32,
}

/// The set's layout, which hosts make their pipelines with.
pub(crate) fn visibility_layout(gpu: &Arc<Gpu>) -> Result<SetLayout, VulkanError> {
    let mut kinds = [vk::DescriptorType::STORAGE_BUFFER; 10];
    kinds[0] = vk::DescriptorType::UNIFORM_BUFFER;
    SetLayout::new(gpu, &kinds)
}

/// What a host's shaders see beside a frame's resources.
pub(crate) struct VisibleGeometry<'a> {
    pub triangles: &'a Buffer,
    /// In clip space.
    pub positions: vk::DescriptorBufferInfo,
    pub draws: &'a Draws,
    /// The draw of each triangle.
    pub draw_of: &'a Buffer,
    /// Where a list is sampled.
    pub locations: Option<vk::DescriptorBufferInfo>,
}

impl Resources {
    /// A set that shows these resources and a host's geometry.
    ///
    /// # Safety
    /// Positions and locations that are the host's outlive the set's use.
    pub(crate) unsafe fn visibility_set(
        &self,
        layout: &SetLayout,
        uniform: &Buffer,
        geometry: &VisibleGeometry<'_>,
    ) -> Result<OwnSet, VulkanError> {
        let set = layout.allocate()?;
        let draw_of = whole(geometry.draw_of);
        let buffers = [
            whole(uniform),
            whole(&self.bins),
            whole(&self.shade_order),
            whole(&self.records.buffer),
            whole(geometry.triangles),
            geometry.positions,
            whole(&self.shaded.buffer),
            whole(&geometry.draws.table),
            draw_of,
            // A frame's shaders read none.
            geometry.locations.unwrap_or(draw_of),
        ];
        // SAFETY: the set is new; of the host's buffers as the caller says, ours go with the frame.
        unsafe { set.write_buffers(0, &buffers) };
        Ok(set)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_uniform_block_is_the_shaders() {
        let text = include_str!("../../../shaders/include/gpc_visibility.glsl");
        let block = text
            .split("uniform GpcFrame {")
            .nth(1)
            .and_then(|rest| rest.split("} gpc_frame;").next())
            .unwrap();
        let fields: Vec<_> = block
            .lines()
            .filter_map(|line| line.split_once(';'))
            .map(|(field, _)| field.trim())
            .collect();
        assert_eq!(
            fields,
            [
                "vec2 scale",
                "vec2 half_size",
                "float place_side",
                "uint box",
                "uint list"
            ]
        );
        assert_eq!(size_of::<VisibilityUniform>() % 16, 0);
    }
}
