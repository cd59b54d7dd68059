//! Image files: readers find what was written.

use clap::ValueEnum;
use exr::meta::attribute::{AttributeValue, Chromaticities, EnvironmentMap, Preview};
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds, Layer, LayerAttributes,
    ReadChannels, ReadLayers, Vec2, WritableImage, f16, read as read_exr,
};
use gpc::color::srgb;
use gpc::output::{
    Aov, AovKind, Format, OutputError, Picture, decode, decode_light, decode_linear, encode, encode_aov, read,
    write_atomically,
};
use gpc::render::PixelAttributes;
use std::io::Cursor;

/// A picture of 16 x 16 pixels whose colours are the 256 8-bit code values.
fn ramp(alpha: f32) -> Vec<[f32; 4]> {
    (0..=255)
        .map(|code| {
            let v = srgb::decode_u8(code) as f32;
            [v * alpha, 0.5 * v * alpha, alpha * (1.0 - v), alpha]
        })
        .collect()
}

fn encoded(format: Format, pixels: &[[f32; 4]], size: [u32; 2]) -> Vec<u8> {
    encode(format, &Picture::new(size, pixels).unwrap(), &[]).unwrap()
}

#[test]
fn png_keeps_every_code_value() {
    let bytes = encoded(Format::Png8, &ramp(1.0), [16, 16]);
    let image = image::load_from_memory(&bytes).unwrap();
    assert_eq!(image.color(), image::ColorType::Rgb8);
    for (code, pixel) in image.to_rgb8().pixels().enumerate() {
        assert_eq!(usize::from(pixel[0]), code);
    }
}

#[test]
fn png_of_16_bits_is_within_half_a_step() {
    let pixels = ramp(1.0);
    let bytes = encoded(Format::Png16, &pixels, [16, 16]);
    let image = image::load_from_memory(&bytes).unwrap();
    assert_eq!(image.color(), image::ColorType::Rgb16);
    for (pixel, expected) in image.to_rgb16().pixels().zip(&pixels) {
        for i in 0..3 {
            let exact = srgb::encode(f64::from(expected[i])) * 65_535.0;
            assert!((f64::from(pixel[i]) - exact).abs() <= 0.5);
        }
    }
}

#[test]
fn png_holds_straight_alpha() {
    let bytes = encoded(Format::Png8, &ramp(0.5), [16, 16]);
    let image = image::load_from_memory(&bytes).unwrap();
    assert_eq!(image.color(), image::ColorType::Rgba8);
    for (code, pixel) in image.to_rgba8().pixels().enumerate() {
        assert_eq!((usize::from(pixel[0]), pixel[3]), (code, 128));
    }
}

#[test]
fn colour_without_coverage_is_not_written() {
    let bytes = encoded(Format::Png8, &[[0.3, 0.2, 0.1, 0.0]], [1, 1]);
    let image = image::load_from_memory(&bytes).unwrap().to_rgba8();
    assert_eq!(image.as_raw(), &[0, 0, 0, 0]);
}

#[test]
fn numbers_that_no_file_can_hold_are_bounded() {
    let pixels = [[f32::NAN, f32::INFINITY, -1.0, 1.0], [9.0, 0.0, 0.0, 2.0]];
    let bytes = encoded(Format::Png8, &pixels, [2, 1]);
    let image = image::load_from_memory(&bytes).unwrap().to_rgb8();
    assert_eq!(image.as_raw(), &[0, 255, 0, 255, 0, 0]);
}

#[test]
fn jpeg_shows_colour_over_black() {
    let pixels = vec![[0.25, 0.25, 0.25, 0.25]; 64];
    let bytes = encoded(Format::Jpeg, &pixels, [8, 8]);
    let image = image::load_from_memory(&bytes).unwrap().to_rgb8();
    let expected = i32::from(srgb::encode_u8(0.25));
    assert!((i32::from(image.get_pixel(3, 3)[0]) - expected).abs() <= 2);
}

fn all_aovs(pixels: usize) -> Vec<Aov> {
    let attribute = |i: usize| PixelAttributes {
        depth: i as f32 * 0.5,
        id: i as u32,
        samples: (i % 3 * 512) as u32,
        superpixel: (i % 2) as u32,
        normal: [0.0, if i == 0 { 0.0 } else { 1.0 }, 0.0],
        padding: 0,
    };
    let attributes: Vec<_> = (0..pixels).map(attribute).collect();
    AovKind::value_variants().iter().map(|kind| Aov::from_attributes(*kind, &attributes)).collect()
}

#[test]
fn exr_holds_the_very_floats_and_ids() {
    let pixels = [[0.1, 7.5, -0.25, 0.5], [1e-6, 1e6, 0.0, 1.0], [0.0; 4]];
    let picture = Picture::new([3, 1], &pixels).unwrap();
    let bytes = encode(Format::Exr, &picture, &all_aovs(3)).unwrap();
    let image = read_exr()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .unwrap();
    let channels = &image.layer_data.channel_data.list;
    let find = |name: &str| {
        let found = channels.iter().find(|channel| channel.name.eq(name));
        &found.unwrap_or_else(|| panic!("no channel {name}")).sample_data
    };
    for (i, name) in ["R", "G", "B", "A"].into_iter().enumerate() {
        let expected: Vec<_> = pixels.iter().map(|p| p[i]).collect();
        assert_eq!(*find(name), FlatSamples::F32(expected));
    }
    assert_eq!(*find("id.Y"), FlatSamples::U32(vec![0, 1, 2]));
    assert_eq!(*find("samples.Y"), FlatSamples::U32(vec![0, 512, 1024]));
    assert_eq!(*find("superpixels.Y"), FlatSamples::U32(vec![0, 1, 0]));
    assert_eq!(*find("depth.Z"), FlatSamples::F32(vec![f32::INFINITY, 0.5, 1.0]));
    assert_eq!(*find("normal.Y"), FlatSamples::F32(vec![0.0, 1.0, 1.0]));
    assert_eq!(channels.len(), 11);
}

/// An EXR file of 2 x 1 pixels at `start`, in a display window of `size` that starts at (3, 4).
fn exr_file(channels: &[(&str, FlatSamples)], start: [i32; 2], size: [usize; 2]) -> Vec<u8> {
    let channel = |(name, samples): &(&str, FlatSamples)| AnyChannel::new(*name, samples.clone());
    let mut layer = Layer::new(
        (2, 1),
        LayerAttributes::default(),
        Encoding::UNCOMPRESSED,
        AnyChannels::sort(channels.iter().map(channel).collect()),
    );
    layer.attributes.layer_position = Vec2(start[0], start[1]);
    let window = IntegerBounds::new((3, 4), (size[0], size[1]));
    let mut bytes = Cursor::new(Vec::new());
    Image::new(ImageAttributes::new(window), layer).write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

fn two(first: f32, second: f32) -> FlatSamples {
    FlatSamples::F32(vec![first, second])
}

#[test]
fn exr_is_placed_in_its_display_window() {
    let colors = [("R", two(1., 2.)), ("G", two(3., 4.)), ("B", two(5., 6.))];
    let (first, second, none) = ([1., 3., 5., 1.], [2., 4., 6., 1.], [0.; 4]);
    for (start, size, expected) in [
        ([3, 4], [2, 1], vec![first, second]),
        ([4, 5], [3, 2], vec![none, none, none, none, first, second]),
        // Beyond the left border, and wholly outside.
        ([2, 4], [2, 1], vec![second, none]),
        ([-9, 4], [2, 1], vec![none, none]),
    ] {
        let (found, pixels) = decode_linear(&exr_file(&colors, start, size), "x").unwrap();
        assert_eq!(found.map(|side| side as usize), size);
        assert_eq!(pixels, expected, "{start:?}");
    }
}

#[test]
fn exr_channels_are_read_or_named() {
    let read = |channels: &[(&str, FlatSamples)]| {
        decode_linear(&exr_file(channels, [3, 4], [2, 1]), "x").map(|(_, pixels)| pixels)
    };
    let grey = read(&[("Y", two(0.5, 2.0))]).unwrap();
    assert_eq!(grey, [[0.5, 0.5, 0.5, 1.0], [2.0, 2.0, 2.0, 1.0]]);
    let layer = |name: &str| ["R", "G", "B", "A"].map(|channel| format!("{name}.{channel}"));
    let of = |names: &[String]| {
        let named = |(i, name): (usize, &String)| (name.clone(), two(i as f32, 9.0));
        names.iter().enumerate().map(named).collect::<Vec<_>>()
    };
    let with_names = |named: &[(String, FlatSamples)]| {
        let channels: Vec<_> = named.iter().map(|(name, s)| (name.as_str(), s.clone())).collect();
        read(&channels)
    };
    let beauty = with_names(&of(&layer("beauty"))).unwrap();
    assert_eq!(beauty[0], [0.0, 1.0, 2.0, 3.0]);
    for (named, told) in [
        (of(&[layer("sun"), layer("sky")].concat()), "sky.A, sky.B"),
        (of(&["Y", "RY", "BY"].map(String::from)), "BY, RY, Y"),
        (of(&["Z".to_owned()]), "the channels Z;"),
    ] {
        let error = with_names(&named).unwrap_err().to_string();
        assert!(error.contains(told), "{error}");
    }
}

/// A header claims any size, but a file of some bytes is not read as a huge image.
#[test]
fn images_cannot_claim_what_is_not_there() {
    let colors = [("R", two(1., 2.)), ("G", two(3., 4.)), ("B", two(5., 6.))];
    // A small data window in a large display window is an ordinary crop.
    let crop = decode_light(&exr_file(&colors, [3, 4], [4096, 2160]), "x").unwrap();
    assert_eq!((crop.size, crop.colors[1], crop.colors[2]), ([4096, 2160], [2., 4., 6.], [0.; 3]));
    for size in [[8192, 4096], [60_000, 60_000]] {
        let error = decode_light(&exr_file(&colors, [3, 4], size), "x").unwrap_err().to_string();
        assert!(error.contains(&format!("{} x {}", size[0], size[1])), "{error}");
    }
    // The size of a whole image, by its data window, and by those of other formats.
    let mut exr = exr_file(&colors, [3, 4], [2, 1]);
    let data = exr.windows(10).position(|window| window == b"dataWindow").unwrap() + 10 + 1 + 6 + 4;
    exr[data + 8..data + 16].copy_from_slice(bytemuck::cast_slice(&[8192_i32, 8192]));
    assert!(decode_light(&exr, "x").unwrap_err().to_string().contains("data window claims 8190 x 8189"));
    let hdr = b"#?RADIANCE\n\n-Y 8192 +X 8192\n\x01\x01\x01\x01";
    assert!(decode_light(hdr, "x").unwrap_err().to_string().contains("claims 8192 x 8192"));
    let mut png = encoded(Format::Png8, &ramp(1.0), [16, 16]);
    png[16..24].copy_from_slice(&[0, 0, 0x20, 0, 0, 0, 0x20, 0]);
    let check = crc(&png[12..29]).to_be_bytes();
    png[29..33].copy_from_slice(&check);
    assert!(decode(&png, "x").unwrap_err().to_string().contains("claims 8192 x 8192"));
    let mut jpeg = encoded(Format::Jpeg, &ramp(1.0), [16, 16]);
    let frame = jpeg.windows(2).position(|marker| marker == [0xff, 0xc0]).unwrap();
    jpeg[frame + 5..frame + 9].copy_from_slice(&[0x20, 0, 0x20, 0]);
    assert!(decode(&jpeg, "x").unwrap_err().to_string().contains("claims 8192 x 8192"));
}

/// Cyclic redundancy check of a chunk of a PNG file.
fn crc(bytes: &[u8]) -> u32 {
    let step = |sum: u32| if sum & 1 > 0 { 0xEDB8_8320 ^ (sum >> 1) } else { sum >> 1 };
    !bytes.iter().fold(u32::MAX, |sum, byte| (0..8).fold(sum ^ u32::from(*byte), |sum, _| step(sum)))
}

/// Everything that the format has is used or named.
#[test]
fn everything_in_exr() {
    let named = |bytes: &[u8]| decode_light(bytes, "x").unwrap().warnings;
    let colors = || ["R", "G", "B"].map(|name| AnyChannel::new(name, two(1., 2.)));
    let layer = |channels: Vec<AnyChannel<FlatSamples>>, encoding| {
        Layer::new((2, 1), LayerAttributes::default(), encoding, AnyChannels::sort(channels.into_iter().collect()))
    };
    let window = IntegerBounds::new((0, 0), (2, 1));
    let written = |image: &dyn Fn(&mut Cursor<Vec<u8>>)| {
        let mut bytes = Cursor::new(Vec::new());
        image(&mut bytes);
        bytes.into_inner()
    };
    let plain = Image::new(ImageAttributes::new(window), layer(colors().to_vec(), Encoding::UNCOMPRESSED));
    assert!(named(&written(&|bytes| plain.write().to_buffered(bytes).unwrap())).is_empty());

    let more = ["A", "Z", "diffuse.R"].map(|name| AnyChannel::new(name, two(1., 0.5)));
    let mut rich = layer([&colors()[..], &more].concat(), Encoding::UNCOMPRESSED);
    let own = &mut rich.attributes;
    own.layer_name = Some("beauty".into());
    own.layer_position = Vec2(-1, 0);
    own.white_luminance = Some(80.0);
    own.adopted_neutral = Some(Vec2(0.3, 0.3));
    own.rendering_transform_name = Some("a".into());
    own.look_modification_transform_name = Some("a".into());
    own.wrap_mode_name = Some("clamp".into());
    own.view_name = Some("left".into());
    own.world_to_camera = Some([0.0; 16]);
    own.world_to_normalized_device = Some([0.0; 16]);
    own.multi_view_names = Some(vec!["left".into()]);
    own.screen_window_center = Vec2(1.0, 0.0);
    own.screen_window_width = 2.0;
    own.preview = Some(Preview { size: Vec2(1, 1), pixel_data: vec![0; 4] });
    own.environment_map = Some(EnvironmentMap::LatitudeLongitude);
    // What is like a comment is not named.
    own.owner = Some("o".into());
    own.comments = Some("c".into());
    own.other.insert("custom".into(), AttributeValue::F32(1.0));
    own.other.insert("note".into(), AttributeValue::Text("t".into()));
    let mut second = layer(colors().to_vec(), Encoding::UNCOMPRESSED);
    second.attributes.layer_name = Some("second".into());
    let mut attributes = ImageAttributes::new(window);
    attributes.pixel_aspect = 2.0;
    let at = |x, y| Vec2(x, y);
    attributes.chromaticities =
        Some(Chromaticities { red: at(0.7, 0.3), green: at(0.2, 0.8), blue: at(0.1, 0.1), white: at(0.3, 0.3) });
    let image = Image::empty(attributes).with_layer(rich).with_layer(second);
    let bytes = written(&|bytes| image.write().to_buffered(bytes).unwrap());
    let expected = "x: left out: attributes (15: adoptedNeutral, chromaticities, custom, lookModTransform, multiView, pixelAspectRatio, \
        preview, renderingTransform, screenWindowCenter, screenWindowWidth, view, whiteLuminance, worldToCamera, worldToNDC, \
        wrapmodes); channels (2: Z, diffuse.R); parts (1: second); pixels outside the display window (1); \
        transparency of pixels (1)";
    assert_eq!(named(&bytes), [expected]);

    let mut cube = layer(colors().to_vec(), Encoding::UNCOMPRESSED);
    cube.attributes.environment_map = Some(EnvironmentMap::Cube);
    let cube = Image::new(ImageAttributes::new(window), cube);
    let cube = written(&|bytes| cube.write().to_buffered(bytes).unwrap());
    assert!(decode_light(&cube, "x").unwrap_err().to_string().contains("faces of a cube"));
}

/// Everything that the format's description has is used or named.
#[test]
fn everything_in_hdr() {
    let named = |head: &str, rest: &[u8]| {
        let pixel = [128, 128, 128, 129];
        let bytes = [head.as_bytes(), b"\n-Y 1 +X 1\n", &pixel, rest].concat();
        decode_light(&bytes, "x").unwrap().warnings
    };
    let neutral = "#?RADIANCE\n# comment = 5\noconv a.rad\nrpict -vp 1 2 3 -av=1\nSOFTWARE=gpc\nCAPDATE=2026:01:01\n\
        EXPOSURE= 1.0\nCOLORCORR=1 1 1\nPIXASPECT=1\nPRIMARIES=.64 .33 .29 .6 .15 .06 .3333 .3333\nGAMMA=1\n\
        FORMAT=32-bit_rle_rgbe\n";
    assert_eq!(named(neutral, b""), [""; 0]);
    let rich = "#?RADIANCE\nEXPOSURE=2\nEXPOSURE=3\nCOLORCORR=1 .5 1\nPIXASPECT=.5\nVIEW=-vta -vh 360\nGAMMA=2.2\n\
        PRIMARIES=.7 .3 .2 .8 .1 .1 .3 .3\nLATLONG=1\n";
    let expected = "x: left out: bytes behind the scanlines (4); \
        variables (8: EXPOSURE, COLORCORR, PIXASPECT, VIEW, GAMMA, PRIMARIES, LATLONG)";
    assert_eq!(named(rich, b"more"), [expected]);
}

#[test]
fn infinite_light_is_bounded() {
    let halves = |a: f32, b: f32| FlatSamples::F16(vec![f16::from_f32(a), f16::from_f32(b)]);
    let floats = |a: f32, b: f32| FlatSamples::F32(vec![a, b]);
    let light = |channels: [(&str, FlatSamples); 3]| {
        let light = decode_light(&exr_file(&channels, [3, 4], [2, 1]), "x").unwrap();
        (light.colors, light.warnings)
    };
    let infinite = f32::INFINITY;
    let (colors, warnings) = light([("R", halves(infinite, 2.0)), ("G", halves(1.0, 3.0)), ("B", halves(1.0, 3.0))]);
    assert_eq!(colors, [[65_504.0, 1.0, 1.0], [2.0, 3.0, 3.0]]);
    assert_eq!(warnings, ["x: 1 pixels are infinitely bright and are taken as 65504"]);
    let (colors, _) = light([("R", floats(infinite, 1e6)), ("G", floats(infinite, 0.0)), ("B", floats(infinite, 0.0))]);
    assert_eq!(colors, [[1e6; 3], [1e6, 0.0, 0.0]]);
    let (_, warnings) = light([("R", floats(f32::NAN, 1.0)), ("G", floats(1.0, 1.0)), ("B", floats(-1.0, 1.0))]);
    assert_eq!(warnings, [""; 0]);
}

#[test]
fn aovs_can_be_looked_at() {
    let grey = |aov: &Aov| {
        let bytes = encode_aov([3, 1], aov).unwrap();
        image::load_from_memory(&bytes).unwrap().into_luma16().into_raw()
    };
    let [depth, id, normal, superpixels, samples] = all_aovs(3).try_into().unwrap();
    assert_eq!(grey(&depth), [0, 65_535, 1]);
    assert_eq!(grey(&samples), [0, 32_768, 65_535]);
    assert_eq!(grey(&superpixels), [0, 65_535, 0]);
    let rgb = |aov: &Aov| {
        let bytes = encode_aov([3, 1], aov).unwrap();
        image::load_from_memory(&bytes).unwrap().into_rgb8()
    };
    let colors: Vec<_> = rgb(&id).pixels().map(|p| p.0).collect();
    assert_eq!(colors[0], [0; 3]);
    assert_ne!(colors[1], [0; 3]);
    assert_ne!(colors[1], colors[2]);
    let normals = rgb(&normal);
    assert_eq!(normals.get_pixel(0, 0).0, [0; 3]);
    assert_eq!(normals.get_pixel(1, 0).0, [128, 255, 128]);
}

#[test]
fn every_format_reads_back() {
    let folder = tempfile::tempdir().unwrap();
    let pixels = ramp(0.5);
    for name in ["a.png", "a.16.png", "a.jpg", "a.exr"] {
        let path = folder.path().join(name);
        let format = Format::of(&path).unwrap();
        write_atomically(&path, &encoded(format, &pixels, [16, 16])).unwrap();
        let image = read(&path).unwrap();
        assert_eq!(image.size, [16, 16]);
        for (found, expected) in image.pixels.iter().zip(&pixels) {
            let shown = srgb::encode(f64::from(expected[0]));
            let tolerance = if name == "a.jpg" { 0.03 } else { 0.005 };
            assert!((f64::from(found[0]) - shown).abs() < tolerance, "{name}");
        }
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 4);
}

#[test]
fn a_count_of_pixels_that_does_not_fit_is_refused() {
    let wrong = |size| matches!(Picture::new(size, &[[0.0; 4]; 6]), Err(OutputError::PixelCount { .. }));
    assert!(wrong([2, 2]) && wrong([0, 0]) && !wrong([3, 2]));
    let pixels = [[0.0; 4]; 6];
    let picture = Picture::new([3, 2], &pixels).unwrap();
    assert!(encode(Format::Exr, &picture, &all_aovs(5)).is_err());
    assert!(encode_aov([3, 2], &all_aovs(5)[0]).is_err());
}

#[test]
fn what_is_no_image_is_refused() {
    let png = encoded(Format::Png8, &ramp(1.0), [16, 16]);
    let exr = encoded(Format::Exr, &ramp(1.0), [16, 16]);
    let cases: [&[u8]; 5] = [b"", b"glTF", &png[..40], &exr[..100], &exr[..4]];
    for bytes in cases {
        let error = decode(bytes, "file").unwrap_err();
        assert!(matches!(error, OutputError::Decode { .. }), "{error}");
    }
}

#[test]
fn an_exr_that_is_not_a_number_names_the_pixel() {
    let mut pixels = ramp(1.0);
    pixels[16 + 3][2] = f32::NAN;
    let bytes = encoded(Format::Exr, &pixels, [16, 16]);
    let error = decode(&bytes, "a.exr").unwrap_err();
    assert!(matches!(error, OutputError::NotANumber { x: 3, y: 1, .. }), "{error}");
}

#[test]
fn a_failed_write_leaves_what_was_there() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("no such folder").join("a.png");
    assert!(write_atomically(&missing, b"new").is_err());
    let occupied = folder.path().join("occupied");
    std::fs::create_dir(&occupied).unwrap();
    assert!(write_atomically(&occupied, b"new").is_err());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[cfg(unix)]
#[test]
fn a_link_is_kept_and_its_target_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let [target, link] = ["target.png", "link.png"].map(|name| folder.path().join(name));
    std::fs::write(&target, b"old").unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    write_atomically(&link, b"new").unwrap();
    assert!(link.is_symlink());
    assert_eq!(std::fs::read(&target).unwrap(), b"new");
}
