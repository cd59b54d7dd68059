//! Points and lines. Their size is in pixels, so that they have another shape for each camera.

use crate::engine::spirv;

/// Vertex of a [`PosedGeometry`](super::PosedGeometry) that a renderer places for each camera: a corner of a point's disc or of
/// a line. The other vertices that it refers to are positions in space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stroke {
    /// Corner of the point or line.
    pub part: StrokePart,
    /// Index of the vertex to place. Until the vertex is placed, it has the position of [`at`](Self::at).
    pub vertex: u32,
    /// Index of the vertex at the point, or at the segment's end, to which the corner belongs.
    pub at: u32,
    /// Index of the vertex at the other end of the segment.
    pub other: u32,
    /// Index of the vertex to which the line continues from `at`; `at` itself at the end of the line.
    pub beyond: u32,
    /// Whether the vertex's normal faces the camera, because the vertex has no normal of its own.
    pub faces_camera: bool,
}

/// Edge of a mesh, drawn as a line of two triangles whose corners a renderer places for each camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Index of the first of four consecutive vertices to place: the left corner of the first end, the right and left
    /// corners of the second end, and the right corner of the first, as in [`StrokePart`].
    pub first_vertex: u32,
    /// Indices of the vertices at the edge's ends.
    pub ends: [u32; 2],
    /// Indices of the third vertices of the edge's two faces. The edge runs from the first end to the second in the
    /// first face, and back in the second. For a missing face, the index is that of an end of the edge.
    pub opposite: [u32; 2],
    /// Whether the edge is visible only as a silhouette, between a face seen from the front and one seen from behind.
    pub is_smooth: bool,
    /// Whether the edge is visible even if its faces are seen from behind.
    pub is_double_sided: bool,
}

impl Edge {
    /// Number of an edge's corners.
    pub const CORNERS: u32 = 4;

    /// The end to which each corner belongs.
    pub(crate) fn corners(&self) -> [u32; 4] {
        let [from, to] = self.ends;
        [from, to, to, from]
    }

    /// The triangles by which the edge is drawn.
    pub(crate) fn triangles(&self) -> [[u32; 3]; 2] {
        [[0, 1, 2], [0, 2, 3]].map(|corners| corners.map(|corner| self.first_vertex + corner))
    }

    /// Edge whose vertices are counted from `first`, of a mesh that may be mirrored, which swaps the faces.
    pub(crate) fn placed(self, first: u32, mirrored: bool) -> Self {
        let [a, b] = self.opposite.map(|v| v + first);
        Self {
            first_vertex: self.first_vertex + first,
            ends: self.ends.map(|v| v + first),
            opposite: if mirrored { [b, a] } else { [a, b] },
            ..self
        }
    }
}

/// Corner of a point or line. Left and right are seen when looking from the other end of the segment to the corner's
/// own end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StrokePart {
    /// The left corner of a segment's end.
    Left,
    /// The right corner of a segment's end.
    Right,
    /// The middle of the triangle that fills a joint too sharp for a mitre.
    JointCentre,
    /// The first corner of that triangle on the border, counter-clockwise.
    JointFirst,
    /// The last corner of that triangle.
    JointSecond,
    /// A corner of the regular polygon that approximates a point's disc, counted counter-clockwise.
    Disc(u32),
}

impl StrokePart {
    /// Number of corners of the polygon that approximates a disc. The polygon has the disc's area, and its border is
    /// within 1.3 % of the radius from the disc's.
    pub const DISC_CORNERS: u32 = 16;

    /// The kind of corner in `shaders/stroke.comp`.
    pub(crate) fn code(self) -> u32 {
        match self {
            Self::Left => spirv::CORNER_LEFT,
            Self::Right => spirv::CORNER_RIGHT,
            Self::JointCentre => spirv::CORNER_JOINT_CENTRE,
            Self::JointFirst => spirv::CORNER_JOINT_FIRST,
            Self::JointSecond => spirv::CORNER_JOINT_SECOND,
            Self::Disc(_) => spirv::CORNER_DISC,
        }
    }

    /// Offset of a disc's corner from its centre, x to the right and y down, in radii; zero for other corners.
    pub(crate) fn offset(self) -> [f32; 2] {
        let Self::Disc(index) = self else {
            return [0.0; 2];
        };
        let step = std::f64::consts::TAU / f64::from(Self::DISC_CORNERS);
        let radius = (step / step.sin()).sqrt();
        let (sin, cos) = (step * f64::from(index)).sin_cos();
        [radius * cos, -radius * sin].map(|x| x as f32)
    }
}
