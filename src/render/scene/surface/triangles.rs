//! Triangles of a primitive, whatever its topology (glTF 2.0, section 3.7.2.1).

use gltf::json::mesh::Mode;
use rayon::prelude::*;

/// Number of triangles that `count` indices make; 0 for topologies of points and lines.
pub fn number(mode: Mode, count: usize) -> usize {
    match mode {
        Mode::Triangles => count / 3,
        Mode::TriangleStrip | Mode::TriangleFan => count.saturating_sub(2),
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => 0,
    }
}

/// Triangles of `count` indices, and the number of indices that are left over.
pub fn assemble(mode: Mode, count: usize, index: impl Fn(usize) -> u32 + Sync) -> (Vec<[u32; 3]>, usize) {
    let triangle = |t: usize| match mode {
        Mode::Triangles => [index(3 * t), index(3 * t + 1), index(3 * t + 2)],
        // Every other triangle is reversed, so that all have the same winding.
        Mode::TriangleStrip => [index(t), index(t + 1 + t % 2), index(t + 2 - t % 2)],
        _ => [index(t + 1), index(t + 2), index(0)],
    };
    let left_over = match mode {
        Mode::Triangles => count % 3,
        _ if count < 3 => count,
        _ => 0,
    };
    let triangles = (0..number(mode, count)).into_par_iter().with_min_len(16_384).map(triangle).collect();
    (triangles, left_over)
}

/// Removes vertices, of `vertex_count`, that no triangle uses: returns the indices of the used ones in ascending
/// order, and renumbers the triangles. If few vertices are used, the cost does not depend on `vertex_count`, because
/// many primitives may share a large buffer.
pub fn compact(triangles: &mut [[u32; 3]], vertex_count: usize) -> Vec<u32> {
    const FEW: usize = 32;
    let corners = triangles.as_flattened_mut();
    if corners.len().saturating_mul(FEW) < vertex_count {
        let mut used = corners.to_vec();
        used.sort_unstable();
        used.dedup();
        for corner in corners {
            *corner = used.partition_point(|v| v < corner) as u32;
        }
        return used;
    }
    let mut place = vec![0_u32; vertex_count];
    for &corner in corners.iter() {
        place[corner as usize] = 1;
    }
    let mut used = Vec::new();
    for (vertex, place) in place.iter_mut().enumerate() {
        if *place != 0 {
            *place = used.len() as u32;
            used.push(vertex as u32);
        }
    }
    for corner in corners {
        *corner = place[*corner as usize];
    }
    used
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn topologies_keep_the_winding() {
        let assemble = |mode, count| assemble(mode, count, |i| i as u32);
        assert_eq!(assemble(Mode::Triangles, 7), (vec![[0, 1, 2], [3, 4, 5]], 1));
        assert_eq!(assemble(Mode::TriangleStrip, 5), (vec![[0, 1, 2], [1, 3, 2], [2, 3, 4]], 0));
        assert_eq!(assemble(Mode::TriangleFan, 4), (vec![[1, 2, 0], [2, 3, 0]], 0));
        assert_eq!(assemble(Mode::TriangleFan, 2), (vec![], 2));
    }

    #[test]
    fn compaction_is_the_same_with_few_and_many_vertices() {
        let original = [[5, 9, 7], [7, 9, 100]];
        for vertex_count in [101, 1_000_000] {
            let mut triangles = original;
            assert_eq!(compact(&mut triangles, vertex_count), [5, 7, 9, 100]);
            assert_eq!(triangles, [[0, 2, 1], [1, 2, 3]]);
        }
    }
}
