//! What the triangles of any format need: assembly, normals and tangents.

pub mod normals;
pub mod tangent;
pub mod triangles;
