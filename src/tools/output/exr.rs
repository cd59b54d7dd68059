//! OpenEXR files, read and written by the `exr` crate.

use super::{Aov, OutputError, Picture, check_count};
use ::exr::prelude::*;
use std::io::Cursor;

/// Encodes a file with one part: the picture's R, G, B and A, and a layer for each AOV.
pub(super) fn encode(
    picture: &Picture<'_>,
    aovs: &[Aov],
) -> std::result::Result<Vec<u8>, OutputError> {
    let channel = |i: usize| picture.pixels().iter().map(|pixel| pixel[i]).collect();
    let mut channels: Vec<_> = ["R", "G", "B", "A"]
        .into_iter()
        .enumerate()
        .map(|(i, name)| AnyChannel::new(name, FlatSamples::F32(channel(i))))
        .collect();
    for aov in aovs {
        check_count(picture.size(), aov.len())?;
        channels.extend(layer(aov));
    }
    let [width, height] = picture.size().map(|side| side as usize);
    let image = Image::from_layer(Layer::new(
        (width, height),
        LayerAttributes::default(),
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(channels.into_iter().collect()),
    ));
    let mut bytes = Cursor::new(Vec::new());
    image
        .write()
        .to_buffered(&mut bytes)
        .map_err(|error| OutputError::Encode(error.to_string()))?;
    Ok(bytes.into_inner())
}

fn layer(aov: &Aov) -> Vec<AnyChannel<FlatSamples>> {
    let kind = aov.kind();
    let channel = |name: &str, samples| {
        AnyChannel::new(Text::new_or_panic(format!("{kind}.{name}")), samples)
    };
    match aov {
        Aov::Depth(depths) => vec![channel("Z", FlatSamples::F32(depths.clone()))],
        Aov::Id(values) | Aov::Samples(values) => {
            vec![channel("Y", FlatSamples::U32(values.clone()))]
        }
        Aov::Superpixels(flags) => {
            let values = flags.iter().map(|flag| u32::from(*flag)).collect();
            vec![channel("Y", FlatSamples::U32(values))]
        }
        Aov::Normal(normals) => ["X", "Y", "Z"]
            .into_iter()
            .enumerate()
            .map(|(i, name)| {
                let values = normals.iter().map(|normal| normal[i]).collect();
                channel(name, FlatSamples::F32(values))
            })
            .collect(),
    }
}

/// Largest number of pixels that is read, so that a header can't claim memory far beyond the file's size.
const MAX_PIXELS: usize = 1 << 28;

/// Size and pixels of the first layer that has R, G and B; alpha is 1 if the layer has none.
pub(super) fn decode(bytes: &[u8]) -> std::result::Result<([u32; 2], Vec<[f32; 4]>), String> {
    let text = |error: Error| error.to_string();
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(text)?;
    for header in &meta.headers {
        let size = header.layer_size;
        if size.width().saturating_mul(size.height()) > MAX_PIXELS {
            return Err(format!(
                "it has {} x {} pixels, more than the {MAX_PIXELS} that are read",
                size.width(),
                size.height()
            ));
        }
    }
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgba_channels(
            |size, _| (size, vec![[0.0; 4]; size.area()]),
            |(size, pixels), position, (r, g, b, a): (f32, f32, f32, f32)| {
                if let Some(pixel) = pixels.get_mut(position.y() * size.width() + position.x()) {
                    *pixel = [r, g, b, a];
                }
            },
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(text)?;
    let (size, pixels) = image.layer_data.channel_data.pixels;
    let side = |side: usize| u32::try_from(side).map_err(|_| "a side is too long".to_owned());
    Ok(([side(size.width())?, side(size.height())?], pixels))
}
