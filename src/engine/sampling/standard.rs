//! The regular grid, and the sample locations that graphics APIs define.

use super::pattern::PatternError;
use super::{Location, locate};

/// Name of the grid pattern.
pub(super) const GRID: &str = "grid";

/// Name of the rotated pattern.
pub(super) const ROTATED: &str = "rotated";

/// Standard sample locations (Vulkan 1.3, section 25.3, "Multisampling"), in sixteenths of a pixel from its top left
/// corner.
const STANDARD: [&[[u8; 2]]; 5] = [
    &[[8, 8]],
    &[[12, 12], [4, 4]],
    &[[6, 2], [14, 6], [2, 10], [10, 14]],
    &[[9, 5], [7, 11], [13, 9], [5, 3], [3, 13], [1, 7], [11, 15], [15, 1]],
    &[
        [9, 9],
        [7, 5],
        [5, 10],
        [12, 7],
        [3, 6],
        [10, 13],
        [13, 11],
        [11, 3],
        [6, 14],
        [8, 1],
        [4, 2],
        [2, 12],
        [0, 8],
        [15, 4],
        [14, 15],
        [1, 0],
    ],
];

/// Centres of the cells of a square grid with `count` cells.
pub(super) fn grid(count: u32) -> Result<Vec<Location>, PatternError> {
    let side = count.isqrt();
    if side * side != count {
        return Err(PatternError::CountUnavailable {
            pattern: GRID,
            count,
            available: vec![side * side, (side + 1) * (side + 1)],
        });
    }
    let centre = |index: u32| (f64::from(index) + 0.5) / f64::from(side);
    Ok((0..count).map(|index| locate(centre(index % side), centre(index / side))).collect())
}

/// Standard sample locations for `count` samples.
pub(super) fn rotated(count: u32) -> Result<Vec<Location>, PatternError> {
    let sixteenths =
        STANDARD.iter().find(|set| set.len() == count as usize).ok_or_else(|| PatternError::CountUnavailable {
            pattern: ROTATED,
            count,
            available: STANDARD.iter().map(|set| set.len() as u32).collect(),
        })?;
    Ok(sixteenths.iter().map(|xy| xy.map(|units| u16::from(units) << 12)).collect())
}
