//! Buffers and buffer views (glTF 2.0, section 3.6.1), loaded when they are first needed.

use std::{borrow::Cow, path::Path, sync::OnceLock};

use gltf::json::{Buffer, Index, buffer::View as Description, validation::USize64};

use super::{meshopt, model::Model, uri};
use crate::scene::error::Fault;

/// Buffers and views of a document.
pub struct Buffers<'a> {
    model: &'a Model,
    binary: Option<&'a [u8]>,
    base: Option<&'a Path>,
    loaded: Vec<OnceLock<Result<LoadedBuffer<'a>, Fault>>>,
    decoded: Vec<OnceLock<Result<Vec<u8>, Fault>>>,
}

/// The bytes of a buffer, and a fault that is tolerated.
type LoadedBuffer<'a> = (Cow<'a, [u8]>, Option<Fault>);

/// The bytes of a buffer view.
#[derive(Clone, Copy, Debug)]
pub struct BufferView<'b> {
    /// The bytes.
    pub bytes: &'b [u8],
    /// Distance between two elements, if the view prescribes one.
    pub stride: Option<usize>,
}

impl<'a> Buffers<'a> {
    /// `binary` is the GLB's chunk, `base` the folder that relative URIs start from.
    pub fn new(model: &'a Model, binary: Option<&'a [u8]>, base: Option<&'a Path>) -> Self {
        Self {
            loaded: model.root.buffers.iter().map(|_| OnceLock::new()).collect(),
            decoded: model.root.buffer_views.iter().map(|_| OnceLock::new()).collect(),
            model,
            binary,
            base,
        }
    }

    /// Folder that relative URIs start from.
    pub fn base(&self) -> Option<&'a Path> {
        self.base
    }

    /// Faults of buffers that are tolerated.
    pub fn notes(&self) -> impl Iterator<Item = Fault> {
        let loaded = self.loaded.iter().filter_map(OnceLock::get);
        loaded.flatten().filter_map(|(_, note)| note.clone())
    }

    /// The view `index`, referred to at the place `from`.
    pub fn view(&self, index: Index<Description>, from: &str) -> Result<BufferView<'_>, Fault> {
        let (view, place) = self.model.get(index, from)?;
        let others = view.extensions.as_ref().map(|extensions| &extensions.others);
        let compressed = meshopt::find(others, &place)?;
        let bytes = match (compressed, self.decoded.get(index.value())) {
            (Some((compressed, place)), Some(decoded)) => decoded
                .get_or_init(|| {
                    let (offset, length) = (compressed.byte_offset, compressed.byte_length);
                    let bytes = self.range(compressed.buffer, offset, length, &place)?;
                    meshopt::decode(&compressed, bytes, &place)
                })
                .as_deref()
                .map_err(Clone::clone)?,
            _ => {
                let offset = view.byte_offset.unwrap_or_default();
                self.range(view.buffer, offset, view.byte_length, &place)?
            }
        };
        let stride = view.byte_stride.map(|stride| stride.0);
        Ok(BufferView { bytes, stride: stride.filter(|&stride| stride > 0) })
    }

    /// `length` bytes at `offset` of a buffer. `place` is the place of the object that refers to the bytes.
    fn range(&self, buffer: Index<Buffer>, offset: USize64, length: USize64, place: &str) -> Result<&[u8], Fault> {
        let (item, buffer_place) = self.model.get(buffer, &format!("{place}/buffer"))?;
        let bytes = match self.loaded.get(buffer.value()) {
            Some(slot) => slot
                .get_or_init(|| self.load(item, &buffer_place, buffer.value()))
                .as_ref()
                .map(|(bytes, _)| &**bytes)
                .map_err(Clone::clone)?,
            None => &[],
        };
        let (offset, length) = (offset.0, length.0);
        let end = offset.checked_add(length).and_then(|end| usize::try_from(end).ok());
        end.and_then(|end| bytes.get(offset as usize..end)).ok_or_else(|| {
            let all = bytes.len();
            Fault::new(place, format!("{length} bytes at {offset} reach beyond the {all} bytes of {buffer_place}"))
        })
    }

    fn load(&self, item: &'a Buffer, place: &str, index: usize) -> Result<LoadedBuffer<'a>, Fault> {
        let length = item.byte_length.0;
        let (mut bytes, note) = match (&item.uri, self.binary) {
            (Some(uri), _) => {
                let fault = |reason| Fault::new(format!("{place}/uri"), reason);
                let fetched = uri::fetch(uri, self.base, length).map_err(fault)?;
                (Cow::Owned(fetched.bytes), fetched.note.map(fault))
            }
            (None, Some(binary)) if index == 0 => (Cow::Borrowed(binary), None),
            _ => {
                return Err(Fault::new(place, "has neither a URI nor a GLB's binary chunk"));
            }
        };
        // The chunk may be longer than the buffer, because of padding.
        let length = usize::try_from(length).unwrap_or(usize::MAX);
        match &mut bytes {
            Cow::Owned(bytes) => bytes.truncate(length),
            Cow::Borrowed(bytes) => *bytes = bytes.get(..length).unwrap_or(bytes),
        }
        Ok((bytes, note))
    }
}
