//! Meshes of the host, and the places of their instances at a time.

use crate::Failure;
use crate::device::{Buffer, Device, Texture};
use crate::textures;
use ash::vk;
use glam::{Mat4, Quat, Vec3};
use gpc::host::{AlphaMap, Draw};
use std::f32::consts::TAU;

/// Shading keys: the same numbers as in `shaders/materials.glsl`.
pub const WAVES: u32 = 0;
pub const BRICKS: u32 = 1;
pub const GLOW: u32 = 2;
pub const FENCE: u32 = 3;
pub const KEYS: u32 = 4;

/// A vertex, laid out as in `shaders/host.glsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Vertex {
    position: [f32; 3],
    _unused: f32,
    normal: [f32; 3],
    _unused_too: f32,
}

/// An instance, laid out as in `shaders/host.glsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Instance {
    to_clip: [f32; 16],
    to_world: [f32; 16],
}

/// Ranges of a mesh's vertices and indices.
#[derive(Clone, Copy)]
pub struct Mesh {
    pub first_vertex: u32,
    pub vertex_count: u32,
    pub first_index: u32,
    pub triangle_count: u32,
}

/// Contents of the scene, in the order of the host's draws.
pub struct World<'a> {
    pub vertices: Buffer<'a>,
    pub indices: Buffer<'a>,
    pub index_count: u32,
    /// Data about each draw for the host's own shaders.
    pub draw_table: Buffer<'a>,
    pub draw_of: Buffer<'a>,
    pub draws: Vec<Draw>,
    /// The mesh of each draw.
    pub meshes: Vec<Mesh>,
    pub triangle_count: u32,
    pub posed_count: u32,
    /// Texture coordinates of posed vertices.
    pub coordinates: Buffer<'a>,
    pub bricks: Texture<'a>,
    pub fence: Texture<'a>,
}

#[derive(Default)]
struct Builder {
    vertices: Vec<Vertex>,
    coordinates: Vec<[f32; 2]>,
    indices: Vec<u32>,
}

impl Builder {
    /// Adds a mesh over a grid; `at` gives position and normal for u and v from 0 to 1. Front faces are on the side of
    /// the normal.
    fn grid(&mut self, [columns, rows]: [u32; 2], repeat: [f32; 2], at: impl Fn(f32, f32) -> (Vec3, Vec3)) -> Mesh {
        let (first_vertex, first_index) = (self.vertices.len() as u32, self.indices.len() as u32);
        for row in 0..=rows {
            for column in 0..=columns {
                let (u, v) = (column as f32 / columns as f32, row as f32 / rows as f32);
                let (position, normal) = at(u, v);
                self.vertices.push(Vertex {
                    position: position.to_array(),
                    normal: normal.to_array(),
                    ..bytemuck::Zeroable::zeroed()
                });
                self.coordinates.push([u * repeat[0], v * repeat[1]]);
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let a = row * (columns + 1) + column;
                let (b, c, d) = (a + 1, a + columns + 1, a + columns + 2);
                self.indices.extend([a, b, d, a, d, c]);
            }
        }
        Mesh { first_vertex, vertex_count: (columns + 1) * (rows + 1), first_index, triangle_count: 2 * columns * rows }
    }

    fn torus(&mut self, thickness: f32, cells: [u32; 2]) -> Mesh {
        self.grid(cells, [4.0, 1.0], |u, v| {
            let (around, along) = (TAU * u, TAU * v);
            let out = Vec3::new(around.cos(), 0.0, around.sin());
            let normal = out * along.cos() - Vec3::Y * along.sin();
            (out + thickness * normal, normal)
        })
    }
}

impl<'a> World<'a> {
    pub fn new(device: &'a Device) -> Result<Self, Failure> {
        let mut builder = Builder::default();
        let floor = builder.grid([8, 8], [1.0; 2], |u, v| (Vec3::new(16.0 * v - 8.0, 0.0, 16.0 * u - 8.0), Vec3::Y));
        let ring = builder.torus(0.3, [96, 32]);
        let wire = builder.torus(0.006, [128, 6]);
        let fence = builder.grid([48, 1], [30.0, 3.0], |u, v| {
            let around = 2.0 * u - 1.0;
            let out = Vec3::new(around.sin(), 0.0, around.cos());
            (2.7 * out + Vec3::Y * (0.6 - 0.54 * v), out)
        });
        let mut parts = vec![(floor, WAVES)];
        parts.extend([(ring, BRICKS); 5]);
        parts.extend([(wire, GLOW); 4]);
        // Meshes with an alpha map come last.
        parts.push((fence, FENCE));

        let mut draws = Vec::new();
        let mut table = Vec::new();
        let mut draw_of = Vec::new();
        let mut coordinates = Vec::new();
        let mut posed = 0;
        for (index, &(mesh, key)) in parts.iter().enumerate() {
            table.push([draw_of.len() as u32, mesh.first_index, posed, key]);
            draw_of.extend(std::iter::repeat_n(index as u32, mesh.triangle_count as usize));
            draws.push(Draw {
                first_index: mesh.first_index,
                triangle_count: mesh.triangle_count,
                vertex_offset: posed as i32,
                key,
                material: index as u16,
                alpha_map: (key == FENCE).then_some(0),
                double_sided: key == FENCE,
                detailed: matches!(key, WAVES | BRICKS),
                ..Draw::default()
            });
            let first = mesh.first_vertex as usize;
            let of_mesh = first..first + mesh.vertex_count as usize;
            coordinates.extend_from_slice(&builder.coordinates[of_mesh]);
            posed += mesh.vertex_count;
        }
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::INDEX_BUFFER;
        let mut index_buffer = device.buffer(4 * builder.indices.len() as u64, usage)?;
        let bytes: &[u8] = bytemuck::cast_slice(&builder.indices);
        index_buffer.bytes_mut()?[..bytes.len()].copy_from_slice(bytes);
        Ok(Self {
            vertices: device.filled(&builder.vertices)?,
            indices: index_buffer,
            index_count: builder.indices.len() as u32,
            draw_table: device.filled(&table)?,
            triangle_count: draw_of.len() as u32,
            draw_of: device.filled(&draw_of)?,
            draws,
            meshes: parts.iter().map(|(mesh, _)| *mesh).collect(),
            posed_count: posed,
            coordinates: device.filled(&coordinates)?,
            bricks: textures::bricks(device)?,
            fence: textures::fence(device)?,
        })
    }

    /// Alpha map of the fence, which the host's own pass also tests.
    pub fn alpha_map(&self) -> AlphaMap {
        AlphaMap {
            view: self.fence.view,
            size: [textures::FENCE_SIDE; 2],
            levels: 1,
            mag_filter: vk::Filter::LINEAR,
            min_filter: vk::Filter::LINEAR,
            mipmap_mode: vk::SamplerMipmapMode::NEAREST,
            address: [vk::SamplerAddressMode::REPEAT; 2],
            cutoff: 0.5,
        }
    }

    /// Instances of all draws at a time in seconds.
    pub fn instances(&self, time: f32, to_clip: Mat4) -> Vec<Instance> {
        let place = |index: usize| -> Mat4 {
            let (number, key) = (index as f32, self.draws[index].key);
            match key {
                WAVES => Mat4::IDENTITY,
                BRICKS => {
                    let turn =
                        Quat::from_rotation_y(time + number) * Quat::from_rotation_x(0.9 + 0.7 * number + 0.5 * time);
                    let at = Vec3::new(2.0 * (number - 3.0), 1.0 + 0.2 * (number + time).sin(), -0.6 * (number % 2.0));
                    Mat4::from_rotation_translation(turn, at) * Mat4::from_scale(Vec3::splat(0.7))
                }
                FENCE => Mat4::from_rotation_y(0.1 * time),
                _ => {
                    let turn = Quat::from_rotation_z(0.3 * number + 0.2 * time);
                    let at = Vec3::new(0.9 * (number - 7.5), 1.2, 1.0);
                    Mat4::from_rotation_translation(turn * Quat::from_rotation_x(1.3), at)
                }
            }
        };
        (0..self.draws.len())
            .map(|index| Instance {
                to_clip: (to_clip * place(index)).to_cols_array(),
                to_world: place(index).to_cols_array(),
            })
            .collect()
    }
}
