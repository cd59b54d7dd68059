//! Data about a frame that a host's shaders can read: the set of `shaders/include/gpc_visibility.glsl`.

use super::draws::Draws;
use super::{Data, Resources};
use crate::engine::spirv::gpc_visibility_set;
use crate::vulkan::{Buffer, Descriptor, DescriptorSets, Gpu, SetLayout, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Uniform block about a frame for hosts' shaders.
pub(crate) use crate::engine::spirv::GpcFrame as VisibilityUniform;

/// Makes the layout of the set; hosts use it in the layouts of their pipelines.
pub(crate) fn visibility_layout(gpu: &Arc<Gpu>) -> Result<Arc<SetLayout>, VulkanError> {
    let bindings = gpc_visibility_set::ALL.map(|binding| (binding, vk::ShaderStageFlags::COMPUTE));
    Ok(Arc::new(SetLayout::new(gpu, &bindings)?))
}

/// Geometry that a host's shaders can read, besides a frame's resources.
pub(crate) struct VisibleGeometry<'a> {
    pub triangles: &'a Buffer,
    /// Positions in clip space.
    pub positions: vk::DescriptorBufferInfo,
    pub draws: &'a Draws,
    /// Draw of each triangle.
    pub draw_of: &'a Buffer,
    /// Locations, if a list is sampled.
    pub locations: Option<vk::DescriptorBufferInfo>,
}

impl Resources {
    /// Makes a set with these resources and a host's geometry.
    ///
    /// # Safety
    /// Positions and locations that belong to the host outlive the use of the set.
    pub(crate) unsafe fn visibility_set(
        &self,
        gpu: &Arc<Gpu>,
        layout: &Arc<SetLayout>,
        uniform: &Buffer,
        geometry: &VisibleGeometry<'_>,
    ) -> Result<DescriptorSets, VulkanError> {
        let mut own = DescriptorSets::new(gpu, false, std::slice::from_ref(layout), 1)?.remove(0);
        let draw_of = Descriptor::from(geometry.draw_of);
        let buffers = [
            (gpc_visibility_set::GPC_FRAME, uniform.into()),
            (gpc_visibility_set::GPC_KEYS, self.buffer(Data::Bins).into()),
            (gpc_visibility_set::GPC_ORDER, self.buffer(Data::ShadeOrder).into()),
            (gpc_visibility_set::GPC_FRAGMENTS, self.buffer(Data::Fragments).into()),
            (gpc_visibility_set::GPC_TRIANGLES, geometry.triangles.into()),
            (gpc_visibility_set::GPC_POSITIONS, geometry.positions.into()),
            (gpc_visibility_set::GPC_SHADED, self.buffer(Data::Shaded).into()),
            (gpc_visibility_set::GPC_DRAWS, (&geometry.draws.table).into()),
            (gpc_visibility_set::GPC_DRAW_OF, draw_of),
            // Without a list, shaders don't read this binding.
            (gpc_visibility_set::GPC_LOCATIONS, geometry.locations.map_or(draw_of, Descriptor::from)),
        ];
        // SAFETY: the set is new; the caller guarantees the host's buffers, and the others live as long as the frame.
        unsafe { own.write(&buffers) };
        Ok(own)
    }
}
