//! Stress check: vertices with infinite or undefined positions, and triangles without an area. None may be visible,
//! nor change the rest of the image.

use super::difference::same;
use super::stage::once;
use super::{Finding, Length, soup};
use gpc::render::{Headless, MethodKind, RenderError};

pub(super) fn check(headless: &mut Headless, length: Length) -> Result<Vec<Finding>, RenderError> {
    let size = length.choose([40, 30], [320, 200]);
    let stage = soup(9, size, length.choose(60, 2000), 0);
    let with = |method: MethodKind, samples| {
        once(size).attributes(false).method(method.with_samples(samples)).map_superpixels(|options| options.thin(false))
    };
    let methods = [
        ("none", with(MethodKind::None, 1)),
        ("superpixel", with(MethodKind::Superpixel, 16)),
        ("ssaa", with(MethodKind::Ssaa, 4)),
        ("msaa", with(MethodKind::Msaa, 4)),
    ];
    let mut findings = Vec::new();
    for (name, settings) in methods {
        let clean = stage.render(headless, &settings)?;
        for (what, corners) in hostile() {
            let mut spoilt = stage.clone();
            for corners in turned(corners) {
                spoilt.add(0, corners);
            }
            let image = spoilt.render(headless, &settings)?;
            findings.push(same(format!("{what}, {name}"), &clean, &image));
        }
    }
    Ok(findings)
}

/// Triangles with no area, or with an undefined one.
fn hostile() -> [(&'static str, [[f32; 3]; 3]); 9] {
    let (right, up) = ([1.0, 0.0, -1.0], [0.0, 1.0, -1.0]);
    [
        ("a vertex that is NaN", [[f32::NAN; 3], right, up]),
        ("a coordinate that is NaN", [[0.0, f32::NAN, -1.0], right, up]),
        ("an infinite vertex", [[f32::INFINITY; 3], right, up]),
        ("an infinite depth", [[0.0, 0.0, f32::NEG_INFINITY], right, up]),
        ("the largest numbers", [[f32::MAX; 3], [-f32::MAX; 3], [f32::MAX; 3]]),
        ("denormals", [[1e-40, 0.0, -1e-40], [0.0, 1e-40, -1e-40], [1e-41; 3]]),
        ("one vertex thrice", [up; 3]),
        ("one vertex twice", [right, up, up]),
        ("three in a line", [[-0.5, 0.25, -1.0], [0.0, 0.25, -1.0], [0.5, 0.25, -1.0]]),
    ]
}

/// Triangle with its vertices in all three rotations, and once in the opposite winding.
fn turned(corners: [[f32; 3]; 3]) -> [[[f32; 3]; 3]; 4] {
    let [a, b, c] = corners;
    [[a, b, c], [b, c, a], [c, a, b], [b, a, c]]
}
