//! Programs that use the library, run under the validation layer.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Path of a built example; `cargo test` builds examples beside its tests.
pub fn built(name: &str) -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let profile = test.parent().and_then(Path::parent).unwrap();
    let example = profile.join("examples").join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    assert!(
        example.is_file(),
        "{} is missing: `cargo test` builds it, `cargo test --test hosts` alone does not",
        example.display()
    );
    example
}

/// Runs a program with validation and synchronisation validation, and returns its standard output. A message of the
/// layer fails the test, and so does an exit code other than 0.
pub fn validated(program: &mut Command) -> String {
    // The loader inserts the layer; without a messenger it writes to standard output.
    let run = program
        .env("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation")
        .env("VK_LAYER_ENABLES", "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stdout).into_owned();
    let complained = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(run.status.success(), "{program:?}: {said}{complained}");
    assert!(!said.contains("Validation") && !complained.contains("Validation"), "{said}{complained}");
    said
}

/// Asserts that an example takes at most `paths` paths, prints its usage for `--help`, refuses any other argument with
/// one line that names it, and writes nothing in either case.
pub fn takes_only(program: impl Fn() -> Command, paths: usize, usage: &str) {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| {
        let run = program().args(arguments).current_dir(folder.path()).output();
        let run = run.unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        (run.status.code(), text(run.stdout), text(run.stderr))
    };
    let said = format!("Usage: {usage}\n");
    assert_eq!(run(&["--help"]), (Some(0), said, String::new()));
    let too_many = [vec!["a"; paths], vec!["b"]].concat();
    for (arguments, unexpected) in [(vec!["--frames", "3"], "--frames"), (vec!["a", "-o"], "-o"), (too_many, "b")] {
        let (code, said, complained) = run(&arguments);
        let expected = format!("unexpected argument \"{unexpected}\"; usage: {usage}\n");
        assert_eq!((code, said, complained), (Some(2), String::new(), expected));
    }
}

/// Number in the line of a program's output that begins with `name`.
pub fn figure(said: &str, name: &str) -> f64 {
    let line = said.lines().find_map(|line| line.strip_prefix(name));
    line.unwrap_or_else(|| panic!("no \"{name}\" in {said}")).parse().unwrap()
}
