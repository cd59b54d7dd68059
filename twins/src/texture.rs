//! Texture filtering over the footprint of a shaded place: the texture coordinates and the mipmap level that are read.

/// Largest number of places along the longer axis of a footprint at which a texture is read.
pub const MOST_IN_ROW: u32 = 8;

/// Length in texels up to which a whole pixel is read as one place.
const SMALL_FOOTPRINT: f64 = 0.5;

/// Places at which a texture is read, in rows along the longer axis of the footprint, and their mipmap level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probes {
    /// Number of places in a row, from 1.
    pub in_row: u32,
    /// Number of rows: 1 or 2.
    pub rows: u32,
    /// Mipmap level, before it is clamped to those that the texture has.
    pub level: i32,
    /// Texture coordinates of the first place.
    pub first: [f64; 2],
    /// Difference of texture coordinates from one place of a row to the next.
    pub along: [f64; 2],
    /// Difference of texture coordinates from one row to the next.
    pub across: [f64; 2],
    /// Distance to the nearest footprint with another count, level or axis, as the approximate fraction by which a side
    /// would have to change.
    pub margin: f64,
}

/// Places at which a texture of `size` texels is read around the texture coordinates `at`. `sides` are the changes of
/// the texture coordinates along the two sides of the footprint. `whole` says that the footprint is a pixel in which
/// nothing else is shaded.
///
/// The width of a texel is 0.58 (the root of 1/3) of the footprint's width, because a trilinear filter of such texels
/// has the same variance as a box of that width. A footprint that is more than 1.25 times as long as wide has two
/// places, one more than 2.25 times has three, and so on. If a footprint is longer than the largest number of places
/// can cover, its texels are larger. A whole pixel has twice as many places in each direction, with texels of half the
/// width, because the box is then approximated better.
#[must_use]
pub fn probes(size: [u32; 2], at: [f64; 2], sides: [[f64; 2]; 2], whole: bool) -> Probes {
    let texels = sides.map(|side| [0, 1].map(|axis| side[axis] * f64::from(size[axis])));
    let lengths = texels.map(|[u, v]| u.hypot(v));
    let [[a, b], [c, d]] = texels;
    let longer = usize::from(lengths[0] <= lengths[1]);
    let longest = lengths[longer];
    let width = (a * d - b * c).abs() / longest;
    let shares = if whole && longest > SMALL_FOOTPRINT { 2 } else { 1 };
    let ratio = longest / width.max(1.0);
    let in_row = (shares * (ratio - 0.25).ceil().max(1.0) as u32).min(MOST_IN_ROW);
    let share = longest / f64::from(in_row);
    let rows = if width > share { shares } else { 1 };
    let exact = (share.max(width / f64::from(rows)) / 3f64.sqrt()).log2();
    let level = exact.round();
    let boundary = (ratio - 0.25).round().clamp(1.0, f64::from(MOST_IN_ROW - 1)) + 0.25;
    let along = sides[longer].map(|change| change / f64::from(in_row));
    let across = sides[1 - longer].map(|change| change / f64::from(rows));
    let axes = if in_row * rows > 1 { lengths[1 - longer] / longest - 1.0 } else { 1.0 };
    let rows_change = if shares > 1 { width / share - 1.0 } else { 1.0 };
    let small = if whole { longest / SMALL_FOOTPRINT - 1.0 } else { 1.0 };
    let margins = [ratio / boundary - 1.0, 0.5 - (exact - level).abs(), axes, rows_change, small];
    let middle = |count: u32| 0.5 * f64::from(count - 1);
    Probes {
        in_row,
        rows,
        level: level as i32,
        first: [0, 1].map(|axis| at[axis] - along[axis] * middle(in_row) - across[axis] * middle(rows)),
        along,
        across,
        margin: margins.into_iter().map(f64::abs).fold(1.0, f64::min),
    }
}
