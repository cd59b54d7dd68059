//! A run's locations as the device takes them: locations, cells of one or several of them, groups of cells, tiles.

use super::partition::{Partition, ROUNDING, Sorted, TILE, Window, half_extent, tile_of};
use crate::passes::LocationData;
use rayon::prelude::*;
use std::ops::Range;

/// Half of a cell's side beyond its samples, in pixels: covers the rounding of edge functions.
const SLACK: f64 = 1.0 / 64.0;

/// How locations share cells, and cells groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct CellSizes {
    /// Most locations of a cell.
    pub in_cell: usize,
    /// Most cells of a group.
    pub in_group: usize,
    /// Samples of a superpixel.
    pub samples: u32,
}

/// Where a location lies from the centre of its tile, and half of its cell's width and height.
type Place = ([f64; 2], [f64; 2]);

/// Tiles that a thread lays out at once.
const TILES_AT_ONCE: usize = 512;

impl Partition<'_> {
    /// A run's locations in its window. `words` are those of all locations in the caller's order, which
    /// `shaders/include/locations.glsl` describes; missing ones are 0.
    pub fn data(
        &self,
        run: &Range<usize>,
        window: &Window,
        sizes: &CellSizes,
        words: &[u32],
    ) -> LocationData {
        let tile_count = window.tiles[0] as usize * window.tiles[1] as usize;
        let mut data = LocationData {
            locations: Vec::with_capacity(run.len()),
            masks: vec![0; tile_count],
            loads: vec![[0; 2]; tile_count],
            ..LocationData::default()
        };
        let sorted = self.run(run);
        let tiles: Vec<&[Sorted]> = sorted.chunk_by(|a, b| a.shares_tile(*b)).collect();
        let parts = tiles.par_chunks(TILES_AT_ONCE).map(|tiles| {
            let mut part = Part::default();
            for locations in tiles {
                self.lay_out(locations, window, (sizes, words), &mut part);
            }
            part
        });
        for part in parts.collect::<Vec<_>>() {
            data.append(part);
        }
        data
    }

    /// Adds the locations of a tile.
    fn lay_out(
        &self,
        sorted: &[Sorted],
        window: &Window,
        (sizes, words): (&CellSizes, &[u32]),
        part: &mut Part,
    ) {
        let Some(tile) = sorted.first().map(|first| tile_of(self.location(*first))) else {
            return;
        };
        let [column, row] = [0, 1].map(|axis| (tile[axis] - window.low[axis] / TILE[axis]) as u32);
        let index = row * window.tiles[0] + column;
        let corner = [0, 1].map(|axis| (tile[axis] * TILE[axis]) as f64);
        let mut places = std::mem::take(&mut part.places);
        places.clear();
        let mut mask = 0;
        for sorted in sorted {
            let location = self.location(*sorted);
            let [x, y] = [0, 1].map(|axis| location.uv[axis] - corner[axis]);
            // A place just before the far side may be rounded onto it.
            let pixel = [x.min(7.0) as u32, y.min(3.0) as u32];
            mask |= 1 << (8 * pixel[1] + pixel[0]);
            let place = [x - 4.0, y - 2.0].map(|v| f64::from(v as f32));
            let [u, v] = location.jacobian;
            let word = words.get(sorted.index()).copied().unwrap_or(0);
            part.data.locations.push([
                [bits(place[0]), bits(place[1]), index, word],
                [bits(u[0]), bits(u[1]), bits(v[0]), bits(v[1])],
            ]);
            places.push((place, half_extent(location, self.cells)));
        }
        let cells = part.data.push_cells(index, &places, sizes);
        let samples = if self.cells.are_points() {
            places.len() as u32
        } else {
            cells.saturating_mul(sizes.samples)
        };
        part.tiles.push((index, mask, [cells, samples]));
        part.places = places;
    }
}

/// What one thread lays out: some tiles of a run, whose locations and cells count from 0.
#[derive(Default)]
struct Part {
    /// Without masks and loads.
    data: LocationData,
    /// Index, mask and load of each tile.
    tiles: Vec<(u32, u32, [u32; 2])>,
    /// Memory that one tile after another uses.
    places: Vec<Place>,
}

impl LocationData {
    /// Adds the tiles that follow.
    fn append(&mut self, part: Part) {
        let [locations, cells] = [self.locations.len(), self.cells.len()].map(|count| count as u32);
        self.locations.extend_from_slice(&part.data.locations);
        let moved = |[middle, [first, count, ..]]: [[u32; 4]; 2]| {
            [middle, [first + locations, count, 0, 0]]
        };
        self.cells.extend(part.data.cells.into_iter().map(moved));
        let moved = |[tile, first, count, number]: [u32; 4]| [tile, first + cells, count, number];
        self.groups.extend(part.data.groups.into_iter().map(moved));
        for (tile, mask, load) in part.tiles {
            if let (Some(word), Some(sum)) = (
                self.masks.get_mut(tile as usize),
                self.loads.get_mut(tile as usize),
            ) {
                (*word, *sum) = (mask, load);
            }
        }
    }

    /// Makes the cells and groups of the last locations, those of a tile, and returns how many cells they are.
    fn push_cells(&mut self, tile: u32, places: &[Place], sizes: &CellSizes) -> u32 {
        let mut first_location = self.locations.len() - places.len();
        let mut in_tile = 0;
        for members in places.chunks(sizes.in_cell.max(1)) {
            let mut low = [f64::INFINITY; 2];
            let mut high = [f64::NEG_INFINITY; 2];
            for (place, extent) in members {
                for axis in 0..2 {
                    low[axis] = low[axis].min(place[axis] - extent[axis]);
                    high[axis] = high[axis].max(place[axis] + extent[axis]);
                }
            }
            // A lone location is the middle itself, to the bit.
            let middle = match members {
                [(place, _)] => *place,
                _ => [0, 1].map(|axis| 0.5 * (low[axis] + high[axis])),
            };
            let half = [0, 1].map(|axis| 0.5 * (high[axis] - low[axis]) * ROUNDING + SLACK);
            match self.groups.last_mut() {
                Some(group) if in_tile > 0 && (group[2] as usize) < sizes.in_group => group[2] += 1,
                _ => {
                    let first_cell = self.cells.len() as u32;
                    self.groups.push([tile, first_cell, 1, in_tile]);
                }
            }
            let [x, y] = middle.map(bits);
            let [width, height] = half.map(bits);
            let count = members.len();
            self.cells.push([
                [x, y, width, height],
                [first_location as u32, count as u32, 0, 0],
            ]);
            first_location += count;
            in_tile += 1;
        }
        in_tile
    }
}

fn bits(v: f64) -> u32 {
    (v as f32).to_bits()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::SampleLocation;
    use crate::passes::Cells;

    fn location(uv: [f64; 2]) -> SampleLocation {
        SampleLocation {
            uv,
            jacobian: [[2.0, 0.0], [0.0, 1.0]],
            output: 0,
        }
    }

    const SIZES: CellSizes = CellSizes {
        in_cell: 3,
        in_group: 2,
        samples: 16,
    };

    #[test]
    fn tiles_cells_and_groups_hold_every_location_once() {
        // Seven locations in one tile, one in the next, one left of the plane's corner by less than 64 bits resolve.
        let mut locations: Vec<SampleLocation> = (0..7)
            .map(|i| location([f64::from(i) + 0.5, 3.5]))
            .collect();
        locations.extend([location([9.0, 0.0]), location([-1e-20, 0.0])]);
        for (cells, expected) in [
            (Cells::Points, [[1, 1], [3, 7], [1, 1]]),
            (Cells::Superpixels, [[1, 16], [7, 112], [1, 16]]),
        ] {
            let sizes = CellSizes {
                in_cell: if cells == Cells::Points { 3 } else { 1 },
                ..SIZES
            };
            let partition = Partition::new(&locations, cells).unwrap();
            // The region left of the corner is one of its own.
            let runs = partition.runs(100);
            assert_eq!(runs.len(), 2);
            let windows: Vec<_> = runs.iter().map(|run| partition.window(run)).collect();
            let data: Vec<_> = runs
                .iter()
                .zip(&windows)
                .map(|(run, window)| partition.data(run, window, &sizes, &[]))
                .collect();
            let loads: Vec<_> = data.iter().flat_map(|data| data.loads.clone()).collect();
            assert_eq!(loads, expected);
            let masks: Vec<_> = data.iter().flat_map(|data| data.masks.clone()).collect();
            assert_eq!(masks, [1 << 7, 0x7f00_0000, 1 << 1]);
            assert_eq!(windows[0].low, [-8, 0]);
            assert_eq!(windows[1].tiles, [2, 1]);
            let mut seen = vec![0; locations.len()];
            for sorted in partition.run(&(0..locations.len())) {
                seen[sorted.index()] += 1;
            }
            assert_eq!(seen, [1; 9]);
            for data in &data {
                let grouped: u32 = data.groups.iter().map(|group| group[2]).sum();
                assert_eq!(grouped as usize, data.cells.len());
                assert!(data.groups.iter().all(|group| group[2] <= 2));
                let held: u32 = data.cells.iter().map(|[_, [_, count, ..]]| count).sum();
                assert_eq!(held as usize, data.locations.len());
            }
            let reach = windows[1].reach;
            let expected = if cells == Cells::Points { 0.5 } else { 1.5 };
            assert!((reach - expected).abs() < 1e-4, "{reach}");
        }
    }
}
