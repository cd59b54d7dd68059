//! The sRGB transfer function (IEC 61966-2-1:1999, section 5.2).

/// Linear light, 0 to 1, as an sRGB-encoded value, 0 to 1. What lies outside is brought to the nearer bound.
pub fn encode(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

/// An sRGB-encoded value, 0 to 1, as linear light, 0 to 1; bounds as in [`encode`].
pub fn decode(encoded: f64) -> f64 {
    let encoded = encoded.clamp(0.0, 1.0);
    if encoded <= 0.040_45 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}

/// Linear light as the nearest 8-bit sRGB code value.
pub fn encode_u8(linear: f64) -> u8 {
    (encode(linear) * 255.0).round() as u8
}

/// An 8-bit sRGB code value as linear light.
pub fn decode_u8(code: u8) -> f64 {
    decode(f64::from(code) / 255.0)
}
