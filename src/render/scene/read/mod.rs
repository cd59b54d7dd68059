//! Reads glTF 2.0, and the triangles, lines, points and colours of other formats.
//!
//! Faults in a scene's geometry are errors. Faults in appearance, animation and cameras become warnings: the element
//! is left out or gets its defaults. Unused buffers, accessors, meshes and images are not read at all.

mod accessor;
mod animation;
mod asset;
#[cfg(feature = "basisu")]
mod basis;
#[cfg(not(feature = "basisu"))]
#[path = "no_basis.rs"]
mod basis;
mod buffer;
mod camera;
mod container;
mod described;
#[cfg(feature = "draco")]
mod draco;
#[cfg(not(feature = "draco"))]
#[path = "no_draco.rs"]
mod draco;
mod foreign;
mod image;
mod image_based;
mod instance;
mod light;
mod limits;
mod lobes;
mod material;
mod mesh;
mod meshopt;
mod model;
mod mtl;
mod node;
mod obj;
mod obj_part;
mod packed;
mod ply;
mod ply_data;
mod pointer;
mod polygon;
mod primitive;
mod shape;
mod skin;
mod stl;
mod stl_text;
mod text;
mod texture;
mod texture_file;
mod unread;
mod uri;
mod vertex;

use std::{path::Path, sync::Arc};

use gltf::json::{self, Index};

use accessor::Accessor;
use buffer::Buffers;
pub use described::{AnimatedProperty, Change, Descriptions};
use limits::Budget;
#[cfg(feature = "cli")]
pub use limits::check_texels;
pub use limits::{MAX_DISPLACEMENTS, MAX_ELEMENTS};
use model::Model;

use super::{
    Loaded, Scene, SceneError,
    document::{Document, variants},
    error::{Fault, Warnings},
};

/// Context that all readers share.
struct Context<'a> {
    model: &'a Model,
    /// Index of the selected variant of the materials.
    variant: Option<u32>,
    buffers: Buffers<'a>,
    budget: Budget,
    warnings: Warnings,
}

impl Context<'_> {
    /// The accessor `index`, referred to at the place `from`.
    fn accessor(&self, index: Index<json::Accessor>, from: &str) -> Result<Accessor<'_>, Fault> {
        Accessor::new(self.model, index, from, &self.buffers)
    }

    fn warn(&mut self, fault: &Fault) {
        self.warnings.push(fault);
    }

    /// Turns an error into a warning, which also names the consequence.
    fn tolerate<T>(&mut self, result: Result<Option<T>, Fault>, consequence: &str) -> Option<T> {
        result.unwrap_or_else(|fault| {
            self.warn(&fault.but(consequence));
            None
        })
    }
}

/// Reads a scene from the bytes of a file; the content tells the format. `file` is its name in messages, relative URIs
/// start from `base`, and `variant` names a variant of the materials.
pub fn read(bytes: &[u8], file: &str, base: Option<&Path>, variant: Option<&str>) -> Result<Loaded, SceneError> {
    if container::is_glb(bytes) {
        return read_gltf(bytes, file, base, variant);
    }
    let original = bytes;
    let bytes = &*text::utf8(bytes);
    let mut warnings = Warnings::new(file);
    let (format, drawing) = if stl::is_stl(bytes) {
        ("STL", stl::read(bytes, &mut warnings))
    } else if ply::is_ply(bytes) {
        ("PLY", ply::read(bytes, base, &mut warnings))
    } else if obj::is_obj(bytes) {
        ("OBJ", obj::read(bytes, base, &mut warnings))
    } else if stl::is_named(bytes, file) {
        ("STL", stl::read(bytes, &mut warnings))
    } else {
        return read_gltf(original, file, base, variant);
    };
    let loaded = drawing.and_then(|drawing| drawing.into_scene(format, file, warnings));
    let loaded = loaded.map_err(|fault| fault.into_error(file))?;
    find_variant(&loaded.scene.document.root, variant, file)?;
    Ok(loaded)
}

/// Index of the variant with this name.
fn find_variant(root: &json::Root, variant: Option<&str>, file: &str) -> Result<Option<u32>, SceneError> {
    let Some(asked) = variant else {
        return Ok(None);
    };
    let index = variants(root).position(|name| name == asked);
    let index = index.ok_or_else(|| {
        let names: Vec<String> = variants(root).map(|name| format!("\"{name}\"")).collect();
        SceneError::NoSuchVariant {
            file: file.to_owned(),
            asked: asked.to_owned(),
            known: match names.is_empty() {
                true => "the file has none".to_owned(),
                false => format!("the file has {}", names.join(", ")),
            },
        }
    })?;
    Ok(Some(index as u32))
}

fn read_gltf(bytes: &[u8], file: &str, base: Option<&Path>, variant: Option<&str>) -> Result<Loaded, SceneError> {
    let mut warnings = Warnings::new(file);
    let container = container::open(bytes, file, &mut warnings)?;
    let malformed = |fault: Fault| fault.into_error(file);
    let mut value = container.json;
    model::settle(&mut value, "");
    unread::name(&value, &mut warnings);
    // The version comes first, because a file of another version looks malformed throughout.
    let asset = asset::read(&value, file)?;
    let mut model = Model::new(value, asset, &mut warnings).map_err(malformed)?;
    asset::check_extensions(&model.root, file, &mut warnings)?;
    let mut context = Context {
        model: &model,
        variant: find_variant(&model.root, variant, file)?,
        buffers: Buffers::new(&model, container.binary, base),
        budget: Budget::default(),
        warnings,
    };
    let mut scene = read_scene(&mut context).map_err(malformed)?;
    context.warnings.extend(context.buffers.notes());
    let warnings = context.warnings.into_vec();
    // The buffers are dropped, because data URIs are large and not needed any more.
    model.root.buffers.clear();
    model.root.images.clear();
    scene.document.root = model.root;
    scene.document.file = file.to_owned();
    scene.document.format = "glTF";
    Ok(Loaded { scene, warnings })
}

fn read_scene(context: &mut Context<'_>) -> Result<Scene, Fault> {
    let cameras = camera::read_all(context);
    let lights = light::read_all(context);
    let (nodes, order) = node::read_nodes(context)?;
    let default_scene = node::check_scenes(context, &nodes)?;
    let mut materials = material::read_all(context);
    let (textures, images) = texture::resolve(context, &mut materials);
    let file_materials = materials.len() - 1;
    let environments = image_based::read_all(context);
    let (meshes, unlit_copies) = mesh::read_all(context, &mut materials)?;
    let skins = skin::read_all(context)?;
    skin::check_joints(&context.model.root.nodes, &meshes, &skins)?;
    let (animations, descriptions) = animation::read_all(context, &nodes, &materials);
    Ok(Scene {
        materials,
        textures,
        images,
        environment: None,
        descriptions: Arc::new(descriptions),
        document: Document {
            default_scene,
            nodes,
            order,
            meshes,
            skins,
            animations,
            cameras,
            lights,
            environments,
            file_materials,
            unlit_copies,
            ..Document::default()
        },
    })
}
