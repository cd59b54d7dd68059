//! What the triangles, points and lines of any format need: assembly, normals and tangents.

pub mod normals;
pub mod strokes;
pub mod tangent;
pub mod triangles;
