//! Merging of visibility samples that see the same triangle and that the same lights reach, for triangles with one part. Parts are
//! those of [`crate::variation`].

use std::collections::BTreeMap;

/// A visibility sample of a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sample {
    /// ID of the triangle that it sees; 0 for none.
    pub triangle: u32,
    /// Its shadow word: a bit for each light that does not reach it.
    pub shadows: u32,
    /// Its offset from the middle of the cell, in units of 2^-12 of the cell's sides.
    pub offset: [i32; 2],
}

/// Samples that are shaded together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Merged {
    /// ID of their triangle.
    pub triangle: u32,
    /// Their shadow word.
    pub shadows: u32,
    /// Number of samples.
    pub samples: u32,
    /// Mean of their offsets.
    pub offset: [f64; 2],
}

/// The samples of a block, merged. The result is ordered by triangle, then by shadow word.
#[must_use]
pub fn merged(samples: &[Sample]) -> Vec<Merged> {
    let mut groups: BTreeMap<(u32, u32), Vec<[i32; 2]>> = BTreeMap::new();
    for sample in samples.iter().filter(|sample| sample.triangle != 0) {
        groups.entry((sample.triangle, sample.shadows)).or_default().push(sample.offset);
    }
    let merge = |((triangle, shadows), offsets): ((u32, u32), Vec<[i32; 2]>)| {
        let mean =
            |axis: usize| offsets.iter().map(|offset| f64::from(offset[axis])).sum::<f64>() / offsets.len() as f64;
        Merged { triangle, shadows, samples: offsets.len() as u32, offset: [mean(0), mean(1)] }
    };
    groups.into_iter().map(merge).collect()
}
