//! Triangles in the form that shaders read: corners, and a word with material, bin and flags.

use super::bins::Bins;
use super::material::high_frequency;
use crate::engine::data::TriangleWord;
use crate::render::data::geometry::double_sided;
use crate::scene::{Material, PosedGeometry};

/// A triangle's corners, rotated so that the one with the smallest position comes first. Copies of a triangle that
/// begin with another vertex are then computed identically, and the same copy is visible everywhere.
fn first_corner_first(corners: [u32; 3], positions: &[[f32; 3]]) -> [u32; 3] {
    let position = |corner: u32| positions.get(corner as usize).copied().unwrap_or_default();
    let before = |a: u32, b: u32| {
        let pairs = position(a).into_iter().zip(position(b));
        pairs.map(|(a, b)| a.total_cmp(&b)).find(|order| order.is_ne()).is_some_and(std::cmp::Ordering::is_lt)
    };
    let [a, b, c] = corners;
    if before(b, a) && !before(c, b) {
        [b, c, a]
    } else if before(c, a) && before(c, b) {
        [c, a, b]
    } else {
        corners
    }
}

/// All triangles of a scene.
pub(super) struct Triangles {
    /// Corners and last word of each triangle.
    pub(super) words: Vec<[u32; 4]>,
    /// Number of drawn triangles that may need several shadings in a pixel.
    pub(super) high_frequency: u64,
}

impl Triangles {
    pub(super) fn new(materials: &[Material], geometry: &PosedGeometry, bins: &Bins) -> Self {
        let mut last_words = vec![0_u32; geometry.triangles.len()];
        for draw in &geometry.draws {
            let word = TriangleWord {
                material: draw.material,
                bin: bins.of(draw.material),
                high_frequency: materials.get(draw.material as usize).is_some_and(high_frequency),
                double_sided: double_sided(draw.class),
            };
            let first = draw.first_triangle as usize;
            last_words[first..first + draw.triangle_count as usize].fill(word.bits());
        }
        let words: Vec<_> = geometry
            .triangles
            .iter()
            .zip(&last_words)
            .map(|(&corners, &word)| {
                let [a, b, c] = first_corner_first(corners, &geometry.positions);
                [a, b, c, word]
            })
            .collect();
        Self { high_frequency: high_frequency_count(geometry, &words), words }
    }
}

/// Number of drawn triangles whose words has this flag.
fn high_frequency_count(geometry: &PosedGeometry, words: &[[u32; 4]]) -> u64 {
    let counts = words.iter().scan(0, |count, [.., word]| {
        *count += u64::from(word & TriangleWord::HIGH_FREQUENCY != 0);
        Some(*count)
    });
    // Counts of all words before each index, and at the end of all of them.
    let counts: Vec<u64> = std::iter::once(0).chain(counts).collect();
    let up_to = |triangle: usize| counts.get(triangle).copied().unwrap_or(0);
    let of = |range: std::ops::Range<usize>| up_to(range.end) - up_to(range.start);
    match geometry.instances.as_slice() {
        [] => up_to(words.len()),
        instances => instances.iter().map(|i| of(i.triangles())).sum(),
    }
}
