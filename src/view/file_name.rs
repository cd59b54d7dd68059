//! Names of files that the viewer writes.

use std::path::{Path, PathBuf};

/// The first of STEM.png, STEM-2.png and so on that there is no file of yet.
pub fn free_name(folder: &Path, stem: &str) -> PathBuf {
    let mut path = folder.join(format!("{stem}.png"));
    let mut number = 2;
    while path.exists() {
        path = folder.join(format!("{stem}-{number}.png"));
        number += 1;
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_file_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        for expected in ["a.png", "a-2.png", "a-3.png"] {
            let path = free_name(folder.path(), "a");
            assert_eq!(path, folder.path().join(expected));
            std::fs::write(path, "").unwrap();
        }
    }
}
