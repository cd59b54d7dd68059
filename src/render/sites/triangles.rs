//! The triangles of a scene as the host needs them, to look for thin ones and to know where sites see them.

use crate::scene::{DrawClass, Geometry};
use glam::DVec3;
use std::ops::Range;

/// Most triangles of a chunk.
const CHUNK: usize = 1024;

/// The triangles of a posed scene, in the order of their IDs.
#[derive(Clone, Debug, Default)]
pub(in crate::render) struct Triangles {
    /// What their positions are relative to.
    pub(super) origin: DVec3,
    positions: Vec<[f32; 3]>,
    corners: Vec<[u32; 3]>,
    pub(super) chunks: Vec<Chunk>,
}

/// Neighbouring triangles that are alike.
#[derive(Clone, Debug)]
pub(super) struct Chunk {
    /// Their indices, which are 1 less than their IDs.
    pub range: Range<usize>,
    pub double_sided: bool,
    /// Corners of the box around them.
    pub bounds: [DVec3; 2],
}

impl Triangles {
    /// The triangles of a pose.
    pub fn new(geometry: &Geometry) -> Self {
        use DrawClass::{BlendDoubleSided, MaskDoubleSided, OpaqueDoubleSided};
        let two = [OpaqueDoubleSided, MaskDoubleSided, BlendDoubleSided];
        let mut triangles = Self {
            origin: geometry.origin,
            positions: geometry.positions.clone(),
            corners: geometry.triangles.clone(),
            chunks: Vec::new(),
        };
        for draw in &geometry.draws {
            let first = draw.first_triangle as usize;
            let end = first + draw.triangle_count as usize;
            for start in (first..end).step_by(CHUNK) {
                let range = start..end.min(start + CHUNK);
                let chunk = Chunk {
                    bounds: triangles.bounds(range.clone()),
                    range,
                    double_sided: two.contains(&draw.class),
                };
                triangles.chunks.push(chunk);
            }
        }
        triangles
    }

    /// Corners of the box around a range of triangles.
    fn bounds(&self, range: Range<usize>) -> [DVec3; 2] {
        let corners = self.corners.get(range).unwrap_or(&[]).iter().flatten();
        let places = corners.map(|corner| self.position(*corner));
        places.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], at| {
            [low.min(at), high.max(at)]
        })
    }

    /// The corners of a triangle.
    pub(super) fn get(&self, index: usize) -> Option<[DVec3; 3]> {
        let corners = self.corners.get(index)?;
        Some(corners.map(|corner| self.position(corner)))
    }

    fn position(&self, corner: u32) -> DVec3 {
        let position = self.positions.get(corner as usize);
        DVec3::from_array(position.copied().unwrap_or_default().map(f64::from))
    }
}
