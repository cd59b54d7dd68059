//! Mipmap levels that an image file lacks.
//!
//! Mipmaps are computed on the host: devices that compute them with blits round differently, and CPU drivers compile
//! shaders for these blits at every start.

use crate::color::srgb;
use crate::scene::Image;
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::LazyLock;

/// All levels of an image down to a single texel, one after the other. `srgb` is true for colours, whose means are
/// computed in linear light; other values, and alpha, are averaged as they are.
pub(super) fn levels(image: &Image, srgb: bool) -> Cow<'_, [u8]> {
    let given = image.levels().count() as u32;
    if given == image.full_levels() {
        return Cow::Borrowed(&image.pixels);
    }
    let mut all = image.pixels.clone();
    let mut last = 0;
    for level in 1..image.full_levels() {
        let next = all.len();
        let half = halve::<4>(&all[last..], image.level_size(level - 1), srgb);
        all.extend(half);
        last = next;
    }
    Cow::Owned(all)
}

/// The next level of an image with `N` channels, the fourth of which is alpha: means of 2 x 2 texels, of 3 along an
/// odd side.
pub(super) fn halve<const N: usize>(level: &[u8], [width, height]: [u32; 2], srgb: bool) -> Vec<u8> {
    let half = [(width / 2).max(1), (height / 2).max(1)];
    let span = |i: u32, from: u32, to: u32| (i * from / to)..((i + 1) * from).div_ceil(to);
    let curve = srgb.then(|| &*CURVE);
    let row_bytes = N * half[0] as usize;
    let mut out = vec![0; row_bytes * half[1] as usize];
    let rows = out.par_chunks_mut(row_bytes).with_min_len(16);
    (0..half[1]).into_par_iter().zip(rows).for_each(|(y, row)| {
        for (x, texel) in (0..half[0]).zip(row.chunks_exact_mut(N)) {
            let (mut sums, mut count) = ([0; N], 0);
            for v in span(y, height, half[1]) {
                for u in span(x, width, half[0]) {
                    let from = N * (v * width + u) as usize;
                    for (channel, code) in level[from..from + N].iter().enumerate() {
                        sums[channel] += match curve {
                            Some(curve) if channel < 3 => curve.light[usize::from(*code)],
                            _ => u32::from(*code),
                        };
                    }
                    count += 1;
                }
            }
            for (channel, code) in texel.iter_mut().enumerate() {
                let mean = (sums[channel] + count / 2) / count;
                *code = match curve {
                    Some(curve) if channel < 3 => curve.code(mean),
                    _ => mean as u8,
                };
            }
        }
    });
    out
}

/// The sRGB transfer function and its inverse, for light in units of 2^-22.
struct Curve {
    light: [u32; 256],
    /// Smallest light of each code, and a last entry above the largest light.
    least: [u32; 257],
    /// Code at the start of each of 4,096 intervals of light. An interval contains at most one step to the next code.
    codes: [u8; 4097],
}

static CURVE: LazyLock<Curve> = LazyLock::new(Curve::new);

impl Curve {
    const UNIT: f64 = (1 << 22) as f64;
    /// Number of low bits of light that distinguish values within an interval.
    const REST: u32 = 10;

    fn new() -> Self {
        let light = std::array::from_fn(|code| {
            let light = srgb::decode_u8(code as u8);
            (light * Self::UNIT).round() as u32
        });
        let mut least = [u32::MAX; 257];
        for (code, least) in least.iter_mut().enumerate().take(256) {
            let light = srgb::decode((code as f64 - 0.5) / 255.0);
            *least = (light * Self::UNIT).ceil() as u32;
        }
        let codes = std::array::from_fn(|begins| {
            let reached = least.partition_point(|least| *least <= (begins as u32) << Self::REST);
            (reached - 1) as u8
        });
        Self { light, least, codes }
    }

    /// Nearest code of a light.
    fn code(&self, light: u32) -> u8 {
        let code = self.codes[(light >> Self::REST) as usize];
        code + u8::from(light >= self.least[usize::from(code) + 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halving_keeps_the_mean() {
        let level = halve::<1>(&[0, 100, 200, 100, 50, 250], [3, 2], false);
        assert_eq!(level, [117]);
    }

    #[test]
    fn colours_are_means_of_light_and_alpha_is_one_of_codes() {
        let texels = [[0, 0, 0, 0], [255, 100, 10, 100]].concat();
        let mean = |code| srgb::encode_u8(srgb::decode_u8(code) / 2.0);
        assert_eq!(halve::<4>(&texels, [2, 1], true), [mean(255), mean(100), mean(10), 50]);
        assert_eq!(halve::<4>(&texels, [2, 1], false), [128, 50, 5, 50]);
    }

    #[test]
    fn light_becomes_the_nearest_code() {
        for light in 0..=1 << 22 {
            let expected = srgb::encode(f64::from(light) / Curve::UNIT) * 255.0;
            let found = f64::from(CURVE.code(light));
            assert!((found - expected).abs() < 0.5 + 1e-4, "{light}: {found}, {expected}");
        }
        for code in 0..=255 {
            assert_eq!(CURVE.code(CURVE.light[usize::from(code)]), code);
        }
    }

    #[test]
    fn all_levels_are_made_unless_they_are_there() {
        let image = |pixels| Image { width: 5, height: 2, pixels };
        let bare = image(vec![200; 4 * 10]);
        let all = levels(&bare, true);
        assert_eq!(*all, vec![200; 4 * (10 + 2 + 1)]);
        let whole = image(all.to_vec());
        assert!(matches!(levels(&whole, true), Cow::Borrowed(pixels) if pixels == &*all));
    }
}
