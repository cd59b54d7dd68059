//! `gpc compare`: its numbers, its exit codes, and that it can fail.

use crate::command::{files, gpc};
use image::{Rgb, RgbImage};
use std::path::Path;

fn write_images(folder: &Path) {
    let mut image = RgbImage::from_pixel(40, 30, Rgb([90, 120, 150]));
    image.save(folder.join("a.png")).unwrap();
    image.save(folder.join("same.png")).unwrap();
    image.put_pixel(11, 7, Rgb([90, 220, 150]));
    image.save(folder.join("b.png")).unwrap();
    RgbImage::new(30, 40)
        .save(folder.join("turned.png"))
        .unwrap();
}

#[test]
fn identical_images() {
    let folder = tempfile::tempdir().unwrap();
    write_images(folder.path());
    let run = gpc(
        folder.path(),
        &["compare", "a.png", "same.png", "--json", "--max-rmse", "0"],
    )
    .ok();
    let expected = serde_json::json!({ "rmse": 0.0, "psnr": null, "max": 0.0, "flip": 0.0 });
    assert_eq!(run.json(), expected);
}

#[test]
fn one_corrupted_pixel_exits_with_5_where_the_bound_is_tight() {
    let folder = tempfile::tempdir().unwrap();
    write_images(folder.path());
    let compare = ["compare", "a.png", "b.png", "--json", "--max-rmse"];
    let run = gpc(folder.path(), &[&compare[..], &["0.001"]].concat())
        .exits(5)
        .says(&["bound"]);
    let json = run.json();
    let expected = 100.0 / 255.0 / (40.0_f64 * 30.0 * 3.0).sqrt();
    assert!((json["rmse"].as_f64().unwrap() - expected).abs() < 1e-6);
    assert!((json["max"].as_f64().unwrap() - 100.0 / 255.0).abs() < 1e-6);
    assert!((json["psnr"].as_f64().unwrap() + 20.0 * expected.log10()).abs() < 1e-3);
    assert!(json["flip"].as_f64().unwrap() > 0.0);
    gpc(folder.path(), &[&compare[..], &["0.1"]].concat()).ok();
}

#[test]
fn a_heatmap_shows_where() {
    let folder = tempfile::tempdir().unwrap();
    write_images(folder.path());
    gpc(
        folder.path(),
        &["compare", "a.png", "b.png", "--heatmap", "h.png"],
    )
    .ok();
    let heat = image::open(folder.path().join("h.png")).unwrap().to_rgb8();
    let sum = |x, y| {
        heat.get_pixel(x, y)
            .0
            .iter()
            .map(|v| u32::from(*v))
            .sum::<u32>()
    };
    assert_eq!(heat.dimensions(), (40, 30));
    assert!(sum(11, 7) > sum(35, 25) + 50);
}

#[test]
fn what_can_not_be_compared_exits_with_1() {
    let folder = tempfile::tempdir().unwrap();
    write_images(folder.path());
    std::fs::write(folder.path().join("no.png"), b"no image").unwrap();
    let compare = |b| {
        gpc(
            folder.path(),
            &["compare", "a.png", b, "--heatmap", "h.png"],
        )
    };
    compare("turned.png").exits(1).says(&["40 x 30", "30 x 40"]);
    compare("missing.png").exits(1).says(&["missing.png"]);
    compare("no.png").exits(1).says(&["no.png"]);
    assert!(!files(folder.path()).contains(&"h.png".to_owned()));
}

#[test]
fn wrong_usage_exits_with_2() {
    let folder = tempfile::tempdir().unwrap();
    write_images(folder.path());
    gpc(folder.path(), &["compare", "a.png"]).exits(2);
    gpc(
        folder.path(),
        &["compare", "a.png", "b.png", "--heatmap", "h.exr"],
    )
    .exits(2)
    .says(&[".png"]);
    gpc(
        folder.path(),
        &["compare", "a.png", "b.png", "--max-rmse", "nan"],
    )
    .exits(2);
}
