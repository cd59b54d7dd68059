//! The window, on separate displays and with real input. Needs Xvfb, xdotool, sway and grim, and fails without them.

#[path = "../common/command.rs"]
#[allow(dead_code, reason = "other tests use the rest")]
mod command;
#[path = "../common/scene_builder.rs"]
mod scene_builder;
#[path = "../common/shadowed_floor.rs"]
mod shadowed_floor;
mod support;

use command::{asset, finish, gpc};
use glam::DVec3;
use scene_builder::Builder;
use serde_json::json;
use shadowed_floor::shadowed_floor;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};
use support::{Density, Display, Loss, Monitor, Monitors, PATIENCE, Program, Viewer, drop_file};

/// Runs a `gpc render` command that writes to the file `output`, and returns the file's bytes.
fn render(folder: &Path, command: &[String], output: &str) -> Vec<u8> {
    let mut arguments: Vec<_> = command.iter().map(String::as_str).collect();
    let file = 1 + arguments.iter().position(|word| *word == "-o").unwrap();
    arguments[file] = output;
    gpc(folder, &arguments).ok();
    std::fs::read(folder.join(output)).unwrap()
}

/// Waits until the window's pixels are correct; notes that cover them disappear after a while.
fn assert_pixels(display: &Display, size: [usize; 2], wrong: impl Fn(&[[u8; 3]]) -> usize) {
    let until = Instant::now() + PATIENCE;
    loop {
        let count = wrong(&display.pixels(size));
        if count == 0 {
            return;
        }
        assert!(Instant::now() < until, "{count} pixels of {size:?} are others");
        std::thread::sleep(Duration::from_millis(200));
    }
}

/// Asserts that the window shows an image, except for the device's rounding of colours to codes.
fn assert_shows(display: &Display, size: [usize; 2], file: &[u8]) {
    let image = image::load_from_memory(file).unwrap().to_rgb8();
    assert_eq!([image.width() as usize, image.height() as usize], size);
    assert_pixels(display, size, |pixels| {
        let pairs = pixels.iter().zip(image.pixels());
        pairs.filter(|(shown, expected)| differ(shown, expected)).count()
    });
}

/// Asserts that the screenshot key writes these bytes.
fn assert_writes(viewer: &mut Viewer, folder: &Path, expected: &[u8]) {
    viewer.key("F12");
    let line = viewer.wait_for("wrote ");
    let written = std::fs::read(folder.join(line.strip_prefix("wrote ").unwrap())).unwrap();
    assert!(written == expected, "the file has other bytes than the command's");
}

fn differ(shown: &[u8; 3], expected: &image::Rgb<u8>) -> bool {
    (0..3).any(|channel| shown[channel].abs_diff(expected[channel]) > 1)
}

#[test]
fn what_is_seen_at_rest_is_what_the_copied_command_renders() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let scene = asset("letters.glb");
    let mut viewer = Viewer::open(&display, folder.path(), &[&scene, "--size", "320x200"]);
    viewer.wait_for("at rest");
    viewer.show_picture_alone();

    // The view is turned, moved sideways and zoomed; the pointer ends outside of the window.
    viewer.drag("1", ["200", "80"]);
    viewer.drag("2", ["150", "110"]);
    display.input(&["mousemove", "100", "60", "click", "4", "click", "4", "mousemove", "600", "400"]);
    viewer.wait_for("at rest");
    let command = viewer.command();
    assert!(command.iter().any(|word| word.starts_with("--eye=")), "{command:?}");
    let rendered = render(folder.path(), &command, "direct.png");
    assert_shows(&display, [320, 200], &rendered);

    // A file with the same picture has the same bytes.
    viewer.key("F12");
    viewer.wait_for("wrote letters.png");
    let written = std::fs::read(folder.path().join("letters.png")).unwrap();
    assert!(written == rendered, "the screenshot has other bytes than the command's image");

    // The window gets another size, and the picture another method.
    display.input(&["search", "--name", "gpc$", "windowsize", "400", "240"]);
    viewer.wait_for("at rest");
    viewer.key("n");
    viewer.wait_for("at rest");
    let command = viewer.command();
    assert!(command.iter().any(|word| word == "400x240"), "{command:?}");
    assert!(command.iter().any(|word| word == "none"), "{command:?}");
    assert_shows(&display, [400, 240], &render(folder.path(), &command, "resized.png"));
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
    let halves = |file: &[u8]| image::load_from_memory(file).unwrap().to_rgb8();
    let (superpixels, none) = (halves(&superpixels), halves(&none));
    assert_pixels(&display, [320, 200], |pixels| {
        let wrong = |(index, shown): &(usize, &[u8; 3])| {
            let (x, y) = (*index as u32 % 320, *index as u32 / 320);
            // The line of the split covers both pictures.
            let half = if x < 160 { &superpixels } else { &none };
            !(158..=161).contains(&x) && differ(shown, half.get_pixel(x, y))
        };
        pixels.iter().enumerate().filter(wrong).count()
    });

    // Enlarged 8 times, the pixel under the pointer is as large as the block around it.
    display.input(&["mousemove", "240", "100"]);
    viewer.key("l");
    // The pointer itself hides the block in the middle.
    let expected = none.get_pixel(240 - 5, 100 - 5);
    assert_pixels(&display, [320, 200], |pixels| {
        let block = pixels[(100 - 5 * 8) * 320 + 240 - 5 * 8];
        usize::from(differ(&block, expected))
    });
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
    // A click moves the lens, a drag sets its radius, and the wheel its multiplicity.
    viewer.drag("1", ["200", "100"]);
    display.input(&["click", "4", "mousemove", "600", "400"]);
    viewer.wait_for("at rest");
    let command = viewer.command();
    assert_eq!(command[0], "zoom");
    for word in ["--center=160,100", "40,40"] {
        assert!(command.iter().any(|found| found == word), "{word} in {command:?}");
    }
    let multiplicity = 1 + command.iter().position(|word| word == "--multiplicity").unwrap();
    assert!(command[multiplicity].parse::<f64>().unwrap() < 0.5, "{command:?}");
    let zoomed = render(folder.path(), &command, "zoom.png");
    assert_shows(&display, [320, 200], &zoomed);
    assert_writes(&mut viewer, folder.path(), &zoomed);

    // After the lens is removed, overlays are shown; superpixels are the fourth.
    viewer.key("z");
    let mut arguments = viewer.command();
    for _ in 0..4 {
        viewer.key("o");
    }
    viewer.wait_for("shows superpixels");
    viewer.wait_for("at rest");
    arguments.extend(["--aov", "superpixels"].map(str::to_owned));
    render(folder.path(), &arguments, "with.png");
    let superpixels = std::fs::read(folder.path().join("with.superpixels.png")).unwrap();
    assert_shows(&display, [320, 200], &superpixels);
    viewer.close();
}

#[test]
fn an_environment_is_seen_behind_the_scene_at_rest() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let sky = |x: u32, y: u32| image::Rgb([0.2 + 0.05 * x as f32, 0.4, 0.1 * y as f32]);
    image::Rgb32FImage::from_fn(16, 8, sky).save(folder.path().join("sky.hdr")).unwrap();
    let scene = asset("letters.glb");
    let options = "--size 320x200 --samples 16 --environment sky.hdr --background environment";
    let arguments: Vec<_> = std::iter::once(scene.as_str()).chain(options.split(' ')).collect();
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    viewer.show_picture_alone();
    for turned in [false, true] {
        if turned {
            viewer.drag("1", ["200", "100"]);
            display.input(&["mousemove", "600", "400"]);
            viewer.wait_for("at rest");
        }
        let command = viewer.command();
        assert!(command.contains(&"--background=environment".to_owned()));
        let expected = render(folder.path(), &command, "environment.png");
        let image = image::load_from_memory(&expected).unwrap().to_rgba8();
        assert!(image.pixels().all(|pixel| pixel.0[3] == 255));
        assert_shows(&display, [320, 200], &expected);
    }
    // A lens enlarges only the scene.
    display.input(&["mousemove", "120", "90", "key", "z", "mousemove", "600", "400"]);
    viewer.wait_for("at rest");
    let command = viewer.command();
    assert_eq!(command[0], "zoom");
    render(folder.path(), &command, "zoom.png");
    viewer.close();
}

#[test]
fn shadows_are_seen_at_rest_and_in_lenses() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    std::fs::write(folder.path().join("lit.glb"), shadowed_floor()).unwrap();
    let options = "lit.glb --size 320x200 --samples 16 --shadows exact --eye=0,3,5 --target=0,0,0 --fov 45";
    let arguments: Vec<_> = options.split(' ').collect();
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    viewer.show_picture_alone();
    let command = viewer.command();
    assert!(command.contains(&"--shadows=exact".to_owned()), "{command:?}");
    let shadowed = render(folder.path(), &command, "shadowed.png");
    let without: Vec<_> = command.into_iter().filter(|word| !word.starts_with("--shadows")).collect();
    assert_ne!(render(folder.path(), &without, "without.png"), shadowed);
    assert_shows(&display, [320, 200], &shadowed);
    assert_writes(&mut viewer, folder.path(), &shadowed);
    // The lens is made of the same scene, and moves without a new upload.
    display.input(&["mousemove", "160", "120", "key", "z", "mousemove", "600", "400"]);
    viewer.wait_for("at rest");
    let command = viewer.command();
    assert_eq!(command[0], "zoom");
    assert_shows(&display, [320, 200], &render(folder.path(), &command, "zoom.png"));
    viewer.close();
}

#[test]
fn a_photograph_has_lenses_and_a_zoomed_one_is_unzoomed_under_the_pointer() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let arguments = ["render", &asset("letters.glb"), "-o", "photo.png"];
    let options = "--size 320x200 --samples 16 --background #708090".split(' ');
    let options: Vec<_> = options.collect();
    let ordinary = arguments.iter().chain(&options).map(|word| (*word).to_owned());
    let photo = render(folder.path(), &ordinary.collect::<Vec<_>>(), "photo.png");
    let arguments = ["photo.png", "--size", "320x200"];
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    viewer.focus("nothing to copy");
    display.input(&["mousemove", "600", "400", "key", "p"]);
    assert_shows(&display, [320, 200], &photo);

    // There are two lenses; the second enlarges more.
    display.input(&["mousemove", "100", "90", "key", "z"]);
    display.input(&["mousemove", "250", "120", "key", "a", "click", "4"]);
    display.input(&["mousemove", "600", "400"]);
    let command = viewer.command();
    let centers = command.iter().filter(|word| word.starts_with("--center="));
    assert_eq!(centers.collect::<Vec<_>>(), ["--center=100,90", "--center=250,120"]);
    let zoomed = render(folder.path(), &command, "zoomed.png");
    assert_shows(&display, [320, 200], &zoomed);
    // Transitions are coloured, and nothing else.
    viewer.key("t");
    let plain = image::load_from_memory(&zoomed).unwrap().to_rgb8();
    assert_pixels(&display, [320, 200], |pixels| {
        let is_same = |x: u32, y: u32| {
            let shown = pixels[y as usize * 320 + x as usize];
            !differ(&shown, plain.get_pixel(x, y))
        };
        usize::from(is_same(150, 90) || !is_same(100, 95))
    });
    assert_writes(&mut viewer, folder.path(), &zoomed);
    // After removing the active lens, the other one is left.
    viewer.key("Delete");
    let one = render(folder.path(), &viewer.command(), "one.png");
    assert_ne!(one, zoomed);
    viewer.close();

    let arguments = ["one.png", "--size", "320x200"];
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    viewer.focus("nothing to copy");
    display.input(&["mousemove", "100", "90", "key", "p", "key", "u"]);
    let command = viewer.command();
    assert_eq!(command[0], "unzoom");
    let unzoomed = render(folder.path(), &command, "unzoomed.png");
    let unzoomed = image::load_from_memory(&unzoomed).unwrap().to_rgb8();
    let radius = unzoomed.width() / 2;
    assert_pixels(&display, [320, 200], |pixels| {
        let wrong = |(x, y, expected): &(u32, u32, &image::Rgb<u8>)| {
            // The pointer itself hides the middle.
            let is_hidden = x.abs_diff(radius) < 20 && y.abs_diff(radius) < 20;
            let [column, row] = [100 + x - radius, 90 + y - radius];
            let shown = pixels[row as usize * 320 + column as usize];
            !is_hidden && differ(&shown, expected)
        };
        unzoomed.enumerate_pixels().filter(wrong).count()
    });
    viewer.close();
}

#[test]
fn overlays_count_triangles_and_show_errors() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let scene = asset("letters.glb");
    let arguments = [&scene, "--size", "320x200", "--samples", "16"];
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    viewer.show_picture_alone();
    let command = viewer.command();
    for _ in 0..6 {
        viewer.key("o");
    }
    let mut finer = command.clone();
    let size = finer.iter().position(|word| word == "320x200").unwrap();
    finer[size] = "1280x800".to_owned();
    let samples = finer.iter().position(|word| word == "--samples").unwrap();
    finer.drain(samples..samples + 2);
    finer.extend(["--aa", "none", "--aov", "id"].map(str::to_owned));
    render(folder.path(), &finer, "finer.png");
    let ids = image::open(folder.path().join("finer.id.png"));
    let ids = ids.unwrap().to_rgb8();
    let count = |index: usize| {
        let (x, y) = (index as u32 % 320, index as u32 / 320);
        let samples = (0..16).map(|sample| ids.get_pixel(4 * x + sample % 4, 4 * y + sample / 4));
        let mut seen: Vec<_> = samples.map(|id| id.0).filter(|id| *id != [0; 3]).collect();
        seen.sort_unstable();
        seen.dedup();
        seen.len().max(1)
    };
    let counts: Vec<_> = (0..320 * 200).map(count).collect();
    assert!(counts.iter().filter(|count| **count > 1).count() > 1000);
    assert_pixels(&display, [320, 200], |pixels| {
        let expected = counts.iter().map(|count| heat((*count as f64).log2() / 4.0));
        let pairs = pixels.iter().zip(expected);
        pairs.filter(|(shown, expected)| *shown != expected).count()
    });

    viewer.key("o");
    let mut brute = command.clone();
    brute[samples + 1] = "256".to_owned();
    brute.extend(["--aa", "ssaa"].map(str::to_owned));
    let pictures = [(&command, "picture.png"), (&brute, "brute.png")];
    let [picture, brute] = pictures.map(|(command, name)| {
        let file = render(folder.path(), command, name);
        image::load_from_memory(&file).unwrap().to_rgb8()
    });
    assert_pixels(&display, [320, 200], |pixels| {
        let pairs = picture.pixels().zip(brute.pixels());
        let errors = pairs.map(|(a, b)| (0..3).map(|channel| a[channel].abs_diff(b[channel])).max());
        let expected = errors.map(|error| heat(f64::from(error.unwrap()) / 16.0));
        let pairs = pixels.iter().zip(expected);
        pairs.filter(|(shown, expected)| *shown != expected).count()
    });
    viewer.close();
}

/// Colour of a share on a heat map's scale.
fn heat(share: f64) -> [u8; 3] {
    let palette = nv_flip::magma_lut().to_vec();
    let index = (share.min(1.0) * 255.0).round() as usize;
    palette.as_chunks::<3>().0[index]
}

/// A file that is never read to its end: a pipe called slow.glb, to which nobody writes.
fn slow_file(folder: &Path) -> PathBuf {
    let pipe = folder.join("slow.glb");
    let made = Command::new("mkfifo").arg(&pipe).status().unwrap();
    assert!(made.success());
    pipe
}

#[test]
fn loading_is_stopped_and_blocks_nothing() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let pipe = slow_file(folder.path());
    let arguments = [&asset("checker.glb"), "slow.glb", "--size", "320x200", "--samples", "4"];
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    viewer.show_picture_alone();
    let before = viewer.command();
    let seen = display.pixels([320, 200]);
    viewer.key("Right");
    // A note says that the scene is loading.
    assert_pixels(&display, [320, 200], |pixels| usize::from(pixels == seen));
    // The picture can still be turned, also where the notes are.
    for from in [["160", "100"], ["60", "180"]] {
        let [x, y] = from;
        display.input(&["mousemove", x, y, "mousedown", "1"]);
        display.input(&["mousemove", "200", "80", "mouseup", "1"]);
        viewer.wait_for("at rest");
    }
    assert_ne!(viewer.command(), before);
    viewer.key("Escape");
    viewer.wait_for("stopped loading slow.glb");
    // The reading thread ends once the pipe does.
    drop(std::fs::OpenOptions::new().write(true).open(&pipe).unwrap());
    viewer.close();
}

/// Closes the window in the middle of work, and returns what the viewer says from then on. The validation layer is off,
/// because the viewer would wait for its messages.
fn close_amid_work(arguments: &[&str], begin: impl FnOnce(&mut Viewer, &Path)) -> Vec<String> {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let variables = [("GPC_VALIDATION", Path::new(""))];
    slow_file(folder.path());
    let mut viewer = Viewer::open_with(&display, folder.path(), arguments, &variables);
    viewer.repeat_until("can be unzoomed", |display| display.input(&["key", "u"]));
    begin(&mut viewer, folder.path());
    viewer.read();
    let before = viewer.said.len();
    let status = viewer.quit();
    viewer.read_to_end();
    assert!(status.success(), "{status}: {:#?}", viewer.said);
    viewer.said.split_off(before)
}

#[test]
fn writing_is_stopped_by_a_key() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let scene = asset("fence.glb");
    let mut viewer = Viewer::open(&display, folder.path(), &[&scene, "--size", "640x480"]);
    viewer.wait_for("at rest");
    viewer.show_picture_alone();
    display.input(&["key", "F12", "key", "Escape"]);
    viewer.wait_for("stopped writing fence.png");
    // New work is written after the stopped work, to a file of the same name.
    viewer.key("n");
    viewer.wait_for("at rest");
    viewer.key("F12");
    viewer.wait_for("wrote fence.png");
    let written = std::fs::read(folder.path().join("fence.png")).unwrap();
    assert!(written == render(folder.path(), &viewer.command(), "none.png"));
    viewer.close();
}

#[test]
fn at_twice_the_density_the_panel_is_twice_as_large_and_pixels_are_the_windows() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let _density = Density::new(&display, 192);
    let scene = asset("letters.glb");
    let arguments = [&scene, "--size", "600x440", "--samples", "4"];
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    viewer.focus("copied: ");
    // This is the panel's button `none`, at 101, 69 on a display of normal density.
    display.input(&["mousemove", "202", "138", "sleep", "0.3", "click", "1"]);
    viewer.wait_for("at rest");
    let command = viewer.command();
    for word in ["600x440", "none"] {
        assert!(command.iter().any(|found| found == word), "{command:?}");
    }
    display.input(&["mousemove", "630", "470", "key", "p"]);
    let rendered = render(folder.path(), &command, "none.png");
    assert_shows(&display, [600, 440], &rendered);
    // The lens appears at the pointer.
    display.input(&["mousemove", "420", "300", "key", "z"]);
    viewer.wait_for("at rest");
    let command = viewer.command();
    assert!(command.contains(&"--center=420,300".to_owned()), "{command:?}");
    viewer.close();
}

#[test]
fn the_density_of_the_display_may_change() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let density = Density::new(&display, 96);
    let scene = asset("letters.glb");
    let arguments = [&scene, "--size", "300x200", "--samples", "16"];
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    viewer.show_picture_alone();
    display.input(&["mousemove", "630", "470"]);
    // As after moving a window to another monitor, it keeps its apparent size.
    for (dots, size) in [(192, [600, 400]), (96, [300, 200])] {
        density.set(dots);
        let asked = format!("{}x{}", size[0], size[1]);
        let until = Instant::now() + PATIENCE;
        let command = loop {
            let command = viewer.command();
            if command.contains(&asked) {
                break command;
            }
            assert!(Instant::now() < until, "{command:?} is not of {asked}");
        };
        let rendered = render(folder.path(), &command, "rendered.png");
        assert_shows(&display, size, &rendered);
    }
    viewer.close();
}

#[test]
fn a_window_goes_to_another_monitor_and_fills_it() {
    let (monitors, folder) = (Monitors::open(), tempfile::tempdir().unwrap());
    let options = ["--samples", "16", "--background=#2b2f36", "--camera", "0"];
    let scene = asset("letters.glb");
    let arguments = [&[scene.as_str(), "--size", "600x400"][..], &options].concat();
    let mut viewer = monitors.start(&mut Program::viewer(folder.path(), &arguments));
    viewer.wait_for("at rest");
    let window = "[title=\"gpc$\"]";
    for (orders, monitor, size, corner) in [
        ("move absolute position 20 30", Monitor::Left, [600, 400], [20, 30]),
        ("move absolute position 650 10", Monitor::Right, [1200, 800], [20, 20]),
        ("fullscreen enable", Monitor::Right, [1280, 960], [0, 0]),
        ("fullscreen disable, move absolute position 20 30", Monitor::Left, [600, 400], [20, 30]),
    ] {
        monitors.order(&format!("{window} {orders}"));
        let asked = format!("{}x{}", size[0], size[1]);
        let command = ["render", &scene, "-o", "there.png", "--size", &asked];
        let command: Vec<_> = [&command[..], &options].concat();
        let command: Vec<_> = command.into_iter().map(str::to_owned).collect();
        let expected = render(folder.path(), &command, "there.png");
        let expected = image::load_from_memory(&expected).unwrap().to_rgb8();
        // The panel is left of the middle, and has the same apparent size on both monitors.
        let panel = 2 * size[0] / 3;
        let until = Instant::now() + PATIENCE;
        loop {
            let seen = monitors.picture(monitor);
            let wrong = expected.enumerate_pixels().filter(|(x, y, color)| {
                let shown = seen.get_pixel_checked(corner[0] + x, corner[1] + y);
                *x >= panel && shown.is_none_or(|shown| differ(&shown.0, color))
            });
            let count = wrong.count();
            if count == 0 {
                break;
            }
            assert!(Instant::now() < until, "{count} pixels of {asked} are others");
            std::thread::sleep(Duration::from_millis(200));
        }
    }
    monitors.order(&format!("{window} kill"));
    viewer.ended_well();
}

#[test]
fn closing_waits_for_no_load_and_no_compiler() {
    // A pipe to which nobody writes is never read to its end.
    let size = ["--size", "320x200"];
    close_amid_work(&[&["slow.glb"][..], &size].concat(), |_, _| {});
    let scene = asset("letters.glb");
    close_amid_work(&[&[scene.as_str()][..], &size].concat(), |viewer, _| {
        // Every other method has its own kernels.
        for method in ["b", "m", "s"] {
            viewer.key(method);
        }
    });
}

#[test]
fn closing_stops_pictures_that_are_made() {
    // The scene takes many seconds.
    let fence = asset("fence.glb");
    let size = ["--size", "640x480"];
    let said = close_amid_work(&[&[fence.as_str()][..], &size].concat(), |viewer, folder| {
        viewer.repeat_until("writing ", |display| display.input(&["key", "F12"]));
        assert!(!folder.join("fence.png").exists());
    });
    assert!(said.iter().any(|line| line.contains("closed before fence.png was written")), "{said:#?}");
    let said = close_amid_work(&[&[fence.as_str()][..], &size].concat(), |viewer, _| {
        for _ in 0..7 {
            viewer.key("o");
        }
        viewer.wait_for("shows error");
    });
    assert!(!said.iter().any(|line| line.contains("at rest")), "{said:#?}");
    let shadows = ["--shadows", "exact"];
    let said = close_amid_work(&[&[fence.as_str()][..], &size, &shadows].concat(), |_, _| {});
    assert!(!said.iter().any(|line| line.contains("at rest")), "{said:#?}");
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
    let before = render(folder.path(), &viewer.command(), "before.png");
    assert_shows(&display, [320, 200], &before);
    // A file that can't be read causes a note, and the picture stays.
    std::fs::write(&file, "no scene").unwrap();
    viewer.wait_for("error");
    std::fs::copy(asset("spheres.glb"), &file).unwrap();
    viewer.wait_for("shows ");
    viewer.wait_for("at rest");
    let again = render(folder.path(), &viewer.command(), "again.png");
    assert_ne!(again, before);
    assert_shows(&display, [320, 200], &again);
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
    let command = viewer.command();
    assert!(!command.contains(&"--time".to_owned()));
    let before = render(folder.path(), &command, "before.png");
    assert_shows(&display, [320, 200], &before);
    viewer.key("space");
    let time = |command: &[String]| {
        let option = command.iter().position(|word| word == "--time")?;
        command[option + 1].parse::<f64>().ok()
    };
    let until = Instant::now() + PATIENCE;
    while time(&viewer.command()).is_none_or(|time| time < 0.5) {
        assert!(Instant::now() < until, "the animation does not move");
    }
    viewer.key("space");
    viewer.wait_for("at rest");
    let command = viewer.command();
    assert!(time(&command) > Some(0.5), "{command:?}");
    let moved = render(folder.path(), &command, "moved.png");
    assert_ne!(moved, before);
    assert_shows(&display, [320, 200], &moved);
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
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("broken.glb"), "no scene").unwrap();
    std::fs::write(path("empty.gltf"), r#"{"asset": {"version": "2.0"}}"#).unwrap();
    std::fs::create_dir(path("nothing")).unwrap();
    std::fs::create_dir(path("scenes")).unwrap();
    std::fs::copy(asset("checker.glb"), path("scenes/checker.glb")).unwrap();
    let files = ["nothing", "broken.glb", "empty.gltf", "scenes"];
    let options = ["--size", "320x200", "--samples", "4"];
    let arguments = [&files[..], &options].concat();
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("error: nothing has no scene file");
    viewer.wait_for("error: broken.glb");
    let until = Instant::now() + PATIENCE;
    while display.pixels([320, 200]).iter().all(|pixel| *pixel == [0; 3]) {
        assert!(Instant::now() < until, "the window says nothing");
        std::thread::sleep(Duration::from_millis(100));
    }
    // The following scenes can still be shown.
    viewer.repeat_until("nothing to draw", |display| {
        display.input(&["key", "Right"]);
    });
    viewer.wait_for("at rest");
    viewer.key("Right");
    viewer.wait_for("shows scenes/checker.glb");
    viewer.wait_for("at rest");
    viewer.key("Left");
    viewer.wait_for("shows empty.gltf");
    // So can this file, once it is a scene.
    viewer.repeat_until("error: broken.glb", |display| {
        display.input(&["key", "Left"]);
    });
    std::fs::copy(asset("checker.glb"), path("broken.glb")).unwrap();
    viewer.wait_for("shows broken.glb");
    viewer.wait_for("at rest");
    assert!(viewer.quit().success());
}

#[test]
fn a_scene_that_is_mended_is_seen_from_where_it_was_asked_for() {
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    let file = folder.path().join("broken.glb");
    std::fs::write(&file, "no scene").unwrap();
    let arguments = ["broken.glb", "--size", "320x200", "--samples", "4"];
    let arguments = [&arguments[..], &["--eye=3,4,5"]].concat();
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("error: broken.glb");
    std::fs::copy(asset("checker.glb"), &file).unwrap();
    viewer.wait_for("shows broken.glb");
    viewer.wait_for("at rest");
    let command = viewer.command();
    assert!(command.contains(&"--eye=3,4,5".to_owned()), "{command:?}");
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
    // A folder stands for its scenes, sorted by name.
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
    let options =
        "--size 320x200 --samples 16 --eye=0.5,2,6 --target=0,1,0 --fov 50 --edges 1.5,#204060 --exposure=0.5";
    let scene = asset("letters.glb");
    let mut arguments = vec![scene.as_str()];
    arguments.extend(options.split(' '));
    let mut viewer = Viewer::open(&display, folder.path(), &arguments);
    viewer.wait_for("at rest");
    viewer.show_picture_alone();
    let command = viewer.command();
    for word in ["--target=0,1,0", "50", "--exposure=0.5"] {
        assert!(command.iter().any(|found| found == word), "{word} in {command:?}");
    }
    let ordinary = ["render", &scene, "-o", "ordinary.png"].into_iter();
    let ordinary = ordinary.chain(["--background", "#2b2f36"]).chain(options.split(' '));
    let asked: Vec<_> = ordinary.map(str::to_owned).collect();
    assert_shows(&display, [320, 200], &render(folder.path(), &asked, "ordinary.png"));

    // The eye moves forward while the key is down, then looks to the side.
    viewer.key("f");
    viewer.wait_for("flying");
    let eye = |command: &[String]| {
        let word = command.iter().find_map(|word| word.strip_prefix("--eye="));
        let numbers = word.unwrap().split(',').map(|number| number.parse().unwrap());
        DVec3::from_slice(&numbers.collect::<Vec<f64>>())
    };
    let start = eye(&command);
    // A busy window may receive the press and the release at once.
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
    assert!(moved.normalize().dot(forward) > 0.999, "{moved} is not {forward}");
    viewer.key("Escape");

    // A hidden window is drawn again when it becomes visible. A key that went down meanwhile was meant for another
    // window.
    let window = display.window().to_string();
    display.input(&["windowunmap", "--sync", &window, "keydown", "q"]);
    display.input(&["windowmap", "--sync", &window, "windowfocus", "--sync", &window]);
    display.input(&["mousemove", "600", "400", "keyup", "q"]);
    assert_shows(&display, [320, 200], &render(folder.path(), &flown, "flown.png"));
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
    // The view is unchanged.
    assert_eq!(viewer.command(), command);
    assert_shows(&display, [320, 200], &render(folder.path(), &command, "again.png"));

    // The lens is on the same device: it comes back with the window, whichever of them loses the device.
    loss.once();
    display.input(&["mousemove", "160", "100", "key", "z", "mousemove", "600", "400"]);
    viewer.wait_for("everything is made again");
    viewer.wait_for("shows ");
    viewer.wait_for("at rest");
    let command = viewer.command();
    assert_eq!(command[0], "zoom");
    assert_shows(&display, [320, 200], &render(folder.path(), &command, "zoom.png"));

    loss.always();
    viewer.key("n");
    let status = viewer.ended();
    viewer.read_to_end();
    assert_eq!(status.code(), Some(4), "{:#?}", viewer.said);
    let last = viewer.said.last().unwrap();
    assert_eq!(last, "error: the device was lost; its driver may have reset it");
}

/// Duration of random input in seconds: `GPC_SOAK`, or a few.
fn soak_seconds() -> u64 {
    std::env::var("GPC_SOAK").map_or(20, |text| text.parse().unwrap())
}

/// Random input may cause error notes, but no message of the validation layer, which would end the viewer with an
/// error.
#[test]
fn random_input_does_nothing_forbidden() {
    soak(&[]);
}

/// Random input leaks no memory. The validation layer is off, because it keeps a third of a megabyte for each change
/// of method.
#[test]
fn random_input_leaves_nothing_behind() {
    let memory = soak(&[("GPC_VALIDATION", Path::new(""))]);
    for (second, bytes) in &memory {
        println!("{second} s: {} MiB", bytes >> 20);
    }
    let median = |part: &[(u64, u64)]| {
        let mut bytes: Vec<_> = part.iter().map(|(_, bytes)| bytes >> 20).collect();
        bytes.sort_unstable();
        bytes[bytes.len() / 2]
    };
    let fifth = memory.len() / 5;
    let middle = median(&memory[2 * fifth..3 * fifth]);
    let end = median(&memory[4 * fifth..]);
    // For some minutes kernels are compiled and heaps become fragmented; a leak would go on growing.
    let allowed = if soak_seconds() < 300 { middle } else { 96 };
    assert!(end < middle + allowed, "{middle} MiB became {end} MiB");
}

/// Sends random input, and returns samples of the viewer's memory: seconds and bytes.
fn soak(variables: &[(&str, &Path)]) -> Vec<(u64, u64)> {
    let seconds = soak_seconds();
    let (display, folder) = (Display::open(), tempfile::tempdir().unwrap());
    std::fs::write(folder.path().join("moving.glb"), moving_triangle()).unwrap();
    let render = ["render", &asset("fence.glb"), "-o", "photo.png"];
    let arguments = ["--size", "200x150", "--samples", "1"];
    gpc(folder.path(), &[&render[..], &arguments].concat()).ok();
    let (letters, fence) = (asset("letters.glb"), asset("fence.glb"));
    let scenes = [&letters, "moving.glb", "photo.png", &fence];
    let arguments = [&scenes[..], &["--size", "320x200", "--samples", "64"]].concat();
    let mut viewer = Viewer::open_with(&display, folder.path(), &arguments, variables);
    viewer.wait_for("at rest");
    viewer.command();
    let mut random = Random(1);
    let mut memory = Vec::new();
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(seconds) {
        for _ in 0..20 {
            random_input(&display, &mut random);
        }
        viewer.read();
        memory.push((start.elapsed().as_secs(), viewer.memory_bytes()));
    }
    // Escape leaves any mode that the viewer may be in.
    display.input(&["key", "Escape"]);
    let status = viewer.quit();
    assert!(status.success(), "{status}: {:#?}", viewer.said);
    memory
}

/// Pseudo-random numbers that are the same in every run (Knuth's MMIX).
struct Random(u64);

impl Random {
    fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % end
    }
}

/// Sends a random key, drag, turn of the wheel, or size of the window.
fn random_input(display: &Display, random: &mut Random) {
    const KEYS: &str = "h p Return 1 3 7 9 c f w a s d s n m b plus minus x l z a Delete t u o \
         space bracketleft bracketright Left Right Up Escape";
    let keys: Vec<_> = KEYS.split_whitespace().collect();
    let place = |random: &mut Random| [random.below(320), random.below(200)].map(|v| v.to_string());
    let ([x, y], [to_x, to_y]) = (place(random), place(random));
    match random.below(8) {
        0..4 => display.input(&["key", keys[random.below(keys.len() as u64) as usize]]),
        4..6 => {
            let button = (1 + random.below(3)).to_string();
            let press = ["mousemove", &x, &y, "mousedown", &button];
            let release = ["mousemove", &to_x, &to_y, "mouseup", &button];
            display.input(&[press, release].concat());
        }
        6 => {
            let button = (4 + random.below(2)).to_string();
            display.input(&["mousemove", &x, &y, "click", &button]);
        }
        _ => {
            let side = |random: &mut Random| (80 + 20 * random.below(15)).to_string();
            let (width, height) = (side(random), side(random));
            let search = ["search", "--name", "gpc$", "windowsize"];
            display.input(&[&search[..], &[&width, &height]].concat());
        }
    }
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
    let said = finish(output).exits(3).says(&["gpc render", "DISPLAY"]);
    assert!(!said.stderr.contains(".rs:"), "{}", said.stderr);
}

/// The example's frames fill the window in each size that it gets.
#[test]
fn a_host_shows_its_frames_in_a_window_that_is_resized() {
    let display = Display::open();
    let test = std::env::current_exe().unwrap();
    let profile = test.parent().and_then(Path::parent).unwrap();
    let mut host = Program::start(
        Command::new(profile.join("examples/window"))
            .env("DISPLAY", &display.name)
            .env_remove("WAYLAND_DISPLAY")
            .env("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation"),
    );
    host.wait_for("shows 320 x 180 pixels");
    for size in [["400", "240"], ["200", "300"]] {
        display.input(&[&["search", "--name", "visibility", "windowsize"][..], &size].concat());
        host.wait_for(&format!("shows {} x {} pixels", size[0], size[1]));
        let pixels = display.pixels([200, 240]);
        let colors: std::collections::HashSet<_> = pixels.iter().collect();
        assert!(colors.len() > 200, "{} colours", colors.len());
    }
    display.input(&["search", "--name", "visibility", "windowfocus"]);
    let until = Instant::now() + PATIENCE;
    let line = loop {
        // The window may not have the focus yet.
        display.input(&["key", "Escape"]);
        let soon = Instant::now() + Duration::from_secs(2);
        if let Some(line) = host.wait_until(" frames, ", soon) {
            break line;
        }
        assert!(Instant::now() < until, "the window does not close");
    };
    assert!(line.ends_with(" 0 left over"), "{line}");
    host.ended_well();
    for line in &host.said {
        assert!(!line.contains("Validation"), "{line}");
    }
}
