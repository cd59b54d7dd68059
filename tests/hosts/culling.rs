//! The example of a host whose draws are decided on the device.

use crate::example::{self, figure};
use std::process::Command;

#[test]
fn culling_refuses_arguments_that_it_does_not_know() {
    let program = || Command::new(example::built("culling"));
    example::takes_only(program, 1, "culling [OUT.png]");
}

/// The CPU counts as many objects in the view as the device draws, up to rounding.
#[test]
fn what_the_device_draws_is_antialiased_as_by_brute_force() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("culling.png");
    let said = example::validated(Command::new(example::built("culling")).arg(&out));
    let [drawn, in_view] = ["objects drawn: ", "objects in the view: "].map(|name| figure(&said, name));
    assert!((1000.0..6000.0).contains(&drawn) && (drawn - in_view).abs() <= 2.0, "{said}");
    assert!(figure(&said, "left out: ") == 0.0 && said.contains(" 0 left over"), "{said}");
    let brute = figure(&said, "error of brute force: ");
    assert!(figure(&said, "error of one sample: ") > 10.0 * brute, "{said}");
    assert!(figure(&said, "error of superpixels: ") <= brute, "{said}");
}
