//! Primitives compressed with `KHR_draco_mesh_compression`.

use std::collections::BTreeMap;

use draco_core::{DataType, DecodeLimits, DecoderBuffer, Mesh, MeshDecoder, PointIndex};
use gltf::json::{
    self, Index,
    accessor::ComponentType,
    buffer::View,
    mesh::{Primitive, Semantic},
};

use super::{
    Context, model,
    packed::{Packed, Stream},
    vertex::attribute_of,
};
use crate::scene::error::Fault;

/// Whether the extension is supported.
pub const AVAILABLE: bool = true;

/// The extension's name.
pub const NAME: &str = "KHR_draco_mesh_compression";

/// Largest number of elements for each encoded byte. Equal values take almost no space, so that a valid file may have
/// thousands of elements for each byte.
const ELEMENTS_PER_BYTE: u64 = 65_536;
/// Number of decoded elements that is allowed beyond the declared one, because seams split vertices.
const SLACK: u64 = 1024;
/// Largest number of bytes of a decoded attribute value.
const WIDEST: u64 = 64;

/// The extension object.
#[derive(serde::Deserialize)]
#[serde(rename_all = "camelCase")]
struct DracoExtension {
    buffer_view: Index<View>,
    attributes: BTreeMap<String, u32>,
}

/// Decodes the primitive `item` at `place`; `None` if it is not compressed.
pub fn read(item: &Primitive, place: &str, context: &Context<'_>) -> Result<Option<Packed>, Fault> {
    let others = item.extensions.as_ref().map(|extensions| &extensions.others);
    let Some((compressed, place)) = model::extension::<DracoExtension>(others, NAME, place)? else {
        return Ok(None);
    };
    let fault = |reason: String| Fault::new(place.clone(), reason);
    let view = context.buffers.view(compressed.buffer_view, &format!("{place}/bufferView"))?;

    // The accessors declare the decoded size, so that it can be checked before decoding.
    let claimed = |index: Option<Index<json::Accessor>>| {
        let accessor = index.and_then(|index| context.model.root.get(index));
        accessor.map_or(0, |accessor| accessor.count.0)
    };
    let points = claimed(attribute_of(item, Semantic::Positions));
    let faces = claimed(item.indices) / 3;
    let justified = ELEMENTS_PER_BYTE.saturating_mul(view.bytes.len() as u64);
    if points.max(faces) > justified {
        return Err(fault(format!("{} bytes cannot hold {faces} triangles of {points} vertices", view.bytes.len())));
    }
    let (points, faces) = (2 * points + SLACK, 2 * faces + SLACK);
    let attributes = compressed.attributes.len() as u64;
    let limits = DecodeLimits::default()
        .with_max_points(points)
        .with_max_faces(faces)
        .with_max_decoded_bytes(points * attributes * WIDEST);

    let mut buffer = DecoderBuffer::new(view.bytes).with_limits(limits);
    let mut mesh = Mesh::new();
    MeshDecoder::new()
        .decode(&mut buffer, &mut mesh)
        .map_err(|error| fault(format!("the compressed data are broken: {error}")))?;
    let indices = mesh.faces().iter().flatten();
    let indices: Vec<u8> = indices.flat_map(|index| index.0.to_le_bytes()).collect();
    let mut packed = Packed {
        indices: Stream { bytes: indices, count: 3 * mesh.num_faces(), component: ComponentType::U32, components: 1 },
        attributes: BTreeMap::new(),
    };
    for (name, &id) in &compressed.attributes {
        let stream = stream(&mesh, id).map_err(|reason| {
            let place = format!("{place}/attributes/{name}");
            Fault::new(place, reason)
        })?;
        packed.attributes.insert(name.clone(), stream);
    }
    Ok(Some(packed))
}

/// Values of an attribute, one for each point.
fn stream(mesh: &Mesh, id: u32) -> Result<Stream, String> {
    let attribute =
        mesh.attribute_by_unique_id(id).ok_or_else(|| format!("the compressed data have no attribute {id}"))?;
    let component = match attribute.data_type() {
        DataType::Int8 => ComponentType::I8,
        DataType::Uint8 => ComponentType::U8,
        DataType::Int16 => ComponentType::I16,
        DataType::Uint16 => ComponentType::U16,
        DataType::Uint32 => ComponentType::U32,
        DataType::Float32 => ComponentType::F32,
        other => return Err(format!("glTF has no components of {other:?}")),
    };
    let components = usize::from(attribute.num_components());
    let size = components * component.size();
    let data = attribute.buffer().data();
    let count = mesh.num_points();
    let mut bytes = Vec::new();
    for point in 0..count {
        let index = attribute.mapped_index(PointIndex(point as u32)).0 as usize;
        let start = index.checked_mul(size);
        let value = start.and_then(|start| data.get(start..start + size));
        bytes.extend(value.ok_or_else(|| format!("vertex {point} has no value"))?);
    }
    Ok(Stream { bytes, count, component, components })
}
