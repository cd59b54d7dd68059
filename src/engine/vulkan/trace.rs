//! What was recorded, for who asks.

use super::{Access, Gpu, Interface, Pipeline};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// How large a dispatch is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Dispatched {
    /// The host knew the number of workgroups.
    Workgroups(u64),
    /// The device reads it from this vector of the buffer of indirect dispatches.
    Indirect(u32),
    /// Triangles are drawn.
    Drawn,
}

/// A dispatch, or draws of the same pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Dispatch {
    pub interface: &'static Interface,
    pub size: Dispatched,
}

/// The dispatches recorded on a device while somebody asks for them.
#[derive(Default)]
pub(crate) struct Trace {
    is_asked: AtomicBool,
    dispatches: Mutex<Vec<Dispatch>>,
}

impl Trace {
    /// Whether dispatches are kept.
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
    /// What is recorded on the device meanwhile, by whatever thread.
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
    /// What is read, or written, in the order of bindings: data that is bound twice, as a texel buffer to be read and as a storage
    /// buffer to be written, has one name.
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
