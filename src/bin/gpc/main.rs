//! The `gpc` command.

mod cli;
mod scene_files;
#[cfg(feature = "view")]
mod view;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}
