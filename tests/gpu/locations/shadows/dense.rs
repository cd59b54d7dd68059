//! Shadows of more casters than planes of lights usually have room for.

use glam::DVec2;
use gpc::scene::{AlphaMode, LightKind};

use super::{OVER, SIZE, ask, cast, floor, lamp, lit, pinhole, places, sun};
use crate::meshes::Random;
use crate::stage::on_gpu;

/// Number of locations. A plane for as many has 125,000 tiles, whose numbers take 17 of the 32 bits of a pair.
const LOCATIONS: usize = 500_000;
/// Numbers of triangles in a tile: one that the other bits can count, and one that they can't.
const FEW: usize = 24_000;
const MANY: usize = 45_000;

/// Places in a tile with many casters have the same shadows as with few, although the plane has fewer tiles. The stage with many casters
/// only repeats specks of the other one, so that it casts the same shadows. Some of the specks are seen, because their edges are
/// rounded.
#[test]
fn shadows_are_the_same_among_many_casters() {
    on_gpu(|gpu| {
        for (light, caster) in [(sun(), AlphaMode::Opaque), (lamp(LightKind::Point), AlphaMode::Blend)] {
            let stage = floor(vec![lit(AlphaMode::Opaque), lit(caster)]);
            let mut random = Random::new(5);
            let specks: Vec<_> = (0..FEW)
                .map(|_| {
                    let middle = [-0.2, 0.6, -2.8].map(|at: f64| at + random.range(-0.01, 0.01));
                    [0; 3].map(|_| middle.map(|at| (at + random.range(-1e-6, 1e-6)) as f32))
                })
                .collect();
            let over = OVER.map(|corner| cast(&light, corner, &pinhole(SIZE)));
            let locations: Vec<_> = places(over).into_iter().cycle().take(LOCATIONS).collect();
            let lights = [light];
            let [few, many] = [FEW, MANY].map(|count| {
                let mut dense = stage.clone();
                for speck in specks.iter().cycle().take(count) {
                    dense.add(0, *speck);
                }
                dense.add(1, OVER);
                dense.triangles[count + 2].color[3] = 0.5;
                ask(gpu, &dense, &lights, &locations)
            });
            assert!(few.iter().any(|point| point.shadows != 0));
            let pairs = many.iter().zip(&few);
            let differ = pairs.filter(|(a, b)| (a.color, a.shadows) != (b.color, b.shadows)).count();
            assert_eq!(differ, 0, "of {}", many.len());
        }
    });
}

/// Casters that cover all tiles of a plane have more pairs than usual. The frame gets room for them.
#[test]
fn planes_get_the_pairs_that_they_need() {
    on_gpu(|gpu| {
        let mut stage = floor(vec![lit(AlphaMode::Opaque)]);
        for layer in 0..80 {
            let height = 1.5 + 0.01 * layer as f32;
            stage.add(0, [[-90.0, height, 90.0], [90.0, height, 90.0], [0.0, height, -180.0]]);
        }
        let locations = places([DVec2::new(600.0, 400.0), DVec2::new(700.0, 450.0), DVec2::new(640.0, 700.0)]);
        let seen = ask(gpu, &stage, &[sun()], &locations);
        let on_floor: Vec<_> = seen.iter().filter(|seen| (1..=2).contains(&seen.id)).collect();
        assert!(on_floor.len() > 10_000, "{}", on_floor.len());
        assert!(on_floor.iter().all(|seen| seen.shadows == 1));
    });
}
