//! Images and samplers of a scene, each created once.

use super::texture::{DeviceSampler, GpuTexture};
use crate::engine::spirv::shade_set;
use crate::scene::{Filter, Image as SceneImage, Sampler, Scene};
use crate::vulkan::{Buffer, DescriptorSets, Memory, VulkanError, read_image};
use ash::vk;
use std::collections::HashMap;

/// Indices of an image and a sampler in a [`TextureSet`].
pub(super) type TextureIndex = (usize, usize);

/// Images and samplers that have been created.
pub(super) struct TextureSet<'a> {
    memory: &'a Memory,
    pub(super) textures: Vec<GpuTexture>,
    /// Contents of the textures.
    pub(super) texture_uploads: Vec<Buffer>,
    known: HashMap<(u32, bool), usize>,
    pub(super) samplers: Vec<(Sampler, DeviceSampler)>,
    white: Option<usize>,
}

impl<'a> TextureSet<'a> {
    pub(super) fn new(memory: &'a Memory) -> Self {
        Self {
            memory,
            textures: Vec::new(),
            texture_uploads: Vec::new(),
            known: HashMap::new(),
            samplers: Vec::new(),
            white: None,
        }
    }

    /// Index of a texture of the scene; `srgb` is true for colours. `None` if the scene lacks it.
    pub(super) fn get(&mut self, scene: &Scene, texture: u32, srgb: bool) -> Result<Option<TextureIndex>, VulkanError> {
        let Some(texture) = scene.textures.get(texture as usize) else {
            return Ok(None);
        };
        let Some(image) = scene.images.get(texture.image as usize) else {
            return Ok(None);
        };
        let index = match self.known.get(&(texture.image, srgb)) {
            Some(index) => *index,
            None => {
                let index = self.add(image, srgb)?;
                self.known.insert((texture.image, srgb), index);
                index
            }
        };
        Ok(Some((index, self.sampler(texture.sampler)?)))
    }

    fn add(&mut self, image: &SceneImage, srgb: bool) -> Result<usize, VulkanError> {
        let (texture, upload) = GpuTexture::new(self.memory, image, srgb)?;
        self.textures.push(texture);
        self.texture_uploads.push(upload);
        Ok(self.textures.len() - 1)
    }

    /// Index of a texture's sampler; the one for means is there, too.
    fn sampler(&mut self, sampler: Sampler) -> Result<usize, VulkanError> {
        self.add_sampler(averaging(sampler))?;
        self.add_sampler(sampler)
    }

    fn add_sampler(&mut self, sampler: Sampler) -> Result<usize, VulkanError> {
        if let Some(index) = self.samplers.iter().position(|(known, _)| *known == sampler) {
            return Ok(index);
        }
        self.samplers.push((sampler, DeviceSampler::new(self.memory.gpu(), &sampler)?));
        Ok(self.samplers.len() - 1)
    }

    /// White texel for bindings that the specialised shader does not read.
    pub(super) fn unused(&mut self) -> Result<TextureIndex, VulkanError> {
        let index = match self.white {
            Some(index) => index,
            None => {
                let texel = SceneImage { width: 1, height: 1, pixels: vec![255; 4] };
                self.add(&texel, false)?
            }
        };
        self.white = Some(index);
        Ok((index, self.sampler(Sampler::default())?))
    }

    /// Writes textures to the slots of a descriptor set, in their order, with samplers for means over footprints where
    /// `averages` is true.
    pub(super) fn write(&self, set: &DescriptorSets, textures: &[TextureIndex], averages: bool) {
        let infos: Vec<vk::DescriptorImageInfo> = textures
            .iter()
            .filter_map(|(image, sampler)| {
                let view = self.textures.get(*image)?.image.view;
                let (given, _) = self.samplers.get(*sampler)?;
                let wanted = if averages { averaging(*given) } else { *given };
                let mut samplers = self.samplers.iter();
                let (_, sampler) = samplers.find(|(known, _)| *known == wanted)?;
                Some(read_image(view).sampler(sampler.raw))
            })
            .collect();
        // SAFETY: the set was just allocated; images and samplers live as long as the scene that holds the set.
        unsafe { set.write_images(shade_set::TEXTURES, &infos) };
    }
}

/// Sampler with which means over a footprint (`BOX_FILTER` of the shaders) are read, from whole levels. Texels that are
/// smaller than the footprint are read linearly, and from mipmaps: the nearest texel of the full image is a sample of a
/// mean, not the mean.
fn averaging(sampler: Sampler) -> Sampler {
    Sampler { min: Filter::Linear, mip: Some(Filter::Nearest), ..sampler }
}
