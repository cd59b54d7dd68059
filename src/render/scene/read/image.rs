//! Images (glTF 2.0, section 3.8.2), decoded in parallel.

use std::{
    borrow::Cow,
    collections::{BTreeMap, BTreeSet, HashMap},
    io::Cursor,
    path::PathBuf,
};

use gltf::json::{self, Index};
use image::{DynamicImage, ImageFormat, ImageReader, Limits};
use rayon::prelude::*;

use super::{Context, buffer::Buffers, limits::check_texels, model::Model, texture_file::TextureFault, uri};
use crate::scene::{error::Fault, material::Image};

/// Largest width and height.
const MAX_SIDE: u32 = 16_384;
/// Most texels of all images together: 4 GiB.
const MAX_TEXELS: u64 = 1 << 30;
/// Most bytes of an image file.
const MAX_FILE: u64 = 1 << 30;

/// Images of a document; only those that are needed are decoded.
#[derive(Default)]
pub struct DecodedImages {
    /// Index into `decoded` of every image that was tried; `None` for a failure.
    places: BTreeMap<usize, Option<u32>>,
    /// First image of each file and buffer view that was tried.
    first: HashMap<ImageSource, usize>,
    decoded: Vec<Image>,
    texels: u64,
}

impl DecodedImages {
    /// Decodes the images `wanted` that were not tried before; failures become warnings.
    pub fn decode(&mut self, context: &mut Context<'_>, wanted: impl IntoIterator<Item = usize>) {
        let wanted: BTreeSet<usize> = wanted.into_iter().filter(|index| !self.places.contains_key(index)).collect();
        let mut accepted = Vec::new();
        let mut faults = Vec::new();
        let mut repeated = Vec::new();
        for index in wanted {
            self.places.insert(index, None);
            if let Some(source) = ImageSource::of(index, context) {
                let first = *self.first.entry(source).or_insert(index);
                if first != index {
                    repeated.push((index, first));
                    continue;
                }
            }
            let fetched = fetch(index, context.model, &context.buffers);
            let encoded = fetched.and_then(|EncodedImage { bytes, place, note }| {
                faults.extend(note);
                let admitted = sniff(&bytes).and_then(|format| self.admit(bytes, format));
                match admitted {
                    Ok(encoded) => Ok((index, encoded, place)),
                    Err(reason) => Err(Fault::new(place, reason)),
                }
            });
            match encoded {
                Ok(encoded) => accepted.push(encoded),
                Err(fault) => faults.push(fault),
            }
        }
        let decoded: Vec<_> = accepted
            .into_par_iter()
            .map(|(index, encoded, place)| {
                let fault = |reason| Fault::new(place, reason);
                (index, encoded.decode().map_err(fault))
            })
            .collect();
        for (index, result) in decoded {
            match result {
                Ok(image) => {
                    self.places.insert(index, Some(self.decoded.len() as u32));
                    self.decoded.push(image);
                }
                Err(fault) => faults.push(fault),
            }
        }
        for (index, first) in repeated {
            self.places.insert(index, self.place(first));
        }
        context.warnings.extend(faults);
    }

    /// Checks an image's header against the limits.
    fn admit<'b>(&mut self, bytes: Cow<'b, [u8]>, format: ImageEncoding) -> Result<Encoded<'b>, String> {
        let (width, height) = match format {
            ImageEncoding::Picture(format) => ImageReader::with_format(Cursor::new(&bytes), format)
                .into_dimensions()
                .map_err(|error| format!("cannot be decoded: {error}"))?,
            ImageEncoding::Basis => super::basis::dimensions(&bytes)?,
        };
        let texels = u64::from(width) * u64::from(height);
        let size = format!("{width} x {height} texels");
        if texels == 0 || width > MAX_SIDE || height > MAX_SIDE {
            return Err(format!("{size} are not within 1 to {MAX_SIDE} a side"));
        }
        check_texels(width.into(), height.into(), bytes.len())?;
        if self.texels + texels > MAX_TEXELS {
            return Err(format!("{size} exceed the limit of {MAX_TEXELS} texels for all images together"));
        }
        self.texels += texels;
        Ok(Encoded { bytes, format, size: (width, height) })
    }

    /// Decodes an image of the file `name`, which is not part of a document.
    pub fn decode_named(&mut self, bytes: Cow<'_, [u8]>, name: &str) -> Result<Image, TextureFault> {
        let fault = |reason, is_supported| TextureFault { file: name.to_owned(), reason, is_supported };
        let format = sniff_named(&bytes, name).map_err(|reason| fault(reason, false))?;
        let admitted = self.admit(bytes, format);
        admitted.and_then(|encoded| encoded.decode()).map_err(|reason| fault(reason, true))
    }

    /// Adds a decoded image; returns its index among the decoded images.
    pub fn push(&mut self, image: Image) -> u32 {
        self.decoded.push(image);
        self.decoded.len() as u32 - 1
    }

    /// Index, among the decoded images, of the document's image `index`; `None` if it was not decoded.
    pub fn place(&self, index: usize) -> Option<u32> {
        self.places.get(&index).copied().flatten()
    }

    /// A decoded image.
    pub fn decoded(&self, index: u32) -> Option<&Image> {
        self.decoded.get(index as usize)
    }

    pub fn into_decoded(self) -> Vec<Image> {
        self.decoded
    }
}

/// Where an image of a document is stored.
#[derive(PartialEq, Eq, Hash)]
enum ImageSource {
    File(PathBuf),
    View(usize),
}

impl ImageSource {
    fn of(index: usize, context: &Context<'_>) -> Option<Self> {
        let item = context.model.root.images.get(index)?;
        let file = |uri: &String| Self::File(uri::identity(uri, context.buffers.base()).into_owned());
        item.uri.as_ref().map(file).or(item.buffer_view.map(|view| Self::View(view.value())))
    }
}

/// An image as it is stored.
struct EncodedImage<'b> {
    bytes: Cow<'b, [u8]>,
    place: String,
    /// Fault that is tolerated.
    note: Option<Fault>,
}

/// Fetches the encoded bytes of an image.
fn fetch<'b>(index: usize, model: &Model, buffers: &'b Buffers<'_>) -> Result<EncodedImage<'b>, Fault> {
    let (item, place) = model.get::<json::Image>(Index::new(index as u32), "/images")?;
    match (&item.uri, item.buffer_view) {
        (Some(uri), _) => {
            let fault = |reason| Fault::new(format!("{place}/uri"), reason);
            let fetched = uri::fetch(uri, buffers.base(), MAX_FILE).map_err(fault)?;
            let note = fetched.note.map(fault);
            Ok(EncodedImage { bytes: Cow::Owned(fetched.bytes), place, note })
        }
        (None, Some(view)) => {
            let view = buffers.view(view, &format!("{place}/bufferView"))?;
            Ok(EncodedImage { bytes: Cow::Borrowed(view.bytes), place, note: None })
        }
        _ => Err(Fault::new(place, "has neither a URI nor a buffer view")),
    }
}

/// Encoding of an image.
#[derive(Clone, Copy)]
enum ImageEncoding {
    /// A format that `image` decodes.
    Picture(ImageFormat),
    /// KTX2 of Basis Universal.
    Basis,
}

/// Format of an image by its content; the declared type and the file's extension are often wrong.
fn sniff(bytes: &[u8]) -> Result<ImageEncoding, String> {
    match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg | ImageFormat::WebP)) => Ok(ImageEncoding::Picture(format)),
        _ if bytes.starts_with(KTX2) => Ok(ImageEncoding::Basis),
        _ => Err("is neither PNG, JPEG, WebP nor KTX2".to_owned()),
    }
}

/// Format of an image that an MTL or PLY file names: one of glTF's, BMP, or TGA, which only its name or its last bytes
/// tell.
fn sniff_named(bytes: &[u8], name: &str) -> Result<ImageEncoding, String> {
    if let Ok(format) = sniff(bytes) {
        return Ok(format);
    }
    let is_tga = name.to_ascii_lowercase().ends_with(".tga") || bytes.ends_with(TGA_END);
    match image::guess_format(bytes) {
        Ok(ImageFormat::Bmp) => Ok(ImageEncoding::Picture(ImageFormat::Bmp)),
        Err(_) if is_tga => Ok(ImageEncoding::Picture(ImageFormat::Tga)),
        Ok(other) => {
            let format = format!("{other:?}").to_uppercase();
            Err(format!("{format} is not supported; convert it to PNG"))
        }
        Err(_) => Err("is neither PNG, JPEG, WebP, KTX2, BMP nor TGA; convert it to PNG".to_owned()),
    }
}

/// Last bytes of newer TGA files.
const TGA_END: &[u8] = b"TRUEVISION-XFILE.\0";

/// First bytes of a KTX2 file.
const KTX2: &[u8] = b"\xABKTX 20\xBB";

/// An encoded image whose header was accepted.
struct Encoded<'b> {
    bytes: Cow<'b, [u8]>,
    format: ImageEncoding,
    size: (u32, u32),
}

impl Encoded<'_> {
    fn decode(&self) -> Result<Image, String> {
        let pixels = match self.format {
            ImageEncoding::Picture(format) => self.decode_picture(format)?,
            ImageEncoding::Basis => super::basis::decode(&self.bytes)?,
        };
        let (width, height) = self.size;
        let image = Image { width, height, pixels };
        let levels = image.levels().count();
        let bytes: usize = image.levels().map(<[u8]>::len).sum();
        let complete = levels == 1 || levels == image.full_levels() as usize;
        if bytes != image.pixels.len() || !complete {
            return Err(format!("is not of the {width} x {height} texels that its header states"));
        }
        Ok(image)
    }

    fn decode_picture(&self, format: ImageFormat) -> Result<Vec<u8>, String> {
        let failed = |error: image::ImageError| format!("cannot be decoded: {error}");
        let mut reader = ImageReader::with_format(Cursor::new(&self.bytes), format);
        let mut limits = Limits::default();
        limits.max_image_width = Some(MAX_SIDE);
        limits.max_image_height = Some(MAX_SIDE);
        // The limit allows 16 bits a channel, and as much again for the decoder itself.
        limits.max_alloc = Some(16 * u64::from(MAX_SIDE) * u64::from(MAX_SIDE));
        reader.limits(limits);
        let decoder = reader.into_decoder().map_err(failed)?;
        let pixels = DynamicImage::from_decoder(decoder).map_err(failed)?;
        Ok(pixels.into_rgba8().into_raw())
    }
}
