//! Scenes: the contents of a file, and their triangles in the pose of one moment.
//!
//! This module does not use Vulkan. [`Scene::load`] reads a file; [`Scene::pose`] turns one of its scenes into
//! [`PosedGeometry`], which a renderer uploads. Positions are in world space, except in large meshes that are drawn many
//! times.
//!
//! ```no_run
//! use gpc::scene::{PoseRequest, Scene};
//!
//! let loaded = Scene::load("ship.glb".as_ref())?;
//! for warning in &loaded.warnings {
//!     eprintln!("{warning}");
//! }
//! let pose = loaded.scene.pose(&PoseRequest::default())?;
//! println!("{} triangles", pose.geometry.triangle_count());
//! # Ok::<(), gpc::scene::SceneError>(())
//! ```
//!
//! OBJ, STL and PLY files are read, too: their triangles, lines, points, normals, base colours and opacities. These
//! formats define no unit, no up axis and no light; positions are taken unchanged.
//!
//! Supported extensions: `KHR_animation_pointer` (into materials, lights and cameras, to the transforms, weights and
//! visibility of nodes and the weights of meshes), `KHR_draco_mesh_compression` and `KHR_texture_basisu` (by the features
//! `draco` and `basisu`, on by default), `KHR_meshopt_compression`, `KHR_lights_punctual`, `KHR_materials_emissive_strength`,
//! `KHR_materials_anisotropy`, `KHR_materials_clearcoat`, `KHR_materials_diffuse_transmission`, `KHR_materials_ior`,
//! `KHR_materials_iridescence`, `KHR_materials_pbrSpecularGlossiness`, `KHR_materials_sheen`, `KHR_materials_specular`,
//! `KHR_materials_transmission` and `KHR_materials_volume` (a tinted layer, neither refracted nor blurred, with a warning),
//! `KHR_materials_unlit`, `KHR_materials_variants`, `KHR_mesh_quantization`, `KHR_node_visibility`, `KHR_texture_transform`,
//! `EXT_lights_image_based`, `EXT_mesh_gpu_instancing`, `EXT_meshopt_compression`, `EXT_texture_webp`. A file that requires
//! another extension is refused.

mod document;
mod edges;
mod environment;
mod error;
mod geometry;
mod info;
mod light;
mod lobes;
mod material;
mod pose;
mod read;
mod stroke;
mod surface;
mod view;

use std::{path::Path, sync::Arc};

pub use edges::Edges;
pub use environment::{Environment, EnvironmentError};
pub(crate) use environment::{Sun, Suns};
pub use error::SceneError;
#[cfg(feature = "cli")]
pub(crate) use error::Warnings;
pub use geometry::{DrawClass, DrawRange, GeometryError, InstanceFault, MeshInstance, PosedGeometry, VertexStreams};
pub use info::{AlphaModes, AnimationInfo, CameraInfo, ImageInfo, SceneInfo, SceneNames};
pub use light::{Light, LightKind};
pub use lobes::{
    Anisotropy, Clearcoat, DiffuseTransmission, Iridescence, Lobes, Sheen, Specular, SpecularGlossiness, Transmission,
};
pub use material::{
    AlphaMode, Filter, Image, Material, Sampler, Texture, TextureRole, TextureTransform, TextureUse, Wrap,
};
pub use pose::{Moment, Motion, Pose, PoseRequest};
pub(crate) use pose::{MotionPart, MovingBounds};
#[cfg(feature = "cli")]
pub(crate) use read::check_texels;
pub use stroke::{Edge, Stroke, StrokePart};
pub use view::{SceneCamera, SceneProjection};

/// A file's content, checked and decoded.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Materials: those of the file in its order, glTF's default material for primitives without one, and unlit copies
    /// for points and lines without normals; never empty.
    pub materials: Vec<Material>,
    /// Textures that materials use.
    pub textures: Vec<Texture>,
    /// Images that textures use.
    pub images: Vec<Image>,
    /// Environment that replaces the file's environment and the built-in studio.
    pub environment: Option<Arc<Environment>>,
    document: document::Document,
    /// Descriptions whose numbers animations change.
    descriptions: Arc<read::Descriptions>,
}

/// A loaded scene, and warnings about its file.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// Loaded scene.
    pub scene: Scene,
    /// Warnings, each a sentence that names the file and the place in it, and says what was left out or replaced, and
    /// why. The last one counts and names what the file has and is not drawn.
    pub warnings: Vec<String>,
}

impl Scene {
    /// Reads a glTF, OBJ, STL or PLY file; the content tells the format. Relative URIs start from the file's folder.
    ///
    /// # Errors
    /// [`SceneError`] if the file can't be read, is in none of these formats, is glTF of a version other than 2.0,
    /// requires an unsupported extension, or if a part that has to be drawn is broken.
    pub fn load(path: &Path) -> Result<Loaded, SceneError> {
        let file = path.display().to_string();
        Self::from_slice(&read_file(path)?, &file, path.parent())
    }

    /// Reads a file as [`load`](Self::load) does, with the materials of the variant called `variant`
    /// (`KHR_materials_variants`).
    ///
    /// # Errors
    /// As [`load`](Self::load), and if the file has no such variant.
    pub fn load_variant(path: &Path, variant: &str) -> Result<Loaded, SceneError> {
        let file = path.display().to_string();
        read::read(&read_file(path)?, &file, path.parent(), Some(variant))
    }

    /// Reads the bytes of a glTF, OBJ, STL or PLY file. `name` stands for the file in messages. Relative URIs start
    /// from the folder `base`; without it, a URI that is needed is an error.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn from_slice(bytes: &[u8], name: &str, base: Option<&Path>) -> Result<Loaded, SceneError> {
        read::read(bytes, name, base, None)
    }

    /// Reads bytes as [`from_slice`](Self::from_slice) does, with the materials of the variant called `variant`
    /// (`KHR_materials_variants`).
    ///
    /// # Errors
    /// As [`load_variant`](Self::load_variant).
    pub fn variant_from_slice(
        bytes: &[u8],
        name: &str,
        base: Option<&Path>,
        variant: &str,
    ) -> Result<Loaded, SceneError> {
        read::read(bytes, name, base, Some(variant))
    }

    /// Makes a scene of materials, without a file and without textures, for [`PosedGeometry`] from another source. glTF's
    /// default material is appended.
    #[must_use]
    pub fn from_materials(mut materials: Vec<Material>) -> Self {
        materials.push(Material::default());
        Self {
            materials,
            textures: Vec::new(),
            images: Vec::new(),
            environment: None,
            document: document::Document::default(),
            descriptions: Arc::default(),
        }
    }

    /// Adds lines along the edges of all meshes: creases, boundaries and, for each camera, silhouettes. The lines move
    /// with the meshes, but creases are determined with the meshes at rest.
    pub fn add_edges(&mut self, edges: &Edges) {
        edges::add(self, edges);
    }

    /// Poses a scene of the file at one moment: its triangles, lights and cameras.
    ///
    /// # Errors
    /// [`SceneError`] if the file has no such scene or animation, or if repeated content makes the scene too large.
    pub fn pose(&self, request: &PoseRequest) -> Result<Pose, SceneError> {
        pose::pose(self, request)
    }

    /// Poses a scene as [`pose`](Self::pose) does, and makes the [`Motion`] that shows other moments of its animation.
    /// Moving meshes are not drawn by instances.
    ///
    /// # Errors
    /// As [`pose`](Self::pose).
    pub fn pose_in_motion(&self, request: &PoseRequest) -> Result<(Pose, Motion), SceneError> {
        pose::pose_in_motion(self, request)
    }

    /// Summary of the file's contents.
    #[must_use]
    pub fn info(&self) -> SceneInfo {
        info::summarize(self)
    }
}

fn read_file(path: &Path) -> Result<Vec<u8>, SceneError> {
    std::fs::read(path)
        .map_err(|source| SceneError::Read { file: path.display().to_string(), source: Arc::new(source) })
}
