//! Surfaces of all formats: assembly of triangles, points and lines, normals and tangents.

pub mod normals;
pub mod strokes;
pub mod tangent;
pub mod triangles;
