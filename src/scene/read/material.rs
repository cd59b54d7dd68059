//! Materials (glTF 2.0, section 3.9) with `KHR_materials_unlit`, `KHR_materials_emissive_strength`,
//! `KHR_texture_transform` and, converted, `KHR_materials_pbrSpecularGlossiness`.

use gltf::json::{
    self, Index, extensions,
    material::{AlphaCutoff, AlphaMode as Mode},
    texture::Info,
};

use serde_json::{Map, Value};

use super::{Context, model};
use crate::scene::{
    error::Fault,
    material::{AlphaMode, Material, TextureTransform, TextureUse},
};

/// Reads all materials, glTF's default appended. Their textures are the file's: see
/// [`texture::resolve`](super::texture::resolve).
pub fn read_all(context: &mut Context<'_>) -> Vec<Material> {
    let mut materials = Vec::new();
    for found in context.model.all() {
        let read = found.and_then(|(item, place)| read(item, &place, context).map(Some));
        let material = context.tolerate(read, "the material takes the defaults");
        materials.push(material.unwrap_or_default());
    }
    materials.push(Material::default());
    materials
}

fn read(item: &json::Material, place: &str, context: &mut Context<'_>) -> Result<Material, Fault> {
    let pbr = &item.pbr_metallic_roughness;
    let unit = |x: f32| x.clamp(0.0, 1.0);
    let mut texture = |info: Option<Info>, name: &str| {
        let used = read_texture_use(&info?, &format!("{place}/{name}"), context);
        context.tolerate(used.map(Some), "the texture is left out")
    };
    let mut material = Material {
        name: item.name.clone(),
        double_sided: item.double_sided,
        base_color: pbr.base_color_factor.0.map(unit),
        metallic: unit(pbr.metallic_factor.0),
        roughness: unit(pbr.roughness_factor.0),
        base_color_texture: texture(
            pbr.base_color_texture.clone(),
            "pbrMetallicRoughness/baseColorTexture",
        ),
        metallic_roughness_texture: texture(
            pbr.metallic_roughness_texture.clone(),
            "pbrMetallicRoughness/metallicRoughnessTexture",
        ),
        emissive_texture: texture(item.emissive_texture.clone(), "emissiveTexture"),
        ..Material::default()
    };
    if let Some(normal) = &item.normal_texture {
        let others = normal
            .extensions
            .as_ref()
            .map(|extensions| &extensions.others);
        let info = with_transform(normal.index, normal.tex_coord, others);
        material.normal_texture = texture(Some(info), "normalTexture");
        material.normal_scale = normal.scale;
        if !normal.scale.is_finite() {
            let place = format!("{place}/normalTexture/scale");
            return Err(Fault::new(place, "is not within single precision"));
        }
    }
    if let Some(occlusion) = &item.occlusion_texture {
        let others = occlusion
            .extensions
            .as_ref()
            .map(|extensions| &extensions.others);
        let info = with_transform(occlusion.index, occlusion.tex_coord, others);
        material.occlusion_texture = texture(Some(info), "occlusionTexture");
        material.occlusion_strength = unit(occlusion.strength.0);
    }
    let (mut strength, mut converted) = (1.0, false);
    if let Some(extensions) = &item.extensions {
        material.unlit = extensions.unlit.is_some();
        if let Some(old) = &extensions.pbr_specular_glossiness {
            let place = "extensions/KHR_materials_pbrSpecularGlossiness/diffuseTexture";
            material.base_color_texture = texture(old.diffuse_texture.clone(), place);
            material.metallic_roughness_texture = None;
            convert(old, &mut material);
            converted = true;
        }
        if let Some(extension) = &extensions.emissive_strength {
            strength = extension.emissive_strength.0.max(0.0);
        }
    }
    if converted {
        let reason = "is approximated: the base colour is the diffuse one, metalness and roughness \
                      follow from the factors, and the specularGlossinessTexture is ignored; convert \
                      it with `gltf-transform metalrough IN OUT` for more";
        let place = format!("{place}/extensions/KHR_materials_pbrSpecularGlossiness");
        context.warn(&Fault::new(place, reason));
    }
    // The factor is at most 1, so that a finite strength leaves the product finite.
    material.emissive = item.emissive_factor.0.map(|x| unit(x) * strength);
    let mode = context
        .model
        .valid(&item.alpha_mode, &format!("{place}/alphaMode"))?;
    material.alpha_mode = match mode {
        Mode::Opaque => AlphaMode::Opaque,
        Mode::Mask => AlphaMode::Mask {
            cutoff: item.alpha_cutoff.unwrap_or(AlphaCutoff(0.5)).0.max(0.0),
        },
        Mode::Blend => AlphaMode::Blend,
    };
    Ok(material)
}

/// Metallic-roughness for a material of `KHR_materials_pbrSpecularGlossiness`, as Khronos' example of
/// a conversion does it for factors. With textures, these say nothing of any one place, and the
/// material is taken for a dielectric.
fn convert(old: &extensions::material::PbrSpecularGlossiness, material: &mut Material) {
    /// Reflectance of a dielectric at normal incidence.
    const DIELECTRIC: f32 = 0.04;
    const LEAST: f32 = 1e-6;
    let unit = |x: f32| x.clamp(0.0, 1.0);
    let [r, g, b, alpha] = old.diffuse_factor.0.map(unit);
    let specular = old.specular_factor.0.map(unit);
    material.base_color = [r, g, b, alpha];
    material.metallic = 0.0;
    material.roughness = 1.0 - unit(old.glossiness_factor.0);
    if old.diffuse_texture.is_some() || old.specular_glossiness_texture.is_some() {
        return;
    }
    let brightness = |[r, g, b]: [f32; 3]| (0.299 * r * r + 0.587 * g * g + 0.114 * b * b).sqrt();
    let (diffuse, shine) = (brightness([r, g, b]), brightness(specular));
    let strongest = specular.into_iter().fold(0.0, f32::max);
    let kept = (1.0 - strongest) / (1.0 - DIELECTRIC);
    // The metalness at which diffuse and specular colour both come out: a root of a parabola.
    let metallic = if shine < DIELECTRIC {
        0.0
    } else {
        let b = diffuse * kept + shine - 2.0 * DIELECTRIC;
        let root = (b * b - 4.0 * DIELECTRIC * (DIELECTRIC - shine))
            .max(0.0)
            .sqrt();
        unit((root - b) / (2.0 * DIELECTRIC))
    };
    let of_diffuse = kept / (1.0 - metallic).max(LEAST);
    for (channel, shine) in material.base_color.iter_mut().zip(specular) {
        let from_specular = (shine - DIELECTRIC * (1.0 - metallic)) / metallic.max(LEAST);
        let from_diffuse = *channel * of_diffuse;
        let metal = metallic * metallic;
        *channel = unit(from_diffuse + (from_specular - from_diffuse) * metal);
    }
    material.metallic = metallic;
}

/// A texture in the form that `gltf` gives to all but two; of the extensions of these it knows none.
fn with_transform(
    index: Index<json::Texture>,
    tex_coord: u32,
    others: Option<&Map<String, Value>>,
) -> Info {
    Info {
        index,
        tex_coord,
        extensions: others.map(|others| extensions::texture::Info {
            texture_transform: None,
            others: others.clone(),
        }),
        extras: None,
    }
}

fn read_texture_use(item: &Info, place: &str, context: &Context<'_>) -> Result<TextureUse, Fault> {
    context
        .model
        .check(&item.index, &format!("{place}/index"))?;
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
        let reason = format!(
            "uses TEXCOORD_{}, but only the UV sets 0 and 1 are supported",
            used.uv_set
        );
        return Err(Fault::new(place, reason));
    }
    Ok(used)
}

/// Translation times rotation times scale; the rotation is counter-clockwise in an image whose v
/// points down.
fn transform(given: &extensions::texture::TextureTransform) -> Option<TextureTransform> {
    let ([x, y], [w, h]) = (given.offset.0, given.scale.0);
    let (sin, cos) = given.rotation.0.sin_cos();
    let rows = [[cos * w, sin * h, x], [-sin * w, cos * h, y]];
    let finite = rows.as_flattened().iter().all(|x| x.is_finite());
    finite.then_some(TextureTransform(rows))
}
