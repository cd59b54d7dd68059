//! Help texts of the command.

use std::process::Command;

/// Subcommands that `gpc --help` lists, without `help` and those of the feature `view`.
fn subcommands() -> Vec<String> {
    let help = help(&["--help"]);
    let (_, list) = help.split_once("Commands:\n").unwrap();
    let lines = list.lines().take_while(|line| !line.trim().is_empty());
    lines
        .filter_map(|line| line.split_whitespace().next())
        .filter(|name| !["help", "view"].contains(name))
        .map(str::to_owned)
        .collect()
}

/// Help texts of all subcommands, each under its own heading.
pub fn every() -> String {
    let mut text = String::new();
    for name in subcommands() {
        text += &format!("## gpc {name}\n\n```text\n{}\n```\n\n", help(&[&name, "--help"]).trim_end());
    }
    text
}

/// Output of the command.
pub fn help(arguments: &[&str]) -> String {
    let run = Command::new(env!("CARGO_BIN_EXE_gpc")).args(arguments).env_remove("COLUMNS").output().unwrap();
    assert!(run.status.success(), "gpc {arguments:?}");
    let text = String::from_utf8(run.stdout).unwrap();
    let lines: Vec<_> = text.lines().map(str::trim_end).collect();
    lines.join("\n") + "\n"
}
