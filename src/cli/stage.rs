//! A scene on a device and one camera, for the commands that choose their own sampling locations.

use super::exit::usage;
use super::input;
use super::render::{self, ImageArgs};
use gpc::camera::{Camera, Pinhole, Site};
use gpc::render::{Headless, PreparedScene, Rendered, Settings};
use std::path::Path;

/// What is sampled, from where, and with which settings.
pub struct Stage {
    pub headless: Headless,
    pub scene: PreparedScene,
    pub camera: Camera,
    pub settings: Settings,
}

impl Stage {
    /// Loads a scene, poses it and puts it on the device.
    pub fn open(path: &Path, image: &ImageArgs, settings: Settings) -> anyhow::Result<Self> {
        let loaded = input::load(path)?;
        let pose = image.pose(&loaded, image.camera.time)?;
        for warning in loaded.warnings.iter().chain(&pose.warnings) {
            log::warn!("{warning}");
        }
        let [width, height] = image.size.map(f64::from);
        let views = render::choose_views(&image.camera, &pose, width / height)?;
        let [view] = views.as_slice() else {
            usage!("--camera all: this command takes one camera");
        };
        let mut headless = render::open(image.device.clone())?;
        let scene = render::upload(&mut headless, &loaded.scene, &pose, &settings)?;
        Ok(Self {
            headless,
            scene,
            camera: view.camera,
            settings,
        })
    }

    /// The camera's pinhole for an image of the size asked for.
    pub fn pinhole(&self) -> anyhow::Result<Pinhole> {
        Ok(Pinhole::from_camera(&self.camera, self.settings.size)?)
    }

    /// Renders an image of `size` pixels that look where the sites of pinholes say.
    pub fn render(
        &mut self,
        size: [u32; 2],
        rig: &[(Pinhole, Vec<Site>)],
    ) -> anyhow::Result<Rendered> {
        Ok(self
            .headless
            .render_sites(&self.scene, rig, size, &self.settings)?)
    }

    /// Fails if the validation layer was asked, and has said anything.
    pub fn finish(&self) -> anyhow::Result<()> {
        match self.headless.validation_messages().first() {
            Some(message) => anyhow::bail!("the validation layer says: {message}"),
            None => Ok(()),
        }
    }
}
