//! Times of methods and of the camera's variants, measured in turns.

use super::Spread;
use gpc::camera::Camera;
use gpc::render::{Headless, PassTime, PreparedScene, RenderError, Rendered, Settings};
use serde::Serialize;
use std::time::{Duration, Instant};

/// Function that does a piece of work once. Its image is freed after the clock has stopped.
type Work<'a> = dyn FnMut(&mut Headless) -> Result<Rendered, RenderError> + 'a;

/// Work that takes part in a measurement, warmed up; collects the times of its runs.
pub struct Contender<'a> {
    work: Box<Work<'a>>,
    runs: Vec<Timed>,
}

struct Timed {
    wall_ms: f64,
    passes: Vec<PassTime>,
}

/// Cost of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// Milliseconds on the device, without the [output of the image](PassTime::is_output).
    pub gpu_ms: Spread,
    /// Wall-clock milliseconds, from recording to the values in host memory.
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

impl<'a> Contender<'a> {
    /// Takes part with work that was done once already, because drivers compile shaders then.
    pub fn new(work: impl FnMut(&mut Headless) -> Result<Rendered, RenderError> + 'a) -> Self {
        Self { work: Box::new(work), runs: Vec::new() }
    }

    /// Prepares a method and renders a frame that is not timed.
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
        let camera = *camera;
        Ok((Self::new(move |headless| headless.render(&mut frame, &camera)), rendered))
    }

    fn time(&mut self, headless: &mut Headless) -> Result<(), RenderError> {
        let start = Instant::now();
        let rendered = (self.work)(headless)?;
        let wall_ms = 1e3 * start.elapsed().as_secs_f64();
        self.runs.push(Timed { wall_ms, passes: rendered.statistics.passes });
        Ok(())
    }

    /// Whether another run fits into the time limit. The first run always does.
    fn goes_on(&self, budget: Duration) -> bool {
        let spent: f64 = self.runs.iter().map(|run| run.wall_ms).sum();
        self.runs.last().is_none_or(|last| spent + last.wall_ms <= 1e3 * budget.as_secs_f64())
    }

    /// Cost over the runs so far.
    pub fn cost(&self) -> Cost {
        let of_pass = |pass: &str| {
            Spread::of(self.runs.iter().map(|run| {
                let times = run.passes.iter().filter(|time| time.pass == pass);
                times.map(|time| time.ms).sum()
            }))
        };
        let passes = self.runs.first().map_or(&[][..], |run| &run.passes);
        Cost {
            gpu_ms: Spread::of(self.runs.iter().map(|run| PassTime::total(&run.passes))),
            wall_ms: Spread::of(self.runs.iter().map(|run| run.wall_ms)),
            passes: passes.iter().map(|time| PassCost { pass: time.pass, ms: of_pass(time.pass) }).collect(),
        }
    }
}

/// Times every contender `repeat` times, in turns. A contender that would need more than `budget` drops out of later
/// rounds, after at least one run. `progress` is called with a contender's index before each run.
///
/// # Errors
/// As [`Headless::render`].
pub fn take_turns(
    headless: &mut Headless,
    contenders: &mut [Contender<'_>],
    repeat: u32,
    budget: Duration,
    progress: impl Fn(usize),
) -> Result<(), RenderError> {
    for _ in 0..repeat {
        for (index, contender) in contenders.iter_mut().enumerate() {
            if contender.goes_on(budget) {
                progress(index);
                contender.time(headless)?;
            }
        }
    }
    Ok(())
}
