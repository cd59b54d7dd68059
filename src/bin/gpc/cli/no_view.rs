//! What takes the place of `gpc view` in a command that was built without its window.

use clap::Subcommand;
use std::error::Error;
use std::process::ExitCode;

/// The window has no subcommand.
#[derive(Subcommand)]
pub enum Command {}

/// Whether an error says that there is no display for the window.
pub fn is_no_display(_: &(dyn Error + 'static)) -> bool {
    false
}

/// Advice on an unknown subcommand that the window would have.
pub fn tip(subcommand: &str) -> Option<&'static str> {
    (subcommand == "view")
        .then_some("this gpc was built without its window; in the repository: cargo install --path . --features view")
}

pub fn run(command: Command) -> anyhow::Result<ExitCode> {
    match command {}
}
