//! Machine and date of a benchmark.

use chrono::Utc;
use serde::Serialize;

/// The machine, as far as the system describes it.
#[derive(Serialize)]
pub struct Machine {
    /// Model of the processor, or its architecture if the system names no model.
    pub cpu: String,
    /// Hardware threads that this process may use.
    pub threads: usize,
    pub os: String,
}

impl Machine {
    pub fn this() -> Self {
        Self {
            cpu: value_in("/proc/cpuinfo", "model name", ':').unwrap_or_else(|| std::env::consts::ARCH.to_owned()),
            threads: std::thread::available_parallelism().map_or(1, usize::from),
            os: value_in("/etc/os-release", "PRETTY_NAME", '=').unwrap_or_else(|| std::env::consts::OS.to_owned()),
        }
    }
}

/// The first value of a key in a text file with one key and value in each line.
fn value_in(file: &str, key: &str, separator: char) -> Option<String> {
    let text = std::fs::read_to_string(file).ok()?;
    let mut pairs = text.lines().filter_map(|line| line.split_once(separator));
    let (_, value) = pairs.find(|(found, _)| found.trim() == key)?;
    Some(value.trim().trim_matches('"').to_owned())
}

/// Today's date in universal time: `YYYY-MM-DD`.
pub fn today() -> String {
    Utc::now().format("%Y-%m-%d").to_string()
}
