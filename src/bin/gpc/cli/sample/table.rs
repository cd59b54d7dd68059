//! Locations of a file, and rows of the result.

use gpc::camera::set::Sample;
use gpc::render::PointSample;

/// Sampling locations of a file, in its order.
#[derive(Debug, PartialEq)]
pub struct Locations {
    /// Locations; those of a file without rows and columns are all of row 0 and column 0, so that they have no neighbours.
    pub samples: Vec<Sample>,
    /// Whether the file has rows and columns.
    pub has_cells: bool,
}

impl Locations {
    /// Makes a table of rows of `width` numbers: u, v and, if `width` is 4, row and column.
    pub fn from_rows(width: usize, numbers: &[f64]) -> Result<Self, String> {
        let index = |value: f64| {
            let whole = value.fract() == 0.0 && (0.0..f64::from(u32::MAX)).contains(&value);
            whole.then_some(value as u32)
        };
        let sample = |(place, numbers): (usize, &[f64])| match *numbers {
            [u, v, row, col] => match (index(row), index(col)) {
                (Some(row), Some(col)) => Ok(Sample { uv: [u, v], row, col }),
                _ => Err(format!("sample {place} has row {row} and column {col}; both must be whole numbers from 0")),
            },
            [u, v, ..] => Ok(Sample { uv: [u, v], row: 0, col: 0 }),
            _ => Err(format!("sample {place} has no u and v")),
        };
        let samples = numbers.chunks_exact(width).enumerate().map(sample).collect::<Result<_, _>>()?;
        Ok(Self { samples, has_cells: width == 4 })
    }
}

/// Names of the columns of a result.
pub const COLUMNS: [&str; 12] = ["u", "v", "r", "g", "b", "a", "depth", "id", "hit", "nx", "ny", "nz"];

/// The values of one sample.
pub type SampleRow = [f64; COLUMNS.len()];

/// Whether a sample sees a triangle.
pub fn is_hit(sample: &PointSample) -> bool {
    sample.id != 0 || sample.blend_id != 0
}

pub fn row(uv: [f64; 2], sample: &PointSample) -> SampleRow {
    let [r, g, b, a] = sample.color.map(f64::from);
    let [x, y, z] = sample.normal.map(f64::from);
    let hit = f64::from(u8::from(is_hit(sample)));
    let (depth, id) = (f64::from(sample.depth), f64::from(sample.id));
    [uv[0], uv[1], r, g, b, a, depth, id, hit, x, y, z]
}
