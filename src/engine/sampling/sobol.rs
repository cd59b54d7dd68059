//! First two dimensions of the Sobol sequence, with Owen's scrambling.
//!
//! The sequence is a (0,2)-sequence in base 2: of 2^m consecutive points that start at a multiple of 2^m, one lies in
//! each of the 2^m equal boxes of any shape 2^-i x 2^-(m-i). Owen's scrambling (A. B. Owen, "Randomly permuted
//! (t,m,s)-nets and (t,s)-sequences", 1995) flips each binary digit at random, depending on the digits before it. This
//! keeps the property above, and breaks up the rows of the plain sequence, which err on edges of some orientations.

use super::{Location, offset};

/// Scrambling seed of [`Pattern::Sobol`](super::Pattern::Sobol), found by the search in `tests/cpu/coverage_chart.rs`.
pub(super) const SEED: u32 = 551;

/// First `count` points of the Sobol sequence's first two dimensions, Owen-scrambled with `seed`: offsets from the
/// pixel's centre in [-0.5, 0.5), multiples of 2^-16, in the order of the sequence.
///
/// The first 65,536 points are distinct; then the sequence, which is cut to 16 binary digits, repeats.
pub fn owen_sobol(count: u32, seed: u32) -> Vec<[f32; 2]> {
    locations(count, seed).into_iter().map(offset).collect()
}

/// The points of [`owen_sobol`] as locations.
pub(super) fn locations(count: u32, seed: u32) -> Vec<Location> {
    let seeds = [hash(seed), hash(!seed)];
    (0..count)
        .map(|index| {
            let index = index as u16;
            [scramble(index.reverse_bits(), seeds[0]), scramble(second_dimension(index), seeds[1])]
        })
        .collect()
}

/// Second dimension of the Sobol sequence, from the primitive polynomial x + 1: each direction number is the one
/// before, exclusive-or the same shifted right by one.
fn second_dimension(index: u16) -> u16 {
    let mut direction = 1_u16 << 15;
    let mut value = 0;
    for digit in 0..u16::BITS {
        if index >> digit & 1 == 1 {
            value ^= direction;
        }
        direction ^= direction >> 1;
    }
    value
}

/// Flips each digit of a binary fraction by a random bit that depends on all digits before it.
fn scramble(value: u16, seed: u32) -> u16 {
    (0..u16::BITS).fold(0, |scrambled, digit| {
        // A one in front of the prefix distinguishes prefixes of different lengths.
        let prefix = (1 << digit) | u32::from(value) >> (u16::BITS - digit);
        let coin = (hash(prefix ^ seed) >> 31) as u16;
        let bit = u16::BITS - 1 - digit;
        scrambled | ((value >> bit & 1) ^ coin) << bit
    })
}

/// An integer hash (C. Wellons' lowbias32: an exclusive-or and multiply permutation with low avalanche bias).
fn hash(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ x >> 16
}
