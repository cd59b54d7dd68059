//! Writing an image and its AOVs to files.

use crate::cli::exit::Usage;
use crate::cli::{input, print};
use gpc::names::name;
use gpc::output::{self, Aov, AovKind, Format, Picture};
use gpc::render::Rendered;
use std::path::{Path, PathBuf};

/// Writes an image to a file, or to standard output for `-`. Its AOVs become files in the same folder, unless the
/// format has layers.
pub fn save(path: &Path, format: Format, rendered: &Rendered, kinds: &[AovKind]) -> anyhow::Result<()> {
    let bytes = encode(path, format, rendered, kinds)?;
    write(path, &bytes)
}

/// Writes an image that the device has encoded as codes of 8 bits to a PNG file, or to standard output for `-`. Its AOVs become
/// files in the same folder.
pub fn save_codes(path: &Path, rendered: &Rendered<[u8; 4]>, kinds: &[AovKind]) -> anyhow::Result<()> {
    let bytes = output::encode_rgba(rendered.size, &rendered.colors)?;
    save_aovs(path, Format::Png8, rendered, &aovs(rendered, kinds))?;
    write(path, &bytes)
}

/// Encodes an image. AOVs for which the format has no layers are written to files in the same folder.
pub fn encode(path: &Path, format: Format, rendered: &Rendered, kinds: &[AovKind]) -> anyhow::Result<Vec<u8>> {
    let picture = Picture::new(rendered.size, &rendered.colors)?;
    let aovs = aovs(rendered, kinds);
    let bytes = output::encode(format, &picture, &aovs)?;
    if format != Format::Exr {
        save_aovs(path, format, rendered, &aovs)?;
    }
    Ok(bytes)
}

fn aovs<P>(rendered: &Rendered<P>, kinds: &[AovKind]) -> Vec<Aov> {
    let kinds = kinds.iter();
    kinds.map(|kind| Aov::from_attributes(*kind, &rendered.attributes)).collect()
}

/// Writes AOVs to files in the folder of the image at `path`.
fn save_aovs<P>(path: &Path, format: Format, rendered: &Rendered<P>, aovs: &[Aov]) -> anyhow::Result<()> {
    for aov in aovs {
        let bytes = output::encode_aov(rendered.size, aov)?;
        output::write_atomically(&beside(path, format, &name(&aov.kind())), &bytes)?;
    }
    Ok(())
}

/// Writes bytes to a file, or to standard output for `-`.
pub fn write(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    if input::is_standard(path) {
        return print::bytes(bytes);
    }
    Ok(output::write_atomically(path, bytes)?)
}

/// Format of an output file, or of standard output for `-`. Fails if the file's folder does not exist.
pub fn format_of(path: &Path) -> anyhow::Result<Format> {
    if input::is_standard(path) {
        return Ok(Format::Png8);
    }
    let format = Format::of(path).map_err(|error| Usage(format!("-o {error}")))?;
    check_folder(path)?;
    Ok(format)
}

/// Fails if the folder of an output file does not exist, before work is done for that file. A folder whose name has
/// placeholders is not checked.
pub fn check_folder(path: &Path) -> anyhow::Result<()> {
    let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) else {
        return Ok(());
    };
    if !folder.is_dir() && !folder.to_string_lossy().contains('{') {
        anyhow::bail!("-o {}: there is no folder {}", path.display(), folder.display());
    }
    Ok(())
}

/// Path of a file beside the image that holds something else, such as depth: `a.depth.png` for `a.png`, `a.16.png` and
/// `a.jpg`.
pub fn beside(path: &Path, format: Format, holds: &str) -> PathBuf {
    let mut stem = path.with_extension("");
    if format == Format::Png16 {
        stem.set_extension("");
    }
    let mut name = stem.into_os_string();
    name.push(format!(".{holds}.png"));
    PathBuf::from(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn aovs_are_named_after_the_image() {
        let name = |path: &str| {
            let path = Path::new(path);
            beside(path, Format::of(path).unwrap(), "id")
        };
        assert_eq!(name("o/a.b.png"), Path::new("o/a.b.id.png"));
        assert_eq!(name("a.16.png"), Path::new("a.id.png"));
        assert_eq!(name("a.jpeg"), Path::new("a.id.png"));
    }
}
