//! Common behaviour of `gpc zoom`, `sample`, `panorama` and `project`: figures, `--quiet`, and refusal of impossible
//! requests. Also `gpc project` with the light on the wall.

use crate::command::{Run, asset, files, gpc};
use gpc::output;
use serde_json::Value;
use std::path::Path;

/// Four correspondences of a projector whose pixels are the upper left 100 x 100 pixels of the picture.
const FOUR: &str = "x,y,u,v\n0,0,0,0\n100,0,100,0\n0,100,0,100\n100,100,100,100\n";
const EMPTY_SCENE: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[]}]}"#;

/// Runs the command with the words of `line`.
fn run(folder: &Path, line: &str) -> Run {
    let words: Vec<_> = line.split_whitespace().collect();
    gpc(folder, &words)
}

fn write(folder: &Path, files: &[(&str, &str)]) {
    for (name, text) in files {
        std::fs::write(folder.join(name), text).unwrap();
    }
}

/// Command lines of the four subcommands for a scene, without the output.
fn commands(scene: &str) -> [String; 4] {
    [
        format!("zoom {scene} --size 48x32 --center 20,16 --radius 6 --multiplicity 0.4"),
        format!("sample {scene} --size 48x32 --samples s.csv"),
        format!("panorama {scene} --size 48x24 --projection equirectangular"),
        format!("project {scene} --size 48x32 --projector four.csv --projector-size 40x30"),
    ]
}

/// The JSON object that describes an image.
fn image(json: &Value) -> &Value {
    json.get("images").map_or(json, |images| &images[0])
}

#[test]
fn every_command_has_figures_and_can_be_silent() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &[("s.csv", "u,v\n24,16\n1,1\n24,17\n"), ("four.csv", FOUR)]);
    for command in commands(&asset("letters.glb")) {
        let silent = run(folder.path(), &format!("{command} -o a.png --quiet --json"));
        let silent = if command.starts_with("sample") {
            silent.exits(2).says(&["row"]);
            run(folder.path(), &format!("{command} -o a.csv --quiet --json"))
        } else {
            silent
        }
        .ok();
        assert_eq!(silent.stderr, "", "{command}");
        let json = silent.json();
        let image = image(&json);
        for positive in ["/gpu_ms/total", "/wall_ms", "/memory_bytes", "/triangles/total", "/samples"] {
            let found = image.pointer(positive).and_then(Value::as_f64);
            assert!(found.is_some_and(|found| found > 0.0), "{positive} of {json}");
        }
        for there in ["device", "driver", "size", "superpixels", "warnings", "output"] {
            assert!(image.get(there).is_some(), "{there} in {json}");
        }
        match command.split(' ').next().unwrap() {
            "zoom" => {
                assert_eq!(image["regions"][0]["multiplicity"], 0.4);
                let rate = image["locations"]["highest_rate"].as_f64().unwrap();
                assert!((rate - 6.25).abs() < 1e-6, "{rate}");
            }
            "sample" => {
                let rows = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
                let hit = |row: &&str| row.split(',').nth(8) == Some("1");
                let hits = rows.lines().filter(hit).count();
                assert!(hits > 0 && image["locations"] == 3, "{json}");
                assert_eq!(image["hits"], hits);
            }
            "panorama" => assert_eq!(image["pinholes"], 6),
            _ => {
                assert_eq!(image["calibration"]["agreeing"], 4);
                assert_eq!(image["mean_weight"], 1.0);
                assert!(json["wall"].is_null());
            }
        }
        // Without either option, the same command prints to standard error.
        let loud = run(folder.path(), &format!("{command} -o a.csv"));
        if command.starts_with("sample") {
            assert!(loud.ok().says(&["3 samples"]).stdout.is_empty());
        } else {
            loud.exits(2).says(&["a.csv"]);
        }
        let both = format!("{command} -o - --json");
        run(folder.path(), &both).exits(2).says(&["standard output"]);
    }
    run(folder.path(), "render a.glb -o - --json").exits(2).says(&["standard output"]);
}

#[test]
fn unzooming_says_how_far_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let [zoom, ..] = commands(&asset("letters.glb"));
    run(folder.path(), &format!("{zoom} -o z.png --steps --quiet")).ok();
    let unzoom = "unzoom z.png -o u.png --reference z.direct.png";
    let json = run(folder.path(), &format!("{unzoom} --json")).ok().json();
    assert_eq!(json["size"], serde_json::json!([12, 12]));
    assert_eq!(json["region"], 0);
    let printed = run(folder.path(), unzoom).ok().stdout;
    let rmse = json["comparison"]["rmse"].as_f64().unwrap();
    let printed = String::from_utf8(printed).unwrap();
    assert!(printed.starts_with(&format!("rmse {rmse:.6}")), "{printed}");
    let silent = run(folder.path(), &format!("{unzoom} --quiet")).ok();
    assert!(silent.stdout.is_empty() && silent.stderr.is_empty());
    let json = run(folder.path(), "unzoom z.png -o u.png --whole --json").ok().json();
    assert!(json["region"].is_null() && json["comparison"].is_null());
}

#[test]
fn the_light_on_the_wall_is_the_picture_without_a_seam() {
    let folder = tempfile::tempdir().unwrap();
    let gallery = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/gallery");
    let view = format!("{} --size 480x300 --background #a8c0d8 --quiet", asset("fence.glb"));
    let project = format!(
        "project {view} -o f-{{projector}}.png --projector {gallery}/left.csv --projector {gallery}/right.csv \
         --projector-size 320x240 --weights --wall wall.png --json"
    );
    let json = run(folder.path(), &project).ok().json();
    run(folder.path(), &format!("render {view} -o picture.png")).ok();
    let expected = ["f-0.png", "f-0.weights.png", "f-1.png", "f-1.weights.png", "picture.png", "wall.png"];
    assert_eq!(files(folder.path()), expected);
    let read = |name: &str| output::read(&folder.path().join(name)).unwrap().pixels;
    let (wall, picture) = (read("wall.png"), read("picture.png"));
    let rmse = |shift: usize| {
        let places = (20..260).flat_map(|row| (20..460).map(move |col| row * 480 + col));
        let squares = places.map(|at| {
            let pairs = wall[at].iter().zip(&picture[at + shift]);
            pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>()
        });
        (squares.sum::<f64>() / (4.0 * 240.0 * 440.0)).sqrt()
    };
    assert!(rmse(0) < 0.025, "{}", rmse(0));
    assert!(rmse(0) < 0.5 * rmse(1), "{} and {} a pixel aside", rmse(0), rmse(1));
    // One pixel is below the left frame, and one beside the right one.
    for unlit in [295 * 480 + 150, 479] {
        assert_eq!(wall[unlit], [0.0, 0.0, 0.0, 1.0]);
    }
    for (index, image) in json["images"].as_array().unwrap().iter().enumerate() {
        let weights = read(&format!("f-{index}.weights.png"));
        let mean = weights.iter().map(|[grey, ..]| f64::from(*grey)).sum::<f64>() / weights.len() as f64;
        let said = image["mean_weight"].as_f64().unwrap();
        assert!((mean - said).abs() < 1e-4 && said > 0.8 && said < 0.95, "{mean} and {said}");
    }
}

#[test]
fn scenes_without_triangles_are_empty_and_broken_ones_are_named() {
    let folder = tempfile::tempdir().unwrap();
    write(
        folder.path(),
        &[
            ("s.csv", "u,v,row,col\n24,16,0,0\n"),
            ("four.csv", FOUR),
            ("empty.gltf", EMPTY_SCENE),
            ("broken.gltf", "{\"asset\": broken"),
        ],
    );
    for command in commands("empty.gltf") {
        run(folder.path(), &format!("{command} -o a.png --background #204060")).ok();
        let seen = output::read(&folder.path().join("a.png")).unwrap().pixels;
        assert!(seen.iter().all(|color| *color == seen[0]), "{command}");
    }
    for (scene, said) in [("broken.gltf", "JSON"), ("missing.glb", "cannot be read")] {
        for command in commands(scene) {
            run(folder.path(), &format!("{command} -o b.png")).exits(1).says(&[scene, said]);
        }
    }
    assert!(!folder.path().join("b.png").exists());
}

#[test]
fn what_can_not_be_is_refused_with_one_error() {
    let folder = tempfile::tempdir().unwrap();
    let mut outliers = "x,y,u,v".to_owned();
    for i in 0..20_u32 {
        let number = |factor: u32| i.wrapping_mul(factor) % 211;
        outliers += &format!("\n{},{},{},{}", number(37), number(101), number(59), number(173));
    }
    let far = "x,y,u,v\n0,0,1e9,1e9\n100,0,1000000100,1e9\n0,100,1e9,1000000100\n100,100,1000000100,1000000100\n";
    write(
        folder.path(),
        &[
            ("none.csv", "u,v\n"),
            ("zero.csv", ""),
            ("nan.csv", "u,v\n1,1\nnan,1\n"),
            ("far.csv", "u,v\n1,1\n1e9,1\n"),
            ("cell.csv", "u,v,row,col\n1,1,60000,60000\n"),
            ("three.csv", "x,y,u,v\n0,0,0,0\n1,0,1,0\n0,1,0,1\n"),
            ("outliers.csv", &outliers),
            ("beyond.csv", far),
            ("map.exr", "no map"),
        ],
    );
    let scene = asset("letters.glb");
    let cases = [
        ("sample --samples none.csv", 1, "none.csv: no sampling locations"),
        ("sample --samples zero.csv", 1, "zero.csv: it is empty; its first line must be u,v"),
        ("sample --samples nan.csv", 1, "nan.csv: sampling location 1 is (NaN, 1)"),
        ("sample --samples far.csv", 1, "far.csv: sampling location 1 is (1000000000, 1)"),
        ("sample --samples cell.csv", 1, "cell.csv: an output of 60001 x 60001 cells"),
        ("zoom --center 9,9 --radius 0 --multiplicity .5", 2, "above 0"),
        ("zoom --center 9,9 --radius -3 --multiplicity .5", 2, "above 0"),
        ("zoom --center 9,9 --radius 3 --multiplicity -1", 2, "at most 1"),
        ("zoom --center 9,9 --radius 1e9 --multiplicity .5 --steps", 2, "65535 x 65535 pixels"),
        ("panorama --projection fisheye --fov 0", 2, "above 0"),
        ("panorama --projection fisheye --fov -1", 2, "above 0"),
        ("panorama --projection fisheye --fov 400", 2, "at most 360"),
        ("panorama --projection cubemap --size 1x1", 2, "no room"),
        ("project --projector three.csv", 1, "three.csv: 3 correspondences"),
        ("project --projector outliers.csv", 1, "outliers.csv: only"),
        ("project --projector beyond.csv", 1, "projector 0: sampling location 0"),
        ("project --projector map.exr", 1, "error: map.exr: not of a known format; it must be an EXR"),
        ("project --projector three.csv --tolerance -1", 2, "above 0"),
        ("project --projector three.csv --wall a.gif", 2, "--wall a.gif"),
        ("project --projector three.csv -o {x}.png", 2, "{projector}"),
    ];
    let before = files(folder.path());
    for (line, code, said) in cases {
        let out = match line {
            line if line.contains("-o ") => "",
            line if line.starts_with("sample") => "-o a.csv",
            _ => "-o a.png",
        };
        let (command, rest) = line.split_once(' ').unwrap();
        let run = run(folder.path(), &format!("{command} {scene} {rest} {out}")).exits(code).says(&[said]);
        assert_eq!(run.stderr.matches("error:").count(), 1, "{}", run.stderr);
        assert!(!run.stderr.contains("panicked"), "{}", run.stderr);
    }
    assert_eq!(files(folder.path()), before);
    // A region that is larger than any image can still be zoomed, but not unzoomed.
    let huge = format!("zoom {scene} -o z.png --size 8x8 --center 4,4 --radius 1e300 --multiplicity .5");
    run(folder.path(), &huge).ok();
    run(folder.path(), "unzoom z.png -o u.png").exits(2).says(&["region 0", "65535 x 65535"]);
    run(folder.path(), "unzoom z.png -o u.png --whole").ok();
    run(folder.path(), "unzoom z.png -o u.png --region 1").exits(2).says(&["--region 1"]);
}

/// All 51,113 triangles of the scene lie in a pixel or two: more than a subgroup can process for several cells at a
/// time.
#[test]
fn a_scene_fits_in_a_pixel() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let fence = asset("fence.glb");
    let linear = |line: &str| {
        let name = "pixel.exr";
        let run = run(folder, &format!("{line} -o {name}")).ok();
        let is_brute = line.contains("ssaa");
        assert_eq!(run.stderr.contains("triangles for each pixel"), !is_brute, "{}", run.stderr);
        let bytes = std::fs::read(folder.join(name)).unwrap();
        output::decode_linear(&bytes, name).unwrap().1
    };
    for samples in [64, 1024] {
        let one = format!("render {fence} --size 1x1 --background #80a0c0 --samples {samples}");
        let (seen, true_) = (linear(&one), linear(&format!("{one} --aa ssaa")));
        for (a, b) in seen[0].iter().zip(true_[0]) {
            assert!((a - b).abs() < 0.03, "{samples}: {seen:?}, {true_:?}");
        }
    }
    let around = linear(&format!("panorama {fence} --projection fisheye --size 12x9 --background #80a0c0"));
    assert!(around.iter().flatten().all(|value| value.is_finite()));
    assert!(around.iter().any(|color| color[1] != around[0][1]));
}

#[test]
fn an_image_of_nothing_says_which_camera_sees_something() {
    let folder = tempfile::tempdir().unwrap();
    let letters = asset("letters.glb");
    let render = ["render", &letters, "-o", "a.png", "--size", "64x36"];
    let away = ["--eye", "0,0,1000", "--target", "0,0,2000"];
    gpc(folder.path(), &[&render[..], &away].concat()).ok().says(&[
        "nothing of the scene is in view",
        "--camera 'reader'",
        "--azimuth 35",
    ]);
    let run = gpc(folder.path(), &render).ok();
    assert!(!run.stderr.contains("in view"), "{}", run.stderr);
}
