//! The images of a sequence.

use super::args::RenderArgs;
use crate::cli::exit::Usage;

/// A moment or an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// What stands for `{frame}`.
    pub frame: u32,
    /// Seconds into the animation.
    pub time: f64,
    /// Degrees that the camera is turned by.
    pub turn: f64,
}

const MAX_STEPS: u32 = 1_000_000;

/// The steps that the options ask for, at least one.
pub fn steps(args: &RenderArgs) -> Result<Vec<Step>, Usage> {
    let time = args.image.camera.time;
    let still = Step {
        frame: 0,
        time,
        turn: 0.0,
    };
    if let Some(frames) = &args.sequence.frames {
        if frames.end() - frames.start() >= MAX_STEPS {
            return Err(Usage(format!("--frames: at most {MAX_STEPS} at once")));
        }
        let fps = args.sequence.fps;
        let step = |frame| Step {
            frame,
            time: f64::from(frame) / fps,
            ..still
        };
        return Ok(frames.clone().map(step).collect());
    }
    let Some(count) = args.sequence.turntable else {
        return Ok(vec![still]);
    };
    if count > MAX_STEPS {
        return Err(Usage(format!("--turntable: at most {MAX_STEPS} images")));
    }
    let step = |frame| Step {
        frame,
        turn: 360.0 * f64::from(frame) / f64::from(count),
        ..still
    };
    Ok((0..count).map(step).collect())
}
