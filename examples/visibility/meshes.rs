//! The host's meshes, where their instances are at a time, and the texture.

use crate::Failure;
use crate::device::{Buffer, Device, Texture};
use ash::vk;
use glam::{Mat4, Quat, Vec3};
use gpc::host::Draw;
use std::f32::consts::TAU;

/// Shading keys, as in `shaders/materials.glsl`.
pub const WAVES: u32 = 0;
pub const BRICKS: u32 = 1;
pub const GLOW: u32 = 2;
pub const KEYS: u32 = 3;

/// As in `shaders/host.glsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Vertex {
    position: [f32; 3],
    u: f32,
    normal: [f32; 3],
    v: f32,
}

/// As in `shaders/host.glsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Instance {
    to_clip: [f32; 16],
    to_world: [f32; 16],
}

/// A run of vertices and of indices.
#[derive(Clone, Copy)]
pub struct Mesh {
    pub first_vertex: u32,
    pub vertex_count: u32,
    pub first_index: u32,
    pub triangle_count: u32,
}

/// What the host shows, in the order of its draws.
pub struct World<'a> {
    pub vertices: Buffer<'a>,
    pub indices: Buffer<'a>,
    pub index_count: u32,
    /// Of each draw, for the host's own shaders.
    pub draw_table: Buffer<'a>,
    pub draw_of: Buffer<'a>,
    pub draws: Vec<Draw>,
    /// Mesh of each draw.
    pub meshes: Vec<Mesh>,
    pub triangle_count: u32,
    pub posed_count: u32,
    pub bricks: Texture<'a>,
}

#[derive(Default)]
struct Builder {
    vertices: Vec<Vertex>,
    indices: Vec<u32>,
}

impl Builder {
    /// A mesh over a grid; `at` gives position and normal at u and v from 0 to 1. Front faces are seen where the normal
    /// points to.
    fn grid(
        &mut self,
        [columns, rows]: [u32; 2],
        repeat: [f32; 2],
        at: impl Fn(f32, f32) -> (Vec3, Vec3),
    ) -> Mesh {
        let (first_vertex, first_index) = (self.vertices.len() as u32, self.indices.len() as u32);
        for row in 0..=rows {
            for column in 0..=columns {
                let (u, v) = (column as f32 / columns as f32, row as f32 / rows as f32);
                let (position, normal) = at(u, v);
                self.vertices.push(Vertex {
                    position: position.to_array(),
                    u: u * repeat[0],
                    normal: normal.to_array(),
                    v: v * repeat[1],
                });
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let a = row * (columns + 1) + column;
                let (b, c, d) = (a + 1, a + columns + 1, a + columns + 2);
                self.indices.extend([a, b, d, a, d, c]);
            }
        }
        Mesh {
            first_vertex,
            vertex_count: (columns + 1) * (rows + 1),
            first_index,
            triangle_count: 2 * columns * rows,
        }
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
        let floor = builder.grid([8, 8], [1.0; 2], |u, v| {
            (Vec3::new(16.0 * v - 8.0, 0.0, 16.0 * u - 8.0), Vec3::Y)
        });
        let ring = builder.torus(0.3, [96, 32]);
        let wire = builder.torus(0.006, [128, 6]);
        let mut parts = vec![(floor, WAVES)];
        parts.extend([(ring, BRICKS); 5]);
        parts.extend([(wire, GLOW); 4]);

        let mut draws = Vec::new();
        let mut table = Vec::new();
        let mut draw_of = Vec::new();
        let mut posed = 0;
        for (index, &(mesh, key)) in parts.iter().enumerate() {
            table.push([draw_of.len() as u32, mesh.first_index, posed, key]);
            draw_of.extend(std::iter::repeat_n(
                index as u32,
                mesh.triangle_count as usize,
            ));
            draws.push(Draw {
                first_index: mesh.first_index,
                triangle_count: mesh.triangle_count,
                vertex_offset: posed as i32,
                key,
                material: index as u16,
                double_sided: false,
                detailed: key != GLOW,
                ..Draw::default()
            });
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
            bricks: bricks(device)?,
        })
    }

    /// Where each draw's mesh is at a time, in seconds.
    pub fn instances(&self, time: f32, to_clip: Mat4) -> Vec<Instance> {
        let place = |index: usize| -> Mat4 {
            let (number, key) = (index as f32, self.draws[index].key);
            match key {
                WAVES => Mat4::IDENTITY,
                BRICKS => {
                    let turn = Quat::from_rotation_y(time + number)
                        * Quat::from_rotation_x(0.9 + 0.7 * number + 0.5 * time);
                    let at = Vec3::new(
                        2.0 * (number - 3.0),
                        1.0 + 0.2 * (number + time).sin(),
                        -0.6 * (number % 2.0),
                    );
                    Mat4::from_rotation_translation(turn, at) * Mat4::from_scale(Vec3::splat(0.7))
                }
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

/// A wall of bricks with all its mipmap levels, linear.
fn bricks(device: &Device) -> Result<Texture<'_>, Failure> {
    const SIDE: u32 = 128;
    let levels = SIDE.ilog2() + 1;
    let texel = |x: u32, y: u32| -> [f32; 4] {
        let row = y / 16;
        let column = x + 16 * (row % 2);
        let mortar = y % 16 < 2 || column % 32 < 2;
        let shade = ((row * 7 + (column % SIDE) / 32 * 13) % 5) as f32 / 5.0;
        if mortar {
            [0.7, 0.68, 0.62, 1.0]
        } else {
            [0.35 + 0.25 * shade, 0.1 + 0.06 * shade, 0.06, 1.0]
        }
    };
    let mut level: Vec<[f32; 4]> = (0..SIDE * SIDE)
        .map(|i| texel(i % SIDE, i / SIDE))
        .collect();
    let mut bytes: Vec<u8> = Vec::new();
    let mut regions = Vec::new();
    for number in 0..levels {
        let side = SIDE >> number;
        regions.push(
            vk::BufferImageCopy::default()
                .buffer_offset(bytes.len() as u64)
                .image_subresource(vk::ImageSubresourceLayers {
                    aspect_mask: vk::ImageAspectFlags::COLOR,
                    mip_level: number,
                    base_array_layer: 0,
                    layer_count: 1,
                })
                .image_extent(vk::Extent3D {
                    width: side,
                    height: side,
                    depth: 1,
                }),
        );
        bytes.extend(
            level
                .iter()
                .flatten()
                .map(|value| (255.0 * value).round() as u8),
        );
        let half = (side / 2).max(1) as usize;
        let at = |x: usize, y: usize| {
            level[(y.min(side as usize - 1)) * side as usize + x.min(side as usize - 1)]
        };
        level = (0..half * half)
            .map(|i| {
                let (x, y) = (2 * (i % half), 2 * (i / half));
                let four = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
                [0, 1, 2, 3]
                    .map(|channel| four.iter().map(|texel| texel[channel]).sum::<f32>() / 4.0)
            })
            .collect();
    }
    let usage = vk::BufferUsageFlags::TRANSFER_SRC;
    let mut upload = device.buffer(bytes.len() as u64, usage)?;
    upload.bytes_mut()?[..bytes.len()].copy_from_slice(&bytes);
    let texture = device.image(
        vk::Format::R8G8B8A8_UNORM,
        [SIDE; 2],
        levels,
        vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST,
        vk::ImageAspectFlags::COLOR,
    )?;
    device.run(|commands| {
        let written = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        let shown = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        let change = |from, to| crate::slot::change(device, commands, &texture, levels, from, to);
        change(vk::ImageLayout::UNDEFINED, written);
        // SAFETY: the buffer holds all levels; the commands are waited for.
        unsafe {
            device.raw.cmd_copy_buffer_to_image(
                commands,
                upload.raw,
                texture.raw,
                written,
                &regions,
            );
        }
        change(written, shown);
    })?;
    Ok(texture)
}
