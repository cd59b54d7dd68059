//! The viewer in a window, and what it says.

use super::PATIENCE;
use super::display::Display;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// The viewer, and what it says.
pub struct Viewer<'a> {
    display: &'a Display,
    process: Child,
    lines: Receiver<String>,
    pub said: Vec<String>,
}

impl<'a> Viewer<'a> {
    /// Opens scenes in a window, and waits for that.
    pub fn open(display: &'a Display, folder: &Path, arguments: &[&str]) -> Self {
        Self::open_with(display, folder, arguments, &[])
    }

    /// The same with variables of the environment.
    pub fn open_with(
        display: &'a Display,
        folder: &Path,
        arguments: &[&str],
        variables: &[(&str, &Path)],
    ) -> Self {
        let mut process = Command::new(env!("CARGO_BIN_EXE_gpc"))
            .arg("view")
            .args(arguments)
            .current_dir(folder)
            .env("DISPLAY", &display.name)
            .env_remove("WAYLAND_DISPLAY")
            .env("GPC_VALIDATION", "1")
            .env("RUST_LOG", "gpc=debug")
            .envs(variables.iter().copied())
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
    pub fn wait_for(&mut self, text: &str) -> String {
        let until = Instant::now() + PATIENCE;
        self.wait_until(text, until)
            .unwrap_or_else(|| panic!("no line with {text:?} came after {:#?}", self.said))
    }

    pub fn wait_until(&mut self, text: &str, until: Instant) -> Option<String> {
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

    /// Says something that has an effect, again and again until a line holds a text: a window may not be ready for it.
    pub fn repeat_until(&mut self, text: &str, mut act: impl FnMut(&Display)) -> String {
        let until = Instant::now() + PATIENCE;
        loop {
            act(self.display);
            let soon = Instant::now() + Duration::from_secs(3);
            if let Some(line) = self.wait_until(text, soon) {
                return line;
            }
            assert!(
                Instant::now() < until,
                "no line with {text:?} came after {:#?}",
                self.said
            );
        }
    }

    pub fn key(&self, key: &str) {
        self.display.input(&["key", key]);
    }

    /// Drags with a button from the window's middle.
    pub fn drag(&self, button: &str, to: [&str; 2]) {
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

    /// Waits until the window has the focus, and takes keys: then it answers when asked for a command.
    pub fn focus(&mut self, answer: &str) {
        self.repeat_until(answer, |display| display.input(&["key", "ctrl+c"]));
    }

    /// Hides the panel.
    pub fn show_picture_alone(&mut self) {
        self.focus("copied: ");
        self.key("p");
    }

    /// The `gpc render` command that makes the picture, by its arguments.
    pub fn command(&mut self) -> Vec<String> {
        // The window may not have the focus yet.
        let line = self.repeat_until("copied: gpc ", |display| display.input(&["key", "ctrl+c"]));
        let (_, command) = line.split_once("copied: gpc ").unwrap();
        let words = command.split(' ');
        words
            .map(|word| word.trim_matches('\'').to_owned())
            .collect()
    }

    /// Closes the window, and waits for that.
    pub fn quit(&mut self) -> ExitStatus {
        self.key("q");
        self.ended()
    }

    /// Takes all that it has said and was not waited for, once it has ended.
    pub fn read_to_end(&mut self) {
        self.said.extend(self.lines.iter());
    }

    /// Takes what it has said since.
    pub fn read(&mut self) {
        self.said.extend(self.lines.try_iter());
    }

    /// Main memory that it uses.
    pub fn memory_bytes(&self) -> u64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.process.id()));
        let status = status.expect("the viewer has ended");
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
        let number = line.and_then(|line| line.split_whitespace().next());
        1024 * number.unwrap().parse::<u64>().unwrap()
    }

    /// Waits until the program ends.
    pub fn ended(&mut self) -> ExitStatus {
        let until = Instant::now() + PATIENCE;
        loop {
            if let Some(status) = self.process.try_wait().unwrap() {
                return status;
            }
            assert!(Instant::now() < until, "the window does not close");
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// Closes the window, and checks that nothing was complained of.
    pub fn close(mut self) {
        let status = self.quit();
        self.read_to_end();
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
