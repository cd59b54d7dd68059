//! coordinates: gathers texture coordinates of a host's vertices, one for each position in clip space.

use crate::engine::data::Draws;
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv::{self, coordinates_set};
use crate::vulkan::{Buffer, DescriptorSets, Specialized, VulkanError};
use ash::vk;

/// Makes the kernel for numbers of the type `vertex_format`. If draws have matrices, each draw has its own positions.
///
/// # Errors
/// If the driver refuses it.
pub(crate) fn kernel(
    layout: &FrameLayout,
    draws: &Draws,
    vertex_format: u32,
) -> Result<Kernel<spirv::Coordinates>, VulkanError> {
    let object = draws.matrices.is_some();
    layout.kernel(&spirv::Coordinates { object, vertex_format })
}

/// Makes a set with the draws, the host's vertices and the coordinates.
///
/// # Errors
/// If the driver refuses it.
///
/// # Safety
/// The host's buffer outlives the use of the set.
pub(crate) unsafe fn set(
    layout: &FrameLayout,
    draws: &Draws,
    vertices: vk::DescriptorBufferInfo,
    coordinates: &Buffer,
) -> Result<DescriptorSets, VulkanError> {
    let buffers = [
        (coordinates_set::DRAWS, (&draws.table).into()),
        (coordinates_set::VERTICES, vertices.into()),
        (coordinates_set::COORDINATES_OUT, coordinates.into()),
    ];
    // SAFETY: the caller guarantees the host's buffer; the others live as long as the frame.
    unsafe { layout.own_set(spirv::Coordinates::INTERFACE, &buffers) }
}
