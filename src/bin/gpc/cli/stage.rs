//! A scene on a device and one camera, for the commands that choose their own sampling locations.

use super::exit::usage;
use super::render::image::ImageArgs;
use super::render::{self, RenderedImage};
use super::report::{DeviceReport, Effort, Figures};
use super::values::Background;
use gpc::camera::{Camera, Pinhole, SampleLocation};
use gpc::render::{Headless, PreparedScene, Settings};
use serde::Serialize;
use std::path::Path;
use std::time::Instant;

/// A scene on a device, the camera that samples it, and the settings.
pub struct RenderSetup {
    pub headless: Headless,
    pub scene: PreparedScene,
    pub camera: Camera,
    pub settings: Settings,
    /// Warnings: parts of the scene that could not be shown.
    warnings: Vec<String>,
}

impl RenderSetup {
    /// Loads a scene, poses it and uploads it.
    pub fn open(path: &Path, image: &ImageArgs, settings: Settings) -> anyhow::Result<Self> {
        if image.background == Background::Environment {
            usage!("--background environment: this command shows none; `gpc render` does");
        }
        let (mut headless, (loaded, pose, warnings, camera)) = render::open_beside(&image.device.options(), || {
            let loaded = image.load(path)?;
            let pose = image.pose(&loaded, image.camera.time)?;
            let warnings: Vec<_> = loaded.warnings.iter().chain(&pose.warnings).cloned().collect();
            for warning in &warnings {
                log::warn!("{warning}");
            }
            let [width, height] = image.size.map(f64::from);
            let views = render::choose_views(&image.camera, &pose, width / height)?;
            let [view] = views.as_slice() else {
                usage!("--camera all: this command takes one camera");
            };
            let camera = view.camera;
            Ok((loaded, pose, warnings, camera))
        })?;
        let scene = render::upload(&mut headless, &loaded.scene, (&pose, None), &settings)?;
        Ok(Self { headless, scene, camera, settings, warnings })
    }

    /// The camera's pinhole for an image of the size asked for.
    pub fn pinhole(&self) -> anyhow::Result<Pinhole> {
        Ok(Pinhole::from_camera(&self.camera, self.settings.size)?)
    }

    /// Renders an image of `size` = [width, height]; each pixel is sampled at a location of a pinhole.
    pub fn render(&mut self, size: [u32; 2], rig: &[(Pinhole, Vec<SampleLocation>)]) -> anyhow::Result<RenderedImage> {
        let start = Instant::now();
        let settings = self.settings.clone().size(size);
        let rendered = self.headless.render_locations(&self.scene, rig, &settings)?;
        Ok(RenderedImage {
            passes: vec![rendered.statistics.passes.clone()],
            wall_ms: vec![1e3 * start.elapsed().as_secs_f64()],
            rendered,
        })
    }

    /// Figures of an image that was written to `output`; `more` holds the figures that only this command has.
    pub fn figures<T: Serialize>(&self, output: &Path, size: [u32; 2], effort: Effort, more: T) -> Figures<T> {
        Figures {
            output: output.display().to_string(),
            device: DeviceReport::of(&self.headless),
            size,
            effort,
            more,
            warnings: self.warnings.clone(),
        }
    }

    /// Fails if the validation layer is on and has reported a message.
    pub fn finish(&self) -> anyhow::Result<()> {
        render::check_validation(&self.headless)
    }
}
