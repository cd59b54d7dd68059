//! OpenEXR files, read and written by the `exr` crate.

use super::{Aov, OutputError, Picture, check_count};
use crate::names::name;
use crate::scene::{Warnings, check_texels};
use ::exr::meta::BlockDescription;
use ::exr::meta::attribute::{AttributeValue, Chromaticities, EnvironmentMap, LevelMode};
use ::exr::meta::header::Header;
use ::exr::prelude::*;
use std::collections::BTreeSet;
use std::io::Cursor;

/// Encodes a file with one part: the picture's R, G, B and A, and a layer for each AOV.
pub(super) fn encode(picture: &Picture<'_>, aovs: &[Aov]) -> std::result::Result<Vec<u8>, OutputError> {
    let mut channels = floats(["R", "G", "B", "A"].map(Text::from), picture.pixels());
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
    image.write().to_buffered(&mut bytes).map_err(|error| OutputError::Encode(error.to_string()))?;
    Ok(bytes.into_inner())
}

/// Channels with these names, one for each component of the pixels.
fn floats<const N: usize>(names: [Text; N], pixels: &[[f32; N]]) -> Vec<AnyChannel<FlatSamples>> {
    let channel = |(i, name): (usize, Text)| {
        AnyChannel::new(name, FlatSamples::F32(pixels.iter().map(|pixel| pixel[i]).collect()))
    };
    names.into_iter().enumerate().map(channel).collect()
}

fn layer(aov: &Aov) -> Vec<AnyChannel<FlatSamples>> {
    let kind = name(&aov.kind());
    let named = |channel: &str| Text::new_or_panic(format!("{kind}.{channel}"));
    let channel = |channel: &str, samples| AnyChannel::new(named(channel), samples);
    match aov {
        Aov::Depth(depths) => vec![channel("Z", FlatSamples::F32(depths.clone()))],
        Aov::Id(values) | Aov::Samples(values) => {
            vec![channel("Y", FlatSamples::U32(values.clone()))]
        }
        Aov::Superpixels(flags) => {
            let values = flags.iter().map(|flag| u32::from(*flag)).collect();
            vec![channel("Y", FlatSamples::U32(values))]
        }
        Aov::Normal(normals) => floats(["X", "Y", "Z"].map(named), normals),
    }
}

/// Largest number of pixels that is read.
const MAX_PIXELS: usize = 1 << 28;

/// Channels that an image is read from.
#[derive(Debug, PartialEq)]
enum Chosen {
    Colors { rgb: [Text; 3], alpha: Text },
    Luminance,
}

impl Chosen {
    /// Whether the image is read from a channel.
    fn has(&self, name: &Text) -> bool {
        match self {
            Self::Colors { rgb, alpha } => rgb.contains(name) || alpha == name,
            Self::Luminance => [Text::from("Y"), Text::from("A")].contains(name),
        }
    }

    fn are_in(&self, header: &Header) -> bool {
        let has = |name: &Text| header.channels.find_index_of_channel(name).is_some();
        !header.deep
            && match self {
                Self::Colors { rgb, .. } => rgb.iter().all(has),
                Self::Luminance => has(&Text::from("Y")),
            }
    }

    /// Chooses R, G and B; otherwise Y, if it is luminance alone; otherwise the only layer with R, G and B.
    fn of(headers: &[Header]) -> std::result::Result<Self, String> {
        let colors = |layer: &str| {
            let name = |channel: &str| Text::new_or_none(format!("{layer}{channel}"));
            Some(Self::Colors { rgb: [name("R")?, name("G")?, name("B")?], alpha: name("A")? })
        };
        let is_there = |chosen: &Self| headers.iter().any(|header| chosen.are_in(header));
        let names: Vec<String> =
            headers.iter().flat_map(|header| &header.channels.list).map(|channel| channel.name.to_string()).collect();
        let has = |name: &str| names.iter().any(|known| known == name);
        let luminance = Some(Self::Luminance).filter(|_| !has("RY") && !has("BY"));
        let first = [colors(""), luminance].into_iter().flatten().find(is_there);
        if let Some(chosen) = first {
            return Ok(chosen);
        }
        let layers = names.iter().filter_map(|name| name.strip_suffix('R'));
        let layers: BTreeSet<&str> = layers.filter(|layer| layer.ends_with('.')).collect();
        let mut layers: Vec<Self> = layers.into_iter().filter_map(colors).collect();
        layers.retain(is_there);
        match (layers.len(), layers.pop()) {
            (1, Some(layer)) => Ok(layer),
            _ => Err(format!(
                "{}it has the channels {}; what is read is R, G and B, Y alone, or a layer's R, G and B if only one layer has them",
                if headers.iter().all(|header| header.deep) { "its data are deep; " } else { "" },
                names.join(", ")
            )),
        }
    }
}

/// An image of a file.
pub(super) struct Decoded {
    pub(super) size: [u32; 2],
    /// Alpha is 1 if the file has none.
    pub(super) pixels: Vec<[f32; 4]>,
    /// Whether the image has the six faces of a cube below each other.
    pub(super) is_cube: bool,
}

/// Reads the first part that has R, G and B, or what is [chosen](Chosen::of) otherwise. The image is the display window: pixels
/// outside the data window are transparent black, and data outside the display window are not part of the image. What is not
/// read is named in `left_out`.
pub(super) fn decode(bytes: &[u8], left_out: &mut Warnings) -> std::result::Result<Decoded, String> {
    let text = |error: Error| error.to_string();
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(text)?;
    let chosen = Chosen::of(&meta.headers)?;
    let index = meta.headers.iter().position(|header| chosen.are_in(header));
    let header = index.and_then(|index| meta.headers.get(index)).ok_or("it has no image")?;
    let window = header.shared_attributes.display_window;
    for (name, size) in [("data", header.layer_size), ("display", window.size)] {
        let [width, height] = [size.width(), size.height()];
        if width.saturating_mul(height) > MAX_PIXELS {
            return Err(format!("it has {width} x {height} pixels, more than the {MAX_PIXELS} that are read"));
        }
        check_texels(width as u64, height as u64, bytes.len())
            .map_err(|reason| format!("its {name} window {reason}; crop the window, or export the image again"))?;
    }
    name_unused(&meta.headers, index, &chosen, left_out);
    let along = |start: i32, end: i32| i64::from(start) - i64::from(end);
    let start = header.own_attributes.layer_position;
    let (left, top) = (along(start.x(), window.position.x()), along(start.y(), window.position.y()));
    let (width, height) = (window.size.width(), window.size.height());
    let place = |start: i64, at: usize, side: usize| {
        let at = usize::try_from(start + at as i64).ok();
        at.filter(|at| *at < side)
    };
    let inside =
        |start: i64, length: usize, side: usize| (0..length).filter(|at| place(start, *at, side).is_some()).count();
    let shown = inside(left, header.layer_size.width(), width) * inside(top, header.layer_size.height(), height);
    left_out.leave_out("pixels outside the display window", header.layer_size.area() - shown, "");
    let set = move |pixels: &mut Vec<[f32; 4]>, at: Vec2<usize>, value: [f32; 4]| {
        let (x, y) = (place(left, at.x(), width), place(top, at.y(), height));
        let index = x.zip(y).map(|(x, y)| y * width + x);
        if let Some(pixel) = index.and_then(|index| pixels.get_mut(index)) {
            *pixel = value;
        }
    };
    let black = move || vec![[0.0; 4]; width * height];
    let reader = read().no_deep_data().largest_resolution_level().specific_channels();
    let bytes = Cursor::new(bytes);
    let pixels = match chosen {
        Chosen::Colors { rgb: [r, g, b], alpha } => reader
            .required(r)
            .required(g)
            .required(b)
            .optional(alpha, 1.0_f32)
            .collect_pixels(
                move |_, _| black(),
                move |pixels, at, (r, g, b, a): (f32, f32, f32, f32)| set(pixels, at, [r, g, b, a]),
            )
            .first_valid_layer()
            .all_attributes()
            .from_buffered(bytes)
            .map(|image| image.layer_data.channel_data.pixels),
        Chosen::Luminance => reader
            .required("Y")
            .optional("A", 1.0_f32)
            .collect_pixels(move |_, _| black(), move |pixels, at, (y, a): (f32, f32)| set(pixels, at, [y, y, y, a]))
            .first_valid_layer()
            .all_attributes()
            .from_buffered(bytes)
            .map(|image| image.layer_data.channel_data.pixels),
    };
    let side = |side: usize| u32::try_from(side).map_err(|_| "a side is too long".to_owned());
    Ok(Decoded {
        size: [side(width)?, side(height)?],
        pixels: pixels.map_err(text)?,
        is_cube: header.own_attributes.environment_map == Some(EnvironmentMap::Cube),
    })
}

/// Names the parts, channels, levels and attributes that are not read. Attributes that say who made the image, when, and with
/// what are like comments, and are not named.
fn name_unused(headers: &[Header], used: Option<usize>, chosen: &Chosen, left_out: &mut Warnings) {
    for (index, header) in headers.iter().enumerate() {
        let own = &header.own_attributes;
        if Some(index) != used {
            let name = own.layer_name.as_ref().map_or_else(|| format!("part {index}"), ToString::to_string);
            left_out.leave_out("parts", 1, &if header.deep { name + " (deep data)" } else { name });
            continue;
        }
        for channel in header.channels.list.iter().filter(|channel| !chosen.has(&channel.name)) {
            left_out.leave_out("channels", 1, &channel.name.to_string());
        }
        if let BlockDescription::Tiles(tiles) = header.blocks
            && tiles.level_mode != LevelMode::Singular
        {
            left_out.leave_out("smaller levels of the image", 1, "");
        }
        let shared = &header.shared_attributes;
        let known = [
            ("adoptedNeutral", own.adopted_neutral.is_some()),
            ("chromaticities", shared.chromaticities.as_ref().is_some_and(|colors| !is_rec709(colors))),
            ("lookModTransform", own.look_modification_transform_name.is_some()),
            ("multiView", own.multi_view_names.is_some()),
            ("pixelAspectRatio", shared.pixel_aspect != 1.0),
            ("preview", own.preview.is_some()),
            ("renderingTransform", own.rendering_transform_name.is_some()),
            ("screenWindowCenter", own.screen_window_center != Vec2(0.0, 0.0)),
            ("screenWindowWidth", own.screen_window_width != 1.0),
            ("view", own.view_name.is_some()),
            ("whiteLuminance", own.white_luminance.is_some()),
            ("worldToCamera", own.world_to_camera.is_some()),
            ("worldToNDC", own.world_to_normalized_device.is_some()),
            ("wrapmodes", own.wrap_mode_name.is_some()),
        ];
        let known = known.into_iter().filter(|(_, is_there)| *is_there).map(|(name, _)| name.to_owned());
        let others = own.other.iter().chain(&shared.other);
        let others =
            others.filter(|(_, value)| !matches!(value, AttributeValue::Text(_) | AttributeValue::TextVector(_)));
        let mut names: Vec<String> = known.chain(others.map(|(name, _)| name.to_string())).collect();
        names.sort();
        names.iter().for_each(|name| left_out.leave_out("attributes", 1, name));
    }
}

/// Whether colours are those of the primaries and the white of Rec. 709, which are also those of sRGB.
fn is_rec709(colors: &Chromaticities) -> bool {
    let expected = [
        (colors.red, [0.64, 0.33]),
        (colors.green, [0.3, 0.6]),
        (colors.blue, [0.15, 0.06]),
        (colors.white, [0.3127, 0.329]),
    ];
    expected.iter().all(|(found, [x, y])| (found.x() - x).abs() < 1e-3 && (found.y() - y).abs() < 1e-3)
}
