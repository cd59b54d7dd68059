//! Tiles: blocks of 8 x 4 pixels, whose masks of superpixels and of shadows are words with a bit for each pixel.

/// Width of a tile in pixels.
pub const WIDTH: u32 = 8;

/// Height of a tile in pixels.
pub const HEIGHT: u32 = 4;

/// Numbers of tiles that cover an image of `size` pixels, horizontally and vertically.
pub const fn tiles(size: [u32; 2]) -> [u32; 2] {
    [size[0].div_ceil(WIDTH), size[1].div_ceil(HEIGHT)]
}

/// Number of tiles that cover an image of `size` pixels.
pub const fn tile_count(size: [u32; 2]) -> u64 {
    let [columns, rows] = tiles(size);
    columns as u64 * rows as u64
}

/// Index of the tile of pixel (`x`, `y`) in an image of `width` pixels, and the pixel's bit in the tile's mask.
pub const fn mask_bit([x, y]: [u32; 2], width: u32) -> (usize, u32) {
    let [columns, _] = tiles([width, 0]);
    ((y / HEIGHT * columns + x / WIDTH) as usize, 1 << (y % HEIGHT * WIDTH + x % WIDTH))
}
