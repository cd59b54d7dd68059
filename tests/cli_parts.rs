//! Images and sequences in parts, for many machines: each part is what the whole has there.

#[allow(dead_code)]
mod cli_support;

use cli_support::{asset, gpc};
use std::path::Path;

const SMALL: [&str; 4] = ["--size", "90x60", "--samples", "16"];

fn render(folder: &Path, scene: &str, options: &[&str]) -> cli_support::Run {
    let scene = asset(&format!("{scene}.glb"));
    gpc(folder, &[&["render", &scene], &SMALL[..], options].concat()).ok()
}

#[test]
fn a_region_is_cut_from_the_image() {
    let folder = tempfile::tempdir().unwrap();
    let open = |name: &str| image::open(folder.path().join(name)).unwrap().into_rgba8();
    let aovs = ["--aov", "superpixels"];
    render(folder.path(), "fence", &[&["-o", "whole.png"], &aovs[..]].concat());
    let options = ["-o", "part.png", "--region", "31,7,40x39", "--json"];
    let run = render(folder.path(), "fence", &[&options, &aovs[..]].concat());
    for [whole, part] in [
        ["whole.png", "part.png"],
        ["whole.superpixels.png", "part.superpixels.png"],
    ] {
        let cut = image::imageops::crop_imm(&open(whole), 31, 7, 40, 39).to_image();
        assert!(cut == open(part), "{part}");
    }
    let json = run.json();
    assert_eq!(json["size"], serde_json::json!([40, 39]));
    assert_eq!(
        json["region"],
        serde_json::json!({"corner": [31, 7], "image": [90, 60]})
    );
}
