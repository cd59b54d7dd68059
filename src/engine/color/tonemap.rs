//! Khronos PBR Neutral tone mapping (Khronos Group, "Khronos PBR Neutral Tone Mapper", 2024).
//!
//! Colours up to 0.76 only lose the 4 % that a dielectric reflects, so that base colours under neutral light stay
//! unchanged. Brighter colours are compressed below 1, and become less saturated as they approach it.

/// Brightness at which compression starts, after the reflection was subtracted.
const START: f64 = 0.8 - REFLECTION;

/// Reflection of a dielectric at normal incidence.
const REFLECTION: f64 = 0.04;

/// Rate at which bright colours lose saturation.
const DESATURATION: f64 = 0.15;

/// Display colour, linear and from 0 to below 1, of a scene-linear colour. Red, green and blue must be finite and not
/// negative.
pub fn neutral(colour: [f64; 3]) -> [f64; 3] {
    let darkest = colour.into_iter().fold(f64::INFINITY, f64::min);
    let offset = if darkest < 2.0 * REFLECTION { darkest - darkest * darkest / (4.0 * REFLECTION) } else { REFLECTION };
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
