//! The example of a host with materials of its own.

#[allow(dead_code)]
#[path = "common/example.rs"]
mod example;

use example::figure;
use std::process::Command;

#[test]
fn visibility_refuses_arguments_that_it_does_not_know() {
    let program = || Command::new(example::built("visibility"));
    example::takes_only(program, 1, "visibility [OUT.png]");
}

#[test]
fn a_hosts_own_materials_are_antialiased_as_by_its_brute_force() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("visibility.png");
    let said = example::validated(Command::new(example::built("visibility")).arg(out));
    assert_eq!(said.matches(" 0 left over").count(), 2, "{said}");
    let brute = figure(&said, "error of brute force: ");
    assert!(
        figure(&said, "error of one sample: ") > 10.0 * brute,
        "{said}"
    );
    // A superpixel is shaded in 8 or 16 places where 64 samples of brute force are shaded.
    assert!(
        figure(&said, "error of superpixels: ") < 1.45 * brute,
        "{said}"
    );
    let placed = figure(
        &said,
        "error of superpixels, samples where brute force has them: ",
    );
    assert!(placed <= 1.25 * brute, "{said}");
    let each = figure(
        &said,
        "error of superpixels, each of these samples shaded: ",
    );
    assert!(each <= 1.1 * brute, "{said}");
    assert!(figure(&said, "share of superpixels: ") < 0.6, "{said}");
}
