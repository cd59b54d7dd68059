//! Version and extensions of a file (glTF 2.0, sections 3.2 and 3.12).

use gltf::json::{Asset, Root};
use serde_json::Value;

use super::{basis, container::CONVERT_OLD, draco, model};
use crate::scene::{
    SceneError,
    error::{Fault, Warnings},
};

/// The supported extensions; `false` for those whose optional feature is off.
const SUPPORTED: [(&str, bool); 25] = [
    ("EXT_lights_image_based", true),
    ("EXT_mesh_gpu_instancing", true),
    ("EXT_meshopt_compression", true),
    ("EXT_texture_webp", true),
    // A pointer to something that can't be animated gets its own warning.
    ("KHR_animation_pointer", true),
    ("KHR_draco_mesh_compression", draco::AVAILABLE),
    ("KHR_lights_punctual", true),
    ("KHR_materials_anisotropy", true),
    ("KHR_materials_clearcoat", true),
    ("KHR_materials_diffuse_transmission", true),
    ("KHR_materials_emissive_strength", true),
    ("KHR_materials_ior", true),
    ("KHR_materials_iridescence", true),
    ("KHR_materials_pbrSpecularGlossiness", true),
    ("KHR_materials_sheen", true),
    ("KHR_materials_specular", true),
    ("KHR_materials_transmission", true),
    ("KHR_materials_unlit", true),
    ("KHR_materials_variants", true),
    ("KHR_materials_volume", true),
    ("KHR_mesh_quantization", true),
    ("KHR_meshopt_compression", true),
    ("KHR_node_visibility", true),
    ("KHR_texture_basisu", basis::AVAILABLE),
    ("KHR_texture_transform", true),
];

/// Supported extensions that are approximated, and how. In the other extensions, only lighting is approximate.
const APPROXIMATED: [(&str, &str); 3] = [
    (
        "KHR_materials_diffuse_transmission",
        "light from behind is that of the lights and the environment, not of other surfaces",
    ),
    ("KHR_materials_transmission", "what lies behind is tinted, but neither refracted nor blurred"),
    ("KHR_materials_volume", "light is absorbed over the thickness, but neither refracted nor scattered"),
];

/// Unsupported extensions without which a file looks different. All others are metadata, or have a fallback that looks
/// the same.
const VISIBLE: [&str; 3] = ["KHR_materials_dispersion", "KHR_materials_subsurface", "KHR_materials_volume_scatter"];

/// Whether an extension is read, or a warning about it names it.
pub fn is_mentioned(name: &str) -> bool {
    SUPPORTED.contains(&(name, true)) || VISIBLE.contains(&name)
}

/// Reads `asset`; refuses another version of glTF.
pub fn read(value: &Value, file: &str) -> Result<Asset, SceneError> {
    let malformed = |fault: Fault| fault.into_error(file);
    let root = Fault::new("/", "lacks the required \"asset\"");
    let value = value.get("asset").ok_or(root).map_err(malformed)?;
    let asset: Asset = model::typed(value, "/asset").map_err(malformed)?;
    let (major, _) = parse_version(&asset.version, "/asset/version").map_err(malformed)?;
    let refuse = |found: String, way_out| SceneError::Version { file: file.to_owned(), found, way_out };
    if major != 2 {
        return Err(refuse(asset.version, if major < 2 { CONVERT_OLD } else { EXPORT_2 }));
    }
    if let Some(least) = &asset.min_version
        && parse_version(least, "/asset/minVersion").map_err(malformed)? > (2, 0)
    {
        return Err(refuse(format!("{least} (minVersion)"), EXPORT_2));
    }
    Ok(asset)
}

/// Refuses extensions that are required but unsupported; warns of those that are approximated, and of unsupported ones
/// that change the image.
pub fn check_extensions(root: &Root, file: &str, warnings: &mut Warnings) -> Result<(), SceneError> {
    let supported = |name: &str| SUPPORTED.contains(&(name, true));
    if let Some(name) = root.extensions_required.iter().find(|name| !supported(name)) {
        return Err(SceneError::Extension { file: file.to_owned(), name: name.clone(), way_out: way_out(name) });
    }
    for (name, how) in APPROXIMATED {
        if root.extensions_required.iter().any(|other| other == name) {
            let reason = format!("{name} is approximated: {how}");
            warnings.push(&Fault::new("/extensionsRequired", reason));
        }
    }
    let used = root.extensions_used.iter().map(String::as_str);
    let visible: Vec<&str> = used.filter(|name| VISIBLE.contains(name)).collect();
    if !visible.is_empty() {
        let reason = format!("drawn without {}", visible.join(", "));
        warnings.push(&Fault::new("/extensionsUsed", reason));
    }
    Ok(())
}

const EXPORT_2: &str = "export it again as glTF 2.0";

/// Major and minor version.
fn parse_version(text: &str, place: &str) -> Result<(u32, u32), Fault> {
    text.split_once('.')
        .and_then(|(major, minor)| Some((major.parse().ok()?, minor.parse().ok()?)))
        .ok_or_else(|| Fault::new(place, format!("\"{text}\" is no version")))
}

fn way_out(name: &str) -> String {
    match name {
        "KHR_draco_mesh_compression" => "decode it with `gltf-transform copy IN OUT`".to_owned(),
        "KHR_texture_basisu" => "convert its textures with `gltf-transform ktxdecompress IN OUT`".to_owned(),
        _ => format!("export the scene without {name}"),
    }
}
