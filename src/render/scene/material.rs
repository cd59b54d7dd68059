//! Materials, textures and images (glTF 2.0, section 3.9 and 3.8).

use super::lobes::Lobes;

pub use gltf::json::texture::{MagFilter as Filter, WrappingMode as Wrap};

/// Use of a material's alpha (glTF's alpha mode).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaMode {
    /// Alpha is ignored.
    Opaque,
    /// Surface that exists only where alpha is at least the cutoff.
    Mask {
        /// Cutoff, usually within 0 to 1.
        cutoff: f32,
    },
    /// Surface that is composited over what lies behind.
    Blend,
}

/// Texture coordinate transform of `KHR_texture_transform`: `uv' = m * (u, v, 1)`, rows of a 2 x 3 matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureTransform(pub [[f32; 3]; 2]);

impl Default for TextureTransform {
    fn default() -> Self {
        Self([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    }
}

/// Use of a texture by a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureUse {
    /// Index into [`crate::scene::Scene::textures`].
    pub texture: u32,
    /// Index of the UV set, 0 or 1.
    pub uv_set: u32,
    /// Transform of the texture coordinates.
    pub transform: TextureTransform,
}

/// Material of a surface; the defaults are glTF's.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name in the file, if there is one.
    pub name: Option<String>,
    /// Base colour: linear RGB and straight alpha.
    pub base_color: [f32; 4],
    /// Metalness from 0 (dielectric) to 1 (metal).
    pub metallic: f32,
    /// Perceptual roughness, 0 to 1.
    pub roughness: f32,
    /// Linear emitted radiance, including the strength of `KHR_materials_emissive_strength`.
    pub emissive: [f32; 3],
    /// Factor for the x and y of the normal texture.
    pub normal_scale: f32,
    /// Strength of the occlusion texture from 0 (ignored) to 1.
    pub occlusion_strength: f32,
    /// Use of alpha.
    pub alpha_mode: AlphaMode,
    /// Whether back faces are drawn too.
    pub double_sided: bool,
    /// Whether an animation may change the material's numbers. If so, lobes are kept even if they have no effect at
    /// present.
    pub animated: bool,
    /// Whether the base colour is the final colour, without lighting (`KHR_materials_unlit`).
    pub unlit: bool,
    /// Texture of the base colour: sRGB colour and linear alpha.
    pub base_color_texture: Option<TextureUse>,
    /// Texture of roughness in green and metalness in blue, linear.
    pub metallic_roughness_texture: Option<TextureUse>,
    /// Texture of tangent-space normals, linear.
    pub normal_texture: Option<TextureUse>,
    /// Texture of occlusion in red, linear.
    pub occlusion_texture: Option<TextureUse>,
    /// Texture of emitted light: sRGB colour.
    pub emissive_texture: Option<TextureUse>,
    /// Lobes and layers of extensions.
    pub lobes: Lobes,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: None,
            base_color: [1.0; 4],
            metallic: 1.0,
            roughness: 1.0,
            emissive: [0.0; 3],
            normal_scale: 1.0,
            occlusion_strength: 1.0,
            alpha_mode: AlphaMode::Opaque,
            double_sided: false,
            animated: false,
            unlit: false,
            base_color_texture: None,
            metallic_roughness_texture: None,
            normal_texture: None,
            occlusion_texture: None,
            emissive_texture: None,
            lobes: Lobes::default(),
        }
    }
}

/// Property of a material that a texture modulates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
#[non_exhaustive]
pub enum TextureRole {
    BaseColor,
    MetallicRoughness,
    Normal,
    Occlusion,
    Emissive,
    Specular,
    SpecularColor,
    Clearcoat,
    ClearcoatRoughness,
    ClearcoatNormal,
    SheenColor,
    SheenRoughness,
    Anisotropy,
    Iridescence,
    IridescenceThickness,
    DiffuseTransmission,
    DiffuseTransmissionColor,
    Transmission,
    Thickness,
    SpecularGlossiness,
}

impl TextureRole {
    /// Number of roles.
    pub const COUNT: usize = Self::SpecularGlossiness as usize + 1;

    /// Whether red, green and blue are in sRGB, or not read at all. Alpha is always linear.
    #[must_use]
    pub fn is_srgb(self) -> bool {
        matches!(
            self,
            Self::BaseColor
                | Self::Emissive
                | Self::Specular
                | Self::SpecularColor
                | Self::SheenColor
                | Self::SheenRoughness
                | Self::DiffuseTransmission
                | Self::DiffuseTransmissionColor
                | Self::SpecularGlossiness
        )
    }
}

impl Material {
    /// Whether surfaces let their background show, so that they are composited in order of depth.
    #[must_use]
    pub fn is_layer(&self) -> bool {
        self.alpha_mode == AlphaMode::Blend || (self.lobes.transmission.is_some() && !self.unlit)
    }

    /// Whether the material has a thickness that light passes through.
    #[must_use]
    pub fn has_volume(&self) -> bool {
        let lobe = self.lobes.transmission;
        lobe.is_some_and(|lobe| lobe.thickness > 0.0 || self.animated)
    }

    /// Index of the UV set that tangents follow, if the surface needs tangents.
    #[must_use]
    pub fn tangent_uv_set(&self) -> Option<u32> {
        let coat = self.lobes.clearcoat.and_then(|coat| coat.normal_texture);
        let normal = self.normal_texture.or(coat);
        let lobe = self.lobes.anisotropy;
        let drawn_out = lobe.map(|lobe| lobe.texture.map_or(0, |used| used.uv_set));
        normal.map(|used| used.uv_set).or(drawn_out)
    }

    /// Textures that the material uses, with their roles.
    pub fn textures(&self) -> impl Iterator<Item = (TextureRole, TextureUse)> + use<> {
        let mut copy = self.clone();
        let used: Vec<_> = copy.texture_slots().into_iter().filter_map(|(role, slot)| Some((role, (*slot)?))).collect();
        used.into_iter()
    }

    /// Places for all textures of the material, used or not, in the order of roles.
    pub(super) fn texture_slots(&mut self) -> Vec<(TextureRole, &mut Option<TextureUse>)> {
        use TextureRole as Role;
        let mut slots = vec![
            (Role::BaseColor, &mut self.base_color_texture),
            (Role::MetallicRoughness, &mut self.metallic_roughness_texture),
            (Role::Normal, &mut self.normal_texture),
            (Role::Occlusion, &mut self.occlusion_texture),
            (Role::Emissive, &mut self.emissive_texture),
        ];
        let lobes = &mut self.lobes;
        if let Some(lobe) = &mut lobes.specular {
            slots.push((Role::Specular, &mut lobe.texture));
            slots.push((Role::SpecularColor, &mut lobe.color_texture));
        }
        if let Some(lobe) = &mut lobes.clearcoat {
            slots.push((Role::Clearcoat, &mut lobe.texture));
            slots.push((Role::ClearcoatRoughness, &mut lobe.roughness_texture));
            slots.push((Role::ClearcoatNormal, &mut lobe.normal_texture));
        }
        if let Some(lobe) = &mut lobes.sheen {
            slots.push((Role::SheenColor, &mut lobe.color_texture));
            slots.push((Role::SheenRoughness, &mut lobe.roughness_texture));
        }
        if let Some(lobe) = &mut lobes.anisotropy {
            slots.push((Role::Anisotropy, &mut lobe.texture));
        }
        if let Some(lobe) = &mut lobes.iridescence {
            slots.push((Role::Iridescence, &mut lobe.texture));
            slots.push((Role::IridescenceThickness, &mut lobe.thickness_texture));
        }
        if let Some(lobe) = &mut lobes.diffuse_transmission {
            slots.push((Role::DiffuseTransmission, &mut lobe.texture));
            slots.push((Role::DiffuseTransmissionColor, &mut lobe.color_texture));
        }
        if let Some(lobe) = &mut lobes.transmission {
            slots.push((Role::Transmission, &mut lobe.texture));
            slots.push((Role::Thickness, &mut lobe.thickness_texture));
        }
        if let Some(lobe) = &mut lobes.specular_glossiness {
            slots.push((Role::SpecularGlossiness, &mut lobe.texture));
        }
        slots
    }
}

/// State of a glTF sampler; the default is linear, trilinear and repeating.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampler {
    /// Filter for texels larger than a pixel.
    pub mag: Filter,
    /// Filter within a mipmap level.
    pub min: Filter,
    /// Filter between mipmap levels; `None` reads only the full image.
    pub mip: Option<Filter>,
    /// Wrapping along u.
    pub wrap_u: Wrap,
    /// Wrapping along v.
    pub wrap_v: Wrap,
}

impl Default for Sampler {
    fn default() -> Self {
        Self {
            mag: Filter::Linear,
            min: Filter::Linear,
            mip: Some(Filter::Linear),
            wrap_u: Wrap::Repeat,
            wrap_v: Wrap::Repeat,
        }
    }
}

/// Image seen through a sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Texture {
    /// Index into [`crate::scene::Scene::images`].
    pub image: u32,
    /// State of the sampler.
    pub sampler: Sampler,
}

/// Decoded image: rows from the top, RGBA, 8 bits a channel, as stored (no colour conversion).
#[derive(Clone, PartialEq, Eq)]
pub struct Image {
    /// Width in texels, at least 1.
    pub width: u32,
    /// Height in texels, at least 1.
    pub height: u32,
    /// Texels, `4 * width * height` bytes. If the file holds mipmaps, all levels down to a single texel follow, each
    /// half as wide and high as the one before, rounded down.
    pub pixels: Vec<u8>,
}

impl Image {
    /// Number of levels down to a single texel.
    #[must_use]
    pub fn full_levels(&self) -> u32 {
        self.width.max(self.height).max(1).ilog2() + 1
    }

    /// Width and height of a level.
    #[must_use]
    pub fn level_size(&self, level: u32) -> [u32; 2] {
        [self.width, self.height].map(|side| (side >> level).max(1))
    }

    /// Levels that the image holds: one, or all.
    pub fn levels(&self) -> impl Iterator<Item = &[u8]> {
        let mut rest = &self.pixels[..];
        (0..self.full_levels()).map_while(move |level| {
            let [width, height] = self.level_size(level);
            let (first, others) = rest.split_at_checked(4 * width as usize * height as usize)?;
            rest = others;
            Some(first)
        })
    }
}

impl std::fmt::Debug for Image {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Image({} x {})", self.width, self.height)
    }
}
