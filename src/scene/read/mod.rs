//! Reads glTF 2.0.
//!
//! Faults in what a scene's geometry is made of are errors; faults in how it looks, moves or is
//! looked at become warnings, and the element is left out or takes its defaults. Unused buffers,
//! accessors, meshes and images are not read at all.

mod accessor;
mod animation;
mod asset;
mod buffer;
mod camera;
mod container;
mod image;
mod instance;
mod json;
mod light;
mod limits;
mod material;
mod mesh;
mod meshopt;
mod node;
mod primitive;
mod skin;
mod surface;
mod tangent;
mod texture;
mod triangles;
mod uri;
mod vertex;

use std::path::Path;

use accessor::Accessor;
use buffer::Buffers;
use json::Item;
use limits::Budget;
pub use limits::MAX_ELEMENTS;

use super::{
    Loaded, Scene, SceneError,
    document::Document,
    error::{Fault, Warnings},
};

/// What every reader needs.
struct Context<'a> {
    root: Item<'a>,
    accessors: Vec<Item<'a>>,
    buffers: Buffers<'a>,
    budget: Budget,
    warnings: Warnings,
}

impl Context<'_> {
    /// The accessor whose index `item` is.
    fn accessor(&self, item: &Item<'_>) -> Result<Accessor<'_>, Fault> {
        let index = item.as_index("accessors", self.accessors.len())?;
        Accessor::new(&self.accessors[index], &self.buffers)
    }

    fn warn(&mut self, fault: &Fault) {
        self.warnings.push(fault);
    }

    /// Turns an error into a warning that says what follows from it.
    fn tolerate<T>(&mut self, result: Result<Option<T>, Fault>, consequence: &str) -> Option<T> {
        result.unwrap_or_else(|Fault { place, reason }| {
            self.warn(&Fault::new(place, format!("{reason}; {consequence}")));
            None
        })
    }
}

/// Reads a scene from the bytes of a file; `file` is what messages call it, and relative URIs start
/// from `base`.
pub fn read(bytes: &[u8], file: &str, base: Option<&Path>) -> Result<Loaded, SceneError> {
    let container = container::open(bytes, file)?;
    let malformed = |fault: Fault| fault.into_error(file);
    let root = Item::root(&container.json);
    let mut warnings = Warnings::new(file);
    // First, for a file of another version looks malformed throughout.
    let asset = asset::read(&root, file, &mut warnings)?;
    let mut context = Context {
        accessors: root.objects("accessors").map_err(malformed)?,
        buffers: Buffers::new(&root, container.binary, base).map_err(malformed)?,
        budget: Budget::default(),
        warnings,
        root,
    };
    let mut scene = read_scene(&mut context).map_err(malformed)?;
    scene.document.asset = asset;
    scene.document.file = file.to_owned();
    Ok(Loaded {
        scene,
        warnings: context.warnings.into_vec(),
    })
}

fn read_scene(context: &mut Context<'_>) -> Result<Scene, Fault> {
    let cameras = camera::read_all(context)?;
    let lights = light::read_all(context)?;
    let counts = node::Counts {
        nodes: context.root.objects("nodes")?.len(),
        meshes: context.root.objects("meshes")?.len(),
        skins: context.root.objects("skins")?.len(),
        cameras: cameras.len(),
        lights: lights.len(),
    };
    let (nodes, order) = node::read_nodes(context, counts)?;
    let (scenes, default_scene) = node::read_scenes(context, &nodes)?;
    let mut materials = material::read_all(context)?;
    let (textures, images) = texture::resolve(context, &mut materials)?;
    let meshes = mesh::read_all(context, &nodes, &materials)?;
    let skins = skin::read_all(context, &nodes)?;
    skin::check_joints(&nodes, &meshes, &skins)?;
    let animations = animation::read_all(context, &nodes)?;
    Ok(Scene {
        materials,
        textures,
        images,
        document: Document {
            scenes,
            default_scene,
            nodes,
            order,
            meshes,
            skins,
            animations,
            cameras,
            lights,
            ..Document::default()
        },
    })
}
