//! Parts of the uniform block that depend on a host's geometry and images.

use super::alpha::ROW;
use super::draw::PlacedDraws;
use super::viewport::ClipPlane;
use super::{ClipSpace, Geometry, HostError};
use crate::engine::sampler::uniform::{PlaneBlock, SceneBlock};

/// Number of loop iterations that llvmpipe completes, with a margin: see MOST_TRIPS of `shaders/include/workarounds.glsl`. In each,
/// a workgroup of `bin` processes 64 tiles of 32 pixels.
const TRIPS: u64 = 60_000;

/// Checks that an image does not have more tiles than devices can process.
pub(super) fn check_size([width, height]: [u32; 2]) -> Result<(), HostError> {
    let most = TRIPS * 64 * 32;
    let found = u64::from(width) * u64::from(height);
    if found > most { Err(HostError::Pixels { found, most }) } else { Ok(()) }
}

/// Scene block of a host's triangles for a recording.
pub(super) fn scene_block(geometry: &Geometry, placed: &PlacedDraws) -> SceneBlock {
    SceneBlock {
        triangle_count: placed.triangles,
        first_mask: placed.opaque,
        first_blend: placed.solid,
        material_vectors: ROW as u32,
        bin_count: geometry.keys + 1,
        ..SceneBlock::default()
    }
}

/// Plane block of a frame's part of the images, `size` pixels large; `plane` is the mapping of clip space to the part.
pub(super) fn plane_block(clip: &ClipSpace, plane: &ClipPlane, size: [u32; 2]) -> PlaneBlock {
    let [x, y] = plane.scale;
    // Transformation to reversed depth, in which larger values are nearer: z, or w - z.
    let (z, z_of_w) = if clip.reversed_depth { (1.0, 0.0) } else { (-1.0, 1.0) };
    let columns = [[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0], [0.0, 0.0, z_of_w, 1.0]];
    PlaneBlock {
        transform: columns.as_flattened().try_into().unwrap_or_default(),
        corner: plane.middle.map(|at| -at),
        size,
        interior: [[0, 0], size],
        ..PlaneBlock::default()
    }
}
