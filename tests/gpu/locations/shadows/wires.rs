//! Shadows that are narrower than a pixel.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use gpc::camera::Pinhole;
use gpc::render::{Settings, Shadows};
use gpc::scene::{AlphaMode, Light, LightKind, Material};

use super::super::planar;
use super::{FLOOR, floor, light, lit, render, upload};
use crate::stage::{camera, on_gpu};

const SIZE: [u32; 2] = [640, 360];
/// Width of a wire's shadow in pixels.
const WIDTH: f64 = 0.2;
const LENGTH: f64 = 50.0;
/// Part of the image for each wire, in pixels.
const PART: [u32; 2] = [160, 62];
const FIRST_ROW: u32 = 234;

/// Wires out of view, whose shadows are a fifth of a pixel wide and have all directions, block as much light as the
/// area of their shadows.
#[test]
fn the_shadow_of_a_thin_wire_keeps_its_energy() {
    on_gpu(|gpu| {
        let rough = Material { roughness: 1.0, ..lit(AlphaMode::Opaque) };
        let mut stage = floor(vec![rough]);
        let pinhole = Pinhole::from_camera(&camera(), SIZE).unwrap();
        let sun = light(LightKind::Directional, DVec3::ZERO, DVec3::new(0.1, -1.0, 0.05));
        let part = |wire: u32| [PART[0] * (wire % 4), FIRST_ROW + PART[1] * (wire / 4)];
        for wire in 0..8 {
            let [x, y] = part(wire).map(f64::from);
            let middle = DVec2::new(x + 80.3, y + 31.6);
            let along = DVec2::from_angle(PI * (f64::from(wire) + 0.37) / 8.0);
            let (along, across) = (along * LENGTH / 2.0, along.perp() * WIDTH / 2.0);
            let above = |uv: DVec2| {
                let ray = pinhole.ray(uv);
                let to_floor = (FLOOR - ray.start.y) / ray.direction.y;
                let on_floor = ray.start + ray.direction * to_floor;
                (on_floor - sun.direction * 20.0).as_vec3().to_array()
            };
            stage.add_quad(
                0,
                [
                    above(middle - along - across),
                    above(middle + along - across),
                    above(middle + along + across),
                    above(middle - along + across),
                ],
            );
        }
        let rig = [(pinhole, planar(SIZE))];
        let mut image = |sun: Light, shadows: Shadows, as_list: bool| {
            let settings = Settings::new(SIZE[0], SIZE[1]).shadows(shadows);
            let prepared = upload(gpu, &stage, &[sun]);
            if as_list {
                let rendered = gpu.render_locations(&prepared, &rig, &settings);
                return rendered.unwrap().colors;
            }
            render(gpu, &prepared, &settings).colors
        };
        let shadowed = [false, true].map(|as_list| image(sun, Shadows::Exact, as_list));
        let open = image(sun, Shadows::None, false);
        let dark = Light { color: [0.0; 3], ..sun };
        let ambient = image(dark, Shadows::None, false);
        let taken = |shadowed: &[[f32; 4]], wire: u32| -> f64 {
            let [left, top] = part(wire);
            let rows = (top..top + PART[1]).map(|y| (y * SIZE[0] + left) as usize);
            let pixels = rows.flat_map(|row| row..row + PART[0] as usize);
            let share = |i: usize| {
                let [open, shadowed, ambient] = [&open, shadowed, &ambient].map(|image| f64::from(image[i][1]));
                if open == ambient {
                    return 0.0;
                }
                (open - shadowed) / (open - ambient)
            };
            pixels.map(share).sum::<f64>() / (WIDTH * LENGTH)
        };
        for shadowed in &shadowed {
            let energies: Vec<f64> = (0..8).map(|wire| taken(shadowed, wire)).collect();
            let mean = energies.iter().sum::<f64>() / 8.0;
            assert!((mean - 1.0).abs() < 0.03, "{energies:?}");
            assert!(energies.iter().all(|energy| (energy - 1.0).abs() < 0.08), "{energies:?}");
        }
    });
}
