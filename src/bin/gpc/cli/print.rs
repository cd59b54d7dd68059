//! Printing to standard output, and labels of messages. Unlike `println!`, what prints returns an error if the pipe is closed.

use clap::builder::styling::AnsiColor;
use serde::Serialize;
use std::io::{IsTerminal, Write};

/// Prints a value as indented JSON.
pub fn json(value: &impl Serialize) -> anyhow::Result<()> {
    let text = serde_json::to_string_pretty(value)?;
    line(&text)
}

/// Prints a line.
pub fn line(text: &str) -> anyhow::Result<()> {
    writeln!(std::io::stdout(), "{text}")?;
    Ok(())
}

/// A label before a message on standard error: in colour on a terminal, unless `NO_COLOR` is set.
pub fn label(word: &str, color: AnsiColor) -> String {
    let is_plain = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    if is_plain || !std::io::stderr().is_terminal() {
        return format!("{word}:");
    }
    let style = color.on_default().bold();
    format!("{style}{word}:{style:#}")
}

/// Writes bytes unchanged.
pub fn bytes(bytes: &[u8]) -> anyhow::Result<()> {
    let mut out = std::io::stdout().lock();
    out.write_all(bytes)?;
    out.flush()?;
    Ok(())
}
