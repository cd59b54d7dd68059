//! Cancellation of work in another thread.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

/// Flag that is shared between the thread that orders work and the one that does it.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicU8>);

const SUPERSEDED: u8 = 1;
const UNWANTED: u8 = 2;

impl Stop {
    /// Marks the work as superseded by newer work: it may still be of use if it is nearly done.
    pub fn supersede(&self) {
        self.0.fetch_max(SUPERSEDED, Ordering::Relaxed);
    }

    /// Marks the work as unwanted: it is to be abandoned.
    pub fn stop(&self) {
        self.0.fetch_max(UNWANTED, Ordering::Relaxed);
    }

    /// Whether work should not be started any more.
    pub fn is_superseded(&self) -> bool {
        self.0.load(Ordering::Relaxed) >= SUPERSEDED
    }

    /// Whether work that was started should be abandoned.
    pub fn is_unwanted(&self) -> bool {
        self.0.load(Ordering::Relaxed) >= UNWANTED
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_nobody_wants_stays_unwanted() {
        let stop = Stop::default();
        assert!(!stop.is_superseded());
        let other = stop.clone();
        other.supersede();
        assert!(stop.is_superseded() && !stop.is_unwanted());
        other.stop();
        other.supersede();
        assert!(stop.is_unwanted());
    }
}
