//! Growth: pixels that become superpixels because they contrast with a neighbouring superpixel.
//!
//! A feature that covers no pixel centre may show in the samples of a superpixel. Its neighbours then become
//! superpixels too, if they contrast with the superpixel. The comparison uses the colour at a neighbour's centre, and
//! the resolved colour of the superpixel.

use super::detect::{TILE_HEIGHT, TILE_WIDTH};

/// Superpixels that grow, as one word for each tile in the order of [`superpixels`](super::detect::superpixels). The
/// argument `superpixels` holds the existing ones, none of which grows again. `seen` holds the displayed colours of all
/// pixels' centres, and `resolved` the colours of superpixels. Both are RGBA, 8 bits each, red in the lowest byte, in
/// rows of `width` pixels. A channel must differ by more than `threshold` code values.
///
/// # Panics
/// If `seen` and `resolved` differ in length, or `superpixels` is too short for them.
pub fn grown(width: u32, seen: &[u32], resolved: &[u32], superpixels: &[u32], threshold: u8) -> Vec<u32> {
    assert_eq!(seen.len(), resolved.len());
    let height = seen.len() as u32 / width;
    let tiles_x = width.div_ceil(TILE_WIDTH);
    let word = |x: u32, y: u32| (y / TILE_HEIGHT * tiles_x + x / TILE_WIDTH) as usize;
    let bit = |x: u32, y: u32| 1 << (y % TILE_HEIGHT * TILE_WIDTH + x % TILE_WIDTH);
    let place = |x: u32, y: u32| (y * width + x) as usize;
    let mut mask = vec![0; superpixels.len()];
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
        if superpixels[word(x, y)] & bit(x, y) != 0 {
            continue;
        }
        let own = seen[place(x, y)].to_le_bytes();
        let contrasts = |nx: u32, ny: u32| {
            let pairs = own.into_iter().zip(resolved[place(nx, ny)].to_le_bytes());
            superpixels[word(nx, ny)] & bit(nx, ny) != 0 && pairs.into_iter().any(|(a, b)| a.abs_diff(b) > threshold)
        };
        let rows = y.saturating_sub(1)..(y + 2).min(height);
        let mut around = rows.flat_map(|ny| (x.saturating_sub(1)..(x + 2).min(width)).map(move |nx| (nx, ny)));
        if around.any(|(nx, ny)| contrasts(nx, ny)) {
            mask[word(x, y)] |= bit(x, y);
        }
    }
    mask
}
