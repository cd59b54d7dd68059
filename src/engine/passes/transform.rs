//! transform: computes positions of a host's vertices in clip space.

use crate::engine::data::Draws;
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv::{self, transform_set};
use crate::vulkan::{Buffer, DescriptorSets, Specialized, VulkanError};
use ash::vk;

/// Push constants: scale and bias of a vertex attribute, ranges of positions and of draws, and where the attribute begins in the
/// host's buffer and how far apart two are, in units of 2 bytes.
pub(crate) use spirv::TransformPush as VertexCounts;

/// Makes the kernel. If the draws have matrices, a position has three numbers in object space, whose type is
/// `vertex_format`; otherwise, four floats in clip space.
///
/// # Errors
/// If the driver refuses it.
pub(crate) fn kernel(
    layout: &FrameLayout,
    draws: &Draws,
    vertex_format: u32,
) -> Result<Kernel<spirv::Transform>, VulkanError> {
    let object = draws.matrices.is_some();
    layout.kernel(&spirv::Transform { object, vertex_format })
}

/// Makes a set with the draws, the host's vertices, the matrices and the positions.
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
    positions: &Buffer,
) -> Result<DescriptorSets, VulkanError> {
    // Without matrices, the shader does not read this binding.
    let matrices = draws.matrices.as_ref().unwrap_or(&draws.table);
    let buffers = [
        (transform_set::DRAWS, (&draws.table).into()),
        (transform_set::VERTICES, vertices.into()),
        (transform_set::MATRICES, matrices.into()),
        (transform_set::POSITIONS_OUT, positions.into()),
    ];
    // SAFETY: the caller guarantees the host's buffer; the others live as long as the frame.
    unsafe { layout.own_set(spirv::Transform::INTERFACE, &buffers) }
}
