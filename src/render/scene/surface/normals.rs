//! Normals from faces, for vertices that have none.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Whether a normal has a direction.
pub fn is_usable(n: &[f32; 3]) -> bool {
    n.iter().all(|x| x.is_finite()) && n.iter().any(|&x| x != 0.0)
}

/// Turns triangles around whose corners' normals point to their back, so that the front is the side of the normals. For formats
/// whose order of corners is no convention.
pub fn turn_to_normals(triangles: &mut [[u32; 3]], positions: &[[f32; 3]], normals: &[[f32; 3]]) {
    if normals.is_empty() {
        return;
    }
    let vector = |stream: &[[f32; 3]], v: u32| Vec3::from_array(stream[v as usize]).as_dvec3();
    let usable = |v: &u32| is_usable(&normals[*v as usize]);
    triangles.par_iter_mut().with_min_len(16_384).for_each(|triangle| {
        let [a, b, c] = triangle.map(|v| vector(positions, v));
        let corners = triangle.iter().filter(|v| usable(v));
        let normal: DVec3 = corners.map(|&v| vector(normals, v).normalize_or_zero()).sum();
        if normal.dot((b - a).cross(c - a)) < 0.0 {
            triangle.swap(1, 2);
        }
    });
}

/// Replaces normals without a direction by the mean of the normals of adjacent faces, weighted by area. Returns the
/// number of such normals; if no normal is usable, `normals` is emptied.
pub fn mend_normals(triangles: &[[u32; 3]], positions: &[[f32; 3]], normals: &mut Vec<[f32; 3]>) -> usize {
    let unusable = normals.iter().filter(|n| !is_usable(n)).count();
    if unusable == normals.len() {
        normals.clear();
        return unusable;
    }
    if unusable == 0 {
        return 0;
    }
    let at = |v: u32| Vec3::from_array(positions[v as usize]).as_dvec3();
    let mut sums = vec![DVec3::ZERO; normals.len()];
    for &[a, b, c] in triangles {
        let face = (at(b) - at(a)).cross(at(c) - at(a));
        for v in [a, b, c] {
            sums[v as usize] += face;
        }
    }
    for (normal, sum) in normals.iter_mut().zip(sums) {
        if !is_usable(normal) {
            *normal = sum.normalize_or(DVec3::Z).as_vec3().to_array();
        }
    }
    unusable
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_turn_to_the_side_of_their_normals() {
        let positions = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]];
        let turned = |z: [f32; 3]| {
            let mut triangles = [[0, 1, 2]];
            turn_to_normals(&mut triangles, &positions, &z.map(|z| [0.2, 0.0, z]));
            triangles[0]
        };
        assert_eq!(turned([1.0; 3]), [0, 1, 2]);
        assert_eq!(turned([-1.0; 3]), [0, 2, 1]);
        // Most corners decide, however long their normals are; a normal that is none has no say.
        assert_eq!(turned([9.0, -1.0, -1.0]), [0, 2, 1]);
        assert_eq!(turned([f32::NAN, -1.0, 0.0]), [0, 2, 1]);
        assert_eq!(turned([f32::NAN, 1.0, f32::INFINITY]), [0, 1, 2]);
    }
}
