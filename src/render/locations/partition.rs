//! Partition of locations into regions of the plane and into runs, which are sampled at once. The device sorts a run's
//! locations by tile.
//!
//! Regions form a fixed grid on the plane; regions without locations cost nothing.

use super::LocationError;
use crate::camera::SampleLocation;
use crate::engine::data::{Cells, ListedLocation};
use crate::render::plane::{PlaneWindow, TILE};
use crate::render::shadows::Rectangle;
use glam::DVec2;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;

/// Tiles of a region along both axes: 2,048 x 2,048 pixels.
const REGION_TILES: [i64; 2] = [256, 512];
/// Largest extent of all locations, in pixels, for which positions of all runs are relative to the same point. Results
/// then don't depend on how locations are cut into runs, and equal those of an image. For larger extents, 32-bit
/// positions are more precise relative to the middle of each window.
const COMPACT: f64 = 8192.0;
/// Number of locations of a chunk of a list.
const CHUNK: usize = 4096;
/// Ratio of the chunks' summed areas to the whole area above which a list counts as unordered, so that runs don't
/// follow its order.
const SCATTERED: f64 = 32.0;
/// Largest number of locations of a list.
const MOST: usize = (1 << 31) - 1;

/// Locations, in the order in which they are sampled.
pub(super) struct Partition<'a> {
    locations: &'a [SampleLocation],
    /// Indices of the locations in sampling order; `None` for the caller's order.
    order: Option<Vec<u32>>,
    pub cells: Cells,
    /// Point to which clip-space positions of all runs are relative; `None` if the locations are too far apart.
    middle: Option<[f64; 2]>,
    /// Bounds of each chunk of the order; `None` if there are several regions.
    chunks: Option<Vec<Bounds>>,
    /// Ranges of the order, one for each region.
    regions: Vec<Range<usize>>,
}

impl<'a> Partition<'a> {
    /// Partitions `locations`.
    ///
    /// # Errors
    /// [`LocationError`] about the first location that is not finite or too far off the image.
    pub fn new(locations: &'a [SampleLocation], cells: Cells) -> Result<Self, LocationError> {
        if locations.is_empty() {
            return Err(LocationError::Empty);
        }
        if locations.len() > MOST {
            return Err(LocationError::TooMany { found: locations.len() });
        }
        let surveys: Vec<Survey> = locations
            .par_chunks(CHUNK)
            .enumerate()
            .map(|(chunk, locations)| {
                let numbered = (chunk * CHUNK..).zip(locations);
                numbered.fold(Survey::NOTHING, |survey, (index, location)| survey.with(index, location, cells))
            })
            .collect();
        let survey = surveys.iter().copied().fold(Survey::NOTHING, Survey::and);
        if let Some(first) = survey.offender {
            check(&locations[first], first, cells)?;
        }
        let bounds = survey.bounds;
        let chunks: Vec<Bounds> = surveys.iter().map(|survey| survey.bounds).collect();
        let area: f64 = chunks.iter().map(Bounds::area).sum();
        let all = 0..locations.len();
        let (order, chunks, regions) = if survey.regions[0] != survey.regions[1] {
            let (order, regions) = by_region(locations, cells);
            (Some(order), None, regions)
        } else if area > SCATTERED * bounds.area() {
            let (order, chunks) = by_tile(locations, &bounds);
            (Some(order), Some(chunks), vec![all])
        } else {
            (None, Some(chunks), vec![all])
        };
        Ok(Self { order, middle: bounds.is_compact().then(|| bounds.middle()), chunks, locations, cells, regions })
    }

    /// Number of places on the plane for which lights are looked up: one for a point, up to eight in a superpixel.
    pub fn places(&self) -> u64 {
        let in_cell = if self.cells.are_points() { 1 } else { 8 };
        self.locations.len() as u64 * in_cell
    }

    /// Runs of at most `longest` locations each, within one region.
    pub fn runs(&self, longest: usize) -> Vec<Range<usize>> {
        let longest = longest.max(1);
        let pieces = |region: &Range<usize>| {
            let end = region.end;
            let starts = region.clone().step_by(longest);
            starts.map(move |start| start..end.min(start + longest))
        };
        self.regions.iter().flat_map(pieces).collect()
    }

    /// Index in the caller's list of the location at position `place` of the order.
    pub fn index(&self, place: usize) -> usize {
        self.order.as_ref().map_or(place, |order| order[place] as usize)
    }

    /// Location at position `place` of the order.
    ///
    /// # Panics
    /// If there is no such position.
    pub fn location(&self, place: usize) -> &SampleLocation {
        &self.locations[self.index(place)]
    }

    /// Stores the values of a run at the positions of its locations in the caller's list; values start with the run's
    /// first location. Runs must be stored in order.
    pub fn put<T: Clone + Default + Send>(
        &self,
        run: &Range<usize>,
        values: &mut Vec<T>,
        value: impl Fn(usize) -> T + Send + Sync,
    ) {
        match &self.order {
            None => values.par_extend((0..run.len()).into_par_iter().map(value)),
            Some(order) => {
                values.resize(order.len(), T::default());
                for (i, index) in order[run.clone()].iter().enumerate() {
                    values[*index as usize] = value(i);
                }
            }
        }
    }

    /// Writes a run's locations in the format of the device, in pixels of its window.
    pub fn list(&self, run: &Range<usize>, window: &PlaneWindow, to: &mut [ListedLocation]) {
        to.par_iter_mut().enumerate().for_each(|(i, listed)| {
            let SampleLocation { uv, jacobian, .. } = self.location(run.start + i);
            let floor = uv.map(f64::floor);
            let [[a, b], [c, d]] = jacobian.map(|column| column.map(|v| v as f32));
            *listed = ListedLocation {
                pixel: [0, 1].map(|axis| (floor[axis] as i64 - window.low[axis]) as i32),
                within: [0, 1].map(|axis| (uv[axis] - floor[axis]) as f32),
                jacobian: [[a, b], [c, d]],
            };
        });
    }

    /// Rectangle of the plane that holds all locations, and the largest distance of a sample from its location along
    /// either axis, in pixels.
    pub fn reach(&self) -> (Rectangle, f64) {
        type Reach = (Rectangle, f64);
        let around = |location: &SampleLocation| {
            let at = DVec2::from_array(location.uv);
            let [x, y] = half_extent(location, self.cells);
            ([at; 2], x.max(y))
        };
        let both = |([a, b], e): Reach, ([c, d], f): Reach| ([a.min(c), b.max(d)], e.max(f));
        let nothing = || ([DVec2::INFINITY, DVec2::NEG_INFINITY], 0.0);
        self.locations.par_iter().map(around).reduce(nothing, both)
    }

    /// Window that holds the locations of a run.
    pub fn window(&self, run: &Range<usize>) -> PlaneWindow {
        let bounds = match &self.chunks {
            Some(chunks) => {
                let of_run = run.start / CHUNK..run.end.div_ceil(CHUNK);
                let all = chunks[of_run].iter().copied();
                all.fold(Bounds::NOTHING, Bounds::and)
            }
            None => {
                let places = run.clone().into_par_iter();
                Bounds::of(places.map(|place| tile_of(self.location(place))))
            }
        };
        PlaneWindow {
            low: bounds.low.map(|pixel| pixel as i64),
            tiles: bounds.tiles(),
            middle: self.middle.unwrap_or_else(|| bounds.middle()),
        }
    }
}

/// Facts about a list of locations.
#[derive(Clone, Copy)]
struct Survey {
    /// Index of the first location that can't be sampled.
    offender: Option<usize>,
    bounds: Bounds,
    /// Smallest and largest key of a region.
    regions: [u64; 2],
}

impl Survey {
    const NOTHING: Self = Self { offender: None, bounds: Bounds::NOTHING, regions: [u64::MAX, 0] };

    fn with(self, index: usize, location: &SampleLocation, cells: Cells) -> Self {
        if check(location, index, cells).is_err() {
            let first = self.offender.unwrap_or(index).min(index);
            return Self { offender: Some(first), ..self };
        }
        let key = region(location, cells);
        Self {
            bounds: self.bounds.with(tile_of(location)),
            regions: [self.regions[0].min(key), self.regions[1].max(key)],
            ..self
        }
    }

    fn and(self, other: Self) -> Self {
        Self {
            offender: self.offender.into_iter().chain(other.offender).min(),
            bounds: self.bounds.and(other.bounds),
            regions: [self.regions[0].min(other.regions[0]), self.regions[1].max(other.regions[1])],
        }
    }
}

/// Indices of the locations, sorted by region, and the range of each region.
fn by_region(locations: &[SampleLocation], cells: Cells) -> (Vec<u32>, Vec<Range<usize>>) {
    let keyed: Vec<(u64, u32)> = (0..locations.len() as u32)
        .into_par_iter()
        .map(|index| (region(&locations[index as usize], cells), index))
        .collect();
    let mut members: BTreeMap<u64, Vec<u32>> = BTreeMap::new();
    for part in keyed.chunk_by(|(a, _), (b, _)| a == b) {
        if let Some((region, _)) = part.first() {
            let members = members.entry(*region).or_default();
            members.extend(part.iter().map(|(_, index)| *index));
        }
    }
    let mut order = Vec::with_capacity(locations.len());
    let mut regions = Vec::with_capacity(members.len());
    for members in members.into_values() {
        regions.push(order.len()..order.len() + members.len());
        order.extend(members);
    }
    (order, regions)
}

/// Indices of the locations, sorted by tile, and the bounds of each chunk of them.
fn by_tile(locations: &[SampleLocation], bounds: &Bounds) -> (Vec<u32>, Vec<Bounds>) {
    let columns = u64::from(bounds.tiles()[0]);
    let low = [0, 1].map(|axis| bounds.low[axis] as i64 / TILE[axis]);
    let key = |index: u32| {
        let tile = tile_of(&locations[index as usize]);
        let [x, y] = [0, 1].map(|axis| (tile[axis] - low[axis]) as u64);
        (y * columns + x) << 32 | u64::from(index)
    };
    let keys = (0..locations.len() as u32).into_par_iter().map(key);
    let mut keys: Vec<u64> = keys.collect();
    keys.par_sort_unstable();
    let tile = |key: &u64| {
        let tile = key >> 32;
        [low[0] + (tile % columns) as i64, low[1] + (tile / columns) as i64]
    };
    let chunks = keys.par_chunks(CHUNK).map(|keys| keys.iter().map(tile).fold(Bounds::NOTHING, Bounds::with)).collect();
    (keys.into_iter().map(|key| key as u32).collect(), chunks)
}

/// Rectangle of whole tiles, in pixels of the plane.
#[derive(Clone, Copy)]
struct Bounds {
    low: [f64; 2],
    high: [f64; 2],
}

impl Bounds {
    const NOTHING: Self = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };

    fn of(tiles: impl ParallelIterator<Item = [i64; 2]>) -> Self {
        let bounds = tiles.fold(|| Self::NOTHING, Self::with);
        bounds.reduce(|| Self::NOTHING, Self::and)
    }

    fn with(self, tile: [i64; 2]) -> Self {
        let corner = |beyond: i64| [0, 1].map(|axis| ((tile[axis] + beyond) * TILE[axis]) as f64);
        self.and(Self { low: corner(0), high: corner(1) })
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

    fn area(&self) -> f64 {
        (self.high[0] - self.low[0]) * (self.high[1] - self.low[1])
    }

    fn is_compact(&self) -> bool {
        (0..2).all(|axis| self.high[axis] - self.low[axis] <= COMPACT)
    }
}

/// Column and row of the tile of the plane in which a location lies.
fn tile_of(location: &SampleLocation) -> [i64; 2] {
    [0, 1].map(|axis| (location.uv[axis] / TILE[axis] as f64).floor() as i64)
}

/// Half of the width and height, in pixels, of the axis-aligned rectangle around a location's cell; zero for points.
pub(super) fn half_extent(location: &SampleLocation, cells: Cells) -> [f64; 2] {
    let [column, row] = location.jacobian;
    if cells.are_points() { [0.0; 2] } else { [0, 1].map(|axis| 0.5 * (column[axis].abs() + row[axis].abs())) }
}

fn check(location: &SampleLocation, index: usize, cells: Cells) -> Result<(), LocationError> {
    let [u, v] = location.uv;
    let jacobian = location.jacobian;
    let numbers = [u, v].into_iter().chain(jacobian.into_iter().flatten());
    if !numbers.into_iter().all(f64::is_finite) {
        return Err(LocationError::NotFinite { index, u, v, jacobian });
    }
    let extent = half_extent(location, cells);
    if (0..2).any(|axis| location.uv[axis].abs() + extent[axis] > LocationError::FARTHEST) {
        return Err(LocationError::TooFar { index, u, v, half_width: extent[0], half_height: extent[1] });
    }
    Ok(())
}

/// Key of the region in which a location is sampled. Cells of similar extent share a key, because the largest cell of
/// a run determines how many triangles are candidates in its tiles.
fn region(location: &SampleLocation, cells: Cells) -> u64 {
    let tile = tile_of(location);
    let region = [0, 1].map(|axis| tile[axis].div_euclid(REGION_TILES[axis]));
    let [width, height] = half_extent(location, cells);
    let extent = width.max(height);
    let level = if extent <= 1.0 { 0 } else { 1 + (0.5 * extent.log2()) as u64 };
    // Regions are at most 2^10 columns and rows from the region at the origin.
    let [column, row] = region.map(|index| (index + 1024) as u64 & 0x7ff);
    level << 22 | row << 11 | column
}

#[cfg(test)]
mod tests {
    use super::*;

    fn location(uv: [f64; 2]) -> SampleLocation {
        SampleLocation { uv, jacobian: [[2.0, 0.0], [0.0, 1.0]], output: 0 }
    }

    #[test]
    fn runs_hold_every_location_once_and_windows_hold_runs() {
        // Seven locations are in one tile and one in the next. The last is left of the plane's corner by less than
        // 64-bit numbers resolve.
        let mut locations: Vec<SampleLocation> = (0..7).map(|i| location([f64::from(i) + 0.5, 3.5])).collect();
        locations.extend([location([9.0, 0.0]), location([-1e-20, 0.0])]);
        let partition = Partition::new(&locations, Cells::Superpixels).unwrap();
        // The location left of the corner is in a region of its own.
        let runs = partition.runs(100);
        assert_eq!(runs, [0..1, 1..9]);
        assert_eq!(partition.runs(5), [0..1, 1..6, 6..9]);
        let windows: Vec<_> = runs.iter().map(|run| partition.window(run)).collect();
        assert_eq!((windows[0].low, windows[0].tiles), ([-8, 0], [1, 1]));
        assert_eq!((windows[1].low, windows[1].tiles), ([0, 0], [2, 1]));
        let mut seen = Vec::new();
        for (run, window) in runs.iter().zip(&windows) {
            let mut listed = vec![ListedLocation::default(); run.len()];
            partition.list(run, window, &mut listed);
            partition.put(run, &mut seen, |i| 1 + listed[i].pixel[0]);
            for (place, listed) in run.clone().zip(&listed) {
                let uv = partition.location(place).uv;
                let [x, y] = [0, 1].map(|axis| {
                    window.low[axis] as f64 + f64::from(listed.pixel[axis]) + f64::from(listed.within[axis])
                });
                assert!((x - uv[0]).abs() < 1e-7 && (y - uv[1]).abs() < 1e-7);
                assert_eq!(listed.jacobian, [[2.0, 0.0], [0.0, 1.0]]);
            }
        }
        assert_eq!(seen, [1, 2, 3, 4, 5, 6, 7, 10, 8]);
        // Locations in a single region stay in the caller's order.
        let partition = Partition::new(&locations[..8], Cells::Points).unwrap();
        assert!(partition.order.is_none());
        assert_eq!(partition.runs(3), [0..3, 3..6, 6..8]);
    }
}
