//! Materials (glTF 2.0, section 3.9) with `KHR_materials_unlit`, `KHR_materials_emissive_strength`,
//! `KHR_texture_transform` and the [lobes] of other extensions.

use gltf::json::{
    self, extensions,
    material::{AlphaCutoff, AlphaMode as Mode, NormalTexture, OcclusionTexture},
    texture::Info,
};
use serde_json::{Map, Value};

use super::{Context, lobes, model, pointer};
use crate::scene::{
    error::Fault,
    material::{AlphaMode, Material, TextureTransform, TextureUse},
};

/// Reads all materials, and appends glTF's default material. Their textures are indices into the file's: see
/// [`texture::resolve`](super::texture::resolve).
pub fn read_all(context: &mut Context<'_>) -> Vec<Material> {
    let animated = pointer::animated_materials(context.model);
    let mut materials = Vec::new();
    for (index, found) in context.model.all().enumerate() {
        let animated = animated.contains(&index);
        let read = found.and_then(|(item, place)| read(item, &place, animated, context).map(Some));
        let material = context.tolerate(read, "the material takes the defaults");
        materials.push(material.unwrap_or_default());
    }
    materials.push(Material::default());
    materials
}

/// Reads the material at `place`; one that is `animated` keeps lobes that have no effect at present.
pub fn read(item: &json::Material, place: &str, animated: bool, context: &mut Context<'_>) -> Result<Material, Fault> {
    let pbr = &item.pbr_metallic_roughness;
    let unit = |x: f32| x.clamp(0.0, 1.0);
    let mut texture = |info: Option<Info>, name: &str| {
        let used = read_texture_use(&info?, &format!("{place}/{name}"), context);
        context.tolerate(used.map(Some), "the texture is left out")
    };
    let mut material = Material {
        name: item.name.clone(),
        animated,
        double_sided: item.double_sided,
        base_color: pbr.base_color_factor.0.map(unit),
        metallic: unit(pbr.metallic_factor.0),
        roughness: unit(pbr.roughness_factor.0),
        base_color_texture: texture(pbr.base_color_texture.clone(), "pbrMetallicRoughness/baseColorTexture"),
        metallic_roughness_texture: texture(
            pbr.metallic_roughness_texture.clone(),
            "pbrMetallicRoughness/metallicRoughnessTexture",
        ),
        emissive_texture: texture(item.emissive_texture.clone(), "emissiveTexture"),
        ..Material::default()
    };
    if let Some(normal) = &item.normal_texture {
        material.normal_texture = texture(Some(normal_info(normal)), "normalTexture");
        material.normal_scale = normal.scale;
        if !normal.scale.is_finite() {
            let place = format!("{place}/normalTexture/scale");
            return Err(Fault::new(place, "is not within single precision"));
        }
    }
    if let Some(occlusion) = &item.occlusion_texture {
        material.occlusion_texture = texture(Some(occlusion_info(occlusion)), "occlusionTexture");
        material.occlusion_strength = unit(occlusion.strength.0);
    }
    let mut strength = 1.0;
    if let Some(extensions) = &item.extensions {
        material.unlit = extensions.unlit.is_some();
        if let Some(old) = &extensions.pbr_specular_glossiness {
            let place = "extensions/KHR_materials_pbrSpecularGlossiness/diffuseTexture";
            material.base_color = old.diffuse_factor.0.map(unit);
            material.base_color_texture = texture(old.diffuse_texture.clone(), place);
            material.metallic_roughness_texture = None;
        }
        if let Some(extension) = &extensions.emissive_strength {
            strength = extension.emissive_strength.0.max(0.0);
        }
        material.lobes = lobes::read(extensions, place, animated, context);
    }
    // The product is finite, because the factor is at most 1.
    material.emissive = item.emissive_factor.0.map(|x| unit(x) * strength);
    let mode = context.model.valid(&item.alpha_mode, &format!("{place}/alphaMode"))?;
    material.alpha_mode = match mode {
        Mode::Opaque => AlphaMode::Opaque,
        Mode::Mask => AlphaMode::Mask { cutoff: item.alpha_cutoff.unwrap_or(AlphaCutoff(0.5)).0.max(0.0) },
        Mode::Blend => AlphaMode::Blend,
    };
    Ok(material)
}

/// A normal texture in `gltf`'s type for other textures.
pub fn normal_info(texture: &NormalTexture) -> Info {
    Info {
        index: texture.index,
        tex_coord: texture.tex_coord,
        extensions: texture.extensions.as_ref().map(|e| with_transform(&e.others)),
        extras: None,
    }
}

/// An occlusion texture in `gltf`'s type for other textures.
fn occlusion_info(texture: &OcclusionTexture) -> Info {
    Info {
        index: texture.index,
        tex_coord: texture.tex_coord,
        extensions: texture.extensions.as_ref().map(|e| with_transform(&e.others)),
        extras: None,
    }
}

/// Texture extensions from their JSON, for textures whose extensions `gltf` does not parse.
fn with_transform(others: &Map<String, Value>) -> extensions::texture::Info {
    extensions::texture::Info { texture_transform: None, others: others.clone() }
}

/// Reads a material's reference to a texture; `place` is the material's.
pub fn read_texture_use(item: &Info, place: &str, context: &Context<'_>) -> Result<TextureUse, Fault> {
    context.model.check(&item.index, &format!("{place}/index"))?;
    let mut used = TextureUse {
        texture: item.index.value() as u32,
        uv_set: item.tex_coord,
        transform: TextureTransform::default(),
    };
    if let Some(extensions) = &item.extensions {
        let other = model::extension(Some(&extensions.others), "KHR_texture_transform", place)?;
        let other = other.map(|(transform, _)| transform);
        if let Some(given) = extensions.texture_transform.clone().or(other) {
            used.uv_set = given.tex_coord.unwrap_or(used.uv_set);
            used.transform = transform(&given).ok_or_else(|| {
                let place = format!("{place}/extensions/KHR_texture_transform");
                Fault::new(place, "the transform is not within single precision")
            })?;
        }
    }
    if used.uv_set > 1 {
        let reason = format!("uses TEXCOORD_{}, but only the UV sets 0 and 1 are supported", used.uv_set);
        return Err(Fault::new(place, reason));
    }
    Ok(used)
}

/// Matrix: translation * rotation * scale. The rotation is counter-clockwise in an image whose v points down.
fn transform(given: &extensions::texture::TextureTransform) -> Option<TextureTransform> {
    let ([x, y], [w, h]) = (given.offset.0, given.scale.0);
    let (sin, cos) = given.rotation.0.sin_cos();
    let rows = [[cos * w, sin * h, x], [-sin * w, cos * h, y]];
    let finite = rows.as_flattened().iter().all(|x| x.is_finite());
    finite.then_some(TextureTransform(rows))
}
