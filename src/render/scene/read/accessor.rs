//! Accessors (glTF 2.0, section 3.6.2), read element by element from the buffers.
//!
//! No memory is allocated for a mere claim of the file: every element is first checked to lie within its buffer view,
//! and an accessor without data is never expanded.

use gltf::json::{
    Index,
    accessor::{
        Accessor as Description, ComponentType, GenericComponentType, IndexComponentType,
        sparse::Sparse as SparseDescription,
    },
    validation::USize64,
};

use super::{
    buffer::{BufferView, Buffers},
    model::Model,
    packed::Stream,
};
use crate::scene::error::Fault;

/// Elements at equal distances in a buffer.
#[derive(Clone, Copy, Debug)]
struct Elements<'b> {
    bytes: &'b [u8],
    stride: usize,
    size: usize,
}

impl<'b> Elements<'b> {
    /// `count` elements of `size` bytes from `offset` on, checked to lie within `view`.
    fn new(place: &str, view: BufferView<'b>, offset: USize64, count: usize, size: usize) -> Result<Self, Fault> {
        let offset = offset.0 as usize;
        let stride = view.stride.unwrap_or(size);
        if stride < size {
            return Err(Fault::new(
                place,
                format!("elements of {size} bytes do not fit the buffer view's stride of {stride}"),
            ));
        }
        let end = count.saturating_sub(1).checked_mul(stride).and_then(|n| n.checked_add(size)?.checked_add(offset));
        match end.and_then(|end| view.bytes.get(offset..end)) {
            Some(bytes) => Ok(Self { bytes, stride, size }),
            None => Err(Fault::new(
                place,
                format!(
                    "{count} elements of {size} bytes, {stride} apart, at {offset} reach beyond the \
                 {} bytes of the buffer view",
                    view.bytes.len()
                ),
            )),
        }
    }

    /// The bytes of element `i`; empty past the end.
    #[inline]
    fn get(&self, i: usize) -> &'b [u8] {
        let start = i * self.stride;
        self.bytes.get(start..start + self.size).unwrap_or(&[])
    }
}

/// Elements that replace others in a sparse accessor.
#[derive(Clone, Debug)]
struct Sparse<'b> {
    /// Indices of the replaced elements, ascending.
    indices: Vec<u32>,
    values: Elements<'b>,
}

/// A checked accessor.
#[derive(Clone, Debug)]
pub struct Accessor<'b> {
    /// Number of elements, at least 1.
    pub count: usize,
    /// Type of the components.
    pub component: ComponentType,
    /// Number of components of an element: 1 to 4, or 16.
    pub components: usize,
    normalized: bool,
    /// The elements; `None` if all are zero.
    elements: Option<Elements<'b>>,
    sparse: Option<Sparse<'b>>,
    place: String,
}

impl<'b> Accessor<'b> {
    /// Reads and checks the accessor `index`, referred to at the place `from`.
    pub fn new(model: &Model, index: Index<Description>, from: &str, buffers: &'b Buffers<'_>) -> Result<Self, Fault> {
        let (item, place) = model.get(index, from)?;
        let GenericComponentType(component) = model.valid(&item.component_type, &format!("{place}/componentType"))?;
        let components = model.valid(&item.type_, &format!("{place}/type"))?.multiplicity();
        let count = item.count.0 as usize;
        if count == 0 || u32::try_from(item.count.0).is_err() {
            let reason = format!("{count} elements are too few or too many");
            return Err(Fault::new(place + "/count", reason));
        }
        let size = component.size() * components;
        let elements = item.buffer_view.map(|view| {
            let view = buffers.view(view, &format!("{place}/bufferView"))?;
            Elements::new(&place, view, item.byte_offset.unwrap_or_default(), count, size)
        });
        let sparse = item
            .sparse
            .as_ref()
            .map(|sparse| read_sparse(model, sparse, &format!("{place}/sparse"), buffers, count, size));
        Ok(Self {
            count,
            component,
            components,
            normalized: item.normalized,
            elements: elements.transpose()?,
            sparse: sparse.transpose()?,
            place,
        })
    }

    /// Values of a stream that was decoded instead of the accessor at `place`.
    pub fn of_stream(stream: &'b Stream, normalized: bool, place: &str) -> Result<Self, Fault> {
        let size = stream.component.size() * stream.components;
        if stream.count == 0 || stream.bytes.len() != stream.count * size {
            return Err(Fault::new(place, "there are no values in the compressed data"));
        }
        Ok(Self {
            count: stream.count,
            component: stream.component,
            components: stream.components,
            normalized,
            elements: Some(Elements { bytes: &stream.bytes, stride: size, size }),
            sparse: None,
            place: place.to_owned(),
        })
    }

    /// A fault at this accessor.
    pub fn fault(&self, reason: impl Into<String>) -> Fault {
        Fault::new(&self.place, reason)
    }

    /// JSON pointer to this accessor.
    pub fn place(&self) -> &str {
        &self.place
    }

    /// Whether all elements are zero because the accessor has no data.
    pub fn is_void(&self) -> bool {
        self.elements.is_none() && self.sparse.is_none()
    }

    /// Fails if there is too little data to justify an allocation for every element. Needed only where nothing else
    /// limits the number of elements that are read.
    pub fn check_justified(&self) -> Result<(), Fault> {
        const FREE: usize = 65_536;
        const PER_SPARSE: usize = 1024;
        let replaced = self.sparse.as_ref().map_or(0, |s| s.indices.len());
        if self.elements.is_some() || self.count <= FREE + replaced.saturating_mul(PER_SPARSE) {
            Ok(())
        } else {
            Err(self.fault(format!("claims {} elements, but has no buffer view", self.count)))
        }
    }

    /// Fails unless an element has `components` components.
    pub fn expect_components(self, components: &[usize]) -> Result<Self, Fault> {
        if components.contains(&self.components) {
            Ok(self)
        } else {
            Err(self.fault(format!("expected elements of {components:?} components, found {}", self.components)))
        }
    }

    /// Fails unless the components have one of the `allowed` types.
    pub fn expect_type(self, allowed: &[ComponentType]) -> Result<Self, Fault> {
        if allowed.contains(&self.component) {
            Ok(self)
        } else {
            Err(self.fault(format!("expected components of {allowed:?}, found {:?}", self.component)))
        }
    }

    /// Fails unless there are at least `count` elements.
    pub fn expect_count(self, count: usize) -> Result<Self, Fault> {
        if self.count >= count {
            Ok(self)
        } else {
            Err(self.fault(format!("expected {count} elements, found {}", self.count)))
        }
    }

    /// Treats integers as normalised, as the specification demands of some attributes.
    pub fn normalized(mut self) -> Self {
        self.normalized = true;
        self
    }

    #[inline]
    fn bytes(&self, i: usize) -> &'b [u8] {
        if let Some(sparse) = &self.sparse
            && let Ok(at) = sparse.indices.binary_search(&(i as u32))
        {
            return sparse.values.get(at);
        }
        self.elements.map_or(&[], |elements| elements.get(i))
    }

    /// Element `i` as floating-point numbers; missing components are 0.
    #[inline]
    pub fn floats<const N: usize>(&self, i: usize) -> [f32; N] {
        let bytes = self.bytes(i);
        let scale = |x: f32, most: f32| {
            if self.normalized { (x / most).max(-1.0) } else { x }
        };
        let mut floats = [0.0; N];
        match self.component {
            ComponentType::F32 => each(bytes, &mut floats, f32::from_le_bytes),
            ComponentType::U32 => each(bytes, &mut floats, |b| u32::from_le_bytes(b) as f32),
            ComponentType::I8 => each(bytes, &mut floats, |[b]: [u8; 1]| scale(f32::from(b as i8), 127.0)),
            ComponentType::U8 => each(bytes, &mut floats, |[b]: [u8; 1]| scale(b.into(), 255.0)),
            ComponentType::I16 => each(bytes, &mut floats, |b| scale(i16::from_le_bytes(b).into(), 32_767.0)),
            ComponentType::U16 => each(bytes, &mut floats, |b| scale(u16::from_le_bytes(b).into(), 65_535.0)),
        }
        floats
    }

    /// Element `i` as unsigned integers; components that are missing or no unsigned integers are 0.
    #[inline]
    pub fn integers<const N: usize>(&self, i: usize) -> [u32; N] {
        integers(self.component, self.bytes(i))
    }
}

/// Decodes consecutive components of `SIZE` bytes.
#[inline]
fn each<const SIZE: usize, T>(bytes: &[u8], out: &mut [T], decode: impl Fn([u8; SIZE]) -> T) {
    let (components, _) = bytes.as_chunks::<SIZE>();
    for (out, &component) in out.iter_mut().zip(components) {
        *out = decode(component);
    }
}

fn read_sparse<'b>(
    model: &Model,
    item: &SparseDescription,
    place: &str,
    buffers: &'b Buffers<'_>,
    count: usize,
    size: usize,
) -> Result<Sparse<'b>, Fault> {
    let replaced = item.count.0 as usize;
    let part = |key: &str, view, offset, size| {
        let place = format!("{place}/{key}");
        let view = buffers.view(view, &format!("{place}/bufferView"))?;
        Elements::new(&place, view, offset, replaced, size)
    };
    let (at, values) = (&item.indices, &item.values);
    let IndexComponentType(component) = model.valid(&at.component_type, &format!("{place}/indices/componentType"))?;
    let indices = part("indices", at.buffer_view, at.byte_offset, component.size())?;
    let indices: Vec<u32> = (0..replaced)
        .map(|i| {
            let [index] = integers(component, indices.get(i));
            index
        })
        .collect();
    if !indices.is_sorted_by(|a, b| a < b) || indices.last().is_some_and(|&i| i as usize >= count) {
        return Err(Fault::new(
            place,
            format!("the indices do not ascend strictly below the accessor's count of {count}"),
        ));
    }
    let values = part("values", values.buffer_view, values.byte_offset, size)?;
    Ok(Sparse { indices, values })
}

/// Unsigned integers of a component type; 0 for other types.
#[inline]
fn integers<const N: usize>(component: ComponentType, bytes: &[u8]) -> [u32; N] {
    let mut integers = [0; N];
    match component {
        ComponentType::U8 => each(bytes, &mut integers, |[b]: [u8; 1]| b.into()),
        ComponentType::U16 => each(bytes, &mut integers, |b| u16::from_le_bytes(b).into()),
        ComponentType::U32 => each(bytes, &mut integers, u32::from_le_bytes),
        ComponentType::I8 | ComponentType::I16 | ComponentType::F32 => {}
    }
    integers
}
