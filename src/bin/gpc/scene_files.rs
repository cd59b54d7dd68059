//! Names of scene files.

use std::path::Path;

/// Extensions of scene files.
pub const EXTENSIONS: [&str; 5] = ["glb", "gltf", "obj", "ply", "stl"];

/// Whether a file is a scene by its name.
pub fn is_scene(path: &Path) -> bool {
    path.extension().is_some_and(|extension| EXTENSIONS.iter().any(|known| extension.eq_ignore_ascii_case(known)))
}
