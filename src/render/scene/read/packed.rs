//! Decoded streams of a compressed primitive, which replace its accessors.

use std::collections::BTreeMap;

use gltf::json::accessor::ComponentType;

/// A primitive's triangles and attributes.
#[derive(Debug)]
pub struct Packed {
    /// Three a triangle.
    pub indices: Stream,
    /// Streams by attribute name, with one value a vertex.
    pub attributes: BTreeMap<String, Stream>,
}

/// Values one after the other.
#[derive(Debug)]
pub struct Stream {
    /// The bytes.
    pub bytes: Vec<u8>,
    /// Number of values.
    pub count: usize,
    /// Type of the components.
    pub component: ComponentType,
    /// Components of a value.
    pub components: usize,
}
