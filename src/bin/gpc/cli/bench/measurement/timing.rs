//! Times of the methods, measured in turns.

use super::Spread;
use gpc::camera::Camera;
use gpc::render::{Headless, PassTime, PreparedScene, RenderError, Rendered, SceneFrame, Settings};
use serde::Serialize;
use std::time::{Duration, Instant};

/// Method that takes part in a measurement, warmed up; collects the times of its frames.
pub struct Contender {
    frame: SceneFrame,
    frames: Vec<Timed>,
    spent: Duration,
}

struct Timed {
    wall_ms: f64,
    passes: Vec<PassTime>,
}

/// Cost of a frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// Milliseconds on the device, without the [output of the image](PassTime::is_output).
    pub gpu_ms: Spread,
    /// Wall-clock milliseconds, from recording to the image in host memory.
    pub wall_ms: Spread,
    /// Device time of each pass, in the order in which they run.
    pub passes: Vec<PassCost>,
}

/// Cost of a pass.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PassCost {
    /// Name of the pass.
    pub pass: &'static str,
    /// Milliseconds on the device.
    #[serde(flatten)]
    pub ms: Spread,
}

impl Contender {
    /// Prepares a method and renders a frame that is not timed, because drivers compile shaders during the first
    /// frame.
    ///
    /// # Errors
    /// [`RenderError`] if the settings are impossible, memory runs out or the device is lost.
    pub fn warm_up(
        headless: &mut Headless,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
    ) -> Result<(Self, Rendered), RenderError> {
        let mut frame = headless.prepare(scene, settings)?;
        let rendered = headless.render(&mut frame, camera)?;
        let contender = Self { frame, frames: Vec::new(), spent: Duration::ZERO };
        Ok((contender, rendered))
    }

    /// Settings of the method.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        self.frame.settings()
    }

    fn time_a_frame(&mut self, headless: &mut Headless, camera: &Camera) -> Result<(), RenderError> {
        let start = Instant::now();
        let rendered = headless.render(&mut self.frame, camera)?;
        let wall = start.elapsed();
        self.spent += wall;
        self.frames.push(Timed { wall_ms: 1e3 * wall.as_secs_f64(), passes: rendered.statistics.passes });
        Ok(())
    }

    /// Whether another frame is wanted and fits into the time limit. The first frame is always rendered.
    fn goes_on(&self, repeat: u32, budget: Duration) -> bool {
        let Some(last) = self.frames.last() else {
            return true;
        };
        let expected = self.spent.as_secs_f64() + 1e-3 * last.wall_ms;
        self.frames.len() < repeat as usize && expected <= budget.as_secs_f64()
    }

    /// Cost over the frames so far.
    #[must_use]
    pub fn cost(&self) -> Cost {
        let of_pass = |pass: &str| {
            Spread::of(self.frames.iter().map(|frame| {
                let times = frame.passes.iter().filter(|time| time.pass == pass);
                times.map(|time| time.ms).sum()
            }))
        };
        let total = |frame: &Timed| PassTime::total(&frame.passes);
        let passes = self.frames.first().map_or(&[][..], |frame| &frame.passes);
        Cost {
            gpu_ms: Spread::of(self.frames.iter().map(total)),
            wall_ms: Spread::of(self.frames.iter().map(|frame| frame.wall_ms)),
            passes: passes.iter().map(|time| PassCost { pass: time.pass, ms: of_pass(time.pass) }).collect(),
        }
    }
}

/// Times every contender `repeat` times, in turns. A contender that would need more than `budget` drops out of later
/// rounds, after at least one frame. `progress` is called before each frame.
///
/// # Errors
/// As [`Headless::render`].
pub fn take_turns<'a>(
    headless: &mut Headless,
    camera: &Camera,
    contenders: impl IntoIterator<Item = &'a mut Contender>,
    repeat: u32,
    budget: Duration,
    mut progress: impl FnMut(&Contender),
) -> Result<(), RenderError> {
    let mut contenders: Vec<_> = contenders.into_iter().collect();
    for _ in 0..repeat.max(1) {
        for contender in &mut contenders {
            if contender.goes_on(repeat, budget) {
                progress(contender);
                contender.time_a_frame(headless, camera)?;
            }
        }
    }
    Ok(())
}
