//! Lattices: the rotated square lattice, whose rows are straight, and Korobov's, whose error is smaller.

use super::{Location, locate};

/// A k x k grid, where k is `side`, turned by 1/k. Its projections on either axis are spread evenly over k^2 places,
/// while each row stays straight and evenly spaced. The sample in column i and row j, from 0, is at x = -1/2 + (i +
/// 1/2)/k + (j - (k - 1)/2)/k^2, y = -1/2 + (j + 1/2)/k - (i - (k - 1)/2)/k^2 from the centre.
///
/// The signs of the two tilts must differ: equal signs shear the lattice along a diagonal of the pixel, which leaves
/// two corners empty, and the error falls as N^-0.55 only.
pub(super) fn rotated(side: u32) -> Vec<Location> {
    let k = f64::from(side);
    let centre = |index: u32| (f64::from(index) + 0.5) / k;
    let tilt = |index: u32| (f64::from(index) - (k - 1.0) / 2.0) / (k * k);
    (0..side)
        .flat_map(|j| (0..side).map(move |i| (i, j)))
        .map(|(i, j)| locate(centre(i) + tilt(j), centre(j) - tilt(i)))
        .collect()
}

/// Rank-1 lattice of the points (i, g i mod n), each at the centre of its cell in an n x n grid; n is `count`.
pub(super) fn korobov(count: u32) -> Vec<Location> {
    let centre = |index: u32| (f64::from(index) + 0.5) / f64::from(count);
    let generator = generator(count);
    (0..count).map(|i| locate(centre(i), centre(i * generator % count))).collect()
}

/// The generator, coprime to `count`, with the smallest worst-case error over smooth periodic functions (I. H. Sloan
/// and S. Joe, "Lattice Methods for Multiple Integration", 1994, section 4.3). For edges it is among the best as well.
///
/// The error grows with the sum over i of B(i/n) B({g i/n}), where B(x) = x^2 - x + 1/6. The code computes with 6 n^2
/// B, so that the sums are exact. A lattice and its mirror images have the same error; of these, the lattice with the
/// largest generator is chosen.
fn generator(count: u32) -> u32 {
    let n = i64::from(count);
    let kernel: Vec<i64> = (0..n).map(|i| 6 * i * i - 6 * i * n + n * n).collect();
    let error = |generator: u32| -> i64 {
        let steps = (0..kernel.len()).map(|i| i * generator as usize % kernel.len());
        kernel.iter().zip(steps).map(|(a, j)| a * kernel[j]).sum()
    };
    (1..count)
        .rev()
        .filter(|&generator| greatest_common_divisor(generator, count) == 1)
        .min_by_key(|&generator| error(generator))
        .unwrap_or(1)
}

/// Greatest common divisor by Euclid's algorithm.
fn greatest_common_divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}
