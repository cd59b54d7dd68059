//! Locations of a file, and rows of the result.

use gpc::camera::set::Sample;
use gpc::render::PointSample;

/// Sampling locations of a file.
#[derive(Debug, Default, PartialEq)]
pub struct Locations {
    pub uv: Vec<[f64; 2]>,
    /// Row and column of each location, if the file has them.
    pub cells: Option<Vec<[f64; 2]>>,
}

impl Locations {
    /// Makes a table of rows of `width` numbers: u, v and, if `width` is 4, row and column.
    pub fn from_rows(width: usize, numbers: &[f64]) -> Self {
        let pair = |row: &[f64], start: usize| match row.get(start..start + 2) {
            Some([a, b]) => [*a, *b],
            _ => [f64::NAN; 2],
        };
        let rows = || numbers.chunks_exact(width);
        Self {
            uv: rows().map(|row| pair(row, 0)).collect(),
            cells: (width == 4).then(|| rows().map(|row| pair(row, 2)).collect()),
        }
    }

    /// The samples of a set, in the order of the file.
    pub fn samples(&self) -> anyhow::Result<Vec<Sample>> {
        let Some(cells) = &self.cells else {
            let sample = |uv: &[f64; 2]| Sample { uv: *uv, row: 0, col: 0 };
            return Ok(self.uv.iter().map(sample).collect());
        };
        let index = |value: f64| {
            let whole = value.fract() == 0.0 && (0.0..f64::from(u32::MAX)).contains(&value);
            whole.then_some(value as u32)
        };
        let sample = |(place, (uv, cell)): (usize, (&[f64; 2], &[f64; 2]))| {
            let [row, col] = cell.map(index);
            match (row, col) {
                (Some(row), Some(col)) => Ok(Sample { uv: *uv, row, col }),
                _ => anyhow::bail!(
                    "sample {place} has row {} and column {}; both must be whole numbers from 0",
                    cell[0],
                    cell[1]
                ),
            }
        };
        self.uv.iter().zip(cells).enumerate().map(sample).collect()
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
