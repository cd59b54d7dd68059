//! Decoded streams of a compressed primitive, used instead of its accessors.

use std::collections::BTreeMap;

use gltf::json::accessor::ComponentType;

/// A primitive's triangles and attributes.
#[derive(Debug)]
pub struct Packed {
    /// Indices, three for each triangle.
    pub indices: Stream,
    /// Streams by attribute name, with a value for each vertex.
    pub attributes: BTreeMap<String, Stream>,
}

/// Consecutive values.
#[derive(Debug)]
pub struct Stream {
    /// The bytes.
    pub bytes: Vec<u8>,
    /// Number of values.
    pub count: usize,
    /// Type of the components.
    pub component: ComponentType,
    /// Number of components of a value.
    pub components: usize,
}
