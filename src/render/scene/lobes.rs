//! Reflection and transmission lobes that material extensions add to glTF's metallic-roughness base.

use super::material::TextureUse;

/// Reflection of a dielectric: `KHR_materials_ior` and `KHR_materials_specular`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Specular {
    /// Reflectance at normal incidence that follows from the index of refraction, 0 to 1; 0.04 for glTF's 1.5.
    pub reflectance: f32,
    /// Strength of the reflection, 0 to 1.
    pub factor: f32,
    /// Linear RGB, at least 0, that multiplies the reflectance; the product is clamped to 1.
    pub color: [f32; 3],
    /// Texture of the strength, in alpha.
    pub texture: Option<TextureUse>,
    /// Texture of the colour, sRGB.
    pub color_texture: Option<TextureUse>,
}

/// Clear coat: `KHR_materials_clearcoat`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearcoat {
    /// Share of the surface that is coated, 0 to 1.
    pub factor: f32,
    /// Perceptual roughness of the coat, 0 to 1.
    pub roughness: f32,
    /// Factor for the x and y of the coat's normal texture.
    pub normal_scale: f32,
    /// Texture of the factor, in red.
    pub texture: Option<TextureUse>,
    /// Texture of the roughness, in green.
    pub roughness_texture: Option<TextureUse>,
    /// Tangent-space normals of the coat; without a texture, the coat has the normals of the mesh.
    pub normal_texture: Option<TextureUse>,
}

/// Sheen of fibres at grazing angles: `KHR_materials_sheen`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheen {
    /// Linear RGB of the sheen, 0 to 1.
    pub color: [f32; 3],
    /// Perceptual roughness of the sheen, 0 to 1.
    pub roughness: f32,
    /// Texture of the colour, sRGB.
    pub color_texture: Option<TextureUse>,
    /// Texture of the roughness, in alpha.
    pub roughness_texture: Option<TextureUse>,
}

/// Anisotropy, which stretches reflections along a direction: `KHR_materials_anisotropy`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anisotropy {
    /// Strength from 0 (isotropic) to 1.
    pub strength: f32,
    /// Angle of the direction from the tangent, in radians, counter-clockwise.
    pub rotation: f32,
    /// Texture of the direction in red and green, from -1 to 1, and of the strength in blue.
    pub texture: Option<TextureUse>,
}

/// Iridescence by interference in a thin film: `KHR_materials_iridescence`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iridescence {
    /// Share of the surface that has the film, 0 to 1.
    pub factor: f32,
    /// Index of refraction of the film, at least 1.
    pub ior: f32,
    /// Thickness of the film in nanometres where the thickness texture is 0 and where it is 1; the second one holds
    /// without a texture.
    pub thickness: [f32; 2],
    /// Texture of the factor, in red.
    pub texture: Option<TextureUse>,
    /// Texture of the thickness, in green.
    pub thickness_texture: Option<TextureUse>,
}

/// Diffuse transmission, as through a leaf: `KHR_materials_diffuse_transmission`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffuseTransmission {
    /// Share of the diffuse light that passes through, 0 to 1.
    pub factor: f32,
    /// Linear RGB of that light, 0 to 1.
    pub color: [f32; 3],
    /// Texture of the factor, in alpha.
    pub texture: Option<TextureUse>,
    /// Texture of the colour, sRGB.
    pub color_texture: Option<TextureUse>,
}

/// Transmission through a transparent surface: `KHR_materials_transmission` and `KHR_materials_volume`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transmission {
    /// Share of the light, after reflection, that passes through and is tinted by the base colour, 0 to 1.
    pub factor: f32,
    /// Texture of the factor, in red.
    pub texture: Option<TextureUse>,
    /// Thickness of the volume behind the surface, in units of the mesh; 0 for a thin wall.
    pub thickness: f32,
    /// Texture of the thickness, in green.
    pub thickness_texture: Option<TextureUse>,
    /// Absorption of RGB per unit of length: light is reduced by `exp(-absorption * length)`.
    pub absorption: [f32; 3],
}

/// Specular-glossiness base instead of metalness and roughness (`KHR_materials_pbrSpecularGlossiness`). The base
/// colour is the diffuse colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpecularGlossiness {
    /// Linear RGB of the reflectance at normal incidence, 0 to 1.
    pub specular: [f32; 3],
    /// Glossiness, 1 - perceptual roughness, 0 to 1.
    pub glossiness: f32,
    /// Texture of the specular colour in sRGB, and of the glossiness in alpha.
    pub texture: Option<TextureUse>,
}

/// Lobes of a material; those without an effect are absent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(missing_docs)]
pub struct Lobes {
    pub specular: Option<Specular>,
    pub clearcoat: Option<Clearcoat>,
    pub sheen: Option<Sheen>,
    pub anisotropy: Option<Anisotropy>,
    pub iridescence: Option<Iridescence>,
    pub diffuse_transmission: Option<DiffuseTransmission>,
    pub transmission: Option<Transmission>,
    pub specular_glossiness: Option<SpecularGlossiness>,
}
