//! Parts of a glTF document that are not drawn. Application data (`extras`) are not meant to be.

use serde_json::Value;

use super::asset;
use crate::scene::error::Warnings;

/// Vertex attributes that are read, apart from the numbered sets of joints and weights.
const ATTRIBUTES: [&str; 6] = ["POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"];

/// Attributes of morph targets that are read.
const DISPLACED: [&str; 3] = ["POSITION", "NORMAL", "TANGENT"];

/// Attributes of instances that are read.
const OF_INSTANCES: [&str; 3] = ["TRANSLATION", "ROTATION", "SCALE"];

/// Members that the specification gives the elements of each list, besides `extensions` and `extras`, which all have.
const MEMBERS: [(&str, &[&str]); 16] = [
    (
        "/accessors",
        &["bufferView", "byteOffset", "componentType", "count", "max", "min", "name", "normalized", "sparse", "type"],
    ),
    ("/animations", &["channels", "name", "samplers"]),
    ("/bufferViews", &["buffer", "byteLength", "byteOffset", "byteStride", "name", "target"]),
    ("/buffers", &["byteLength", "name", "uri"]),
    ("/cameras", &["name", "orthographic", "perspective", "type"]),
    ("/images", &["bufferView", "mimeType", "name", "uri"]),
    (
        "/materials",
        &[
            "alphaCutoff",
            "alphaMode",
            "doubleSided",
            "emissiveFactor",
            "emissiveTexture",
            "name",
            "normalTexture",
            "occlusionTexture",
            "pbrMetallicRoughness",
        ],
    ),
    ("/meshes", &["name", "primitives", "weights"]),
    (
        "/nodes",
        &["camera", "children", "matrix", "mesh", "name", "rotation", "scale", "skin", "translation", "weights"],
    ),
    ("/samplers", &["magFilter", "minFilter", "name", "wrapS", "wrapT"]),
    ("/scenes", &["name", "nodes"]),
    ("/skins", &["inverseBindMatrices", "joints", "name", "skeleton"]),
    ("/textures", &["name", "sampler", "source"]),
    ("/extensions/KHR_lights_punctual/lights", &["color", "intensity", "name", "range", "spot", "type"]),
    ("/extensions/KHR_materials_variants/variants", &["name"]),
    (
        "/extensions/EXT_lights_image_based/lights",
        &["intensity", "irradianceCoefficients", "name", "rotation", "specularImageSize", "specularImages"],
    ),
];

/// The same for objects within elements: where they are, and their members.
const INNER: [(&str, &str, &[&str]); 10] = [
    (
        "/materials",
        "pbrMetallicRoughness",
        &["baseColorFactor", "baseColorTexture", "metallicFactor", "metallicRoughnessTexture", "roughnessFactor"],
    ),
    ("/materials", "normalTexture", &["index", "scale", "texCoord"]),
    ("/materials", "occlusionTexture", &["index", "strength", "texCoord"]),
    ("/materials", "emissiveTexture", &["index", "texCoord"]),
    ("/cameras", "perspective", &["aspectRatio", "yfov", "zfar", "znear"]),
    ("/cameras", "orthographic", &["xmag", "ymag", "zfar", "znear"]),
    ("/accessors", "sparse", &["count", "indices", "values"]),
    ("/meshes", "primitives", &["attributes", "indices", "material", "mode", "targets"]),
    ("/animations", "channels", &["sampler", "target"]),
    ("/animations", "samplers", &["input", "interpolation", "output"]),
];

/// Members of the document itself.
const TOP: [&str; 17] = [
    "accessors",
    "animations",
    "asset",
    "bufferViews",
    "buffers",
    "cameras",
    "extensionsRequired",
    "extensionsUsed",
    "images",
    "materials",
    "meshes",
    "nodes",
    "samplers",
    "scene",
    "scenes",
    "skins",
    "textures",
];

/// Counts the parts of a document that are not read, and the elements to which nothing refers.
pub fn name(document: &Value, warnings: &mut Warnings) {
    name_extensions(document, warnings);
    name_members(document, warnings);
    Uses::new(document).name(warnings);
    name_attributes(document, warnings);
    name_skins_and_weights(document, warnings);
    name_channels(document, warnings);
    for material in list(document, "/materials") {
        let is_mask = material.get("alphaMode").and_then(Value::as_str) == Some("MASK");
        let is_unused = material.get("alphaCutoff").is_some() && !is_mask;
        warnings.leave_out("alpha cutoffs of materials that are not MASK", usize::from(is_unused), "");
    }
    for camera in list(document, "/cameras") {
        let aspect = camera.pointer("/perspective/aspectRatio").and_then(Value::as_f64);
        let is_unused = aspect.is_some_and(|aspect| aspect <= 0.0);
        warnings.leave_out("aspect ratios that are not positive", usize::from(is_unused), "");
    }
}

/// Entries of the array at `place`.
fn list<'v>(value: &'v Value, place: &str) -> impl Iterator<Item = &'v Value> {
    let array = value.pointer(place).and_then(Value::as_array);
    array.into_iter().flatten()
}

/// Names of an object's members.
fn names(object: Option<&Value>) -> impl Iterator<Item = &str> {
    let members = object.and_then(Value::as_object).into_iter().flatten();
    members.map(|(name, _)| name.as_str())
}

/// Extension objects of an element.
fn extensions(element: &Value) -> impl Iterator<Item = &Value> {
    let extensions = element.get("extensions").and_then(Value::as_object);
    extensions.into_iter().flatten().map(|(_, extension)| extension)
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
    let mut check = |object: &Value, known: &[&str]| {
        let is_known = |name: &str| known.contains(&name) || name == "extensions" || name == "extras";
        for name in names(Some(object)).filter(|name| !is_known(name)) {
            warnings.leave_out("members that are not of the format", 1, name);
        }
    };
    check(document, &TOP);
    for (place, known) in MEMBERS {
        list(document, place).for_each(|element| check(element, known));
    }
    for (place, member, known) in INNER {
        for inner in list(document, place).filter_map(|element| element.get(member)) {
            match inner {
                Value::Array(several) => several.iter().for_each(|one| check(one, known)),
                one => check(one, known),
            }
        }
    }
}

/// Lists whose elements others refer to, and what elements are called to which nothing refers.
const KINDS: [(&str, &str); 11] = [
    ("/accessors", "accessors that nothing uses"),
    ("/bufferViews", "buffer views that nothing uses"),
    ("/buffers", "buffers that nothing uses"),
    ("/cameras", "cameras of no node"),
    ("/images", "images that nothing uses"),
    ("/extensions/KHR_lights_punctual/lights", "lights of no node"),
    ("/extensions/EXT_lights_image_based/lights", "environments of no scene"),
    ("/materials", "materials that nothing uses"),
    ("/meshes", "meshes of no node"),
    ("/skins", "skins of no node"),
    ("/textures", "textures that nothing uses"),
];
const SAMPLERS: &str = "/samplers";

/// Elements to which others refer.
struct Uses<'v> {
    document: &'v Value,
    used: Vec<(&'static str, &'static str, Vec<bool>)>,
}

impl<'v> Uses<'v> {
    fn new(document: &'v Value) -> Self {
        let kinds = KINDS.into_iter().chain([(SAMPLERS, "samplers that nothing uses")]);
        let used = kinds.map(|(place, name)| (place, name, vec![false; list(document, place).count()]));
        let mut uses = Self { document, used: used.collect() };
        uses.of_geometry();
        uses.of_nodes();
        uses.of_looks();
        uses
    }

    /// Marks what an index refers to.
    fn mark(&mut self, place: &str, index: Option<&Value>) {
        let index = index.and_then(Value::as_u64).and_then(|index| usize::try_from(index).ok());
        let used = self.used.iter_mut().find(|(other, ..)| *other == place);
        if let Some(used) = used.and_then(|(.., used)| used.get_mut(index?)) {
            *used = true;
        }
    }

    fn mark_all<'i>(&mut self, place: &str, indices: impl IntoIterator<Item = Option<&'i Value>>) {
        indices.into_iter().for_each(|index| self.mark(place, index));
    }

    fn of_geometry(&mut self) {
        let document = self.document;
        let values =
            |object: Option<&'v Value>| object.and_then(Value::as_object).into_iter().flatten().map(|(_, v)| Some(v));
        for primitive in list(document, "/meshes").flat_map(|mesh| list(mesh, "/primitives")) {
            self.mark_all("/accessors", values(primitive.get("attributes")).chain([primitive.get("indices")]));
            self.mark_all("/accessors", list(primitive, "/targets").flat_map(|target| values(Some(target))));
            let mappings = list(primitive, "/extensions/KHR_materials_variants/mappings");
            self.mark_all(
                "/materials",
                mappings.map(|mapping| mapping.get("material")).chain([primitive.get("material")]),
            );
            self.mark_all("/bufferViews", extensions(primitive).map(|extension| extension.get("bufferView")));
        }
        for accessor in list(document, "/accessors") {
            let sparse =
                ["/sparse/indices/bufferView", "/sparse/values/bufferView"].map(|place| accessor.pointer(place));
            self.mark_all("/bufferViews", sparse.into_iter().chain([accessor.get("bufferView")]));
        }
        for view in list(document, "/bufferViews") {
            let compressed = extensions(view).map(|extension| extension.get("buffer"));
            self.mark_all("/buffers", compressed.chain([view.get("buffer")]));
        }
        for sampler in list(document, "/animations").flat_map(|animation| list(animation, "/samplers")) {
            self.mark_all("/accessors", ["input", "output"].map(|member| sampler.get(member)));
        }
        self.mark_all("/accessors", list(document, "/skins").map(|skin| skin.get("inverseBindMatrices")));
    }

    fn of_nodes(&mut self) {
        let document = self.document;
        for node in list(document, "/nodes") {
            self.mark("/meshes", node.get("mesh"));
            self.mark("/cameras", node.get("camera"));
            self.mark("/skins", node.get("skin"));
            self.mark("/extensions/KHR_lights_punctual/lights", node.pointer("/extensions/KHR_lights_punctual/light"));
            let instances = node.pointer("/extensions/EXT_mesh_gpu_instancing/attributes");
            let instances = instances.and_then(Value::as_object).into_iter().flatten();
            self.mark_all("/accessors", instances.map(|(_, index)| Some(index)));
        }
        for scene in list(document, "/scenes") {
            let light = scene.pointer("/extensions/EXT_lights_image_based/light");
            self.mark("/extensions/EXT_lights_image_based/lights", light);
        }
    }

    fn of_looks(&mut self) {
        let document = self.document;
        for material in list(document, "/materials") {
            self.of_material(material);
        }
        for texture in list(document, "/textures") {
            self.mark(SAMPLERS, texture.get("sampler"));
            self.mark_all(
                "/images",
                extensions(texture).map(|extension| extension.get("source")).chain([texture.get("source")]),
            );
        }
        for light in list(document, "/extensions/EXT_lights_image_based/lights") {
            let images = list(light, "/specularImages").filter_map(Value::as_array).flatten();
            self.mark_all("/images", images.map(Some));
        }
        self.mark_all("/bufferViews", list(document, "/images").map(|image| image.get("bufferView")));
    }

    /// Marks the textures of a material or of an object in it.
    fn of_material(&mut self, value: &Value) {
        for (key, inner) in value.as_object().into_iter().flatten().filter(|(key, _)| *key != "extras") {
            if key.ends_with("Texture") {
                self.mark("/textures", inner.get("index"));
            }
            self.of_material(inner);
        }
    }

    /// Names the elements to which nothing refers, and the nodes that are in no scene.
    fn name(&self, warnings: &mut Warnings) {
        for (place, kind, used) in &self.used {
            for (index, (element, _)) in
                list(self.document, place).zip(used).enumerate().filter(|(_, (_, used))| !**used)
            {
                warnings.leave_out(kind, 1, &title(element, index));
            }
        }
        let nodes: Vec<&Value> = list(self.document, "/nodes").collect();
        let scenes = list(self.document, "/scenes");
        let mut open: Vec<&Value> = scenes.flat_map(|scene| list(scene, "/nodes")).collect();
        if list(self.document, "/scenes").next().is_none() {
            // All nodes are drawn.
            return;
        }
        let mut is_reached = vec![false; nodes.len()];
        while let Some(index) = open.pop() {
            let index = index.as_u64().and_then(|index| usize::try_from(index).ok());
            let reached = index.and_then(|index| Some((is_reached.get_mut(index)?, nodes.get(index)?)));
            if let Some((reached, node)) = reached
                && !std::mem::replace(reached, true)
            {
                open.extend(list(node, "/children"));
            }
        }
        for (index, node) in nodes.iter().enumerate().filter(|(index, _)| !is_reached[*index]) {
            warnings.leave_out("nodes of no scene", 1, &title(node, index));
        }
    }
}

/// Name of an element, or otherwise its index.
fn title(element: &Value, index: usize) -> String {
    let name = element.get("name").and_then(Value::as_str).filter(|name| !name.is_empty());
    name.map_or_else(|| index.to_string(), str::to_owned)
}

fn name_attributes(document: &Value, warnings: &mut Warnings) {
    for primitive in list(document, "/meshes").flat_map(|mesh| list(mesh, "/primitives")) {
        let attributes = primitive.get("attributes");
        let has = |name: String| attributes.is_some_and(|all| all.get(name).is_some());
        // Sets of joints and weights are read up to the first that is not whole.
        let whole = (0..).take_while(|n| has(format!("JOINTS_{n}")) && has(format!("WEIGHTS_{n}"))).count();
        let is_read = |name: &str| {
            let set = name.strip_prefix("JOINTS_").or_else(|| name.strip_prefix("WEIGHTS_"));
            set.map_or(ATTRIBUTES.contains(&name), |set| set.parse().is_ok_and(|set: usize| set < whole))
        };
        for name in names(attributes).filter(|name| !is_read(name)) {
            warnings.leave_out("vertex attributes", 1, name);
        }
        for target in list(primitive, "/targets") {
            for name in names(Some(target)).filter(|name| !DISPLACED.contains(name)) {
                warnings.leave_out("attributes of morph targets", 1, name);
            }
        }
    }
    for node in list(document, "/nodes") {
        let attributes = node.pointer("/extensions/EXT_mesh_gpu_instancing/attributes");
        for name in names(attributes).filter(|name| !OF_INSTANCES.contains(name)) {
            warnings.leave_out("attributes of instances", 1, name);
        }
    }
}

/// Names skins without joints, joints without a skin, and weights without morph targets.
fn name_skins_and_weights(document: &Value, warnings: &mut Warnings) {
    let meshes: Vec<&Value> = list(document, "/meshes").collect();
    let primitives = |mesh: &'_ Value| -> Vec<(usize, bool)> {
        let of_primitive = |primitive: &Value| {
            let has_joints = primitive.pointer("/attributes/JOINTS_0").is_some();
            (list(primitive, "/targets").count(), has_joints)
        };
        list(mesh, "/primitives").map(of_primitive).collect()
    };
    // Number of morph targets, and whether there are joints.
    let known: Vec<(usize, bool)> = meshes
        .iter()
        .map(|mesh| {
            let primitives = primitives(mesh);
            let targets = primitives.iter().map(|(targets, _)| *targets).max().unwrap_or(0);
            (targets, primitives.iter().any(|(_, has_joints)| *has_joints))
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
    for node in list(document, "/nodes") {
        let mesh = node.get("mesh").and_then(Value::as_u64).and_then(|mesh| usize::try_from(mesh).ok());
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
    let nodes = list(document, "/nodes").count() as u64;
    for animation in list(document, "/animations") {
        let mut is_used = vec![false; list(animation, "/samplers").count()];
        for channel in list(animation, "/channels") {
            let sampler =
                channel.get("sampler").and_then(Value::as_u64).and_then(|sampler| usize::try_from(sampler).ok());
            if let Some(used) = sampler.and_then(|sampler| is_used.get_mut(sampler)) {
                *used = true;
            }
            let path = channel.pointer("/target/path").and_then(Value::as_str).unwrap_or_default();
            let has_node = channel.pointer("/target/node").and_then(Value::as_u64).is_some_and(|node| node < nodes);
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
