//! A scene on the device, and its reference images.

use super::BenchArgs;
use super::measurement::{self, Cache, Contender, Fingerprint};
use super::progress::Progress;
use crate::cli::input;
use crate::cli::render::{NamedView, choose_views};
use gpc::camera::Camera;
use gpc::color::srgb;
use gpc::output::Picture;
use gpc::render::{Headless, MethodKind, PreparedScene, RenderError, Rendered, SceneRequest, Settings};
use gpc::scene::{Pose, PosedGeometry, Scene};
use std::path::Path;
use std::time::Instant;

/// Background colour in sRGB. The background is opaque, so that images differ in colour alone and never in alpha.
const BACKGROUND: [f64; 3] = [0.87, 0.89, 0.91];

/// Device and options for measuring one scene after the other.
pub struct Bench<'a> {
    pub headless: Headless,
    pub cache: Cache,
    pub args: &'a BenchArgs,
    pub progress: Progress,
}

/// A scene on the device, with its source.
pub(super) struct Subject {
    pub prepared: PreparedScene,
    pub scene: Scene,
    pub pose: Pose,
    pub view: NamedView,
}

/// Request for a reference image.
pub(super) struct Wanted<'a> {
    pub prepared: &'a PreparedScene,
    pub geometry: &'a PosedGeometry,
    pub camera: &'a Camera,
    pub settings: &'a Settings,
    /// Samples a pixel.
    pub samples: u32,
    /// Name of the scene for the progress bar.
    pub name: &'a str,
}

impl Bench<'_> {
    /// Loads a scene and uploads it for images of `size` = [width, height].
    pub(super) fn upload(&mut self, path: &Path, size: [u32; 2]) -> anyhow::Result<Subject> {
        let camera = &self.args.camera;
        let loaded = input::load(path, camera.variant.as_deref())?;
        let pose = loaded.scene.pose(&camera.request(camera.time))?;
        let [width, height] = size.map(f64::from);
        let views = choose_views(camera, &pose, width / height)?;
        let Some(view) = views.into_iter().next() else {
            anyhow::bail!("{}: there is no camera to see it with", path.display());
        };
        Ok(Subject {
            prepared: self.headless.upload(SceneRequest::new(&loaded.scene, &pose))?,
            scene: loaded.scene,
            pose,
            view,
        })
    }

    pub(super) fn settings(&self, method: MethodKind, samples: u32) -> Settings {
        settings(method, samples, self.args.size)
    }

    /// A reference image, and the seconds that it took to render; `None` if it came from the cache.
    pub(super) fn reference(&mut self, wanted: &Wanted<'_>) -> anyhow::Result<(Vec<[f32; 4]>, Option<f64>)> {
        let Wanted { prepared, geometry, camera, settings, samples, name } = *wanted;
        self.progress.say(&format!("looking for {name}"));
        let fingerprint = Fingerprint::new(&mut self.headless, prepared, geometry, camera, settings, samples)?;
        if let Some(known) = self.cache.get(fingerprint, settings.size) {
            return Ok((known, None));
        }
        let start = Instant::now();
        let parts = samples / measurement::GRID_SAMPLES;
        let mut done = 0;
        let progress = &self.progress;
        let mut count = || {
            progress.say(&format!("{name}, {done} of {parts} renderings"));
            done += 1;
        };
        count();
        let reference = measurement::brute_force(&mut self.headless, prepared, camera, settings, samples, count)?;
        let seconds = start.elapsed().as_secs_f64();
        let picture = Picture::new(settings.size, &reference)?;
        self.cache.put(fingerprint, &picture)?;
        Ok((reference, Some(seconds)))
    }

    pub(super) fn warm_up(
        &mut self,
        subject: &Subject,
        settings: &Settings,
    ) -> Result<(Contender<'static>, Rendered), RenderError> {
        Contender::warm_up(&mut self.headless, &subject.prepared, &subject.view.camera, settings)
    }

    /// Times contenders as often and as long as the options say. `progress` is called with a contender's index before each run.
    pub(super) fn take_turns(
        &mut self,
        contenders: &mut [Contender<'_>],
        progress: impl Fn(&Progress, usize),
    ) -> Result<(), RenderError> {
        let progress = |index| progress(&self.progress, index);
        measurement::take_turns(&mut self.headless, contenders, self.args.repeat, self.args.budget(), progress)
    }
}

impl Subject {
    pub fn triangles(&self) -> u64 {
        self.pose.geometry.triangle_count()
    }

    /// Whether a visible material has a texture.
    pub fn is_textured(&self) -> bool {
        let draws = self.pose.geometry.draws.iter();
        draws
            .filter_map(|draw| self.scene.materials.get(draw.material as usize))
            .any(|material| material.textures().next().is_some())
    }

    /// Request for a reference image of the whole scene.
    pub fn wanted<'a>(&'a self, settings: &'a Settings, samples: u32, name: &'a str) -> Wanted<'a> {
        Wanted {
            prepared: &self.prepared,
            geometry: &self.pose.geometry,
            camera: &self.view.camera,
            settings,
            samples,
            name,
        }
    }
}

/// Settings of a method.
pub fn settings(method: MethodKind, samples: u32, [width, height]: [u32; 2]) -> Settings {
    Settings::new(width, height)
        .background(Some(BACKGROUND.map(|value| srgb::decode(value) as f32)))
        .method(method.with_samples(samples))
}

/// Name of a scene: its file's name without the ending, or its folder's name if the file is called `scene`, as
/// Sketchfab's files are.
pub(super) fn name(path: &Path) -> String {
    let stem = input::stem(path);
    let folder = || Some(path.parent()?.file_name()?.to_string_lossy().into_owned());
    if stem == "scene" { folder().unwrap_or(stem) } else { stem }
}
