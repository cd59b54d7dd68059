//! Loading in a separate thread: reading a scene, posing it and uploading it to the device.

use super::engine::Engine;
use super::navigate::Bounds;
use super::photo::Photo;
use super::progress::{LoadStep, Progress};
use crate::cli::render::view::bounds;
use gpc::render::{PreparedScene, SceneRequest, SceneSettings};
use gpc::scene::{AnimationInfo, Edges, Environment, Motion, Pose, PoseRequest, Scene};
use std::path::PathBuf;
use std::sync::Arc;

/// A file to open: its path, and the scene, material variant, animation and time to show.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneSource {
    pub path: PathBuf,
    /// Variant of the materials by name.
    pub variant: Option<String>,
    /// Scene of the file by index, animation by name or index, and time.
    pub request: PoseRequest,
}

/// Appearance of scenes beyond what their files say.
#[derive(Clone, Debug, Default)]
pub struct Appearance {
    /// Environment that replaces the built-in studio.
    pub environment: Option<Arc<Environment>>,
    /// Warnings about the file of the environment.
    pub warnings: Vec<String>,
    /// Edges of meshes that are drawn; `None` for none.
    pub edges: Option<Edges>,
}

/// Contents of an opened file.
pub enum Opened {
    Scene(Arc<LoadedScene>),
    Photo(Photo),
}

/// A scene on the device, and the data about it that the window needs.
pub struct LoadedScene {
    pub source: SceneSource,
    pub scene: Scene,
    /// First pose that is shown.
    pub pose: Pose,
    pub prepared: Arc<PreparedScene>,
    /// Motion of the scene, if it has animations.
    pub motion: Option<Motion>,
    pub animations: Vec<AnimationInfo>,
    pub bounds: Bounds,
    /// Warnings: parts of the file that can't be shown.
    pub warnings: Vec<String>,
    /// Engine whose device the scene uses; dropped after the scene.
    pub engine: Arc<Engine>,
}

impl LoadedScene {
    /// Index of the animation that is played.
    pub fn animation(&self) -> usize {
        let Some(asked) = &self.source.request.animation else {
            return 0;
        };
        let named = |animation: &AnimationInfo| animation.name.as_ref() == Some(asked);
        let index = self.animations.iter().position(named);
        index.or_else(|| asked.parse().ok()).unwrap_or(0)
    }
}

impl SceneSource {
    /// Source for the file's default scene at the start of its animation.
    pub fn new(path: PathBuf) -> Self {
        Self { path, variant: None, request: PoseRequest::default() }
    }

    /// Reads a scene and prepares it for pictures with these settings, or reads a photograph.
    pub fn open(
        &self,
        engine: Arc<Engine>,
        appearance: &Appearance,
        settings: &SceneSettings,
        progress: &Progress,
    ) -> anyhow::Result<Opened> {
        let is_photo = gpc::output::is_image(&self.path);
        progress.begin(LoadStep::Read)?;
        if is_photo {
            return Ok(Opened::Photo(Photo::open(&self.path)?));
        }
        let mut loaded = match &self.variant {
            Some(variant) => Scene::load_variant(&self.path, variant)?,
            None => Scene::load(&self.path)?,
        };
        if appearance.environment.is_some() {
            loaded.scene.environment = appearance.environment.clone();
        }
        if let Some(edges) = &appearance.edges {
            loaded.scene.add_edges(edges);
        }
        progress.begin(LoadStep::Pose)?;
        let animations = loaded.scene.info().animations;
        let (pose, motion) = if animations.is_empty() {
            (loaded.scene.pose(&self.request)?, None)
        } else {
            let (pose, motion) = loaded.scene.pose_in_motion(&self.request)?;
            (pose, Some(motion))
        };
        progress.begin(LoadStep::Prepare)?;
        let request = SceneRequest::new(&loaded.scene, &pose)
            .moving(motion.as_ref())
            .shadowed(settings.shadows)
            .within(settings.max_memory);
        let prepared = engine.headless()?.upload(request)?;
        let warnings = loaded.warnings.iter().chain(&pose.warnings).chain(&appearance.warnings);
        let warnings: Vec<_> = warnings.map(ToString::to_string).collect();
        Ok(Opened::Scene(Arc::new(LoadedScene {
            source: self.clone(),
            scene: loaded.scene,
            bounds: bounds(&pose),
            pose,
            motion,
            animations,
            prepared: Arc::new(prepared),
            warnings,
            engine,
        })))
    }

    /// The file name.
    pub fn name(&self) -> String {
        let name = self.path.file_name().unwrap_or(self.path.as_os_str());
        name.to_string_lossy().into_owned()
    }
}
