//! `gpc bench` and its library, on a tiny image.

use crate::command::{Run, asset, files, gpc};
use crate::difference::rmse;
use crate::measurement::{Growth, PixelTriangles, Variant, Yardstick, brute_force};
use glam::DVec2;
use gpc::camera::panorama::PanoramaError;
use gpc::camera::{Camera, Orbit, Projection};
use gpc::output::Picture;
use gpc::render::{
    EngineError, Footprint, Headless, HeadlessOptions, MethodKind, PassTime, PreparedScene, RenderError, SceneRequest,
    Settings, SuperpixelOptions,
};
use gpc::scene::{PoseRequest, Scene};
use serde_json::Value;
use std::path::Path;

const SIZE: u32 = 64;

fn stage(name: &str) -> (Headless, PreparedScene, Camera) {
    let scene = Scene::load(asset(name).as_ref()).unwrap().scene;
    let pose = scene.pose(&PoseRequest::default()).unwrap();
    let (low, high) = pose.geometry.bounds().unwrap();
    let camera = Orbit::default().frame(low, high, 1.0).unwrap();
    let mut headless = Headless::new(&HeadlessOptions::default()).unwrap();
    let prepared = headless.upload(SceneRequest::new(&scene, &pose)).unwrap();
    (headless, prepared, camera)
}

fn settings(method: MethodKind, samples: u32) -> Settings {
    Settings::new(SIZE, SIZE).background(Some([0.8; 3])).method(method.with_samples(samples))
}

/// A shift of the image plane by whole pixels moves the picture by these pixels.
#[test]
fn a_shift_of_the_film_moves_the_picture_the_other_way() {
    let (mut headless, scene, camera) = stage("letters.glb");
    let mut frame = headless.prepare(&scene, &settings(MethodKind::None, 1)).unwrap();
    let mut render = |shift| {
        let camera = Camera { shift, ..camera };
        headless.render(&mut frame, &camera).unwrap().colors
    };
    let still = render(DVec2::ZERO);
    let moved = render(DVec2::new(2.0, 3.0) / f64::from(SIZE));
    let side = SIZE as usize;
    let mut pairs = Vec::new();
    for y in 0..side - 3 {
        for x in 0..side - 2 {
            pairs.push((still[(y + 3) * side + x + 2], moved[y * side + x]));
        }
    }
    let same = |(a, b): &&([f32; 4], [f32; 4])| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-3);
    let equal = pairs.iter().filter(same).count();
    assert!(equal * 100 >= pairs.len() * 99, "{equal} of {}", pairs.len());
    let unmoved = still.iter().zip(&moved).filter(|(a, b)| a == b).count();
    assert!(unmoved * 100 < still.len() * 95, "the picture is too plain to tell");
}

/// The reference differs from its parts less than images with fewer samples do.
#[test]
fn the_reference_lies_beyond_supersampling() {
    let (mut headless, scene, camera) = stage("letters.glb");
    let mut calls = 0;
    let reference =
        brute_force(&mut headless, &scene, &camera, &settings(MethodKind::None, 1), 1024, || calls += 1).unwrap();
    assert_eq!(calls, 4);
    let errors = [1, 16, 256].map(|samples| {
        let settings = settings(MethodKind::Ssaa, samples);
        let mut frame = headless.prepare(&scene, &settings).unwrap();
        let image = headless.render(&mut frame, &camera).unwrap();
        rmse(&image.colors, &reference)
    });
    assert!(errors[0] > 3.0 * errors[1] && errors[1] > 2.0 * errors[2], "{errors:?}");
    assert!(errors[2] > 0.0, "the grid was not moved");
}

/// Frames of a camera that moves within the pixel come to the reference as supersampling does, also with textures.
#[test]
fn accumulation_comes_to_the_reference() {
    for name in ["letters.glb", "foliage.glb"] {
        let (mut headless, scene, camera) = stage(name);
        let reference =
            brute_force(&mut headless, &scene, &camera, &settings(MethodKind::None, 1), 1024, || {}).unwrap();
        let mut error = |method, samples| {
            let mut frame = headless.prepare(&scene, &settings(method, samples)).unwrap();
            rmse(&headless.render(&mut frame, &camera).unwrap().colors, &reference)
        };
        let [few, many] = [16, 256].map(|samples| error(MethodKind::Ssaa, samples));
        for method in [MethodKind::Accumulate, MethodKind::Rotated] {
            let errors = [1, 16, 256].map(|samples| error(method, samples));
            assert_eq!(errors[0], error(MethodKind::None, 1), "one frame is not moved");
            assert!(errors[1] < 1.2 * few && errors[2] < 1.5 * many, "{name}, {method}: {errors:?}, {few}, {many}");
        }
    }
}

/// Accumulation sums light, and has no attributes of its own.
#[test]
fn accumulation_refuses_codes_and_attributes() {
    let (headless, scene, _) = stage("letters.glb");
    let settings = settings(MethodKind::Accumulate, 4);
    let codes = headless.prepare_pixels::<[u8; 4]>(&scene, &settings);
    assert!(matches!(codes, Err(RenderError::AccumulatedPixels)));
    let attributes = headless.prepare(&scene, &settings.attributes(true));
    assert!(matches!(attributes, Err(RenderError::Engine(EngineError::Attributes))));
}

#[test]
fn a_reference_is_made_of_whole_renderings() {
    let (mut headless, scene, camera) = stage("letters.glb");
    for samples in [0, 100, 257] {
        let settings = settings(MethodKind::None, 1);
        let asked = brute_force(&mut headless, &scene, &camera, &settings, samples, || {});
        assert!(matches!(asked, Err(RenderError::Engine(EngineError::Samples { .. }))), "{samples}");
    }
}

/// Features that cover no pixel centre cause few of the errors that superpixels leave, and many without `thin`.
#[test]
fn unseen_wires_are_not_missed() {
    let (mut headless, scene, camera) = stage("fence.glb");
    let plain = settings(MethodKind::None, 1);
    let reference = brute_force(&mut headless, &scene, &camera, &plain, 256, || {}).unwrap();
    let mut render = |settings: &Settings| {
        let mut frame = headless.prepare(&scene, settings).unwrap();
        headless.render(&mut frame, &camera).unwrap().colors
    };
    let one = render(&plain);
    let [with, without] =
        [true, false].map(|thin| settings(MethodKind::Superpixel, 16).map_superpixels(|options| options.thin(thin)));
    let images = [&with, &without].map(&mut render);
    let size = [SIZE; 2];
    let picture = |pixels| Picture::new(size, pixels).unwrap();
    let yardstick = Yardstick::new(&picture(&reference), &picture(&one)).unwrap();
    let looks = PixelTriangles::new(&mut headless, &scene, &camera, &plain, || {}).unwrap();
    let [with, without] = [(with, &images[0]), (without, &images[1])].map(|(settings, image)| {
        let causes = looks.causes(&mut headless, &settings).unwrap();
        yardstick.split(&picture(image), &causes).unwrap().unseen
    });
    assert!(with < 0.02, "{with} of the error was missed");
    assert!(without > 1.3 * with, "{without} without thin, {with} with");
}

/// Textures filtered for samples give another picture; a footprint larger than a pixel is refused.
#[test]
fn textures_follow_the_footprint_asked_for() {
    let (mut headless, scene, camera) = stage("foliage.glb");
    let settings =
        [Footprint::Pixel, Footprint::Sample].map(|footprint| settings(MethodKind::Ssaa, 64).footprint(footprint));
    let images = settings.clone().map(|settings| {
        let mut frame = headless.prepare(&scene, &settings).unwrap();
        headless.render(&mut frame, &camera).unwrap().colors
    });
    let apart = rmse(&images[0], &images[1]);
    assert!(apart > 1e-3, "{apart}");
    let [_, sample] = settings;
    let asked = sample.footprint(Footprint::Side(2.0));
    let refused = headless.prepare(&scene, &asked);
    assert!(matches!(refused, Err(RenderError::Engine(EngineError::Footprint(_)))));
}

/// The scenes of the growth benchmark have the stated quantities.
#[test]
fn what_grows_is_what_is_said_to() {
    let mut headless = Headless::new(&HeadlessOptions::default()).unwrap();
    let size = [320, 180];
    let pixels = f64::from(size[0] * size[1]);
    for index in 0..Growth::Superpixels.steps() {
        let step = Growth::Superpixels.step(index, size).unwrap();
        let prepared = headless.upload(SceneRequest::new(&step.scene, &step.pose)).unwrap();
        let settings = Settings::new(size[0], size[1]).background(Some([0.8; 3])).method(SuperpixelOptions::new(4));
        let mut frame = headless.prepare(&prepared, &settings).unwrap();
        let image = headless.render(&mut frame, &step.camera).unwrap();
        let percent = 100.0 * image.statistics.superpixels as f64 / pixels;
        assert!((percent - step.value).abs() < 2.0, "{percent} at {}", step.value);
        assert!(step.value > 0.0 || percent == 0.0, "{percent} without an edge");
    }
    for index in 0..3 {
        let step = Growth::Triangles.step(index, size).unwrap();
        let found = step.pose.geometry.triangles.len() as f64;
        assert!((found / step.value - 1.0).abs() < 0.05, "{found}");
    }
    let layers: Vec<_> =
        (0..Growth::Depth.steps()).filter_map(|index| Growth::Depth.step(index, size)).map(|step| step.value).collect();
    assert!(layers.is_sorted() && layers.last() == Some(&64.0));
    assert!(Growth::Depth.step(layers.len(), size).is_none());
    let sizes = (0..).map_while(|index| Growth::Pixels.step(index, size));
    assert_eq!(sizes.last().unwrap().size, [7680, 4320]);
}

fn bench(folder: &Path) -> Value {
    let scene = asset("letters.glb");
    let arguments = [
        "bench",
        &scene,
        "--size",
        "64x64",
        "--methods",
        "none,msaa,ssaa,accumulate,superpixel",
        "--samples",
        "16,4,16",
        "--superpixel-samples",
        "8,4",
        "--reference",
        "512",
        "--repeat",
        "2",
        "--geometry",
        "--cache",
        "cache",
        "--out",
        "results/letters",
    ];
    gpc(folder, &arguments).ok();
    let bytes = std::fs::read(folder.join("results/letters/results.json")).unwrap();
    serde_json::from_slice(&bytes).unwrap()
}

/// Number at a JSON path of a value.
fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("no {path} in {value}"))
}

/// Summary of a run whose scenes have no textures.
fn results_of_untextured(results: &Value) -> &Value {
    let [summary] = results["summary"].as_array().unwrap().as_slice() else {
        panic!("{}", results["summary"]);
    };
    assert_eq!((&summary["textured"], &summary["scenes"]), (&false.into(), &1.into()));
    summary
}

#[test]
fn measures_every_method_that_there_is_and_keeps_the_reference() {
    let folder = tempfile::tempdir().unwrap();
    let first = bench(folder.path());
    let scene = &first["scenes"][0];
    let rows = scene["rows"].as_array().unwrap();
    let row = |method: &str, samples: u32| {
        rows.iter()
            .find(|row| row["method"] == method && row["samples"] == samples)
            .unwrap_or_else(|| panic!("no {method} {samples} in {scene}"))
    };
    let expected = [
        ("none", 1),
        ("msaa", 4),
        ("ssaa", 4),
        ("ssaa", 16),
        ("accumulate", 4),
        ("accumulate", 16),
        ("superpixel", 4),
        ("superpixel", 8),
        ("superpixel", 16),
    ];
    let found: Vec<_> =
        rows.iter().map(|row| (row["method"].as_str().unwrap(), row["samples"].as_u64().unwrap())).collect();
    assert_eq!(found, expected, "msaa is 4x on the software driver");
    let notes = scene["notes"].to_string();
    assert!(notes.contains("msaa") && notes.contains("16"), "{notes}");

    let surfaces = number(scene, "/surface_fraction");
    assert!(0.0 < surfaces && surfaces < 1.0, "{surfaces}");
    for row in rows {
        assert_eq!(row["gpu_ms"]["count"], 2);
        let [median, least] = ["median", "min"].map(|of| number(row, &format!("/gpu_ms/{of}")));
        assert!(0.0 < least && least <= median, "{row}");
        assert!(number(row, "/wall_ms/min") > 0.0 && number(row, "/memory_bytes") > 0.0);
        let passes = row["passes"].as_array().unwrap();
        let passes = passes.iter().filter(|pass| !PassTime::is_output(pass["pass"].as_str().unwrap()));
        let sum: f64 = passes.map(|pass| number(pass, "/min")).sum();
        assert!(sum <= number(row, "/gpu_ms/median") + 1e-6, "{row}");
    }
    assert_eq!(number(row("none", 1), "/accuracy/removed"), 0.0);
    assert_eq!(number(row("none", 1), "/accuracy/needless"), 0.0);
    assert_eq!(number(row("none", 1), "/superpixel_fraction"), 0.0);
    assert!(number(row("superpixel", 16), "/superpixel_fraction") > 0.0);
    for method in ["ssaa", "accumulate", "superpixel"] {
        let [few, many] = [4, 16].map(|samples| number(row(method, samples), "/accuracy/removed"));
        assert!(0.5 < few && few < many && many < 1.0, "{method}: {few} {many}");
    }
    for row in rows {
        let left = row["left"].as_object().unwrap();
        let shares: f64 = left.values().map(|share| share.as_f64().unwrap()).sum();
        let removed = number(row, "/accuracy/removed");
        assert!((shares - (1.0 - removed)).abs() < 1e-9, "{row}");
        if row["method"] == "superpixel" {
            let within = |names: &[&str]| -> f64 {
                let path = |name: &&str| number(row, &format!("/left_within/{name}"));
                names.iter().map(path).sum()
            };
            let split = number(row, "/left/superpixels");
            let edges = within(&["superpixel_edges"]);
            let sum = edges + within(&["superpixel_texture", "superpixel_light"]);
            assert!((sum - split).abs() < 1e-9, "{row}");
            let sum = within(&["inside_texture", "inside_light"]);
            assert!((sum - number(row, "/left/inside")).abs() < 1e-9, "{row}");
            assert!(edges > 0.5 * split, "letters are edges: {row}");
        } else {
            assert!(row["left_within"].is_null(), "{row}");
        }
        // The letters have no textures.
        assert_eq!(row["geometry"], row["accuracy"]);
    }
    assert!(scene["reference_seconds"].is_number());
    let kept = files(&folder.path().join("cache"));
    assert_eq!(
        kept.len(),
        3,
        "the truth, which is that of light alone, that of paint alone, and a reference for geometry alone: {kept:?}"
    );
    assert_eq!(scene["textured"], false);
    let summary = results_of_untextured(&first);
    let compared = summary["at"].as_array().unwrap();
    assert_eq!(compared.len(), 3);
    assert!(compared[1]["rmse_ratio"].is_null(), "ssaa has no 8 samples");
    assert_eq!(summary["at"][0]["rmse_ratio"], summary["at"][0]["geometry_ratio"]);

    let again = bench(folder.path());
    let scene = &again["scenes"][0];
    assert!(scene["reference_seconds"].is_null(), "it was rendered again");
    for (row, before) in scene["rows"].as_array().unwrap().iter().zip(rows) {
        assert_eq!(row["accuracy"], before["accuracy"]);
    }
}

/// Rows of a CSV after its head, whose keys are checked.
fn body(csv: &str) -> impl Iterator<Item = &str> {
    for key in ["driver", "machine", "date", "size", "reference", "repeat"] {
        assert!(csv.contains(&format!("# {key}: ")), "no {key} in {csv}");
    }
    csv.lines().filter(|line| !line.starts_with('#'))
}

#[test]
fn writes_a_report_that_needs_no_other_file() {
    let folder = tempfile::tempdir().unwrap();
    let results = bench(folder.path());
    let out = folder.path().join("results/letters");
    assert_eq!(files(&out), ["report.html", "results.csv", "results.json", "summary.csv"]);
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    for part in [
        "data:image/png;base64,",
        "data:image/jpeg;base64,",
        "letters",
        "superpixel 16",
        "error of ssaa 16",
        "Where superpixels err most: edges in superpixels",
        "squared error that is left",
        "RMSE at equal time",
    ] {
        assert!(page.contains(part), "{part}");
    }
    let sources = page.matches("src=").count();
    assert_eq!(page.matches("src=\"data:").count(), sources);
    // Base 64 may contain any word.
    let mut parts = page.split(";base64,");
    let mut text = parts.next().unwrap().to_owned();
    text.extend(parts.filter_map(|part| part.split_once('"')).map(|(_, rest)| rest));
    for outside in ["http:", "https:", "<link", "<script", "url(", "NaN", "inf\""] {
        assert!(!text.contains(outside), "{outside}");
    }
    let csv = std::fs::read_to_string(out.join("results.csv")).unwrap();
    let columns: Vec<_> = body(&csv).map(|line| line.split(',').count()).collect();
    let rows = results["scenes"][0]["rows"].as_array().unwrap().len();
    assert_eq!(columns, vec![35; rows + 1]);
}

#[test]
fn wrong_use_is_told_before_anything_is_measured() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("letters.glb");
    let with = |arguments: &[&str]| {
        let all: Vec<_> = ["bench", &scene, "--out", "out"].iter().chain(arguments).copied().collect();
        gpc(folder.path(), &all).exits(2)
    };
    with(&["--reference", "1000"]).says(&["multiple of 256"]);
    with(&["--samples", "2000"]).says(&["1024"]);
    with(&["--methods", "taa"]).says(&["superpixel"]);
    gpc(folder.path(), &["bench", "--out", "out"]).exits(2).says(&["SCENE"]);
    gpc(folder.path(), &["bench", "-", "--out", "out"]).exits(2).says(&["standard input"]);
    assert!(files(folder.path()).is_empty());
}

/// Runs `gpc bench` on scenes and returns its results. `arguments` are further arguments in one line, which name `out`
/// as the folder.
fn measured(folder: &Path, scenes: &[&str], arguments: &str) -> (Run, Value) {
    let mut all = vec!["bench"];
    all.extend(scenes);
    all.extend(arguments.split(' '));
    let run = gpc(folder, &all).ok();
    let results = std::fs::read(folder.join("out").join("results.json")).unwrap();
    (run, serde_json::from_slice(&results).unwrap())
}

#[test]
fn variants_of_the_camera_are_timed_beside_the_raster_pass() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("letters.glb");
    let arguments = "--size 64x64 --methods none --reference 256 --repeat 2 --variants --cache cache --out out";
    let (run, results) = measured(folder.path(), &[&scene], arguments);
    let out = folder.path().join("out");
    let timed = &results["variants"][0];
    assert_eq!(timed["name"], "letters");
    let rows = timed["rows"].as_array().unwrap();
    let names: Vec<_> = rows.iter().map(|row| row["variant"].as_str().unwrap()).collect();
    let expected = Variant::ALL.map(|variant| variant.to_string());
    assert_eq!(names, expected);
    let pixels = f64::from(SIZE * SIZE);
    let raster = &rows[0];
    for row in rows {
        let samples = number(row, "/samples");
        match row["variant"].as_str().unwrap() {
            // The panorama is sampled with one more column on either side, where it continues.
            "rig" => assert_eq!(samples, f64::from((SIZE + 2) * SIZE / 2)),
            "superpixel" => {
                let more = samples - pixels;
                assert!(more > 0.0 && more % 64.0 == 0.0, "{row}");
            }
            _ => assert_eq!(samples, pixels),
        }
        for clock in ["gpu", "wall"] {
            let of = |row: &Value, what: &str| number(row, &format!("/{clock}_{what}"));
            assert_eq!(of(row, "ms/count"), 2.0);
            assert!(0.0 < of(row, "ms/min") && of(row, "ms/min") <= of(row, "ms/median"), "{row}");
            let each = 1e6 * of(row, "ms/median") / samples;
            assert!((of(row, "ns") / each - 1.0).abs() < 1e-12, "{row}");
            assert!((of(row, "ratio") / (each / of(raster, "ns")) - 1.0).abs() < 1e-12, "{row}");
        }
    }
    let csv = std::fs::read_to_string(out.join("variants.csv")).unwrap();
    let columns: Vec<_> = body(&csv).map(|line| line.split(',').count()).collect();
    assert_eq!(columns, vec![15; rows.len() + 1]);
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    let printed = String::from_utf8(run.stdout).unwrap();
    for variant in Variant::ALL {
        assert!(page.contains(variant.about()) && printed.contains(&variant.to_string()), "{variant}");
    }
}

#[test]
fn choices_change_one_option_of_superpixels() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("checker.glb");
    let arguments = "--size 64x64 --methods none --reference 256 --repeat 2 --choices --cache cache --out out";
    let (run, results) = measured(folder.path(), &[&scene], arguments);
    let rows = results["choices"][0]["rows"].as_array().unwrap();
    let find = |option: &str, value: &str| {
        let row = rows.iter().find(|row| row["option"] == option && row["value"] == value);
        row.unwrap_or_else(|| panic!("no {option} {value}"))
    };
    // The default among the thresholds is the default among the shadings.
    for column in ["/superpixel_fraction", "/accuracy/rmse", "/accuracy/flip"] {
        let [contrast, shading] = [find("contrast", "6"), find("shading", "part")];
        assert_eq!(number(contrast, column), number(shading, column));
    }
    let share = |contrast| number(find("contrast", contrast), "/superpixel_fraction");
    assert!(share("0") >= share("6") && share("6") > share("32"));
    let error = |shading| number(find("shading", shading), "/accuracy/rmse");
    assert!(error("triangle") > error("part"));
    for row in rows {
        assert!(number(row, "/cost/gpu_ms/min") > 0.0, "{row}");
    }
    let csv = std::fs::read_to_string(folder.path().join("out/choices.csv")).unwrap();
    let columns: Vec<_> = body(&csv).map(|line| line.split(',').count()).collect();
    assert_eq!(columns, vec![15; rows.len() + 1]);
    let printed = String::from_utf8(run.stdout).unwrap();
    assert!(printed.contains("one option changed"), "{printed}");
}

/// An orthographic camera has no panorama; the other variants are timed all the same.
#[test]
fn a_variant_that_a_camera_can_not_have_says_why() {
    let (mut headless, scene, camera) = stage("letters.glb");
    let camera = Camera { projection: Projection::Orthographic { half_height: 1.0, near: 0.0, far: 100.0 }, ..camera };
    let settings = settings(MethodKind::None, 1);
    let mut warm_up = |variant: Variant| variant.warm_up(&mut headless, &scene, &camera, &settings);
    assert!(warm_up(Variant::Planar).is_ok());
    assert!(warm_up(Variant::Rig).err().unwrap().is::<PanoramaError>());
}

/// Results have each method in motion, and superpixels with as many samples as supersampling.
#[test]
fn motion_is_measured_against_the_truth_of_each_frame() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("letters.glb");
    let arguments = "--motion-size 48x32 --cache cache --out out";
    let (run, results) = measured(folder.path(), &["--motion", &scene], arguments);
    let out = folder.path().join("out");
    let moved = &results["motion"][0];
    assert_eq!((&moved["name"], &moved["textured"]), (&"letters".into(), &false.into()));
    assert_eq!(moved["size"], serde_json::json!([48, 32]));
    let rows = moved["rows"].as_array().unwrap();
    for motion in ["pan", "turn"] {
        let find = |method: &str, samples: u32| {
            let mine = |row: &&Value| row["motion"] == motion && row["method"] == method && row["samples"] == samples;
            rows.iter().find(mine).unwrap_or_else(|| panic!("no {method} {samples}"))
        };
        let cells = [("none", 1), ("msaa", 4), ("ssaa", 16), ("ssaa", 64)];
        for of in ["rmse", "flicker"] {
            let values = cells.map(|(method, samples)| number(find(method, samples), &format!("/{of}")));
            assert!(values.is_sorted_by(|a, b| *a > 1.4 * b), "{motion} {of} {values:?}");
            let none = values[0];
            for samples in [16, 64] {
                let superpixel = number(find("superpixel", samples), &format!("/{of}"));
                assert!(0.0 < superpixel && superpixel < 0.3 * none, "{motion} {of} {superpixel}");
            }
        }
        // An error that is the same in every frame does not flicker.
        for row in rows {
            assert!(number(row, "/flicker") <= number(row, "/rmse") * 1.05, "{row}");
        }
    }
    let summary = results["motion_summary"].as_array().unwrap();
    assert_eq!(summary.iter().map(|at| &at["samples"]).collect::<Vec<_>>(), [16, 64]);
    let csv = std::fs::read_to_string(out.join("motion.csv")).unwrap();
    let columns: Vec<_> = body(&csv).map(|line| line.split(',').count()).collect();
    assert_eq!(columns, vec![9; rows.len() + 1]);
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    let printed = String::from_utf8(run.stdout).unwrap();
    assert!(page.contains("in motion") && printed.contains("in motion"));
}
