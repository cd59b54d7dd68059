//! Counts of pixels that differ between two images.

use super::Finding;
use gpc::color::srgb;
use gpc::render::Rendered;

/// Share of the pixels that differ in any channel by more than one 8-bit sRGB code.
pub(super) fn in_codes(a: &Rendered, b: &Rendered) -> f64 {
    let code = |value: f32| srgb::encode_u8(f64::from(value.clamp(0.0, 1.0)));
    let differ = |(a, b): &(&[f32; 4], &[f32; 4])| {
        let mut channels = a.iter().zip(b.iter());
        channels.any(|(a, b)| code(*a).abs_diff(code(*b)) > 1)
    };
    let pairs = a.colors.iter().zip(&b.colors);
    pairs.filter(differ).count() as f64 / a.colors.len() as f64
}

/// Finding that compares two images which must be identical, in every bit.
pub(super) fn same(case: impl Into<String>, a: &Rendered, b: &Rendered) -> Finding {
    let pairs = a.colors.iter().zip(&b.colors);
    let different = pairs.filter(|(a, b)| a.map(f32::to_bits) != b.map(f32::to_bits)).count();
    Finding {
        case: case.into(),
        checked: a.colors.len() as u64,
        unit: "pixels that differ",
        measured: different as f64,
        allowed: Some(0.0),
    }
}
