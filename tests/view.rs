//! The window on a display of its own, with real input. Needs Xvfb and xdotool, and fails without them.

#[allow(dead_code, reason = "other tests use the rest")]
mod cli_support;
mod scene_builder;

use cli_support::{asset, finish, gpc};
use scene_builder::Builder;
use serde_json::json;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Generous: a software driver under validation, on a machine that may be busy.
const PATIENCE: Duration = Duration::from_secs(180);
/// Longer than anything is said in the window.
const NOTES_SEEN: Duration = Duration::from_secs(8);

/// A display without a screen.
struct Display {
    server: Child,
    name: String,
    folder: TempDir,
}

impl Display {
    const SIZE: [usize; 2] = [640, 480];

    fn open() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut server = Command::new("Xvfb")
            .args([
                "-displayfd",
                "1",
                "-screen",
                "0",
                "640x480x24",
                "-nolisten",
                "tcp",
                "-fbdir",
            ])
            .arg(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb can't be started");
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap())
            .read_line(&mut number)
            .unwrap();
        assert!(!number.trim().is_empty(), "Xvfb opened no display");
        Self {
            server,
            name: format!(":{}", number.trim()),
            folder,
        }
    }

    /// Sends input.
    fn input(&self, arguments: &[&str]) {
        let status = Command::new("xdotool")
            .args(arguments)
            .env("DISPLAY", &self.name)
            .stdout(Stdio::null())
            .status()
            .expect("xdotool can't be started");
        assert!(status.success(), "xdotool {arguments:?}: {status}");
    }

    /// Colours of the screen's upper left part.
    fn pixels(&self, [width, height]: [usize; 2]) -> Vec<[u8; 3]> {
        // An XWD file: a header of big-endian words, a colour map, and rows of BGRX.
        let bytes = std::fs::read(self.folder.path().join("Xvfb_screen0")).unwrap();
        let word = |index: usize| {
            let word = bytes[4 * index..4 * index + 4].try_into().unwrap();
            u32::from_be_bytes(word) as usize
        };
        let (header, row, colors) = (word(0), word(12), word(19));
        assert_eq!([word(4), word(5)], Self::SIZE);
        let start = header + 12 * colors;
        let pixel = |x: usize, y: usize| {
            let at = start + y * row + 4 * x;
            [bytes[at + 2], bytes[at + 1], bytes[at]]
        };
        (0..height)
            .flat_map(|y| (0..width).map(move |x| pixel(x, y)))
            .collect()
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// The viewer, and what it says.
struct Viewer<'a> {
    display: &'a Display,
    process: Child,
    lines: Receiver<String>,
    said: Vec<String>,
}

impl<'a> Viewer<'a> {
    /// Opens scenes in a window, and waits for that.
    fn open(display: &'a Display, folder: &Path, arguments: &[&str]) -> Self {
        let mut process = Command::new(env!("CARGO_BIN_EXE_gpc"))
            .arg("view")
            .args(arguments)
            .current_dir(folder)
            .env("DISPLAY", &display.name)
            .env_remove("WAYLAND_DISPLAY")
            .env("GPC_VALIDATION", "1")
            .env("RUST_LOG", "gpc=debug")
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let (sender, lines) = channel();
        let errors = BufReader::new(process.stderr.take().unwrap());
        std::thread::spawn(move || {
            errors
                .lines()
                .map_while(Result::ok)
                .try_for_each(|line| sender.send(line))
        });
        let viewer = Self {
            display,
            process,
            lines,
            said: Vec::new(),
        };
        display.input(&["search", "--sync", "--name", "gpc$", "windowfocus"]);
        viewer
    }

    /// The next line that holds a text.
    fn wait_for(&mut self, text: &str) -> String {
        let until = Instant::now() + PATIENCE;
        self.wait_until(text, until)
            .unwrap_or_else(|| panic!("no line with {text:?} came after {:#?}", self.said))
    }

    fn wait_until(&mut self, text: &str, until: Instant) -> Option<String> {
        loop {
            let left = until.saturating_duration_since(Instant::now());
            match self.lines.recv_timeout(left) {
                Ok(line) => {
                    self.said.push(line.clone());
                    if line.contains(text) {
                        return Some(line);
                    }
                }
                Err(RecvTimeoutError::Timeout) => return None,
                Err(RecvTimeoutError::Disconnected) => {
                    panic!("the viewer ended, having said {:#?}", self.said)
                }
            }
        }
    }

    fn key(&self, key: &str) {
        self.display.input(&["key", key]);
    }

    /// Drags with a button from the window's middle.
    fn drag(&self, button: &str, to: [&str; 2]) {
        self.display.input(&[
            "mousemove",
            "160",
            "100",
            "mousedown",
            button,
            "mousemove",
            "170",
            "104",
            "mousemove",
            to[0],
            to[1],
            "mouseup",
            button,
        ]);
    }

    /// Hides the panel, once the window takes keys, and waits until nothing else lies over the picture.
    fn show_picture_alone(&mut self) {
        self.command();
        self.key("p");
        std::thread::sleep(NOTES_SEEN);
    }

    /// The `gpc render` command that makes the picture, by its arguments.
    fn command(&mut self) -> Vec<String> {
        let until = Instant::now() + PATIENCE;
        loop {
            // The window may not have the focus yet.
            self.key("ctrl+c");
            let soon = Instant::now() + Duration::from_secs(3);
            if let Some(line) = self.wait_until("copied: gpc ", soon) {
                let (_, command) = line.split_once("copied: gpc ").unwrap();
                return command
                    .split(' ')
                    .map(|word| word.trim_matches('\'').to_owned())
                    .collect();
            }
            assert!(
                Instant::now() < until,
                "the window takes no keys: {:#?}",
                self.said
            );
        }
    }

    /// Closes the window, and checks that nothing was complained of.
    fn close(mut self) {
        self.key("q");
        let status = self.process.wait().unwrap();
        self.said.extend(self.lines.try_iter());
        assert!(status.success(), "{status}: {:#?}", self.said);
        for line in &self.said {
            assert!(!line.starts_with("error"), "{line}");
        }
    }
}

impl Drop for Viewer<'_> {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

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
    viewer.key("q");
    assert!(viewer.process.wait().unwrap().success());
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
    let until = Instant::now() + PATIENCE;
    while viewer
        .wait_until("shows ", Instant::now() + Duration::from_secs(3))
        .is_none()
    {
        assert!(Instant::now() < until, "the window takes no keys");
        viewer.key("Right");
    }
    viewer.wait_for("at rest");
    viewer.key("q");
    assert!(viewer.process.wait().unwrap().success());
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
