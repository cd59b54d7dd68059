//! The uniform block of what a host lends.

use super::alpha::ROW;
use super::draw::PlacedDraws;
use super::{Geometry, HostError};
use crate::engine::sampler::Settings;
use crate::engine::sampler::footprint::Footprints;
use crate::passes::{FrameUniform, ResourceSizes};

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

/// What images and lists have in common.
pub(super) fn uniform(
    geometry: &Geometry,
    settings: &Settings,
    sizes: &ResourceSizes,
    footprints: &Footprints,
    placed: &PlacedDraws,
) -> FrameUniform {
    let [width, height] = settings.size;
    let [x, y] = scale(geometry, settings.size);
    // Depth in which larger is nearer: z, or w - z.
    let (z, z_of_w) = if geometry.clip.reversed_depth {
        (1.0, 0.0)
    } else {
        (-1.0, 1.0)
    };
    FrameUniform {
        transform: [
            [x, 0.0, 0.0, 0.0],
            [0.0, y, 0.0, 0.0],
            [0.0, 0.0, z, 0.0],
            [0.0, 0.0, z_of_w, 1.0],
        ]
        .as_flattened()
        .try_into()
        .unwrap_or_default(),
        background: settings.background_rgba(),
        origin: settings.size.map(|side| 0.5 - 0.5 * side as f32),
        size: [width, height],
        tiles: [width.div_ceil(8), height.div_ceil(4)],
        triangle_count: placed.triangles,
        first_mask: placed.opaque,
        first_blend: placed.solid,
        material_vectors: ROW as u32,
        sample_count: settings.samples,
        bin_count: geometry.keys + 1,
        exposure: 1.0,
        footprint: footprints.centre,
        place_footprint: footprints.place,
        sample_footprint: footprints.sample,
        side: 1,
        reach: 0.5,
        ..FrameUniform::with_room(sizes)
    }
}

/// Clip space to pixels from the image's centre, y down.
pub(super) fn scale(geometry: &Geometry, size: [u32; 2]) -> [f32; 2] {
    let [x, y] = size.map(|side| 0.5 * side as f32);
    [x, if geometry.clip.y_up { -y } else { y }]
}
