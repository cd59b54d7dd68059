//! Displays without a screen: Xvfb, with input by xdotool. Fails without them.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use tempfile::TempDir;

/// A display without a screen.
pub struct Display {
    server: Child,
    pub name: String,
    folder: TempDir,
}

impl Display {
    const SIZE: [usize; 2] = [640, 480];

    pub fn open() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "640x480x24", "-noreset", "-nolisten", "tcp", "-fbdir"])
            .arg(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb can't be started");
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        assert!(!number.trim().is_empty(), "Xvfb opened no display");
        Self { server, name: format!(":{}", number.trim()), folder }
    }

    /// Sends input with xdotool.
    pub fn input(&self, arguments: &[&str]) {
        let status = Command::new("xdotool")
            .args(arguments)
            .env("DISPLAY", &self.name)
            .stdout(Stdio::null())
            .status()
            .expect("xdotool can't be started");
        assert!(status.success(), "xdotool {arguments:?}: {status}");
    }

    /// Number of the viewer's window.
    pub fn window(&self) -> u32 {
        let found = Command::new("xdotool")
            .args(["search", "--name", "gpc$"])
            .env("DISPLAY", &self.name)
            .output()
            .expect("xdotool can't be started");
        let text = String::from_utf8(found.stdout).unwrap();
        let number = text.lines().next().expect("there is no window");
        number.parse().unwrap()
    }

    /// Colours of the upper left part of the screen.
    pub fn pixels(&self, [width, height]: [usize; 2]) -> Vec<[u8; 3]> {
        // The file is in XWD format: a header of big-endian words, a colour map, and rows of BGRX.
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
        (0..height).flat_map(|y| (0..width).map(move |x| pixel(x, y))).collect()
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
