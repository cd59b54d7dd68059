//! Images and samplers on the device.

use super::mipmaps;
use crate::scene::{Filter, Image as SceneImage, Sampler, Wrap};
use crate::vulkan::{Buffer, Gpu, Image, Memory, Recorder, VulkanError, flat_image};
use ash::vk;
use std::sync::Arc;

/// An image with its mipmaps.
pub(super) struct GpuTexture {
    pub(super) image: Image,
}

impl GpuTexture {
    /// Makes the image, and a buffer with its contents; `srgb` is true for colours.
    pub(super) fn new(memory: &Memory, source: &SceneImage, srgb: bool) -> Result<(Self, Buffer), VulkanError> {
        let limit = u64::from(memory.gpu().limits().max_image_side);
        let side = u64::from(source.width.max(source.height));
        VulkanError::check_limit("a texture's side", side, "texels", limit)?;
        let format = if srgb { vk::Format::R8G8B8A8_SRGB } else { vk::Format::R8G8B8A8_UNORM };
        let usage = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST;
        let info = flat_image(format, [source.width, source.height], usage).mip_levels(source.full_levels());
        let image = memory.image("texture", &info, vk::ImageAspectFlags::COLOR)?;
        let upload = memory.upload("texture upload", &mipmaps::levels(source, srgb))?;
        Ok((Self { image }, upload))
    }

    /// Records the copy of all levels.
    pub(super) fn record_upload(&self, recorder: &Recorder<'_>, upload: &Buffer) {
        let image = &self.image;
        let mut end = 0;
        let levels = (0..image.levels).map(|level| {
            let [width, height] = [image.extent.width, image.extent.height].map(|side| (side >> level).max(1));
            let first_byte = end;
            end += 4 * u64::from(width) * u64::from(height);
            (first_byte, [width, height])
        });
        recorder.fill_image(image, upload, levels);
    }
}

/// A sampler that is destroyed with its owner.
pub(super) struct DeviceSampler {
    gpu: Arc<Gpu>,
    pub(super) raw: vk::Sampler,
}

impl DeviceSampler {
    pub(super) fn new(gpu: &Arc<Gpu>, sampler: &Sampler) -> Result<Self, VulkanError> {
        let filter = |filter| match filter {
            Filter::Nearest => vk::Filter::NEAREST,
            Filter::Linear => vk::Filter::LINEAR,
        };
        let wrap = |wrap| match wrap {
            Wrap::Repeat => vk::SamplerAddressMode::REPEAT,
            Wrap::MirroredRepeat => vk::SamplerAddressMode::MIRRORED_REPEAT,
            Wrap::ClampToEdge => vk::SamplerAddressMode::CLAMP_TO_EDGE,
        };
        let info = vk::SamplerCreateInfo::default()
            .mag_filter(filter(sampler.mag))
            .min_filter(filter(sampler.min))
            .mipmap_mode(match sampler.mip {
                Some(Filter::Linear) => vk::SamplerMipmapMode::LINEAR,
                _ => vk::SamplerMipmapMode::NEAREST,
            })
            .address_mode_u(wrap(sampler.wrap_u))
            .address_mode_v(wrap(sampler.wrap_v))
            .max_lod(if sampler.mip.is_some() { vk::LOD_CLAMP_NONE } else { 0.25 });
        // SAFETY: plain creation on a live device.
        let raw = unsafe { gpu.device.create_sampler(&info, None) }.map_err(VulkanError::of("vkCreateSampler"))?;
        Ok(Self { gpu: gpu.clone(), raw })
    }
}

impl Drop for DeviceSampler {
    fn drop(&mut self) {
        // SAFETY: owners drop samplers after the frames that use them.
        unsafe { self.gpu.device.destroy_sampler(self.raw, None) };
    }
}
