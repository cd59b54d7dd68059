//! The scenes in `assets/` are what their generator writes.

#[path = "../examples/generate_assets/scenes/mod.rs"]
mod scenes;

use std::path::Path;

#[test]
fn regenerating_gives_the_same_bytes() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    for (name, build) in scenes::ALL {
        let stored = std::fs::read(folder.join(name)).unwrap();
        assert!(
            stored == build(),
            "assets/{name} differs from what the generator writes: run `make assets`"
        );
    }
}

#[test]
fn the_folder_holds_nothing_else() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    let mut found: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    found.sort();
    assert_eq!(found, scenes::ALL.map(|(name, _)| name));
}

#[test]
fn every_scene_is_small_and_has_a_camera() {
    let mut total = 0;
    for (name, build) in scenes::ALL {
        let bytes = build();
        total += bytes.len();
        let file = gltf::Glb::from_slice(&bytes).unwrap();
        let document: serde_json::Value = serde_json::from_slice(&file.json).unwrap();
        assert!(document["cameras"].is_array(), "{name} has no camera");
    }
    assert!(total < 3_000_000, "the scenes take {total} bytes");
}

#[test]
fn every_scene_is_valid() {
    for (name, build) in scenes::ALL {
        if let Err(error) = gltf::Gltf::from_slice(&build()) {
            panic!("{name}: {error}");
        }
    }
}
