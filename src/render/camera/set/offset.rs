//! Fits a uniform grid to locations, so that each cell holds at most one.

use super::{Grid, Sample, SetError};

/// Largest number of grid cells for each sample. Sets with few samples may have [`FEW`] more.
const CELLS_PER_SAMPLE: f64 = 32.0;
const FEW: f64 = 4096.0;

/// Finest `k` to try: cells of 2^-30 pixel, below which double precision does not resolve locations.
const FINEST: i32 = 60;

const FREE: u32 = u32::MAX;

/// Coarsest grid whose cells hold at most one sample each, and the cell of each sample. The sides of cells are
/// 2^(-k/2) pixels and their corners multiples of that, so that a grid with sides of 1 has the pixels as cells.
pub(super) fn fit(samples: &[Sample]) -> Result<(Grid, Vec<u32>), SetError> {
    let Some((low, high)) = bounds(samples) else {
        return Err(SetError::Empty);
    };
    let grid_of = |k: i32| {
        let pitch = 2.0_f64.powi(-k.div_euclid(2)) * [1.0, 0.5_f64.sqrt()][k.rem_euclid(2) as usize];
        let first = low.map(|v| (v / pitch).floor());
        let last = high.map(|v| (v / pitch).floor());
        let sides = [last[0] - first[0] + 1.0, last[1] - first[1] + 1.0];
        (pitch, first, sides)
    };
    // The first cells are as wide as all samples together. A grid that is too coarse is given up at the first cell
    // with two samples.
    let widest = (high[0] - low[0]).max(high[1] - low[1]).max(1.0);
    let mut k = (-2.0 * widest.log2()).floor() as i32;
    let most = (CELLS_PER_SAMPLE * samples.len() as f64 + FEW).min(f64::from(FREE));
    let mut conflict = (0, 0, widest);
    loop {
        let (pitch, first, sides) = grid_of(k);
        if sides[0] * sides[1] > most || k > FINEST {
            let (first, second, pitch) = conflict;
            return Err(SetError::NoGrid { first, second, pitch });
        }
        let columns = sides[0] as usize;
        let cell = |sample: &Sample| {
            let [column, row] = [0, 1].map(|i| (sample.uv[i] / pitch).floor() - first[i]);
            row as usize * columns + column as usize
        };
        match assign(samples, columns * sides[1] as usize, cell) {
            Ok(owners) => {
                let grid =
                    Grid { origin: first.map(|v| v * pitch), pitch, columns: sides[0] as u32, rows: sides[1] as u32 };
                return Ok((grid, owners));
            }
            Err((first, second)) => conflict = (first, second, pitch),
        }
        k += 1;
    }
}

fn bounds(samples: &[Sample]) -> Option<([f64; 2], [f64; 2])> {
    let first = samples.first()?.uv;
    Some(samples.iter().fold((first, first), |(low, high), sample| {
        let [u, v] = sample.uv;
        ([low[0].min(u), low[1].min(v)], [high[0].max(u), high[1].max(v)])
    }))
}

/// Cell of each sample; otherwise the indices of the first two samples that share a cell.
fn assign(samples: &[Sample], cells: usize, cell: impl Fn(&Sample) -> usize) -> Result<Vec<u32>, (usize, usize)> {
    let mut owners = vec![FREE; cells];
    let mut of_samples = Vec::with_capacity(samples.len());
    for (index, sample) in samples.iter().enumerate() {
        let cell = cell(sample);
        if let Some(owner) = owners.get_mut(cell) {
            if *owner != FREE {
                return Err((*owner as usize, index));
            }
            *owner = index as u32;
        }
        of_samples.push(cell as u32);
    }
    Ok(of_samples)
}
