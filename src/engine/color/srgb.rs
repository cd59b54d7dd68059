//! The sRGB transfer function (IEC 61966-2-1:1999, section 5.2).

/// sRGB-encoded value, 0 to 1, of linear light. Light outside of 0 to 1 is clamped.
pub fn encode(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Linear light, 0 to 1, of an sRGB-encoded value. A value outside of 0 to 1 is clamped.
pub fn decode(encoded: f64) -> f64 {
    let encoded = encoded.clamp(0.0, 1.0);
    if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// Nearest 8-bit sRGB code of linear light, which is clamped to 0 to 1.
pub fn encode_u8(linear: f64) -> u8 {
    (encode(linear) * 255.0).round() as u8
}

/// Linear light, 0 to 1, of an 8-bit sRGB code.
pub fn decode_u8(code: u8) -> f64 {
    decode(f64::from(code) / 255.0)
}
