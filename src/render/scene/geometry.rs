//! Triangles of a scene at one moment, and the places where they are drawn.

use super::material::{AlphaMode, Material};
use super::stroke::{Edge, Stroke};
use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use std::borrow::Cow;
use std::ops::RangeInclusive;

/// Class of a draw: how its triangles are rasterized. [`PosedGeometry::draws`] are in the order of these variants.
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
    /// Class of the surfaces of a material.
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

/// Consecutive triangles with the same material and class.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawRange {
    /// Index of the first triangle in [`PosedGeometry::triangles`].
    pub first_triangle: u32,
    /// Number of triangles, at least 1.
    pub triangle_count: u32,
    /// Index into [`crate::scene::Scene::materials`].
    pub material: u32,
    /// Class of the triangles.
    pub class: DrawClass,
}

impl DrawRange {
    /// Indices of the triangles in [`PosedGeometry::triangles`].
    fn triangles(&self) -> std::ops::Range<usize> {
        let first = self.first_triangle as usize;
        first..first + self.triangle_count as usize
    }
}

/// Vertex attributes other than the position. A stream that no primitive of the scene needs is empty; otherwise it has
/// an entry for each vertex, with glTF's default for primitives that lack the attribute.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VertexStreams {
    /// Unit normals in world space; never empty if there are vertices (missing normals are generated flat).
    pub normals: Vec<[f32; 3]>,
    /// Unit tangents in world space, with the bitangent's sign in `w`; empty unless a material
    /// [needs](Material::tangent_uv_set) them.
    pub tangents: Vec<[f32; 4]>,
    /// Texture coordinates, untransformed: TEXCOORD_0 in `[0..2]`, TEXCOORD_1 in `[2..4]`.
    pub uvs: Vec<[f32; 4]>,
    /// Vertex colours (COLOR_0), linear, straight alpha; opaque white by default.
    pub colors: Vec<[f32; 4]>,
    /// Length in world space / length in the mesh: the cube root of the ratio of volumes. Empty unless a material
    /// [has](Material::has_volume) a thickness.
    pub scales: Vec<f32>,
}

/// Consecutive triangles of a [`PosedGeometry`], drawn at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshInstance {
    /// Index of the first triangle in [`PosedGeometry::triangles`].
    pub first_triangle: u32,
    /// Number of triangles, at least 1; all have the same [`DrawClass`].
    pub triangle_count: u32,
    /// ID of the first triangle minus 1, a multiple of [`MeshInstance::ALIGNMENT`]; the IDs of the other triangles follow
    /// it. IDs between the last triangle of an instance and the first of the next belong to no triangle.
    pub first_index: u32,
    /// Transform from the space of the vertices to the world relative to [`PosedGeometry::origin`].
    pub transform: DAffine3,
}

/// Factor by which a transform enlarges lengths: the cube root of the ratio of volumes.
pub(super) fn length_scale(transform: &DAffine3) -> f64 {
    transform.matrix3.determinant().abs().cbrt()
}

impl MeshInstance {
    /// Divisor of every [`MeshInstance::first_index`].
    pub const ALIGNMENT: u32 = 64;

    /// Whether the transform mirrors, which reverses the winding of triangles.
    #[must_use]
    pub fn mirrored(&self) -> bool {
        self.transform.matrix3.determinant() < 0.0
    }

    /// Length in the world / length among the vertices: the cube root of the ratio of volumes.
    #[must_use]
    pub fn scale(&self) -> f64 {
        length_scale(&self.transform)
    }

    /// Indices of the triangles in [`PosedGeometry::triangles`].
    pub(crate) fn triangles(&self) -> std::ops::Range<usize> {
        let first = self.first_triangle as usize;
        first..first + self.triangle_count as usize
    }
}

/// Triangles of a scene, ready for upload.
///
/// Front faces wind counter-clockwise seen from outside. Without [`instances`](Self::instances), positions are in
/// world space, and triangle `i` has the ID `i + 1`; 0 is background. With instances, each instance draws some of the
/// triangles at its own place and with its own IDs, so that a mesh that is drawn many times is stored once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PosedGeometry {
    /// World position to which [`positions`](Self::positions) are relative, so that a scene far from the world's
    /// origin keeps its precision.
    pub origin: DVec3,
    /// Positions relative to [`origin`](Self::origin), or in the space of their instances.
    pub positions: Vec<[f32; 3]>,
    /// Other attributes, with an entry for each vertex in each stream that is not empty.
    pub streams: VertexStreams,
    /// Vertex indices of each triangle, in range.
    pub triangles: Vec<[u32; 3]>,
    /// Ranges that partition `triangles`, sorted by [`DrawClass`], then by order in the file.
    pub draws: Vec<DrawRange>,
    /// Places where triangles are drawn, in the order of their IDs and therefore of their classes. If the list is
    /// empty, each triangle is drawn once, at the positions of its vertices.
    pub instances: Vec<MeshInstance>,
    /// Corners of points and lines, in world space, with vertices in range and ascending.
    pub strokes: Vec<Stroke>,
    /// Edges of meshes, in world space and in range.
    pub edges: Vec<Edge>,
}

/// Error: a [`PosedGeometry`] that can't be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GeometryError {
    /// Triangle that refers to a missing vertex.
    #[error("triangle {triangle} has vertex {index}, and there are {vertices}")]
    Index {
        /// Index of the first such triangle.
        triangle: usize,
        /// Index of the missing vertex.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// Vertex stream that is neither empty nor as long as the positions.
    #[error("the stream of {stream} has {found} entries for {vertices} vertices")]
    Stream {
        /// Name of the stream.
        stream: &'static str,
        /// Length of the stream.
        found: usize,
        /// Number of vertices.
        vertices: usize,
    },
    /// Draws that do not partition the triangles in their order.
    #[error("draw {draw} has triangles from {first} on, and {expected} comes next of {triangles}")]
    Draw {
        /// Index of the draw; the number of draws if triangles remain after the last one.
        draw: usize,
        /// First triangle of the draw.
        first: u32,
        /// First triangle that the draw should have.
        expected: usize,
        /// Number of triangles.
        triangles: usize,
    },
    /// Draw that follows one of a later class.
    #[error("draw {draw} is of class {class:?} and follows one of a later class")]
    Order {
        /// Index of the draw.
        draw: usize,
        /// Class of the draw.
        class: DrawClass,
    },
    /// Instance that can't be drawn.
    #[error("instance {index}: {fault}")]
    Instance {
        /// Index of the instance.
        index: usize,
        /// Fault of the instance.
        fault: InstanceFault,
    },
    /// Point or line that refers to a missing vertex.
    #[error("stroke {stroke} has vertex {index}, and there are {vertices}")]
    Stroke {
        /// Index of the first such corner.
        stroke: usize,
        /// Index of the missing vertex.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// Edge of a mesh that refers to a missing vertex.
    #[error("edge {edge} has vertex {index}, and there are {vertices}")]
    Edge {
        /// Index of the first such edge.
        edge: usize,
        /// Index of the missing vertex.
        index: u64,
        /// Number of vertices.
        vertices: usize,
    },
    /// Draw of a missing material.
    #[error("draw {draw} has material {material}, and there are {materials}")]
    Material {
        /// Index of the draw.
        draw: usize,
        /// Index of the material.
        material: u32,
        /// Number of materials.
        materials: usize,
    },
}

/// Reason why an [`MeshInstance`] can't be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum InstanceFault {
    /// Instance without triangles, or with more than there are.
    #[error("it has no triangles, or some that there are none of")]
    Triangles,
    /// First index that is below the end of the previous instance or no multiple of 64, or last index that needs more
    /// than 32 bits.
    #[error("its first index is no multiple of 64 after the instance before it, or its last passes 32 bits")]
    Index,
    /// Transform that is not finite.
    #[error("its transform is not finite")]
    Transform,
    /// Triangles of several classes.
    #[error("its triangles are of several classes")]
    Classes,
    /// Instance that follows one of a later class.
    #[error("it follows one of a later class")]
    Order,
}

impl PosedGeometry {
    /// Checks everything that a renderer relies on, for a scene with `materials` materials. Positions that are not
    /// finite are allowed: their triangles are invisible.
    ///
    /// # Errors
    /// [`GeometryError`] about the first contradiction.
    pub fn check(&self, materials: usize) -> Result<(), GeometryError> {
        let vertices = self.positions.len();
        let VertexStreams { normals, tangents, uvs, scales, colors } = &self.streams;
        for (stream, found) in [
            ("normals", normals.len()),
            ("tangents", tangents.len()),
            ("texture coordinates", uvs.len()),
            ("scales", scales.len()),
            ("colours", colors.len()),
        ] {
            // Only normals are required.
            let may_be_empty = stream != "normals";
            if found != vertices && !(may_be_empty && found == 0) {
                return Err(GeometryError::Stream { stream, found, vertices });
            }
        }
        for (triangle, corners) in self.triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|index| **index as usize >= vertices) {
                return Err(GeometryError::Index { triangle, index, vertices });
            }
        }
        for (stroke, corner) in self.strokes.iter().enumerate() {
            let named = [corner.vertex, corner.at, corner.other, corner.beyond];
            if let Some(&index) = named.iter().find(|index| **index as usize >= vertices) {
                return Err(GeometryError::Stroke { stroke, index, vertices });
            }
        }
        for (edge, found) in self.edges.iter().enumerate() {
            let ([a, b], [c, d]) = (found.ends, found.opposite);
            let last_corner = u64::from(found.first_vertex) + u64::from(Edge::CORNERS - 1);
            let named = [a, b, c, d].map(u64::from).into_iter().chain([last_corner]);
            if let Some(index) = named.into_iter().find(|&index| index >= vertices as u64) {
                return Err(GeometryError::Edge { edge, index, vertices });
            }
        }
        let triangles = self.triangles.len();
        let (mut expected, mut class) = (0, DrawClass::Opaque);
        for (draw, found) in self.draws.iter().enumerate() {
            let end = expected + found.triangle_count as usize;
            if found.first_triangle as usize != expected || end > triangles {
                return Err(GeometryError::Draw { draw, first: found.first_triangle, expected, triangles });
            }
            if found.class < class {
                return Err(GeometryError::Order { draw, class: found.class });
            }
            if found.material as usize >= materials {
                return Err(GeometryError::Material { draw, material: found.material, materials });
            }
            (expected, class) = (end, found.class);
        }
        if expected != triangles {
            return Err(GeometryError::Draw { draw: self.draws.len(), first: triangles as u32, expected, triangles });
        }
        self.check_instances()
    }

    fn check_instances(&self) -> Result<(), GeometryError> {
        let (mut next, mut class) = (0, DrawClass::Opaque);
        for (index, instance) in self.instances.iter().enumerate() {
            let error = |fault| Err(GeometryError::Instance { index, fault });
            let own = instance.triangles();
            if own.is_empty() || own.end > self.triangles.len() {
                return error(InstanceFault::Triangles);
            }
            if instance.first_index < next || !instance.first_index.is_multiple_of(MeshInstance::ALIGNMENT) {
                return error(InstanceFault::Index);
            }
            match instance.first_index.checked_add(instance.triangle_count) {
                Some(end) => next = end,
                None => return error(InstanceFault::Index),
            }
            if !instance.transform.is_finite() {
                return error(InstanceFault::Transform);
            }
            let touched = self.draws_of(instance).map(|draw| draw.class);
            if touched.clone().any(|other| Some(other) != touched.clone().next()) {
                return error(InstanceFault::Classes);
            }
            match touched.clone().next() {
                Some(found) if found < class => return error(InstanceFault::Order),
                found => class = found.unwrap_or(class),
            }
        }
        Ok(())
    }

    /// Draws that contain triangles of an instance.
    fn draws_of(&self, instance: &MeshInstance) -> impl Iterator<Item = &DrawRange> + Clone {
        let own = instance.triangles();
        let first = self.draws.partition_point(|draw| draw.triangles().end <= own.start);
        let after = self.draws.get(first..).unwrap_or(&[]).iter();
        after.take_while(move |draw| draw.triangles().start < own.end)
    }

    /// Whether some vertices have to be placed for each camera.
    #[must_use]
    pub fn has_strokes(&self) -> bool {
        !self.strokes.is_empty() || !self.edges.is_empty()
    }

    /// Number of triangles that are drawn, counting instances.
    #[must_use]
    pub fn triangle_count(&self) -> u64 {
        if self.instances.is_empty() {
            return self.triangles.len() as u64;
        }
        let counts = self.instances.iter().map(|i| u64::from(i.triangle_count));
        counts.sum()
    }

    /// Number of triangle slots. The index of every triangle, which is its ID minus 1, is smaller; some slots may be empty.
    #[must_use]
    pub fn triangle_slots(&self) -> u64 {
        self.instances
            .last()
            .map_or(self.triangles.len() as u64, |last| u64::from(last.first_index) + u64::from(last.triangle_count))
    }

    /// Lowest and highest corner of the axis-aligned box around all vertices of drawn triangles, in world space;
    /// `None` without triangles.
    #[must_use]
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let whole = [DAffine3::IDENTITY].map(|place| self.box_of(0..self.triangles.len(), place));
        let boxes: Vec<_> = match self.instances.as_slice() {
            [] => whole.to_vec(),
            all => all.par_iter().map(|instance| self.box_of(instance.triangles(), instance.transform)).collect(),
        };
        let (low, high) = boxes.into_iter().flatten().reduce(|(low, high), (l, h)| (low.min(l), high.max(h)))?;
        Some((low + self.origin, high + self.origin))
    }

    /// Box around a range of triangles at a place.
    fn box_of(&self, triangles: std::ops::Range<usize>, place: DAffine3) -> Option<(DVec3, DVec3)> {
        let corners = self.triangles.get(triangles)?.iter().flatten();
        let positions = corners.map(|&v| place.transform_point3(self.position(v)));
        let boxes = positions.map(|p| (p, p));
        boxes.reduce(|(low, high), (p, _)| (low.min(p), high.max(p)))
    }

    /// Lowest and highest corner of the box around an instance's vertices, before its transform.
    pub(crate) fn own_box(&self, instance: &MeshInstance) -> Option<[DVec3; 2]> {
        let (low, high) = self.box_of(instance.triangles(), DAffine3::IDENTITY)?;
        Some([low, high])
    }

    fn position(&self, v: u32) -> DVec3 {
        DVec3::from_array(self.positions[v as usize].map(f64::from))
    }

    /// Geometry with the same triangles and IDs in world space, without instances. Vertices keep their indices; for
    /// each instance with a transform, transformed copies of its vertices are appended. IDs that belong to no triangle
    /// get triangles without area. Points and lines have no area either, until a camera gives them a size.
    #[must_use]
    pub fn flat(&self) -> Cow<'_, Self> {
        if self.instances.is_empty() {
            return Cow::Borrowed(self);
        }
        let mut flat = Self {
            origin: self.origin,
            positions: self.positions.clone(),
            streams: self.streams.clone(),
            ..Self::default()
        };
        for instance in &self.instances {
            self.flatten(instance, &mut flat);
        }
        Cow::Owned(flat)
    }

    /// Adds the triangles of an instance to a geometry without instances.
    fn flatten(&self, instance: &MeshInstance, flat: &mut Self) {
        let triangles = self.triangles.get(instance.triangles()).unwrap_or(&[]);
        let vertices = triangles.iter().flatten();
        let (Some(&low), Some(&high)) = (vertices.clone().min(), vertices.max()) else {
            return;
        };
        let stays = instance.transform == DAffine3::IDENTITY;
        let first = if stays { low } else { self.place(low as usize..=high as usize, instance, flat) };

        // Indices that belong to no triangle become part of the draw before them.
        let gap = instance.first_index as usize - flat.triangles.len();
        flat.triangles.extend(std::iter::repeat_n([first; 3], gap));
        if let Some(draw) = flat.draws.last_mut() {
            draw.triangle_count += gap as u32;
        }
        let mirrored = instance.mirrored();
        flat.triangles.extend(triangles.iter().map(|&[a, b, c]| {
            let corners = if mirrored { [a, c, b] } else { [a, b, c] };
            corners.map(|v| v - low + first)
        }));
        let own = instance.triangles();
        for draw in self.draws_of(instance) {
            let start = draw.triangles().start.max(own.start);
            let end = draw.triangles().end.min(own.end);
            flat.draws.push(DrawRange {
                first_triangle: instance.first_index + (start - own.start) as u32,
                triangle_count: (end - start) as u32,
                ..*draw
            });
        }
    }

    /// Adds a range of an instance's vertices in world space; returns the index of the first one there.
    fn place(&self, used: RangeInclusive<usize>, instance: &MeshInstance, flat: &mut Self) -> u32 {
        let first = flat.positions.len() as u32;
        let place = instance.transform;
        // The inverse transpose, up to a positive factor, exists even if the inverse does not.
        let m = place.matrix3;
        let sign = if instance.mirrored() { -1.0 } else { 1.0 };
        let turn = |[x, y, z]: [f32; 3]| {
            let n = DVec3::from_array([x, y, z].map(f64::from));
            let cofactors =
                m.y_axis.cross(m.z_axis) * n.x + m.z_axis.cross(m.x_axis) * n.y + m.x_axis.cross(m.y_axis) * n.z;
            (cofactors * sign).normalize_or(DVec3::Z).as_vec3().to_array()
        };
        let vertices = used.clone().map(|v| v as u32);
        let placed = vertices.map(|v| place.transform_point3(self.position(v)));
        flat.positions.extend(placed.map(|p| p.as_vec3().to_array()));
        let streams = &mut flat.streams;
        if let Some(normals) = self.streams.normals.get(used.clone()) {
            streams.normals.extend(normals.iter().map(|&n| turn(n)));
        }
        if let Some(tangents) = self.streams.tangents.get(used.clone()) {
            streams.tangents.extend(tangents.iter().map(|&[x, y, z, w]| {
                let along = m * DVec3::from_array([x, y, z].map(f64::from));
                let [x, y, z] = along.normalize_or(DVec3::X).as_vec3().to_array();
                [x, y, z, w * sign as f32]
            }));
        }
        if let Some(scales) = self.streams.scales.get(used.clone()) {
            let scale = instance.scale() as f32;
            streams.scales.extend(scales.iter().map(|s| s * scale));
        }
        if let Some(uvs) = self.streams.uvs.get(used.clone()) {
            streams.uvs.extend(uvs);
        }
        if let Some(colors) = self.streams.colors.get(used) {
            streams.colors.extend(colors);
        }
        first
    }
}
