//! Documents and their generated parts.

use crate::data::root;
use crate::{choices, gpu, help, hosts, passes, pipeline, plot, rivals, room, sets, table};
use std::path::PathBuf;

/// Function that generates the text of a part.
type Make = fn() -> String;

const PARTS: [(&str, Make); 24] = [
    ("picture", table::picture),
    ("readme", table::readme),
    ("choosing", table::choosing),
    ("exceptions", table::exceptions),
    ("quality", table::quality_by_scene),
    ("views", table::views),
    ("many", table::many),
    ("large", table::large),
    ("speed", table::speed),
    ("gpu", gpu::table),
    ("motion", table::motion),
    ("variants", table::variants),
    ("hosts", hosts::table),
    ("alpha", rivals::alpha),
    ("python", rivals::python),
    ("room", room::table),
    ("contrast", choices::contrast),
    ("shading", choices::shading),
    ("help", help::every),
    ("passes", passes::frame),
    ("passes-in-short", pipeline::in_short),
    ("list-passes", passes::list),
    ("shadow-passes", passes::shadows),
    ("image-passes", passes::image),
];

const PLOTS: [(&str, Make); 4] =
    [("error-time", plot::error_time), ("growth", plot::growth), ("passes", pipeline::draw), ("sets", sets::draw)];

const BEGIN: &str = "<!-- figures: ";
const END: &str = "<!-- end -->";

/// Every file with generated parts, and the text that it should have.
pub fn generate() -> Vec<(PathBuf, String)> {
    let mut used = Vec::new();
    let documents = markdown().into_iter().map(|path| (path, ""));
    // The documentation of the crate.
    let documents = documents.chain([(root().join("src/lib.rs"), "//! ")]);
    let mut files: Vec<_> = documents
        .filter_map(|(path, margin)| {
            let text = std::fs::read_to_string(&path).unwrap();
            let has_parts = text.contains(BEGIN);
            has_parts.then(|| (path, fill(&text, margin, &mut used)))
        })
        .collect();
    for (name, _) in PARTS {
        assert!(used.iter().any(|other| other == name), "no document has the part \"{name}\"");
    }
    for path in passes::SOURCES.map(|path| root().join(path)) {
        let text = std::fs::read_to_string(&path).unwrap();
        files.push((path, passes::annotated(&text)));
    }
    for (name, make) in PLOTS {
        files.push((root().join(format!("docs/figures/{name}.svg")), make()));
    }
    files
}

/// Paths of the documents at the root and in `docs`.
pub fn markdown() -> Vec<PathBuf> {
    let folders = [root().to_owned(), root().join("docs")];
    let mut paths: Vec<PathBuf> = folders
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
        .collect();
    paths.sort();
    paths
}

/// Text of a document with its marked parts generated again. Each line begins with `margin`.
fn fill(text: &str, margin: &str, used: &mut Vec<String>) -> String {
    let mut filled = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once(BEGIN) {
        let (name, after) = after.split_once(" -->").unwrap();
        let part = PARTS.iter().find(|(other, _)| *other == name);
        let (_, make) = part.unwrap_or_else(|| panic!("no part is called \"{name}\""));
        let end = after.find(END).unwrap_or_else(|| panic!("the part \"{name}\" has no end"));
        let part = format!("{BEGIN}{name} -->\n\n{}\n\n{END}", make().trim());
        let lines: Vec<_> = part.split('\n').collect();
        let part = lines.join(&format!("\n{margin}"));
        filled += &format!("{before}{}", part.replace("//! \n", "//!\n"));
        used.push(name.to_owned());
        rest = &after[end + END.len()..];
    }
    filled + rest
}

/// Text of a document without its generated parts.
pub fn handwritten(text: &str) -> String {
    let mut kept = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once(BEGIN) {
        kept += before;
        rest = after.split_once(END).map_or("", |(_, rest)| rest);
    }
    kept + rest
}
