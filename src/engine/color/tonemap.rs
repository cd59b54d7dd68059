//! Khronos PBR Neutral tone mapping (Khronos Group, "Khronos PBR Neutral Tone Mapper", 2024).
//!
//! Base colours under neutral light come through unchanged up to 0.76, less the 4 % that a dielectric reflects; what
//! is brighter is compressed below 1 and bleached as it gets there.

/// Brightness at which compression starts, after the reflection is taken off.
const START: f64 = 0.8 - REFLECTION;

/// Reflection of a dielectric at normal incidence.
const REFLECTION: f64 = 0.04;

/// How quickly bright colours bleach.
const DESATURATION: f64 = 0.15;

/// The displayed colour, linear, 0 to below 1, of a scene-linear colour: red, green and blue, finite, 0 or more.
pub fn neutral(colour: [f64; 3]) -> [f64; 3] {
    let darkest = colour.into_iter().fold(f64::INFINITY, f64::min);
    let offset = if darkest < 2.0 * REFLECTION {
        darkest - darkest * darkest / (4.0 * REFLECTION)
    } else {
        REFLECTION
    };
    let colour = colour.map(|channel| channel - offset);
    let peak = colour.into_iter().fold(0.0, f64::max);
    if peak < START {
        return colour;
    }
    let room = 1.0 - START;
    let compressed = 1.0 - room * room / (peak + room - START);
    let bleach = 1.0 - 1.0 / (DESATURATION * (peak - compressed) + 1.0);
    colour.map(|channel| {
        let scaled = channel * compressed / peak;
        scaled + (compressed - scaled) * bleach
    })
}
