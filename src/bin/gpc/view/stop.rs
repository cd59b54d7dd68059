//! Work that may no longer be wanted while it is done.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

/// Shared by who asked for something and who makes it.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicU8>);

const SUPERSEDED: u8 = 1;
const UNWANTED: u8 = 2;

impl Stop {
    /// Marks the work as superseded by newer work: it may still be of use if it is nearly done.
    pub fn supersede(&self) {
        self.0.fetch_max(SUPERSEDED, Ordering::Relaxed);
    }

    /// Nobody wants it any more.
    pub fn stop(&self) {
        self.0.fetch_max(UNWANTED, Ordering::Relaxed);
    }

    /// Whether the work is not to be begun any more.
    pub fn is_superseded(&self) -> bool {
        self.0.load(Ordering::Relaxed) >= SUPERSEDED
    }

    /// Whether the work is not to be finished, either.
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
