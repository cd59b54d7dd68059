//! The parts of the uniform block that say what a host lends.

use super::alpha::ROW;
use super::draw::PlacedDraws;
use super::viewport::ClipPlane;
use super::{ClipSpace, Geometry, HostError};
use crate::engine::sampler::uniform::{PlaneBlock, SceneBlock};

/// Trips that loops have on CPU devices, with some to spare; in each, a workgroup of `bin` takes 64 tiles of 32 pixels.
const TRIPS: u64 = 60_000;

/// Refuses images of more tiles than devices get through.
pub(super) fn check_size([width, height]: [u32; 2]) -> Result<(), HostError> {
    let most = TRIPS * 64 * 32;
    if u64::from(width) * u64::from(height) > most {
        return Err(HostError::Count {
            what: "the number of pixels",
            found: width.saturating_mul(height),
            most: most as u32,
        });
    }
    Ok(())
}

/// A host's triangles, as a recording draws them.
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

/// The part of the images, of this size, that a host's clip space lies on.
pub(super) fn plane_block(clip: &ClipSpace, plane: &ClipPlane, size: [u32; 2]) -> PlaneBlock {
    let [x, y] = plane.scale;
    // Depth in which larger is nearer: z, or w - z.
    let (z, z_of_w) = if clip.reversed_depth {
        (1.0, 0.0)
    } else {
        (-1.0, 1.0)
    };
    let columns = [
        [x, 0.0, 0.0, 0.0],
        [0.0, y, 0.0, 0.0],
        [0.0, 0.0, z, 0.0],
        [0.0, 0.0, z_of_w, 1.0],
    ];
    PlaneBlock {
        transform: columns.as_flattened().try_into().unwrap_or_default(),
        corner: plane.middle.map(|at| -at),
        size,
        interior: [[0, 0], size],
        ..PlaneBlock::default()
    }
}
