//! Trace of recorded commands, on request.

use super::{Access, Gpu, Interface, Pipeline};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

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
pub(crate) struct TracedDispatch {
    pub interface: &'static Interface,
    pub size: Dispatched,
}

/// Commands that were recorded on a device while a trace was requested.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Traced {
    /// Dispatches and draws; of consecutive rounds, only those of the first.
    pub dispatches: Vec<TracedDispatch>,
    /// Number of all dispatches.
    pub dispatch_count: u64,
    /// Number of all barriers.
    pub barrier_count: u64,
}

/// Trace that was requested, with the commands recorded so far.
#[derive(Default)]
pub(crate) struct Trace {
    is_asked: AtomicBool,
    traced: Mutex<Traced>,
}

impl Trace {
    /// Whether a trace is requested.
    pub fn is_asked(&self) -> bool {
        self.is_asked.load(Ordering::Relaxed)
    }

    fn traced(&self) -> MutexGuard<'_, Traced> {
        self.traced.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Gpu {
    /// Calls `record`, and returns the commands that any thread recorded on the device in the meantime.
    pub(crate) fn traced<T>(&self, record: impl FnOnce() -> T) -> (T, Traced) {
        self.trace.is_asked.store(true, Ordering::Relaxed);
        let made = record();
        self.trace.is_asked.store(false, Ordering::Relaxed);
        (made, std::mem::take(&mut *self.trace.traced()))
    }

    /// Adds a dispatch or draw to the trace, and lists it unless it repeats a listed one.
    pub(super) fn trace(&self, pipeline: &Pipeline, size: Dispatched, is_listed: bool) {
        let mut traced = self.trace.traced();
        let is_drawn = size == Dispatched::Drawn;
        traced.dispatch_count += u64::from(!is_drawn);
        let interface = pipeline.interface();
        let dispatch = TracedDispatch { interface, size };
        let continues = is_drawn && traced.dispatches.last() == Some(&dispatch);
        if is_listed && !continues {
            traced.dispatches.push(dispatch);
        }
    }

    /// Adds a barrier to the trace.
    pub(super) fn trace_barrier(&self) {
        self.trace.traced().barrier_count += 1;
    }
}

impl Interface {
    /// Names of the data that the shader accesses in this way, in the order of bindings. Data with two bindings, a
    /// texel buffer for reading and a storage buffer for writing, has one name.
    pub(crate) fn data(&self, access: Access) -> Vec<&'static str> {
        let wanted = self.uses.iter().filter(|used| used.access == access || used.access == Access::ReadWrite);
        let mut names: Vec<&'static str> = Vec::new();
        for name in wanted.map(|used| used.binding.name.trim_end_matches("_out")) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }
}
