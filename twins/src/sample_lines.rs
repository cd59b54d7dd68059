//! Places of the samples on straight lines across a pixel.

/// Number of samples of a line.
pub const BITS: u32 = 64;

/// Offsets of a pixel's samples from its centre, in pixels. The samples lie on `lines` rows, or columns if `columns` is
/// set, one line after the other; `lines` is a power of two. The samples of a line are evenly spaced. The position of
/// the first sample differs from line to line, so that all samples together are evenly spread over both axes.
#[must_use]
pub fn offsets(columns: bool, lines: u32) -> Vec<[f64; 2]> {
    let samples = (0..lines).flat_map(|line| (0..BITS).map(move |bit| (line, bit)));
    samples
        .map(|(line, bit)| {
            let reversed = line.reverse_bits() >> (u32::BITS - lines.ilog2());
            let phase = (f64::from(reversed) + 0.5) / f64::from(lines);
            let along = (f64::from(bit) + phase) / f64::from(BITS) - 0.5;
            let across = (f64::from(line) + 0.5) / f64::from(lines) - 0.5;
            if columns { [across, along] } else { [along, across] }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{BITS, offsets};

    #[test]
    fn each_row_and_each_column_has_its_samples() {
        for lines in [8, 16, 32, 64] {
            let rows = offsets(false, lines);
            assert_eq!(rows.len(), (lines * BITS) as usize);
            let mut columns: Vec<u32> =
                rows.iter().map(|[x, _]| ((x + 0.5) * f64::from(lines * BITS)) as u32).collect();
            columns.sort_unstable();
            assert!(columns.into_iter().eq(0..lines * BITS));
            let turned: Vec<_> = rows.iter().map(|&[x, y]| [y, x]).collect();
            assert_eq!(turned, offsets(true, lines));
        }
    }
}
