//! The example of a host with materials of its own, run as a program of its own under the validation layer.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The built example; `cargo test` builds examples beside its tests.
fn example() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let profile = test.parent().and_then(Path::parent).unwrap();
    let example = profile
        .join("examples")
        .join(format!("visibility{}", std::env::consts::EXE_SUFFIX));
    assert!(
        example.is_file(),
        "{} is missing: `cargo test` builds it, `cargo test --test visibility` alone does not",
        example.display()
    );
    example
}

#[test]
fn a_hosts_own_materials_are_antialiased_as_by_its_brute_force() {
    let folder = tempfile::tempdir().unwrap();
    let run = Command::new(example())
        .arg(folder.path().join("visibility.png"))
        .env("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation")
        .env(
            "VK_LAYER_ENABLES",
            "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT",
        )
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stdout).into_owned();
    let complained = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(run.status.success(), "{said}{complained}");
    assert!(
        !said.contains("Validation") && !complained.contains("Validation"),
        "{said}{complained}"
    );
    assert_eq!(said.matches(" 0 left over").count(), 2, "{said}");
    let figure = |name: &str| -> f64 {
        let line = said.lines().find_map(|line| line.strip_prefix(name));
        line.unwrap_or_else(|| panic!("no {name}{said}"))
            .parse()
            .unwrap()
    };
    let brute = figure("error of brute force: ");
    assert!(figure("error of one sample: ") > 10.0 * brute, "{said}");
    // A superpixel is shaded in 8 or 16 places where 64 samples of brute force are shaded.
    assert!(figure("error of superpixels: ") < 1.7 * brute, "{said}");
    let each = figure("error of superpixels, each sample shaded: ");
    assert!(each <= 1.25 * brute, "{said}");
    assert!(figure("share of superpixels: ") < 0.6, "{said}");
}
