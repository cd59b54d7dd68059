//! Buffers and buffer views (glTF 2.0, section 3.6.1), loaded when they are first needed.

use std::{collections::HashMap, path::Path, sync::OnceLock};

use gltf::json::{Buffer, Index, buffer::View as Description, validation::USize64};

use super::{
    meshopt,
    model::Model,
    uri::{self, Fetched},
};
use crate::scene::error::Fault;

/// Buffers and views of a document.
pub struct Buffers<'a> {
    model: &'a Model,
    binary: Option<&'a [u8]>,
    base: Option<&'a Path>,
    /// What the URIs of buffers refer to. Buffers with the same file share it.
    files: Vec<BufferFile>,
    /// Index of each buffer's file, if it has a URI.
    file_of: Vec<Option<usize>>,
    /// Decoded views, by the index of the first view of the same compressed data.
    decoded: Vec<OnceLock<Result<Vec<u8>, Fault>>>,
    /// Index of that view for each view.
    first_view: Vec<usize>,
}

/// A file of buffers, loaded when it is first needed.
struct BufferFile {
    /// Place of the first of its buffers.
    place: String,
    /// Largest number of bytes that a buffer has of it.
    length: u64,
    content: OnceLock<Result<Fetched, String>>,
}

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
        let mut files: Vec<BufferFile> = Vec::new();
        let mut known_files = HashMap::new();
        let buffers = model.root.buffers.iter().enumerate();
        let file_of = buffers.map(|(index, buffer)| {
            let file = *known_files.entry(uri::identity(buffer.uri.as_ref()?, base)).or_insert_with(|| {
                let place = format!("/buffers/{index}/uri");
                files.push(BufferFile { place, length: 0, content: OnceLock::new() });
                files.len() - 1
            });
            files[file].length = files[file].length.max(buffer.byte_length.0);
            Some(file)
        });
        let file_of = file_of.collect();
        let views = &model.root.buffer_views;
        let mut known = HashMap::new();
        let first_of = |(index, view): (usize, &Description)| {
            let others = view.extensions.as_ref().map(|extensions| &extensions.others);
            match meshopt::find(others, "") {
                Ok(Some((compressed, _))) => *known.entry(compressed.key()).or_insert(index),
                _ => index,
            }
        };
        Self {
            first_view: views.iter().enumerate().map(first_of).collect(),
            decoded: views.iter().map(|_| OnceLock::new()).collect(),
            files,
            file_of,
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
        let loaded = self.files.iter().filter_map(|file| Some((file, file.content.get()?.as_ref().ok()?)));
        loaded.filter_map(|(file, fetched)| Some(Fault::new(&file.place, fetched.note.as_ref()?)))
    }

    /// The view `index`, referred to at the place `from`.
    pub fn view(&self, index: Index<Description>, from: &str) -> Result<BufferView<'_>, Fault> {
        let (view, place) = self.model.get(index, from)?;
        let others = view.extensions.as_ref().map(|extensions| &extensions.others);
        let compressed = meshopt::find(others, &place)?;
        let decoded = self.first_view.get(index.value()).and_then(|first| self.decoded.get(*first));
        let bytes = match (compressed, decoded) {
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
        let bytes = self.bytes(item, &buffer_place, buffer.value())?;
        let (offset, length) = (offset.0, length.0);
        let end = offset.checked_add(length).and_then(|end| usize::try_from(end).ok());
        end.and_then(|end| bytes.get(offset as usize..end)).ok_or_else(|| {
            let all = bytes.len();
            Fault::new(place, format!("{length} bytes at {offset} reach beyond the {all} bytes of {buffer_place}"))
        })
    }

    /// Bytes of the buffer at `place`.
    fn bytes(&self, item: &Buffer, place: &str, index: usize) -> Result<&[u8], Fault> {
        let file = self.file_of.get(index).copied().flatten().and_then(|file| self.files.get(file));
        let all = match (&item.uri, file, self.binary) {
            (Some(uri), Some(file), _) => {
                let fetched = file.content.get_or_init(|| uri::fetch(uri, self.base, file.length));
                let fault = |reason: &String| Fault::new(format!("{place}/uri"), reason);
                fetched.as_ref().map(|fetched| &fetched.bytes[..]).map_err(fault)?
            }
            (None, _, Some(binary)) if index == 0 => binary,
            _ => {
                return Err(Fault::new(place, "has neither a URI nor a GLB's binary chunk"));
            }
        };
        // A file may be longer than its buffer, and the chunk because of padding.
        let length = usize::try_from(item.byte_length.0).unwrap_or(usize::MAX);
        Ok(all.get(..length).unwrap_or(all))
    }
}
