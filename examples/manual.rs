//! Writes the manual pages of the command, and completions for shells.
//!
//! ```text
//! cargo run --release --features view --example manual FOLDER
//! ```
//!
//! FOLDER then has `man1/` and `completions/`.

#[path = "common/arguments.rs"]
mod arguments;
#[path = "../src/bin/gpc/cli/mod.rs"]
#[allow(dead_code, unused_imports, reason = "only the options are wanted")]
mod cli;
#[path = "../src/bin/gpc/scene_files.rs"]
mod scene_files;
#[cfg(feature = "view")]
#[path = "../src/bin/gpc/view/mod.rs"]
#[allow(dead_code, unused_imports, reason = "only the options are wanted")]
mod view;

use clap::CommandFactory;
use clap_complete::Shell;
use std::fs;
use std::path::PathBuf;

fn main() -> std::io::Result<()> {
    let [folder] = arguments::paths("manual FOLDER");
    let folder = folder.unwrap_or_else(|| PathBuf::from("out/manual"));
    let (man, completions) = (folder.join("man1"), folder.join("completions"));
    fs::create_dir_all(&man)?;
    fs::create_dir_all(&completions)?;
    clap_mangen::generate_to(cli::Cli::command(), &man)?;
    for shell in [Shell::Bash, Shell::Fish, Shell::Zsh] {
        clap_complete::generate_to(shell, &mut cli::Cli::command(), "gpc", &completions)?;
    }
    Ok(())
}
