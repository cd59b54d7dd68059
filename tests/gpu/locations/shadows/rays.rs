//! Shadows among random triangles, compared with rays.

use glam::{DVec2, DVec3};
use gpc::scene::{AlphaMode, DiffuseTransmission, Light, LightKind};
use twins::shadow::{Receiver, Shining, is_in_shadow};

use super::{SIZE, ask, light, lit, location, pinhole, spot};
use crate::meshes::Random;
use crate::stage::{Stage, on_gpu};

/// A light in the form that the twin takes.
fn shining(light: &Light, corners: &[[DVec3; 3]]) -> Shining {
    let cosine = match light.kind {
        LightKind::Directional => {
            let (low, high) = corners
                .iter()
                .flatten()
                .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), at| (low.min(*at), high.max(*at)));
            return Shining::Distant {
                to_light: -light.direction,
                depth: ((high - low) * light.direction.abs()).element_sum(),
            };
        }
        LightKind::Point => -2.0,
        LightKind::Spot { outer_angle, .. } => f64::from(outer_angle).cos(),
    };
    Shining::Local {
        position: light.position,
        cone: (light.direction, cosine),
        range: light.range.map_or(f64::INFINITY, f64::from),
    }
}

#[test]
fn places_lie_in_the_shadow_of_what_rays_meet() {
    shadows_are_those_of_the_twin([2.0, 1.2], 200, 1.0);
}

/// Hundreds of triangles in a few tiles of the planes, whose lists are refined.
#[test]
fn places_among_crowds_lie_in_the_shadow_of_what_rays_meet() {
    shadows_are_those_of_the_twin([0.5, 0.15], 1000, 0.25);
}

/// Compares the shadows among `count` triangles with the twin's. They lie within a box whose height is `spread`, and `side` bounds
/// their size. `part` is the part of the image's width and height around its middle in which places are compared.
fn shadows_are_those_of_the_twin([spread, side]: [f64; 2], count: usize, part: f64) {
    on_gpu(|gpu| {
        let mut random = Random::new(41);
        let mut fraction = || random.below(1 << 20) as f64 / f64::from(1 << 20);
        let mut leaf = lit(AlphaMode::Opaque);
        leaf.lobes.diffuse_transmission =
            Some(DiffuseTransmission { color: [0.8; 3], factor: 0.5, texture: None, color_texture: None });
        let mut stage = Stage::new(vec![lit(AlphaMode::Opaque), leaf]);
        let mut corners: Vec<[DVec3; 3]> = Vec::new();
        let is_leaf = |triangle: usize| triangle % 2 == 1;
        for i in 0..count {
            let mut within = |side: f64| DVec3::new(fraction() - 0.5, fraction() - 0.5, fraction() - 0.5) * side;
            let middle = within(spread) * DVec3::new(2.0, 1.0, 1.0) - DVec3::Z * 3.5;
            let triangle = [(); 3].map(|()| (middle + within(side)).as_vec3());
            stage.add(usize::from(is_leaf(i)), triangle.map(|corner| corner.to_array()));
            corners.push(triangle.map(|corner| corner.as_dvec3()));
        }
        let down = DVec3::new(0.3, -1.0, -0.2);
        let above = DVec3::new(0.4, 2.5, -3.0);
        let among = DVec3::new(0.1, 0.2, -3.4);
        let lights = [
            light(LightKind::Directional, DVec3::ZERO, down),
            light(LightKind::Point, among, DVec3::NEG_Y),
            light(spot(30.0), above, DVec3::NEG_Y),
            Light { range: Some(2.8), ..light(spot(85.0), above, down) },
        ];
        let pinhole = pinhole(SIZE);
        let size = SIZE.map(f64::from);
        let mut within = |side: f64| side * (0.5 + part * (fraction() - 0.5));
        let locations: Vec<_> = (0..60_000).map(|_| location([within(size[0]), within(size[1])], 0)).collect();
        let seen = ask(gpu, &stage, &lights, &locations);
        let mut found = [[[0; 2]; 2]; 4];
        for (location, seen) in locations.iter().zip(&seen) {
            let Some(triangle) = (seen.id as usize).checked_sub(1) else {
                continue;
            };
            let ray = pinhole.ray(DVec2::from_array(location.uv));
            let [a, b, c] = corners[triangle];
            let normal = (b - a).cross(c - a);
            let distance = normal.dot(a - ray.start) / normal.dot(ray.direction);
            let receiver = Receiver {
                triangle,
                position: ray.start + ray.direction * distance,
                eye: ray.start,
                is_backlit: is_leaf(triangle),
            };
            for (bit, light) in lights.iter().enumerate() {
                let shining = shining(light, &corners);
                let Some(expected) = is_in_shadow(&corners, &receiver, &shining, 1e-4) else {
                    continue;
                };
                let hidden = seen.shadows >> bit & 1;
                assert_eq!(hidden, u32::from(expected), "{light:?} at {receiver:?}");
                found[bit][usize::from(is_leaf(triangle))][hidden as usize] += 1;
            }
        }
        for of_light in &found {
            let both = |hidden: usize| of_light[0][hidden] + of_light[1][hidden];
            assert!(both(0) > 400 && both(1) > 400, "{found:?}");
        }
        assert!(found.as_flattened().as_flattened().iter().all(|count| *count > 150), "{found:?}");
    });
}
