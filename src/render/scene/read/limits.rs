//! Bounds on what a small file can blow up to by repeating itself.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use crate::scene::error::Fault;

/// Most triangles of a scene, and most vertices.
pub const MAX_ELEMENTS: u64 = 1 << 27;
/// Most instances of `EXT_mesh_gpu_instancing` in a file.
const MAX_INSTANCES: u64 = 1 << 22;

/// Amounts that were read so far.
#[derive(Debug, Default)]
pub struct Budget {
    vertices: AtomicU64,
    instances: AtomicU64,
}

impl Budget {
    /// Counts vertices, and displacements of vertices, that are about to be read.
    pub fn add_vertices(&self, count: u64, place: &str) -> Result<(), Fault> {
        add(&self.vertices, count, MAX_ELEMENTS, "vertices", place)
    }

    /// Counts instances that are about to be read.
    pub fn add_instances(&self, count: usize, place: &str) -> Result<(), Fault> {
        add(
            &self.instances,
            count as u64,
            MAX_INSTANCES,
            "instances",
            place,
        )
    }
}

fn add(so_far: &AtomicU64, count: u64, limit: u64, what: &str, place: &str) -> Result<(), Fault> {
    let total = so_far.fetch_add(count, Relaxed).saturating_add(count);
    if total <= limit {
        Ok(())
    } else {
        Err(Fault::new(
            place,
            format!("the file's {what} exceed the limit of {limit}; split the scene"),
        ))
    }
}
