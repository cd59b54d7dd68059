//! The environment as the shaders read it.

use crate::scene::Environment;
use crate::vulkan::{Buffer, Image, Memory, Recorder, VulkanError};
use ash::vk;
use half::f16;

/// A cube of half floats with a level for each roughness, and what goes with it in the uniform block. Where a scene has no
/// environment the cube is a single black texel a face, which is not read.
pub(in crate::passes) struct GpuEnvironment {
    image: Image,
    pub(super) uniform: EnvironmentUniform,
    /// Texels along the side of each level's faces.
    sides: Vec<u32>,
}

/// What of the uniform block `Frame` an environment sets.
#[derive(Clone, Copy, Debug, Default)]
pub struct EnvironmentUniform {
    /// Coefficients of the irradiance over pi, the fourth number unused.
    pub irradiance: [[f32; 4]; 9],
    /// Rows that turn world space to the map's; in the first one's fourth number a factor on what the cube holds, in the
    /// second's the last level.
    pub axes: [[f32; 4]; 3],
}

/// Largest number that is stored; half floats end at 65,504.
const LARGEST: f32 = 60_000.0;

impl GpuEnvironment {
    /// The cube of an environment, and the bytes that fill it.
    pub(super) fn new(
        memory: &Memory,
        environment: Option<&Environment>,
    ) -> Result<(Self, Buffer), VulkanError> {
        let mut sides = Vec::new();
        let mut colors: Vec<[f32; 3]> = Vec::new();
        for (side, texels) in environment.into_iter().flat_map(Environment::levels) {
            sides.push(side);
            colors.extend_from_slice(texels);
        }
        if sides.is_empty() {
            sides.push(1);
            colors.resize(6, [0.0; 3]);
        }
        let brightest = colors.as_flattened().iter().copied().fold(0.0, f32::max);
        let factor = (brightest / LARGEST).max(1.0);
        let texels: Vec<[f16; 4]> = colors
            .iter()
            .map(|[r, g, b]| [r / factor, g / factor, b / factor, 1.0].map(f16::from_f32))
            .collect();
        let info = vk::ImageCreateInfo::default()
            .flags(vk::ImageCreateFlags::CUBE_COMPATIBLE)
            .image_type(vk::ImageType::TYPE_2D)
            .format(vk::Format::R16G16B16A16_SFLOAT)
            .extent(vk::Extent3D {
                width: sides[0],
                height: sides[0],
                depth: 1,
            })
            .mip_levels(sides.len() as u32)
            .array_layers(6)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST);
        let image = memory.image("environment", &info, vk::ImageAspectFlags::COLOR)?;
        let upload = memory.upload("environment upload", bytemuck::cast_slice(&texels))?;
        let uniform = environment.map_or(EnvironmentUniform::default(), |environment| {
            let rows = environment.rotation().transpose();
            let last = (sides.len() - 1) as f32;
            let row = |row: glam::DVec3, w: f32| row.as_vec3().extend(w).to_array();
            EnvironmentUniform {
                irradiance: environment.irradiance().map(|[r, g, b]| [r, g, b, 0.0]),
                axes: [
                    row(rows.x_axis, factor),
                    row(rows.y_axis, last),
                    row(rows.z_axis, 0.0),
                ],
            }
        });
        let this = Self {
            image,
            uniform,
            sides,
        };
        Ok((this, upload))
    }

    /// What a binding shows of it.
    pub(in crate::passes) fn descriptor(&self) -> vk::DescriptorImageInfo {
        vk::DescriptorImageInfo::default()
            .image_view(self.image.view)
            .image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)
    }

    pub(super) fn record_upload(&self, recorder: &Recorder<'_>, upload: &Buffer) {
        let write = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        recorder.transition(&self.image, vk::ImageLayout::UNDEFINED, write);
        let mut offset = 0;
        let mut copies = Vec::new();
        for (level, &side) in self.sides.iter().enumerate() {
            copies.push(
                vk::BufferImageCopy::default()
                    .buffer_offset(offset)
                    .image_subresource(vk::ImageSubresourceLayers {
                        aspect_mask: vk::ImageAspectFlags::COLOR,
                        mip_level: level as u32,
                        base_array_layer: 0,
                        layer_count: 6,
                    })
                    .image_extent(vk::Extent3D {
                        width: side,
                        height: side,
                        depth: 1,
                    }),
            );
            offset += u64::from(6 * side * side) * size_of::<[f16; 4]>() as u64;
        }
        // SAFETY: the recorder's contract; the buffer holds all levels, which are in the layout named.
        unsafe {
            recorder.device().cmd_copy_buffer_to_image(
                recorder.raw(),
                upload.raw,
                self.image.raw,
                write,
                &copies,
            );
        }
        let shown = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        recorder.transition(&self.image, write, shown);
    }
}
