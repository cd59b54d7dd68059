//! The scenes in `assets/` equal the output of their generator.

#[path = "../../examples/generate_assets/scenes/mod.rs"]
mod scenes;

use gpc::scene::{PoseRequest, Scene};
use std::path::Path;

#[test]
fn regenerating_gives_the_same_bytes() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    for (name, build) in scenes::ALL {
        let stored = std::fs::read(folder.join(name)).unwrap();
        assert!(stored == build(), "assets/{name} differs from what the generator writes: run `make assets`");
    }
}

#[test]
fn the_folder_holds_nothing_else() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    let mut found: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    found.sort();
    assert_eq!(found, scenes::ALL.map(|(name, _)| name));
}

#[test]
fn the_scenes_are_small() {
    let total: usize = scenes::ALL.iter().map(|(_, build)| build().len()).sum();
    assert!(total < 3_000_000, "the scenes take {total} bytes");
}

#[test]
fn every_scene_loads_without_a_warning_and_has_a_camera() {
    for (name, build) in scenes::ALL {
        let loaded = Scene::from_slice(&build(), name, None).unwrap();
        assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
        let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
        assert!(pose.warnings.is_empty(), "{:?}", pose.warnings);
        assert!(!pose.cameras.is_empty(), "{name} has no camera");
        assert!(pose.geometry.triangles.len() > 1_000, "{name} shows little");
    }
}
