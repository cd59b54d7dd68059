//! Names of output files with placeholders.

use crate::cli::exit::Usage;
use std::path::{Path, PathBuf};

/// Values of the placeholders `{stem}`, `{camera}` and `{frame}`.
pub struct Fields<'a> {
    pub stem: &'a str,
    pub camera: &'a str,
    pub frame: u32,
}

const KNOWN: [&str; 3] = ["stem", "camera", "frame"];

/// OUT with its placeholders checked.
pub struct Template(String);

impl Template {
    /// Checks the placeholders in the path of an output file.
    pub fn new(path: &Path) -> Result<Self, Usage> {
        let Some(text) = path.to_str() else {
            return Err(Usage(format!("-o {}: it is not UTF-8", path.display())));
        };
        let mut rest = text;
        while let Some((_, after)) = rest.split_once('{') {
            let Some((field, after)) = after.split_once('}') else {
                return Err(Usage(format!("-o {text}: a {{ without a }}")));
            };
            if !KNOWN.contains(&field) {
                return Err(Usage(format!(
                    "-o {text}: there is no field {{{field}}}; there are {{stem}}, {{camera}} and {{frame}}"
                )));
            }
            rest = after;
        }
        Ok(Self(text.to_owned()))
    }

    /// Refuses a name without the placeholder `field` if there are several images to write.
    pub fn require(&self, field: &str, what: &str, count: usize) -> Result<(), Usage> {
        let placeholder = format!("{{{field}}}");
        if count <= 1 || self.0.contains(&placeholder) {
            return Ok(());
        }
        Err(Usage(if self.0 == "-" {
            format!(
                "-o -: standard output takes one image, not {count} {what}; with --format y4m or raw it takes frames"
            )
        } else {
            format!("-o {}: add {placeholder} to it, for there are {count} {what}", self.0)
        }))
    }

    /// The path of one image. Braces in a value are kept.
    pub fn fill(&self, fields: &Fields<'_>) -> PathBuf {
        let frame = format!("{:04}", fields.frame);
        let mut name = String::new();
        let mut rest = self.0.as_str();
        while let Some((before, after)) = rest.split_once('{') {
            name.push_str(before);
            let (field, after) = after.split_once('}').unwrap_or((after, ""));
            name.push_str(match field {
                "stem" => fields.stem,
                "camera" => fields.camera,
                _ => &frame,
            });
            rest = after;
        }
        name.push_str(rest);
        PathBuf::from(name)
    }
}

/// A name from a scene as part of a file name: characters that folders, drives or shells interpret become `_`.
pub fn file_name_part(name: &str) -> String {
    let safe = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '.' | ' ' | '+');
    let part: String = name.chars().map(|c| if safe(c) { c } else { '_' }).collect();
    match part.trim_matches(['.', ' ']) {
        "" => "_".to_owned(),
        trimmed => trimmed.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn template(text: &str) -> Template {
        Template::new(Path::new(text)).unwrap()
    }

    #[test]
    fn fields_are_filled_in() {
        let fields = Fields { stem: "a{frame}", camera: "top", frame: 7 };
        let name = template("o/{stem}-{camera}.{frame}.png").fill(&fields);
        assert_eq!(name, Path::new("o/a{frame}-top.0007.png"));
        let frame = 12_345;
        let name = template("{frame}").fill(&Fields { frame, ..fields });
        assert_eq!(name, Path::new("12345"));
    }

    #[test]
    fn names_stay_in_their_folder() {
        assert_eq!(file_name_part("../../etc/passwd"), "_.._etc_passwd");
        assert_eq!(file_name_part(".."), "_");
        assert_eq!(file_name_part("Kamera 1 süd"), "Kamera 1 süd");
    }
}
