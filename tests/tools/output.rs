//! Image files: readers find what was written.

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds, Layer, LayerAttributes,
    ReadChannels, ReadLayers, Vec2, WritableImage, f16, read as read_exr,
};
use gpc::color::srgb;
use gpc::output::{
    Aov, AovKind, Format, OutputError, Picture, bound_light, decode, decode_light, decode_linear, encode, encode_aov,
    read, write_atomically,
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
    AovKind::ALL.map(|kind| Aov::from_attributes(kind, &attributes)).into()
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

#[test]
fn infinite_light_is_bounded() {
    let halves = |a: f32, b: f32| FlatSamples::F16(vec![f16::from_f32(a), f16::from_f32(b)]);
    let red = ("R", halves(f32::INFINITY, 2.0));
    let half = exr_file(&[red, ("G", halves(1.0, 3.0)), ("B", halves(1.0, 3.0))], [3, 4], [2, 1]);
    let (_, mut colors) = decode_light(&half, "x").unwrap();
    assert_eq!(bound_light(&mut colors), (1, 65_504.0));
    assert_eq!(colors, [[65_504.0, 1.0, 1.0], [2.0, 3.0, 3.0]]);
    let mut brighter = [[f32::INFINITY; 3], [1e6, 0.0, 0.0]];
    assert_eq!(bound_light(&mut brighter), (1, 1e6));
    assert_eq!(brighter, [[1e6; 3], [1e6, 0.0, 0.0]]);
    assert_eq!(bound_light(&mut [[f32::NAN, 1.0, -1.0]]).0, 0);
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
