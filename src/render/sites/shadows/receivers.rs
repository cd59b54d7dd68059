//! The points that sites see, in the world.

use crate::camera::{Pinhole, Site};
use crate::render::sites::Triangles;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// A point of a triangle that a site sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Receiver {
    /// The site's place in the caller's list.
    pub index: usize,
    /// ID of the triangle.
    pub id: u32,
    /// Where it is in the world.
    pub position: DVec3,
    /// At right angles to the triangle, on the side that is seen; of any length.
    pub normal: DVec3,
}

/// Where sites of a pinhole see triangles of these IDs; those that see none are left out.
pub(super) fn receivers(
    triangles: &Triangles,
    pinhole: &Pinhole,
    sites: &[Site],
    ids: &[u32],
) -> Vec<Receiver> {
    let seen = sites.par_iter().zip(ids).enumerate();
    seen.filter_map(|(index, (site, id))| {
        let corners = triangles.get(id.checked_sub(1)? as usize)?;
        let ray = pinhole.ray(DVec2::from_array(site.uv));
        let (position, normal) = seen_at(corners, ray.start - triangles.origin, ray.direction);
        Some(Receiver {
            index,
            id: *id,
            position: triangles.origin + position,
            normal,
        })
    })
    .collect()
}

/// The point of a triangle on a ray, or the nearest one that its plane has where the device, which rounds positions to
/// 32 bits, sees the triangle beside the ray; and the normal on the side that the ray meets.
fn seen_at([a, b, c]: [DVec3; 3], start: DVec3, direction: DVec3) -> (DVec3, DVec3) {
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(ac);
    let distance = normal.dot(a - start) / normal.dot(direction);
    let ap = start + direction * distance - a;
    let square = normal.length_squared();
    let of_b = ap.cross(ac).dot(normal) / square;
    let of_c = ab.cross(ap).dot(normal) / square;
    let weights = DVec3::new(1.0 - of_b - of_c, of_b, of_c).max(DVec3::ZERO);
    let sum = weights.element_sum();
    // Seen edge-on, any of its points is as near as another.
    let weights = if sum.is_finite() && sum > 0.0 {
        weights / sum
    } else {
        DVec3::splat(1.0 / 3.0)
    };
    let position = a * weights.x + b * weights.y + c * weights.z;
    let towards_start = -normal.dot(direction).signum();
    (position, normal * towards_start)
}
