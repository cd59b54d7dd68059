//! The host's textures.

use crate::Failure;
use crate::device::{Device, Texture};
use ash::vk;

/// Width and height of the fence's image.
pub const FENCE_SIDE: u32 = 8;

/// A wall of bricks.
pub fn bricks(device: &Device) -> Result<Texture<'_>, Failure> {
    const SIDE: u32 = 128;
    texture(device, SIDE, |x, y| {
        let row = y / 16;
        let column = x + 16 * (row % 2);
        let mortar = y % 16 < 2 || column % 32 < 2;
        let shade = ((row * 7 + (column % SIDE) / 32 * 13) % 5) as f32 / 5.0;
        if mortar { [0.7, 0.68, 0.62, 1.0] } else { [0.35 + 0.25 * shade, 0.1 + 0.06 * shade, 0.06, 1.0] }
    })
}

/// A sheet with a round hole in each tile: alpha grows with the distance from the tile's centre, and is 1/2 at the
/// hole's border.
pub fn fence(device: &Device) -> Result<Texture<'_>, Failure> {
    const RADIUS: f32 = 0.36;
    texture(device, FENCE_SIDE, |x, y| {
        let from_centre = |at: u32| (at as f32 + 0.5) / FENCE_SIDE as f32 - 0.5;
        let beyond = from_centre(x).hypot(from_centre(y)) - RADIUS;
        [1.0, 1.0, 1.0, (0.5 + 2.0 * beyond).clamp(0.0, 1.0)]
    })
}

/// Makes a texture with all mipmap levels from a square image of linear values, whose side is a power of two.
fn texture(device: &Device, side: u32, texel: impl Fn(u32, u32) -> [f32; 4]) -> Result<Texture<'_>, Failure> {
    let levels = side.ilog2() + 1;
    let mut level: Vec<[f32; 4]> = (0..side * side).map(|i| texel(i % side, i / side)).collect();
    let mut bytes: Vec<u8> = Vec::new();
    let mut regions = Vec::new();
    for number in 0..levels {
        let side = side >> number;
        regions.push(
            vk::BufferImageCopy::default()
                .buffer_offset(bytes.len() as u64)
                .image_subresource(vk::ImageSubresourceLayers {
                    aspect_mask: vk::ImageAspectFlags::COLOR,
                    mip_level: number,
                    base_array_layer: 0,
                    layer_count: 1,
                })
                .image_extent(vk::Extent3D { width: side, height: side, depth: 1 }),
        );
        bytes.extend(level.iter().flatten().map(|value| (255.0 * value).round() as u8));
        let half = (side / 2).max(1) as usize;
        let at = |x: usize, y: usize| level[(y.min(side as usize - 1)) * side as usize + x.min(side as usize - 1)];
        level = (0..half * half)
            .map(|i| {
                let (x, y) = (2 * (i % half), 2 * (i / half));
                let four = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
                [0, 1, 2, 3].map(|channel| four.iter().map(|texel| texel[channel]).sum::<f32>() / 4.0)
            })
            .collect();
    }
    let usage = vk::BufferUsageFlags::TRANSFER_SRC;
    let mut upload = device.buffer(bytes.len() as u64, usage)?;
    upload.bytes_mut()?[..bytes.len()].copy_from_slice(&bytes);
    let texture = device.image(
        vk::Format::R8G8B8A8_UNORM,
        [side; 2],
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
            device.raw.cmd_copy_buffer_to_image(commands, upload.raw, texture.raw, written, &regions);
        }
        change(written, shown);
        Ok(())
    })?;
    Ok(texture)
}
