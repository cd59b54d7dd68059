//! Malformed files give a scene, or an error with a place and a reason, without a panic or a hang.

use std::{panic::catch_unwind, path::Path};

use crate::shared::{gltf_files, shared};
use gpc::scene::{PoseRequest, Scene, SceneError};
use serde_json::Value;

/// Loads a file, and poses every scene of it at rest and in the middle of every animation.
fn exercise(path: &Path) -> Result<Vec<String>, SceneError> {
    let loaded = Scene::load(path)?;
    let info = loaded.scene.info();
    let mut warnings = loaded.warnings;
    for index in (0..info.scenes.names.len()).map(Some).chain([None]) {
        let rest = (None, 0.0);
        let moving = info.animations.iter().enumerate();
        let moments = moving.map(|(i, a)| (Some(i.to_string()), a.duration / 2.0));
        for (animation, time) in std::iter::once(rest).chain(moments) {
            let request = PoseRequest { scene: index, animation, time };
            warnings.extend(loaded.scene.pose(&request)?.warnings);
        }
    }
    Ok(warnings)
}

/// Number of errors in the validator's report beside the file, if there is one.
fn reported_errors(path: &Path) -> Option<u64> {
    let name = format!("{}.report.json", path.file_name()?.to_str()?);
    let report = std::fs::read(path.with_file_name(name)).ok()?;
    let report: Value = serde_json::from_slice(&report).ok()?;
    report["issues"]["numErrors"].as_u64()
}

#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn every_file_ends_in_a_scene_or_an_error_with_its_name() {
    let folder = shared("malformed");
    let files = gltf_files(&folder);
    assert!(files.len() >= 200, "only {} files", files.len());
    let (mut errors, mut valid) = (0, 0);
    for path in &files {
        let name = path.display().to_string();
        let result = catch_unwind(|| exercise(path)).unwrap_or_else(|_| panic!("{name} panics"));
        let shorten = |message: &str| message.replace(folder.to_str().unwrap(), "");
        match &result {
            Ok(warnings) => {
                assert!(warnings.iter().all(|w| w.starts_with(&name)), "{name}: {warnings:?}");
                for warning in warnings {
                    eprintln!("warning {}", shorten(warning));
                }
            }
            Err(error) => {
                errors += 1;
                let message = error.to_string();
                assert!(message.starts_with(&name), "{message}");
                eprintln!("error {}", shorten(&message));
            }
        }
        if reported_errors(path) == Some(0) {
            valid += 1;
            let unsupported = matches!(result, Err(SceneError::Version { .. } | SceneError::Extension { .. }));
            assert!(result.is_ok() || unsupported, "{name}: {result:?}");
        }
    }
    assert!(errors > 40, "only {errors} of {} files are refused", files.len());
    assert!(valid >= 40, "only {valid} reports without errors");
}

/// URIs that other programs write or read lead to their files; those that lead nowhere are named.
#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn uris_of_other_programs_are_read_or_named() {
    let files = gltf_files(&shared("reports/16-gltf-uri"));
    assert!(files.len() >= 18, "only {} files", files.len());
    for path in files {
        let name = path.file_stem().unwrap().to_str().unwrap();
        let loaded = match (name, Scene::load(&path)) {
            ("utf16", Err(error)) => {
                assert!(error.to_string().contains("neither a GLB"), "{error}");
                continue;
            }
            (_, loaded) => loaded.unwrap(),
        };
        // On some systems, the case of letters in a file's name does not matter.
        let is_tolerated = ["backslash", "backslash-up", "data-newline", "case", "trailing"].contains(&name);
        let has_images = !["bin-query", "trailing", "data-urlsafe", "case"].contains(&name);
        let images = loaded.scene.images.len();
        match name {
            "case" => assert_eq!(images == 0, !loaded.warnings.is_empty()),
            "data-urlsafe" => assert!(loaded.warnings[0].contains("/images/0/uri"), "{name}"),
            _ => assert_eq!((images == 1, loaded.warnings.len()), (has_images, usize::from(is_tolerated)), "{name}"),
        }
        let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
        assert!(!pose.geometry.triangles.is_empty(), "{name}");
    }
}
