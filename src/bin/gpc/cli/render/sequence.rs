//! The images of a sequence.

use super::args::{RenderArgs, SequenceArgs};
use crate::cli::exit::Usage;
use crate::cli::input;
use crate::cli::values::Shard;
use gpc::output::VideoFormat;

/// An image of a sequence: its time and its angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SequenceFrame {
    /// Number that replaces `{frame}` in the output's name.
    pub frame: u32,
    /// Seconds into the animation.
    pub time: f64,
    /// Degrees that the camera is turned by.
    pub turn: f64,
}

const MAX_STEPS: u32 = 1_000_000;

/// Refuses options that need a sequence without one, and options that contradict each other.
pub fn check(args: &RenderArgs) -> Result<(), Usage> {
    let SequenceArgs { frames, fps, turntable, shard } = &args.sequence;
    let standard = input::is_standard(&args.output);
    let refuse = |text: &str| Err(Usage(text.to_owned()));
    if args.format.is_some() && !standard {
        return refuse("--format: OUT's ending decides the format of files; say -o -");
    }
    if fps.is_some() && frames.is_none() && args.format != Some(VideoFormat::Y4m) {
        return refuse("--fps: it says when --frames A..B are, and the rate of --format y4m");
    }
    if shard.is_some() && frames.is_none() && turntable.is_none() {
        return refuse("--shard: it divides --frames A..B or --turntable N");
    }
    if shard.is_some() && standard {
        return refuse("--shard: every N-th frame makes no film; write files, such as -o {frame}.png");
    }
    Ok(())
}

/// The steps of a share: every N-th one, because neighbouring steps cost about the same.
pub fn share(steps: Vec<SequenceFrame>, shard: Option<Shard>) -> Vec<SequenceFrame> {
    let Some(Shard { number, count }) = shard else {
        return steps;
    };
    let (first, count) = (number as usize - 1, count as usize);
    steps.into_iter().skip(first).step_by(count).collect()
}

/// The steps of the whole sequence that the options describe, at least one.
pub fn steps(args: &RenderArgs) -> Result<Vec<SequenceFrame>, Usage> {
    let time = args.image.camera.time;
    let still = SequenceFrame { frame: 0, time, turn: 0.0 };
    if let Some(frames) = &args.sequence.frames {
        if frames.end() - frames.start() >= MAX_STEPS {
            return Err(Usage(format!("--frames: at most {MAX_STEPS} at once")));
        }
        let fps = args.sequence.fps();
        let step = |frame| SequenceFrame { frame, time: f64::from(frame) / fps, ..still };
        return Ok(frames.clone().map(step).collect());
    }
    let Some(count) = args.sequence.turntable else {
        return Ok(vec![still]);
    };
    if count > MAX_STEPS {
        return Err(Usage(format!("--turntable: at most {MAX_STEPS} images")));
    }
    let step = |frame| SequenceFrame { frame, turn: 360.0 * f64::from(frame) / f64::from(count), ..still };
    Ok((0..count).map(step).collect())
}
