//! Two monitors of different density on Wayland: sway without a screen, and grim. Fails without them.

use super::PATIENCE;
use super::program::Program;
use std::os::unix::fs::{MetadataExt, chown};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Configuration of sway: two outputs, and windows that stay where they are put.
const CONFIG: &str = "\
output HEADLESS-1 mode 640x480 position 0 0 scale 1
output HEADLESS-2 mode 1280x960 position 640 0 scale 2
default_border none
for_window [title=\".*\"] floating enable
";
/// User ID without rights: sway refuses to run as root.
const NOBODY: u32 = 65534;

/// One of the two monitors.
#[derive(Clone, Copy, Debug)]
pub enum Monitor {
    /// Left monitor, 640 x 480 pixels.
    Left,
    /// Right monitor, 1280 x 960 pixels, with the same apparent size.
    Right,
}

/// Two monitors side by side.
pub struct Monitors {
    server: Child,
    folder: TempDir,
}

impl Monitors {
    pub fn open() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let config = folder.path().join("config");
        std::fs::write(&config, CONFIG).unwrap();
        let mut command = if folder.path().metadata().unwrap().uid() == 0 {
            chown(folder.path(), Some(NOBODY), Some(NOBODY)).unwrap();
            let mut command = Command::new("setpriv");
            command.args([
                format!("--reuid={NOBODY}"),
                format!("--regid={NOBODY}"),
                "--clear-groups".to_owned(),
                "sway".to_owned(),
            ]);
            command
        } else {
            Command::new("sway")
        };
        let server = command
            .arg("-c")
            .arg(config)
            .env("XDG_RUNTIME_DIR", folder.path())
            .env("SWAYSOCK", folder.path().join("sway"))
            .env("WLR_BACKENDS", "headless")
            .env("WLR_HEADLESS_OUTPUTS", "2")
            .env("WLR_RENDERER", "pixman")
            .env("WLR_LIBINPUT_NO_DEVICES", "1")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("sway can't be started");
        let monitors = Self { server, folder };
        let until = Instant::now() + PATIENCE;
        while !["sway", "wayland-1"].iter().all(|socket| monitors.folder.path().join(socket).exists()) {
            assert!(Instant::now() < until, "sway opens no display");
            std::thread::sleep(Duration::from_millis(50));
        }
        monitors
    }

    /// Starts a program that opens its windows on these monitors.
    pub fn start(&self, command: &mut Command) -> Program {
        Program::start(self.on(command).env_remove("DISPLAY"))
    }

    /// Sends a command to sway until it succeeds, because a window may not exist yet.
    pub fn order(&self, order: &str) {
        let until = Instant::now() + PATIENCE;
        loop {
            let mut command = Command::new("swaymsg");
            let command = command.args(["--quiet", order]).env("SWAYSOCK", self.folder.path().join("sway"));
            let done = command.status().expect("swaymsg can't be started");
            if done.success() {
                return;
            }
            assert!(Instant::now() < until, "sway refuses {order:?}");
            std::thread::sleep(Duration::from_millis(100));
        }
    }

    /// Screenshot of a monitor.
    pub fn picture(&self, monitor: Monitor) -> image::RgbImage {
        let name = match monitor {
            Monitor::Left => "HEADLESS-1",
            Monitor::Right => "HEADLESS-2",
        };
        let mut command = Command::new("grim");
        let grabbed = self.on(command.args(["-o", name, "-"])).output();
        let grabbed = grabbed.expect("grim can't be started");
        assert!(grabbed.status.success(), "{grabbed:?}");
        image::load_from_memory(&grabbed.stdout).unwrap().to_rgb8()
    }

    fn on<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        command.env("XDG_RUNTIME_DIR", self.folder.path()).env("WAYLAND_DISPLAY", "wayland-1")
    }
}

impl Drop for Monitors {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
