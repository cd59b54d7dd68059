//! Spatial order of samples, common to all patterns.

use super::Location;

/// Possible sizes of the blocks of samples in a half, in descending order.
const BLOCKS: [usize; 5] = [256, 64, 16, 4, 1];

/// Sorts distinct locations into the order that the [module](super#order) describes.
pub(super) fn sort(locations: &mut [Location]) {
    halve(locations, [1.0, 1.0]);
}

/// Sorts the locations of a part of the pixel. `width` and `height` are the sides of this part for evenly spread
/// samples, instead of those of the samples' bounding box, so that the order does not depend on the places of a few
/// samples.
fn halve(locations: &mut [Location], [width, height]: [f64; 2]) {
    let count = locations.len();
    let Some(block) = BLOCKS.into_iter().find(|&block| block < count) else {
        return;
    };
    let first = block * (count.div_ceil(block) / 2).max(1);
    let share = first as f64 / count as f64;
    let sides = if width > height {
        locations.sort_unstable_by_key(|&[x, y]| (x, y));
        [[width * share, height], [width * (1.0 - share), height]]
    } else {
        locations.sort_unstable_by_key(|&[x, y]| (y, x));
        [[width, height * share], [width, height * (1.0 - share)]]
    };
    let (before, after) = locations.split_at_mut(first);
    halve(before, sides[0]);
    halve(after, sides[1]);
}
