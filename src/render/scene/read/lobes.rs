//! Material extensions that add lobes to the base (`KHR_materials_*`).

use gltf::json::{extensions::material, material::NormalTexture, texture::Info};
use serde::Deserialize;

use super::{
    Context,
    material::{normal_info, read_texture_use},
    model,
};
use crate::scene::{
    error::Fault,
    lobes::{
        Anisotropy, Clearcoat, DiffuseTransmission, Iridescence, Lobes, Sheen, Specular, SpecularGlossiness,
        Transmission,
    },
    material::TextureUse,
};

/// Extension object of `KHR_materials_clearcoat`.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct ClearcoatObject {
    clearcoat_factor: f32,
    clearcoat_texture: Option<Info>,
    clearcoat_roughness_factor: f32,
    clearcoat_roughness_texture: Option<Info>,
    clearcoat_normal_texture: Option<NormalTexture>,
}

/// Extension object of `KHR_materials_sheen`.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct SheenObject {
    sheen_color_factor: [f32; 3],
    sheen_color_texture: Option<Info>,
    sheen_roughness_factor: f32,
    sheen_roughness_texture: Option<Info>,
}

/// Extension object of `KHR_materials_anisotropy`.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct AnisotropyObject {
    anisotropy_strength: f32,
    anisotropy_rotation: f32,
    anisotropy_texture: Option<Info>,
}

/// Extension object of `KHR_materials_iridescence`.
#[derive(Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct IridescenceObject {
    iridescence_factor: f32,
    iridescence_texture: Option<Info>,
    iridescence_ior: f32,
    iridescence_thickness_minimum: f32,
    iridescence_thickness_maximum: f32,
    iridescence_thickness_texture: Option<Info>,
}

impl Default for IridescenceObject {
    fn default() -> Self {
        Self {
            iridescence_factor: 0.0,
            iridescence_texture: None,
            iridescence_ior: 1.3,
            iridescence_thickness_minimum: 100.0,
            iridescence_thickness_maximum: 400.0,
            iridescence_thickness_texture: None,
        }
    }
}

/// Extension object of `KHR_materials_diffuse_transmission`.
#[derive(Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct DiffuseTransmissionObject {
    diffuse_transmission_factor: f32,
    diffuse_transmission_texture: Option<Info>,
    diffuse_transmission_color_factor: [f32; 3],
    diffuse_transmission_color_texture: Option<Info>,
}

impl Default for DiffuseTransmissionObject {
    fn default() -> Self {
        Self {
            diffuse_transmission_factor: 0.0,
            diffuse_transmission_texture: None,
            diffuse_transmission_color_factor: [1.0; 3],
            diffuse_transmission_color_texture: None,
        }
    }
}

/// Reads the lobes of the material at `place`; a broken one is left out with a warning. Lobes without an effect are
/// kept if the material is `animated`.
pub fn read(item: &material::Material, place: &str, animated: bool, context: &mut Context<'_>) -> Lobes {
    let mut reader = LobeReader { item, place, animated, context };
    Lobes {
        specular: reader.specular(),
        clearcoat: reader.clearcoat(),
        sheen: reader.sheen(),
        anisotropy: reader.anisotropy(),
        iridescence: reader.iridescence(),
        diffuse_transmission: reader.diffuse_transmission(),
        transmission: reader.transmission(),
        specular_glossiness: reader.specular_glossiness(),
    }
}

fn unit(x: f32) -> f32 {
    x.clamp(0.0, 1.0)
}

struct LobeReader<'a, 'c, 'm> {
    item: &'a material::Material,
    place: &'a str,
    animated: bool,
    context: &'c mut Context<'m>,
}

impl LobeReader<'_, '_, '_> {
    /// Reads an extension for which `gltf` has no type.
    fn other<T: serde::de::DeserializeOwned>(&mut self, name: &str) -> Option<T> {
        let found = model::extension(Some(&self.item.others), name, self.place);
        let found = found.map(|found| found.map(|(object, _)| object));
        self.context.tolerate(found, "it is left out")
    }

    /// Reads the texture `member` of the extension `name`.
    fn texture(&mut self, info: Option<Info>, name: &str, member: &str) -> Option<TextureUse> {
        let place = format!("{}/extensions/{name}/{member}", self.place);
        let used = read_texture_use(&info?, &place, self.context);
        self.context.tolerate(used.map(Some), "the texture is left out")
    }

    fn specular(&mut self) -> Option<Specular> {
        const NAME: &str = "KHR_materials_specular";
        if self.item.ior.is_none() && self.item.specular.is_none() {
            return None;
        }
        let ior = self.item.ior.clone().unwrap_or_default().ior.0;
        let ior = if ior == 0.0 || ior >= 1.0 {
            ior
        } else {
            let place = format!("{}/extensions/KHR_materials_ior/ior", self.place);
            let reason = format!("{ior} is neither 0 nor at least 1; 1.5 is taken");
            self.context.warn(&Fault::new(place, reason));
            1.5
        };
        let lobe = self.item.specular.clone().unwrap_or_default();
        Some(Specular {
            reflectance: ((ior - 1.0) / (ior + 1.0)).powi(2),
            factor: unit(lobe.specular_factor.0),
            color: lobe.specular_color_factor.0.map(|x| x.max(0.0)),
            texture: self.texture(lobe.specular_texture, NAME, "specularTexture"),
            color_texture: self.texture(lobe.specular_color_texture, NAME, "specularColorTexture"),
        })
    }

    fn clearcoat(&mut self) -> Option<Clearcoat> {
        const NAME: &str = "KHR_materials_clearcoat";
        let lobe: ClearcoatObject = self.other(NAME)?;
        let factor = unit(lobe.clearcoat_factor);
        let normal = lobe.clearcoat_normal_texture;
        (self.animated || factor > 0.0).then(|| Clearcoat {
            factor,
            roughness: unit(lobe.clearcoat_roughness_factor),
            normal_scale: normal.as_ref().map_or(1.0, |normal| normal.scale),
            texture: self.texture(lobe.clearcoat_texture, NAME, "clearcoatTexture"),
            roughness_texture: self.texture(lobe.clearcoat_roughness_texture, NAME, "clearcoatRoughnessTexture"),
            normal_texture: self.texture(normal.as_ref().map(normal_info), NAME, "clearcoatNormalTexture"),
        })
    }

    fn sheen(&mut self) -> Option<Sheen> {
        const NAME: &str = "KHR_materials_sheen";
        let lobe: SheenObject = self.other(NAME)?;
        let color = lobe.sheen_color_factor.map(unit);
        (self.animated || color != [0.0; 3]).then(|| Sheen {
            color,
            roughness: unit(lobe.sheen_roughness_factor),
            color_texture: self.texture(lobe.sheen_color_texture, NAME, "sheenColorTexture"),
            roughness_texture: self.texture(lobe.sheen_roughness_texture, NAME, "sheenRoughnessTexture"),
        })
    }

    fn anisotropy(&mut self) -> Option<Anisotropy> {
        const NAME: &str = "KHR_materials_anisotropy";
        let lobe: AnisotropyObject = self.other(NAME)?;
        let strength = unit(lobe.anisotropy_strength);
        (self.animated || strength > 0.0).then(|| Anisotropy {
            strength,
            rotation: lobe.anisotropy_rotation,
            texture: self.texture(lobe.anisotropy_texture, NAME, "anisotropyTexture"),
        })
    }

    fn iridescence(&mut self) -> Option<Iridescence> {
        const NAME: &str = "KHR_materials_iridescence";
        let lobe: IridescenceObject = self.other(NAME)?;
        let factor = unit(lobe.iridescence_factor);
        let thickness = [lobe.iridescence_thickness_minimum, lobe.iridescence_thickness_maximum];
        (self.animated || factor > 0.0).then(|| Iridescence {
            factor,
            ior: lobe.iridescence_ior.max(1.0),
            thickness: thickness.map(|x| x.max(0.0)),
            texture: self.texture(lobe.iridescence_texture, NAME, "iridescenceTexture"),
            thickness_texture: self.texture(lobe.iridescence_thickness_texture, NAME, "iridescenceThicknessTexture"),
        })
    }

    fn diffuse_transmission(&mut self) -> Option<DiffuseTransmission> {
        const NAME: &str = "KHR_materials_diffuse_transmission";
        let lobe: DiffuseTransmissionObject = self.other(NAME)?;
        let factor = unit(lobe.diffuse_transmission_factor);
        (self.animated || factor > 0.0).then(|| DiffuseTransmission {
            factor,
            color: lobe.diffuse_transmission_color_factor.map(unit),
            texture: self.texture(lobe.diffuse_transmission_texture, NAME, "diffuseTransmissionTexture"),
            color_texture: self.texture(
                lobe.diffuse_transmission_color_texture,
                NAME,
                "diffuseTransmissionColorTexture",
            ),
        })
    }

    fn transmission(&mut self) -> Option<Transmission> {
        const NAME: &str = "KHR_materials_transmission";
        const VOLUME: &str = "KHR_materials_volume";
        let lobe = self.item.transmission.clone()?;
        let factor = unit(lobe.transmission_factor.0);
        let volume = self.item.volume.clone().unwrap_or_default();
        let distance = volume.attenuation_distance.0;
        let absorption = |color: f32| {
            // Black would have an infinite absorption, and that times a thickness of 0 is NaN.
            const DARKEST: f32 = 1e-6;
            if distance > 0.0 { -unit(color).max(DARKEST).ln() / distance } else { 0.0 }
        };
        (self.animated || factor > 0.0).then(|| Transmission {
            factor,
            texture: self.texture(lobe.transmission_texture, NAME, "transmissionTexture"),
            thickness: volume.thickness_factor.0.max(0.0),
            thickness_texture: self.texture(volume.thickness_texture, VOLUME, "thicknessTexture"),
            absorption: volume.attenuation_color.0.map(absorption),
        })
    }

    fn specular_glossiness(&mut self) -> Option<SpecularGlossiness> {
        const NAME: &str = "KHR_materials_pbrSpecularGlossiness";
        let base = self.item.pbr_specular_glossiness.clone()?;
        Some(SpecularGlossiness {
            specular: base.specular_factor.0.map(unit),
            glossiness: unit(base.glossiness_factor.0),
            texture: self.texture(base.specular_glossiness_texture, NAME, "specularGlossinessTexture"),
        })
    }
}
