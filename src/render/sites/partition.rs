//! Sites into runs, tiles, cells and groups: what the sampling engine works through instead of an image's pixels.
//!
//! The plane is cut into regions on a fixed grid; regions without sites cost nothing. Within a region, sites are sorted
//! by tile of 8 x 4 pixels, and within a tile along a Morton curve, so that neighbours share a cell.

use super::SiteError;
use crate::camera::Site;
use crate::passes::Cells;
use rayon::prelude::*;
use std::ops::Range;

/// Tiles of a region: 2,048 x 2,048 pixels.
const REGION_TILES: [i64; 2] = [256, 512];
/// Pixels of a tile.
pub(super) const TILE: [i64; 2] = [8, 4];
/// Up to this many pixels sites share what positions are relative to, so that they see the same however they are cut
/// into runs, and what an image of their plane sees; beyond it 32-bit positions are finer from the middle of each window.
const COMPACT: f64 = 8192.0;
/// Factor on the reach of large cells, whose samples are rounded to 32 bits.
pub(super) const ROUNDING: f64 = 1.0 + 1.0 / 1_048_576.0;
/// Key bits below those of the region: a tile of it, and the place in the tile.
const TILE_BITS: u32 = 17;
const PLACE_BITS: u32 = 16;

/// Sites in the order in which they are sampled.
pub(super) struct Partition {
    /// The sites' places in the caller's list.
    pub order: Vec<u32>,
    sites: Vec<Site>,
    pub cells: Cells,
    /// What clip-space positions of all runs are relative to, if they lie close enough together.
    middle: Option<[f64; 2]>,
    /// Parts of the order that lie in one region each.
    regions: Vec<Range<usize>>,
}

/// The part of the plane that a run's sites lie in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Window {
    /// Its upper left pixel.
    pub low: [i64; 2],
    /// Its size in tiles.
    pub tiles: [u32; 2],
    /// The place on the plane that clip-space positions are relative to, in pixels.
    pub middle: [f64; 2],
    /// The farthest that samples are from the centre of the pixel that holds their site.
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

impl Partition {
    /// Sorts `sites`.
    ///
    /// # Errors
    /// The first site that is not finite or too far off the image.
    pub fn new(sites: &[Site], cells: Cells) -> Result<Self, SiteError> {
        if sites.is_empty() {
            return Err(SiteError::Empty);
        }
        if sites.len() > (u32::MAX >> 1) as usize {
            return Err(SiteError::TooMany { found: sites.len() });
        }
        let checked: Result<Vec<(u64, u32)>, SiteError> = sites
            .par_iter()
            .enumerate()
            .map(|(index, site)| {
                check(site, index, cells).map(|()| (key(site, cells), index as u32))
            })
            .collect();
        let mut keyed = checked.or_else(|any| {
            // Which one was found first depends on the threads.
            let offenders = sites.iter().enumerate();
            let first = offenders.map(|(index, site)| check(site, index, cells));
            first.collect::<Result<(), _>>().and(Err(any))
        })?;
        keyed.par_sort_unstable();
        let mut regions: Vec<Range<usize>> = Vec::new();
        let mut start = 0;
        let region = |key: u64| key >> (TILE_BITS + PLACE_BITS);
        for part in keyed.chunk_by(|(a, _), (b, _)| region(*a) == region(*b)) {
            regions.push(start..start + part.len());
            start += part.len();
        }
        let sorted: Vec<Site> = keyed
            .par_iter()
            .map(|(_, index)| sites[*index as usize])
            .collect();
        let bounds = Bounds::of(&sorted);
        Ok(Self {
            order: keyed.into_iter().map(|(_, index)| index).collect(),
            middle: bounds.is_compact().then(|| bounds.middle()),
            sites: sorted,
            cells,
            regions,
        })
    }

    /// Runs of at most `longest` sites, each in one region.
    pub fn runs(&self, longest: usize) -> Vec<Range<usize>> {
        let longest = longest.max(1);
        let pieces = |region: &Range<usize>| {
            let end = region.end;
            let starts = region.clone().step_by(longest);
            starts.map(move |start| start..end.min(start + longest))
        };
        self.regions.iter().flat_map(pieces).collect()
    }

    /// The sites of a run, in order.
    pub fn run(&self, run: &Range<usize>) -> &[Site] {
        self.sites.get(run.clone()).unwrap_or(&[])
    }

    /// The places of a run's sites in the caller's list.
    pub fn places(&self, run: &Range<usize>) -> &[u32] {
        self.order.get(run.clone()).unwrap_or(&[])
    }

    /// The window around a run.
    pub fn window(&self, run: &Range<usize>) -> Window {
        let sites = self.run(run);
        let bounds = Bounds::of(sites);
        let reach = |site: &Site| {
            let extent = half_extent(site, self.cells);
            let from_centre = site.uv.map(|v| (v - v.floor() - 0.5).abs());
            (from_centre[0] + extent[0]).max(from_centre[1] + extent[1])
        };
        let reach = if self.cells.are_points() {
            0.5
        } else {
            sites.iter().map(reach).fold(0.5, f64::max)
        };
        Window {
            low: bounds.low.map(|pixel| pixel as i64),
            tiles: bounds.tiles(),
            middle: self.middle.unwrap_or_else(|| bounds.middle()),
            reach: reach * ROUNDING,
        }
    }
}

/// Whole tiles around sites, in pixels of the plane.
struct Bounds {
    low: [f64; 2],
    high: [f64; 2],
}

impl Bounds {
    fn of(sites: &[Site]) -> Self {
        let mut bounds = Self {
            low: [f64::INFINITY; 2],
            high: [f64::NEG_INFINITY; 2],
        };
        for site in sites {
            let tile = tile_of(site);
            for axis in 0..2 {
                let pixel = (tile[axis] * TILE[axis]) as f64;
                bounds.low[axis] = bounds.low[axis].min(pixel);
                bounds.high[axis] = bounds.high[axis].max(pixel + TILE[axis] as f64);
            }
        }
        bounds
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

/// The tile of the plane that a site lies in.
pub(super) fn tile_of(site: &Site) -> [i64; 2] {
    [0, 1].map(|axis| (site.uv[axis] / TILE[axis] as f64).floor() as i64)
}

/// Half of the width and height of the upright rectangle around a site's cell, in pixels; points have none.
pub(super) fn half_extent(site: &Site, cells: Cells) -> [f64; 2] {
    let [column, row] = site.jacobian;
    if cells.are_points() {
        [0.0; 2]
    } else {
        [0, 1].map(|axis| 0.5 * (column[axis].abs() + row[axis].abs()))
    }
}

fn check(site: &Site, index: usize, cells: Cells) -> Result<(), SiteError> {
    let [u, v] = site.uv;
    let jacobian = site.jacobian;
    let numbers = [u, v].into_iter().chain(jacobian.into_iter().flatten());
    if !numbers.into_iter().all(f64::is_finite) {
        return Err(SiteError::NotFinite {
            index,
            u,
            v,
            jacobian,
        });
    }
    let extent = half_extent(site, cells);
    if (0..2).any(|axis| site.uv[axis].abs() + extent[axis] > SiteError::FARTHEST) {
        return Err(SiteError::TooFar {
            index,
            u,
            v,
            half_width: extent[0],
            half_height: extent[1],
        });
    }
    Ok(())
}

/// What sites are sorted by. Cells of about the same extent stay together, since the widest of a run decides how many
/// triangles are candidates in its tiles.
fn key(site: &Site, cells: Cells) -> u64 {
    let tile = tile_of(site);
    let region = [0, 1].map(|axis| tile[axis].div_euclid(REGION_TILES[axis]));
    let in_region = [0, 1].map(|axis| tile[axis].rem_euclid(REGION_TILES[axis]) as u64);
    let [x, y] = [0, 1].map(|axis| {
        let place = site.uv[axis] / TILE[axis] as f64;
        ((place - place.floor()) * 256.0).min(255.0) as u64
    });
    let [width, height] = half_extent(site, cells);
    let extent = width.max(height);
    let level = if extent <= 1.0 {
        0
    } else {
        1 + (0.5 * extent.log2()) as u64
    };
    // Regions lie within 2^10 of the first one.
    let [column, row] = region.map(|index| (index + 1024) as u64 & 0x7ff);
    let region_key = level << 22 | row << 11 | column;
    let tile_key = in_region[1] << 8 | in_region[0];
    region_key << (TILE_BITS + PLACE_BITS) | tile_key << PLACE_BITS | spread(y) << 1 | spread(x)
}

/// The bits of a byte on every other place.
fn spread(v: u64) -> u64 {
    let v = (v | v << 4) & 0x0f0f;
    let v = (v | v << 2) & 0x3333;
    (v | v << 1) & 0x5555
}
