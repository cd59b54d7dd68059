//! World-space triangles of one scene at one moment.

use glam::DVec3;

/// How a draw's triangles are rasterized; the order of the variants is the order of [`Geometry::draws`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DrawClass {
    /// Opaque, back faces culled.
    Opaque,
    /// Opaque, both faces drawn.
    OpaqueDoubleSided,
    /// Alpha-tested, back faces culled.
    Mask,
    /// Alpha-tested, both faces drawn.
    MaskDoubleSided,
    /// Composited over what lies behind, back faces culled.
    Blend,
    /// Composited over what lies behind, both faces drawn.
    BlendDoubleSided,
}

/// A run of triangles with one material and one class.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draw {
    /// Index of its first triangle in [`Geometry::triangles`].
    pub first_triangle: u32,
    /// Number of triangles, at least 1.
    pub triangle_count: u32,
    /// Index into [`crate::scene::Scene::materials`].
    pub material: u32,
    /// How the triangles are rasterized.
    pub class: DrawClass,
}

/// Vertex attributes beside the position. A stream that no primitive of the scene needs is empty;
/// otherwise it has one entry a vertex, with glTF's defaults where a primitive lacks it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VertexStreams {
    /// Unit normals in world space; never empty when there are vertices (flat normals are generated where absent).
    pub normals: Vec<[f32; 3]>,
    /// Unit tangents in world space, `w` is the bitangent's sign. Only where a material has a normal texture.
    pub tangents: Vec<[f32; 4]>,
    /// TEXCOORD_0 in `[0..2]`, TEXCOORD_1 in `[2..4]`, untransformed.
    pub uvs: Vec<[f32; 4]>,
    /// COLOR_0, linear, straight alpha, default opaque white.
    pub colors: Vec<[f32; 4]>,
}

/// Every triangle of a scene in world space, ready for upload.
///
/// Front faces wind counter-clockwise seen from outside, also under negative scale: the
/// winding is mended when a node mirrors. Triangle `i` has the ID `i + 1`; 0 is background.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Geometry {
    /// World position of the point that [`positions`](Self::positions) are relative to, so that a
    /// scene far from its origin keeps its precision.
    pub origin: DVec3,
    /// Positions relative to [`origin`](Self::origin); finite.
    pub positions: Vec<[f32; 3]>,
    /// The other attributes, one entry a vertex in each stream that is not empty.
    pub streams: VertexStreams,
    /// Vertex indices of each triangle; in range.
    pub triangles: Vec<[u32; 3]>,
    /// Runs that partition `triangles`, sorted by [`DrawClass`], then by order in the file.
    pub draws: Vec<Draw>,
}

impl Geometry {
    /// Smallest and largest corner of the axis-aligned box around all vertices that a triangle
    /// uses, in world space; `None` without triangles.
    #[must_use]
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let mut corners = self
            .triangles
            .iter()
            .flatten()
            .map(|&v| DVec3::from_array(self.positions[v as usize].map(f64::from)));
        let first = corners.next()?;
        let (low, high) = corners.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
        Some((low + self.origin, high + self.origin))
    }
}
