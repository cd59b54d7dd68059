//! Accessors (glTF 2.0, section 3.6.2), read element by element straight from the buffers.
//!
//! Nothing is allocated for what an accessor merely claims: every element is checked to lie within
//! its buffer view first, and an accessor without data is never expanded.

use super::{
    buffer::{Buffers, View},
    json::Item,
};
use crate::scene::error::Fault;

/// Type of one component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// 8 bits, signed.
    I8,
    /// 8 bits, unsigned.
    U8,
    /// 16 bits, signed.
    I16,
    /// 16 bits, unsigned.
    U16,
    /// 32 bits, unsigned.
    U32,
    /// 32 bits, floating point.
    F32,
}

impl Component {
    fn read(item: &Item<'_>) -> Result<Self, Fault> {
        let item = item.require("componentType")?;
        Ok(match item.as_usize()? {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            other => return Err(item.fault(format!("{other} is no component type"))),
        })
    }

    const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }
}

/// Elements at equal distances.
#[derive(Clone, Copy, Debug)]
struct Elements<'b> {
    bytes: &'b [u8],
    stride: usize,
    size: usize,
}

impl<'b> Elements<'b> {
    /// `count` elements of `size` bytes from `offset` on, checked to lie within `view`.
    fn new(
        item: &Item<'_>,
        view: View<'b>,
        offset: usize,
        count: usize,
        size: usize,
    ) -> Result<Self, Fault> {
        let stride = view.stride.unwrap_or(size);
        if stride < size {
            return Err(item.fault(format!(
                "elements of {size} bytes do not fit the buffer view's stride of {stride}"
            )));
        }
        let end = count
            .saturating_sub(1)
            .checked_mul(stride)
            .and_then(|n| n.checked_add(size)?.checked_add(offset));
        match end.and_then(|end| view.bytes.get(offset..end)) {
            Some(bytes) => Ok(Self {
                bytes,
                stride,
                size,
            }),
            None => Err(item.fault(format!(
                "{count} elements of {size} bytes, {stride} apart, at {offset} reach beyond the \
                 {} bytes of the buffer view",
                view.bytes.len()
            ))),
        }
    }

    /// The bytes of element `i`; empty past the end.
    #[inline]
    fn get(&self, i: usize) -> &'b [u8] {
        let start = i * self.stride;
        self.bytes.get(start..start + self.size).unwrap_or(&[])
    }
}

/// Elements that replace others.
#[derive(Clone, Debug)]
struct Sparse<'b> {
    /// Ascending.
    indices: Vec<u32>,
    values: Elements<'b>,
}

/// A checked accessor.
#[derive(Clone, Debug)]
pub struct Accessor<'b> {
    /// Number of elements, at least 1.
    pub count: usize,
    /// Type of the components.
    pub component: Component,
    /// Components of an element: 1 to 4, or 16.
    pub components: usize,
    normalized: bool,
    /// `None`: zeros.
    elements: Option<Elements<'b>>,
    sparse: Option<Sparse<'b>>,
    place: String,
}

impl<'b> Accessor<'b> {
    /// Reads and checks the accessor `item`.
    pub fn new(item: &Item<'_>, buffers: &'b Buffers<'_>) -> Result<Self, Fault> {
        let component = Component::read(item)?;
        let kind = item.require("type")?;
        let components = match kind.as_str()? {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" | "MAT2" => 4,
            "MAT3" => 9,
            "MAT4" => 16,
            other => return Err(kind.fault(format!("\"{other}\" is no accessor type"))),
        };
        let count_item = item.require("count")?;
        let count = count_item.as_usize()?;
        if count == 0 || u32::try_from(count).is_err() {
            return Err(count_item.fault(format!("{count} elements are too few or too many")));
        }
        let size = component.size() * components;
        let offset = item.usize_or("byteOffset", 0)?;
        let elements = buffers
            .view(item, "bufferView")?
            .map(|view| Elements::new(item, view, offset, count, size))
            .transpose()?;
        let sparse = item
            .get("sparse")
            .map(|sparse| read_sparse(&sparse, buffers, count, size))
            .transpose()?;
        Ok(Self {
            count,
            component,
            components,
            normalized: item.flag("normalized")?,
            elements,
            sparse,
            place: item.place().to_owned(),
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

    /// Whether every element is zero for lack of data.
    pub fn is_void(&self) -> bool {
        self.elements.is_none() && self.sparse.is_none()
    }

    /// Fails unless data justify to allocate for every element. Needed only where nothing else
    /// bounds the number of elements that are read.
    pub fn check_justified(&self) -> Result<(), Fault> {
        const FREE: usize = 65_536;
        const PER_SPARSE: usize = 1024;
        let replaced = self.sparse.as_ref().map_or(0, |s| s.indices.len());
        if self.elements.is_some() || self.count <= FREE + replaced.saturating_mul(PER_SPARSE) {
            Ok(())
        } else {
            Err(self.fault(format!(
                "claims {} elements, but has no buffer view",
                self.count
            )))
        }
    }

    /// Fails unless an element has `components` components.
    pub fn expect_components(self, components: &[usize]) -> Result<Self, Fault> {
        if components.contains(&self.components) {
            Ok(self)
        } else {
            Err(self.fault(format!(
                "expected elements of {components:?} components, found {}",
                self.components
            )))
        }
    }

    /// Fails unless the components have one of the `allowed` types.
    pub fn expect_type(self, allowed: &[Component]) -> Result<Self, Fault> {
        if allowed.contains(&self.component) {
            Ok(self)
        } else {
            Err(self.fault(format!(
                "expected components of {allowed:?}, found {:?}",
                self.component
            )))
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

    /// Element `i` as floating-point numbers; components that it lacks are 0.
    #[inline]
    pub fn floats<const N: usize>(&self, i: usize) -> [f32; N] {
        let bytes = self.bytes(i);
        let scale = |x: f32, most: f32| {
            if self.normalized {
                (x / most).max(-1.0)
            } else {
                x
            }
        };
        let mut floats = [0.0; N];
        match self.component {
            Component::F32 => each(bytes, &mut floats, f32::from_le_bytes),
            Component::U32 => each(bytes, &mut floats, |b| u32::from_le_bytes(b) as f32),
            Component::I8 => each(bytes, &mut floats, |[b]: [u8; 1]| {
                scale(f32::from(b as i8), 127.0)
            }),
            Component::U8 => each(bytes, &mut floats, |[b]: [u8; 1]| scale(b.into(), 255.0)),
            Component::I16 => each(bytes, &mut floats, |b| {
                scale(i16::from_le_bytes(b).into(), 32_767.0)
            }),
            Component::U16 => each(bytes, &mut floats, |b| {
                scale(u16::from_le_bytes(b).into(), 65_535.0)
            }),
        }
        floats
    }

    /// Element `i` as unsigned integers; components that it lacks, or that are not unsigned
    /// integers, are 0.
    #[inline]
    pub fn integers<const N: usize>(&self, i: usize) -> [u32; N] {
        let bytes = self.bytes(i);
        let mut integers = [0; N];
        match self.component {
            Component::U8 => each(bytes, &mut integers, |[b]: [u8; 1]| b.into()),
            Component::U16 => each(bytes, &mut integers, |b| u16::from_le_bytes(b).into()),
            Component::U32 => each(bytes, &mut integers, u32::from_le_bytes),
            Component::I8 | Component::I16 | Component::F32 => {}
        }
        integers
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
    item: &Item<'_>,
    buffers: &'b Buffers<'_>,
    count: usize,
    size: usize,
) -> Result<Sparse<'b>, Fault> {
    let replaced = item.require("count")?.as_usize()?;
    let part = |key: &str, size: usize| {
        let part = item.require(key)?;
        let view = buffers
            .view(&part, "bufferView")?
            .ok_or_else(|| part.fault("lacks the required \"bufferView\""))?;
        let offset = part.usize_or("byteOffset", 0)?;
        Elements::new(&part, view, offset, replaced, size)
    };
    let component = Component::read(&item.require("indices")?)?;
    let indices = part("indices", component.size())?;
    let indices: Vec<u32> = (0..replaced)
        .map(|i| {
            let mut index = [0];
            let bytes = indices.get(i);
            match component {
                Component::U8 => each(bytes, &mut index, |[b]: [u8; 1]| b.into()),
                Component::U16 => each(bytes, &mut index, |b| u16::from_le_bytes(b).into()),
                _ => each(bytes, &mut index, u32::from_le_bytes),
            }
            index[0]
        })
        .collect();
    if !indices.is_sorted_by(|a, b| a < b) || indices.last().is_some_and(|&i| i as usize >= count) {
        return Err(item.fault(format!(
            "the indices do not ascend strictly below the accessor's count of {count}"
        )));
    }
    Ok(Sparse {
        indices,
        values: part("values", size)?,
    })
}
