//! `--environment`, from files to images.

use crate::command::{Run, asset, gpc};
use gpc::compare::compare;
use gpc::output::read;
use image::{ImageFormat, Rgb, Rgb32FImage};
use std::path::Path;

const SIZE: (u32, u32) = (64, 32);

/// A sky that is bright and red on the right half of the image, and dim on the left.
fn sky() -> Rgb32FImage {
    Rgb32FImage::from_fn(SIZE.0, SIZE.1, |x, _| Rgb(if x < SIZE.0 / 2 { [0.25; 3] } else { [4.0, 2.0, 1.0] }))
}

fn write_exr(path: &Path) {
    let sky = sky();
    exr::prelude::write_rgb_file(path, SIZE.0 as usize, SIZE.1 as usize, |x, y| {
        let Rgb([r, g, b]) = *sky.get_pixel(x as u32, y as u32);
        (r, g, b)
    })
    .unwrap();
}

fn render(folder: &Path, output: &str, options: &[&str]) -> Run {
    let scene = asset("clearcoat.glb");
    let fixed = ["--size", "160x90", "--samples", "16", "-o", output];
    gpc(folder, &[&["render", &scene], &fixed[..], options].concat())
}

#[test]
fn skies_light_the_scene_from_their_side() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    sky().save_with_format(at("sky.hdr"), ImageFormat::Hdr).unwrap();
    write_exr(&at("sky.exr"));
    let image = |name: &str, options: &[&str]| {
        render(folder.path(), name, options).ok();
        read(&at(name)).unwrap()
    };
    let studio = image("studio.png", &[]);
    let hdr = image("hdr.png", &["--environment", "sky.hdr"]);
    let exr = image("exr.png", &["--environment", "sky.exr"]);
    // A Radiance file has 8 bits for each colour.
    assert!(compare(&hdr, &exr).unwrap().rmse < 0.005);
    assert!(compare(&studio, &exr).unwrap().rmse > 0.05);
    let back = image("back.png", &["--environment", "sky.exr", "--environment-rotation", "180"]);
    // Green light on the left and right half of the sphere in the middle.
    let halves = |image: &gpc::output::DecodedImage| {
        let mut sums = [0.0; 2];
        for row in 32..56 {
            for column in 68..92 {
                sums[usize::from(column >= 80)] += image.pixels[160 * row + column][1];
            }
        }
        sums
    };
    let ([left, right], [turned_left, turned_right]) = (halves(&exr), halves(&back));
    assert!(right > 1.3 * left, "{left}, {right}");
    assert!(turned_left > 1.3 * turned_right, "{turned_left}, {turned_right}");
}

/// The sky is the background of scenes, and scenes are antialiased against it.
#[test]
fn the_sky_is_seen_behind_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    write_exr(&at("sky.exr"));
    let sky = ["--environment", "sky.exr", "--background"];
    let behind = ["environment", "--eye", "0,40,0", "--target", "0,40,-9", "--tonemap", "none"];
    render(folder.path(), "sky.png", &[&sky[..], &behind[..]].concat()).ok();
    let image = read(&at("sky.png")).unwrap();
    // Left and right of straight ahead, the sky has a quarter of the red and all of it.
    let row = &image.pixels[45 * 160..46 * 160];
    assert!((row[20][0] - 0.537).abs() < 0.01, "{:?}", row[20]);
    assert!((row[140][0] - 1.0).abs() < 0.01, "{:?}", row[140]);
    assert!(image.pixels.iter().all(|pixel| pixel[3] == 1.0));
    // Against a background colour that equals the sky, the scene looks the same.
    let uniform = Rgb32FImage::from_pixel(SIZE.0, SIZE.1, Rgb([0.5; 3]));
    uniform.save_with_format(at("grey.hdr"), ImageFormat::Hdr).unwrap();
    let plain = ["--environment", "grey.hdr", "--tonemap", "none", "--background"];
    for (name, background) in [("a.png", "environment"), ("b.png", "0.7354,0.7354,0.7354")] {
        render(folder.path(), name, &[&plain[..], &[background]].concat()).ok();
    }
    let [a, b] = ["a.png", "b.png"].map(|name| read(&at(name)).unwrap());
    assert!(compare(&a, &b).unwrap().rmse < 0.003);
    render(folder.path(), "c.png", &["--background", "environment"]).exits(2).says(&["--environment FILE"]);
}

#[test]
fn infinite_light_is_bounded_with_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    exr::prelude::write_rgb_file(folder.path().join("sun.exr"), 16, 8, |x, y| {
        let light = if (x, y) == (8, 2) { f32::INFINITY } else { 1.0 };
        (light, light, light)
    })
    .unwrap();
    render(folder.path(), "a.png", &["--environment", "sun.exr"])
        .ok()
        .says(&["sun.exr: 1 pixels are infinitely bright and are taken as 65504"]);
}

#[test]
fn what_is_no_environment_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("sky.hdr"), b"no sky").unwrap();
    render(folder.path(), "a.png", &["--environment", "sky.hdr"])
        .exits(1)
        .says(&["sky.hdr", "it must be an EXR or Radiance (.hdr) image"]);
    render(folder.path(), "a.png", &["--environment", "none.exr"]).exits(1).says(&["none.exr can't be read"]);
    render(folder.path(), "a.png", &["--environment-rotation", "90"]).exits(2).says(&["--environment"]);
}
