//! Draco meshes where the feature `draco` is off: they are refused.

use super::{Context, packed::Packed, primitive::is_compressed};
use crate::scene::error::Fault;
use gltf::json::mesh::Primitive;

/// Whether the extension is supported.
pub const AVAILABLE: bool = false;

/// `None` where the primitive `item` at `place` is not compressed.
pub fn read(item: &Primitive, place: &str, _: &Context<'_>) -> Result<Option<Packed>, Fault> {
    if !is_compressed(item) {
        return Ok(None);
    }
    Err(Fault::new(
        place,
        "is compressed with KHR_draco_mesh_compression, for which the feature `draco` is needed; \
         decode it with `gltf-transform copy IN OUT`",
    ))
}
