//! Test files in `../shared`, which are too large for the repository. `build.rs` sets the cfg `shared_files` if tests
//! may expect them; otherwise the tests that need them are ignored.

use std::path::{Path, PathBuf};

/// Path of the folder `name` in `../shared`.
///
/// # Panics
/// If the folder is missing.
pub fn shared(name: &str) -> PathBuf {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared")).join(name);
    assert!(folder.is_dir(), "{} is missing", folder.display());
    folder
}

/// All `.gltf` and `.glb` files below `folder`, sorted.
pub fn gltf_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == "gltf" || e == "glb") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}
