//! Descriptions that animations change (`KHR_animation_pointer`): they are read again with the numbers of each moment.

use gltf::json::{self, Root, camera::Camera, extensions::scene::khr_lights_punctual};
use serde_json::{Value, json};

use super::{
    Context,
    buffer::Buffers,
    camera, light,
    limits::Budget,
    material,
    model::{Element, Model, typed},
};
use crate::scene::{
    document::Described,
    error::{Fault, Warnings},
    light::Light,
    material::{Material, TextureUse},
    view::SceneProjection,
};

/// A JSON pointer, relative to a description and without a leading slash, and the numbers to set there.
pub type Change<'c> = (&'c str, Vec<f64>);

/// What a description says about the image, with the description's index.
#[derive(PartialEq)]
pub enum AnimatedProperty {
    Material(usize, Box<Material>),
    Light(usize, Light),
    Camera(usize, SceneProjection),
}

/// The descriptions of materials, lights and cameras as they are at rest.
#[derive(Clone, Debug, Default)]
pub struct Descriptions {
    model: Model,
}

impl Descriptions {
    /// Collects the descriptions of a document.
    pub fn new(model: &Model) -> Self {
        let all = |place: &str| -> Vec<Value> {
            let elements = model.at(place).and_then(Value::as_array);
            let short = |element: &Value| match weight(element) <= MOST {
                true => element.clone(),
                false => Value::Null,
            };
            elements.into_iter().flatten().map(short).collect()
        };
        let lights = all(khr_lights_punctual::Light::PLACE);
        let value = json!({
            "materials": all(json::Material::PLACE),
            "cameras": all(Camera::PLACE),
            "extensions": {"KHR_lights_punctual": {"lights": lights}},
        });
        let root = Root {
            // Materials refer to these textures.
            textures: model.root.textures.clone(),
            ..Root::default()
        };
        Self { model: Model::of(root, value) }
    }

    /// Reads a description with changes. The textures of a material stay those of the material at rest, among `materials`;
    /// their coordinates may change. The inner error is that of a description which can't be used.
    ///
    /// # Errors
    /// If the description can't have these numbers.
    pub fn read(
        &self,
        described: Described,
        changes: &[Change<'_>],
        materials: &[Material],
        warnings: &mut Warnings,
    ) -> Result<Result<AnimatedProperty, Fault>, Fault> {
        Ok(match described {
            Described::Material(index) => {
                let (item, place) = self.changed::<json::Material>(index, changes)?;
                let read = self.with_context(warnings, |context| material::read(&item, &place, true, context));
                read.map(|mut material| {
                    for (role, slot) in material.texture_slots() {
                        let at_rest = materials
                            .get(index)
                            .and_then(|at_rest| at_rest.textures().find(|(other, _)| *other == role));
                        *slot =
                            slot.zip(at_rest).map(|(used, (_, known))| TextureUse { texture: known.texture, ..used });
                    }
                    AnimatedProperty::Material(index, Box::new(material))
                })
            }
            Described::Light(index) => {
                let (item, place) = self.changed::<khr_lights_punctual::Light>(index, changes)?;
                let read = self.with_context(warnings, |context| light::read(&item, &place, context));
                read.map(|light| AnimatedProperty::Light(index, light))
            }
            Described::Camera(index) => {
                let (item, place) = self.changed::<Camera>(index, changes)?;
                camera::read(&item, &place, &self.model).map(|camera| AnimatedProperty::Camera(index, camera))
            }
        })
    }

    /// Calls `read` with a description, and collects its warnings.
    fn with_context<T>(&self, warnings: &mut Warnings, read: impl FnOnce(&mut Context<'_>) -> T) -> T {
        let mut context = Context {
            model: &self.model,
            variant: None,
            buffers: Buffers::new(&self.model, None, None),
            budget: Budget::default(),
            warnings: warnings.of_the_same_file(),
        };
        let made = read(&mut context);
        warnings.append(context.warnings);
        made
    }

    /// The description at `index` with changes, and its place.
    fn changed<T: Element>(&self, index: usize, changes: &[Change<'_>]) -> Result<(T, String), Fault> {
        let place = format!("{}/{index}", T::PLACE);
        let mut value = self.model.at(&place).cloned().unwrap_or_default();
        if value.is_null() {
            let reason = "has a description that is too long to be read at each moment";
            return Err(Fault::new(place, reason));
        }
        for (pointer, numbers) in changes {
            change(&mut value, pointer, numbers).ok_or_else(|| Fault::new(&place, format!("has no {pointer}")))?;
        }
        Ok((typed(&value, &place)?, place))
    }
}

/// Largest weight of a description, which is read again for each channel and at each moment.
const MOST: usize = 1 << 12;

/// Number of values in a JSON value; a long text counts as several.
fn weight(value: &Value) -> usize {
    const TEXT: usize = 16;
    match value {
        Value::Array(array) => 1 + array.iter().map(weight).sum::<usize>(),
        Value::Object(object) => {
            let members = object.iter();
            let members = members.map(|(key, value)| key.len() / TEXT + weight(value));
            1 + members.sum::<usize>()
        }
        Value::String(text) => 1 + text.len() / TEXT,
        Value::Null | Value::Bool(_) | Value::Number(_) => 1,
    }
}

/// Sets the value at a pointer. Objects that have defaults are created, but extensions are not: a material without the
/// extension stays without its lobe.
fn change(description: &mut Value, pointer: &str, numbers: &[f64]) -> Option<()> {
    const HAVE_DEFAULTS: [&str; 3] = ["extensions", "KHR_texture_transform", "pbrMetallicRoughness"];
    let (parents, last) = pointer.rsplit_once('/').unwrap_or(("", pointer));
    let mut parent = description;
    for name in parents.split('/').filter(|name| !name.is_empty()) {
        if let Value::Object(object) = &mut *parent
            && HAVE_DEFAULTS.contains(&name)
        {
            object.entry(name).or_insert_with(|| json!({}));
        }
        parent = parent.pointer_mut(&format!("/{name}"))?;
    }
    // A number beyond single precision becomes null, which no type accepts.
    let number = |x: &f64| match (*x as f32).is_finite() {
        true => Value::from(*x),
        false => Value::Null,
    };
    let numbers = match numbers {
        [one] => number(one),
        several => several.iter().map(number).collect(),
    };
    match parent {
        Value::Object(object) => drop(object.insert(last.to_owned(), numbers)),
        other => *other.pointer_mut(&format!("/{last}"))? = numbers,
    }
    Some(())
}
