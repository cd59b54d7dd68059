//! The environment as the shaders read it.

use crate::passes::upload::Uploader;
use crate::render::passes::prefilter::{self, Prefilter};
use crate::scene::Environment;
use crate::vulkan::{Buffer, Image, Recorder, VulkanError};
use ash::vk;
use half::f16;

/// A cube of half floats with a level for each roughness, and what goes with it in the uniform block. Where a scene has no
/// environment the cube is a single black texel a face, which is not read.
pub(in crate::render::passes) struct GpuEnvironment {
    image: Image,
    pub(super) uniform: EnvironmentUniform,
    /// Texels along the side of each level's faces, and the first of its texels in what is copied.
    levels: Vec<(u32, u32)>,
}

/// What a cube is copied from: texels of four half floats.
pub(super) enum EnvironmentUpload {
    /// The levels, one after the other.
    Levels(Buffer),
    /// Averages, which the device makes levels of.
    Averages(Box<Prefilter>),
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
    /// The cube of an environment, and what fills it.
    pub(super) fn new(
        uploader: &mut Uploader<'_>,
        environment: Option<&Environment>,
    ) -> Result<(Self, EnvironmentUpload), VulkanError> {
        let mut levels = Vec::new();
        let mut colors: Vec<[f32; 3]> = Vec::new();
        for (side, texels) in environment.into_iter().flat_map(Environment::cubes) {
            levels.push((side, colors.len() as u32));
            colors.extend_from_slice(texels);
        }
        if levels.is_empty() {
            levels.push((1, 0));
            colors.resize(6, [0.0; 3]);
        }
        let finest = levels[0].0;
        let brightest = colors.as_flattened().iter().copied().fold(0.0, f32::max);
        let factor = (brightest / LARGEST).max(1.0);
        let mut texels: Vec<[f16; 4]> = colors
            .iter()
            .map(|[r, g, b]| [r / factor, g / factor, b / factor, 1.0].map(f16::from_f32))
            .collect();
        let name = "environment upload";
        let upload = if environment.is_none_or(Environment::is_filtered) {
            let bytes = bytemuck::cast_slice(&texels);
            EnvironmentUpload::Levels(uploader.memory.upload(name, bytes)?)
        } else {
            levels = prefilter::levels(finest).collect();
            let end = levels
                .iter()
                .map(|(side, first)| first + 6 * side * side)
                .max();
            texels.resize(texels.len().max(end.unwrap_or(0) as usize), [f16::ZERO; 4]);
            let buffer = uploader.storage(name, bytemuck::cast_slice(&texels))?;
            let prefilter = Prefilter::new(uploader.memory, buffer, finest)?;
            EnvironmentUpload::Averages(Box::new(prefilter))
        };
        let info = vk::ImageCreateInfo::default()
            .flags(vk::ImageCreateFlags::CUBE_COMPATIBLE)
            .image_type(vk::ImageType::TYPE_2D)
            .format(vk::Format::R16G16B16A16_SFLOAT)
            .extent(vk::Extent3D {
                width: finest,
                height: finest,
                depth: 1,
            })
            .mip_levels(levels.len() as u32)
            .array_layers(6)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST);
        let image = uploader
            .memory
            .image("environment", &info, vk::ImageAspectFlags::COLOR)?;
        let uniform = environment.map_or(EnvironmentUniform::default(), |environment| {
            let rows = environment.rotation().transpose();
            let last = (levels.len() - 1) as f32;
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
            levels,
        };
        Ok((this, upload))
    }

    /// What a binding shows of it.
    pub(in crate::render::passes) fn descriptor(&self) -> vk::DescriptorImageInfo {
        vk::DescriptorImageInfo::default()
            .image_view(self.image.view)
            .image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)
    }

    /// Records what fills the cube; buffers have been copied to the device before.
    pub(super) fn record_upload(&self, recorder: &Recorder<'_>, upload: &EnvironmentUpload) {
        let texels = match upload {
            EnvironmentUpload::Levels(levels) => levels,
            EnvironmentUpload::Averages(averages) => {
                recorder.barrier();
                averages.record(recorder);
                averages.texels()
            }
        };
        let write = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        recorder.transition(&self.image, vk::ImageLayout::UNDEFINED, write);
        let copies: Vec<_> = (0..)
            .zip(&self.levels)
            .map(|(level, &(side, first))| {
                vk::BufferImageCopy::default()
                    .buffer_offset(u64::from(first) * size_of::<[f16; 4]>() as u64)
                    .image_subresource(vk::ImageSubresourceLayers {
                        aspect_mask: vk::ImageAspectFlags::COLOR,
                        mip_level: level,
                        base_array_layer: 0,
                        layer_count: 6,
                    })
                    .image_extent(vk::Extent3D {
                        width: side,
                        height: side,
                        depth: 1,
                    })
            })
            .collect();
        // SAFETY: the recorder's contract; the buffer holds all levels, which are in the layout named.
        unsafe {
            recorder.device().cmd_copy_buffer_to_image(
                recorder.raw(),
                texels.raw,
                self.image.raw,
                write,
                &copies,
            );
        }
        let shown = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        recorder.transition(&self.image, write, shown);
    }
}
