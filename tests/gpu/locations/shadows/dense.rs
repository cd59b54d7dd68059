//! Shadows of casters in tiles of a light's plane that have more triangles than a list of candidates may have.

use gpc::scene::{AlphaMode, LightKind};

use super::{OVER, SIZE, ask, cast, floor, lamp, lit, pinhole, places, sun};
use crate::meshes::Random;
use crate::stage::on_gpu;

/// Numbers of triangles in a tile that still has a list, and in a tile that has none.
const LISTED: usize = 36_000;
const UNLISTED: usize = 45_000;

/// Samples in tiles without a list have the same shadows as with a list. The stage without a list only repeats specks
/// of the other one, so that it casts the same shadows. Some of the specks are seen, because their edges are rounded.
#[test]
fn shadows_are_the_same_without_a_list() {
    on_gpu(|gpu| {
        for (light, caster) in [(sun(), AlphaMode::Opaque), (lamp(LightKind::Point), AlphaMode::Blend)] {
            let stage = floor(vec![lit(AlphaMode::Opaque), lit(caster)]);
            let mut random = Random::new(5);
            let specks: Vec<_> = (0..LISTED)
                .map(|_| {
                    let middle = [-0.2, 0.6, -2.8].map(|at: f64| at + random.range(-0.01, 0.01));
                    [0; 3].map(|_| middle.map(|at| (at + random.range(-1e-6, 1e-6)) as f32))
                })
                .collect();
            let over = OVER.map(|corner| cast(&light, corner, &pinhole(SIZE)));
            let (locations, lights) = (places(over), [light]);
            let [listed, found] = [LISTED, UNLISTED].map(|count| {
                let mut dense = stage.clone();
                for speck in specks.iter().cycle().take(count) {
                    dense.add(0, *speck);
                }
                dense.add(1, OVER);
                dense.triangles[count + 2].color[3] = 0.5;
                ask(gpu, &dense, &lights, &locations)
            });
            assert!(listed.iter().any(|point| point.shadows != 0));
            let pairs = found.iter().zip(&listed);
            let differ = pairs.filter(|(a, b)| (a.color, a.shadows) != (b.color, b.shadows)).count();
            assert_eq!(differ, 0, "of {}", found.len());
        }
    });
}
