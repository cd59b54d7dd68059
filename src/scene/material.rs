//! Metallic-roughness materials, textures and images (glTF 2.0, section 3.9 and 3.8).

pub use gltf::json::texture::{MagFilter as Filter, WrappingMode as Wrap};

/// glTF's alpha modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaMode {
    /// Alpha is ignored.
    Opaque,
    /// Covered where alpha is at least the cutoff.
    Mask {
        /// The cutoff, usually within 0 to 1.
        cutoff: f32,
    },
    /// Composited over what lies behind.
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

/// A material's use of a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureUse {
    /// Index into [`crate::scene::Scene::textures`].
    pub texture: u32,
    /// Which UV set, 0 or 1.
    pub uv_set: u32,
    /// Transform applied to the coordinates.
    pub transform: TextureTransform,
}

/// A material; the defaults are glTF's.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name in the file, where it has one.
    pub name: Option<String>,
    /// Linear RGB and straight alpha.
    pub base_color: [f32; 4],
    /// 0 dielectric to 1 metal.
    pub metallic: f32,
    /// Perceptual roughness, 0 to 1.
    pub roughness: f32,
    /// Linear emitted radiance, `KHR_materials_emissive_strength` multiplied in.
    pub emissive: [f32; 3],
    /// Multiplies the x and y of the normal texture.
    pub normal_scale: f32,
    /// 0 ignores the occlusion texture, 1 applies it fully.
    pub occlusion_strength: f32,
    /// How alpha is used.
    pub alpha_mode: AlphaMode,
    /// Draw back faces too.
    pub double_sided: bool,
    /// `KHR_materials_unlit`: the base colour is the result.
    pub unlit: bool,
    /// sRGB colour and linear alpha.
    pub base_color_texture: Option<TextureUse>,
    /// Roughness in green, metalness in blue, linear.
    pub metallic_roughness_texture: Option<TextureUse>,
    /// Tangent-space normals, linear.
    pub normal_texture: Option<TextureUse>,
    /// Occlusion in red, linear.
    pub occlusion_texture: Option<TextureUse>,
    /// sRGB colour.
    pub emissive_texture: Option<TextureUse>,
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
            unlit: false,
            base_color_texture: None,
            metallic_roughness_texture: None,
            normal_texture: None,
            occlusion_texture: None,
            emissive_texture: None,
        }
    }
}

impl Material {
    /// The textures that the material uses, in the order of its fields.
    pub fn textures(&self) -> impl Iterator<Item = TextureUse> + use<> {
        [
            self.base_color_texture,
            self.metallic_roughness_texture,
            self.normal_texture,
            self.occlusion_texture,
            self.emissive_texture,
        ]
        .into_iter()
        .flatten()
    }

    /// The same for change.
    pub(super) fn texture_slots(&mut self) -> [&mut Option<TextureUse>; 5] {
        [
            &mut self.base_color_texture,
            &mut self.metallic_roughness_texture,
            &mut self.normal_texture,
            &mut self.occlusion_texture,
            &mut self.emissive_texture,
        ]
    }
}

/// glTF sampler state; the default is linear, trilinear and repeating.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampler {
    /// Filter where a texel covers more than a pixel.
    pub mag: Filter,
    /// Filter within a mipmap level.
    pub min: Filter,
    /// Filter between mipmap levels; `None` uses the full image alone.
    pub mip: Option<Filter>,
    /// Along u.
    pub wrap_u: Wrap,
    /// Along v.
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

/// An image seen through a sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Texture {
    /// Index into [`crate::scene::Scene::images`].
    pub image: u32,
    /// How it is read.
    pub sampler: Sampler,
}

/// A decoded image: rows from the top, RGBA, 8 bits a channel, as stored (no colour conversion).
#[derive(Clone, PartialEq, Eq)]
pub struct Image {
    /// Width in texels, at least 1.
    pub width: u32,
    /// Height in texels, at least 1.
    pub height: u32,
    /// `4 * width * height` bytes.
    pub pixels: Vec<u8>,
}

impl std::fmt::Debug for Image {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Image({} x {})", self.width, self.height)
    }
}
