//! The triangles of a scene as the host needs them, to look for thin ones.

use crate::scene::{DrawClass, Geometry, VertexStreams};
use glam::DVec3;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::{Mutex, OnceLock, PoisonError};

/// Most triangles of a chunk.
const CHUNK: usize = 1024;

/// The triangles of a posed scene, put in world space once they are asked for.
pub(in crate::render) struct HostTriangles {
    /// Without what vertices have beside their positions; nothing once `made` is there.
    geometry: Mutex<Option<Geometry>>,
    made: OnceLock<Triangles>,
}

impl HostTriangles {
    pub fn new(geometry: &Geometry) -> Self {
        let geometry = Geometry {
            origin: geometry.origin,
            positions: geometry.positions.clone(),
            streams: VertexStreams::default(),
            triangles: geometry.triangles.clone(),
            draws: geometry.draws.clone(),
            instances: geometry.instances.clone(),
            strokes: Vec::new(),
            edges: Vec::new(),
        };
        Self {
            geometry: Mutex::new(Some(geometry)),
            made: OnceLock::new(),
        }
    }

    pub fn get(&self) -> &Triangles {
        self.made.get_or_init(|| {
            let mut held = self.geometry.lock().unwrap_or_else(PoisonError::into_inner);
            let geometry = held.take().unwrap_or_default();
            match geometry.flat() {
                Cow::Owned(flat) => Triangles::new(flat),
                Cow::Borrowed(_) => Triangles::new(geometry),
            }
        })
    }
}

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
    fn new(geometry: Geometry) -> Self {
        use DrawClass::{BlendDoubleSided, MaskDoubleSided, OpaqueDoubleSided};
        let two = [OpaqueDoubleSided, MaskDoubleSided, BlendDoubleSided];
        let mut triangles = Self {
            origin: geometry.origin,
            positions: geometry.positions,
            corners: geometry.triangles,
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
