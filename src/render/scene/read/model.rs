//! The document in `gltf`'s own types, read element by element, so that a broken element does not break the others.
//!
//! `gltf` refuses a whole file for the first value of a wrong type. Here every element of the top-level arrays is read
//! separately. An element that can't be read is recorded with the place of its fault, which is reported when something
//! refers to the element, and a stand-in keeps its index.

use std::collections::HashMap;

use gltf::json::{
    Accessor, Animation, Asset, Buffer, Camera, Image, Index, Material, Mesh, Node, Path, Root, Scene, Skin, Texture,
    buffer::View,
    extensions::scene::{khr_lights_punctual::Light, khr_materials_variants::Variant},
    root::Get,
    texture::Sampler,
    validation::{Checked, Error, Validate},
};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value, json};
use serde_path_to_error::Segment;

use crate::scene::error::{Fault, Warnings};

/// An element of one of the document's arrays.
pub trait Element: DeserializeOwned + 'static {
    /// JSON pointer to the array.
    const PLACE: &'static str;
    /// Members that the element can do without; `*` stands for any name. Entries of an array become stand-ins, which
    /// refer to nothing.
    const SOFT: &'static [&'static str] = &[];
}

macro_rules! elements {
    ($($kind:ty, $place:literal, [$($soft:literal),*];)*) => {
        $(impl Element for $kind {
            const PLACE: &'static str = $place;
            const SOFT: &'static [&'static str] = &[$($soft),*];
        })*
    };
}

elements! {
    Accessor, "/accessors", [];
    Animation, "/animations", ["channels/*", "samplers/*"];
    Buffer, "/buffers", [];
    View, "/bufferViews", ["target"];
    Camera, "/cameras", [];
    Image, "/images", [];
    Light, "/extensions/KHR_lights_punctual/lights", [];
    Material, "/materials", [
        "extensions/KHR_materials_ior", "extensions/KHR_materials_pbrSpecularGlossiness",
        "extensions/KHR_materials_specular", "extensions/KHR_materials_transmission",
        "extensions/KHR_materials_volume",
        "normalTexture", "occlusionTexture", "emissiveTexture",
        "pbrMetallicRoughness/baseColorTexture", "pbrMetallicRoughness/metallicRoughnessTexture"
    ];
    Mesh, "/meshes", [
        "weights", "primitives/*/attributes/*", "primitives/*/material", "primitives/*/targets/*/*",
        "primitives/*/extensions/KHR_materials_variants"
    ];
    Node, "/nodes", ["camera", "weights", "extensions/KHR_lights_punctual"];
    Sampler, "/samplers", [];
    Scene, "/scenes", [];
    Skin, "/skins", [];
    Texture, "/textures", ["sampler"];
    Variant, "/extensions/KHR_materials_variants/variants", [];
}

/// Attribute that has to be readable for a primitive to be drawn at all.
const HARD: &str = "POSITION";

/// Document of a file.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// The document. Indices may be out of range, and enums [`Checked::Invalid`].
    pub root: Root,
    /// The document as it was written, for messages and for numbers in double precision.
    value: Value,
    /// Elements that are stand-ins, by place.
    broken: HashMap<String, Fault>,
}

impl Model {
    /// Reads a `value` that was [settled](settle). Broken members that an element can do without are left out with a
    /// warning.
    pub fn new(value: Value, asset: Asset, warnings: &mut Warnings) -> Result<Self, Fault> {
        let mut lists = Lists { value: &value, broken: HashMap::new(), warnings };
        let lights: Vec<Light> = lists.read()?;
        let variants: Vec<Variant> = lists.read()?;
        let mut root = Root {
            accessors: lists.read()?,
            animations: lists.read()?,
            asset,
            buffers: lists.read()?,
            buffer_views: lists.read()?,
            scene: None,
            extensions: None,
            extras: None,
            extensions_used: lists.names("extensionsUsed")?,
            extensions_required: lists.names("extensionsRequired")?,
            cameras: lists.read()?,
            images: lists.read()?,
            materials: lists.read()?,
            meshes: lists.read()?,
            nodes: lists.read()?,
            samplers: lists.read()?,
            scenes: lists.read()?,
            skins: lists.read()?,
            textures: lists.read()?,
        };
        let scene = value.get("scene").map(|scene| typed(scene, "/scene")).transpose();
        root.scene = scene.unwrap_or_else(|fault| {
            lists.warnings.push(&fault.but("the first is the default"));
            None
        });
        *root.as_mut() = lights;
        *root.as_mut() = variants;
        let broken = lists.broken;
        Ok(Self { root, value, broken })
    }

    /// Makes a model of a document without broken parts. Some parts may have been removed from the document.
    pub fn of(root: Root, value: Value) -> Self {
        Self { root, value, broken: HashMap::new() }
    }

    /// The element at `index`, and its place; `from` is the place of the reference.
    pub fn get<T: Element>(&self, index: Index<T>, from: &str) -> Result<(&T, String), Fault>
    where
        Root: Get<T>,
        Index<T>: Validate,
    {
        self.check(&index, from)?;
        let place = format!("{}/{}", T::PLACE, index.value());
        if let Some(fault) = self.broken.get(&place) {
            return Err(fault.clone());
        }
        let element = self.root.get(index);
        Ok((element.ok_or_else(|| Fault::new(from, "refers to nothing"))?, place))
    }

    /// All elements of a kind; a broken one is an error.
    pub fn all<T: Element>(&self) -> impl Iterator<Item = Result<(&T, String), Fault>>
    where
        Root: Get<T> + AsRef<[T]>,
        Index<T>: Validate,
    {
        let all: &[T] = self.root.as_ref();
        (0..all.len() as u32).map(|i| self.get(Index::new(i), T::PLACE))
    }

    /// The value of an enum at `place`.
    pub fn valid<T: Copy>(&self, value: &Checked<T>, place: &str) -> Result<T, Fault> {
        self.check(value, place)?;
        match value {
            Checked::Valid(value) => Ok(*value),
            Checked::Invalid => Err(Fault::new(place, "is not valid")),
        }
    }

    /// Reports the first fault that `gltf` finds with a part of the document at `place`.
    pub fn check(&self, part: &impl Validate, place: &str) -> Result<(), Fault> {
        let mut first = None;
        part.validate(&self.root, || Path(place.to_owned()), &mut |path, error| {
            first.get_or_insert_with(|| self.explain(&path(), error));
        });
        first.map_or(Ok(()), Err)
    }

    /// Explains an error of `gltf`, with the place that it is about.
    fn explain(&self, path: &Path, error: Error) -> Fault {
        let place = path.as_str().replace("[\"", "/").replace("\"]", "");
        let place = place.replace(['[', '.'], "/").replace(']', "");
        let found = self.value.pointer(&place).map_or("nothing".to_owned(), found);
        let (array, last) = place.rsplit_once('/').unwrap_or_default();
        let reason = match error {
            Error::IndexOutOfBounds => {
                format!("refers to {found}, which the document does not have")
            }
            Error::Missing => return Fault::new(array, format!("lacks the required \"{last}\"")),
            Error::Invalid => format!("{found} is no valid {last}"),
            Error::Oversize => format!("{found} is more than memory can hold"),
            Error::Unsupported => format!("{found} is not supported"),
        };
        Fault::new(place, reason)
    }

    /// JSON value at `place`.
    pub fn at(&self, place: &str) -> Option<&Value> {
        self.value.pointer(place)
    }

    /// The text at `place`.
    pub fn text(&self, place: &str) -> Option<&str> {
        self.at(place).and_then(Value::as_str)
    }

    /// The `N` numbers at `place` in double precision, which `gltf`'s types do not have.
    pub fn numbers<const N: usize>(&self, place: &str) -> Result<Option<[f64; N]>, Fault> {
        let Some(value) = self.value.pointer(place) else {
            return Ok(None);
        };
        let numbers = value.as_array().and_then(|array| {
            let numbers: Option<Vec<f64>> = array.iter().map(Value::as_f64).collect();
            numbers?.try_into().ok()
        });
        numbers.map(Some).ok_or_else(|| Fault::new(place, format!("expected {N} numbers, found {}", found(value))))
    }
}

/// Reads an extension that `gltf` has no type for.
pub fn extension<T: DeserializeOwned>(
    others: Option<&Map<String, Value>>,
    name: &str,
    place: &str,
) -> Result<Option<(T, String)>, Fault> {
    let Some(value) = others.and_then(|others| others.get(name)) else {
        return Ok(None);
    };
    let place = format!("{place}/extensions/{name}");
    Ok(Some((typed(value, &place)?, place)))
}

/// Description of a value.
fn found(value: &Value) -> String {
    match value {
        Value::Array(array) => format!("an array of {}", array.len()),
        Value::Object(_) => "an object".to_owned(),
        other => other.to_string(),
    }
}

/// Converts a JSON value to a `T`.
pub fn typed<T: DeserializeOwned>(value: &Value, place: &str) -> Result<T, Fault> {
    serde_path_to_error::deserialize(value).map_err(|error| {
        let inner = error.path().iter().map(|segment| match segment {
            Segment::Seq { index } => format!("/{index}"),
            Segment::Map { key } => format!("/{key}"),
            Segment::Enum { variant } => format!("/{variant}"),
            Segment::Unknown => String::new(),
        });
        let place = inner.fold(place.to_owned(), |place, segment| place + &segment);
        let reason = error.inner().to_string();
        let missing = reason.strip_prefix("missing field `").and_then(|r| r.strip_suffix('`'));
        match missing {
            Some(name) => Fault::new(place, format!("lacks the required \"{name}\"")),
            None => Fault::new(place, reason),
        }
    })
}

/// Reads the arrays of a document.
struct Lists<'v, 'w> {
    value: &'v Value,
    broken: HashMap<String, Fault>,
    warnings: &'w mut Warnings,
}

impl Lists<'_, '_> {
    fn names(&self, key: &str) -> Result<Vec<String>, Fault> {
        let value = self.value.get(key);
        value.map_or(Ok(Vec::new()), |value| typed(value, &format!("/{key}")))
    }

    fn read<T: Element>(&mut self) -> Result<Vec<T>, Fault> {
        let mut list = Vec::new();
        let array = match self.value.pointer(T::PLACE) {
            None => return Ok(list),
            Some(Value::Array(array)) => array,
            Some(other) => {
                let reason = format!("expected an array, found {}; it is left out", found(other));
                self.warnings.push(&Fault::new(T::PLACE, reason));
                return Ok(list);
            }
        };
        for (index, value) in array.iter().enumerate() {
            let place = format!("{}/{index}", T::PLACE);
            let element = match typed_object(value, &place) {
                Ok(element) => Ok(element),
                Err(fault) => self.mend(value.clone(), &place, fault),
            };
            list.push(match element {
                Ok(element) => element,
                Err(fault) => {
                    self.broken.insert(place.clone(), fault);
                    typed(&stand_in(), &place)?
                }
            });
        }
        Ok(list)
    }

    /// Removes broken members from an element, as far as the element can do without them.
    fn mend<T: Element>(&mut self, mut value: Value, place: &str, fault: Fault) -> Result<T, Fault> {
        const MOST: usize = 100;
        let mut fault = fault;
        for _ in 0..MOST {
            let inner = fault.place.get(place.len() + 1..).unwrap_or_default();
            let Some(soft) = T::SOFT.iter().find_map(|soft| prefix(inner, soft)) else {
                break;
            };
            let (parent, member) = match soft.rsplit_once('/') {
                Some((parent, member)) => (format!("/{parent}"), member),
                None => (String::new(), soft),
            };
            match value.pointer_mut(&parent) {
                Some(Value::Object(object)) => drop(object.remove(member)),
                Some(array) => {
                    if let Some(entry) = array.pointer_mut(&format!("/{member}")) {
                        *entry = stand_in_of_animation();
                    }
                }
                None => break,
            }
            self.warnings.push(&fault.but("it is left out"));
            fault = match typed_object(&value, place) {
                Ok(element) => return Ok(element),
                Err(fault) => fault,
            };
        }
        Err(fault)
    }
}

fn typed_object<T: DeserializeOwned>(value: &Value, place: &str) -> Result<T, Fault> {
    if value.is_object() {
        typed(value, place)
    } else {
        Err(Fault::new(place, format!("expected an object, found {}", found(value))))
    }
}

/// The part of the path `inner` that matches the pattern `soft`.
fn prefix<'p>(inner: &'p str, soft: &str) -> Option<&'p str> {
    let mut rest = inner;
    for (i, wanted) in soft.split('/').enumerate() {
        if i > 0 {
            rest = rest.strip_prefix('/')?;
        }
        let segment = rest.split('/').next()?;
        if segment.is_empty() || segment == HARD || (wanted != "*" && wanted != segment) {
            return None;
        }
        rest = &rest[segment.len()..];
    }
    inner.strip_suffix(rest)
}

/// Index that refers to nothing.
const NOTHING: u32 = u32::MAX;

/// Whether an index refers to nothing.
pub fn is_nothing<T>(index: Index<T>) -> bool {
    index.value() == NOTHING as usize
}

/// An element of any kind that refers to nothing.
fn stand_in() -> Value {
    json!({
        "componentType": 0, "count": 0, "type": "", "byteLength": 0, "buffer": NOTHING,
        "channels": [], "samplers": [], "primitives": [], "nodes": [], "joints": [], "name": "",
    })
}

/// A channel or a sampler of an animation that refers to nothing.
fn stand_in_of_animation() -> Value {
    json!({
        "sampler": NOTHING, "target": {"node": NOTHING, "path": ""}, "input": NOTHING,
        "output": NOTHING,
    })
}

/// Members that are read in double precision, or as 64-bit numbers.
const WIDE: [&str; 7] = ["byteLength", "byteOffset", "count", "matrix", "rotation", "scale", "translation"];

/// Texts that are never worth an error.
const TEXT: [&str; 3] = ["copyright", "generator", "name"];

/// Settles differences between JSON and `gltf`'s types: whole numbers may be written as 3.0; a name may be anything; a
/// scene needs no nodes, a channel no node. A number that its type would silently truncate becomes a text that says
/// so, which no type accepts.
pub fn settle(value: &mut Value, key: &str) {
    match value {
        Value::Number(number) => {
            let x = number.as_f64().unwrap_or_default();
            if number.is_f64() && (0.0..=f64::from(u32::MAX)).contains(&x) && x.fract() == 0.0 {
                *value = Value::from(x as u64);
            } else if WIDE.contains(&key) {
            } else if number.is_u64() && x > f64::from(u32::MAX) {
                *value = Value::from(format!("{number}, more than 32 bits hold"));
            } else if x.abs() > f64::from(f32::MAX) {
                *value = Value::from(format!("{number}, beyond single precision"));
            }
        }
        Value::Array(array) => array.iter_mut().for_each(|value| settle(value, key)),
        Value::Object(object) => {
            if key == "scenes" {
                object.entry("nodes").or_insert(json!([]));
            } else if key == "target" && object.contains_key("path") {
                object.entry("node").or_insert(json!(NOTHING));
            }
            object.retain(|key, value| !TEXT.contains(&key.as_str()) || value.is_string());
            object.iter_mut().for_each(|(key, value)| settle(value, key));
        }
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}
