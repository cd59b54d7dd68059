//! Code in the documents compiles.

use crate::data::root;
use crate::documents::markdown;
use std::path::{Path, PathBuf};
use std::process::Command;

mod manual;

/// A fenced block of code.
struct Snippet {
    /// Line of the document at which the code begins, counted from 1.
    line: usize,
    code: String,
}

/// Blocks of a document in one of `languages`, in their order.
fn snippets(document: &str, languages: &[&str]) -> Vec<Snippet> {
    let mut found: Vec<Snippet> = Vec::new();
    let (mut inside, mut wanted) = (false, false);
    for (index, line) in document.lines().enumerate() {
        if let Some(language) = line.trim_start().strip_prefix("```") {
            inside = !inside;
            wanted = inside && languages.contains(&language.trim());
            if wanted {
                found.push(Snippet { line: index + 2, code: String::new() });
            }
        } else if wanted {
            found.last_mut().unwrap().code += &format!("{line}\n");
        }
    }
    found
}

/// The C code of a document as one file. Blocks that define functions come first. The others are the body of one function, in which
/// each block sees what the blocks before it declare, and may declare the same names again.
fn translation_unit(name: &str, document: &str) -> String {
    let own = root().join(format!("tests/figures/snippets/{name}.h"));
    let prelude = if own.exists() { own } else { root().join("tests/figures/snippets/application.h") };
    let is_function =
        |snippet: &Snippet| snippet.code.lines().any(|line| line.starts_with("void ") && line.ends_with('{'));
    let (functions, statements): (Vec<_>, Vec<_>) =
        snippets(document, &["c"]).into_iter().partition(|snippet| is_function(snippet));
    let text = |snippet: &Snippet| format!("#line {} \"{name}.md\"\n{}", snippet.line, snippet.code);
    let mut unit = format!("#include \"{}\"\n", prelude.display());
    unit.extend(functions.iter().map(text));
    unit += "void snippets_of_the_document(void) {\n";
    unit.extend(statements.iter().map(|snippet| format!("{{\n{}", text(snippet))));
    unit + &"}".repeat(statements.len() + 1) + "\n"
}

/// What the C compiler says against a document's code; empty if nothing.
fn complaints(name: &str, document: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let source = folder.path().join("snippets.c");
    std::fs::write(&source, translation_unit(name, document)).unwrap();
    let run = Command::new("cc")
        .args(["-std=c11", "-fsyntax-only", "-Wall", "-Wextra", "-Werror"])
        // Snippets show a part of a program, so they declare what they do not use.
        .args(["-Wno-unused-variable", "-Wno-unused-parameter", "-Wno-missing-field-initializers"])
        .arg(format!("-I{}", root().join("include").display()))
        .arg(&source)
        .output()
        .unwrap();
    String::from_utf8_lossy(&run.stderr).into_owned()
}

fn name_of(path: &Path) -> String {
    path.file_stem().unwrap().to_string_lossy().into_owned()
}

#[test]
fn c_code_compiles() {
    let mut blocks = 0;
    let mut wrong = Vec::new();
    for path in markdown() {
        let document = std::fs::read_to_string(&path).unwrap();
        let count = snippets(&document, &["c"]).len();
        if count > 0 {
            wrong.extend(Some(complaints(&name_of(&path), &document)).filter(|text| !text.is_empty()));
        }
        blocks += count;
    }
    assert!(blocks > 5, "only {blocks} blocks of C were found");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_call_without_an_argument_is_found() {
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    assert_eq!(complaints("README", &readme), "");
    let wrong = complaints("README", &readme.replace("commands, &images, ", "commands, "));
    assert!(wrong.contains("README.md") && wrong.contains("too few arguments"), "{wrong}");
}

/// Files with Rust code below a folder.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Code without indentation and empty lines.
fn flat(code: &str) -> String {
    let lines: Vec<_> = code.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    lines.join("\n")
}

/// Rust code in a document is a part of a file that is compiled. The code in the README is compiled by a test of the crate's
/// documentation.
#[test]
fn rust_code_is_part_of_a_compiled_file() {
    let mut paths = Vec::new();
    for folder in ["src", "tests", "examples"] {
        sources(&root().join(folder), &mut paths);
    }
    let compiled: Vec<_> = paths.iter().map(|path| flat(&std::fs::read_to_string(path).unwrap())).collect();
    let mut unknown = Vec::new();
    for path in markdown().into_iter().filter(|path| name_of(path) != "README") {
        let document = std::fs::read_to_string(&path).unwrap();
        for Snippet { line, code } in snippets(&document, &["rust", "rust,ignore", "rust,no_run"]) {
            if !compiled.iter().any(|source| source.contains(&flat(&code))) {
                unknown.push(format!("{}, line {line}:\n{code}", path.display()));
            }
        }
    }
    assert!(unknown.is_empty(), "no compiled file has this code:\n{}", unknown.join("\n"));
}

#[test]
fn blocks_are_found_by_their_language() {
    let document = "text\n```c\none;\n```\n```rust\ntwo;\n```\n```c\nthree;\n```\n";
    let found: Vec<_> = snippets(document, &["c"]).into_iter().map(|snippet| (snippet.line, snippet.code)).collect();
    assert_eq!(found, [(3, "one;\n".to_owned()), (9, "three;\n".to_owned())]);
}
