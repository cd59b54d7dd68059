//! Materials (glTF 2.0, section 3.9) with `KHR_materials_unlit`, `KHR_materials_emissive_strength`
//! and `KHR_texture_transform`.

use super::{Context, json::Item};
use crate::scene::{
    error::Fault,
    material::{AlphaMode, Material, TextureTransform, TextureUse},
};

/// Reads all materials, glTF's default appended. Their textures are the file's: see
/// [`texture::resolve`](super::texture::resolve).
pub fn read_all(context: &mut Context<'_>) -> Result<Vec<Material>, Fault> {
    let textures = context.root.objects("textures")?.len();
    let mut materials = Vec::new();
    for item in context.root.objects("materials")? {
        let material = read(&item, context, textures).map(Some);
        materials.push(
            context
                .tolerate(material, "the material takes the defaults")
                .unwrap_or_default(),
        );
    }
    materials.push(Material::default());
    Ok(materials)
}

fn read(item: &Item<'_>, context: &mut Context<'_>, textures: usize) -> Result<Material, Fault> {
    let mut material = Material {
        name: item.name(),
        double_sided: item.flag("doubleSided")?,
        unlit: item.extension("KHR_materials_unlit").is_some(),
        ..Material::default()
    };
    let mut texture = |item: Option<Item<'_>>| {
        let used = read_texture_use(&item?, textures);
        context.tolerate(used.map(Some), "the texture is left out")
    };
    if let Some(pbr) = item.get("pbrMetallicRoughness") {
        if let Some(color) = pbr.numbers::<4>("baseColorFactor")? {
            material.base_color = color.map(|x| x.clamp(0.0, 1.0) as f32);
        }
        material.metallic = pbr.f32_or("metallicFactor", 1.0)?.clamp(0.0, 1.0);
        material.roughness = pbr.f32_or("roughnessFactor", 1.0)?.clamp(0.0, 1.0);
        material.base_color_texture = texture(pbr.get("baseColorTexture"));
        material.metallic_roughness_texture = texture(pbr.get("metallicRoughnessTexture"));
    }
    if let Some(info) = item.get("normalTexture") {
        material.normal_scale = info.f32_or("scale", 1.0)?;
        material.normal_texture = texture(Some(info));
    }
    if let Some(info) = item.get("occlusionTexture") {
        material.occlusion_strength = info.f32_or("strength", 1.0)?.clamp(0.0, 1.0);
        material.occlusion_texture = texture(Some(info));
    }
    material.emissive_texture = texture(item.get("emissiveTexture"));
    let emissive = item.numbers::<3>("emissiveFactor")?.unwrap_or_default();
    let strength = match item.extension("KHR_materials_emissive_strength") {
        Some(extension) => extension.f32_or("emissiveStrength", 1.0)?.max(0.0),
        None => 1.0,
    };
    // The factor is at most 1, so that a finite strength leaves the product finite.
    material.emissive = emissive.map(|x| x.clamp(0.0, 1.0) as f32 * strength);
    material.alpha_mode = match item.text("alphaMode")? {
        None | Some("OPAQUE") => AlphaMode::Opaque,
        Some("MASK") => AlphaMode::Mask {
            cutoff: item.f32_or("alphaCutoff", 0.5)?.max(0.0),
        },
        Some("BLEND") => AlphaMode::Blend,
        Some(other) => return Err(item.fault(format!("\"{other}\" is no alpha mode"))),
    };
    Ok(material)
}

fn read_texture_use(item: &Item<'_>, textures: usize) -> Result<TextureUse, Fault> {
    let texture = item.require("index")?.as_index("textures", textures)?;
    let mut uv_set = item.usize_or("texCoord", 0)?;
    let mut transform = TextureTransform::default();
    if let Some(extension) = item.extension("KHR_texture_transform") {
        uv_set = extension.usize_or("texCoord", uv_set)?;
        transform = read_transform(&extension)?;
    }
    if uv_set > 1 {
        return Err(item.fault(format!(
            "uses TEXCOORD_{uv_set}, but only the UV sets 0 and 1 are supported"
        )));
    }
    Ok(TextureUse {
        texture: texture as u32,
        uv_set: uv_set as u32,
        transform,
    })
}

/// Translation times rotation times scale; the rotation is counter-clockwise in an image whose v
/// points down.
fn read_transform(extension: &Item<'_>) -> Result<TextureTransform, Fault> {
    let [x, y] = extension.numbers("offset")?.unwrap_or([0.0, 0.0]);
    let [w, h] = extension.numbers("scale")?.unwrap_or([1.0, 1.0]);
    let (sin, cos) = extension.f64_or("rotation", 0.0)?.sin_cos();
    let rows = [[cos * w, sin * h, x], [-sin * w, cos * h, y]].map(|row| row.map(|x| x as f32));
    if rows.as_flattened().iter().all(|x| x.is_finite()) {
        Ok(TextureTransform(rows))
    } else {
        Err(extension.fault("the transform is not within single precision"))
    }
}
