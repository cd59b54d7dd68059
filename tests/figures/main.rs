//! Checks that every table and plot of the documents agrees with the data in `docs/bench`, every help text with the
//! command, and every drawing of passes with what the library records.
//!
//! `make figures` writes them: it runs this test with `GPC_FIGURES=write`.

mod checks;
mod choices;
mod data;
mod documents;
mod gpu;
mod help;
mod hosts;
mod passes;
mod pipeline;
mod plot;
mod rivals;
mod room;
mod sets;
mod snippets;
mod table;
mod text;
mod time_to_error;

/// Compares the files in the repository with the generated ones, or writes them.
#[test]
fn documents_agree_with_their_data() {
    let write = std::env::var_os("GPC_FIGURES").is_some_and(|value| value == "write");
    let mut stale = Vec::new();
    for (path, wanted) in documents::generate() {
        let found = std::fs::read_to_string(&path).unwrap_or_default();
        if found == wanted {
            continue;
        }
        if write {
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(&path, wanted).unwrap();
        } else {
            stale.push(path.display().to_string());
        }
    }
    assert!(
        stale.is_empty(),
        "these differ from docs/bench, from the command's help or from the passes that the library records; run `make figures`: {stale:?}"
    );
}
