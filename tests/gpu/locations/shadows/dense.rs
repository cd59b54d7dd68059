//! Shadows of casters in tiles of a light's plane that have more triangles than a list of candidates may have.

use gpc::scene::{AlphaMode, LightKind};

use super::{OVER, SIZE, ask, cast, floor, lamp, lit, pinhole, places, sun};
use crate::meshes::Random;
use crate::stage::on_gpu;

/// Specks that are too small to keep light from a place change next to no shadow: their edges are rounded, so that some of 40,000
/// are found before a place that they miss.
#[test]
fn specks_change_no_shadow() {
    on_gpu(|gpu| {
        for (light, caster) in [
            (sun(), AlphaMode::Opaque),
            (lamp(LightKind::Point), AlphaMode::Blend),
        ] {
            let mut stage = floor(vec![lit(AlphaMode::Opaque), lit(caster)]);
            let mut specked = stage.clone();
            let mut random = Random::new(5);
            for _ in 0..40_000 {
                let middle = [-0.2, 0.6, -2.8].map(|at: f64| at + random.range(-0.05, 0.05));
                let corners =
                    [0; 3].map(|_| middle.map(|at| (at + random.range(-1e-6, 1e-6)) as f32));
                specked.add(0, corners);
            }
            stage.add(1, OVER);
            specked.add(1, OVER);
            stage.triangles[2].color[3] = 0.5;
            specked.triangles[40_002].color[3] = 0.5;
            let over = OVER.map(|corner| cast(&light, corner, &pinhole(SIZE)));
            let locations = places(over);
            let lights = [light];
            let listed = ask(gpu, &stage, &lights, &locations);
            let found = ask(gpu, &specked, &lights, &locations);
            assert!(listed.iter().any(|point| point.shadows != 0));
            let pairs = found.iter().zip(&listed);
            let differ = pairs
                .filter(|(a, b)| (a.color, a.shadows) != (b.color, b.shadows))
                .count();
            assert!(50 * differ <= found.len(), "{differ} of {}", found.len());
        }
    });
}
