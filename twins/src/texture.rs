//! Texture filtering over the footprint of a shaded place: the texture coordinates and the mipmap level that are read.

/// Largest number of places along the longer axis of a footprint at which a texture is read.
pub const MOST_PROBES: u32 = 8;

/// Places at which a texture is read, and their mipmap level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probes {
    /// Number of places, from 1.
    pub count: u32,
    /// Mipmap level, before it is clamped to those that the texture has.
    pub level: i32,
    /// Texture coordinates of the first place.
    pub first: [f64; 2],
    /// Difference of texture coordinates from one place to the next.
    pub step: [f64; 2],
    /// Distance to the nearest footprint with another count, level or axis, as the approximate fraction by which a side
    /// would have to change.
    pub margin: f64,
}

/// Places at which a texture of `size` texels is read around the texture coordinates `at`. `sides` are the changes of
/// the texture coordinates along the two sides of the footprint.
///
/// The width of a texel is 0.58 (the root of 1/3) of the footprint's width, because a trilinear filter of such texels
/// has the same variance as a box of that width. A footprint that is more than 1.25 times as long as wide has two
/// places, one more than 2.25 times has three, and so on. If a footprint is longer than the largest number of places
/// can cover, its texels are larger.
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
    let boundary = (ratio - 0.25).round().clamp(1.0, f64::from(MOST_PROBES - 1)) + 0.25;
    let step = sides[longer].map(|change| change / f64::from(count));
    let axes = if count > 1 { lengths[1 - longer] / longest - 1.0 } else { 1.0 };
    let margins = [ratio / boundary - 1.0, 0.5 - (exact - level).abs(), axes];
    Probes {
        count,
        level: level as i32,
        first: [0, 1].map(|axis| at[axis] - step[axis] * 0.5 * f64::from(count - 1)),
        step,
        margin: margins.into_iter().map(f64::abs).fold(1.0, f64::min),
    }
}
