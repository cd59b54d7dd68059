//! Environment in the form that shaders read.

use super::texture::DeviceSampler;
use crate::engine::data::upload::Uploader;
use crate::engine::pipelines::FrameLayout;
use crate::render::passes::prefilter::{self, Prefilter};
use crate::scene::{Environment, Filter, Sampler, Wrap};
use crate::vulkan::{Buffer, Image, Recorder, VulkanError, flat_image, read_image};
use ash::vk;
use half::f16;

/// A cube of half floats with a level for each roughness, and its part of the uniform block. For a scene without an
/// environment the cube is black, has one texel a face and is not read.
pub(in crate::render) struct GpuEnvironment {
    image: Image,
    sampler: DeviceSampler,
    pub(in crate::render) uniform: EnvironmentUniform,
    /// Side of each level's faces in texels, and the index of its first texel in the source of the copy.
    levels: Vec<(u32, u32)>,
}

/// Source of a cube: texels of four half floats.
pub(super) enum EnvironmentUpload {
    /// The levels, one after the other.
    Levels(Buffer),
    /// Averages from which the device makes the levels.
    Averages(Box<Prefilter>),
}

/// Fields of the uniform block `Frame` that belong to the environment.
#[derive(Clone, Copy, Debug, Default)]
pub struct EnvironmentUniform {
    /// Spherical-harmonic coefficients of the irradiance / pi; the fourth component is unused.
    pub irradiance: [[f32; 4]; 9],
    /// Rows of the rotation from world space to the map's space. In the fourth components, the first row has a factor
    /// for the cube's values, the second row the index of the last level, and the third row the number of
    /// groups of bright parts.
    pub axes: [[f32; 4]; 3],
}

const TRILINEAR: Sampler = Sampler {
    mag: Filter::Linear,
    min: Filter::Linear,
    mip: Some(Filter::Linear),
    wrap_u: Wrap::ClampToEdge,
    wrap_v: Wrap::ClampToEdge,
};

/// Largest value that is stored; half floats end at 65,504.
const LARGEST: f32 = 60_000.0;

impl GpuEnvironment {
    /// Makes the cube of an environment, and its source.
    pub(super) fn new(
        layout: &FrameLayout,
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
        let mut texels: Vec<[f16; 4]> =
            colors.iter().map(|[r, g, b]| [r / factor, g / factor, b / factor, 1.0].map(f16::from_f32)).collect();
        let name = "environment upload";
        let upload = if environment.is_none_or(Environment::is_filtered) {
            let bytes = bytemuck::cast_slice(&texels);
            EnvironmentUpload::Levels(uploader.memory.upload(name, bytes)?)
        } else {
            levels = prefilter::levels(finest).collect();
            let end = levels.iter().map(|(side, first)| first + 6 * side * side).max();
            texels.resize(texels.len().max(end.unwrap_or(0) as usize), [f16::ZERO; 4]);
            let buffer = uploader.storage(name, bytemuck::cast_slice(&texels))?;
            let prefilter = Prefilter::new(layout, uploader.memory, buffer, finest)?;
            EnvironmentUpload::Averages(Box::new(prefilter))
        };
        let usage = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST;
        let info = flat_image(vk::Format::R16G16B16A16_SFLOAT, [finest; 2], usage)
            .flags(vk::ImageCreateFlags::CUBE_COMPATIBLE)
            .mip_levels(levels.len() as u32)
            .array_layers(6);
        let image = uploader.memory.image("environment", &info, vk::ImageAspectFlags::COLOR)?;
        let uniform = environment.map_or(EnvironmentUniform::default(), |environment| {
            let rows = environment.rotation().transpose();
            let last = (levels.len() - 1) as f32;
            let groups = environment.suns().groups.len() as f32;
            let row = |row: glam::DVec3, w: f32| row.as_vec3().extend(w).to_array();
            EnvironmentUniform {
                irradiance: environment.irradiance().map(|[r, g, b]| [r, g, b, 0.0]),
                axes: [row(rows.x_axis, factor), row(rows.y_axis, last), row(rows.z_axis, groups)],
            }
        });
        let this = Self { image, sampler: DeviceSampler::new(&layout.gpu, &TRILINEAR)?, uniform, levels };
        Ok((this, upload))
    }

    /// Descriptor of the cube.
    pub(in crate::render) fn descriptor(&self) -> vk::DescriptorImageInfo {
        read_image(self.image.view).sampler(self.sampler.raw)
    }

    /// Records the copies to the cube; its buffers have been uploaded before.
    pub(super) fn record_upload(&self, recorder: &Recorder<'_>, upload: &EnvironmentUpload) {
        let texels = match upload {
            EnvironmentUpload::Levels(levels) => levels,
            EnvironmentUpload::Averages(averages) => {
                averages.record(recorder);
                averages.texels()
            }
        };
        let first_byte = |first: u32| u64::from(first) * size_of::<[f16; 4]>() as u64;
        let levels = self.levels.iter().map(|&(side, first)| (first_byte(first), [side; 2]));
        recorder.fill_image(&self.image, texels, levels);
    }
}
