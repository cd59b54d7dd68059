//! Locations into runs, tiles, cells and groups: what the sampling engine works through instead of an image's pixels.
//!
//! The plane is cut into regions on a fixed grid; regions without locations cost nothing. Within a region, locations are sorted
//! by tile of 8 x 4 pixels, and within a tile along a Morton curve, so that neighbours share a cell.

use super::LocationError;
use crate::camera::SampleLocation;
use crate::passes::Cells;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;

/// Tiles of a region: 2,048 x 2,048 pixels.
const REGION_TILES: [i64; 2] = [256, 512];
/// Pixels of a tile.
pub(super) const TILE: [i64; 2] = [8, 4];
/// Up to this many pixels locations share what positions are relative to, so that they see the same however they are cut
/// into runs, and what an image of their plane sees; beyond it 32-bit positions are finer from the middle of each window.
const COMPACT: f64 = 8192.0;
/// Factor on the reach of large cells, whose samples are rounded to 32 bits.
pub(super) const ROUNDING: f64 = 1.0 + 1.0 / 1_048_576.0;
/// Bits of a [`Sorted`] word: the index of a location, and above it the place in its tile, below the tile.
const INDEX_BITS: u32 = 31;
const PLACE_BITS: u32 = 16;

/// Locations in the order in which they are sampled.
pub(super) struct Partition<'a> {
    locations: &'a [SampleLocation],
    order: Vec<Sorted>,
    pub cells: Cells,
    /// What clip-space positions of all runs are relative to, if they lie close enough together.
    middle: Option<[f64; 2]>,
    regions: Vec<Region>,
}

/// A part of the order that lies in one region.
struct Region {
    range: Range<usize>,
    /// Its upper left tile.
    low: [i64; 2],
}

/// A location by what locations of a region are sorted by: its tile, its place there along a Morton curve, and its index in the
/// caller's list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Sorted(u64);

impl Sorted {
    /// The location's index in the caller's list.
    pub fn index(self) -> usize {
        (self.0 & ((1 << INDEX_BITS) - 1)) as usize
    }

    /// The tile within its region.
    fn tile(self) -> [i64; 2] {
        let tile = (self.0 >> (INDEX_BITS + PLACE_BITS)) as i64;
        [tile % REGION_TILES[0], tile / REGION_TILES[0]]
    }

    /// Whether two locations of a region lie in the same tile.
    pub fn shares_tile(self, other: Self) -> bool {
        self.tile() == other.tile()
    }
}

/// The part of the plane that a run's locations lie in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Window {
    /// Its upper left pixel.
    pub low: [i64; 2],
    /// Its size in tiles.
    pub tiles: [u32; 2],
    /// The place on the plane that clip-space positions are relative to, in pixels.
    pub middle: [f64; 2],
    /// The farthest that samples are from the centre of the pixel that holds their location.
    pub reach: f64,
}

impl Window {
    /// Tiles that it has.
    pub fn tile_count(&self) -> u32 {
        self.tiles[0] * self.tiles[1]
    }

    /// Its size in pixels.
    pub fn size(&self) -> [u32; 2] {
        [0, 1].map(|axis| self.tiles[axis] * TILE[axis] as u32)
    }
}

impl<'a> Partition<'a> {
    /// Sorts `locations`.
    ///
    /// # Errors
    /// The first location that is not finite or too far off the image.
    pub fn new(locations: &'a [SampleLocation], cells: Cells) -> Result<Self, LocationError> {
        if locations.is_empty() {
            return Err(LocationError::Empty);
        }
        if locations.len() > (1 << INDEX_BITS) - 1 {
            return Err(LocationError::TooMany {
                found: locations.len(),
            });
        }
        // Which one is found first depends on the threads.
        let offender = locations
            .par_iter()
            .enumerate()
            .filter_map(|(index, location)| {
                check(location, index, cells)
                    .err()
                    .map(|error| (index, error))
            })
            .min_by_key(|(index, _)| *index);
        if let Some((_, error)) = offender {
            return Err(error);
        }
        let keyed: Vec<(u64, Sorted)> = locations
            .par_iter()
            .enumerate()
            .map(|(index, location)| (region(location, cells), sorted(location, index)))
            .collect();
        let mut by_region: BTreeMap<u64, Vec<Sorted>> = BTreeMap::new();
        for part in keyed.chunk_by(|(a, _), (b, _)| a == b) {
            if let Some((region, _)) = part.first() {
                let members = by_region.entry(*region).or_default();
                members.extend(part.iter().map(|(_, sorted)| *sorted));
            }
        }
        let mut order: Vec<Sorted> = Vec::with_capacity(locations.len());
        let mut regions: Vec<Region> = Vec::new();
        for mut members in by_region.into_values() {
            members.par_sort_unstable();
            let low = members.first().map(|first| {
                let (tile, within) = (tile_of(&locations[first.index()]), first.tile());
                [0, 1].map(|axis| tile[axis] - within[axis])
            });
            regions.push(Region {
                range: order.len()..order.len() + members.len(),
                low: low.unwrap_or_default(),
            });
            order.append(&mut members);
        }
        let bounds = Bounds::of(locations.par_iter().map(tile_of));
        Ok(Self {
            order,
            middle: bounds.is_compact().then(|| bounds.middle()),
            locations,
            cells,
            regions,
        })
    }

    /// Runs of at most `longest` locations, each in one region.
    pub fn runs(&self, longest: usize) -> Vec<Range<usize>> {
        let longest = longest.max(1);
        let pieces = |region: &Region| {
            let end = region.range.end;
            let starts = region.range.clone().step_by(longest);
            starts.map(move |start| start..end.min(start + longest))
        };
        self.regions.iter().flat_map(pieces).collect()
    }

    /// The region of a place in the order.
    fn region(&self, place: usize) -> Option<&Region> {
        let next = self
            .regions
            .partition_point(|region| region.range.start <= place);
        self.regions.get(next.checked_sub(1)?)
    }

    /// A run in order.
    pub fn run(&self, run: &Range<usize>) -> &[Sorted] {
        self.order.get(run.clone()).unwrap_or(&[])
    }

    /// A location.
    ///
    /// # Panics
    /// If it is not one of the partition's.
    pub fn location(&self, sorted: Sorted) -> &SampleLocation {
        &self.locations[sorted.index()]
    }

    /// The window around a run.
    pub fn window(&self, run: &Range<usize>) -> Window {
        let low = self.region(run.start).map_or([0; 2], |region| region.low);
        let sorted = self.run(run).par_iter();
        let tile = |sorted: &Sorted| {
            let tile = sorted.tile();
            [0, 1].map(|axis| low[axis] + tile[axis])
        };
        let bounds = Bounds::of(sorted.clone().map(tile));
        let reach = |location: &SampleLocation| {
            let extent = half_extent(location, self.cells);
            let from_centre = location.uv.map(|v| (v - v.floor() - 0.5).abs());
            (from_centre[0] + extent[0]).max(from_centre[1] + extent[1])
        };
        let reach = if self.cells.are_points() {
            0.5
        } else {
            let reaches = sorted.map(|sorted| reach(self.location(*sorted)));
            reaches.reduce(|| 0.5, f64::max)
        };
        Window {
            low: bounds.low.map(|pixel| pixel as i64),
            tiles: bounds.tiles(),
            middle: self.middle.unwrap_or_else(|| bounds.middle()),
            reach: reach * ROUNDING,
        }
    }
}

/// A rectangle around tiles, in pixels of the plane.
struct Bounds {
    low: [f64; 2],
    high: [f64; 2],
}

impl Bounds {
    const NOTHING: Self = Self {
        low: [f64::INFINITY; 2],
        high: [f64::NEG_INFINITY; 2],
    };

    fn of(tiles: impl ParallelIterator<Item = [i64; 2]>) -> Self {
        let bounds = tiles.fold(|| Self::NOTHING, Self::with);
        bounds.reduce(|| Self::NOTHING, Self::and)
    }

    fn with(self, tile: [i64; 2]) -> Self {
        let corner = |beyond: i64| [0, 1].map(|axis| ((tile[axis] + beyond) * TILE[axis]) as f64);
        self.and(Self {
            low: corner(0),
            high: corner(1),
        })
    }

    fn and(self, other: Self) -> Self {
        Self {
            low: [0, 1].map(|axis| self.low[axis].min(other.low[axis])),
            high: [0, 1].map(|axis| self.high[axis].max(other.high[axis])),
        }
    }

    fn middle(&self) -> [f64; 2] {
        [0, 1].map(|axis| 0.5 * (self.low[axis] + self.high[axis]))
    }

    fn tiles(&self) -> [u32; 2] {
        [0, 1].map(|axis| ((self.high[axis] - self.low[axis]) / TILE[axis] as f64) as u32)
    }

    fn is_compact(&self) -> bool {
        (0..2).all(|axis| self.high[axis] - self.low[axis] <= COMPACT)
    }
}

/// The tile of the plane that a location lies in.
pub(super) fn tile_of(location: &SampleLocation) -> [i64; 2] {
    [0, 1].map(|axis| (location.uv[axis] / TILE[axis] as f64).floor() as i64)
}

/// Half of the width and height of the upright rectangle around a location's cell, in pixels; points have none.
pub(super) fn half_extent(location: &SampleLocation, cells: Cells) -> [f64; 2] {
    let [column, row] = location.jacobian;
    if cells.are_points() {
        [0.0; 2]
    } else {
        [0, 1].map(|axis| 0.5 * (column[axis].abs() + row[axis].abs()))
    }
}

fn check(location: &SampleLocation, index: usize, cells: Cells) -> Result<(), LocationError> {
    let [u, v] = location.uv;
    let jacobian = location.jacobian;
    let numbers = [u, v].into_iter().chain(jacobian.into_iter().flatten());
    if !numbers.into_iter().all(f64::is_finite) {
        return Err(LocationError::NotFinite {
            index,
            u,
            v,
            jacobian,
        });
    }
    let extent = half_extent(location, cells);
    if (0..2).any(|axis| location.uv[axis].abs() + extent[axis] > LocationError::FARTHEST) {
        return Err(LocationError::TooFar {
            index,
            u,
            v,
            half_width: extent[0],
            half_height: extent[1],
        });
    }
    Ok(())
}

/// A key of the region that a location is sampled in. Cells of about the same extent stay together, since the widest of a run
/// decides how many triangles are candidates in its tiles.
fn region(location: &SampleLocation, cells: Cells) -> u64 {
    let tile = tile_of(location);
    let region = [0, 1].map(|axis| tile[axis].div_euclid(REGION_TILES[axis]));
    let [width, height] = half_extent(location, cells);
    let extent = width.max(height);
    let level = if extent <= 1.0 {
        0
    } else {
        1 + (0.5 * extent.log2()) as u64
    };
    // Regions lie within 2^10 of the first one.
    let [column, row] = region.map(|index| (index + 1024) as u64 & 0x7ff);
    level << 22 | row << 11 | column
}

/// A location with what it is sorted by within its region.
fn sorted(location: &SampleLocation, index: usize) -> Sorted {
    let tile = tile_of(location);
    let in_region = [0, 1].map(|axis| tile[axis].rem_euclid(REGION_TILES[axis]) as u64);
    let [x, y] = [0, 1].map(|axis| {
        let place = location.uv[axis] / TILE[axis] as f64;
        ((place - place.floor()) * 256.0).min(255.0) as u64
    });
    let tile = in_region[1] << 8 | in_region[0];
    let place = spread(y) << 1 | spread(x);
    Sorted((tile << PLACE_BITS | place) << INDEX_BITS | index as u64)
}

/// The bits of a byte on every other place.
fn spread(v: u64) -> u64 {
    let v = (v | v << 4) & 0x0f0f;
    let v = (v | v << 2) & 0x3333;
    (v | v << 1) & 0x5555
}
