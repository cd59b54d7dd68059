//! The triangle that each sample sees, compared with the exact twin.

use gpc::render::Headless;
use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;

use crate::meshes::{Depths, Mesh, Random, delaunay, fan, ground, slivers, tilings};
use crate::stage::{Stage, centre, code, everywhere, flat, ids, on_gpu, once, seen_at};
use crate::twin::Twin;

const SIZE: [u32; 2] = [64, 64];
const HALF: f64 = 32.0;

/// Counts of a comparison.
#[derive(Debug, Default)]
struct Tally {
    samples: u64,
    /// Number of samples whose triangle rounding may change.
    contested: u64,
    /// Number of pixels that differ from the twin for that reason.
    excused: u64,
}

impl Tally {
    /// Fails if so many samples are contested that the comparison means little.
    fn assert_few_contested(&self, name: &str) {
        assert!(self.contested * 20 <= self.samples && self.excused * 10 <= self.contested + 20, "{name}: {self:?}");
    }
}

/// Reasons for which a pixel may differ from the twin.
#[derive(Clone, Copy, PartialEq)]
enum Excuse {
    Contested,
    /// None: vertices, samples and edge functions are exact in 32 bits.
    Nothing,
}

/// Compares each pixel with the mean of the [codes](code) of the triangles that its samples see.
fn compare(gpu: &mut Headless, stage: &Stage, name: &str, (pattern, samples): (Pattern, u32), excuse: Excuse) -> Tally {
    let rendered = stage.render(gpu, &everywhere(SIZE, pattern.clone(), samples));
    let offsets = pattern.offsets(samples).unwrap();
    let twin = Twin::new(stage, SIZE);
    let mut tally = Tally::default();
    for (pixel, found) in rendered.colors.iter().enumerate() {
        let middle = centre(pixel, SIZE);
        let mut sum = [0.0; 3];
        let mut contested = 0;
        for offset in &offsets {
            let sample = [0, 1].map(|axis| middle[axis] + f64::from(offset[axis]));
            let seen = twin.nearest(pixel, sample);
            contested += u32::from(seen.contested());
            let shown = seen.nearest.map_or([0.0; 3], |hit| code(hit.id));
            for (sum, shown) in sum.iter_mut().zip(shown) {
                *sum += f64::from(shown);
            }
        }
        let mean = sum.map(|sum| sum / f64::from(samples));
        let difference = (0..3).map(|channel| (f64::from(found[channel]) - mean[channel]).abs()).fold(0.0, f64::max);
        // Interpolated codes are accurate to 2^-21 of their value.
        const ROUNDING: f64 = 0.004;
        let allowed = match excuse {
            Excuse::Contested => 4095.0 * f64::from(contested) / f64::from(samples),
            Excuse::Nothing => 0.0,
        };
        assert!(
            difference <= ROUNDING + allowed,
            "{name}, {samples} samples, at {middle:?}: {found:?} instead of {mean:?}, {contested} contested"
        );
        tally.samples += u64::from(samples);
        tally.contested += u64::from(contested);
        tally.excused += u64::from(difference > ROUNDING);
    }
    tally
}

/// A stage of a mesh whose triangles show their codes.
fn coded(mesh: &Mesh, double_sided: bool, permutation: impl Fn(usize) -> usize) -> Stage {
    let mut material = flat([1.0; 4], AlphaMode::Opaque);
    material.double_sided = double_sided;
    let mut stage = Stage::new(vec![material]);
    stage.add_mesh(0, mesh, SIZE[1], permutation);
    stage.color_by_code();
    stage
}

#[test]
fn tilings_are_seen_as_the_twin_sees_them() {
    on_gpu(|gpu| {
        for (index, mesh) in tilings(1, HALF).into_iter().enumerate() {
            // The order of the vertices covers all windings and rotations.
            let stage = coded(&mesh, true, |triangle| triangle + index);
            let lone = Pattern::List(vec![[0.17, -0.31]]);
            for pattern in [(lone, 1), (Pattern::Sobol, 17)] {
                compare(gpu, &stage, &mesh.name, pattern, Excuse::Contested).assert_few_contested(&mesh.name);
            }
        }
    });
}

/// Samples on edges and corners belong to the triangle that the rule for ties gives.
#[test]
fn samples_on_edges_are_owned_by_the_rule() {
    on_gpu(|gpu| {
        for mesh in [
            delaunay(3, HALF, 9, Depths::Snapped),
            delaunay(4, HALF, 40, Depths::Snapped),
            slivers(3, HALF, 40, Depths::Snapped),
        ] {
            let stage = coded(&mesh, true, |triangle| triangle);
            let tally = compare(gpu, &stage, &mesh.name, (Pattern::Grid, 64), Excuse::Nothing);
            assert!(tally.contested > 300, "few ties: {tally:?}");
        }
    });
}

#[test]
fn back_faces_are_not_seen() {
    on_gpu(|gpu| {
        let mesh = fan(5, HALF, 48, Depths::Random);
        let stage = coded(&mesh, false, |triangle| triangle);
        let pattern = (Pattern::Sobol, 16);
        compare(gpu, &stage, &mesh.name, pattern, Excuse::Contested).assert_few_contested(&mesh.name);
        let single = stage.render(gpu, &once(SIZE));
        assert!(ids(&single).contains(&0) && ids(&single).iter().any(|&id| id != 0));
    });
}

/// Triangles with vertices behind the eye, on the near plane and 10^6 pixels off the screen.
#[test]
fn planes_through_the_eye_are_seen_as_the_twin_sees_them() {
    on_gpu(|gpu| {
        for seed in 0..3 {
            let mesh = ground(seed, HALF, 1.0, 9);
            let stage = coded(&mesh, true, |triangle| triangle);
            let lone = Pattern::List(vec![[-0.45, 0.08]]);
            for pattern in [(lone, 1), (Pattern::Sobol, 16)] {
                compare(gpu, &stage, &mesh.name, pattern, Excuse::Contested).assert_few_contested(&mesh.name);
            }
        }
    });
}

/// Triangles that intersect in depth; `distances` from the eye are in powers of two.
pub fn soup(seed: u64, count: usize, double_sided: bool, distances: [f64; 2]) -> Stage {
    let mut random = Random::new(seed);
    let mut material = flat([1.0; 4], AlphaMode::Opaque);
    material.double_sided = double_sided;
    let mut stage = Stage::new(vec![material]);
    for _ in 0..count {
        let middle = [0; 2].map(|_| random.range(-HALF, HALF));
        let corners = [0; 3].map(|_| {
            let place = middle.map(|middle| middle + random.range(-24.0, 24.0));
            let distance = random.range(distances[0], distances[1]).exp2();
            seen_at(place, distance, SIZE[1])
        });
        stage.add(0, corners);
    }
    stage.color_by_code();
    stage
}

#[test]
fn the_nearest_of_intersecting_triangles_is_seen() {
    on_gpu(|gpu| {
        for (seed, count, double_sided) in [(1, 60, true), (2, 400, false), (3, 600, true)] {
            let stage = soup(seed, count, double_sided, [-1.0, 5.0]);
            let name = format!("{count} intersecting triangles");
            compare(gpu, &stage, &name, (Pattern::Sobol, 16), Excuse::Contested).assert_few_contested(&name);
        }
    });
}

/// Nearly coplanar layers far from the eye, whose depths differ by 2^-12.
#[test]
fn nearly_coplanar_layers_keep_their_order() {
    on_gpu(|gpu| {
        let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
        for layer in 0..40_u32 {
            // Layers are not in order of depth, and each has another corner in view.
            let distance = 500.0 * (1.0 + f64::from(layer * 17 % 40) * 2.0_f64.powi(-12));
            let turn = f64::from(layer) * 0.7;
            let corners = [0.0, 2.1, 4.2].map(|angle| {
                let (sin, cos) = f64::sin_cos(turn + angle);
                seen_at([30.0 * cos, 30.0 * sin], distance, SIZE[1])
            });
            stage.add(0, corners);
        }
        stage.color_by_code();
        let pattern = (Pattern::Sobol, 16);
        compare(gpu, &stage, "layers", pattern, Excuse::Contested).assert_few_contested("layers");
    });
}

/// The first pass, by the device's rasterizer, sees the same triangles as the exact twin, except for its rounding of vertices
/// and depths.
#[test]
fn raster_agrees_with_the_twin_away_from_edges() {
    on_gpu(|gpu| {
        let mut stages: Vec<(Stage, String)> = tilings(2, HALF)
            .into_iter()
            .chain((0..2).map(|seed| ground(seed, HALF, 1.0, 9)))
            .map(|mesh| (coded(&mesh, true, |triangle| triangle), mesh.name))
            .collect();
        stages.push((soup(5, 300, true, [-1.0, 5.0]), "soup".to_owned()));
        for (stage, name) in stages {
            let found = ids(&stage.render(gpu, &once(SIZE)));
            let twin = Twin::new(&stage, SIZE);
            let mut excused = 0;
            for (pixel, id) in found.into_iter().enumerate() {
                let middle = centre(pixel, SIZE);
                let (seen, doubtful) = twin.rasterized(pixel, middle);
                let expected = seen.nearest.map_or(0, |hit| hit.id);
                assert!(id == expected || doubtful, "{name}, at {middle:?}: {id} instead of {expected}; {seen:?}");
                excused += u32::from(id != expected);
            }
            assert!(excused <= 41, "{name}: {excused} of 4096 pixels differ");
        }
    });
}
