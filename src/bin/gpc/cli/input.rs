//! Scenes from files and from standard input.

use anyhow::Context;
use gpc::output::{DecodedLight, decode_light};
use gpc::scene::{Environment, Loaded, Scene};
use std::io::Read;
use std::path::Path;

/// Whether a path stands for standard input or output.
pub fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Loads a scene, with the materials of a variant if one is named. `-` stands for standard input, whose relative URIs start from
/// the working folder.
pub fn load(path: &Path, variant: Option<&str>) -> anyhow::Result<Loaded> {
    if !is_standard(path) {
        return Ok(match variant {
            Some(variant) => Scene::load_variant(path, variant)?,
            None => Scene::load(path)?,
        });
    }
    let mut bytes = Vec::new();
    std::io::stdin().lock().read_to_end(&mut bytes).context("standard input can't be read")?;
    let (name, base) = ("standard input", Some(Path::new(".")));
    Ok(match variant {
        Some(variant) => Scene::variant_from_slice(&bytes, name, base, variant)?,
        None => Scene::from_slice(&bytes, name, base)?,
    })
}

/// Reads an equirectangular image as an environment. Returns warnings too.
pub fn environment(path: &Path) -> anyhow::Result<(Environment, Vec<String>)> {
    let file = path.display();
    let bytes = std::fs::read(path).with_context(|| format!("{file} can't be read"))?;
    let DecodedLight { size: [width, height], colors, warnings } = decode_light(&bytes, &file.to_string())?;
    let environment = Environment::from_equirectangular(width, height, colors)
        .with_context(|| format!("{file} is no environment"))?;
    Ok((environment, warnings))
}

/// The scene's name for output files: its file's name without the extension.
pub fn stem(path: &Path) -> String {
    if is_standard(path) {
        return "stdin".to_owned();
    }
    path.file_stem().map_or_else(|| "scene".to_owned(), |stem| stem.to_string_lossy().into_owned())
}
