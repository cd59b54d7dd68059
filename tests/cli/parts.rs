//! Images and sequences rendered in parts, for several machines: each part equals that part of the whole.

use crate::command::{Run, asset, files, gpc};
use std::path::Path;

const SMALL: [&str; 4] = ["--size", "90x60", "--samples", "16"];

fn render(folder: &Path, scene: &str, options: &[&str]) -> Run {
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
    for [whole, part] in [["whole.png", "part.png"], ["whole.superpixels.png", "part.superpixels.png"]] {
        let cut = image::imageops::crop_imm(&open(whole), 31, 7, 40, 39).to_image();
        assert!(cut == open(part), "{part}");
    }
    let json = run.json();
    assert_eq!(json["size"], serde_json::json!([40, 39]));
    assert_eq!(json["region"], serde_json::json!({"corner": [31, 7], "image": [90, 60]}));
}

#[test]
fn shares_are_together_the_sequence() {
    let folder = tempfile::tempdir().unwrap();
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    for (name, scene, sequence) in
        [("turn", "environment", &["--turntable", "4"][..]), ("move", "pointer", &["--frames", "3..6", "--fps", "12"])]
    {
        let whole = format!("whole-{name}-{{frame}}.png");
        render(folder.path(), scene, &[sequence, &["-o", &whole]].concat());
        let mut written = Vec::new();
        for shard in ["1/3", "2/3", "3/3"] {
            let part = format!("part-{name}-{{frame}}.png");
            let options = [sequence, &["-o", &part, "--shard", shard, "--json"]].concat();
            let json = render(folder.path(), scene, &options).json();
            let images = json["images"].as_array().unwrap();
            written.extend(images.iter().map(|image| image["output"].clone()));
        }
        written.sort_by_key(ToString::to_string);
        let first = if name == "turn" { 0 } else { 3 };
        let expected: Vec<_> = (first..first + 4).map(|frame| format!("part-{name}-{frame:04}.png")).collect();
        assert_eq!(written, expected, "each image once");
        for name in expected {
            assert!(read(&name) == read(&name.replace("part", "whole")), "{name}");
        }
    }
    // An image that the device moved to a time equals a still image of that time.
    let still = ["-o", "still.png", "--time", "0.5"];
    render(folder.path(), "pointer", &still);
    assert!(read("still.png") == read("whole-move-0006.png"));
    assert!(read("still.png") != read("whole-move-0003.png"));
}

#[test]
fn a_share_may_be_empty() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["-o", "{frame}.png", "--turntable", "2", "--shard", "3/3", "--json"];
    let run = render(folder.path(), "letters", &options).says(&["none are left"]);
    assert_eq!(run.json()["images"], serde_json::json!([]));
    assert!(files(folder.path()).is_empty());
}
