//! The window on a display of its own, with real input. Needs Xvfb and xdotool, and fails without them.

#[allow(dead_code, reason = "other tests use the rest")]
mod cli_support;
mod scene_builder;
mod view_support;

use cli_support::{asset, finish, gpc};
use glam::DVec3;
use scene_builder::Builder;
use serde_json::json;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};
use view_support::{Display, Loss, NOTES_SEEN, PATIENCE, Viewer, drop_file};

/// Runs a `gpc render` command, to a file of that name.
fn render(folder: &Path, command: &[String], output: &str) -> Vec<u8> {
    let mut arguments: Vec<_> = command.iter().map(String::as_str).collect();
    let file = 1 + arguments.iter().position(|word| *word == "-o").unwrap();
    arguments[file] = output;
    gpc(folder, &arguments).ok();
    std::fs::read(folder.join(output)).unwrap()
}

/// The window's pixels are those of an image, but for how the device rounds them to codes.
fn assert_shows(pixels: &[[u8; 3]], file: &[u8]) {
    let image = image::load_from_memory(file).unwrap().to_rgb8();
    assert_eq!(pixels.len(), image.pixels().len());
    let differ = |(shown, rendered): &(&[u8; 3], &image::Rgb<u8>)| {
        (0..3).any(|channel| shown[channel].abs_diff(rendered[channel]) > 1)
    };
    let different = pixels.iter().zip(image.pixels()).filter(differ).count();
    assert_eq!(different, 0, "of {} pixels", pixels.len());
}

#[test]
fn what_is_seen_at_rest_is_what_the_copied_command_renders() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let scene = asset("letters.glb");
    let mut viewer = Viewer::open(&display, folder.path(), &[&scene, "--size", "320x200"]);
    viewer.wait_for("at rest");
    viewer.show_picture_alone();

    // Turned, moved sideways and nearer; the pointer ends beside the window.
    viewer.drag("1", ["200", "80"]);
    viewer.drag("2", ["150", "110"]);
    display.input(&[
        "mousemove",
        "100",
        "60",
        "click",
        "4",
        "click",
        "4",
        "mousemove",
        "600",
        "400",
    ]);
    viewer.wait_for("at rest");
    let shown = display.pixels([320, 200]);
    let command = viewer.command();
    assert!(
        command.iter().any(|word| word.starts_with("--eye=")),
        "{command:?}"
    );
    let rendered = render(folder.path(), &command, "direct.png");
    assert_shows(&shown, &rendered);

    // The same picture to a file has the same bytes.
    viewer.key("F12");
    viewer.wait_for("wrote letters.png");
    let written = std::fs::read(folder.path().join("letters.png")).unwrap();
    assert!(
        written == rendered,
        "the screenshot has other bytes than the command's image"
    );

    // A window of another size, and another method.
    display.input(&["search", "--name", "gpc$", "windowsize", "400", "240"]);
    viewer.wait_for("at rest");
    viewer.key("n");
    viewer.wait_for("at rest");
    let command = viewer.command();
    assert!(command.iter().any(|word| word == "400x240"), "{command:?}");
    assert!(command.iter().any(|word| word == "none"), "{command:?}");
    // What is said goes after a while.
    std::thread::sleep(NOTES_SEEN);
    let shown = display.pixels([400, 240]);
    assert_shows(&shown, &render(folder.path(), &command, "resized.png"));
    viewer.close();
}

#[test]
fn a_split_and_a_magnifier_show_pixels_of_both_methods() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let scene = asset("fence.glb");
    let arguments = [&scene, "--size", "320x200", "--samples", "16"];
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    viewer.show_picture_alone();
    let left = viewer.command();
    let superpixels = render(folder.path(), &left, "left.png");
    viewer.key("x");
    viewer.wait_for("at rest");
    display.input(&["mousemove", "240", "100"]);
    let right = viewer.command();
    let none = render(folder.path(), &right, "right.png");
    assert_ne!(superpixels, none);
    display.input(&["mousemove", "600", "400"]);
    std::thread::sleep(NOTES_SEEN);
    let shown = display.pixels([320, 200]);
    let halves = |file: &[u8]| image::load_from_memory(file).unwrap().to_rgb8();
    let (superpixels, none) = (halves(&superpixels), halves(&none));
    for (index, shown) in shown.iter().enumerate() {
        let (x, y) = (index as u32 % 320, index as u32 / 320);
        // The line itself is drawn over both.
        if (158..=161).contains(&x) {
            continue;
        }
        let expected = if x < 160 { &superpixels } else { &none }.get_pixel(x, y);
        let error = (0..3).map(|channel| shown[channel].abs_diff(expected[channel]));
        assert!(
            error.max() <= Some(1),
            "{shown:?} at {x}, {y}: {expected:?}"
        );
    }

    // 8 times enlarged, the pixel under the pointer is as large as the block around it.
    display.input(&["mousemove", "240", "100"]);
    viewer.key("l");
    std::thread::sleep(Duration::from_secs(2));
    let shown = display.pixels([320, 200]);
    // The pointer itself hides the block in the middle.
    let expected = none.get_pixel(240 - 5, 100 - 5);
    let block = shown[(100 - 5 * 8) * 320 + 240 - 5 * 8];
    let error = (0..3).map(|channel| block[channel].abs_diff(expected[channel]));
    assert!(error.max() <= Some(1), "{block:?}: {expected:?}");
    viewer.close();
}

#[test]
fn a_lens_shows_what_the_copied_zoom_makes() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let scene = asset("letters.glb");
    let arguments = [&scene, "--size", "320x200", "--samples", "64"];
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    viewer.show_picture_alone();
    display.input(&["mousemove", "120", "90"]);
    viewer.key("z");
    viewer.wait_for("at rest");
    // A click moves it, dragging sets its radius and the wheel its multiplicity.
    viewer.drag("1", ["200", "100"]);
    display.input(&["click", "4", "mousemove", "600", "400"]);
    viewer.wait_for("at rest");
    let command = viewer.command();
    assert_eq!(command[0], "zoom");
    for word in ["--center=160,100", "40,40"] {
        assert!(
            command.iter().any(|found| found == word),
            "{word} in {command:?}"
        );
    }
    let multiplicity = 1 + command
        .iter()
        .position(|word| word == "--multiplicity")
        .unwrap();
    assert!(
        command[multiplicity].parse::<f64>().unwrap() < 0.5,
        "{command:?}"
    );
    std::thread::sleep(NOTES_SEEN);
    let shown = display.pixels([320, 200]);
    assert_shows(&shown, &render(folder.path(), &command, "zoom.png"));

    // Without the lens, what pixels hold beside their colours: superpixels are the fourth.
    viewer.key("z");
    let mut arguments = viewer.command();
    for _ in 0..4 {
        viewer.key("o");
    }
    viewer.wait_for("shows superpixels");
    viewer.wait_for("at rest");
    std::thread::sleep(NOTES_SEEN);
    let shown = display.pixels([320, 200]);
    arguments.extend(["--aov", "superpixels"].map(str::to_owned));
    render(folder.path(), &arguments, "with.png");
    let superpixels = std::fs::read(folder.path().join("with.superpixels.png")).unwrap();
    assert_shows(&shown, &superpixels);
    viewer.close();
}

#[test]
fn a_file_that_is_written_again_is_shown_again() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let file = folder.path().join("scene.glb");
    std::fs::copy(asset("checker.glb"), &file).unwrap();
    let arguments = ["scene.glb", "--size", "320x200", "--samples", "4"];
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    viewer.show_picture_alone();
    let before = display.pixels([320, 200]);
    // What can't be read is said, and the picture stays.
    std::fs::write(&file, "no scene").unwrap();
    viewer.wait_for("error");
    std::fs::copy(asset("spheres.glb"), &file).unwrap();
    viewer.wait_for("shows ");
    viewer.wait_for("at rest");
    std::thread::sleep(NOTES_SEEN);
    let shown = display.pixels([320, 200]);
    assert_ne!(shown, before);
    let command = viewer.command();
    assert_shows(&shown, &render(folder.path(), &command, "again.png"));
    assert!(viewer.quit().success());
}

#[test]
fn an_animation_is_played_and_shown_where_it_stops() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    std::fs::write(folder.path().join("moving.glb"), moving_triangle()).unwrap();
    let arguments = ["moving.glb", "--size", "320x200", "--samples", "16"];
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    viewer.show_picture_alone();
    let before = display.pixels([320, 200]);
    assert!(!viewer.command().contains(&"--time".to_owned()));
    viewer.key("space");
    std::thread::sleep(Duration::from_secs(3));
    viewer.key("space");
    viewer.wait_for("at rest");
    let command = viewer.command();
    let time = 1 + command.iter().position(|word| word == "--time").unwrap();
    assert!(command[time].parse::<f64>().unwrap() > 0.5, "{command:?}");
    std::thread::sleep(NOTES_SEEN);
    let shown = display.pixels([320, 200]);
    assert_ne!(shown, before);
    assert_shows(&shown, &render(folder.path(), &command, "moved.png"));
    viewer.close();
}

/// A triangle that moves sideways for 1,000 seconds.
fn moving_triangle() -> Vec<u8> {
    let mut builder = Builder::new();
    let node = builder.triangle(json!({}));
    let times = builder.floats(&[[0.0], [1000.0]]);
    let places = builder.floats(&[[0.0, 0.0, 0.0], [100.0, 0.0, 0.0]]);
    builder.push(
        "animations",
        json!({
            "samplers": [{"input": times, "output": places}],
            "channels": [{"sampler": 0, "target": {"node": node, "path": "translation"}}],
        }),
    );
    builder.glb()
}

#[test]
fn what_can_not_be_opened_is_said_and_leaves_the_window_open() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    std::fs::write(folder.path().join("broken.glb"), "no scene").unwrap();
    let scene = asset("checker.glb");
    let arguments = ["broken.glb", &scene, "--size", "320x200", "--samples", "4"];
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("broken.glb");
    let before = display.pixels([320, 200]);
    assert!(
        before.iter().any(|pixel| *pixel != [0; 3]),
        "the window says nothing"
    );
    // The next scene can be seen all the same.
    viewer.repeat_until("shows ", |display| display.input(&["key", "Right"]));
    viewer.wait_for("at rest");
    // So can this one, once it is a scene.
    viewer.repeat_until("error: broken.glb", |display| {
        display.input(&["key", "Left"]);
    });
    std::fs::copy(&scene, folder.path().join("broken.glb")).unwrap();
    viewer.wait_for("shows broken.glb");
    viewer.wait_for("at rest");
    assert!(viewer.quit().success());
}

#[test]
fn files_and_folders_that_are_dropped_are_opened() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let scenes = folder.path().join("scenes");
    std::fs::create_dir(&scenes).unwrap();
    for name in ["b.glb", "a.glb"] {
        std::fs::copy(asset("checker.glb"), scenes.join(name)).unwrap();
    }
    let arguments = [&asset("letters.glb"), "--size", "320x200", "--samples", "4"];
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    let window = display.window();
    drop_file(&display, window, &scenes.join("b.glb"));
    viewer.wait_for("scenes/b.glb");
    viewer.wait_for("at rest");
    // A folder is its scenes by name.
    drop_file(&display, window, &scenes);
    viewer.wait_for("scenes/a.glb");
    viewer.wait_for("at rest");
    viewer.key("Right");
    viewer.wait_for("scenes/b.glb");
    viewer.wait_for("at rest");
    viewer.close();
}

#[test]
fn the_view_that_options_ask_for_is_flown_through_and_hidden() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let options = "--size 320x200 --samples 16 --eye=0.5,2,6 --target=0,1,0 --fov 50 --edges 1.5,#204060 --exposure=0.5";
    let scene = asset("letters.glb");
    let mut arguments = vec![scene.as_str()];
    arguments.extend(options.split(' '));
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    viewer.show_picture_alone();
    let command = viewer.command();
    for word in ["--target=0,1,0", "50", "--exposure=0.5"] {
        assert!(
            command.iter().any(|found| found == word),
            "{word} in {command:?}"
        );
    }
    let ordinary = ["render", &scene, "-o", "ordinary.png"].into_iter();
    let ordinary = ordinary
        .chain(["--background", "#2b2f36"])
        .chain(options.split(' '));
    let asked: Vec<_> = ordinary.map(str::to_owned).collect();
    std::thread::sleep(NOTES_SEEN);
    let shown = display.pixels([320, 200]);
    assert_shows(&shown, &render(folder.path(), &asked, "ordinary.png"));

    // Forward while the key is down, then a look aside.
    viewer.key("f");
    viewer.wait_for("flying");
    let eye = |command: &[String]| {
        let word = command.iter().find_map(|word| word.strip_prefix("--eye="));
        let numbers = word
            .unwrap()
            .split(',')
            .map(|number| number.parse().unwrap());
        DVec3::from_slice(&numbers.collect::<Vec<f64>>())
    };
    let start = eye(&command);
    // A window that is busy may hear of both ends of a press at once.
    let until = Instant::now() + PATIENCE;
    while (eye(&viewer.command()) - start).length() < 0.05 {
        assert!(Instant::now() < until, "the eye does not move");
        display.input(&["keydown", "w", "sleep", "1", "keyup", "w"]);
    }
    viewer.drag("1", ["200", "90"]);
    viewer.wait_for("at rest");
    let flown = viewer.command();
    let forward = (DVec3::new(0.0, 1.0, 0.0) - start).normalize();
    let moved = eye(&flown) - start;
    assert!(
        moved.normalize().dot(forward) > 0.999,
        "{moved} is not {forward}"
    );
    viewer.key("Escape");

    // A window that is hidden is drawn again when it is seen.
    let window = display.window().to_string();
    display.input(&["windowunmap", "--sync", &window]);
    display.input(&[
        "windowmap",
        "--sync",
        &window,
        "windowfocus",
        "--sync",
        &window,
    ]);
    display.input(&["mousemove", "600", "400"]);
    std::thread::sleep(NOTES_SEEN);
    let shown = display.pixels([320, 200]);
    assert_shows(&shown, &render(folder.path(), &flown, "flown.png"));
    viewer.close();
}

#[test]
fn a_lost_device_is_replaced_and_one_after_the_other_ends_it() {
    let (display, folder, loss) = (Display::open(), tempfile::tempdir().unwrap(), Loss::new());
    let scene = asset("letters.glb");
    let arguments = [&scene, "--size", "320x200", "--samples", "16"];
    let mut viewer = Viewer::open_with(&display, folder.path(), &arguments, &loss.variables());
    viewer.wait_for("at rest");
    viewer.show_picture_alone();
    viewer.drag("1", ["200", "80"]);
    viewer.wait_for("at rest");
    let command = viewer.command();
    loss.once();
    display.input(&["mousemove", "600", "400", "click", "1"]);
    viewer.repeat_until("everything is made again", |display| {
        display.input(&["mousemove", "100", "60", "mousemove", "600", "400"]);
    });
    viewer.wait_for("shows ");
    viewer.wait_for("at rest");
    // The view is what it was.
    assert_eq!(viewer.command(), command);
    std::thread::sleep(NOTES_SEEN);
    let shown = display.pixels([320, 200]);
    assert_shows(&shown, &render(folder.path(), &command, "again.png"));

    loss.always();
    viewer.key("n");
    let status = viewer.ended();
    viewer.read_to_end();
    assert_eq!(status.code(), Some(4), "{:#?}", viewer.said);
    let last = viewer.said.last().unwrap();
    assert_eq!(
        last,
        "error: the device was lost; its driver may have reset it"
    );
}

#[test]
fn without_a_display_the_command_that_needs_none_is_named() {
    let output = Command::new(env!("CARGO_BIN_EXE_gpc"))
        .args(["view", "scene.glb"])
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .unwrap();
    finish(output).exits(3).says(&["gpc render"]);
}
