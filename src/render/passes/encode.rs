//! encode: converts colours to the format of a host's image, or of an image file.

use crate::color::srgb;
use crate::engine::pipelines::{FrameLayout, Pass, Size};
use crate::engine::spirv::{self, ENCODE_THRESHOLD_WORDS, ENCODE_THRESHOLDS};
use crate::vulkan::{Specialized, VulkanError};
use ash::vk;
use std::sync::LazyLock;

/// Formats of a host's image, or of an image file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// sRGB-encoded, premultiplied: `R8G8B8A8_UNORM` or `R8G8B8A8_SRGB`.
    Rgba8,
    /// sRGB-encoded, with straight alpha, as in image files. The codes are those that [`color::srgb`](crate::color::srgb) has for
    /// the colour divided by alpha; pixels whose alpha has code 0 are 0.
    StraightRgba8,
    /// Linear, premultiplied: `R16G16B16A16_SFLOAT`.
    Rgba16Float,
    /// Linear, premultiplied: `R32G32B32A32_SFLOAT`; needs no conversion.
    Rgba32Float,
}

impl Encoding {
    /// Encoding for a Vulkan format, if it is supported.
    #[must_use]
    pub fn of(format: vk::Format) -> Option<Self> {
        match format {
            vk::Format::R8G8B8A8_UNORM | vk::Format::R8G8B8A8_SRGB => Some(Self::Rgba8),
            vk::Format::R16G16B16A16_SFLOAT => Some(Self::Rgba16Float),
            vk::Format::R32G32B32A32_SFLOAT => Some(Self::Rgba32Float),
            _ => None,
        }
    }

    /// Bytes of a pixel in the buffer that the pass writes; 0 where none is needed.
    pub(crate) fn encoded_bytes(self) -> u64 {
        match self {
            Self::Rgba8 | Self::StraightRgba8 => 4,
            Self::Rgba16Float => 8,
            Self::Rgba32Float => 0,
        }
    }
}

/// Place of the first pixel in the buffer that the pass writes, in bytes. The thresholds lie before it.
pub(crate) const FIRST_PIXEL: u64 = 4 * ENCODE_THRESHOLD_WORDS as u64;

/// Converts the colours of a region's pixels.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(layout: &FrameLayout, encoding: Encoding) -> Result<Pass, VulkanError> {
    let format = match encoding {
        Encoding::Rgba16Float => spirv::ENCODE_RGBA16F,
        Encoding::StraightRgba8 => spirv::ENCODE_STRAIGHT_RGBA8,
        Encoding::Rgba8 | Encoding::Rgba32Float => spirv::ENCODE_RGBA8_SRGB,
    };
    let encode = layout.kernel(&spirv::Encode { format })?;
    let dispatch = encode.dispatch((), Size::Items(1));
    Ok(Pass::named(spirv::Encode::INTERFACE).dispatch(dispatch))
}

/// What the pass reads for [`Encoding::StraightRgba8`]: two words for each threshold, those of colours before those of alpha.
///
/// The quotient of two floats has code k or more if it reaches threshold k - 1. The quotient is a fraction of two numbers of 24
/// bits, times a power of two. So is each threshold: it is the smallest such fraction with this code. Products of 24 and 25 bits
/// then decide exactly, in integers.
pub(crate) fn thresholds() -> &'static [[u32; 2]] {
    static THRESHOLDS: LazyLock<Vec<[u32; 2]>> = LazyLock::new(|| {
        let codes = 1..=ENCODE_THRESHOLDS as u8;
        let colors = codes.clone().map(|code| {
            let linear = srgb::decode((f64::from(code) - 0.5) / 255.0);
            let power = -linear.log2().floor() as i32;
            let fraction = |[n, d]: [u32; 2]| f64::from(n) / f64::from(d);
            let unit = 2.0_f64.powi(-power);
            let [_, reached] = around(|f| srgb::encode_u8(fraction(f) * unit) >= code);
            word(reached, power as u32)
        });
        // Alpha's code is the nearest one to 255 times alpha.
        let alphas = codes.map(|code| {
            let halves = 2 * u32::from(code) - 1;
            let power = 510_u32.div_ceil(halves).next_power_of_two().ilog2();
            word([halves << power, 510], power)
        });
        colors.chain(alphas).collect()
    });
    &THRESHOLDS
}

/// Words of a threshold: a fraction divided by a power of two.
fn word([numerator, denominator]: [u32; 2], power: u32) -> [u32; 2] {
    [power << 28 | numerator, denominator]
}

/// The largest fraction between 1 and 2 that does not reach a threshold, and the smallest one that does, among those whose
/// numerator has up to 25 bits and whose denominator has up to 24 bits. 1 does not reach the threshold, and 2 does. The search
/// walks the Stern-Brocot tree, in steps as long as possible.
fn around(reaches: impl Fn([u32; 2]) -> bool) -> [[u32; 2]; 2] {
    const MOST: [u32; 2] = [(1 << 25) - 2, (1 << 24) - 1];
    let (mut below, mut above) = ([1, 1], [2, 1]);
    // The furthest place from `from` towards `to` for which the answer is still that for `from`.
    let walk = |from: [u32; 2], to: [u32; 2], answer: bool| {
        let place = |steps: u32| [0, 1].map(|i| from[i] + steps * to[i]);
        let room = [0, 1].map(|i| (MOST[i] - from[i]) / to[i]);
        let (mut least, mut most) = (0, room[0].min(room[1]));
        while least < most {
            let middle = most - (most - least) / 2;
            if reaches(place(middle)) == answer {
                least = middle;
            } else {
                most = middle - 1;
            }
        }
        place(least)
    };
    loop {
        let before = [below, above];
        below = walk(below, above, false);
        above = walk(above, below, true);
        if [below, above] == before {
            return before;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::random::Random;
    use crate::vulkan::PassTime;

    /// Times leave out the pass by its name.
    #[test]
    fn the_pass_has_the_name_of_its_time() {
        assert_eq!(spirv::Encode::INTERFACE.name, PassTime::ENCODE);
    }

    /// The twin of `reaches` in `shaders/encode.comp`.
    fn reaches(dividend: f32, divisor: f32, [numerator, denominator]: [u32; 2]) -> bool {
        let [a, b] = [dividend, divisor].map(f32::to_bits);
        let exponent = |bits: u32| (bits >> 23) as i32;
        let power = exponent(a) - exponent(b) + (numerator >> 28) as i32;
        if power.abs() > 1 {
            return power > 0;
        }
        let mantissa = |bits: u32| u64::from(bits & 0x7f_ffff | 0x80_0000);
        let left = mantissa(a) * u64::from(denominator);
        let right = mantissa(b) * u64::from(numerator & 0xfff_ffff);
        left << u32::from(power > 0) >= right << u32::from(power < 0)
    }

    /// Number of thresholds that a quotient reaches.
    fn code(dividend: f32, divisor: f32, thresholds: &[[u32; 2]]) -> u8 {
        let reached = thresholds.iter().filter(|t| reaches(dividend, divisor, **t));
        reached.count() as u8
    }

    fn exact(dividend: f32, divisor: f32) -> u8 {
        srgb::encode_u8(f64::from(dividend) / f64::from(divisor))
    }

    #[test]
    fn codes_are_those_of_double_precision() {
        let (colors, alphas) = thresholds().split_at(ENCODE_THRESHOLDS as usize);
        assert_eq!(colors.len(), alphas.len());
        for threshold in thresholds() {
            let numerator = threshold[0] & 0xfff_ffff;
            assert!((threshold[1]..2 * threshold[1]).contains(&numerator));
        }
        let mut random = Random::new(7);
        let check = |dividend: f32, divisor: f32| {
            assert_eq!(code(dividend, divisor, colors), exact(dividend, divisor), "{dividend} / {divisor}");
        };
        for extreme in [f32::MIN_POSITIVE, 1e-30, 0.003_130_8, 1.0, 7.0, f32::MAX] {
            check(extreme, 1.0);
            check(extreme, 0.25);
        }
        for index in 0..colors.len() {
            let linear = srgb::decode((index as f64 + 0.5) / 255.0);
            for _ in 0..200 {
                // Quotients on both sides of the threshold, as near as floats allow.
                let divisor = 0.002 + 1.1 * (random.below(1 << 24) as f32 * 2.0_f32.powi(-24));
                let near = (linear * f64::from(divisor)) as f32;
                for dividend in [near.next_down(), near, near.next_up()] {
                    check(dividend, divisor);
                }
            }
        }
        for index in 0..alphas.len() {
            let near = ((index as f64 + 0.5) / 255.0) as f32;
            for alpha in [near.next_down(), near, near.next_up()] {
                let expected = (f64::from(alpha).clamp(0.0, 1.0) * 255.0).round() as u8;
                assert_eq!(code(alpha, 1.0, alphas), expected, "{alpha}");
            }
        }
    }

    /// No fraction of two numbers of 24 bits lies between a threshold and the largest fraction below it.
    #[test]
    fn thresholds_leave_no_gap() {
        let [below, above] = around(|[n, d]| f64::from(n) / f64::from(d) >= 1.3);
        let product = |a: u32, b: u32| i64::from(a) * i64::from(b);
        assert_eq!(product(above[0], below[1]) - product(below[0], above[1]), 1);
        assert!(above[1] + below[1] > (1 << 24) - 1 || above[0] + below[0] > (1 << 25) - 2);
    }
}
