//! Where a texture is read for a place that is shaded, so that it is averaged over the place's footprint.

/// At how many places a texture is read along the longer axis of a footprint, at the most.
pub const MOST_PROBES: u32 = 8;

/// The places, and the mipmap level that is read there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probes {
    /// Number of places, from 1.
    pub count: u32,
    /// Mipmap level, before it is clamped to those that the texture has.
    pub level: i32,
    /// Texture coordinates of the first place.
    pub first: [f64; 2],
    /// What leads from a place to the next one.
    pub step: [f64; 2],
    /// How far the footprint is from one with another count, level or axis: about the share by which a side of it would
    /// have to change.
    pub margin: f64,
}

/// Where a texture of `size` texels is read around the texture coordinates `at`, whose changes along the two sides of the
/// footprint are `sides`.
///
/// The texels have 0.58 (the root of 1/3) of the footprint's width, as a trilinear filter of such texels has the variance of a box of
/// that width. There are two places where the footprint is more than 1.25 times as long as wide, three where it is more than 2.25
/// times, and so on. Where it is longer than the most places make up for, the texels are wider than the footprint.
#[must_use]
pub fn probes(size: [u32; 2], at: [f64; 2], sides: [[f64; 2]; 2]) -> Probes {
    let texels = sides.map(|side| [0, 1].map(|axis| side[axis] * f64::from(size[axis])));
    let lengths = texels.map(|[u, v]| u.hypot(v));
    let [[a, b], [c, d]] = texels;
    let longer = usize::from(lengths[0] <= lengths[1]);
    let longest = lengths[longer];
    let across = (a * d - b * c).abs() / longest;
    let ratio = longest / across.max(1.0);
    let count = ((ratio - 0.25).ceil().max(1.0) as u32).min(MOST_PROBES);
    let exact = (across.max(longest / f64::from(count)) / 3f64.sqrt()).log2();
    let level = exact.round();
    let boundary = (ratio - 0.25)
        .round()
        .clamp(1.0, f64::from(MOST_PROBES - 1))
        + 0.25;
    let step = sides[longer].map(|change| change / f64::from(count));
    let axes = if count > 1 {
        lengths[1 - longer] / longest - 1.0
    } else {
        1.0
    };
    let margins = [ratio / boundary - 1.0, 0.5 - (exact - level).abs(), axes];
    Probes {
        count,
        level: level as i32,
        first: [0, 1].map(|axis| at[axis] - step[axis] * 0.5 * f64::from(count - 1)),
        step,
        margin: margins.into_iter().map(f64::abs).fold(1.0, f64::min),
    }
}
