//! Detection: which pixels alias and become superpixels.
//!
//! A pixel is a superpixel if any of its 8 neighbours inside the image differs in colour; with [`Mode::Edges`], only
//! if that neighbour shows another surface too. With [`Mode::SecondDifferences`], a second difference of the colours
//! around it is enough. Two pixels show different surfaces if the IDs of their nearest opaque triangles differ, or the
//! IDs of their nearest blended triangles. Colours are compared as displayed, channel by channel and including alpha,
//! because alpha alone distinguishes a black object from a transparent background.

use thiserror::Error;

/// Width of a tile in pixels.
pub const TILE_WIDTH: u32 = 8;

/// Height of a tile in pixels.
pub const TILE_HEIGHT: u32 = 4;

/// Rule by which two neighbours contrast. Thresholds are in 8-bit code values of the displayed colour: a channel must
/// differ by more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Another colour, on any surface.
    Contrast(u8),
    /// Another surface with another colour.
    Edges(u8),
    /// Another surface with any colour.
    Exact,
    /// Another colour, or three pixels a, b, c of a row, a column or a diagonal of the 3 x 3 pixels around the pixel whose
    /// second difference |a - 2 b + c| exceeds the threshold. Beyond the image's edge its pixels are repeated.
    SecondDifferences(u8),
}

/// Image as detection reads it, rows from the top.
#[derive(Clone, Copy, Debug)]
pub struct DetectionImage<'a> {
    width: u32,
    height: u32,
    ids: &'a [u32],
    blend_ids: &'a [u32],
    colours: &'a [u32],
}

/// Error: a plane of an image whose length is not the number of pixels.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("the {plane} of a {width} x {height} image are {found} values; give one for each pixel")]
pub struct PlaneError {
    /// Name of the plane.
    pub plane: &'static str,
    /// Width of the image in pixels.
    pub width: u32,
    /// Height of the image in pixels.
    pub height: u32,
    /// Number of values in the plane.
    pub found: usize,
}

impl<'a> DetectionImage<'a> {
    /// Image of `width` x `height` pixels. For each pixel it has the ID of the nearest opaque or masked triangle, the
    /// ID of the nearest blended triangle (0 for none), and the displayed colour as RGBA, 8 bits each, red in the
    /// lowest byte.
    ///
    /// # Errors
    /// [`PlaneError`] if the length of a slice is not the number of pixels.
    pub fn new(
        width: u32,
        height: u32,
        ids: &'a [u32],
        blend_ids: &'a [u32],
        colours: &'a [u32],
    ) -> Result<Self, PlaneError> {
        for (plane, values) in [("triangle IDs", ids), ("blend IDs", blend_ids), ("colours", colours)] {
            if values.len() as u64 != u64::from(width) * u64::from(height) {
                return Err(PlaneError { plane, width, height, found: values.len() });
            }
        }
        Ok(Self { width, height, ids, blend_ids, colours })
    }

    /// Whether two pixels contrast; `a` and `b` are their indices.
    fn contrast(&self, a: usize, b: usize, mode: Mode) -> bool {
        let surface = || self.ids[a] != self.ids[b] || self.blend_ids[a] != self.blend_ids[b];
        let colour = |threshold: u8| {
            let channels = self.colours[a].to_le_bytes().into_iter();
            let mut pairs = channels.zip(self.colours[b].to_le_bytes());
            pairs.any(|(a, b)| a.abs_diff(b) > threshold)
        };
        match mode {
            Mode::Contrast(threshold) | Mode::SecondDifferences(threshold) => colour(threshold),
            Mode::Edges(threshold) => surface() && colour(threshold),
            Mode::Exact => surface(),
        }
    }

    /// Whether three pixels in a line among the 3 x 3 around a pixel have a second difference above a threshold.
    fn bends(&self, [x, y]: [u32; 2], threshold: u8) -> bool {
        const LINES: [[[i32; 2]; 3]; 8] = [
            [[-1, -1], [0, -1], [1, -1]],
            [[-1, 0], [0, 0], [1, 0]],
            [[-1, 1], [0, 1], [1, 1]],
            [[-1, -1], [-1, 0], [-1, 1]],
            [[0, -1], [0, 0], [0, 1]],
            [[1, -1], [1, 0], [1, 1]],
            [[-1, -1], [0, 0], [1, 1]],
            [[1, -1], [0, 0], [-1, 1]],
        ];
        let channels = |[dx, dy]: [i32; 2]| {
            let x = x.saturating_add_signed(dx).min(self.width - 1);
            let y = y.saturating_add_signed(dy).min(self.height - 1);
            let code = self.colours[y as usize * self.width as usize + x as usize];
            code.to_le_bytes().map(i32::from)
        };
        LINES.into_iter().any(|line| {
            let [a, b, c] = line.map(channels);
            (0..4).any(|i| (a[i] - 2 * b[i] + c[i]).abs() > i32::from(threshold))
        })
    }
}

/// Superpixels of an image: one word for each tile of [`TILE_WIDTH`] x [`TILE_HEIGHT`] pixels, tiles row by row,
/// ceil(width / 8) of them in a row. Pixel (x, y) is bit 8 (y mod 4) + x mod 8 of its tile's word. Bits outside the
/// image are 0.
pub fn superpixels(frame: &DetectionImage<'_>, mode: Mode) -> Vec<u32> {
    let tiles_x = frame.width.div_ceil(TILE_WIDTH);
    let tiles_y = frame.height.div_ceil(TILE_HEIGHT);
    let mut mask = vec![0; tiles_x as usize * tiles_y as usize];
    let place = |x: u32, y: u32| y as usize * frame.width as usize + x as usize;
    let mut mark = |x: u32, y: u32| {
        let tile = (y / TILE_HEIGHT) as usize * tiles_x as usize + (x / TILE_WIDTH) as usize;
        mask[tile] |= 1 << (y % TILE_HEIGHT * TILE_WIDTH + x % TILE_WIDTH);
    };
    // Each pair of neighbours is tested once, from its first pixel.
    for (y, x) in (0..frame.height).flat_map(|y| (0..frame.width).map(move |x| (y, x))) {
        for (dx, dy) in [(1, 0), (-1, 1), (0, 1), (1, 1)] {
            let Some(nx) = x.checked_add_signed(dx).filter(|&nx| nx < frame.width) else {
                continue;
            };
            let ny = y + dy;
            if ny < frame.height && frame.contrast(place(x, y), place(nx, ny), mode) {
                mark(x, y);
                mark(nx, ny);
            }
        }
        if let Mode::SecondDifferences(threshold) = mode
            && frame.bends([x, y], threshold)
        {
            mark(x, y);
        }
    }
    mask
}
