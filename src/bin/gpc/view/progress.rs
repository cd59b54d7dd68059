//! Progress of loading, which can also be cancelled.

use anyhow::bail;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Steps of loading, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadStep {
    Read,
    Pose,
    Prepare,
}

impl LoadStep {
    const ALL: [Self; 3] = [Self::Read, Self::Pose, Self::Prepare];

    /// Name of the step in the window.
    pub fn name(self) -> &'static str {
        match self {
            Self::Read => "reading the file",
            Self::Pose => "posing the scene",
            Self::Prepare => "uploading it to the device",
        }
    }
}

/// Progress that is shared between the thread that loads and the one that waits.
#[derive(Clone, Debug, Default)]
pub struct Progress(Arc<LoadState>);

#[derive(Debug, Default)]
struct LoadState {
    step: AtomicUsize,
    is_cancelled: AtomicBool,
}

impl Progress {
    /// Begins a step.
    ///
    /// # Errors
    /// If the loading was cancelled.
    pub fn begin(&self, step: LoadStep) -> anyhow::Result<()> {
        if self.0.is_cancelled.load(Ordering::Relaxed) {
            bail!("loading was stopped");
        }
        self.0.step.store(step as usize, Ordering::Relaxed);
        Ok(())
    }

    /// The current step, and the share of all work that is done, 0 to 1.
    pub fn step(&self) -> (LoadStep, f32) {
        let index = self.0.step.load(Ordering::Relaxed);
        let step = LoadStep::ALL.get(index).copied().unwrap_or(LoadStep::Read);
        // A step counts as half done, since nothing tells how far it is.
        let share = (index as f32 + 0.5) / LoadStep::ALL.len() as f32;
        (step, share)
    }

    /// Asks the loading thread to stop at its next step.
    pub fn cancel(&self) {
        self.0.is_cancelled.store(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_go_on_until_nobody_waits() {
        let loads = Progress::default();
        let waits = loads.clone();
        let mut last = 0.0;
        for step in LoadStep::ALL {
            loads.begin(step).unwrap();
            let (found, share) = waits.step();
            assert_eq!(found, step);
            assert!(share > last && share < 1.0);
            last = share;
        }
        waits.cancel();
        assert!(loads.begin(LoadStep::Prepare).is_err());
    }
}
