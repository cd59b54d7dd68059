//! The example of a host with materials of its own.

use crate::difference::rmse;
use crate::example::{self, figure};
use std::process::Command;

#[test]
fn visibility_refuses_arguments_that_it_does_not_know() {
    let program = || Command::new(example::built("visibility"));
    example::takes_only(program, 2, "visibility [OUT.png [LENS.png]]");
}

#[test]
fn a_hosts_own_materials_are_antialiased_as_by_its_brute_force() {
    let folder = tempfile::tempdir().unwrap();
    let [out, lens] = ["visibility.png", "lens.png"].map(|name| folder.path().join(name));
    let said = example::validated(Command::new(example::built("visibility")).args([&out, &lens]));
    assert_eq!(said.matches(" 0 left over").count(), 2, "{said}");
    let brute = figure(&said, "error of brute force: ");
    assert!(figure(&said, "error of one sample: ") > 10.0 * brute, "{said}");
    assert!(figure(&said, "error of superpixels: ") <= 0.9 * brute, "{said}");
    let placed = figure(&said, "error of superpixels, samples where brute force has them: ");
    // Supersampling shades 64 samples where a superpixel is shaded in 8 or 16 places.
    assert!(placed <= 1.15 * brute, "{said}");
    let each = figure(&said, "error of superpixels, each of these samples shaded: ");
    assert!(each <= 1.05 * brute, "{said}");
    assert!(figure(&said, "share of superpixels: ") < 0.6, "{said}");

    let through = |what: &str| figure(&said, &format!("through the lens, error of {what}: "));
    let brute = through("brute force");
    assert!(through("one sample") > 10.0 * brute, "{said}");
    assert!(through("superpixels") <= 0.9 * brute, "{said}");
    let placed = through("superpixels, samples where brute force has them");
    assert!(placed <= 1.15 * brute, "{said}");
    let each = through("superpixels, each of these samples shaded");
    assert!(each <= 1.05 * brute, "{said}");

    // Beside the lens both pictures are equal; in its middle things are larger.
    let [out, lens] = [out, lens].map(|path| image::open(path).unwrap());
    let apart = |x: u32, width: u32| {
        let colors = |picture: &image::DynamicImage| -> Vec<[f32; 4]> {
            let part = picture.crop_imm(x, 0, width, picture.height());
            part.to_rgba32f().pixels().map(|pixel| pixel.0).collect()
        };
        rmse(&colors(&out), &colors(&lens))
    };
    let (beside, middle) = (apart(0, 78), apart(130, 60));
    assert!(beside < 0.002 && middle > 0.04, "{beside} {middle}");
}
