//! Files that the viewer opens and writes.

use crate::scene_files::{EXTENSIONS, is_scene};
use anyhow::{Context, bail};
use std::path::{Path, PathBuf};

/// `path` itself if it is a file; the scene files of a folder, sorted by name.
///
/// # Errors
/// If the folder can't be read or has no scene file.
pub fn scenes_at(path: &Path) -> anyhow::Result<Vec<PathBuf>> {
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let unreadable = || format!("{} can't be read", path.display());
    let mut scenes = Vec::new();
    for entry in std::fs::read_dir(path).with_context(unreadable)? {
        let file = entry.with_context(unreadable)?.path();
        if is_scene(&file) && file.is_file() {
            scenes.push(file);
        }
    }
    scenes.sort();
    if scenes.is_empty() {
        bail!("{} has no scene file: none ends in .{}", path.display(), EXTENSIONS.join(", ."));
    }
    Ok(scenes)
}

/// The first of STEM.png, STEM-2.png and so on that does not exist yet.
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
    fn a_folder_is_its_scenes() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        assert!(scenes_at(folder.path()).is_err());
        for name in ["b.GLB", "a.gltf", "a.bin", "a.png"] {
            std::fs::write(path(name), "").unwrap();
        }
        std::fs::create_dir(path("c.glb")).unwrap();
        let found = scenes_at(folder.path()).unwrap();
        assert_eq!(found, [path("a.gltf"), path("b.GLB")]);
        assert_eq!(scenes_at(&path("a.png")).unwrap(), [path("a.png")]);
    }

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
