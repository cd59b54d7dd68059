//! A program with a window, and its messages.

use super::PATIENCE;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// A program that is killed when this is dropped.
pub struct Program {
    process: Child,
    lines: Receiver<String>,
    /// Lines of standard error that have been read.
    pub said: Vec<String>,
}

impl Program {
    /// Command `gpc view` with all log messages, under the validation layer.
    pub fn viewer(folder: &Path, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_gpc"));
        command.arg("view").args(arguments).current_dir(folder).env("GPC_VALIDATION", "1").env("RUST_LOG", "gpc=debug");
        command
    }

    pub fn start(command: &mut Command) -> Self {
        let mut process = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let (sender, lines) = channel();
        let errors = BufReader::new(process.stderr.take().unwrap());
        std::thread::spawn(move || errors.lines().map_while(Result::ok).try_for_each(|line| sender.send(line)));
        Self { process, lines, said: Vec::new() }
    }

    /// Waits for the next line that contains a text, and returns it.
    pub fn wait_for(&mut self, text: &str) -> String {
        let until = Instant::now() + PATIENCE;
        self.wait_until(text, until).unwrap_or_else(|| panic!("no line with {text:?} came after {:#?}", self.said))
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
                    panic!("the program ended, having said {:#?}", self.said)
                }
            }
        }
    }

    /// Reads all remaining lines, once the program has ended.
    pub fn read_to_end(&mut self) {
        self.said.extend(self.lines.iter());
    }

    /// Reads the lines that have arrived.
    pub fn read(&mut self) {
        self.said.extend(self.lines.try_iter());
    }

    /// Number of bytes of main memory that the program uses.
    pub fn memory_bytes(&self) -> u64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.process.id()));
        let status = status.expect("the program has ended");
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
            assert!(Instant::now() < until, "the program does not end");
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// Waits until the program ends, and asserts that it succeeded without error messages.
    pub fn ended_well(&mut self) {
        let status = self.ended();
        self.read_to_end();
        assert!(status.success(), "{status}: {:#?}", self.said);
        for line in &self.said {
            assert!(!line.starts_with("error"), "{line}");
        }
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
