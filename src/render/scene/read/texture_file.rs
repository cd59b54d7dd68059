//! Textures that OBJ and PLY files name, each read once.

use std::{borrow::Cow, collections::HashMap, path::Path};

use image::{RgbaImage, imageops};

use super::{image::DecodedImages, uri};
use crate::scene::{
    error::{Fault, Warnings},
    material::{Image, Sampler, Texture},
};

/// Largest number of bytes of a file that a scene names.
pub const MAX_FILE: u64 = 1 << 30;

/// Images of a texture: the file of its colours, and that of its alpha. The names are as they were written.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct TextureFiles {
    /// Folder of the file that names the images, relative to that of the scene.
    pub folder: String,
    pub color: Option<String>,
    pub alpha: Option<String>,
}

/// Reason why a texture is not there.
#[derive(Clone, Debug)]
pub struct TextureFault {
    /// File of the image, as it was named.
    pub file: String,
    pub reason: String,
    /// Whether images of its format are read.
    pub is_supported: bool,
}

impl TextureFault {
    fn broken(file: &str, reason: String) -> Self {
        Self { file: file.to_owned(), reason, is_supported: true }
    }

    /// Says that the texture is left out.
    pub fn report(&self, place: &str, warnings: &mut Warnings) {
        let reason = format!("{}: {}", self.file, self.reason);
        if self.is_supported {
            warnings.push(&Fault::new(place, reason).but("the texture is left out"));
        } else {
            warnings.leave_out("textures", 1, &reason);
        }
    }
}

/// Textures by the names of their images.
pub struct NamedTextures<'b> {
    base: Option<&'b Path>,
    images: DecodedImages,
    textures: Vec<Texture>,
    known: HashMap<TextureFiles, Result<u32, TextureFault>>,
}

impl<'b> NamedTextures<'b> {
    /// No textures yet; names are relative to the folder `base`.
    pub fn new(base: Option<&'b Path>) -> Self {
        Self { base, images: DecodedImages::default(), textures: Vec::new(), known: HashMap::new() }
    }

    /// Index of a texture.
    pub fn get(&mut self, files: TextureFiles) -> Result<u32, TextureFault> {
        if let Some(known) = self.known.get(&files) {
            return known.clone();
        }
        let texture = self.read(&files).map(|image| {
            let image = self.images.push(image);
            let sampler = Sampler::default();
            self.textures.push(Texture { image, sampler });
            self.textures.len() as u32 - 1
        });
        self.known.insert(files, texture.clone());
        texture
    }

    /// Whether nearly all texels of a texture are either opaque or transparent, as those of leaves are.
    pub fn is_cutout(&self, texture: u32) -> bool {
        let texture = self.textures.get(texture as usize);
        let image = texture.and_then(|texture| self.images.decoded(texture.image));
        let texels = image.and_then(|image| image.levels().next()).unwrap_or_default();
        let texels = texels.chunks_exact(4);
        let count = texels.len();
        let between = texels.filter(|texel| (16..240).contains(&texel[3])).count();
        between * 20 <= count
    }

    /// All textures, and their images.
    pub fn into_parts(self) -> (Vec<Texture>, Vec<Image>) {
        (self.textures, self.images.into_decoded())
    }

    fn read(&mut self, files: &TextureFiles) -> Result<Image, TextureFault> {
        let mut decode = |name: &Option<String>| {
            let Some(name) = name else {
                return Ok(None);
            };
            let bytes = fetch(name, &files.folder, self.base).map_err(|reason| TextureFault::broken(name, reason))?;
            self.images.decode_named(bytes, name).map(Some)
        };
        match (decode(&files.color)?, decode(&files.alpha)?) {
            (Some(color), None) => Ok(color),
            (color, Some(alpha)) => with_alpha(color, &alpha)
                .map_err(|reason| TextureFault::broken(files.alpha.as_deref().unwrap_or_default(), reason)),
            (None, None) => Err(TextureFault::broken("", "no file is named".to_owned())),
        }
    }
}

/// Reads a file that a file in `folder` names; `folder` is relative to `base`. Programs on Windows write backslashes and
/// absolute paths, and some files name their images relative to the scene; then a file of that name beside it is read.
pub fn fetch(name: &str, folder: &str, base: Option<&Path>) -> Result<Cow<'static, [u8]>, String> {
    let name = name.replace('\\', "/");
    let last = name.rsplit('/').next().unwrap_or(&name);
    let inside = |name: &str| match folder {
        "" => name.to_owned(),
        _ => format!("{folder}/{name}"),
    };
    let places = [inside(&name), name.clone(), inside(last), last.to_owned()];
    let mut fault = None;
    for (index, place) in places.iter().enumerate() {
        if places[..index].contains(place) {
            continue;
        }
        match uri::fetch(place, base, MAX_FILE) {
            Ok(file) => return Ok(Cow::Owned(file.bytes)),
            Err(reason) => fault = fault.or(Some(reason)),
        }
    }
    Err(fault.unwrap_or_default())
}

/// An image with the alpha of another: its alpha channel if that varies, otherwise its brightness. The result is as
/// large as the larger image.
fn with_alpha(color: Option<Image>, alpha: &Image) -> Result<Image, String> {
    let size = |image: &Image| (image.width, image.height);
    let (of_color, of_alpha) = (color.as_ref().map_or((1, 1), size), size(alpha));
    let (width, height) = (of_color.0.max(of_alpha.0), of_color.1.max(of_alpha.1));
    let texels = |(width, height): (u32, u32)| u64::from(width) * u64::from(height);
    if texels((width, height)) > 4 * texels(of_color).max(texels(of_alpha)) {
        return Err(format!(
            "an image of {of_color:?} texels has an alpha map of {of_alpha:?}; scale one to the shape of the other"
        ));
    }
    let channel = alpha_of(alpha);
    let mask = scaled(channel, of_alpha, (width, height));
    let texels = color.map_or_else(|| vec![255; 4], |image| image.levels().next().unwrap_or_default().to_vec());
    let mut pixels = scaled(texels, of_color, (width, height));
    for (texel, mask) in pixels.chunks_exact_mut(4).zip(mask.chunks_exact(4)) {
        texel[3] = mask[3];
    }
    Ok(Image { width, height, pixels })
}

/// Texels whose alpha is that of a mask.
fn alpha_of(image: &Image) -> Vec<u8> {
    let texels = image.levels().next().unwrap_or_default();
    let mut texels = texels.to_vec();
    let is_opaque = texels.chunks_exact(4).all(|texel| texel[3] == 255);
    if is_opaque {
        for texel in texels.chunks_exact_mut(4) {
            let [r, g, b] = [texel[0], texel[1], texel[2]].map(u32::from);
            // Brightness of the codes (Rec. 709).
            texel[3] = ((2126 * r + 7152 * g + 722 * b + 5000) / 10_000) as u8;
        }
    }
    texels
}

/// Texels of an image of another size.
fn scaled(texels: Vec<u8>, (width, height): (u32, u32), to: (u32, u32)) -> Vec<u8> {
    if (width, height) == to {
        return texels;
    }
    let image = RgbaImage::from_raw(width, height, texels).unwrap_or_default();
    imageops::resize(&image, to.0, to.1, imageops::FilterType::Triangle).into_raw()
}
