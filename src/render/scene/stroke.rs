//! Points and lines, which have a size in pixels and so another shape for each camera.

/// A vertex of a [`Geometry`](super::Geometry) that a renderer places for each camera: a corner of a point's disc or of a
/// line. The other vertices that it names are positions in space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stroke {
    /// Corner of the point or line.
    pub part: StrokePart,
    /// The vertex to place; its position is that of [`at`](Self::at) until then.
    pub vertex: u32,
    /// The point, or the end of a segment, that it belongs to.
    pub at: u32,
    /// The other end of the segment.
    pub other: u32,
    /// Index of the vertex at which the line goes on from `at`; `at` itself at its end.
    pub beyond: u32,
    /// Whether its normal is to face the camera, for want of one of its own.
    pub faces_camera: bool,
}

/// An edge of a mesh, drawn as a line of two triangles, whose corners a renderer places for each camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// The first of four vertices to place, which follow each other: the left corner of the first end, right and left of the
    /// second, and right of the first, as [`StrokePart`] has them.
    pub first_vertex: u32,
    /// The vertices at its ends.
    pub ends: [u32; 2],
    /// The vertices of its faces that are not the edge's: of the one that runs from the first end to the second, and of the
    /// one that runs back; an end of the edge where there is no such face.
    pub opposite: [u32; 2],
    /// Whether the edge shows as a silhouette alone: one of its faces is seen from the front, the other from behind.
    pub is_smooth: bool,
    /// Whether the edge also shows if its faces are seen from behind.
    pub is_double_sided: bool,
}

impl Edge {
    /// Number of an edge's corners.
    pub const CORNERS: u32 = 4;

    /// The end that each corner belongs to.
    pub(crate) fn corners(&self) -> [u32; 4] {
        let [from, to] = self.ends;
        [from, to, to, from]
    }

    /// The triangles that it is drawn by.
    pub(crate) fn triangles(&self) -> [[u32; 3]; 2] {
        [[0, 1, 2], [0, 2, 3]].map(|corners| corners.map(|corner| self.first_vertex + corner))
    }

    /// Edge with vertices counted from `first`, of a mesh that may be mirrored, so that faces turn the other way.
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

/// A corner of a point or line. Left and right are those of one who looks from the other end of the segment to the end
/// that the corner belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StrokePart {
    /// The left corner of a segment's end.
    Left,
    /// The right corner of a segment's end.
    Right,
    /// The middle of the triangle that fills a joint too sharp for a mitre.
    JointCentre,
    /// The next corner of that triangle, counter-clockwise.
    JointFirst,
    /// Last corner of a joint.
    JointSecond,
    /// A corner of the regular polygon that stands for a point's disc, counted counter-clockwise.
    Disc(u32),
}

impl StrokePart {
    /// Corners of the polygon that stands for a disc. It has the disc's area, and its border stays within 1.3 % of the
    /// radius of the disc's.
    pub const DISC_CORNERS: u32 = 16;

    /// The kind of corner in `shaders/stroke.comp`.
    pub(crate) fn code(self) -> u32 {
        match self {
            Self::Left => 0,
            Self::Right => 1,
            Self::JointCentre => 2,
            Self::JointFirst => 3,
            Self::JointSecond => 4,
            Self::Disc(_) => 5,
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
