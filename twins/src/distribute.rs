//! Distribution of a list's locations over tiles and cells.

/// Width and height of a tile in pixels.
const TILE: [i32; 2] = [8, 4];
/// Largest distance of a sample from its location's pixel, in pixels.
const FARTHEST: f32 = 1_048_576.0;

/// A sampling location.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedLocation {
    /// Column and row of the pixel in which it lies.
    pub pixel: [i32; 2],
    /// Place within the pixel, from 0 to 1.
    pub within: [f32; 2],
    /// Changes of x and y to the next column and to the next row of the output.
    pub jacobian: [[f32; 2]; 2],
}

/// Region over which a list is distributed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ListBounds {
    /// Width and height in tiles.
    pub tiles: [u32; 2],
    /// Whether locations are sampled once each, so that they have no extent.
    pub points: bool,
}

impl PlacedLocation {
    /// Half of the width and height of the area over which the samples spread.
    fn half_extent(&self, points: bool) -> [f32; 2] {
        let [[a, b], [c, d]] = self.jacobian;
        if points { [0.0; 2] } else { [0.5 * (a.abs() + c.abs()), 0.5 * (b.abs() + d.abs())] }
    }

    /// Place relative to the centre of its tile, in pixels.
    #[must_use]
    pub fn place_in_tile(&self) -> [f32; 2] {
        [0, 1].map(|axis| {
            let pixel = self.pixel[axis].rem_euclid(TILE[axis]) - TILE[axis] / 2;
            pixel as f32 + self.within[axis]
        })
    }

    /// Position on a Morton curve over the pixels of its tile.
    #[must_use]
    pub fn place_on_curve(&self) -> u32 {
        let [x, y] = [0, 1].map(|axis| self.pixel[axis].rem_euclid(TILE[axis]) as u32);
        x & 1 | (y & 1) << 1 | (x & 2) << 1 | (y & 2) << 2 | (x & 4) << 2
    }
}

impl ListBounds {
    /// Index of the tile in which a location lies. `None` for a location that is left out: outside of the region, NaN,
    /// or with samples too far away.
    #[must_use]
    pub fn tile(&self, location: &PlacedLocation) -> Option<u32> {
        let extent = location.half_extent(self.points);
        let sound = location.within.iter().all(|v| (0.0..=1.0).contains(v))
            && extent.iter().all(|v| (0.0..=FARTHEST).contains(v));
        let [column, row] = [0, 1].map(|axis| location.pixel[axis].div_euclid(TILE[axis]));
        let inside = |tile: i32, axis: usize| (0..self.tiles[axis] as i32).contains(&tile);
        (sound && inside(column, 0) && inside(row, 1)).then(|| row as u32 * self.tiles[0] + column as u32)
    }

    /// Largest distance of a location's samples from the centre of its pixel, and at least half a pixel.
    #[must_use]
    pub fn reach(&self, location: &PlacedLocation) -> f32 {
        let extent = location.half_extent(self.points);
        let reach = |axis: usize| (location.within[axis] - 0.5).abs() + extent[axis];
        if self.points { 0.5 } else { reach(0).max(reach(1)).max(0.5) }
    }

    /// Smallest rectangle, relative to the centre of the tile, around the samples of some locations of a tile: lowest
    /// and highest corner.
    #[must_use]
    pub fn bounds(&self, locations: &[PlacedLocation]) -> [[f32; 2]; 2] {
        let mut bounds = [[f32::INFINITY; 2], [f32::NEG_INFINITY; 2]];
        for location in locations {
            let (at, extent) = (location.place_in_tile(), location.half_extent(self.points));
            for axis in 0..2 {
                bounds[0][axis] = bounds[0][axis].min(at[axis] - extent[axis]);
                bounds[1][axis] = bounds[1][axis].max(at[axis] + extent[axis]);
            }
        }
        bounds
    }
}
