//! Advice on wrong command lines.

use crate::scene_files::is_scene;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use gpc::output::Format;
use std::path::Path;

/// A usage error, with a tip where the command line shows what was meant.
pub fn explained(mut error: clap::Error) -> clap::Error {
    if let Some(tip) = tip(&error) {
        let tips = vec![StyledStr::from(tip)];
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(tips));
    }
    error
}

fn tip(error: &clap::Error) -> Option<String> {
    let word = |kind| match error.get(kind) {
        Some(ContextValue::String(word)) => Some(word.as_str()),
        _ => None,
    };
    match error.kind() {
        ErrorKind::InvalidSubcommand => match word(ContextKind::InvalidSubcommand)? {
            scene if is_scene(Path::new(scene)) => Some(format!("to render a scene: gpc render {scene} -o image.png")),
            "view" if cfg!(not(feature = "view")) => Some(
                "this gpc was built without its window; in the repository: cargo install --path . --features view"
                    .to_owned(),
            ),
            _ => None,
        },
        ErrorKind::UnknownArgument => {
            let image = word(ContextKind::InvalidArg)?;
            Format::of(Path::new(image)).ok()?;
            Some(format!("to write an image: -o {image}"))
        }
        _ => None,
    }
}
