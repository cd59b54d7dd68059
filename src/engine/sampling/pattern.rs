//! Patterns by name, and the numbers of samples that each can have.

use std::collections::HashMap;
use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use super::{Location, lattice, locate, offset, order, sobol, standard};

/// Largest number of samples of a superpixel.
pub const MAX_SAMPLES: u32 = 1024;

/// Pattern of the samples in a superpixel.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Pattern {
    /// Samples on straight lines of 64 samples each: rows or columns, whichever the edges in the superpixel cross more
    /// often. Any count. Up to 64 samples have 8 lines, up to 256 have
    /// 32, and more have 64 (32 in scenes with alpha-tested triangles). The count also limits the number of places in
    /// which the superpixel is shaded. In lists of locations, lines follow the columns of the Jacobian.
    /// [Sobol](Pattern::Sobol) points replace lines where each sample is shaded, where BLEND triangles are visible, and
    /// for counts below 4.
    Lines,
    /// First points of an Owen-scrambled Sobol sequence, a (0,2)-sequence in base 2. Any count. Its error on straight
    /// edges depends least on their orientation.
    Sobol,
    /// A k x k lattice turned by 1/k, so that its k^2 columns and k^2 rows are all different, while each of its k rows
    /// is straight and evenly spaced: `x = -1/2 + (i + 1/2)/k + (j - (k - 1)/2)/k^2` and
    /// `y = -1/2 + (j + 1/2)/k - (i - (k - 1)/2)/k^2` for column i and row j from 0, rounded to 2^-16. Any count; for a
    /// count that is no square, the [Korobov](Pattern::Korobov) lattice.
    Lattice,
    /// Rank-1 lattice (i, g i mod N) with the best generator g. Any count. On average over straight edges, the error is
    /// as small as the grid's, without the grid's weakness along the axes. At its worst orientations, the error is
    /// larger than that of Sobol points.
    Korobov,
    /// Centres of a k x k grid. Square counts only. For edges along an axis, this pattern has the largest error of all,
    /// because such edges meet k samples at once.
    Grid,
    /// Standard sample locations of graphics APIs (Vulkan 1.3, section 25.3): 1, 2, 4, 8 or 16 samples. The mean of
    /// the last set is 1/32 pixel from the pixel's centre.
    Rotated,
    /// Offsets of the caller from the pixel's centre, in pixels, x to the right, y down, each in [-0.5, 0.5). They are
    /// rounded to multiples of 2^-16 and sorted into the common order.
    List(Vec<[f32; 2]>),
}

/// Error of a pattern, its number of samples, or a list of offsets.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PatternError {
    /// Name that no pattern has.
    #[error("no sample pattern is called `{0}`; there are lines, sobol, lattice, korobov, grid and rotated")]
    Unknown(String),
    /// Number of samples that is 0 or above [`MAX_SAMPLES`].
    #[error("{0} samples in a pixel were asked for; choose 1 to {MAX_SAMPLES}")]
    CountOutOfRange(u32),
    /// Number of samples that the pattern can't have.
    #[error(
        "pattern {pattern} cannot have {count} samples; choose {}, or pattern lines, sobol, lattice or korobov",
        alternatives(available)
    )]
    CountUnavailable {
        /// Name of the pattern.
        pattern: &'static str,
        /// Number of samples that was asked for.
        count: u32,
        /// Numbers of samples that the pattern can have: the nearest ones, or all if they are few.
        available: Vec<u32>,
    },
    /// List whose length is not the number of samples.
    #[error("{count} samples were asked for, but the list holds {found} offsets; ask for {found}")]
    ListLength {
        /// Number of samples that was asked for.
        count: u32,
        /// Number of offsets in the list.
        found: usize,
    },
    /// Offset of a list that is NaN or outside of the pixel.
    #[error("offset {index} of the list is ({x}, {y}); both coordinates must be at least -0.5 and below 0.5")]
    ListOutside {
        /// Index of the offset in the list.
        index: usize,
        /// Coordinate x of the offset.
        x: f32,
        /// Coordinate y of the offset.
        y: f32,
    },
    /// Offsets of a list that are equal after rounding to 2^-16 pixel.
    #[error("offsets {first} and {second} of the list are the same to 2^-16 pixel; remove one")]
    ListDuplicate {
        /// Index of the first of them in the list.
        first: usize,
        /// Index of the second of them.
        second: usize,
    },
}

impl Pattern {
    /// Offsets of `count` samples from the pixel's centre, in pixels and in the [module's order](super#order). Each
    /// coordinate is in [-0.5, 0.5) and a multiple of 2^-16, and no two offsets are equal. A single sample is at the
    /// centre, except in a [list](Pattern::List).
    ///
    /// # Errors
    /// [`PatternError`] if the count is 0, above [`MAX_SAMPLES`] or one that the pattern can't have, or if a list is
    /// invalid.
    pub fn offsets(&self, count: u32) -> Result<Vec<[f32; 2]>, PatternError> {
        if !(1..=MAX_SAMPLES).contains(&count) {
            return Err(PatternError::CountOutOfRange(count));
        }
        let side = count.isqrt();
        let mut locations = match self {
            Self::List(list) => locate_list(list, count)?,
            _ if count == 1 => vec![locate(0.5, 0.5)],
            Self::Lines | Self::Sobol => sobol::locations(count, sobol::SEED),
            Self::Lattice if side * side == count => lattice::rotated(side),
            Self::Lattice | Self::Korobov => lattice::korobov(count),
            Self::Grid => standard::grid(count)?,
            Self::Rotated => standard::rotated(count)?,
        };
        order::sort(&mut locations);
        Ok(locations.into_iter().map(offset).collect())
    }
}

impl fmt::Display for Pattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Lines => "lines",
            Self::Sobol => "sobol",
            Self::Lattice => "lattice",
            Self::Korobov => "korobov",
            Self::Grid => standard::GRID,
            Self::Rotated => standard::ROTATED,
            Self::List(_) => "list",
        })
    }
}

impl FromStr for Pattern {
    type Err = PatternError;

    /// Pattern with this name. A [list](Pattern::List) has no name, because it needs its offsets.
    fn from_str(name: &str) -> Result<Self, PatternError> {
        match name {
            "lines" => Ok(Self::Lines),
            "sobol" => Ok(Self::Sobol),
            "lattice" => Ok(Self::Lattice),
            "korobov" => Ok(Self::Korobov),
            standard::GRID => Ok(Self::Grid),
            standard::ROTATED => Ok(Self::Rotated),
            _ => Err(PatternError::Unknown(name.to_owned())),
        }
    }
}

/// Checks a caller's list, and converts it to locations.
fn locate_list(list: &[[f32; 2]], count: u32) -> Result<Vec<Location>, PatternError> {
    if list.len() != count as usize {
        return Err(PatternError::ListLength { count, found: list.len() });
    }
    let mut seen = HashMap::with_capacity(list.len());
    let mut locations = Vec::with_capacity(list.len());
    for (index, &[x, y]) in list.iter().enumerate() {
        // `contains` is false for NaN.
        if ![x, y].iter().all(|v| (-0.5..0.5).contains(v)) {
            return Err(PatternError::ListOutside { index, x, y });
        }
        let location = locate(f64::from(x) + 0.5, f64::from(y) + 0.5);
        if let Some(first) = seen.insert(location, index) {
            return Err(PatternError::ListDuplicate { first, second: index });
        }
        locations.push(location);
    }
    Ok(locations)
}

/// The counts in words: "4", "4 or 9", "1, 2 or 4".
fn alternatives(counts: &[u32]) -> String {
    let words: Vec<String> = counts.iter().map(u32::to_string).collect();
    match words.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => words.concat(),
    }
}
