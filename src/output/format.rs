//! Image formats and the endings of their file names.

use super::UnknownFormat;
use std::path::Path;

/// Format of a written image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// PNG, 8 bits a channel.
    Png8,
    /// PNG, 16 bits a channel.
    Png16,
    /// JPEG, 8 bits a channel, without alpha.
    Jpeg,
    /// OpenEXR, 32-bit floats.
    Exr,
}

impl Format {
    /// Format of a file by the ending of its name, in upper or lower case.
    ///
    /// # Errors
    /// [`UnknownFormat`], whose message lists the endings.
    pub fn of(path: &Path) -> Result<Self, UnknownFormat> {
        let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().to_ascii_lowercase());
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

    /// Whether files of this format hold scene-linear light; the others hold sRGB colours.
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
}
