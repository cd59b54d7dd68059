//! Names of output files with placeholders.

use crate::cli::exit::Usage;
use std::path::{Path, PathBuf};

/// OUT with its placeholders checked: fields in braces.
pub struct Template(String);

impl Template {
    /// Checks the placeholders in the path of an output file, which are some of `fields`.
    pub fn new(path: &Path, fields: &[&str]) -> Result<Self, Usage> {
        let Some(text) = path.to_str() else {
            return Err(Usage(format!("-o {}: it is not UTF-8", path.display())));
        };
        let mut rest = text;
        while let Some((_, after)) = rest.split_once('{') {
            let Some((field, after)) = after.split_once('}') else {
                return Err(Usage(format!("-o {text}: a {{ without a }}")));
            };
            if !fields.contains(&field) {
                let known: Vec<_> = fields.iter().map(|field| format!("{{{field}}}")).collect();
                let known = known.join(", ");
                return Err(Usage(format!("-o {text}: there is no field {{{field}}}; what there is: {known}")));
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
        Err(Usage(match (self.0.as_str(), field) {
            ("-", "frame") => format!(
                "-o -: standard output takes one image, not {count} {what}; with --format y4m or raw it takes frames"
            ),
            ("-", _) => format!("-o -: standard output takes one image, and there are {count} {what}"),
            (name, _) => format!("-o {name}: add {placeholder} to it, for there are {count} {what}"),
        }))
    }

    /// The path of one image, from the value of each field. Braces in a value are kept.
    pub fn fill(&self, values: &[(&str, &str)]) -> PathBuf {
        let mut name = String::new();
        let mut rest = self.0.as_str();
        while let Some((before, after)) = rest.split_once('{') {
            name.push_str(before);
            let (field, after) = after.split_once('}').unwrap_or((after, ""));
            let value = values.iter().find(|(known, _)| *known == field);
            name.push_str(value.map_or("", |(_, value)| value));
            rest = after;
        }
        name.push_str(rest);
        PathBuf::from(name)
    }
}

/// The number of a frame as part of a file name.
pub fn frame_number(frame: u32) -> String {
    format!("{frame:04}")
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

    fn template(text: &str) -> Result<Template, String> {
        Template::new(Path::new(text), &["stem", "camera", "frame"]).map_err(|error| error.to_string())
    }

    #[test]
    fn fields_are_filled_in() {
        let fill = |text: &str, frame: u32| {
            let frame = frame_number(frame);
            template(text).unwrap().fill(&[("stem", "a{frame}"), ("camera", "top"), ("frame", &frame)])
        };
        assert_eq!(fill("o/{stem}-{camera}.{frame}.png", 7), Path::new("o/a{frame}-top.0007.png"));
        assert_eq!(fill("{frame}", 12_345), Path::new("12345"));
    }

    #[test]
    fn unknown_fields_are_told_the_known_ones() {
        let message = template("{name}.png").err().unwrap();
        assert!(message.contains("{name}") && message.contains("{stem}"), "{message}");
        assert!(template("{stem.png").is_err());
    }

    #[test]
    fn several_images_need_a_field() {
        let plain = template("a.png").unwrap();
        assert!(plain.require("frame", "frames", 1).is_ok());
        let message = plain.require("frame", "frames", 2).unwrap_err().to_string();
        assert!(message.contains("add {frame}"), "{message}");
        assert!(template("{frame}.png").unwrap().require("frame", "frames", 2).is_ok());
        assert!(template("-").unwrap().require("camera", "cameras", 2).is_err());
    }

    #[test]
    fn names_stay_in_their_folder() {
        assert_eq!(file_name_part("../../etc/passwd"), "_.._etc_passwd");
        assert_eq!(file_name_part(".."), "_");
        assert_eq!(file_name_part("Kamera 1 süd"), "Kamera 1 süd");
    }
}
