//! A device with one scene on it, rendering image after image.

use crate::cli::report::Device;
use gpc::camera::Camera;
use gpc::render::{
    Frame, Headless, HeadlessOptions, PassTime, PreparedScene, RenderError, Rendered, Settings,
};
use gpc::scene::{Pose, Scene};
use gpc::vulkan::VulkanError;
use std::time::Instant;

/// Renders with the same settings until it is dropped.
pub struct Session {
    headless: Headless,
    settings: Settings,
    shown: Option<(PreparedScene, Frame)>,
}

/// An image, and the times of all renderings that it took.
pub struct Shot {
    pub rendered: Rendered,
    /// Times of the passes, a list for each rendering.
    pub passes: Vec<Vec<PassTime>>,
    /// Wall-clock milliseconds of each rendering, from recording to the image in host memory.
    pub wall_ms: Vec<f64>,
}

/// Opens a device by part of its name, or the best one; under the validation layer where the environment says so.
pub fn open(device: Option<String>) -> Result<Headless, VulkanError> {
    let validation = std::env::var_os("GPC_VALIDATION").is_some_and(|value| !value.is_empty());
    Headless::new(&HeadlessOptions { device, validation })
}

impl Session {
    /// Opens a device by part of its name, or the best one.
    pub fn new(device: Option<String>, settings: Settings) -> Result<Self, VulkanError> {
        Ok(Self {
            headless: open(device)?,
            settings,
            shown: None,
        })
    }

    /// The device.
    pub fn device(&self) -> Device {
        Device::of(&self.headless)
    }

    /// Puts a pose on the device in place of the one before.
    pub fn show(&mut self, scene: &Scene, pose: &Pose) -> Result<(), RenderError> {
        // The memory of the pose before is free for this one.
        self.shown = None;
        let prepared = self
            .headless
            .upload(scene, pose, self.settings.max_memory)?;
        let frame = self.headless.prepare(&prepared, &self.settings)?;
        self.shown = Some((prepared, frame));
        Ok(())
    }

    /// Renders what is shown: once, or with `repeat` once unmeasured and then so many times.
    pub fn shoot(&mut self, camera: &Camera, repeat: Option<u32>) -> anyhow::Result<Shot> {
        let Some((scene, frame)) = &mut self.shown else {
            anyhow::bail!("nothing was put on the device to render");
        };
        if repeat.is_some() {
            self.headless.render(scene, frame, camera)?;
        }
        let mut passes = Vec::new();
        let mut wall_ms = Vec::new();
        loop {
            let start = Instant::now();
            let rendered = self.headless.render(scene, frame, camera)?;
            wall_ms.push(1e3 * start.elapsed().as_secs_f64());
            passes.push(rendered.statistics.passes.clone());
            if passes.len() >= repeat.unwrap_or(1) as usize {
                return Ok(Shot {
                    rendered,
                    passes,
                    wall_ms,
                });
            }
        }
    }

    /// What the validation layer has said, if it was asked.
    pub fn validation_messages(&self) -> Vec<String> {
        self.headless.validation_messages()
    }
}
