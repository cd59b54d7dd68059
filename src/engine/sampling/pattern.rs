//! The patterns by name, and what each can have.

use std::collections::HashMap;
use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use super::{Location, lattice, locate, offset, order, sobol, standard};

/// The most samples that a superpixel can have.
pub const MAX_SAMPLES: u32 = 1024;

/// How the samples of a superpixel are placed.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// Samples on straight lines, rows or columns, whichever edges in the superpixel cross more often, 64 on each: 8
    /// lines up to a count of 64, and 16 above that. The count decides in how many places the superpixel is shaded.
    /// Superpixels of a frame have them that see opaque and alpha-tested triangles; where each sample is shaded, where
    /// BLEND triangles show, in lists of locations, and below a count of 16, there are [Sobol](Pattern::Sobol)'s. Any count.
    Lines,
    /// The first points of an Owen-scrambled Sobol sequence, a (0,2)-sequence in base 2: any count. Its error on
    /// straight edges is the most even over orientations.
    Sobol,
    /// A k x k lattice turned by 1/k, so that its k^2 columns and k^2 rows are all different while each of its k rows is
    /// straight and evenly spaced: `x = -1/2 + (i + 1/2)/k + (j - (k - 1)/2)/k^2` and
    /// `y = -1/2 + (j + 1/2)/k - (i - (k - 1)/2)/k^2` for column i and row j from 0, rounded to 2^-16. For counts that are
    /// no square, [Korobov](Pattern::Korobov)'s. Any count.
    Lattice,
    /// The rank-1 lattice (i, g i mod N) with the best generator g: any count. On average over straight edges it errs as
    /// little as the grid, without the grid's weakness along the axes; at its own worst orientations it errs more than
    /// Sobol points.
    Korobov,
    /// The centres of a k x k grid; square counts only. The worst on edges along an axis, which meet k samples at once.
    Grid,
    /// The standard sample locations of graphics APIs (Vulkan 1.3, section 25.3): 1, 2, 4, 8 or 16 samples. The last
    /// set is off the pixel's centre by 1/32 pixel.
    Rotated,
    /// The caller's own offsets in pixels from the pixel's centre, x to the right, y down, each in [-0.5, 0.5). They
    /// are rounded to multiples of 2^-16 and given the common order.
    List(Vec<[f32; 2]>),
}

/// Why a pattern cannot be had.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PatternError {
    /// No pattern has this name.
    #[error(
        "no sample pattern is called `{0}`; there are lines, sobol, lattice, korobov, grid and rotated"
    )]
    Unknown(String),
    /// The count is 0 or above [`MAX_SAMPLES`].
    #[error("{0} samples in a pixel were asked for; choose 1 to {MAX_SAMPLES}")]
    CountOutOfRange(u32),
    /// The pattern exists for some counts only.
    #[error(
        "pattern {pattern} cannot have {count} samples; choose {}, or pattern lines, sobol, lattice or korobov",
        alternatives(available)
    )]
    CountUnavailable {
        /// The pattern's name.
        pattern: &'static str,
        /// The count asked for.
        count: u32,
        /// Counts that the pattern can have: the nearest ones, or all where they are few.
        available: Vec<u32>,
    },
    /// A list holds another number of offsets than asked for.
    #[error("{count} samples were asked for, but the list holds {found} offsets; ask for {found}")]
    ListLength {
        /// The count asked for.
        count: u32,
        /// How many offsets the list holds.
        found: usize,
    },
    /// An offset of a list is not a number or lies outside the pixel.
    #[error(
        "offset {index} of the list is ({x}, {y}); both coordinates must be at least -0.5 and below 0.5"
    )]
    ListOutside {
        /// The offset's position in the list, from 0.
        index: usize,
        /// Its x.
        x: f32,
        /// Its y.
        y: f32,
    },
    /// Two offsets of a list are the same after rounding to 2^-16 pixel.
    #[error("offsets {first} and {second} of the list are the same to 2^-16 pixel; remove one")]
    ListDuplicate {
        /// The earlier one's position in the list, from 0.
        first: usize,
        /// The later one's position.
        second: usize,
    },
}

impl Pattern {
    /// The offsets of `count` samples from the pixel's centre, in pixels and in the [module's order](super#order):
    /// each in [-0.5, 0.5), a multiple of 2^-16, no two the same. One sample is the centre, except in a
    /// [list](Pattern::List), whose own location is kept.
    ///
    /// # Errors
    /// The count is outside 1 to [`MAX_SAMPLES`] or one that the pattern cannot have, or a list is invalid.
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

    /// The pattern of a name; a [list](Pattern::List) has none, since it needs its offsets.
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

/// The locations of a caller's list, checked.
fn locate_list(list: &[[f32; 2]], count: u32) -> Result<Vec<Location>, PatternError> {
    if list.len() != count as usize {
        return Err(PatternError::ListLength {
            count,
            found: list.len(),
        });
    }
    let mut seen = HashMap::with_capacity(list.len());
    let mut locations = Vec::with_capacity(list.len());
    for (index, &[x, y]) in list.iter().enumerate() {
        // NaN is in no range.
        if ![x, y].iter().all(|v| (-0.5..0.5).contains(v)) {
            return Err(PatternError::ListOutside { index, x, y });
        }
        let location = locate(f64::from(x) + 0.5, f64::from(y) + 0.5);
        if let Some(first) = seen.insert(location, index) {
            return Err(PatternError::ListDuplicate {
                first,
                second: index,
            });
        }
        locations.push(location);
    }
    Ok(locations)
}

/// "4", "4 or 9", "1, 2 or 4".
fn alternatives(counts: &[u32]) -> String {
    let words: Vec<String> = counts.iter().map(u32::to_string).collect();
    match words.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => words.concat(),
    }
}
