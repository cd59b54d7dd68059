//! Buffers and buffer views (glTF 2.0, section 3.6.1), fetched when first needed.

use std::{borrow::Cow, path::Path, sync::OnceLock};

use super::{json::Item, meshopt, uri};
use crate::scene::error::Fault;

const MESHOPT: &str = "EXT_meshopt_compression";

/// All buffers and views of a document.
#[derive(Debug)]
pub struct Buffers<'a> {
    buffers: Vec<Item<'a>>,
    views: Vec<Item<'a>>,
    binary: Option<&'a [u8]>,
    base: Option<&'a Path>,
    loaded: Vec<OnceLock<Result<Cow<'a, [u8]>, Fault>>>,
    decoded: Vec<OnceLock<Result<Vec<u8>, Fault>>>,
}

/// The bytes of a buffer view.
#[derive(Clone, Copy, Debug)]
pub struct View<'b> {
    /// The bytes.
    pub bytes: &'b [u8],
    /// Distance of two elements, where the view prescribes one.
    pub stride: Option<usize>,
}

impl<'a> Buffers<'a> {
    /// `binary` is the GLB's chunk, `base` the folder that relative URIs start from.
    pub fn new(
        root: &Item<'a>,
        binary: Option<&'a [u8]>,
        base: Option<&'a Path>,
    ) -> Result<Self, Fault> {
        let buffers = root.objects("buffers")?;
        let views = root.objects("bufferViews")?;
        Ok(Self {
            loaded: buffers.iter().map(|_| OnceLock::new()).collect(),
            decoded: views.iter().map(|_| OnceLock::new()).collect(),
            buffers,
            views,
            binary,
            base,
        })
    }

    /// Folder that relative URIs start from.
    pub fn base(&self) -> Option<&'a Path> {
        self.base
    }

    /// The view that the member `key` of `item` refers to; `None` where the member is absent.
    pub fn view(&self, item: &Item<'_>, key: &str) -> Result<Option<View<'_>>, Fault> {
        let Some(index) = item.index(key, "bufferViews", self.views.len())? else {
            return Ok(None);
        };
        let (Some(view), Some(decoded)) = (self.views.get(index), self.decoded.get(index)) else {
            return Ok(None);
        };
        let stride = view
            .get("byteStride")
            .map(|s| s.as_usize())
            .transpose()?
            .filter(|&s| s > 0);
        let bytes = match view.extension(MESHOPT) {
            Some(extension) => decoded
                .get_or_init(|| meshopt::decode(&extension, self.range(&extension)?))
                .as_deref()
                .map_err(Clone::clone)?,
            None => self.range(view)?,
        };
        Ok(Some(View { bytes, stride }))
    }

    /// The bytes that `buffer`, `byteOffset` and `byteLength` of `item` select.
    fn range(&self, item: &Item<'_>) -> Result<&[u8], Fault> {
        let index = item
            .require("buffer")?
            .as_index("buffers", self.buffers.len())?;
        let offset = item.usize_or("byteOffset", 0)?;
        let length = item.require("byteLength")?.as_usize()?;
        let bytes = self.buffer(index)?;
        offset
            .checked_add(length)
            .and_then(|end| bytes.get(offset..end))
            .ok_or_else(|| {
                item.fault(format!(
                    "{length} bytes at {offset} reach beyond the {} bytes of buffers/{index}",
                    bytes.len()
                ))
            })
    }

    fn buffer(&self, index: usize) -> Result<&[u8], Fault> {
        let (Some(item), Some(slot)) = (self.buffers.get(index), self.loaded.get(index)) else {
            return Ok(&[]);
        };
        slot.get_or_init(|| self.load(item, index))
            .as_deref()
            .map_err(Clone::clone)
    }

    fn load(&self, item: &Item<'a>, index: usize) -> Result<Cow<'a, [u8]>, Fault> {
        let length = item.require("byteLength")?.as_usize()?;
        let Some(uri) = item.get("uri") else {
            return match self.binary {
                // The chunk may be padded, never shorter.
                Some(binary) if index == 0 => {
                    Ok(Cow::Borrowed(binary.get(..length).unwrap_or(binary)))
                }
                _ => Err(item.fault("has neither a URI nor a GLB's binary chunk")),
            };
        };
        let mut bytes = uri::fetch(uri.as_str()?, self.base, length as u64)
            .map_err(|reason| uri.fault(reason))?;
        bytes.truncate(length);
        Ok(Cow::Owned(bytes))
    }
}
