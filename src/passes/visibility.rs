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
    pub padding: [u32; 2],
}

/// The set's layout, which hosts make their pipelines with.
pub(crate) fn visibility_layout(gpu: &Arc<Gpu>) -> Result<SetLayout, VulkanError> {
    let mut kinds = [vk::DescriptorType::STORAGE_BUFFER; 9];
    kinds[0] = vk::DescriptorType::UNIFORM_BUFFER;
    SetLayout::new(gpu, &kinds)
}

impl Resources {
    /// A set that shows these resources, triangles, positions in clip space, draws and the draw of each triangle.
    ///
    /// # Safety
    /// Positions that are the host's outlive the set's use.
    pub(crate) unsafe fn visibility_set(
        &self,
        layout: &SetLayout,
        uniform: &Buffer,
        triangles: &Buffer,
        positions: vk::DescriptorBufferInfo,
        draws: &Draws,
        draw_of: &Buffer,
    ) -> Result<OwnSet, VulkanError> {
        let set = layout.allocate()?;
        let buffers = [
            whole(uniform),
            whole(&self.bins),
            whole(&self.shade_order),
            whole(&self.records.buffer),
            whole(triangles),
            positions,
            whole(&self.shaded.buffer),
            whole(&draws.table),
            whole(draw_of),
        ];
        // SAFETY: the set is new; of the host's buffer as the caller says, ours go with the frame.
        unsafe { set.write_buffers(0, &buffers) };
        Ok(set)
    }
}
