//! Lobes that material extensions add to the metallic-roughness base, layers over it, and light through it.

use super::material::TextureUse;

/// The reflection of a dielectric: `KHR_materials_ior` and `KHR_materials_specular`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Specular {
    /// Reflectance at normal incidence by the index of refraction alone, 0 to 1; 0.04 for glTF's 1.5.
    pub reflectance: f32,
    /// Strength of the reflection, 0 to 1.
    pub factor: f32,
    /// Linear RGB, at least 0; multiplies the reflectance, which ends at 1.
    pub color: [f32; 3],
    /// Strength in alpha.
    pub texture: Option<TextureUse>,
    /// Texture of the colour, sRGB.
    pub color_texture: Option<TextureUse>,
}

/// A coat of varnish: `KHR_materials_clearcoat`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearcoat {
    /// Share of the surface that is coated, 0 to 1.
    pub factor: f32,
    /// Perceptual roughness of the coat, 0 to 1.
    pub roughness: f32,
    /// Multiplies the x and y of the coat's normal texture.
    pub normal_scale: f32,
    /// The factor's, in red.
    pub texture: Option<TextureUse>,
    /// Texture of the roughness, in green.
    pub roughness_texture: Option<TextureUse>,
    /// Tangent-space normals of the coat, which otherwise has those of the mesh.
    pub normal_texture: Option<TextureUse>,
}

/// Fibres that reflect at grazing angles: `KHR_materials_sheen`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheen {
    /// Linear RGB, 0 to 1.
    pub color: [f32; 3],
    /// Perceptual roughness of the sheen, 0 to 1.
    pub roughness: f32,
    /// Texture of the colour, sRGB.
    pub color_texture: Option<TextureUse>,
    /// Texture of the roughness, in alpha.
    pub roughness_texture: Option<TextureUse>,
}

/// Reflections drawn out along a direction: `KHR_materials_anisotropy`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anisotropy {
    /// 0 isotropic to 1.
    pub strength: f32,
    /// Angle of the direction from the tangent, in radians, counter-clockwise.
    pub rotation: f32,
    /// The direction in red and green, from -1 to 1, and the strength in blue.
    pub texture: Option<TextureUse>,
}

/// Interference in a thin film: `KHR_materials_iridescence`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iridescence {
    /// Share of the surface that has the film, 0 to 1.
    pub factor: f32,
    /// Index of refraction of the film, at least 1.
    pub ior: f32,
    /// Thickness in nanometres where the thickness texture is 0 and where it is 1, or absent.
    pub thickness: [f32; 2],
    /// The factor's, in red.
    pub texture: Option<TextureUse>,
    /// Texture of the thickness, in green.
    pub thickness_texture: Option<TextureUse>,
}

/// Light that leaves the other side of a leaf: `KHR_materials_diffuse_transmission`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffuseTransmission {
    /// Share of the diffuse light that passes through, 0 to 1.
    pub factor: f32,
    /// Linear RGB of that light, 0 to 1.
    pub color: [f32; 3],
    /// The factor's, in alpha.
    pub texture: Option<TextureUse>,
    /// Texture of the colour, sRGB.
    pub color_texture: Option<TextureUse>,
}

/// A surface that is seen through: `KHR_materials_transmission` and `KHR_materials_volume`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transmission {
    /// Share of the light that is not reflected and passes, tinted by the base colour, 0 to 1.
    pub factor: f32,
    /// The factor's, in red.
    pub texture: Option<TextureUse>,
    /// Thickness of the volume behind the surface, in units of the mesh; 0 for a thin wall.
    pub thickness: f32,
    /// Texture of the thickness, in green.
    pub thickness_texture: Option<TextureUse>,
    /// Absorption of RGB per unit of length: light is reduced by `exp(-absorption * length)`.
    pub absorption: [f32; 3],
}

/// Base by specular colour and glossiness instead of metalness and roughness (`KHR_materials_pbrSpecularGlossiness`).
/// The base colour is the diffuse one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpecularGlossiness {
    /// Linear RGB reflected at normal incidence, 0 to 1.
    pub specular: [f32; 3],
    /// 1 less perceptual roughness, 0 to 1.
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
