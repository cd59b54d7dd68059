//! Tone mapping and the sRGB transfer function.

use gpc::color::srgb::{decode, decode_u8, encode, encode_u8};
use gpc::color::tonemap::neutral;

#[test]
fn srgb_is_the_standard_s() {
    assert_eq!((encode(0.0), encode(-3.0)), (0.0, 0.0));
    assert!((encode(1.0) - 1.0).abs() < 1e-15);
    assert_eq!(encode(7.0), encode(1.0));
    // The values are middle grey of 18 %, and the ends of the linear part.
    assert_eq!(encode_u8(0.18), 118);
    assert!((encode(0.003_130_8) - 0.040_45).abs() < 1e-5);
    assert!((encode(0.003_130_9) - encode(0.003_130_7)).abs() < 1e-5);
    for step in 0..=1000 {
        let value = f64::from(step) / 1000.0;
        assert!((decode(encode(value)) - value).abs() < 1e-7);
    }
    for code in 0..=255 {
        assert_eq!(encode_u8(decode_u8(code)), code);
    }
}

#[test]
fn tone_mapping_keeps_dim_colours_less_the_reflection() {
    for grey in [0.08, 0.2, 0.5, 0.79] {
        for channel in neutral([grey; 3]) {
            assert!((channel - (grey - 0.04)).abs() < 1e-15);
        }
    }
    let coloured = neutral([0.1, 0.3, 0.6]);
    for (found, expected) in coloured.into_iter().zip([0.06, 0.26, 0.56]) {
        assert!((found - expected).abs() < 1e-15);
    }
    assert_eq!(neutral([0.0; 3]), [0.0; 3]);
    assert_eq!(neutral([0.0, 0.5, 0.0]), [0.0, 0.5, 0.0]);
}

#[test]
fn tone_mapping_compresses_below_one_without_a_step() {
    // The expected value is 1 - 0.24^2 / (0.96 + 0.24 - 0.76), by the published formula.
    assert!((neutral([1.0; 3])[0] - (1.0 - 0.0576 / 0.44)).abs() < 1e-15);
    let mut previous = 0.0;
    for step in 1..4000 {
        let value = f64::from(step) / 200.0;
        let [red, green, _] = neutral([value, value / 2.0, value / 2.0]);
        assert!(red > previous && red < 1.0, "{value}");
        assert!(red - previous < 0.006, "{value}: a step from {previous} to {red}");
        assert!(green <= red);
        previous = red;
    }
    let bright = neutral([1e6, 1e3, 0.0]);
    assert!(bright.into_iter().all(|channel| channel > 0.99 && channel < 1.0), "{bright:?}");
}
