//! What a file says about itself: its version and its extensions (glTF 2.0, sections 3.2 and 3.12).

use super::{container::CONVERT_OLD, json::Item};
use crate::scene::{
    SceneError,
    document::Asset,
    error::{Fault, Warnings},
};

/// The extensions that are implemented.
const SUPPORTED: [&str; 8] = [
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// Extensions without which a file looks different; others that are not supported are metadata, or
/// have a fallback that looks the same.
const VISIBLE: [&str; 16] = [
    "EXT_lights_image_based",
    "KHR_animation_pointer",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_subsurface",
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_materials_volume_scatter",
    "KHR_node_visibility",
];

/// Reads `asset` and the extension lists; refuses what is not supported.
pub fn read(root: &Item<'_>, file: &str, warnings: &mut Warnings) -> Result<Asset, SceneError> {
    let malformed = |fault: Fault| fault.into_error(file);
    let asset = root.require("asset").map_err(malformed)?;
    let version_item = asset.require("version").map_err(malformed)?;
    let version = version_item.as_str().map_err(malformed)?;
    let (major, _) = parse_version(&version_item).map_err(malformed)?;
    if major != 2 {
        return Err(SceneError::Version {
            file: file.to_owned(),
            found: version.to_owned(),
            way_out: if major < 2 { CONVERT_OLD } else { EXPORT_2 },
        });
    }
    if let Some(item) = asset.get("minVersion")
        && parse_version(&item).map_err(malformed)? > (2, 0)
    {
        return Err(SceneError::Version {
            file: file.to_owned(),
            found: format!("{} (minVersion)", item.as_str().map_err(malformed)?),
            way_out: EXPORT_2,
        });
    }
    let required = names(root, "extensionsRequired").map_err(malformed)?;
    let supported = |name: &str| SUPPORTED.contains(&name);
    if let Some(name) = required.iter().find(|name| !supported(name)) {
        return Err(SceneError::Extension {
            file: file.to_owned(),
            name: name.clone(),
            way_out: way_out(name),
        });
    }
    let used = names(root, "extensionsUsed").map_err(malformed)?;
    let visible: Vec<&str> = used
        .iter()
        .map(String::as_str)
        .filter(|name| VISIBLE.contains(name))
        .collect();
    if !visible.is_empty() {
        warnings.push(&Fault::new(
            "/extensionsUsed",
            format!("drawn without {}", visible.join(", ")),
        ));
    }
    Ok(Asset {
        version: version.to_owned(),
        generator: asset.text("generator").ok().flatten().map(str::to_owned),
        extensions_used: used,
        extensions_required: required,
    })
}

const EXPORT_2: &str = "export it again as glTF 2.0";

/// Major and minor version.
fn parse_version(item: &Item<'_>) -> Result<(u32, u32), Fault> {
    let text = item.as_str()?;
    text.split_once('.')
        .and_then(|(major, minor)| Some((major.parse().ok()?, minor.parse().ok()?)))
        .ok_or_else(|| item.fault(format!("\"{text}\" is no version")))
}

fn names(root: &Item<'_>, key: &str) -> Result<Vec<String>, Fault> {
    let items = root.array(key)?;
    items
        .iter()
        .map(|item| item.as_str().map(str::to_owned))
        .collect()
}

fn way_out(name: &str) -> String {
    match name {
        "KHR_draco_mesh_compression" => "decode it with `gltf-transform copy IN OUT`".to_owned(),
        "KHR_texture_basisu" => {
            "convert its textures with `gltf-transform ktxdecompress IN OUT`".to_owned()
        }
        "KHR_materials_pbrSpecularGlossiness" => {
            "convert it with `gltf-transform metalrough IN OUT`".to_owned()
        }
        _ => format!("export the scene without {name}"),
    }
}
