//! Sampling sets: locations anywhere on an image plane, each for a row and column of the output, sorted into cells.
//!
//! Locations are (u, v) in pixels of the plane, u to the right and v down, (0, 0) its upper left corner. A location may
//! lie outside of the image, as far as [`FARTHEST`] pixels away. The place of a location and its row and column of the
//! output are independent of each other: a warp moves locations far from their cells.
//!
//! ```text
//!     planar            offset             superpixel           no pattern
//!   ┌──┬──┬──┐        ┌──┬──┬──┐         ┌──┬──┬──┐           ┌─────┬─────┐
//!   │ ·│ ·│ ·│        │· │ ·│  │         │ ·│ ·│ ·│           │     │·    │
//!   ├──┼──┼──┤        ├──┼──┼──┤         ├──┼──┼──┤           │  ·  ├──┬──┤
//!   │ ·│ ·│ ·│        │  │·.│. │         │ ·│⁘⁘│⁘⁘│           │     │··│· │
//!   ├──┼──┼──┤        ├──┼──┼──┤         ├──┼──┼──┤           ├──┬──┼──┼──┤
//!   │ ·│ ·│ ·│        │ ·│  │· │         │ ·│ ·│⁘⁘│           │· │··│  │ ·│
//!   └──┴──┴──┘        └──┴──┴──┘         └──┴──┴──┘           └──┴──┴──┴──┘
//!  one location at    at most one a      two rates: one        cells of a quad-tree,
//!  each centre        cell, anywhere     or N in a pixel       at most K locations each
//! ```
//!
//! The fifth variant, several pinholes that share their centre, is a [`Rig`](super::Rig): one set for each of them.

mod error;
mod neighbours;
mod offset;
mod quadtree;
mod statistics;

pub use error::SetError;
pub use quadtree::Leaf;
pub use statistics::SetStatistics;

use super::{LocationMap, SampleLocation};
use glam::{DMat2, DVec2};
use neighbours::Neighbours;
use rayon::prelude::*;

/// Largest absolute coordinate of a location, in pixels. Single precision still resolves a sixteenth of a pixel there.
pub const FARTHEST: f64 = 1_048_576.0;

/// Largest number of cells of an output.
pub const MOST_CELLS: u64 = 1 << 28;

/// Default for the largest number of locations in a leaf of a quadtree.
const LEAF_SAMPLES: usize = 32;

/// A sampling location, and the cell of the output to which it belongs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Location (u, v) in pixels of the plane.
    pub uv: [f64; 2],
    /// Row of the output, from 0 at the top.
    pub row: u32,
    /// Column of the output, from 0 at the left.
    pub col: u32,
}

/// A uniform grid over part of an image plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Upper left corner in pixels.
    pub origin: [f64; 2],
    /// Side of a cell in pixels.
    pub pitch: f64,
    /// Number of columns of cells.
    pub columns: u32,
    /// Number of rows of cells.
    pub rows: u32,
}

/// Cells of a sampling set.
#[derive(Clone, Debug, PartialEq)]
pub enum Layout {
    /// Cells of a grid, row by row: planar, offset and superpixel sets.
    Grid(Grid),
    /// Leaves of a quadtree, which tile its window: no-pattern sets. Samples outside of the window are in one more
    /// cell after the leaves.
    Tree(Vec<Leaf>),
}

/// Samples in the order in which they were given, and their partition into cells.
#[derive(Clone, Debug, PartialEq)]
pub struct SamplingSet {
    size: [u32; 2],
    samples: Vec<Sample>,
    jacobians: Option<Vec<DMat2>>,
    layout: Layout,
    /// Indices of the samples, cell by cell.
    members: Vec<u32>,
    /// Index in `members` of the first sample of each cell; the last entry is the end of the last cell.
    starts: Vec<u32>,
}

impl SamplingSet {
    /// Makes the planar set: one sample at the centre of each of `size` = [columns, rows] pixels.
    ///
    /// # Errors
    /// [`SetError::Size`] if there are no pixels or too many.
    pub fn planar(size: [u32; 2]) -> Result<Self, SetError> {
        check_size(size)?;
        let samples: Vec<_> = cells(size)
            .map(|(row, col)| Sample { uv: [f64::from(col) + 0.5, f64::from(row) + 0.5], row, col })
            .collect();
        Ok(Self::in_pixels(size, samples))
    }

    /// Makes the offset set: the samples with a uniform grid whose cells hold at most one sample each. The grid is in
    /// general finer than the output's, and its cells are unrelated to rows and columns. The sides of its cells are
    /// the largest possible power of the square root of 2.
    ///
    /// # Errors
    /// [`SetError::NoGrid`] if not even 32 cells for each sample separate them; otherwise if a sample is [not
    /// finite](SetError::NotFinite), [far away](SetError::Far) or [outside of the output](SetError::Cell).
    pub fn offset(size: [u32; 2], samples: Vec<Sample>) -> Result<Self, SetError> {
        check(size, &samples)?;
        let (grid, owners) = offset::fit(&samples)?;
        Ok(Self::in_grid(size, samples, grid, &owners))
    }

    /// Makes the superpixel set: `marks` tells for each pixel, row by row, whether it is a superpixel. A superpixel
    /// holds samples at `offsets` from its centre, in pixels; any other pixel holds one at its centre.
    ///
    /// # Errors
    /// [`SetError::Marks`] unless there is a mark for each pixel, [`SetError::Size`] if there are no pixels or too
    /// many, and [`SetError::NotFinite`] or [`SetError::Far`] for samples at impossible places.
    pub fn superpixel(size: [u32; 2], marks: &[bool], offsets: &[[f32; 2]]) -> Result<Self, SetError> {
        check_size(size)?;
        let expected = size[0] as usize * size[1] as usize;
        if marks.len() != expected {
            let found = marks.len();
            return Err(SetError::Marks { expected, found });
        }
        let mut samples = Vec::with_capacity(expected);
        for ((row, col), marked) in cells(size).zip(marks) {
            let at = |[x, y]: [f32; 2]| Sample {
                uv: [f64::from(col) + 0.5 + f64::from(x), f64::from(row) + 0.5 + f64::from(y)],
                row,
                col,
            };
            if *marked {
                samples.extend(offsets.iter().copied().map(at));
            } else {
                samples.push(at([0.0, 0.0]));
            }
        }
        check(size, &samples)?;
        Ok(Self::in_pixels(size, samples))
    }

    /// Makes the no-pattern set: the samples in the leaves of a quadtree over `window` (its upper left and lower right
    /// corners in pixels; `None` for a square around all samples). A square is split in four until it holds at most
    /// `most` samples, or its samples coincide to within 2^-32 of the window's side. Samples outside of the window go
    /// into a separate cell.
    ///
    /// # Errors
    /// [`SetError`] if there are no samples, one of them is not finite, far away or outside of the output, `most` is
    /// 0, or the window is empty.
    pub fn no_pattern(
        size: [u32; 2],
        samples: Vec<Sample>,
        window: Option<[[f64; 2]; 2]>,
        most: usize,
    ) -> Result<Self, SetError> {
        check(size, &samples)?;
        let tree = quadtree::build(&samples, window, most)?;
        Ok(Self {
            size,
            samples,
            jacobians: None,
            layout: Layout::Tree(tree.leaves),
            members: tree.members,
            starts: tree.starts,
        })
    }

    /// Makes a set with one sample for each cell of an output of `size` = [columns, rows], at the location to which
    /// `map` takes the cell's centre. The set is an offset set, or a no-pattern set if no grid fits.
    ///
    /// # Errors
    /// [`SetError`] if the output has no cells or too many, or a location is not finite or too far away.
    pub fn mapped(size: [u32; 2], map: &impl LocationMap) -> Result<Self, SetError> {
        let locations = mapped_locations(size, map)?;
        let mapped = cells(size).zip(&locations).map(|((row, col), location)| {
            let SampleLocation { uv, jacobian, .. } = *location;
            (Sample { uv, row, col }, DMat2::from_cols_array_2d(&jacobian))
        });
        Self::with_jacobians(size, mapped.collect())
    }

    /// Set of samples whose Jacobians (per output column and row) are known to the caller.
    pub(super) fn with_jacobians(size: [u32; 2], mapped: Vec<(Sample, DMat2)>) -> Result<Self, SetError> {
        let (samples, jacobians): (Vec<_>, Vec<_>) = mapped.into_iter().unzip();
        check(size, &samples)?;
        let mut set = match offset::fit(&samples) {
            Ok((grid, owners)) => Self::in_grid(size, samples, grid, &owners),
            Err(_) => Self::no_pattern(size, samples, None, LEAF_SAMPLES)?,
        };
        set.jacobians = Some(jacobians);
        Ok(set)
    }

    /// Set of samples in a grid of the output's own pixels.
    fn in_pixels(size: [u32; 2], samples: Vec<Sample>) -> Self {
        let grid = Grid { origin: [0.0, 0.0], pitch: 1.0, columns: size[0], rows: size[1] };
        let cell = |sample: &Sample| sample.row * size[0] + sample.col;
        let owners: Vec<_> = samples.iter().map(cell).collect();
        Self::in_grid(size, samples, grid, &owners)
    }

    /// Set of samples in a grid; `owners` holds the cell of each.
    fn in_grid(size: [u32; 2], samples: Vec<Sample>, grid: Grid, owners: &[u32]) -> Self {
        let count = grid.columns as usize * grid.rows as usize;
        let mut starts = vec![0_u32; count + 1];
        for owner in owners {
            starts[*owner as usize + 1] += 1;
        }
        for cell in 0..count {
            starts[cell + 1] += starts[cell];
        }
        let mut next = starts.clone();
        let mut members = vec![0; samples.len()];
        for (index, owner) in (0_u32..).zip(owners) {
            let place = &mut next[*owner as usize];
            members[*place as usize] = index;
            *place += 1;
        }
        Self { size, samples, jacobians: None, layout: Layout::Grid(grid), members, starts }
    }

    /// Number of columns and rows of the output.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Samples in the order in which they were given.
    #[must_use]
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// Layout of the cells.
    #[must_use]
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Cells of the set: for each, the indices of its samples.
    pub fn cells(&self) -> impl Iterator<Item = &[u32]> {
        self.starts.windows(2).map(|bounds| match bounds {
            [start, end] => self.members.get(*start as usize..*end as usize).unwrap_or(&[]),
            _ => &[],
        })
    }

    /// Offsets of the samples from the centres of their grid cells, in pixels: a list for each cell. `None` for a
    /// no-pattern set.
    #[must_use]
    pub fn offsets(&self) -> Option<Vec<Vec<[f64; 2]>>> {
        let Layout::Grid(grid) = &self.layout else {
            return None;
        };
        let centre = |cell: usize| {
            let (row, col) = (cell / grid.columns as usize, cell % grid.columns as usize);
            DVec2::from(grid.origin) + grid.pitch * DVec2::new(col as f64 + 0.5, row as f64 + 0.5)
        };
        let offsets = self.cells().enumerate().map(|(cell, members)| {
            let samples = members.iter().filter_map(|i| self.samples.get(*i as usize));
            samples.map(|sample| (DVec2::from(sample.uv) - centre(cell)).to_array()).collect()
        });
        Some(offsets.collect())
    }

    /// Sampling locations for the renderer, one for each sample, in the same order. Their Jacobians are those of the
    /// location map if there is one, otherwise differences between the locations of neighbouring rows and columns.
    #[must_use]
    pub fn locations(&self) -> Vec<SampleLocation> {
        let output = |sample: &Sample| sample.row * self.size[0] + sample.col;
        let location = |sample: &Sample, jacobian: DMat2| SampleLocation {
            uv: sample.uv,
            jacobian: jacobian.to_cols_array_2d(),
            output: output(sample),
        };
        match &self.jacobians {
            Some(jacobians) => {
                let pairs = self.samples.par_iter().zip(jacobians);
                pairs.map(|(sample, jacobian)| location(sample, *jacobian)).collect()
            }
            None => {
                let neighbours = Neighbours::new(self.size, &self.samples);
                let samples = self.samples.iter();
                samples.map(|sample| location(sample, neighbours.jacobian(sample.row, sample.col))).collect()
            }
        }
    }

    /// Makes an image from a colour for each sample: each pixel is the mean of the samples in its cell of the output,
    /// and transparent if the cell has none. Colours are linear light with premultiplied alpha.
    #[must_use]
    pub fn image(&self, colors: &[[f32; 4]]) -> Vec<[f32; 4]> {
        let count = self.size[0] as usize * self.size[1] as usize;
        let mut sums = vec![([0.0_f64; 4], 0.0_f64); count];
        for (sample, color) in self.samples.iter().zip(colors) {
            let cell = sample.row as usize * self.size[0] as usize + sample.col as usize;
            if let Some((sum, count)) = sums.get_mut(cell) {
                for (sum, value) in sum.iter_mut().zip(color) {
                    *sum += f64::from(*value);
                }
                *count += 1.0;
            }
        }
        let mean = |(sum, count): ([f64; 4], f64)| sum.map(|sum| (sum / count.max(1.0)) as f32);
        sums.into_iter().map(mean).collect()
    }

    /// Statistics of the set: density and evenness of its samples.
    #[must_use]
    pub fn statistics(&self) -> SetStatistics {
        let fullest = self.cells().map(<[u32]>::len).max().unwrap_or_default();
        statistics::of(&Neighbours::new(self.size, &self.samples), fullest)
    }
}

/// The locations to which `map` takes the centres of the cells of an output of `size` = [columns, rows], row by row. Whoever
/// samples them checks that they are finite and not too far away.
///
/// # Errors
/// [`SetError::Size`] if there are no cells or too many.
pub fn mapped_locations(size: [u32; 2], map: &impl LocationMap) -> Result<Vec<SampleLocation>, SetError> {
    check_size(size)?;
    let [columns, rows] = size;
    let location = |output: u32| {
        let place = DVec2::new(f64::from(output % columns) + 0.5, f64::from(output / columns) + 0.5);
        SampleLocation { uv: map.location(place).to_array(), jacobian: map.jacobian(place).to_cols_array_2d(), output }
    };
    Ok((0..columns * rows).into_par_iter().map(location).collect())
}

/// Rows and columns of all cells of an output, row by row.
fn cells(size: [u32; 2]) -> impl Iterator<Item = (u32, u32)> {
    (0..size[1]).flat_map(move |row| (0..size[0]).map(move |col| (row, col)))
}

fn check_size(size: [u32; 2]) -> Result<(), SetError> {
    let [columns, rows] = size;
    let count = u64::from(columns) * u64::from(rows);
    if count == 0 || count > MOST_CELLS {
        return Err(SetError::Size { columns, rows });
    }
    Ok(())
}

fn check(size: [u32; 2], samples: &[Sample]) -> Result<(), SetError> {
    check_size(size)?;
    if samples.is_empty() {
        return Err(SetError::Empty);
    }
    if u32::try_from(samples.len()).is_err() {
        return Err(SetError::TooMany(samples.len()));
    }
    let [columns, rows] = size;
    for (index, sample) in samples.iter().enumerate() {
        let [u, v] = sample.uv;
        if !(u.is_finite() && v.is_finite()) {
            return Err(SetError::NotFinite { index, u, v });
        }
        if u.abs() > FARTHEST || v.abs() > FARTHEST {
            return Err(SetError::Far { index, u, v });
        }
        let Sample { row, col, .. } = *sample;
        if row >= rows || col >= columns {
            return Err(SetError::Cell { index, row, col, columns, rows });
        }
    }
    Ok(())
}
