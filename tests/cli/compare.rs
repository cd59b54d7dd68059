//! `gpc compare`: its figures, its exit codes, and that it can fail.

use crate::command::{files, gpc};
use image::{Rgb, RgbImage};
use std::path::Path;

fn write_images(folder: &Path) {
    let mut image = RgbImage::from_pixel(40, 30, Rgb([90, 120, 150]));
    image.save(folder.join("a.png")).unwrap();
    image.save(folder.join("same.png")).unwrap();
    image.put_pixel(11, 7, Rgb([90, 220, 150]));
    image.save(folder.join("b.png")).unwrap();
    RgbImage::new(30, 40).save(folder.join("turned.png")).unwrap();
}

#[test]
fn identical_images() {
    let folder = tempfile::tempdir().unwrap();
    write_images(folder.path());
    let run = gpc(folder.path(), &["compare", "a.png", "same.png", "--json", "--max-rmse", "0"]).ok();
    let expected = serde_json::json!({ "rmse": 0.0, "psnr": null, "max": 0.0, "over_2": 0, "over_8": 0, "flip": 0.0 });
    assert_eq!(run.json(), expected);
}

#[test]
fn one_corrupted_pixel_exits_with_5_where_the_bound_is_tight() {
    let folder = tempfile::tempdir().unwrap();
    write_images(folder.path());
    let compare = ["compare", "a.png", "b.png", "--json", "--max-rmse"];
    let run = gpc(folder.path(), &[&compare[..], &["0.001"]].concat()).exits(5).says(&["bound"]);
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
    gpc(folder.path(), &["compare", "a.png", "b.png", "--heatmap", "h.png"]).ok();
    let heat = image::open(folder.path().join("h.png")).unwrap().to_rgb8();
    let sum = |x, y| heat.get_pixel(x, y).0.iter().map(|v| u32::from(*v)).sum::<u32>();
    assert_eq!(heat.dimensions(), (40, 30));
    assert!(sum(11, 7) > sum(35, 25) + 50);
}

#[test]
fn what_can_not_be_compared_exits_with_1() {
    let folder = tempfile::tempdir().unwrap();
    write_images(folder.path());
    std::fs::write(folder.path().join("no.png"), b"no image").unwrap();
    let compare = |b| gpc(folder.path(), &["compare", "a.png", b, "--heatmap", "h.png"]);
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
    gpc(folder.path(), &["compare", "a.png", "b.png", "--heatmap", "h.exr"]).exits(2).says(&[".png"]);
    gpc(folder.path(), &["compare", "a.png", "b.png", "--max-rmse", "nan"]).exits(2);
}

/// Writes two folders: one image is equal, one differs, one has another size, one is broken, and one exists only in
/// each.
fn write_folders(folder: &Path) {
    let [golden, images] = ["golden", "images"].map(|name| folder.join(name));
    for folder in [&golden, &images] {
        std::fs::create_dir_all(folder.join("deep")).unwrap();
        write_images(folder);
        std::fs::write(folder.join("notes.txt"), "no image").unwrap();
        let gray = RgbImage::from_pixel(8, 8, Rgb([50, 50, 50]));
        gray.save(folder.join("deep/same.png")).unwrap();
    }
    std::fs::rename(images.join("b.png"), images.join("a.png")).unwrap();
    std::fs::remove_file(golden.join("b.png")).unwrap();
    let turned = RgbImage::new(3, 3);
    turned.save(images.join("turned.png")).unwrap();
    std::fs::write(images.join("same.png"), b"no image").unwrap();
    turned.save(images.join("deep/new.png")).unwrap();
    turned.save(golden.join("gone.png")).unwrap();
}

#[test]
fn folders_are_compared_image_by_image() {
    let folder = tempfile::tempdir().unwrap();
    write_folders(folder.path());
    let options = ["--heatmap", "differences", "--junit", "junit.xml", "--json"];
    let compare = ["compare", "golden", "images"];
    let run = gpc(folder.path(), &[&compare[..], &options].concat()).exits(5).says(&["5 of 6 images"]);
    let json = run.json();
    let statuses: Vec<_> = json["images"]
        .as_array()
        .unwrap()
        .iter()
        .map(|image| (image["name"].as_str().unwrap(), image["status"].as_str().unwrap()))
        .collect();
    assert_eq!(
        statuses,
        [
            ("a.png", "different"),
            ("deep/new.png", "new"),
            ("deep/same.png", "equal"),
            ("gone.png", "missing"),
            ("same.png", "different"),
            ("turned.png", "different"),
        ]
    );
    let counts = ["equal", "different", "missing", "new"].map(|name| json[name].as_u64().unwrap());
    assert_eq!(counts, [1, 3, 1, 1]);
    assert!(json["images"][0]["rmse"].as_f64().unwrap() > 0.0);
    // Only images of the same size have a picture of the difference.
    assert_eq!(files(&folder.path().join("differences")), ["a.png"]);
    let junit = std::fs::read_to_string(folder.path().join("junit.xml")).unwrap();
    assert!(junit.contains("tests=\"6\"") && junit.contains("failures=\"5\""), "{junit}");
    for text in ["deep/same.png", "it is not in images", "it is not in golden", "type=\"different\""] {
        assert!(junit.contains(text), "no \"{text}\" in {junit}");
    }
}

#[test]
fn folders_within_the_bound_are_equal() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["golden", "images"] {
        std::fs::create_dir(folder.path().join(name)).unwrap();
        write_images(&folder.path().join(name));
    }
    let compare = ["compare", "golden", "images", "--max-rmse"];
    gpc(folder.path(), &["compare", "golden", "images"]).ok();
    std::fs::copy(folder.path().join("images/b.png"), folder.path().join("images/a.png")).unwrap();
    gpc(folder.path(), &[&compare[..], &["0.1"]].concat()).ok();
    gpc(folder.path(), &[&compare[..], &["0.001"]].concat()).exits(5);
    gpc(folder.path(), &["compare", "golden", "images"]).exits(5);
}

#[test]
fn a_folder_is_not_compared_with_an_image() {
    let folder = tempfile::tempdir().unwrap();
    write_images(folder.path());
    std::fs::create_dir(folder.path().join("images")).unwrap();
    gpc(folder.path(), &["compare", "images", "a.png"]).exits(2).says(&["images is a folder"]);
    gpc(folder.path(), &["compare", "a.png", "b.png", "--junit", "j.xml"]).exits(2).says(&["two folders"]);
    std::fs::create_dir(folder.path().join("golden")).unwrap();
    gpc(folder.path(), &["compare", "golden", "images"]).exits(1).says(&["neither"]);
}
