//! Trace of recorded dispatches, on request.

use super::{Access, Gpu, Interface, Pipeline};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// Size of a dispatch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Dispatched {
    /// Number of workgroups, known to the host.
    Workgroups(u64),
    /// Index of the vector in the buffer of indirect dispatches from which the device reads the size.
    Indirect(u32),
    /// Draw of triangles.
    Drawn,
}

/// A dispatch, or consecutive draws of the same pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Dispatch {
    pub interface: &'static Interface,
    pub size: Dispatched,
}

/// Dispatches that were recorded on a device while a trace is requested.
#[derive(Default)]
pub(crate) struct Trace {
    is_asked: AtomicBool,
    dispatches: Mutex<Vec<Dispatch>>,
}

impl Trace {
    /// Whether a trace is requested.
    pub fn is_asked(&self) -> bool {
        self.is_asked.load(Ordering::Relaxed)
    }

    fn add(&self, dispatch: Dispatch) {
        let mut dispatches = self
            .dispatches
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        if dispatches.last() != Some(&dispatch) || dispatch.size != Dispatched::Drawn {
            dispatches.push(dispatch);
        }
    }
}

impl Gpu {
    /// Calls `record`, and returns the dispatches that were recorded on the device in the meantime, by any thread.
    pub(crate) fn traced<T>(&self, record: impl FnOnce() -> T) -> (T, Vec<Dispatch>) {
        self.trace.is_asked.store(true, Ordering::Relaxed);
        let made = record();
        self.trace.is_asked.store(false, Ordering::Relaxed);
        let dispatches = &self.trace.dispatches;
        let mut dispatches = dispatches.lock().unwrap_or_else(PoisonError::into_inner);
        (made, std::mem::take(&mut *dispatches))
    }

    pub(super) fn trace(&self, pipeline: &Pipeline, size: Dispatched) {
        if let Some(interface) = pipeline.interface() {
            self.trace.add(Dispatch { interface, size });
        }
    }
}

impl Interface {
    /// Names of the data with this access, in the order of bindings. Data with two bindings, a texel buffer for
    /// reading and a storage buffer for writing, has one name.
    pub(crate) fn data(&self, access: Access) -> Vec<&'static str> {
        let wanted = self
            .uses
            .iter()
            .filter(|used| used.access == access || used.access == Access::ReadWrite);
        let mut names: Vec<&'static str> = Vec::new();
        for name in wanted.map(|used| used.binding.name.trim_end_matches("_out")) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }
}
