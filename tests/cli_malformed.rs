//! Malformed files through the built command: an image, or one error that names the file; never a crash.

#[allow(dead_code)]
mod cli_support;
#[allow(dead_code)]
mod scene_support;

use cli_support::{files, gpc};

#[test]
fn every_malformed_file_ends_in_an_image_or_an_error() {
    let Some(shared) = scene_support::shared("malformed") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let image = folder.path().join("a.png");
    let (mut images, mut errors) = (0, 0);
    for path in scene_support::gltf_files(&shared) {
        let name = path.to_str().unwrap();
        let options = ["-o", "a.png", "--size", "32x18", "--samples", "4"];
        let run = gpc(folder.path(), &[&["render", name], &options[..]].concat());
        let said = run.stderr.lines().filter(|line| line.starts_with("error:"));
        match run.code {
            Some(0) => {
                images += 1;
                assert_eq!(files(folder.path()), ["a.png"], "{name}");
                std::fs::remove_file(&image).unwrap();
            }
            Some(1) => {
                errors += 1;
                let said: Vec<_> = said.collect();
                assert!(
                    said.len() == 1 && said[0].contains(name),
                    "{name}: {said:?}"
                );
                assert!(files(folder.path()).is_empty(), "{name}");
            }
            code => panic!("{name}: exit code {code:?}: {}", run.stderr),
        }
    }
    assert!(
        images > 30 && errors > 30,
        "{images} images, {errors} errors"
    );
}
