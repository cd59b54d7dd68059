//! File formats by name.

use super::UnknownFormat;
use std::path::Path;

/// A format that images are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// PNG with 8 bits a channel.
    Png8,
    /// PNG with 16 bits a channel.
    Png16,
    /// JPEG.
    Jpeg,
    /// OpenEXR with 32-bit floats.
    Exr,
}

impl Format {
    /// The format that a file's name asks for; upper and lower case are the same.
    ///
    /// # Errors
    /// [`UnknownFormat`] lists the endings that are known.
    pub fn of(path: &Path) -> Result<Self, UnknownFormat> {
        let name = path.file_name().map_or_else(String::new, |name| {
            name.to_string_lossy().to_ascii_lowercase()
        });
        let endings = [
            (".16.png", Self::Png16),
            (".png", Self::Png8),
            (".jpg", Self::Jpeg),
            (".jpeg", Self::Jpeg),
            (".exr", Self::Exr),
        ];
        endings
            .into_iter()
            .find(|(ending, _)| name.ends_with(ending))
            .map(|(_, format)| format)
            .ok_or_else(|| UnknownFormat(path.to_path_buf()))
    }

    /// Whether it holds scene-linear light rather than colours for a display.
    #[must_use]
    pub fn is_scene_linear(self) -> bool {
        self == Self::Exr
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_decide() {
        let of = |name: &str| Format::of(Path::new(name)).ok();
        assert_eq!(of("a.png"), Some(Format::Png8));
        assert_eq!(of("dir.exr/a.16.PNG"), Some(Format::Png16));
        assert_eq!(of("a.JPEG"), Some(Format::Jpeg));
        assert_eq!(of("a.b.exr"), Some(Format::Exr));
        assert_eq!(of("a.tiff"), None);
        assert_eq!(of("png"), None);
    }

    #[test]
    fn an_unknown_ending_is_told_the_known_ones() {
        let message = Format::of(Path::new("a.tga")).unwrap_err().to_string();
        for ending in [".png", ".16.png", ".jpg", ".jpeg", ".exr"] {
            assert!(message.contains(ending), "{message}");
        }
    }
}
