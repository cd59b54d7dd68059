//! Limits for the size of a scene, because a small file can repeat its content.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use crate::scene::error::Fault;

/// Largest number of triangles of a scene, and of vertices.
pub const MAX_ELEMENTS: u64 = 1 << 27;
/// Largest number of displacements of vertices by morph targets in a scene at one moment: the time that a pose takes grows with
/// the product of copies, vertices and targets.
pub const MAX_DISPLACEMENTS: u64 = 1 << 31;
/// Largest number of instances of `EXT_mesh_gpu_instancing` in a file.
const MAX_INSTANCES: u64 = 1 << 22;

/// Number of texels that an image may have whatever its file's size, and number of further texels for each byte of the file,
/// because a header can claim any size.
const FREE_TEXELS: u64 = 1 << 24;
const TEXELS_PER_BYTE: u64 = 1024;

/// Fails if an image file of `bytes` bytes claims more texels than it can reasonably hold.
pub fn check_texels(width: u64, height: u64, bytes: usize) -> Result<(), String> {
    let justified = FREE_TEXELS + TEXELS_PER_BYTE * bytes as u64;
    match width.checked_mul(height) {
        Some(texels) if texels <= justified => Ok(()),
        _ => Err(format!("claims {width} x {height} texels, but has {bytes} bytes")),
    }
}

/// Numbers of elements that were read so far.
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
        add(&self.instances, count as u64, MAX_INSTANCES, "instances", place)
    }
}

fn add(so_far: &AtomicU64, count: u64, limit: u64, what: &str, place: &str) -> Result<(), Fault> {
    let total = so_far.fetch_add(count, Relaxed).saturating_add(count);
    if total <= limit {
        Ok(())
    } else {
        Err(Fault::new(place, format!("the file's {what} exceed the limit of {limit}; split the scene")))
    }
}
