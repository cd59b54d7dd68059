//! World-space triangles of one scene at one moment.

use super::material::{AlphaMode, Material};
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

impl DrawClass {
    /// How surfaces of a material are rasterized.
    #[must_use]
    pub fn of(material: &Material) -> Self {
        match (material.alpha_mode, material.double_sided) {
            (_, false) if material.is_layer() => Self::Blend,
            (_, true) if material.is_layer() => Self::BlendDoubleSided,
            (AlphaMode::Mask { .. }, false) => Self::Mask,
            (AlphaMode::Mask { .. }, true) => Self::MaskDoubleSided,
            (_, false) => Self::Opaque,
            (_, true) => Self::OpaqueDoubleSided,
        }
    }
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
    /// Unit tangents in world space, `w` is the bitangent's sign. Only where a material [needs](Material::tangent_uv_set) them.
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
    /// Positions relative to [`origin`](Self::origin).
    pub positions: Vec<[f32; 3]>,
    /// The other attributes, one entry a vertex in each stream that is not empty.
    pub streams: VertexStreams,
    /// Vertex indices of each triangle; in range.
    pub triangles: Vec<[u32; 3]>,
    /// Runs that partition `triangles`, sorted by [`DrawClass`], then by order in the file.
    pub draws: Vec<Draw>,
}

/// Why a [`Geometry`] can't be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GeometryError {
    /// A triangle refers to a vertex that there is none of.
    #[error("triangle {triangle} has vertex {index}, and there are {vertices}")]
    Index {
        /// The first such triangle.
        triangle: usize,
        /// The index.
        index: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A vertex stream is neither empty nor as long as the positions.
    #[error("the stream of {stream} has {found} entries for {vertices} vertices")]
    Stream {
        /// The stream.
        stream: &'static str,
        /// Its length.
        found: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// Draws do not partition the triangles in their order.
    #[error("draw {draw} has triangles from {first} on, and {expected} comes next of {triangles}")]
    Draw {
        /// The draw; their number if the triangles after the last are in none.
        draw: usize,
        /// Its first triangle.
        first: u32,
        /// The triangle that comes next.
        expected: usize,
        /// How many triangles there are.
        triangles: usize,
    },
    /// A draw follows one of a later class.
    #[error("draw {draw} is of class {class:?} and follows one of a later class")]
    Order {
        /// The draw.
        draw: usize,
        /// Its class.
        class: DrawClass,
    },
    /// A draw has a material that there is none of.
    #[error("draw {draw} has material {material}, and there are {materials}")]
    Material {
        /// The draw.
        draw: usize,
        /// Its material.
        material: u32,
        /// How many materials there are.
        materials: usize,
    },
}

impl Geometry {
    /// Checks all that a renderer counts on, for a scene of so many materials. Positions that are not finite are none of
    /// it: their triangles are not seen.
    ///
    /// # Errors
    /// The first contradiction found.
    pub fn check(&self, materials: usize) -> Result<(), GeometryError> {
        let vertices = self.positions.len();
        let VertexStreams {
            normals,
            tangents,
            uvs,
            colors,
        } = &self.streams;
        for (stream, found) in [
            ("normals", normals.len()),
            ("tangents", tangents.len()),
            ("texture coordinates", uvs.len()),
            ("colours", colors.len()),
        ] {
            // Normals alone may not be left out.
            let may_be_empty = stream != "normals";
            if found != vertices && !(may_be_empty && found == 0) {
                return Err(GeometryError::Stream {
                    stream,
                    found,
                    vertices,
                });
            }
        }
        for (triangle, corners) in self.triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|index| **index as usize >= vertices) {
                return Err(GeometryError::Index {
                    triangle,
                    index,
                    vertices,
                });
            }
        }
        let triangles = self.triangles.len();
        let (mut expected, mut class) = (0, DrawClass::Opaque);
        for (draw, found) in self.draws.iter().enumerate() {
            let end = expected + found.triangle_count as usize;
            if found.first_triangle as usize != expected || end > triangles {
                return Err(GeometryError::Draw {
                    draw,
                    first: found.first_triangle,
                    expected,
                    triangles,
                });
            }
            if found.class < class {
                return Err(GeometryError::Order {
                    draw,
                    class: found.class,
                });
            }
            if found.material as usize >= materials {
                return Err(GeometryError::Material {
                    draw,
                    material: found.material,
                    materials,
                });
            }
            (expected, class) = (end, found.class);
        }
        if expected != triangles {
            return Err(GeometryError::Draw {
                draw: self.draws.len(),
                first: triangles as u32,
                expected,
                triangles,
            });
        }
        Ok(())
    }

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
