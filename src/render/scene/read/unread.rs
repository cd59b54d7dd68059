//! Parts of a glTF document that are not drawn. Application data (`extras`) are not meant to be.

use serde_json::Value;

use super::asset;
use crate::scene::error::Warnings;

/// Vertex attributes that are read, apart from the numbered sets of joints and weights.
const ATTRIBUTES: [&str; 6] = ["POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"];

/// Attributes of morph targets that are read.
const DISPLACED: [&str; 3] = ["POSITION", "NORMAL", "TANGENT"];

/// Counts the extensions and vertex attributes of a document that are not read.
pub fn name(document: &Value, warnings: &mut Warnings) {
    name_extensions(document, warnings);
    for primitive in list(document, "meshes").flat_map(|mesh| list(mesh, "primitives")) {
        let is_read = |name: &str| {
            let is_skin = name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
            is_skin || ATTRIBUTES.contains(&name)
        };
        for name in names(primitive.get("attributes")).filter(|name| !is_read(name)) {
            warnings.leave_out("vertex attributes", 1, name);
        }
        for target in list(primitive, "targets") {
            let is_read = |name: &str| DISPLACED.contains(&name);
            for name in names(Some(target)).filter(|name| !is_read(name)) {
                warnings.leave_out("attributes of morph targets", 1, name);
            }
        }
    }
}

/// Entries of an array that is a member of an object.
fn list<'v>(object: &'v Value, key: &str) -> impl Iterator<Item = &'v Value> {
    let array = object.get(key).and_then(Value::as_array);
    array.into_iter().flatten()
}

/// Names of an object's members.
fn names(object: Option<&Value>) -> impl Iterator<Item = &str> {
    let members = object.and_then(Value::as_object).into_iter().flatten();
    members.map(|(name, _)| name.as_str())
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
