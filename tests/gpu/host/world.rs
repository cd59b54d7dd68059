//! The world that the tests' host shows, and the images that its own renderer draws of it.

use ash::vk;
use gpc::host::{Draw, IndirectDraws, Instance, Topology, VertexFormat, Viewport};
use twins::topology;
use twins::transform::clip_position;
use twins::visibility::{Surface, nearest};

pub const SIZE: [u32; 2] = [64, 64];
/// Linear colour of the background.
pub const SKY: [f32; 3] = [0.1, 0.3, 0.7];

/// Matrix, by columns.
pub type Matrix = [[f32; 4]; 4];

/// Mesh: vertices in object space, the brightness of each, texture coordinates if it has an alpha map, and triangles.
#[derive(Default)]
pub struct Mesh {
    pub positions: Vec<[f32; 3]>,
    pub paints: Vec<f32>,
    pub coordinates: Vec<[f32; 2]>,
    pub indices: Vec<u32>,
    /// Indices of the same triangles in the topology of [`World::of`].
    pub sequence: Vec<u32>,
}

/// A mesh at a place in the world.
pub struct Part {
    pub mesh: usize,
    pub to_clip: Matrix,
    pub color: [f32; 3],
    /// Opacity; below 1 for a blended part.
    pub opacity: f32,
    pub alpha_map: Option<u16>,
}

/// Texture with an alpha that is tested, and all its levels.
pub struct Map {
    pub side: u32,
    pub levels: Vec<Vec<u8>>,
    pub mag_filter: vk::Filter,
    pub min_filter: vk::Filter,
    pub mipmap_mode: vk::SamplerMipmapMode,
    pub address: [vk::SamplerAddressMode; 2],
    pub cutoff: f32,
}

pub struct World {
    pub meshes: Vec<Mesh>,
    pub parts: Vec<Part>,
    pub maps: Vec<Map>,
    pub projection: Matrix,
}

/// Way in which vertices, indices and images are lent.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// Whether positions are in object space; otherwise the host has transformed them to clip space.
    pub object_space: bool,
    pub positions_offset: u64,
    pub stride: u32,
    /// Format of positions in object space.
    pub format: VertexFormat,
    pub short_indices: bool,
    pub indices_offset: u64,
    /// Pixel of the images at which the picture begins; the margin at its end has the same size.
    pub corner: [u32; 2],
    /// Whether each mesh has buffers of its own.
    pub apart: bool,
    /// Whether there are no indices.
    pub bare: bool,
    pub topology: Topology,
    pub viewport: Option<Viewport>,
    /// Whether y points up in clip space.
    pub y_up: bool,
    pub front_face: vk::FrontFace,
    pub double_sided: bool,
    /// Factor on the brightness of back faces.
    pub back: f32,
    /// Values in the image of depth for a depth of 0 and for a depth of 1.
    pub depth_range: [f32; 2],
    /// Whether depth is 1 at the near plane and 0 far away.
    pub reversed_depth: bool,
    /// Whether the image of colours can be copied and not be sampled.
    pub copied: bool,
}

/// The way of a host that transforms all vertices itself.
pub const PLACED: Way = Way {
    object_space: false,
    positions_offset: 0,
    stride: 16,
    format: VertexFormat::FLOAT,
    short_indices: false,
    indices_offset: 0,
    corner: [0, 0],
    apart: false,
    bare: false,
    topology: Topology::List,
    viewport: None,
    y_up: false,
    front_face: vk::FrontFace::COUNTER_CLOCKWISE,
    double_sided: true,
    back: 1.0,
    depth_range: [0.0, 1.0],
    reversed_depth: true,
    copied: false,
};

impl Way {
    /// Width and height of images that contain a picture of `size` with its margin.
    pub fn around(&self, size: [u32; 2]) -> [u32; 2] {
        [0, 1].map(|axis| size[axis] + 2 * self.corner[axis])
    }

    /// Pixels of the images: a picture, surrounded by `around`.
    pub fn framed<T: Copy>(&self, picture: &[T], size: [u32; 2], around: T) -> Vec<T> {
        let [width, height] = self.around(size);
        let mut pixels = vec![around; (width * height) as usize];
        for (row, line) in picture.chunks_exact(size[0] as usize).enumerate() {
            let first = (row + self.corner[1] as usize) * width as usize + self.corner[0] as usize;
            pixels[first..first + line.len()].copy_from_slice(line);
        }
        pixels
    }
}

/// Buffers and draws that lend a world.
pub struct Lent {
    /// The mesh of each vertex, and of each index.
    pub of_vertices: Vec<usize>,
    pub of_indices: Vec<usize>,
    pub positions: Vec<u8>,
    pub vertex_count: u32,
    /// Brightness of each vertex.
    pub paints: Vec<f32>,
    pub coordinates: Vec<[f32; 2]>,
    pub indices: Vec<u8>,
    pub index_type: vk::IndexType,
    pub index_count: u32,
    pub draws: Vec<Draw>,
    /// Draws that the device reads from buffers.
    pub indirect: Vec<Indirect>,
    /// Number of triangles of all draws; with indirect draws, number of places for triangles.
    pub triangle_count: u32,
    /// Number of vertices over all draws.
    pub drawn_vertices: u32,
}

/// List of draws in buffers. The handles in `list` are still missing.
pub struct Indirect {
    pub list: IndirectDraws,
    pub commands: Vec<u8>,
    /// Contents of the buffer with the number of commands, if there is one.
    pub count: Option<Vec<u8>>,
    pub instances: Vec<Instance>,
}

/// Images of the host's own renderer: for each pixel the ID, depth and colour of its triangle.
pub struct Drawn {
    pub ids: Vec<u32>,
    pub depths: Vec<f32>,
    pub colors: Vec<[f32; 4]>,
}

pub fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|column| std::array::from_fn(|row| (0..4).map(|i| a[i][row] * b[column][i]).sum()))
}

/// Perspective projection, y down, with depth from 1 at the near plane to 0 at infinity.
pub fn projection() -> Matrix {
    let mut matrix = [[0.0; 4]; 4];
    (matrix[0][0], matrix[1][1]) = (1.3, -1.3);
    (matrix[2][3], matrix[3][2]) = (-1.0, 0.1);
    matrix
}

/// Rotation about the view direction and the vertical axis, followed by a translation.
pub fn placed(around: f32, turned: f32, at: [f32; 3]) -> Matrix {
    let ((s, c), (t, d)) = (around.sin_cos(), turned.sin_cos());
    [[c * d, s, -c * t, 0.0], [-s * d, c, s * t, 0.0], [t, 0.0, d, 0.0], [at[0], at[1], at[2], 1.0]]
}

impl World {
    /// A world of blades, some thinner than a pixel, in front of sheets; each mesh is shown several times.
    pub fn new() -> Self {
        let mut blades = Mesh { positions: vec![[0.0; 3]], paints: vec![0.2], ..Mesh::default() };
        for blade in 0..9_u32 {
            let (angle, wide) = (0.7 * blade as f32, 0.01 + 0.012 * blade as f32);
            for (side, paint) in [(-wide, 0.5), (wide, 1.0)] {
                let (s, c) = (angle + side).sin_cos();
                blades.positions.push([c, s, 0.1 * s]);
                blades.paints.push(paint);
            }
            blades.indices.extend([0, 2 * blade + 1, 2 * blade + 2]);
        }
        let mut sheet = Mesh::default();
        for row in 0..5_u32 {
            for column in 0..5_u32 {
                let (x, y) = (column as f32 / 2.0 - 1.0, row as f32 / 2.0 - 1.0);
                sheet.positions.push([x, y, 0.2 * (3.0 * x + y).sin()]);
                sheet.paints.push(0.3 + 0.15 * row as f32);
                if row < 4 && column < 4 {
                    let a = 5 * row + column;
                    sheet.indices.extend([a, a + 6, a + 1, a, a + 5, a + 6]);
                }
            }
        }
        let part = |mesh, number: u32| {
            let n = number as f32;
            let at = [(2.3 * n).sin() * 0.8, (1.7 * n).cos() * 0.7, -2.0 - 0.37 * n];
            Part {
                mesh,
                to_clip: product(&projection(), &placed(0.31 + n, 0.4 * n, at)),
                color: [1.0, 0.3 + 0.1 * n, 1.0 - 0.13 * n],
                opacity: 1.0,
                alpha_map: None,
            }
        };
        Self {
            meshes: vec![blades, sheet],
            parts: (0..7).map(|n| part(usize::from(n % 3 == 2), n)).collect(),
            maps: Vec::new(),
            projection: projection(),
        }
    }

    /// World with the positions of [`World::new`], rounded to a format.
    pub fn rounded(format: VertexFormat) -> Self {
        let mut world = Self::new();
        for position in world.meshes.iter_mut().flat_map(|mesh| &mut mesh.positions) {
            for (axis, component) in position.iter_mut().enumerate() {
                *component = if largest(format) > 0.0 {
                    let step = format.scale[axis] / largest(format);
                    format.bias[axis] + step * integer(format, axis, *component)
                } else {
                    half::f16::from_f32(*component).to_f32()
                };
            }
        }
        world
    }

    /// World with the same vertices as [`World::new`], whose indices are those of strips or fans.
    pub fn of(topology: Topology) -> Self {
        let mut world = Self::new();
        for mesh in &mut world.meshes {
            mesh.sequence = std::mem::take(&mut mesh.indices);
            let triangles = match topology {
                Topology::List => topology::list(&mesh.sequence),
                Topology::Strip => topology::strip(&mesh.sequence),
                Topology::Fan => topology::fan(&mesh.sequence),
            };
            mesh.indices = triangles.concat();
        }
        world
    }

    /// Buffers for a way of lending.
    pub fn lent(&self, way: &Way) -> Lent {
        let meshes: Vec<_> = self.meshes.iter().map(|mesh| mesh.lent(way)).collect();
        let mut vertices: Vec<Vec<f32>> = Vec::new();
        let mut paints = Vec::new();
        let mut coordinates = Vec::new();
        let mut indices: Vec<u32> = Vec::new();
        let mut of_meshes = Vec::new();
        for mesh in &meshes {
            of_meshes.push((vertices.len(), indices.len()));
            indices.extend(&mesh.indices);
            if way.object_space {
                vertices.extend(mesh.positions.iter().map(|p| p.to_vec()));
                paints.extend(&mesh.paints);
                coordinates.extend(&mesh.coordinates);
            }
        }
        let mut drawn_vertices = 0;
        let mut draws = Vec::new();
        let mut of_vertices: Vec<usize> = Vec::new();
        if way.object_space {
            for (number, mesh) in meshes.iter().enumerate() {
                of_vertices.resize(of_vertices.len() + mesh.positions.len(), number);
            }
        }
        for (number, part) in self.parts.iter().enumerate() {
            let mesh = &meshes[part.mesh];
            let (first_vertex, first_index) = of_meshes[part.mesh];
            let first_vertex = if way.object_space {
                first_vertex
            } else {
                let first = vertices.len();
                vertices.extend(mesh.clip(&part.to_clip).map(|p| p.to_vec()));
                of_vertices.resize(vertices.len(), part.mesh);
                paints.extend(&mesh.paints);
                coordinates.extend(&mesh.coordinates);
                first
            };
            // Without indices, a draw may begin after the vertex that it counts from.
            let before = if way.bare { first_vertex.min(2) } else { 0 };
            let vertex_count = (mesh.positions.len() + before) as u32;
            drawn_vertices += vertex_count;
            draws.push(Draw {
                mesh: if way.apart { part.mesh as u32 } else { 0 },
                first_index: if way.bare { before } else { first_index } as u32,
                triangle_count: self.meshes[part.mesh].indices.len() as u32 / 3,
                topology: way.topology,
                vertex_offset: (first_vertex - before) as i32,
                vertex_count,
                to_clip: part.to_clip,
                material: number as u16,
                alpha_map: part.alpha_map,
                blended: part.opacity < 1.0,
                double_sided: way.double_sided,
                front_face: way.front_face,
                ..Draw::default()
            });
        }
        // Bytes between the vertices are NaN when read as floats.
        let mut positions = vec![0xff; way.positions_offset as usize];
        for vertex in &vertices {
            let end = positions.len() + way.stride as usize;
            positions.extend(encoded(way.format, vertex));
            positions.resize(end, 0xff);
        }
        positions.resize(positions.len().next_multiple_of(4), 0xff);
        let mut index_bytes = vec![0xff; way.indices_offset as usize];
        for &index in &indices {
            if way.short_indices {
                index_bytes.extend((index as u16).to_ne_bytes());
            } else {
                index_bytes.extend(index.to_ne_bytes());
            }
        }
        index_bytes.resize(index_bytes.len().next_multiple_of(4), 0xff);
        let of_indices = meshes.iter().enumerate();
        let of_indices = of_indices.flat_map(|(number, mesh)| vec![number; mesh.indices.len()]);
        Lent {
            of_indices: of_indices.collect(),
            of_vertices,
            positions,
            vertex_count: vertices.len() as u32,
            paints,
            coordinates,
            indices: index_bytes,
            index_type: if way.short_indices { vk::IndexType::UINT16 } else { vk::IndexType::UINT32 },
            index_count: indices.len() as u32,
            triangle_count: draws.iter().map(|draw| draw.triangle_count).sum(),
            draws,
            indirect: Vec::new(),
            drawn_vertices,
        }
    }

    /// Corners of all triangles in clip space, in the order of the draws.
    pub fn corners(&self) -> Vec<[[f32; 4]; 3]> {
        let of_part = |part: &Part| {
            let mesh = &self.meshes[part.mesh];
            let places: Vec<_> = mesh.clip(&part.to_clip).collect();
            let triangles = mesh.indices.chunks_exact(3);
            triangles.map(|t| [0, 1, 2].map(|corner| places[t[corner] as usize])).collect::<Vec<_>>()
        };
        self.parts.iter().flat_map(of_part).collect()
    }

    /// Colour, and brightness of the corners, of each triangle in the same order.
    fn looks(&self) -> Vec<([f32; 3], [f32; 3])> {
        let of_part = |part: &Part| {
            let mesh = &self.meshes[part.mesh];
            let triangles = mesh.indices.chunks_exact(3);
            let color = part.color;
            triangles.map(|t| (color, [0, 1, 2].map(|corner| mesh.paints[t[corner] as usize]))).collect::<Vec<_>>()
        };
        self.parts.iter().flat_map(of_part).collect()
    }

    /// Triangles of the world, as the host's renderer stores them.
    pub fn surfaces(&self) -> Surfaces {
        let half = SIZE.map(|side| 0.5 * side as f32);
        let in_pixels = |[x, y, z, w]: [f32; 4]| [x * half[0], y * half[1], z, w];
        let surfaces = (1..).zip(self.corners()).filter_map(|(id, corners)| {
            let corners = corners.map(in_pixels);
            Some((bounds(&corners), Surface::new(id, corners, true)?))
        });
        Surfaces { surfaces: surfaces.collect(), looks: self.looks() }
    }

    /// Images of the centres of pixels.
    pub fn drawn(&self) -> Drawn {
        let surfaces = self.surfaces();
        let mut drawn = Drawn { ids: Vec::new(), depths: Vec::new(), colors: Vec::new() };
        for pixel in 0..SIZE[0] * SIZE[1] {
            let at = [pixel % SIZE[0], pixel / SIZE[0]];
            let hit = surfaces.at(at.map(|at| f64::from(at) + 0.5));
            let (id, depth, [r, g, b]) = hit.unwrap_or((0, 0.0, SKY));
            drawn.ids.push(id);
            drawn.depths.push(depth);
            drawn.colors.push([r, g, b, 1.0]);
        }
        drawn
    }
}

/// Largest integer of a normalised format; 0 for floats.
fn largest(format: VertexFormat) -> f32 {
    match format.format {
        vk::Format::R16G16B16_UNORM | vk::Format::R16G16B16A16_UNORM => 65_535.0,
        vk::Format::R16G16B16_SNORM | vk::Format::R16G16B16A16_SNORM => 32_767.0,
        _ => 0.0,
    }
}

/// Number that stands for component `axis` of a position in a normalised format.
fn integer(format: VertexFormat, axis: usize, component: f32) -> f32 {
    let number = (component - format.bias[axis]) / format.scale[axis] * largest(format);
    number.round().clamp(-32_767.0, 65_535.0)
}

/// Bytes of a vertex. Components that the format has beyond those of the vertex are ones.
fn encoded(format: VertexFormat, vertex: &[f32]) -> Vec<u8> {
    if format == VertexFormat::FLOAT {
        return bytemuck::cast_slice(vertex).to_vec();
    }
    let word = |(axis, component): (usize, &f32)| match format.format {
        vk::Format::R16G16B16_SFLOAT | vk::Format::R16G16B16A16_SFLOAT => half::f16::from_f32(*component).to_bits(),
        _ => integer(format, axis, *component) as i32 as u16,
    };
    let words: Vec<u16> = vertex.iter().enumerate().map(word).collect();
    bytemuck::cast_slice(&words).to_vec()
}

/// Smallest and largest x and y of a triangle in the image. The triangle lies in front of the eye.
fn bounds(corners: &[[f32; 4]; 3]) -> [[f64; 2]; 2] {
    [0, 1].map(|axis| {
        let places = corners.map(|corner| f64::from(corner[axis]) / f64::from(corner[3]));
        let least = places.into_iter().fold(f64::INFINITY, f64::min);
        [least, places.into_iter().fold(f64::NEG_INFINITY, f64::max)]
    })
}

/// Triangles of a world, with their bounds and appearance.
pub struct Surfaces {
    surfaces: Vec<([[f64; 2]; 2], Surface)>,
    looks: Vec<([f32; 3], [f32; 3])>,
}

impl Surfaces {
    /// ID, depth and colour of the nearest triangle at a place in the image, in pixels from its upper left corner.
    pub fn at(&self, place: [f64; 2]) -> Option<(u32, f32, [f32; 3])> {
        let place = [0, 1].map(|axis| place[axis] - 0.5 * f64::from(SIZE[axis]));
        let near = self.surfaces.iter().filter(|(bounds, _)| {
            let within = |axis: usize| {
                let [least, greatest] = bounds[axis];
                (least - 0.01..greatest + 0.01).contains(&place[axis])
            };
            within(0) && within(1)
        });
        let near: Vec<_> = near.map(|(_, surface)| surface).collect();
        let hit = nearest(near.iter().copied(), place).nearest?;
        let surface = near.iter().find(|known| known.id() == hit.id)?;
        let factors = surface.edges().factors(place);
        let (color, paints) = self.looks[hit.id as usize - 1];
        let sum: f64 = factors.iter().sum();
        let paint: f64 = (0..3).map(|i| factors[i] * f64::from(paints[i])).sum();
        let color = color.map(|channel| channel * (paint / sum) as f32);
        Some((hit.id, hit.depth as f32, color))
    }
}

impl Mesh {
    /// The mesh as it is lent: without indices, each corner is a vertex.
    fn lent(&self, way: &Way) -> Self {
        let indices = match way.topology {
            Topology::List => &self.indices,
            Topology::Strip | Topology::Fan => &self.sequence,
        };
        let corners = (0..self.positions.len() as u32).collect();
        let vertices = if way.bare { indices } else { &corners };
        let of = |index: &u32| *index as usize;
        let has_coordinates = !self.coordinates.is_empty();
        let coordinates = vertices.iter().filter(|_| has_coordinates);
        Self {
            positions: vertices.iter().map(|v| self.positions[of(v)]).collect(),
            paints: vertices.iter().map(|v| self.paints[of(v)]).collect(),
            coordinates: coordinates.map(|v| self.coordinates[of(v)]).collect(),
            indices: indices.clone(),
            sequence: Vec::new(),
        }
    }

    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Vertices in clip space.
    pub fn clip(&self, to_clip: &Matrix) -> impl Iterator<Item = [f32; 4]> {
        self.positions.iter().map(|p| clip_position(*to_clip, *p))
    }
}
