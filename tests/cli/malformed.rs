//! Malformed files through the built command: an image, or one error that names the file; never a crash.

use crate::command::{files, gpc};
use crate::shared::{gltf_files, shared};

#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn malformed_files_end_in_an_image_or_an_error() {
    let malformed = shared("malformed");
    let folder = tempfile::tempdir().unwrap();
    let image = folder.path().join("a.png");
    let (mut images, mut errors) = (0, 0);
    // Most of the time goes to starting the command, so it reads some of the files; tests/gpu renders all.
    for path in gltf_files(&malformed).into_iter().step_by(16) {
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
                assert!(said.len() == 1 && said[0].contains(name), "{name}: {said:?}");
                assert!(files(folder.path()).is_empty(), "{name}");
            }
            code => panic!("{name}: exit code {code:?}: {}", run.stderr),
        }
    }
    assert!(images > 0 && errors > 0, "{images} images, {errors} errors");
}
