//! adopt: converts a host's triangles to the form that the other passes read.

use crate::engine::data::Draws;
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv::{self, adopt_set};
use crate::vulkan::{Buffer, Descriptor, DescriptorSets, Specialized, VulkanError};
use ash::vk;

/// Push constants of a dispatch: ranges of triangles and indices, the number of draws, the topology and the front face.
pub(crate) use spirv::AdoptPush as AdoptedCounts;

/// Makes the kernel: for 16-bit indices if `are_short` is true, for 32-bit indices if it is false, and for
/// vertices without indices if it is `None`.
///
/// # Errors
/// If the driver refuses it.
pub(crate) fn kernel(layout: &FrameLayout, are_short: Option<bool>) -> Result<Kernel<spirv::Adopt>, VulkanError> {
    let shader = spirv::Adopt { short: are_short.unwrap_or_default(), indexed: are_short.is_some() };
    layout.kernel(&shader)
}

/// Makes a set with the draws, the host's indices if there are any, the triangles, and the draw of each triangle.
///
/// # Errors
/// If the driver refuses it.
///
/// # Safety
/// The host's buffer outlives the use of the set.
pub(crate) unsafe fn set(
    layout: &FrameLayout,
    draws: &Draws,
    indices: Option<vk::DescriptorBufferInfo>,
    triangles: &Buffer,
    draw_of: &Buffer,
) -> Result<DescriptorSets, VulkanError> {
    let buffers = [
        (adopt_set::DRAWS, (&draws.table).into()),
        (adopt_set::INDICES, indices.map_or_else(|| (&draws.table).into(), Descriptor::from)),
        (adopt_set::TRIANGLES_OUT, triangles.into()),
        (adopt_set::DRAW_OF_OUT, draw_of.into()),
    ];
    // SAFETY: the caller guarantees the host's buffer; the others live as long as the frame.
    unsafe { layout.own_set(spirv::Adopt::INTERFACE, &buffers) }
}
