//! The `gpc` command.

mod cli;
#[cfg(feature = "view")]
mod view;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}
