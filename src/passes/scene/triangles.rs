//! Triangles as the shaders read them: corners, and a word of material, bin and flags.

use super::bins::Bins;
use super::material::high_frequency;
use crate::passes::raster::double_sided;
use crate::scene::{DrawClass, Geometry, Scene};

/// Neighbouring triangles of one class, drawn at once.
#[derive(Clone, Copy, Debug)]
pub(in crate::passes) struct Run {
    pub(in crate::passes) class: DrawClass,
    pub(in crate::passes) first_triangle: u32,
    pub(in crate::passes) triangle_count: u32,
}

/// The bits of a triangle's last word: 16 of its material, 14 of its bin, and flags.
const BIN_SHIFT: u32 = 16;
const HIGH_FREQUENCY_BIT: u32 = 1 << 30;
const DOUBLE_SIDED_BIT: u32 = 1 << 31;

/// A triangle's vertices in their order, beginning with the one whose position comes first. Duplicates of a triangle that
/// begin elsewhere are then computed alike to the bit, and the same one is seen everywhere.
fn first_corner_first(corners: [u32; 3], positions: &[[f32; 3]]) -> [u32; 3] {
    let position = |corner: u32| positions.get(corner as usize).copied().unwrap_or_default();
    let before = |a: u32, b: u32| {
        let pairs = position(a).into_iter().zip(position(b));
        pairs
            .map(|(a, b)| a.total_cmp(&b))
            .find(|order| order.is_ne())
            .is_some_and(std::cmp::Ordering::is_lt)
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
    /// Corners and last word of each.
    pub(super) words: Vec<[u32; 4]>,
    pub(super) runs: Vec<Run>,
    /// How many may ask for several shading places in a pixel.
    pub(super) high_frequency: u32,
}

impl Triangles {
    pub(super) fn new(scene: &Scene, geometry: &Geometry, bins: &Bins) -> Self {
        let mut last_words = vec![0_u32; geometry.triangles.len()];
        let mut runs: Vec<Run> = Vec::new();
        let mut high_frequency_count = 0;
        for draw in &geometry.draws {
            let is_high_frequency = scene
                .materials
                .get(draw.material as usize)
                .is_some_and(high_frequency);
            high_frequency_count += if is_high_frequency {
                draw.triangle_count
            } else {
                0
            };
            let flag = |bit: u32, set: bool| if set { bit } else { 0 };
            let word = draw.material
                | bins.of(draw.material) << BIN_SHIFT
                | flag(DOUBLE_SIDED_BIT, double_sided(draw.class))
                | flag(HIGH_FREQUENCY_BIT, is_high_frequency);
            let first = draw.first_triangle as usize;
            last_words[first..first + draw.triangle_count as usize].fill(word);
            match runs.last_mut() {
                Some(run) if run.class == draw.class => run.triangle_count += draw.triangle_count,
                _ => runs.push(Run {
                    class: draw.class,
                    first_triangle: draw.first_triangle,
                    triangle_count: draw.triangle_count,
                }),
            }
        }
        let words = geometry
            .triangles
            .iter()
            .zip(&last_words)
            .map(|(&corners, &word)| {
                let [a, b, c] = first_corner_first(corners, &geometry.positions);
                [a, b, c, word]
            })
            .collect();
        Self {
            words,
            runs,
            high_frequency: high_frequency_count,
        }
    }

    /// Index of the first triangle of a class or a later one; the number of triangles where there is none.
    pub(super) fn first_of(&self, class: DrawClass) -> u32 {
        self.runs
            .iter()
            .find(|run| run.class >= class)
            .map_or(self.words.len() as u32, |run| run.first_triangle)
    }
}
