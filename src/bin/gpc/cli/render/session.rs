//! A device with one scene on it, rendering image after image.

use super::startup::Clock;
use crate::cli::report::{DeviceReport, Effort};
use gpc::camera::Camera;
use gpc::render::{
    Headless, HeadlessOptions, Method, PassTime, Pixel, PreparedScene, RenderError, Rendered, SceneFrame, SceneRequest,
    Settings, Shadows,
};
use gpc::scene::{Moment, Motion, Pose, Scene};
use std::sync::Arc;
use std::time::Instant;

/// A device that renders one scene with the same settings throughout.
pub struct Session {
    headless: Headless,
    settings: Settings,
    /// Whether images are read back as 8-bit codes.
    reads_codes: bool,
    shown: Option<SceneFrame>,
}

/// An image in linear light, or in 8-bit codes.
pub enum Shot {
    Light(RenderedImage),
    Codes(RenderedImage<[u8; 4]>),
}

/// An image, and the times of all renderings that it took.
pub struct RenderedImage<P = [f32; 4]> {
    pub rendered: Rendered<P>,
    /// Times of the passes, a list for each rendering.
    pub passes: Vec<Vec<PassTime>>,
    /// Wall-clock milliseconds of each rendering, from recording to the image in host memory.
    pub wall_ms: Vec<f64>,
}

impl Shot {
    /// Work and time that the image took, with the settings that it was rendered with.
    pub fn effort(&self, settings: &Settings) -> Effort {
        match self {
            Self::Light(shot) => shot.effort(settings),
            Self::Codes(shot) => shot.effort(settings),
        }
    }

    /// Whether all pixels have the same colour.
    pub fn is_uniform(&self) -> bool {
        match self {
            Self::Light(shot) => is_uniform(&shot.rendered.colors),
            Self::Codes(shot) => is_uniform(&shot.rendered.colors),
        }
    }
}

fn is_uniform<P: PartialEq>(colors: &[P]) -> bool {
    colors.iter().all(|color| Some(color) == colors.first())
}

impl<P> RenderedImage<P> {
    /// Work and time that the image took, with the settings that it was rendered with.
    pub fn effort(&self, settings: &Settings) -> Effort {
        let Rendered { colors, statistics, .. } = &self.rendered;
        Effort::new(settings, statistics, colors.len(), &self.passes, &self.wall_ms)
    }
}

/// Opens a device while `load` runs in parallel. If both fail, the error is that of `load`.
pub fn open_beside<T>(
    device: &HeadlessOptions,
    load: impl FnOnce() -> anyhow::Result<T>,
) -> anyhow::Result<(Headless, T)> {
    std::thread::scope(|threads| {
        let headless = threads.spawn(|| Headless::new(device));
        let loaded = load();
        let headless = headless.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        let loaded = loaded?;
        Ok((headless?, loaded))
    })
}

/// Fails if the validation layer is on and has reported a message.
pub fn check_validation(headless: &Headless) -> anyhow::Result<()> {
    match headless.validation_messages().first() {
        Some(message) => anyhow::bail!("the validation layer says: {message}"),
        None => Ok(()),
    }
}

/// Triangles of the scene for each pixel of the image from which superpixels are likely to take longer than brute force
/// with as many samples: they took .5 of its time with 1, and 1.6 times as long with 8.
const DENSE: f64 = 4.0;

/// Warns of an image that is likely to take longer than by brute force.
fn warn_if_dense(pose: &Pose, settings: &Settings) {
    let [width, height] = settings.size.map(f64::from);
    let triangles = pose.geometry.triangle_count() as f64 / (width * height);
    if triangles >= DENSE && matches!(settings.method, Method::Superpixel(_)) {
        log::warn!(
            "the scene has {triangles:.0} triangles for each pixel, so superpixels may take longer than brute force with as many samples: try --aa ssaa, fewer --samples or a larger --size"
        );
    }
}

/// Uploads a pose, prepared for the motion that is given and for the shadows of the settings.
pub fn upload(
    headless: &mut Headless,
    scene: &Scene,
    (pose, motion): (&Pose, Option<&Motion>),
    settings: &Settings,
) -> Result<PreparedScene, RenderError> {
    if settings.scene.shadows == Shadows::Exact && pose.lights.is_empty() {
        log::warn!("--shadows: the scene has no lights of its own, and so no shadows");
    }
    warn_if_dense(pose, settings);
    headless.upload(
        SceneRequest::new(scene, pose)
            .moving(motion)
            .shadowed(settings.scene.shadows)
            .within(settings.scene.max_memory),
    )
}

impl Session {
    /// Opens a session on a device. Images are read back as 8-bit codes with straight alpha if `reads_codes` is set, otherwise
    /// as light.
    pub fn new(headless: Headless, settings: Settings, reads_codes: bool) -> Self {
        Self { headless, settings, reads_codes, shown: None }
    }

    /// The device.
    pub fn device(&self) -> DeviceReport {
        DeviceReport::of(&self.headless)
    }

    /// Uploads a pose in place of the one before, prepared for the motion that is given, and makes pipelines for it.
    pub fn show(
        &mut self,
        scene: &Scene,
        pose: &Pose,
        motion: Option<&Motion>,
        clock: &mut Clock,
    ) -> Result<(), RenderError> {
        // The memory of the pose before is freed first, so that this one can use it.
        self.shown = None;
        let scene = upload(&mut self.headless, scene, (pose, motion), &self.settings)?;
        clock.lap("upload");
        let frame = if self.reads_codes {
            self.headless.prepare_pixels::<[u8; 4]>(&scene, &self.settings)?
        } else {
            self.headless.prepare(&scene, &self.settings)?
        };
        clock.lap("pipelines");
        self.shown = Some(frame);
        Ok(())
    }

    /// Moves the scene on the device to another moment.
    pub fn show_moment(&mut self, moment: Moment) -> Result<(), RenderError> {
        match &mut self.shown {
            Some(frame) => frame.show(Arc::new(moment)),
            None => Err(RenderError::OtherMotion),
        }
    }

    /// Renders the scene on the device: once, or with `repeat` one unmeasured time and then `repeat` times.
    pub fn shoot(&mut self, camera: &Camera, repeat: Option<u32>) -> anyhow::Result<Shot> {
        Ok(if self.reads_codes {
            Shot::Codes(self.render(camera, repeat)?)
        } else {
            Shot::Light(self.render(camera, repeat)?)
        })
    }

    fn render<P: Pixel>(&mut self, camera: &Camera, repeat: Option<u32>) -> anyhow::Result<RenderedImage<P>> {
        let Some(frame) = &mut self.shown else {
            anyhow::bail!("nothing was put on the device to render");
        };
        if repeat.is_some() {
            self.headless.render_pixels::<P>(frame, camera)?;
        }
        let mut passes = Vec::new();
        let mut wall_ms = Vec::new();
        loop {
            let start = Instant::now();
            let rendered = self.headless.render_pixels::<P>(frame, camera)?;
            wall_ms.push(1e3 * start.elapsed().as_secs_f64());
            passes.push(rendered.statistics.passes.clone());
            if passes.len() >= repeat.unwrap_or(1) as usize {
                return Ok(RenderedImage { rendered, passes, wall_ms });
            }
        }
    }

    /// Fails if the validation layer is on and has reported a message.
    pub fn finish(&self) -> anyhow::Result<()> {
        check_validation(&self.headless)
    }
}
