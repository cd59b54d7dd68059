//! The places at which visibility samples are shaded, in the world.

use crate::camera::Pinhole;
use crate::passes::VisibilitySample;
use crate::render::PreparedScene;
use crate::render::locations::partition::Partition;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::ops::Range;

/// A place of an opaque or MASK triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Receiver {
    /// Which record is shaded there.
    pub index: usize,
    /// ID of the triangle.
    pub id: u32,
    /// Where it is in the world.
    pub position: DVec3,
    /// At right angles to the triangle, on the side that is seen; of any length.
    pub normal: DVec3,
}

/// The records of a run.
pub(in crate::render::locations) struct Receivers<'a> {
    pub scene: &'a PreparedScene,
    pub pinhole: &'a Pinhole,
    pub partition: &'a Partition<'a>,
    pub run: &'a Range<usize>,
    pub records: &'a [VisibilitySample],
    /// Device memory that the run holds, in bytes.
    pub held_bytes: u64,
}

impl Receivers<'_> {
    /// The places of records of opaque and MASK triangles.
    pub(super) fn receivers(&self) -> Vec<Receiver> {
        let triangles = self.scene.triangles.get();
        let first_blend = self.scene.gpu_scene.first_blend();
        let records = self.records.par_iter().enumerate();
        records
            .filter(|(_, record)| (1..=first_blend).contains(&record.id()))
            .filter_map(|(index, record)| {
                let place = self.run.start + record.location();
                let location = self.partition.location(place);
                let [column, row] = location.jacobian.map(DVec2::from_array);
                let [x, y] = record.offset();
                let at = DVec2::from_array(location.uv) + column * x + row * y;
                let corners = triangles.get(record.id() as usize - 1)?;
                let ray = self.pinhole.ray(at);
                let start = ray.start - triangles.origin;
                let (position, normal) = seen_at(corners, start, ray.direction);
                Some(Receiver {
                    index,
                    id: record.id(),
                    position: triangles.origin + position,
                    normal,
                })
            })
            .collect()
    }
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
