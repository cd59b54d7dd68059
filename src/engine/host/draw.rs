//! Draws of a host.

use super::indirect::IndirectPart;
use super::{Geometry, HostError, IndirectDraws, Member, Mesh, Place, PositionSpace, Topology};
use crate::engine::data::{HostDraw, TriangleWord};
use ash::vk;

/// A run of triangles that are shaded alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw {
    /// Index into [`Geometry::meshes`] of the mesh whose buffers the draw reads.
    pub mesh: u32,
    /// First index of the draw. For a mesh without indices: its first vertex, counted from `vertex_offset`.
    pub first_index: u32,
    /// Number of triangles.
    pub triangle_count: u32,
    /// Topology: how indices, or vertices without indices, form triangles.
    pub topology: Topology,
    /// Offset that is added to each index.
    pub vertex_offset: i32,
    /// Number of vertices from `vertex_offset` on, if positions are in object space; otherwise ignored. An index beyond
    /// the last of these vertices is clamped to the last one.
    pub vertex_count: u32,
    /// Matrix from object space to clip space, by columns, if positions are in object space; otherwise ignored.
    pub to_clip: [[f32; 4]; 4],
    /// Index into [`Geometry::alpha_maps`] of the map of the alpha test; `None` for a surface without holes. Draws with alpha
    /// maps come after those without.
    pub alpha_map: Option<u16>,
    /// Shading key: the number of the host's pipeline that shades the draw, from 0.
    pub key: u32,
    /// Material number of the host's choice, which its shaders can read. Triangles with the same number are assumed to
    /// look alike where the surrounding colours decide in how many parts [`Self::detailed`] ones are shaded.
    pub material: u16,
    /// Whether back faces are visible.
    pub double_sided: bool,
    /// Orientation of front faces in the image: `frontFace` of the host's pipeline.
    pub front_face: vk::FrontFace,
    /// Whether the colour may vary within a pixel, for example because of a texture or a glossy surface. If so, the
    /// draw is shaded in several parts of a superpixel wherever the surrounding pixels vary in colour.
    pub detailed: bool,
    /// Whether the draw is translucent. The host's shaders then store an opacity, with which the draw is composited
    /// over the surfaces behind it. Blended draws have no alpha map and come after all others. They require
    /// [`Geometry::blended`].
    pub blended: bool,
}

impl Default for Draw {
    /// Empty draw whose matrix is the identity.
    fn default() -> Self {
        Self {
            mesh: 0,
            first_index: 0,
            triangle_count: 0,
            topology: Topology::List,
            vertex_offset: 0,
            vertex_count: 0,
            to_clip: std::array::from_fn(|column| std::array::from_fn(|row| if row == column { 1.0 } else { 0.0 })),
            alpha_map: None,
            key: 0,
            material: 0,
            double_sided: false,
            front_face: vk::FrontFace::COUNTER_CLOCKWISE,
            detailed: false,
            blended: false,
        }
    }
}

/// Draws whose triangles and positions are made by the same dispatches: consecutive draws of the same mesh, topology and front
/// face, or a list of indirect draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct DrawRun {
    /// Index of the mesh.
    pub mesh: usize,
    pub topology: Topology,
    pub front_face: vk::FrontFace,
    /// First draw and number of draws among which those of the triangles are searched.
    pub draws: [u32; 2],
    /// First triangle of the run, counted over all draws, and number of triangles.
    pub triangles: [u32; 2],
    /// First position of the run in clip space and number of positions, if positions are in object space.
    pub positions: [u32; 2],
}

/// Consecutive triangles of a draw, or of a list of indirect draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TrianglePart {
    pub first_triangle: u32,
    pub triangle_count: u32,
    pub double_sided: bool,
}

/// Order of triangles: opaque, with alpha maps, blended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Class {
    Opaque,
    AlphaTested,
    Blended,
}

/// Draws of a frame, with their places in the device's buffers.
#[derive(Default)]
pub(super) struct PlacedDraws {
    pub draws: Vec<HostDraw>,
    /// Matrix of each draw if positions are in object space; otherwise empty.
    pub matrices: Vec<[[f32; 4]; 4]>,
    /// Runs of the draws that have triangles, and of the lists of indirect draws.
    pub runs: Vec<DrawRun>,
    /// Parts of the lists of indirect draws.
    pub indirect: Vec<IndirectPart>,
    /// Triangles of each draw and of each list of indirect draws, in their order.
    pub parts: Vec<TrianglePart>,
    /// Number of triangles of the draws.
    pub drawn_triangles: u32,
    /// Number of places for triangles: those of the draws, and as many as lists of indirect draws may have.
    pub triangles: u32,
    /// Number of triangles of opaque draws without alpha maps; these triangles come first.
    pub opaque: u32,
    /// Number of triangles of draws that are not blended.
    pub solid: u32,
}

impl PlacedDraws {
    /// Places the draws of a frame.
    ///
    /// # Errors
    /// If a draw is invalid, or the draws exceed a capacity; the error names the first such draw.
    pub fn new(geometry: &Geometry, draws: &[Draw]) -> Result<Self, HostError> {
        let capacity = |counted, found, member, capacity| HostError::Capacity { counted, found, member, capacity };
        if draws.len() > geometry.draw_capacity as usize {
            let found = draws.len() as u64;
            return Err(capacity("draws", found, Member::DrawCapacity, geometry.draw_capacity));
        }
        let in_clip = geometry.position_space == PositionSpace::Clip;
        let mut placed = Self { draws: Vec::with_capacity(draws.len()), ..Self::default() };
        let mut lists = Lists::new(geometry);
        // First positions of the meshes, if positions are in clip space.
        let firsts: Vec<u32> = geometry.first_positions().collect();
        let mut made = 0;
        for (number, draw) in draws.iter().enumerate() {
            let in_draw = |error: HostError| error.at(Place::Draw(number));
            let mesh = draw.check(geometry).map_err(in_draw)?;
            let vertices = if in_clip || draw.triangle_count == 0 { 0 } else { draw.vertex_count };
            let drawn = u64::from(placed.drawn_triangles) + u64::from(draw.triangle_count);
            let positions = u64::from(made) + u64::from(vertices);
            if drawn > u64::from(geometry.triangle_capacity) {
                return Err(capacity("triangles", drawn, Member::TriangleCapacity, geometry.triangle_capacity));
            }
            if !in_clip && positions > u64::from(geometry.position_capacity()) {
                let most = geometry.position_capacity();
                return Err(capacity("vertices", positions, Member::PositionCapacity, most));
            }
            if draw.triangle_count > 0 {
                lists.place(&mut placed, |class| class < draw.class());
            }
            let triangles = placed.triangles + draw.triangle_count;
            let offset = draw.vertex_offset.cast_unsigned();
            let common = HostDraw {
                first_triangle: placed.triangles,
                first_index: draw.first_index,
                word: draw.word(),
                material: u32::from(draw.material),
                ..HostDraw::default()
            };
            placed.draws.push(if in_clip {
                let first = firsts[draw.mesh as usize];
                HostDraw {
                    vertex_offset: offset,
                    first_position: first,
                    last_position: mesh.vertex_capacity - 1,
                    shift: 0_u32.wrapping_sub(first),
                    ..common
                }
            } else {
                placed.matrices.push(draw.to_clip);
                HostDraw {
                    first_position: made,
                    last_position: vertices.saturating_sub(1),
                    shift: offset.wrapping_sub(made),
                    ..common
                }
            });
            placed.extend_runs(draw, draws.len() as u32, [made, vertices]);
            let comes_late = |before: u32| before < placed.triangles;
            if !draw.blended {
                if comes_late(placed.solid) {
                    return Err(in_draw(HostError::BlendedOrder));
                }
                placed.solid = triangles;
            }
            if !draw.blended && draw.alpha_map.is_none() {
                if comes_late(placed.opaque) {
                    return Err(in_draw(HostError::Order));
                }
                placed.opaque = triangles;
            }
            placed.parts.push(TrianglePart {
                first_triangle: placed.triangles,
                triangle_count: draw.triangle_count,
                double_sided: draw.double_sided,
            });
            placed.drawn_triangles = drawn as u32;
            placed.triangles = triangles;
            made = positions as u32;
        }
        lists.place(&mut placed, |_| true);
        Ok(placed)
    }

    /// Adds one of `count` draws to the last run, or begins a run if the draw's mesh, topology or front face differs.
    fn extend_runs(&mut self, draw: &Draw, count: u32, positions: [u32; 2]) {
        if draw.triangle_count == 0 {
            return;
        }
        let next = DrawRun {
            mesh: draw.mesh as usize,
            topology: draw.topology,
            front_face: draw.front_face,
            draws: [0, count],
            triangles: [self.triangles, draw.triangle_count],
            positions,
        };
        match self.runs.last_mut() {
            Some(run) if (DrawRun { triangles: next.triangles, positions, ..*run }) == next => {
                run.triangles[1] += draw.triangle_count;
                run.positions[1] += positions[1];
            }
            _ => self.runs.push(next),
        }
    }
}

/// Lists of indirect draws that are placed among the draws.
struct Lists<'a> {
    /// Lists that are not placed yet, in the order of their classes, with their parts as far as these are known.
    left: std::iter::Peekable<std::vec::IntoIter<(&'a IndirectDraws, IndirectPart)>>,
    space: PositionSpace,
}

impl<'a> Lists<'a> {
    fn new(geometry: &'a Geometry) -> Self {
        let mut first_draw = geometry.draw_capacity;
        let mut first_made = u64::from(geometry.position_capacity());
        let firsts: Vec<u32> = geometry.first_positions().collect();
        let mut lists = Vec::new();
        for (number, list) in geometry.indirect.iter().enumerate() {
            let first_position = match geometry.position_space {
                PositionSpace::Clip => firsts.get(list.mesh as usize).copied().unwrap_or_default(),
                PositionSpace::Object { .. } => first_made as u32,
            };
            lists.push((list, IndirectPart { list: number, first_triangle: 0, first_draw, first_position }));
            first_draw += list.draws() as u32;
            first_made += list.positions(geometry.position_space);
        }
        lists.sort_by_key(|(list, _)| list.class());
        Self { left: lists.into_iter().peekable(), space: geometry.position_space }
    }

    /// Places the next lists, as far as their classes are `due`.
    fn place(&mut self, placed: &mut PlacedDraws, due: impl Fn(Class) -> bool) {
        while let Some((list, part)) = self.left.next_if(|(list, _)| due(list.class())) {
            let first_triangle = placed.triangles;
            placed.indirect.push(IndirectPart { first_triangle, ..part });
            placed.runs.push(DrawRun {
                mesh: list.mesh as usize,
                topology: list.topology,
                front_face: list.front_face,
                draws: [part.first_draw, list.draws() as u32],
                triangles: [first_triangle, list.triangle_capacity],
                positions: [part.first_position, list.positions(self.space) as u32],
            });
            placed.parts.push(TrianglePart {
                first_triangle,
                triangle_count: list.triangle_capacity,
                double_sided: list.double_sided,
            });
            placed.triangles += list.triangle_capacity;
            if list.class() < Class::Blended {
                placed.solid = placed.triangles;
            }
            if list.class() == Class::Opaque {
                placed.opaque = placed.triangles;
            }
        }
    }
}

impl IndirectDraws {
    fn class(&self) -> Class {
        match (self.blended, self.alpha_tested) {
            (true, _) => Class::Blended,
            (false, true) => Class::AlphaTested,
            (false, false) => Class::Opaque,
        }
    }
}

/// Checks that an orientation of front faces is one of Vulkan 1.3.
pub(super) fn check_front_face(member: Member, found: vk::FrontFace) -> Result<(), HostError> {
    let possible = "VK_FRONT_FACE_COUNTER_CLOCKWISE (0) or VK_FRONT_FACE_CLOCKWISE (1)";
    match found {
        vk::FrontFace::COUNTER_CLOCKWISE | vk::FrontFace::CLOCKWISE => Ok(()),
        _ => Err(HostError::Choice { member, found: found.as_raw(), possible }),
    }
}

impl Draw {
    /// Checks the draw against the geometry, and returns its mesh.
    fn check<'a>(&self, geometry: &'a Geometry) -> Result<&'a Mesh, HostError> {
        let mesh = geometry.mesh(Member::DrawMesh, self.mesh)?;
        let end = u64::from(self.first_index) + self.topology.corners(self.triangle_count);
        if let Some(indices) = mesh.indices.filter(|lent| end > u64::from(lent.capacity)) {
            return Err(HostError::Indices { end, indices: indices.capacity });
        }
        if self.key >= geometry.keys {
            let (member, by) = (Member::DrawKey, Member::Keys);
            return Err(HostError::Index { member, found: self.key, count: geometry.keys, by });
        }
        check_front_face(Member::DrawFrontFace, self.front_face)?;
        if self.blended && !geometry.blended {
            return Err(HostError::NotBlended);
        }
        if self.blended && self.alpha_map.is_some() {
            return Err(HostError::BlendedMap);
        }
        let maps = geometry.alpha_maps.len();
        if let Some(map) = self.alpha_map.filter(|map| usize::from(*map) >= maps) {
            return Err(HostError::AlphaMap { map, maps });
        }
        if self.alpha_map.is_some() && mesh.coordinates.is_none() {
            return Err(HostError::DrawCoordinates { mesh: self.mesh });
        }
        if self.triangle_count == 0 {
            return Ok(mesh);
        }
        let first = i64::from(self.vertex_offset);
        let in_clip = geometry.position_space == PositionSpace::Clip;
        if mesh.indices.is_none() {
            let has = if in_clip {
                [0, i64::from(mesh.vertex_capacity)]
            } else {
                [first, first + i64::from(self.vertex_count)]
            };
            let takes = [i64::from(self.first_index), end.cast_signed()].map(|at| first + at);
            if takes[0] < has[0] || takes[1] > has[1] {
                return Err(HostError::Corners { read: takes, held: has });
            }
        }
        if in_clip {
            return Ok(mesh);
        }
        let end = first + i64::from(self.vertex_count);
        let exist = first >= 0 && end <= i64::from(mesh.vertex_capacity);
        if !exist || self.vertex_count == 0 {
            return Err(HostError::Vertices { held: [first, end], vertices: mesh.vertex_capacity });
        }
        if !self.to_clip.as_flattened().iter().all(|n| n.is_finite()) {
            return Err(HostError::NotFinite(Member::ToClip));
        }
        Ok(mesh)
    }

    fn class(&self) -> Class {
        match (self.blended, self.alpha_map) {
            (true, _) => Class::Blended,
            (false, Some(_)) => Class::AlphaTested,
            (false, None) => Class::Opaque,
        }
    }

    fn word(&self) -> u32 {
        let word = TriangleWord {
            // The alpha test finds the map's row by this number.
            material: u32::from(self.alpha_map.unwrap_or(self.material)),
            bin: self.key,
            high_frequency: self.detailed,
            double_sided: self.double_sided,
        };
        word.bits()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{AlphaMap, ClipSpace, Coordinates, Indices, VertexFormat};
    use super::*;
    use ash::vk::Handle;

    fn mesh() -> Mesh {
        Mesh {
            positions: vk::Buffer::from_raw(1),
            positions_offset: 0,
            position_stride: 16,
            position_format: VertexFormat::FLOAT,
            vertex_capacity: 100,
            coordinates: None,
            indices: Some(Indices {
                buffer: vk::Buffer::from_raw(2),
                offset: 0,
                index_type: vk::IndexType::UINT32,
                capacity: 60,
            }),
        }
    }

    fn geometry() -> Geometry {
        Geometry {
            meshes: vec![mesh()],
            position_space: PositionSpace::Clip,
            indirect: Vec::new(),
            triangle_capacity: 12,
            draw_capacity: 3,
            keys: 2,
            clip: ClipSpace::default(),
            alpha_maps: Vec::new(),
            blended: false,
        }
    }

    fn in_object_space() -> Geometry {
        Geometry { position_space: PositionSpace::Object { capacity: 40 }, ..geometry() }
    }

    fn draw(first_index: u32, triangle_count: u32, key: u32) -> Draw {
        Draw { first_index, triangle_count, key, ..Draw::default() }
    }

    fn with_vertices(vertex_offset: i32, vertex_count: u32) -> Draw {
        Draw { vertex_offset, vertex_count, ..draw(0, 1, 0) }
    }

    #[test]
    fn draws_follow_each_other() {
        let draws = [draw(30, 4, 1), draw(0, 0, 0), draw(0, 7, 0)];
        let placed = PlacedDraws::new(&geometry(), &draws).unwrap();
        assert_eq!(placed.triangles, 11);
        let firsts: Vec<_> = placed.draws.iter().map(|d| (d.first_triangle, d.first_index)).collect();
        assert_eq!(firsts, [(0, 30), (4, 0), (4, 0)]);
        assert_eq!(placed.draws[0].word, 1 << 16);
        let counts: Vec<_> = placed.parts.iter().map(|part| part.triangle_count).collect();
        assert_eq!(counts, [4, 0, 7]);
        assert!(placed.matrices.is_empty());
    }

    #[test]
    fn flags_and_numbers_have_bits_of_their_own() {
        let all = Draw { material: u16::MAX, double_sided: true, detailed: true, vertex_offset: -1, ..draw(0, 1, 1) };
        let placed = PlacedDraws::new(&geometry(), &[all]).unwrap();
        assert_eq!(placed.draws[0].word, 0xffff | 1 << 16 | 1 << 30 | 1 << 31);
        assert_eq!(placed.draws[0].vertex_offset, u32::MAX);
    }

    #[test]
    fn draws_in_object_space_have_positions_of_their_own() {
        let draws = [with_vertices(60, 20), draw(0, 0, 0), with_vertices(3, 5), with_vertices(60, 15)];
        let geometry = Geometry { draw_capacity: 4, ..in_object_space() };
        let placed = PlacedDraws::new(&geometry, &draws).unwrap();
        let run = DrawRun {
            mesh: 0,
            topology: Topology::List,
            front_face: vk::FrontFace::COUNTER_CLOCKWISE,
            draws: [0, 4],
            triangles: [0, 3],
            positions: [0, 40],
        };
        assert_eq!(placed.runs, [run]);
        assert_eq!(placed.matrices.len(), 4);
        let places: Vec<_> = placed
            .draws
            .iter()
            .map(|d| {
                let vertex = d.first_position.wrapping_add(d.shift);
                (d.first_position, d.last_position, vertex)
            })
            .collect();
        assert_eq!(places, [(0, 19, 60), (20, 0, 0), (20, 4, 3), (25, 14, 60)]);
    }

    #[test]
    fn draws_that_do_not_fit_are_named() {
        let refused = |draws: &[Draw]| {
            let placed = PlacedDraws::new(&geometry(), draws);
            placed.err().unwrap().to_string()
        };
        assert_eq!(refused(&[draw(0, 1, 0), draw(30, 11, 0)]), "draw 1: it reads indices up to 63, and there are 60");
        assert_eq!(refused(&[draw(u32::MAX, 1, 0)]), "draw 0: it reads indices up to 4294967298, and there are 60");
        assert_eq!(refused(&[draw(0, 1, 2)]), "draw 0: Draw::key is 2; it can be 0 to 1, by Geometry::keys");
        assert_eq!(refused(&[draw(0, 10, 0), draw(0, 3, 0)]), "13 triangles; Geometry::triangle_capacity is 12");
        assert_eq!(refused(&[draw(0, 1, 0); 4]), "4 draws; Geometry::draw_capacity is 3");
    }

    #[test]
    fn draws_with_alpha_maps_come_last() {
        let map = AlphaMap {
            view: vk::ImageView::from_raw(3),
            size: [1, 1],
            levels: 1,
            mag_filter: vk::Filter::LINEAR,
            min_filter: vk::Filter::LINEAR,
            mipmap_mode: vk::SamplerMipmapMode::LINEAR,
            address: [vk::SamplerAddressMode::REPEAT; 2],
            cutoff: 0.5,
        };
        let with_coordinates = Mesh {
            coordinates: Some(Coordinates {
                buffer: vk::Buffer::from_raw(4),
                offset: 0,
                stride: 8,
                format: VertexFormat::FLOAT,
            }),
            ..mesh()
        };
        let geometry = Geometry { meshes: vec![with_coordinates, mesh()], alpha_maps: vec![map; 2], ..geometry() };
        let masked = |alpha_map| Draw { alpha_map: Some(alpha_map), material: 7, ..draw(0, 2, 0) };
        let placed = PlacedDraws::new(&geometry, &[draw(0, 3, 0), masked(1)]).unwrap();
        assert_eq!((placed.opaque, placed.triangles), (3, 5));
        assert_eq!(placed.draws[1].word & 0xffff, 1);
        assert_eq!(placed.draws[1].material, 7);
        let refused = |draws: &[Draw]| {
            let placed = PlacedDraws::new(&geometry, draws);
            placed.err().unwrap().to_string()
        };
        assert_eq!(
            refused(&[masked(0), draw(0, 1, 0)]),
            "draw 1: it has no alpha map and comes after one that has: draws without come first"
        );
        assert_eq!(refused(&[masked(2)]), "draw 0: Draw::alpha_map is 2, and there are 2, from 0");
        assert_eq!(
            refused(&[Draw { mesh: 1, ..masked(0) }]),
            "draw 0: it has an alpha map, and its mesh 1 has no texture coordinates: lend Mesh::coordinates"
        );
    }

    #[test]
    fn blended_draws_come_last_of_all() {
        let geometry = Geometry { blended: true, ..geometry() };
        let blended = Draw { blended: true, ..draw(0, 2, 0) };
        let placed = PlacedDraws::new(&geometry, &[draw(0, 3, 0), blended]).unwrap();
        assert_eq!((placed.opaque, placed.solid, placed.triangles), (3, 3, 5));
        let refused = |geometry: &Geometry, draws: &[Draw]| {
            let placed = PlacedDraws::new(geometry, draws);
            placed.err().unwrap().to_string()
        };
        assert_eq!(
            refused(&geometry, &[blended, draw(0, 1, 0)]),
            "draw 1: it is not blended and comes after one that is: these are the last ones"
        );
        assert_eq!(
            refused(&self::geometry(), &[blended]),
            "draw 0: it is blended; make the frame with Geometry::blended"
        );
        let tested = Draw { alpha_map: Some(0), ..blended };
        assert_eq!(
            refused(&geometry, &[tested]),
            "draw 0: it is blended and has an alpha map: let its shader store an opacity of 0 instead"
        );
    }

    #[test]
    fn draws_in_object_space_that_do_not_fit_are_named() {
        let refused = |draws: &[Draw]| {
            let placed = PlacedDraws::new(&in_object_space(), draws);
            placed.err().unwrap().to_string()
        };
        let unknown = Draw { front_face: vk::FrontFace::from_raw(2), ..with_vertices(0, 1) };
        let broken = Draw { to_clip: [[f32::NAN; 4]; 4], ..with_vertices(0, 1) };
        for (draws, message) in [
            (
                vec![with_vertices(0, 1), with_vertices(95, 6)],
                "draw 1: it has the vertices from 95 to before 101; it needs at least one, of those from 0 to before 100",
            ),
            (
                vec![with_vertices(-1, 6)],
                "draw 0: it has the vertices from -1 to before 5; it needs at least one, of those from 0 to before 100",
            ),
            (
                vec![with_vertices(7, 0)],
                "draw 0: it has the vertices from 7 to before 7; it needs at least one, of those from 0 to before 100",
            ),
            (
                vec![with_vertices(0, 30), with_vertices(0, 11)],
                "41 vertices; the capacity of PositionSpace::Object is 40",
            ),
            (
                vec![with_vertices(0, 1), unknown],
                "draw 1: Draw::front_face is 2; it can be VK_FRONT_FACE_COUNTER_CLOCKWISE (0) or VK_FRONT_FACE_CLOCKWISE (1)",
            ),
            (vec![broken], "draw 0: Draw::to_clip has a number that is not finite"),
        ] {
            assert_eq!(refused(&draws), message);
        }
    }

    #[test]
    fn draws_of_several_meshes_are_read_in_runs() {
        let bare = Mesh { vertex_capacity: 50, indices: None, ..mesh() };
        let geometry = Geometry { meshes: vec![mesh(), bare], draw_capacity: 9, ..geometry() };
        let of = |mesh, topology, first_index, triangle_count| Draw {
            mesh,
            topology,
            ..draw(first_index, triangle_count, 0)
        };
        let clockwise = |draw| Draw { front_face: vk::FrontFace::CLOCKWISE, ..draw };
        let draws = [
            of(0, Topology::List, 0, 2),
            of(0, Topology::List, 9, 1),
            clockwise(of(0, Topology::List, 9, 1)),
            of(0, Topology::Fan, 55, 3),
            of(1, Topology::Strip, 48, 0),
            of(1, Topology::Strip, 44, 4),
        ];
        let placed = PlacedDraws::new(&geometry, &draws).unwrap();
        let run = |mesh, topology, triangles| DrawRun {
            mesh,
            topology,
            front_face: vk::FrontFace::COUNTER_CLOCKWISE,
            draws: [0, 6],
            triangles,
            positions: [0, 0],
        };
        let expected = [
            run(0, Topology::List, [0, 3]),
            DrawRun { front_face: vk::FrontFace::CLOCKWISE, ..run(0, Topology::List, [3, 1]) },
            run(0, Topology::Fan, [4, 3]),
            run(1, Topology::Strip, [7, 4]),
        ];
        assert_eq!(placed.runs, expected);
        let last = placed.draws[5];
        let vertex = last.first_position.wrapping_add(last.shift);
        assert_eq!((last.first_position, last.last_position, vertex), (100, 49, 0));
        let refused = |draw| PlacedDraws::new(&geometry, &[draw]).err().unwrap().to_string();
        assert_eq!(refused(of(0, Topology::Fan, 56, 3)), "draw 0: it reads indices up to 61, and there are 60");
        assert_eq!(
            refused(of(1, Topology::Strip, 45, 4)),
            "draw 0: it takes the vertices from 45 to before 51 without indices, by its topology and triangle_count, and has those from 0 to before 50"
        );
        assert_eq!(
            refused(of(2, Topology::List, 0, 1)),
            "draw 0: Draw::mesh is 2; it can be 0 to 1, by Geometry::meshes"
        );
    }

    #[test]
    fn draws_without_indices_have_their_vertices() {
        let bare = Mesh { indices: None, ..mesh() };
        let geometry = Geometry { meshes: vec![bare], ..in_object_space() };
        let of = |first_index, vertex_offset, vertex_count| Draw {
            first_index,
            ..with_vertices(vertex_offset, vertex_count)
        };
        assert!(PlacedDraws::new(&geometry, &[of(5, 90, 8)]).is_ok());
        let refused = |draw| PlacedDraws::new(&geometry, &[draw]).err().unwrap().to_string();
        assert_eq!(
            refused(of(6, 90, 8)),
            "draw 0: it takes the vertices from 96 to before 99 without indices, by its topology and triangle_count, and has those from 90 to before 98"
        );
    }
}
