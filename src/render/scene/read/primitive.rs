//! Mesh primitives (glTF 2.0, section 3.7.2), reduced to triangles, points and lines and the vertices that they use.

use rayon::prelude::*;

use gltf::json::{
    self, Index,
    accessor::ComponentType,
    mesh::{self, Mode, Semantic},
    validation::Checked,
};

use super::{
    Context,
    accessor::Accessor,
    draco,
    vertex::{self, attribute_of},
};
use crate::scene::{
    document::Primitive,
    error::Fault,
    material::Material,
    surface::{
        normals::{is_usable, mend_normals},
        strokes::{self, Strokes},
        tangent, triangles,
    },
};

/// Reads the primitive `item` at `place`. Faults that can be mended or left out become notes; others are errors.
/// `None` if nothing of it can be drawn; a note says why.
pub fn read(
    item: &mesh::Primitive,
    place: &str,
    context: &Context<'_>,
    materials: &[Material],
    notes: &mut Vec<Fault>,
) -> Result<Option<Primitive>, Fault> {
    let mode = context.model.valid(&item.mode, &format!("{place}/mode"))?;
    let attributes = format!("{place}/attributes");
    let Some(positions) = attribute_of(item, Semantic::Positions) else {
        let reason = "there is no POSITION; the primitive is left out";
        notes.push(Fault::new(attributes, reason));
        return Ok(None);
    };
    let positions = context.accessor(positions, &format!("{attributes}/POSITION"));
    let packed = match (draco::read(item, place, context), &positions) {
        // The file also has uncompressed data for programs that can't decode it.
        (Err(fault), Ok(positions)) if !positions.is_void() => {
            notes.push(fault.but("the uncompressed data are used"));
            None
        }
        (packed, _) => packed?,
    };
    let reader = vertex::Reader { primitive: item, place, packed: packed.as_ref(), context, count: 1 };
    let positions = match reader.packed(Semantic::Positions) {
        Some(positions) => positions?,
        None => positions?,
    };
    let positions = positions.expect_components(&[3])?;
    let reader = vertex::Reader { count: positions.count, ..reader };
    // The last material is glTF's default; no index of the file refers to it.
    let default_material = materials.len().saturating_sub(1);
    let (chosen, material_place) = choose_material(item, place, context);
    let material_index = match context.model.check(&chosen, &material_place) {
        Ok(()) => chosen.map_or(default_material, |index| index.value()),
        Err(fault) => {
            notes.push(fault);
            default_material
        }
    };
    let material = materials.get(material_index).cloned().unwrap_or_default();

    let targets = item.targets.as_deref().unwrap_or_default();
    // Decoded data is always a list of triangles.
    let mode = reader.packed.map_or(mode, |_| Mode::Triangles);
    let is_strokes = strokes::are_made_of(mode);
    let shape = if is_strokes {
        let strokes = read_strokes(&reader, mode, &positions, notes)?;
        strokes.map(|(strokes, sources)| (strokes.triangles, strokes.corners, sources))
    } else {
        let read = read_triangles(&reader, mode, &positions, notes)?;
        read.map(|(triangles, sources)| (triangles, Vec::new(), sources))
    };
    let Some((mut triangles, corners, mut sources)) = shape else {
        return Ok(None);
    };
    // Whether there are normals is not known yet. Without normals, no two triangles share a vertex.
    let most = match is_strokes {
        true => sources.len(),
        false => sources.len().max(triangles.len() * 3),
    } as u64;
    context.budget.add_vertices(most * (1 + targets.len() as u64), place)?;

    let normals = reader.attribute(Semantic::Normals, &[3], &vertex::SIGNED, notes);
    let mut normals: Vec<[f32; 3]> = normals.map_or_else(Vec::new, |accessor| gather(&accessor, &sources));
    let shape = gather(&positions, &sources);
    if is_strokes && !normals.iter().all(is_usable) {
        let reason = "some normals are unusable; none is used, and what is drawn is unlit";
        notes.push(Fault::new(attributes.as_str(), reason));
        normals.clear();
    }
    match mend_normals(&triangles, &shape, &mut normals) {
        0 => {}
        mended => notes.push(Fault::new(
            attributes,
            format!("{mended} of the normals are unusable and replaced by those of the faces"),
        )),
    }
    let shape = if normals.is_empty() && !is_strokes {
        sources = triangles.as_flattened().iter().filter_map(|&v| sources.get(v as usize).copied()).collect();
        triangles = (0..triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        gather(&positions, &sources)
    } else {
        shape
    };

    let tangent_uv_set = material.tangent_uv_set();
    let given = tangent_uv_set.and_then(|_| reader.tangents(&normals, &sources, notes));
    let generated_from = tangent_uv_set.filter(|_| given.is_none() && !is_strokes);
    let mut primitive = Primitive {
        material: material_index,
        triangles,
        positions: shape,
        normals,
        tangents: given.unwrap_or_default(),
        uvs: reader.uvs(&material, generated_from, &sources, notes),
        colors: reader.colors(&sources, notes),
        targets: reader.targets(targets, &sources, notes),
        influences: reader.influences(&sources, notes),
        corners,
        edges: Vec::new(),
    };
    if let Some(uv_set) = generated_from {
        tangent::generate(&mut primitive, uv_set);
    }
    Ok(Some(primitive))
}

pub(super) fn is_compressed(item: &mesh::Primitive) -> bool {
    let extensions = item.extensions.as_ref();
    extensions.is_some_and(|e| e.others.contains_key("KHR_draco_mesh_compression"))
}

/// Material of the selected variant, or otherwise the primitive's own, and the place of the reference to it.
fn choose_material(
    item: &mesh::Primitive,
    place: &str,
    context: &Context<'_>,
) -> (Option<Index<json::Material>>, String) {
    let extensions = item.extensions.as_ref();
    let variants = extensions.and_then(|e| e.khr_materials_variants.as_ref());
    let mappings = variants.map_or(&[][..], |variants| &variants.mappings);
    let mapped = |wanted: u32| mappings.iter().position(|m| m.variants.contains(&wanted));
    match context.variant.and_then(mapped) {
        Some(i) => {
            let place = format!("{place}/extensions/KHR_materials_variants/mappings/{i}/material");
            (Some(Index::new(mappings[i].material)), place)
        }
        None => (item.material, format!("{place}/material")),
    }
}

/// Largest number of triangles to which `item` can expand, without reading its data; 0 if reading will fail.
pub fn claimed_triangles(item: &mesh::Primitive, context: &Context<'_>) -> u64 {
    let defining = item.indices.or_else(|| attribute_of(item, Semantic::Positions));
    if is_compressed(item) {
        // The accessors declare the count, without any data.
        let accessor = defining.and_then(|index| context.model.root.get(index));
        return accessor.map_or(0, |accessor| accessor.count.0 / 3);
    }
    let accessor = defining.map(|index| context.accessor(index, ""));
    match (item.mode, accessor) {
        (Checked::Valid(mode), Some(Ok(accessor))) if accessor.check_justified().is_ok() => {
            let (of_surfaces, of_strokes) = (triangles::number, strokes::number);
            (of_surfaces(mode, accessor.count) + of_strokes(mode, accessor.count)) as u64
        }
        _ => 0,
    }
}

/// Elements of `accessor` with the indices `sources`.
pub fn gather<const N: usize>(accessor: &Accessor<'_>, sources: &[u32]) -> Vec<[f32; N]> {
    sources.par_iter().with_min_len(16_384).map(|&source| accessor.floats(source as usize)).collect()
}

/// Index of each vertex that a primitive passes through, by its indices or in order, and the number of these vertices.
fn read_indices<'a>(
    reader: &vertex::Reader<'a, '_>,
    positions: &Accessor<'_>,
) -> Result<(impl Fn(usize) -> u32 + use<'a>, usize), Fault> {
    let place = reader.place;
    let indices = match reader.packed {
        Some(packed) => Some(Accessor::of_stream(&packed.indices, false, place)),
        None => reader.primitive.indices.map(|index| {
            let accessor = reader.context.accessor(index, &format!("{place}/indices"));
            accessor?.expect_components(&[1])
        }),
    };
    let indices = indices
        .transpose()?
        .map(|indices| indices.expect_type(&[ComponentType::U8, ComponentType::U16, ComponentType::U32]));
    let indices = indices.transpose()?;
    let defining = indices.as_ref().unwrap_or(positions);
    defining.check_justified()?;
    let count = defining.count;
    let index = move |place: usize| match &indices {
        Some(indices) => {
            let [index] = indices.integers(place);
            index
        }
        None => place as u32,
    };
    Ok((index, count))
}

/// Points or lines that can be drawn, and the file's vertices that they use.
fn read_strokes(
    reader: &vertex::Reader<'_, '_>,
    mode: Mode,
    positions: &Accessor<'_>,
    notes: &mut Vec<Fault>,
) -> Result<Option<(Strokes, Vec<u32>)>, Fault> {
    let (index, count) = read_indices(reader, positions)?;
    let position = |v: u32| positions.floats::<3>(v as usize);
    let bound = positions.count as u32;
    let usable = |v: u32| v < bound && position(v).iter().all(|x| x.is_finite());
    let path: Vec<Option<u32>> = (0..count).map(index).map(|v| Some(v).filter(|v| usable(*v))).collect();
    let lost = path.iter().filter(|vertex| vertex.is_none()).count();
    if lost > 0 {
        let reason = format!(
            "{lost} of {count} vertices are beyond the {bound} of POSITION, infinite or undefined, and are left out"
        );
        notes.push(Fault::new(reader.place, reason));
    }
    if mode == Mode::Lines && count % 2 > 0 {
        let reason = format!("1 of {count} indices makes no line and is left out");
        notes.push(Fault::new(reader.place, reason));
    }
    // Vertices in the same place may separate if a morph target moves them.
    let is_rigid = reader.primitive.targets.is_none();
    let mut strokes = strokes::assemble(mode, &path, |a, b| a == b || (is_rigid && position(a) == position(b)));
    let sources = strokes.compact(positions.count);
    Ok((!strokes.corners.is_empty()).then_some((strokes, sources)))
}

type Triangles = Vec<[u32; 3]>;

/// Triangles that can be drawn, and the file's vertices that they use.
fn read_triangles(
    reader: &vertex::Reader<'_, '_>,
    mode: Mode,
    positions: &Accessor<'_>,
    notes: &mut Vec<Fault>,
) -> Result<Option<(Triangles, Vec<u32>)>, Fault> {
    let (item, place) = (reader.primitive, reader.place);
    let (index, count) = read_indices(reader, positions)?;
    let (mut triangles, left_over) = triangles::assemble(mode, count, index);
    if left_over > 0 {
        let reason = format!("{left_over} of {count} indices make no triangle and are left out");
        notes.push(Fault::new(place, reason));
    }

    let all = triangles.len();
    let bound = positions.count as u32;
    triangles.retain(|triangle| triangle.iter().all(|&v| v < bound));
    if triangles.len() < all {
        let beyond = all - triangles.len();
        let place = match item.indices {
            Some(_) => format!("{place}/indices"),
            None => place.to_owned(),
        };
        let reason = format!("{beyond} of {all} triangles refer to vertices beyond the {bound} of POSITION");
        if triangles.is_empty() {
            return Err(Fault::new(place, reason));
        }
        notes.push(Fault::new(place, reason + " and are left out"));
    }
    let mut sources = triangles::compact(&mut triangles, positions.count);

    let usable: Vec<bool> = sources
        .par_iter()
        .with_min_len(16_384)
        .map(|&v| positions.floats::<3>(v as usize).iter().all(|x| x.is_finite()))
        .collect();
    if usable.contains(&false) {
        let all = triangles.len();
        triangles.retain(|t| t.iter().all(|&v| usable.get(v as usize) == Some(&true)));
        notes.push(positions.fault(format!(
            "{} of {all} triangles have infinite or undefined positions and are left out",
            all - triangles.len()
        )));
        let kept = triangles::compact(&mut triangles, sources.len());
        sources = kept.iter().filter_map(|&v| sources.get(v as usize).copied()).collect();
    }
    Ok((!triangles.is_empty()).then_some((triangles, sources)))
}
