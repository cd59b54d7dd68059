//! Shadows of meshes on themselves.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use gpc::camera::SampleLocation;
use gpc::scene::{AlphaMode, LightKind};

use super::{FLOOR, ask, light, lit, location, places};
use crate::meshes::Random;
use crate::stage::{Stage, on_gpu};

/// Facets of a convex mesh that face the light are lit everywhere, up to a degree from grazing incidence; facets that
/// face away lie in the shadow of the others.
#[test]
fn a_ball_shadows_its_far_side_alone() {
    const RINGS: usize = 40;
    const SECTORS: usize = 80;
    on_gpu(|gpu| {
        let mut stage = Stage::new(vec![lit(AlphaMode::Opaque)]);
        let at = |ring: usize, sector: usize| {
            let (polar, azimuth) = (PI * ring as f64 / RINGS as f64, TAU * sector as f64 / SECTORS as f64);
            let around = DVec3::new(polar.sin() * azimuth.sin(), polar.cos(), polar.sin() * azimuth.cos());
            (around + DVec3::new(0.1, 0.05, -2.5)).as_vec3().to_array()
        };
        for (ring, sector) in (0..RINGS).flat_map(|ring| (0..SECTORS).map(move |s| (ring, s))) {
            let [a, b] = [at(ring, sector), at(ring + 1, sector)];
            let [c, d] = [at(ring + 1, sector + 1), at(ring, sector + 1)];
            if ring + 1 < RINGS {
                stage.add(0, [a, b, c]);
            }
            if ring > 0 {
                stage.add(0, [a, c, d]);
            }
        }
        let mut random = Random::new(3);
        let mut place = |from: f64, to: f64| from + (to - from) * random.below(1 << 20) as f64 / f64::from(1 << 20);
        let locations: Vec<SampleLocation> =
            (0..60_000).map(|_| location([place(480.0, 840.0), place(180.0, 520.0)], 0)).collect();
        let lights = [
            light(LightKind::Directional, DVec3::ZERO, DVec3::new(0.8, -0.5, -0.2)),
            light(LightKind::Point, DVec3::new(-1.2, 1.9, -1.7), DVec3::NEG_Y),
        ];
        let (mut day, mut night, mut grazing, mut edges) = ([0; 2], [0; 2], 0, 0);
        for seen in ask(gpu, &stage, &lights, &locations) {
            let Some(triangle) = (seen.id as usize).checked_sub(1) else {
                continue;
            };
            let corners = stage.triangles[triangle].corners;
            let [a, b, c] = corners.map(|corner| DVec3::from_array(corner.map(f64::from)));
            let normal = (b - a).cross(c - a).normalize();
            for (bit, light) in lights.iter().enumerate() {
                let to_light = match light.kind {
                    LightKind::Directional => -light.direction,
                    _ => (light.position - a).normalize(),
                };
                let cosine = normal.dot(to_light);
                let shadowed = seen.shadows >> bit & 1 != 0;
                if cosine.abs() < 0.0175 {
                    grazing += 1;
                    continue;
                }
                // A facet that faces away may be lit just behind an edge, where the facet in front of it is at the same
                // distance.
                assert!(!shadowed || cosine < 0.0, "{seen:?}: {cosine} towards light {bit}");
                edges += u32::from(!shadowed && cosine < 0.0);
                day[bit] += u32::from(!shadowed);
                night[bit] += u32::from(shadowed);
            }
        }
        assert!(day.iter().chain(&night).all(|count| *count > 3_000), "{day:?} {night:?}");
        assert!(grazing < 8_000 && edges < 20, "{grazing} {edges}");
    });
}

/// A plane of many triangles does not shadow itself, however long shadows would be.
#[test]
fn a_plane_that_light_grazes_is_lit() {
    on_gpu(|gpu| {
        let mut stage = Stage::new(vec![lit(AlphaMode::Opaque)]);
        let mut random = Random::new(9);
        let mut jitter = || random.below(1000) as f32 * 2e-4;
        let corners: Vec<Vec<[f32; 3]>> = (0..61)
            .map(|row| {
                let corner = |column: u16| {
                    let [x, z] = [column, row].map(|v| f32::from(v) * 0.25);
                    [x - 7.5 + jitter(), FLOOR as f32, -0.5 - z - jitter()]
                };
                (0..61).map(corner).collect()
            })
            .collect();
        for (near, far) in corners.iter().zip(&corners[1..]) {
            for (near, far) in near.windows(2).zip(far.windows(2)) {
                stage.add_quad(0, [near[0], near[1], far[1], far[0]]);
            }
        }
        let grazing = DVec3::new(0.8, -(1.0_f64.to_radians()).tan(), 0.6);
        let sun = light(LightKind::Directional, DVec3::ZERO, grazing);
        let locations = places([DVec2::new(600.0, 400.0), DVec2::new(700.0, 450.0), DVec2::new(640.0, 700.0)]);
        let seen = ask(gpu, &stage, &[sun], &locations);
        assert!(seen.iter().filter(|seen| seen.id != 0).count() > 30_000);
        assert_eq!(seen.iter().filter(|seen| seen.shadows != 0).count(), 0);
    });
}
