//! Normals from faces, for vertices that have none.

use glam::{DVec3, Vec3};

/// Whether a normal has a direction.
pub fn is_usable(n: &[f32; 3]) -> bool {
    n.iter().all(|x| x.is_finite()) && n.iter().any(|&x| x != 0.0)
}

/// Replaces normals without a direction by the mean of the normals of adjacent faces, weighted by area. Returns the
/// number of such normals; if no normal is usable, `normals` is emptied.
pub fn mend_normals(
    triangles: &[[u32; 3]],
    positions: &[[f32; 3]],
    normals: &mut Vec<[f32; 3]>,
) -> usize {
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
