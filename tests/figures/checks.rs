//! Checks of the documents besides their figures.

use crate::data::root;
use crate::documents::{handwritten, markdown};
use crate::help;
use std::path::Path;

fn read(path: impl AsRef<Path>) -> String {
    std::fs::read_to_string(path).unwrap()
}

/// Text of a Markdown document without its fenced blocks.
fn prose(text: &str) -> String {
    let mut inside = false;
    let mut kept = Vec::new();
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            inside = !inside;
        } else if !inside {
            kept.push(line);
        }
    }
    kept.join("\n")
}

/// Units in which results are measured. Bounds of memory have binary units: these are no results.
const UNITS: [&str; 14] = ["%", "dB", "fps", "h", "hours", "kB", "KB", "MB", "GB", "min", "minutes", "ms", "s", "µs"];

/// Whether a text has a number with a unit of measurement.
fn measured(paragraph: &str) -> bool {
    let words: Vec<&str> = paragraph.split_whitespace().collect();
    words.windows(2).any(|pair| {
        let number = pair[0].trim_start_matches(['(', '|']).ends_with(|c: char| c.is_ascii_digit());
        let unit = pair[1].trim_end_matches(['.', ',', ';', ':', ')', '|']);
        number && UNITS.contains(&unit)
    })
}

#[test]
fn the_readme_is_short() {
    let words = read(root().join("README.md")).split_whitespace().count();
    assert!(words <= 900, "README.md has {words} words; 900 are the limit");
}

/// Whether a text names where its figures come from: by a link, a command or a file.
fn sourced(paragraph: &str) -> bool {
    let mut code = paragraph.split('`').skip(1).step_by(2);
    let command = |code: &str| {
        let program = ["gpc ", "make ", "cargo ", ".ci/", "tools/", "docs/"];
        program.iter().any(|program| code.starts_with(program))
    };
    paragraph.contains("](") || code.any(command)
}

/// Every figure in prose names its source.
#[test]
fn figures_in_prose_have_a_source() {
    let mut without = Vec::new();
    for path in markdown() {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        // Entries of these documents are dated and describe the code of their day.
        if ["decisions.md", "CHANGELOG.md"].contains(&name.as_str()) {
            continue;
        }
        for paragraph in prose(&handwritten(&read(&path))).split("\n\n") {
            if measured(paragraph) && !sourced(paragraph) {
                without.push(format!("{name}: {paragraph}"));
            }
        }
    }
    assert!(without.is_empty(), "{without:#?}");
}

#[test]
fn a_figure_without_a_source_is_found() {
    assert!(measured("A frame takes 12 ms."));
    assert!(measured("Images agree to 68 dB, mostly."));
    assert!(measured("A round takes 7 µs, and the frame 1.2 s."));
    assert!(measured("| frames that share | 11.8 MB |"));
    assert!(!measured("It takes 64 samples."));
    assert!(!sourced("On `llvmpipe` a frame takes 12 ms."));
    assert!(sourced("`gpc bench` says 12 ms."));
    assert!(sourced("A frame takes 12 ms ([decision](decisions.md))."));
}

/// Links to files and headings of the repository are valid.
#[test]
fn links_lead_somewhere() {
    let mut broken = Vec::new();
    for path in markdown() {
        let text = prose(&read(&path));
        let folder = path.parent().unwrap();
        let links = text.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
        for (link, _) in links.filter(|(link, _)| !link.contains("://")) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { path.clone() } else { folder.join(file) };
            let found = target.exists() && (heading.is_empty() || headings(&target).contains(&heading.to_owned()));
            if !found {
                broken.push(format!("{}: {link}", path.display()));
            }
        }
    }
    assert!(broken.is_empty(), "{broken:#?}");
}

/// Anchors of a document's headings, as forges generate them.
fn headings(path: &Path) -> Vec<String> {
    let text = prose(&read(path));
    let lines = text.lines().filter(|line| line.starts_with('#'));
    lines
        .map(|line| {
            let title = line.trim_start_matches('#').trim().to_lowercase();
            let kept = title.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
            kept.collect::<String>().replace(' ', "-")
        })
        .collect()
}

/// The four places with the version agree.
#[test]
fn versions_agree() {
    let version = env!("CARGO_PKG_VERSION");
    let (major_minor, _) = version.rsplit_once('.').unwrap();
    for (file, text) in [
        ("CITATION.cff", format!("version: {version}")),
        ("CHANGELOG.md", format!("## {version}")),
        ("README.md", format!("Version {major_minor}")),
    ] {
        assert!(read(root().join(file)).contains(&text), "{file} lacks \"{text}\"");
    }
}

/// Options that documents attribute to the command are options of a subcommand. In a command line, they are options of its own
/// subcommand.
#[test]
fn options_exist() {
    let help = help::every();
    let every: Vec<&str> = options(&help).collect();
    let mut unknown = Vec::new();
    for path in markdown() {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        // Options that these documents name may have been removed.
        if ["CHANGELOG.md", "decisions.md"].contains(&name.as_str()) {
            continue;
        }
        // A command line may go on after a backslash.
        let text = handwritten(&read(&path)).replace("\\\n", " ");
        let spans = text.split('`').skip(1).step_by(2);
        let spans = spans.filter(|span| span.starts_with("--") || span.starts_with("gpc "));
        for code in spans.chain(text.lines()) {
            for option in unknown_options(code, &help, &every) {
                unknown.push(format!("{name}: {option} in \"{code}\""));
            }
        }
    }
    assert!(unknown.is_empty(), "{unknown:#?}");
}

/// Options in a line or a span of code that the command does not have. `every` has those of all subcommands.
fn unknown_options<'a>(code: &'a str, help: &str, every: &[&str]) -> Vec<&'a str> {
    let code = code.trim_start();
    if code.starts_with("--") {
        return options(code).filter(|option| !every.contains(option)).collect();
    }
    let mut unknown = Vec::new();
    // `$(gpc ...)`, `| gpc ...` and `parallel ... gpc ...` are command lines, too.
    for call in code.match_indices("gpc ").map(|(at, _)| &code[at..]) {
        let ends = ["|", ")", ";", "`", " # "].into_iter().filter_map(|end| call.find(end));
        let line = &call[..ends.min().unwrap_or(call.len())];
        let Some(subcommand) = line.split_whitespace().nth(1) else { continue };
        let Some((_, section)) = help.split_once(&format!("## gpc {subcommand}\n")) else { continue };
        let section = section.split("\n## ").next().unwrap();
        let known: Vec<&str> = options(section).collect();
        unknown.extend(options(line).filter(|option| !known.contains(option) && *option != "--help"));
    }
    unknown
}

#[test]
fn an_option_of_another_subcommand_is_found() {
    let help = "## gpc render\n--size\n## gpc zoom\n--center\n";
    let every = ["--size", "--center"];
    assert_eq!(unknown_options("gpc zoom a --center 1,2 --size 3x4", help, &every), ["--size"]);
    assert_eq!(unknown_options("seq 8 | parallel gpc render --size {} --quiet", help, &every), ["--quiet"]);
    assert_eq!(
        unknown_options("gpc render --background '#aabbcc' --wrong # --no", help, &every),
        ["--background", "--wrong"]
    );
    assert_eq!(unknown_options("--size", help, &every), [""; 0]);
    assert_eq!(unknown_options("ffmpeg --wrong", help, &every), [""; 0]);
}

/// Long options in a text.
fn options(text: &str) -> impl Iterator<Item = &str> {
    let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-'));
    words.filter(|word| word.starts_with("--") && word.len() > 3)
}
