//! Parts of a glTF document that are not drawn. Application data (`extras`) are not meant to be.
//!
//! Places are patterns: JSON pointers in which `*` stands for each entry of an array, and `?` for each member of an object.

use std::collections::HashMap;

use serde_json::Value;

use super::asset;
use crate::scene::error::Warnings;

/// Vertex attributes that are read, apart from the numbered sets of joints and weights.
const ATTRIBUTES: [&str; 6] = ["POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"];

/// Attributes of morph targets that are read.
const DISPLACED: [&str; 3] = ["POSITION", "NORMAL", "TANGENT"];

/// Attributes of instances that are read.
const OF_INSTANCES: [&str; 3] = ["TRANSLATION", "ROTATION", "SCALE"];

const LIGHTS: &str = "/extensions/KHR_lights_punctual/lights/*";
const ENVIRONMENTS: &str = "/extensions/EXT_lights_image_based/lights/*";
const PRIMITIVES: &str = "/meshes/*/primitives/*";

/// Members that the specification gives objects, besides `extensions` and `extras`, which all have.
const MEMBERS: [(&str, &str); 27] = [
    (
        "",
        "accessors animations asset bufferViews buffers cameras extensionsRequired extensionsUsed images materials meshes \
         nodes samplers scene scenes skins textures",
    ),
    ("/accessors/*", "bufferView byteOffset componentType count max min name normalized sparse type"),
    ("/animations/*", "channels name samplers"),
    ("/bufferViews/*", "buffer byteLength byteOffset byteStride name target"),
    ("/buffers/*", "byteLength name uri"),
    ("/cameras/*", "name orthographic perspective type"),
    ("/images/*", "bufferView mimeType name uri"),
    (
        "/materials/*",
        "alphaCutoff alphaMode doubleSided emissiveFactor emissiveTexture name normalTexture occlusionTexture \
         pbrMetallicRoughness",
    ),
    ("/meshes/*", "name primitives weights"),
    ("/nodes/*", "camera children matrix mesh name rotation scale skin translation weights"),
    ("/samplers/*", "magFilter minFilter name wrapS wrapT"),
    ("/scenes/*", "name nodes"),
    ("/skins/*", "inverseBindMatrices joints name skeleton"),
    ("/textures/*", "name sampler source"),
    (LIGHTS, "color intensity name range spot type"),
    ("/extensions/KHR_materials_variants/variants/*", "name"),
    (ENVIRONMENTS, "intensity irradianceCoefficients name rotation specularImageSize specularImages"),
    (
        "/materials/*/pbrMetallicRoughness",
        "baseColorFactor baseColorTexture metallicFactor metallicRoughnessTexture roughnessFactor",
    ),
    ("/materials/*/normalTexture", "index scale texCoord"),
    ("/materials/*/occlusionTexture", "index strength texCoord"),
    ("/materials/*/emissiveTexture", "index texCoord"),
    ("/cameras/*/perspective", "aspectRatio yfov zfar znear"),
    ("/cameras/*/orthographic", "xmag ymag zfar znear"),
    ("/accessors/*/sparse", "count indices values"),
    (PRIMITIVES, "attributes indices material mode targets"),
    ("/animations/*/channels/*", "sampler target"),
    ("/animations/*/samplers/*", "input interpolation output"),
];

/// Elements to which others refer, and what those are called to which nothing refers.
const KINDS: [(&str, &str); 12] = [
    ("/accessors/*", "accessors that nothing uses"),
    ("/bufferViews/*", "buffer views that nothing uses"),
    ("/buffers/*", "buffers that nothing uses"),
    ("/cameras/*", "cameras of no node"),
    ("/images/*", "images that nothing uses"),
    (LIGHTS, "lights of no node"),
    (ENVIRONMENTS, "environments of no scene"),
    ("/materials/*", "materials that nothing uses"),
    ("/meshes/*", "meshes of no node"),
    ("/samplers/*", "samplers that nothing uses"),
    ("/skins/*", "skins of no node"),
    ("/textures/*", "textures that nothing uses"),
];

/// Indices, and the elements to which they refer. Those of textures in materials are found by their names.
const REFERENCES: [(&str, &str); 25] = [
    ("/meshes/*/primitives/*/attributes/?", "/accessors/*"),
    ("/meshes/*/primitives/*/indices", "/accessors/*"),
    ("/meshes/*/primitives/*/targets/*/?", "/accessors/*"),
    ("/meshes/*/primitives/*/material", "/materials/*"),
    ("/meshes/*/primitives/*/extensions/KHR_materials_variants/mappings/*/material", "/materials/*"),
    ("/meshes/*/primitives/*/extensions/?/bufferView", "/bufferViews/*"),
    ("/accessors/*/bufferView", "/bufferViews/*"),
    ("/accessors/*/sparse/indices/bufferView", "/bufferViews/*"),
    ("/accessors/*/sparse/values/bufferView", "/bufferViews/*"),
    ("/bufferViews/*/buffer", "/buffers/*"),
    ("/bufferViews/*/extensions/?/buffer", "/buffers/*"),
    ("/animations/*/samplers/*/input", "/accessors/*"),
    ("/animations/*/samplers/*/output", "/accessors/*"),
    ("/skins/*/inverseBindMatrices", "/accessors/*"),
    ("/nodes/*/mesh", "/meshes/*"),
    ("/nodes/*/camera", "/cameras/*"),
    ("/nodes/*/skin", "/skins/*"),
    ("/nodes/*/extensions/KHR_lights_punctual/light", LIGHTS),
    ("/nodes/*/extensions/EXT_mesh_gpu_instancing/attributes/?", "/accessors/*"),
    ("/scenes/*/extensions/EXT_lights_image_based/light", ENVIRONMENTS),
    ("/textures/*/sampler", "/samplers/*"),
    ("/textures/*/source", "/images/*"),
    ("/textures/*/extensions/?/source", "/images/*"),
    ("/extensions/EXT_lights_image_based/lights/*/specularImages/*/*", "/images/*"),
    ("/images/*/bufferView", "/bufferViews/*"),
];

/// Counts the parts of a document that are not read, and the elements to which nothing refers.
pub fn name(document: &Value, warnings: &mut Warnings) {
    name_extensions(document, warnings);
    name_members(document, warnings);
    name_unused(document, warnings);
    name_nodes(document, warnings);
    name_attributes(document, warnings);
    name_skins_and_weights(document, warnings);
    name_channels(document, warnings);
    for material in each(document, "/materials/*") {
        let is_mask = material.get("alphaMode").and_then(Value::as_str) == Some("MASK");
        let is_unused = material.get("alphaCutoff").is_some() && !is_mask;
        warnings.leave_out("alpha cutoffs of materials that are not MASK", usize::from(is_unused), "");
    }
    for aspect in each(document, "/cameras/*/perspective/aspectRatio") {
        let is_unused = aspect.as_f64().is_some_and(|aspect| aspect <= 0.0);
        warnings.leave_out("aspect ratios that are not positive", usize::from(is_unused), "");
    }
}

/// Values at the places of a pattern.
fn each<'v>(value: &'v Value, pattern: &str) -> Vec<&'v Value> {
    let inner = |value: &'v Value, name: &str| -> Vec<&'v Value> {
        match (name, value) {
            ("*", Value::Array(entries)) => entries.iter().collect(),
            ("?", Value::Object(members)) => members.values().collect(),
            _ => value.get(name).into_iter().collect(),
        }
    };
    let names = pattern.split('/').skip(1);
    names.fold(vec![value], |found, name| found.into_iter().flat_map(|value| inner(value, name)).collect())
}

/// Names of an object's members.
fn names(object: &Value) -> impl Iterator<Item = &str> {
    object.as_object().into_iter().flatten().map(|(name, _)| name.as_str())
}

/// An index of a list.
fn index(value: &Value) -> Option<usize> {
    usize::try_from(value.as_u64()?).ok()
}

fn name_extensions(value: &Value, warnings: &mut Warnings) {
    match value {
        Value::Array(values) => values.iter().for_each(|value| name_extensions(value, warnings)),
        Value::Object(members) => {
            for (key, value) in members {
                if key == "extras" {
                    continue;
                }
                if key == "extensions"
                    && let Value::Object(extensions) = value
                {
                    for name in extensions.keys().filter(|name| !asset::is_mentioned(name)) {
                        warnings.leave_out("extensions", 1, name);
                    }
                }
                name_extensions(value, warnings);
            }
        }
        _ => {}
    }
}

/// Names members that the specification does not have, such as misspelt ones.
fn name_members(document: &Value, warnings: &mut Warnings) {
    for (place, known) in MEMBERS {
        let is_known = |name: &str| known.split(' ').chain(["extensions", "extras"]).any(|known| known == name);
        for name in each(document, place).into_iter().flat_map(names).filter(|name| !is_known(name)) {
            warnings.leave_out("members that are not of the format", 1, name);
        }
    }
}

/// Names the elements to which nothing refers.
fn name_unused(document: &Value, warnings: &mut Warnings) {
    let kinds = KINDS.map(|(place, _)| (place, vec![false; each(document, place).len()]));
    let mut is_used: HashMap<&str, Vec<bool>> = kinds.into();
    let mut mark = |place: &str, reference: &Value| {
        let used = is_used.get_mut(place).and_then(|used| used.get_mut(index(reference)?));
        if let Some(used) = used {
            *used = true;
        }
    };
    for (from, place) in REFERENCES {
        each(document, from).into_iter().for_each(|reference| mark(place, reference));
    }
    for material in each(document, "/materials/*") {
        each_texture(material, &mut |texture| mark("/textures/*", texture));
    }
    for (place, kind) in KINDS {
        let elements = each(document, place).into_iter().zip(&is_used[place]).enumerate();
        for (index, (element, _)) in elements.filter(|(_, (_, used))| !**used) {
            warnings.leave_out(kind, 1, &title(element, index));
        }
    }
}

/// Calls `take` with the index of each texture of a material or of an object in it.
fn each_texture(value: &Value, take: &mut impl FnMut(&Value)) {
    for (key, inner) in value.as_object().into_iter().flatten().filter(|(key, _)| *key != "extras") {
        if key.ends_with("Texture") {
            inner.get("index").into_iter().for_each(&mut *take);
        }
        each_texture(inner, take);
    }
}

/// Names the nodes that are in no scene.
fn name_nodes(document: &Value, warnings: &mut Warnings) {
    if each(document, "/scenes/*").is_empty() {
        // All nodes are drawn.
        return;
    }
    let nodes = each(document, "/nodes/*");
    let mut open = each(document, "/scenes/*/nodes/*");
    let mut is_reached = vec![false; nodes.len()];
    while let Some(next) = open.pop() {
        let reached = index(next).and_then(|index| Some((is_reached.get_mut(index)?, nodes.get(index)?)));
        if let Some((reached, node)) = reached
            && !std::mem::replace(reached, true)
        {
            open.extend(each(node, "/children/*"));
        }
    }
    for (index, node) in nodes.iter().enumerate().filter(|(index, _)| !is_reached[*index]) {
        warnings.leave_out("nodes of no scene", 1, &title(node, index));
    }
}

/// Name of an element, or otherwise its index.
fn title(element: &Value, index: usize) -> String {
    let name = element.get("name").and_then(Value::as_str).filter(|name| !name.is_empty());
    name.map_or_else(|| index.to_string(), str::to_owned)
}

fn name_attributes(document: &Value, warnings: &mut Warnings) {
    for attributes in each(document, "/meshes/*/primitives/*/attributes") {
        let has = |name: String| attributes.get(name).is_some();
        // Sets of joints and weights are read up to the first that is not whole.
        let whole = (0..).take_while(|n| has(format!("JOINTS_{n}")) && has(format!("WEIGHTS_{n}"))).count();
        let is_read = |name: &str| {
            let set = name.strip_prefix("JOINTS_").or_else(|| name.strip_prefix("WEIGHTS_"));
            set.map_or(ATTRIBUTES.contains(&name), |set| set.parse().is_ok_and(|set: usize| set < whole))
        };
        for name in names(attributes).filter(|name| !is_read(name)) {
            warnings.leave_out("vertex attributes", 1, name);
        }
    }
    for (place, kind, read) in [
        ("/meshes/*/primitives/*/targets/*", "attributes of morph targets", DISPLACED),
        ("/nodes/*/extensions/EXT_mesh_gpu_instancing/attributes", "attributes of instances", OF_INSTANCES),
    ] {
        for name in each(document, place).into_iter().flat_map(names).filter(|name| !read.contains(name)) {
            warnings.leave_out(kind, 1, name);
        }
    }
}

/// Names skins without joints, joints without a skin, and weights without morph targets.
fn name_skins_and_weights(document: &Value, warnings: &mut Warnings) {
    let meshes = each(document, "/meshes/*");
    // Number of morph targets, and whether there are joints.
    let known: Vec<(usize, bool)> = meshes
        .iter()
        .map(|mesh| {
            let targets = each(mesh, "/primitives/*").into_iter().map(|primitive| each(primitive, "/targets/*").len());
            (targets.max().unwrap_or(0), !each(mesh, "/primitives/*/attributes/JOINTS_0").is_empty())
        })
        .collect();
    let mut has_skin = vec![false; meshes.len()];
    let mut is_drawn = vec![false; meshes.len()];
    let excess = |weights: Option<&Value>, targets: usize| {
        let weights = weights.and_then(Value::as_array).map_or(0, Vec::len);
        weights.saturating_sub(targets)
    };
    for (mesh, (targets, _)) in meshes.iter().zip(&known) {
        warnings.leave_out("weights of no morph target", excess(mesh.get("weights"), *targets), "");
    }
    for node in each(document, "/nodes/*") {
        let mesh = node.get("mesh").and_then(index);
        let (targets, has_joints) = mesh.and_then(|mesh| known.get(mesh).copied()).unwrap_or_default();
        warnings.leave_out("weights of no morph target", excess(node.get("weights"), targets), "");
        let skin = usize::from(node.get("skin").is_some());
        match mesh.filter(|mesh| *mesh < meshes.len()) {
            Some(mesh) => {
                is_drawn[mesh] = true;
                has_skin[mesh] |= skin > 0;
                warnings.leave_out("skins of meshes without joints", if has_joints { 0 } else { skin }, "");
            }
            None => warnings.leave_out("skins of nodes without a mesh", skin, ""),
        }
    }
    for (index, mesh) in meshes.iter().enumerate() {
        let is_unused = known[index].1 && is_drawn[index] && !has_skin[index];
        warnings.leave_out("joints of meshes without a skin", usize::from(is_unused), &title(mesh, index));
    }
}

/// Names channels and samplers of animations that have no effect.
fn name_channels(document: &Value, warnings: &mut Warnings) {
    const PATHS: [&str; 5] = ["translation", "rotation", "scale", "weights", "pointer"];
    let nodes = each(document, "/nodes/*").len();
    for animation in each(document, "/animations/*") {
        let mut is_used = vec![false; each(animation, "/samplers/*").len()];
        for channel in each(animation, "/channels/*") {
            let sampler = channel.get("sampler").and_then(index);
            if let Some(used) = sampler.and_then(|sampler| is_used.get_mut(sampler)) {
                *used = true;
            }
            let path = channel.pointer("/target/path").and_then(Value::as_str).unwrap_or_default();
            let has_node = channel.pointer("/target/node").and_then(index).is_some_and(|node| node < nodes);
            let has_pointer = channel.pointer("/target/extensions/KHR_animation_pointer/pointer").is_some();
            if !PATHS.contains(&path) {
                warnings.leave_out("channels of animations of unknown properties", 1, path);
            } else if !has_node && !has_pointer {
                warnings.leave_out("channels of animations without a target", 1, path);
            }
        }
        let unused = is_used.iter().filter(|used| !**used).count();
        warnings.leave_out("samplers of animations that no channel uses", unused, "");
    }
}
