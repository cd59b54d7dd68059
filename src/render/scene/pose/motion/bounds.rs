//! Box around a scene at any moment of a motion, computed without reading its vertices.
//!
//! The weights of a vertex's joints add up to 1, so that a skinned vertex lies between the positions to which its
//! joints' matrices take it. A part therefore lies within the boxes of the resting vertices of each joint, transformed
//! by the joint's matrix. Morph targets widen these boxes by the boxes around their displacements.

use super::{Moment, Motion, MotionPart};
use crate::scene::PosedGeometry;
use glam::{DMat3, DVec3};

/// Lowest and highest corner of a box.
type Box3 = [DVec3; 2];

const NOTHING: Box3 = [DVec3::INFINITY, DVec3::NEG_INFINITY];

/// Bounds of a motion, known before any of its moments.
pub(crate) struct MovingBounds {
    origin: DVec3,
    /// Box around the triangles that do not move.
    still: Box3,
    parts: Vec<PartBounds>,
}

/// Bounds of vertices that move in the same way.
struct PartBounds {
    /// Boxes around the resting vertices that each matrix of the part moves.
    resting: Vec<Box3>,
    /// Boxes around the displacements of each target.
    displacements: Vec<Box3>,
}

impl MovingBounds {
    /// Computes the bounds of a motion and its geometry, which has no instances.
    pub fn new(geometry: &PosedGeometry, motion: &Motion) -> Self {
        let mut moves = vec![false; geometry.positions.len()];
        for part in &motion.parts {
            let vertices = part.first_vertex as usize..(part.first_vertex + part.vertex_count) as usize;
            if let Some(moves) = moves.get_mut(vertices) {
                moves.fill(true);
            }
        }
        let corners = geometry.triangles.iter().flatten();
        let still = corners.filter_map(|&vertex| {
            let moves = moves.get(vertex as usize).copied().unwrap_or(true);
            let position = geometry.positions.get(vertex as usize)?;
            (!moves).then(|| vector(position))
        });
        Self {
            origin: geometry.origin,
            still: still.fold(NOTHING, with),
            parts: motion.parts.iter().map(|part| PartBounds::new(part, motion)).collect(),
        }
    }

    /// Box at a moment, in world space; `None` without triangles.
    pub fn at(&self, moment: &Moment) -> Option<(DVec3, DVec3)> {
        let mut all = self.still;
        for (part, at) in self.parts.iter().zip(&moment.parts) {
            let from = |first: u32| moment.vectors.get(first as usize..).unwrap_or(&[]);
            let weights = from(at.first_weight).iter().take(at.weight_count as usize);
            let displaced =
                part.displaced_by(weights.map(|&[weight, target, ..]| (f64::from(weight), target as usize)));
            let (matrices, _) = from(at.first_matrix).as_chunks::<3>();
            for (resting, rows) in part.resting.iter().zip(matrices) {
                if resting[0].cmple(resting[1]).all() {
                    let [low, high] = [0, 1].map(|end| resting[end] + displaced[end]);
                    all = carried([low, high], rows).into_iter().fold(all, with);
                }
            }
        }
        let [low, high] = all;
        (low.cmple(high).all()).then(|| (low + self.origin, high + self.origin))
    }
}

impl PartBounds {
    fn new(part: &MotionPart, motion: &Motion) -> Self {
        let count = part.vertex_count as usize;
        let mut resting = vec![NOTHING; part.matrix_count as usize];
        for vertex in 0..count {
            let Some([position, ..]) = motion.vertices.get(part.first_resting as usize + vertex) else {
                continue;
            };
            let mut hold = |matrix: usize| {
                if let Some(held) = resting.get_mut(matrix) {
                    *held = with(*held, vector(position));
                }
            };
            if part.sets == 0 {
                hold(0);
            }
            for set in 0..part.sets as usize {
                let at = part.first_influence as usize + set * count + vertex;
                let [joints, weights] = motion.influences.get(at).copied().unwrap_or_default();
                for (joint, weight) in joints.into_iter().zip(weights) {
                    if f32::from_bits(weight) != 0.0 {
                        hold(joint as usize);
                    }
                }
            }
        }
        let vectors = part.displacement_vectors as usize;
        let of_target = |target: u32| {
            let first = part.first_displacement as usize + target as usize * count * vectors;
            let all = motion.displacements.get(first..).unwrap_or(&[]);
            let positions = all.iter().step_by(vectors).take(count);
            positions.map(|v| vector(v)).fold(NOTHING, with)
        };
        Self { resting, displacements: (0..part.target_count).map(of_target).collect() }
    }

    /// Lowest and highest displacement of the vertices along each axis, for these weights of targets.
    fn displaced_by(&self, weights: impl Iterator<Item = (f64, usize)>) -> Box3 {
        weights.fold([DVec3::ZERO; 2], |[low, high], (weight, target)| {
            let [a, b] = self.displacements.get(target).map_or([DVec3::ZERO; 2], |ends| ends.map(|end| end * weight));
            [low + a.min(b), high + a.max(b)]
        })
    }
}

fn vector(values: &[f32]) -> DVec3 {
    let at = |axis: usize| values.get(axis).map_or(0.0, |&value| f64::from(value));
    DVec3::new(at(0), at(1), at(2))
}

fn with([low, high]: Box3, place: DVec3) -> Box3 {
    [low.min(place), high.max(place)]
}

/// Box around a box that was transformed by a matrix, given by its rows.
fn carried([low, high]: Box3, rows: &[[f32; 4]; 3]) -> Box3 {
    let linear = DMat3::from_cols(vector(&rows[0]), vector(&rows[1]), vector(&rows[2])).transpose();
    let offset = DVec3::from_array(rows.map(|[.., offset]| f64::from(offset)));
    let middle = linear * (0.5 * (low + high)) + offset;
    let absolute = DMat3::from_cols(linear.x_axis.abs(), linear.y_axis.abs(), linear.z_axis.abs());
    let half = absolute * (0.5 * (high - low));
    [middle - half, middle + half]
}

#[cfg(test)]
mod tests {
    use super::super::{MomentPart, PoseRequest};
    use super::*;
    use crate::render::random::Random;
    use std::sync::Arc;

    const VERTICES: usize = 40;
    const JOINTS: usize = 3;
    const TARGETS: usize = 2;

    /// A motion with a part that a node moves, and a part of random vertices with joints and morph targets.
    fn motion(random: &mut dyn FnMut() -> f32) -> Motion {
        let part = |first: u32, sets, matrix_count, target_count| MotionPart {
            placement: 0,
            mirrored: false,
            first_vertex: first,
            vertex_count: VERTICES as u32,
            first_resting: first,
            first_influence: 0,
            sets,
            first_displacement: 0,
            displacement_vectors: 3,
            matrix_count,
            target_count,
            is_flat: false,
        };
        let mut number = || 2.0 * random() - 1.0;
        let mut place = || [number(), number(), number(), 0.0];
        let vertices = (0..2 * VERTICES).map(|_| [place(), [0.0; 4], [0.0; 4]]).collect();
        let displacements = (0..3 * VERTICES * TARGETS).map(|_| place()).collect();
        let influences = (0..VERTICES).map(|v| {
            let weight = v as f32 / VERTICES as f32;
            [[v as u32 % 2, 2, 0, 0], [weight, 1.0 - weight, 0.0, 0.0].map(f32::to_bits)]
        });
        Motion {
            identity: Arc::default(),
            first_pose: 0,
            request: PoseRequest::default(),
            origin: DVec3::splat(10.0),
            lights: Vec::new(),
            changes_lights: false,
            materials: Vec::new(),
            placements: 1,
            parts: vec![part(0, 0, 1, 0), part(VERTICES as u32, 1, JOINTS as u32, TARGETS as u32)],
            vertices,
            influences: influences.collect(),
            displacements,
        }
    }

    fn moment(motion: &Motion, random: &mut dyn FnMut() -> f32) -> Moment {
        let mut vector = || [0; 4].map(|_| 4.0 * random() - 2.0);
        let mut vectors: Vec<[f32; 4]> = (0..3 * (1 + JOINTS)).map(|_| vector()).collect();
        vectors.extend((0..TARGETS).map(|target| [vector()[0], target as f32, 0.0, 0.0]));
        let part = |first_matrix, weight_count| MomentPart {
            first_matrix,
            first_weight: 3 * (1 + JOINTS as u32),
            weight_count,
        };
        Moment {
            identity: motion.identity.clone(),
            cameras: Vec::new(),
            materials: Vec::new(),
            lights: Vec::new(),
            vectors,
            parts: vec![part(0, 0), part(3, TARGETS as u32)],
        }
    }

    /// Position of a vertex, as `shaders/pose.comp` computes it.
    fn posed(motion: &Motion, moment: &Moment, vertex: usize) -> DVec3 {
        let row = |matrix: usize, axis: usize| moment.vectors[3 * matrix + axis].map(f64::from);
        let mut place = vector(&motion.vertices[vertex][0]);
        let mut rows = [0, 1, 2].map(|axis| row(0, axis));
        if let Some(v) = vertex.checked_sub(VERTICES) {
            for weight in &moment.vectors[3 * (1 + JOINTS)..] {
                let target = weight[1] as usize;
                place += f64::from(weight[0]) * vector(&motion.displacements[3 * (target * VERTICES + v)]);
            }
            let [joints, weights] = motion.influences[v];
            rows = [0, 1, 2].map(|axis| {
                let pairs = joints.into_iter().zip(weights.map(f32::from_bits));
                pairs.fold([0.0; 4], |sum, (joint, weight)| {
                    let row = row(1 + joint as usize, axis);
                    [0, 1, 2, 3].map(|i| sum[i] + f64::from(weight) * row[i])
                })
            });
        }
        DVec3::from_array(rows.map(|[x, y, z, w]| DVec3::new(x, y, z).dot(place) + w)) + motion.origin
    }

    #[test]
    fn boxes_hold_every_vertex_at_every_moment() {
        let mut numbers = Random::new(5);
        let mut random = || (numbers.bits() >> 40) as f32 / (1 << 24) as f32;
        let motion = motion(&mut random);
        let still = [[-9.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, 0.5]];
        let positions = vec![[1e3; 3]; 2 * VERTICES].into_iter().chain(still);
        let geometry = PosedGeometry {
            origin: motion.origin,
            positions: positions.collect(),
            triangles: (0..2 * VERTICES as u32 + 1).map(|v| [v, v + 1, v + 2]).collect(),
            ..PosedGeometry::default()
        };
        let bounds = MovingBounds::new(&geometry, &motion);
        let mut extents = 0.0;
        for _ in 0..50 {
            let moment = moment(&motion, &mut random);
            let (low, high) = bounds.at(&moment).unwrap();
            let still = still.iter().map(|at| vector(at) + motion.origin);
            let places = (0..2 * VERTICES).map(|vertex| posed(&motion, &moment, vertex)).chain(still);
            let exact = places.fold(NOTHING, with);
            assert!(low.cmple(exact[0] + 1e-9).all(), "{low} {exact:?}");
            assert!(high.cmpge(exact[1] - 1e-9).all(), "{high} {exact:?}");
            extents += (high - low).length() / (exact[1] - exact[0]).length();
        }
        // Rotated boxes and the largest displacements overestimate the extent, but by less than this.
        assert!(extents / 50.0 < 2.5, "{}", extents / 50.0);
    }
}
