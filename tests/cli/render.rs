//! `gpc render` on a device, from arguments to files.

use crate::command::{Run, asset, files, gpc};
use gpc::color::srgb;
use gpc::output::read;
use serde_json::Value;
use std::path::Path;

fn render(folder: &Path, scene: &str, options: &[&str]) -> Run {
    let scene = asset(&format!("{scene}.glb"));
    gpc(folder, &[&["render", &scene], options].concat())
}

#[test]
fn json_holds_the_figures_of_the_image() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["-o", "{stem}.png", "--size", "96x54", "--samples", "16", "--repeat", "2", "--json"];
    let json = render(folder.path(), "spheres", &options).ok().json();
    let keys: Vec<_> = json.as_object().unwrap().keys().map(String::as_str).collect();
    let mut expected = [
        "output",
        "device",
        "driver",
        "size",
        "camera",
        "samples",
        "superpixels",
        "triangles",
        "gpu_ms",
        "wall_ms",
        "memory_bytes",
        "warnings",
    ];
    expected.sort_unstable();
    assert_eq!(keys, expected);
    assert_eq!(json["output"], "spheres.png");
    assert_eq!(json["size"], serde_json::json!([96, 54]));
    assert_eq!(json["samples"], 16);
    let number = |value: &Value| value.as_f64().unwrap();
    let count = number(&json["superpixels"]["count"]);
    assert!(count > 0.0);
    assert_eq!(number(&json["superpixels"]["fraction"]), count / (96.0 * 54.0));
    assert!(number(&json["triangles"]["total"]) > 90_000.0);
    let passes = json["gpu_ms"].as_object().unwrap();
    assert!(passes.len() > 3 && passes.values().all(|ms| number(ms) >= 0.0));
    assert!(number(&json["gpu_ms"]["total"]) > 0.0 && number(&json["wall_ms"]) > 0.0);
    assert!(number(&json["memory_bytes"]) > 0.0);
    assert_eq!(files(folder.path()), ["spheres.png"]);
}

#[test]
fn json_says_where_the_time_to_the_first_image_went() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["-o", "{frame}.png", "--size", "96x54", "--turntable", "2"];
    let run = render(folder.path(), "glass", &[&options[..], &["--json"]].concat());
    let images = run.ok().json()["images"].clone();
    let steps: std::collections::BTreeMap<String, f64> =
        serde_json::from_value(images[0]["startup_ms"].clone()).unwrap();
    let names: Vec<&str> = steps.keys().map(String::as_str).collect();
    let expected = ["device", "frame", "load", "pipelines", "pose", "total", "upload", "write"];
    assert_eq!(names, expected);
    let sum: f64 = steps.values().sum::<f64>() - steps["total"];
    assert!((sum - steps["total"]).abs() < 1.0, "{steps:?}");
    assert!(steps["frame"] > 0.0 && steps["load"] > 0.0, "{steps:?}");
    assert_eq!(images[1]["startup_ms"], Value::Null);
}

#[test]
fn the_camera_in_json_is_the_one_that_was_used() {
    let folder = tempfile::tempdir().unwrap();
    let view = ["--eye", "-3,4,5", "--target", "-1,0.5,0", "--fov", "50", "--size", "96x48"];
    let options = [&["-o", "a.png", "--json"], &view[..]].concat();
    let camera = render(folder.path(), "spheres", &options).ok().json()["camera"].clone();
    let matrix = |name: &str| {
        let numbers: [f64; 16] = serde_json::from_value(camera[name].clone()).unwrap();
        glam::DMat4::from_cols_array(&numbers)
    };
    let vector = |name: &str| {
        let numbers: [f64; 3] = serde_json::from_value(camera[name].clone()).unwrap();
        glam::DVec3::from_array(numbers)
    };
    assert!(vector("eye").distance(glam::DVec3::new(-3.0, 4.0, 5.0)) < 1e-9);
    assert!(vector("target").distance(glam::DVec3::new(-1.0, 0.5, 0.0)) < 1e-9);
    assert!((camera["fov"].as_f64().unwrap() - 50.0).abs() < 1e-9);
    let ahead = matrix("view").transform_point3(vector("target"));
    assert!(ahead.truncate().length() < 1e-9 && ahead.z < 0.0, "{ahead}");
    let above = matrix("view").transform_point3(vector("target") + vector("up"));
    assert!((above - ahead).distance(glam::DVec3::Y) < 1e-9);
    // The first point is at the upper edge of the view; the other two are in order of depth.
    let clip = |p: glam::DVec3| matrix("projection") * p.extend(1.0);
    let edge = clip(glam::DVec3::new(0.0, 25_f64.to_radians().tan(), -1.0));
    assert!((edge.y / edge.w - 1.0).abs() < 1e-9);
    let depth = |z: f64| clip(glam::DVec3::new(0.0, 0.0, z)).z / clip(glam::DVec3::new(0.0, 0.0, z)).w;
    assert!(depth(-1.0) > depth(-2.0) && depth(-1e9) > 0.0 && depth(-1.0) < 1.0);
}

#[test]
fn the_same_arguments_give_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.png", "b.png"] {
        render(folder.path(), "glass", &["-o", name, "--size", "160x90", "--samples", "16"]).ok();
    }
    let [a, b] = ["a.png", "b.png"].map(|name| std::fs::read(folder.path().join(name)).unwrap());
    assert!(a == b);
}

#[test]
fn the_background_is_the_colour_asked_for_or_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let size = ["--size", "160x90", "--samples", "16"];
    for (name, background) in [("none.png", "none"), ("blue.png", "#3366ff")] {
        let options = [&size[..], &["-o", name, "--background", background]].concat();
        render(folder.path(), "spheres", &options).ok();
    }
    let open = |name: &str| image::open(folder.path().join(name)).unwrap();
    assert_eq!(open("none.png").color(), image::ColorType::Rgba8);
    assert_eq!(open("none.png").to_rgba8().get_pixel(2, 2).0, [0; 4]);
    assert_eq!(open("blue.png").color(), image::ColorType::Rgb8);
    assert_eq!(open("blue.png").to_rgb8().get_pixel(2, 2).0, [0x33, 0x66, 0xff]);
}

#[test]
fn alpha_is_coverage_without_fringes() {
    let folder = tempfile::tempdir().unwrap();
    let size = ["--size", "160x90", "--samples", "64", "--detect", "exact"];
    for (name, background) in [("none.16.png", "none"), ("white.16.png", "1,1,1")] {
        let options = [&size[..], &["-o", name, "--background", background]].concat();
        render(folder.path(), "spheres", &options).ok();
    }
    let open = |name: &str| image::open(folder.path().join(name)).unwrap().into_rgba16();
    let linear = |code: u16| srgb::decode(f64::from(code) / 65_535.0);
    let mut edges = 0;
    for (clear, white) in open("none.16.png").pixels().zip(open("white.16.png").pixels()) {
        let alpha = f64::from(clear[3]) / 65_535.0;
        edges += u32::from(alpha > 0.0 && alpha < 1.0);
        for i in 0..3 {
            let over_white = linear(clear[i]) * alpha + 1.0 - alpha;
            assert!((over_white - linear(white[i])).abs() < 2e-3, "{clear:?} {white:?}");
        }
    }
    assert!(edges > 50, "{edges} pixels are partly covered");
}

#[test]
fn several_cameras_frames_and_angles_get_files_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let small = ["--size", "48x27", "--samples", "4"];
    let run = |output: &str, options: &[&str]| {
        let options = [&["-o", output], &small[..], options].concat();
        render(folder.path(), "letters", &options).ok()
    };
    run("still.png", &[]);
    let json = run("{stem}-{camera}.png", &["--camera", "all", "--json"]).json();
    assert_eq!(json["images"].as_array().unwrap().len(), 2);
    assert_eq!(json["images"][1]["camera"]["fov"], Value::Null);
    run("turn-{frame}.png", &["--turntable", "3"]);
    run("move-{frame}.png", &["--frames", "8..9"]).says(&["no animation"]);
    assert_eq!(
        files(folder.path()),
        [
            "letters-front.png",
            "letters-reader.png",
            "move-0008.png",
            "move-0009.png",
            "still.png",
            "turn-0000.png",
            "turn-0001.png",
            "turn-0002.png",
        ]
    );
    let bytes = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("turn-0000.png") == bytes("still.png"));
    assert!(bytes("letters-reader.png") == bytes("still.png"));
    assert!(bytes("turn-0001.png") != bytes("turn-0002.png"));
}

#[test]
fn aovs_are_layers_of_an_exr_and_files_beside_a_png() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["--size", "96x54", "--samples", "16", "--aov", "depth,id,normal,superpixels,samples"];
    let json = render(folder.path(), "spheres", &[&["-o", "a.exr", "--json"], &options[..]].concat()).ok().json();
    render(folder.path(), "spheres", &[&["-o", "b.png"], &options[..]].concat()).ok();
    assert_eq!(
        files(folder.path()),
        ["a.exr", "b.depth.png", "b.id.png", "b.normal.png", "b.png", "b.samples.png", "b.superpixels.png"]
    );
    use exr::prelude::{ReadChannels, ReadLayers};
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(folder.path().join("a.exr"))
        .unwrap();
    let values = |name: &str| -> Vec<f64> {
        let channels = &image.layer_data.channel_data.list;
        let channel = channels.iter().find(|channel| channel.name.eq(name)).unwrap();
        match &channel.sample_data {
            exr::prelude::FlatSamples::F32(values) => values.iter().copied().map(f64::from).collect(),
            exr::prelude::FlatSamples::U32(values) => values.iter().copied().map(f64::from).collect(),
            exr::prelude::FlatSamples::F16(_) => panic!("{name} is half"),
        }
    };
    let [ids, depths, alphas] = ["id.Y", "depth.Z", "A"].map(values);
    let triangles = json["triangles"]["total"].as_f64().unwrap();
    assert!(ids.iter().all(|id| *id <= triangles) && ids.iter().any(|id| *id > 0.0));
    for ((id, depth), alpha) in ids.iter().zip(&depths).zip(&alphas) {
        assert_eq!(*id == 0.0, depth.is_infinite());
        assert!(*depth > 1.0 && (*id == 0.0 || *alpha > 0.0));
    }
    let superpixels = values("superpixels.Y");
    assert_eq!(Some(superpixels.iter().sum()), json["superpixels"]["count"].as_f64());
    for (superpixel, samples) in superpixels.iter().zip(values("samples.Y")) {
        assert_eq!(samples, if *superpixel == 1.0 { 16.0 } else { 1.0 });
    }
    let [x, y, z] = ["normal.X", "normal.Y", "normal.Z"].map(values);
    for i in 0..ids.len() {
        let length = (x[i] * x[i] + y[i] * y[i] + z[i] * z[i]).sqrt();
        let expected = f64::from(u8::from(ids[i] > 0.0));
        assert!((length - expected).abs() < 1e-3, "{length}");
    }
}

#[test]
fn an_image_may_go_to_standard_output() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["-o", "-", "--size", "48x27", "--samples", "4"];
    let run = render(folder.path(), "glass", &options).ok();
    let image = image::load_from_memory(&run.stdout).unwrap();
    assert_eq!((image.width(), image.height()), (48, 27));
    assert!(files(folder.path()).is_empty());
}

#[test]
fn quiet_is_quiet_and_progress_is_for_terminals() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["-o", "{frame}.png", "--size", "48x27", "--samples", "4", "--turntable", "2"];
    let run = render(folder.path(), "glass", &options).ok();
    assert!(run.stdout.is_empty());
    assert_eq!(run.stderr.lines().count(), 2, "{}", run.stderr);
    assert!(!run.stderr.contains('\u{1b}') && !run.stderr.contains('\r'));
    let run = render(folder.path(), "glass", &[&options[..], &["--quiet"]].concat()).ok();
    assert!(run.stdout.is_empty() && run.stderr.is_empty(), "{}", run.stderr);
}

#[test]
fn failures_have_their_exit_codes_and_leave_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let small = ["--size", "48x27"];
    let run = |options: &[&str]| render(folder.path(), "glass", &[&small[..], options].concat());
    run(&["-o", "a.png", "--aa", "ssaa", "--samples", "60"]).exits(2).says(&["ssaa", "1, 4, 9, 16"]);
    run(&["-o", "a.png", "--aa", "msaa", "--samples", "3"]).exits(2).says(&["msaa", "4"]);
    run(&["-o", "a.png", "--aa", "accumulate", "--samples", "1025"]).exits(2).says(&["accumulate", "1 to 1024"]);
    run(&["-o", "a.png", "--aa", "accumulate", "--aov", "depth"]).exits(2).says(&["accumulation"]);
    run(&["-o", "a.png", "--samples", "1025"]).exits(2).says(&["1024"]);
    run(&["-o", "a.png", "--pattern", "grid", "--samples", "60"]).exits(2).says(&["49", "64"]);
    run(&["-o", "a.png", "--device", "no such device"]).exits(3).says(&["no such device"]);
    run(&["-o", "a.png", "--max-memory", "1K"]).exits(4).says(&["--max-memory"]);
    run(&["-o", "no such folder/a.png"]).exits(1).says(&["no such folder"]);
    assert!(files(folder.path()).is_empty());
}

/// Without `--variant` the first materials are used, and a hidden node is never visible.
#[test]
fn variants_choose_materials_and_hidden_nodes_stay_hidden() {
    let folder = tempfile::tempdir().unwrap();
    let image = |name: &str, variant: &[&str]| {
        let fixed = ["--size", "160x90", "--samples", "4", "-o", name];
        render(folder.path(), "variants", &[&fixed[..], variant].concat()).ok();
        read(&folder.path().join(name)).unwrap()
    };
    let plain = image("plain.png", &[]);
    let day = image("day.png", &["--variant", "day"]);
    let night = image("night.png", &["--variant", "night"]);
    assert_eq!(plain.pixels, day.pixels);
    let mean = |channel: usize| {
        let means = [&day, &night].map(|image| {
            let sum: f32 = image.pixels.iter().map(|pixel| pixel[channel]).sum();
            sum / image.pixels.len() as f32
        });
        (means[0], means[1])
    };
    let ((day_red, night_red), (day_blue, night_blue)) = (mean(0), mean(2));
    assert!(day_red > 2.0 * night_red && day_red > day_blue, "{day_red}, {night_red}");
    assert!(night_blue > 2.0 * night_red, "{night_blue}");
    // Only the hidden sphere is pure green.
    for [r, g, b, _] in day.pixels.iter().chain(&night.pixels) {
        assert!(*g < 0.5 || r + b > 0.3, "{r}, {g}, {b}");
    }
}
