//! Lobes of material extensions, under lights for which their reflection has a closed form.

use std::f64::consts::PI;

use glam::DVec3;
use gpc::render::{Headless, SceneRequest, Settings};
use gpc::sampling::Pattern;
use gpc::scene::{
    AlphaMode, Anisotropy, Clearcoat, DiffuseTransmission, Iridescence, Light, LightKind, Lobes, Material, Sheen,
    Specular, SpecularGlossiness, Transmission,
};
use twins::sheen;

use crate::stage::{Stage, camera, everywhere, flat, on_gpu, once, seen_at};

/// Size of the image; it is odd, so that a pixel's centre is the image's centre.
const SIZE: [u32; 2] = [9, 9];
const MIDDLE: usize = 40;

const ROUGHNESS: f32 = 0.5;
/// GGX's alpha for that roughness.
const ALPHA: f64 = 0.25;
const COLOR: [f32; 3] = [0.8, 0.4, 0.2];

fn lit(lobes: Lobes) -> Material {
    let [r, g, b] = COLOR;
    Material { unlit: false, metallic: 0.0, roughness: ROUGHNESS, lobes, ..flat([r, g, b, 1.0], AlphaMode::Opaque) }
}

/// A surface at the image's centre, turned by `angle` from facing the eye.
fn surface(materials: Vec<Material>, angle: f64) -> Stage {
    let mut stage = Stage::new(materials);
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let (sin, cos) = angle.sin_cos();
    stage.add_quad(0, corners.map(|[x, y]: [f64; 2]| [x * cos, y, x * sin - 2.0].map(|v| v as f32)));
    stage
}

fn render(gpu: &mut Headless, stage: &Stage, lights: &[Light], settings: &Settings) -> [f64; 4] {
    let (scene, mut pose) = stage.build();
    pose.lights = lights.to_vec();
    pose.geometry.streams.tangents = vec![[1.0, 0.0, 0.0, 1.0]; pose.geometry.positions.len()];
    let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
    let mut frame = gpu.prepare(&prepared, settings).unwrap();
    let rendered = gpu.render(&mut frame, &camera()).unwrap();
    rendered.colors[MIDDLE].map(f64::from)
}

/// Light that a material facing the eye reflects towards it from light along z; with `toward` = 1 or -1 the light
/// travels towards or away from the eye.
fn response(gpu: &mut Headless, lobes: Lobes, toward: f64) -> [f64; 3] {
    let stage = surface(vec![lit(lobes)], 0.0);
    let mut with = |power: f32| {
        let light = Light {
            kind: LightKind::Directional,
            position: DVec3::ZERO,
            direction: DVec3::Z * toward,
            color: [power; 3],
            range: None,
        };
        render(gpu, &stage, &[light], &once(SIZE))
    };
    // The studio lights both images, so that it cancels.
    let (lit, dark) = (with(1.0), with(0.0));
    [0, 1, 2].map(|i| lit[i] - dark[i])
}

/// GGX distribution times visibility for an eye and a light along the normal.
fn peak(alpha: f64) -> f64 {
    1.0 / (4.0 * PI * alpha * alpha)
}

/// Reflection of the base alone, with the reflectance `f0` at normal incidence.
fn base(f0: [f64; 3], alpha: f64) -> [f64; 3] {
    let kept = 1.0 - f0.into_iter().fold(0.0, f64::max);
    [0, 1, 2].map(|i| kept * f64::from(COLOR[i]) / PI + f0[i] * peak(alpha))
}

fn assert_near(what: &str, found: [f64; 3], expected: [f64; 3], relative: f64) {
    for (found_channel, expected_channel) in found.iter().zip(expected) {
        assert!(
            (found_channel - expected_channel).abs() <= relative * expected_channel.abs() + 1e-6,
            "{what}: {found:?}, expected {expected:?}"
        );
    }
}

const AWAY: f64 = -1.0;

#[test]
fn reflections_along_the_normal_have_a_closed_form() {
    on_gpu(|gpu| {
        let plain = Lobes::default();
        let found = response(gpu, plain, AWAY);
        assert_near("the base", found, base([0.04; 3], ALPHA), 1e-4);

        let lobes = Lobes {
            specular: Some(Specular {
                reflectance: 1.0 / 9.0,
                factor: 0.5,
                color: [1.0, 0.5, 20.0],
                texture: None,
                color_texture: None,
            }),
            ..plain
        };
        let expected = base([0.5 / 9.0, 0.25 / 9.0, 0.5], ALPHA);
        assert_near("specular", response(gpu, lobes, AWAY), expected, 1e-4);

        let lobes = Lobes {
            specular_glossiness: Some(SpecularGlossiness {
                specular: [0.5, 0.25, 0.125],
                glossiness: 0.6,
                texture: None,
            }),
            ..plain
        };
        // Diffuse light is reduced by the reflected light, and, for this base, by its colour's reflectance.
        let expected = [0, 1, 2].map(|i| {
            let f0 = [0.5, 0.25, 0.125];
            0.5 * 0.5 * f64::from(COLOR[i]) / PI + f0[i] * peak(0.16)
        });
        let found = response(gpu, lobes, AWAY);
        assert_near("specular-glossiness", found, expected, 1e-4);

        let lobes = Lobes {
            clearcoat: Some(Clearcoat {
                factor: 0.75,
                roughness: 0.3,
                normal_scale: 1.0,
                texture: None,
                roughness_texture: None,
                normal_texture: None,
            }),
            ..plain
        };
        let weight = 0.75 * 0.04;
        let expected = base([0.04; 3], ALPHA).map(|x| x * (1.0 - weight) + weight * peak(0.09));
        assert_near("a coat", response(gpu, lobes, AWAY), expected, 1e-4);

        let lobes = Lobes { anisotropy: Some(Anisotropy { strength: 0.6, rotation: 0.7, texture: None }), ..plain };
        let along = ALPHA + (1.0 - ALPHA) * 0.36;
        let expected = base([0.04; 3], (along * ALPHA).sqrt());
        assert_near("anisotropy", response(gpu, lobes, AWAY), expected, 1e-4);
    });
}

/// In a film of many wavelengths, colours cancel, and its two borders reflect as if each were alone.
#[test]
fn a_thick_film_reflects_at_both_borders() {
    on_gpu(|gpu| {
        let lobes = Lobes {
            iridescence: Some(Iridescence {
                factor: 1.0,
                ior: 1.8,
                thickness: [50_000.0; 2],
                texture: None,
                thickness_texture: None,
            }),
            ..Lobes::default()
        };
        let between = |a: f64, b: f64| ((a - b) / (a + b)).powi(2);
        let (outer, inner) = (between(1.0, 1.8), between(1.8, 1.5));
        let f0 = outer + (1.0 - outer).powi(2) * inner / (1.0 - outer * inner);
        let found = response(gpu, lobes, AWAY);
        assert_near("a film", found, base([f0; 3], ALPHA), 1e-3);
    });
}

/// A film that is a quarter of a green wavelength thick and denser than both sides reflects more green than blue; one
/// of half a wavelength reflects no green.
#[test]
fn a_thin_film_has_the_colour_of_its_thickness() {
    on_gpu(|gpu| {
        let mut green = |waves: f32| {
            let lobes = Lobes {
                iridescence: Some(Iridescence {
                    factor: 1.0,
                    ior: 2.0,
                    thickness: [waves * 550.0 / 2.0; 2],
                    texture: None,
                    thickness_texture: None,
                }),
                specular: Some(Specular {
                    reflectance: 0.0,
                    factor: 1.0,
                    color: [1.0; 3],
                    texture: None,
                    color_texture: None,
                }),
                ..Lobes::default()
            };
            let stage = surface(vec![Material { base_color: [0.0, 0.0, 0.0, 1.0], ..lit(lobes) }], 0.0);
            let light = Light {
                kind: LightKind::Directional,
                position: DVec3::ZERO,
                direction: -DVec3::Z,
                color: [1.0; 3],
                range: None,
            };
            render(gpu, &stage, &[light], &once(SIZE))[1] / peak(ALPHA)
        };
        // For a single wavelength, the values are (1 - 4)^2 / (1 + 4)^2 and 0.
        let (quarter, half) = (green(0.25), green(0.5));
        assert!((quarter - 0.36).abs() < 0.06, "{quarter}");
        assert!(half < 0.06, "{half}");
    });
}

#[test]
fn sheen_takes_from_the_base_what_it_reflects() {
    on_gpu(|gpu| {
        for roughness in [0.2_f32, 0.5, 1.0] {
            for degrees in [0.0_f64, 40.0, 70.0] {
                let sheen = Sheen { color: [0.25, 0.5, 1.0], roughness, color_texture: None, roughness_texture: None };
                let mut glowing = |power: f32| {
                    let material =
                        Material { emissive: [power; 3], ..lit(Lobes { sheen: Some(sheen), ..Lobes::default() }) };
                    let stage = surface(vec![material], degrees.to_radians());
                    render(gpu, &stage, &[], &once(SIZE))[0]
                };
                let left = glowing(1.0) - glowing(0.0);
                let expected = 1.0 - sheen::albedo(f64::from(roughness), degrees.to_radians().cos());
                assert!(
                    (left - expected).abs() < 0.055,
                    "roughness {roughness}, {degrees} degrees: {left}, expected {expected}"
                );
            }
        }
    });
}

#[test]
fn light_from_behind_comes_through_a_leaf() {
    on_gpu(|gpu| {
        let lobes = Lobes {
            diffuse_transmission: Some(DiffuseTransmission {
                factor: 0.4,
                color: [0.9, 0.5, 0.1],
                texture: None,
                color_texture: None,
            }),
            ..Lobes::default()
        };
        let behind = [0.9, 0.5, 0.1].map(|color| 0.96 * 0.4 * color / PI);
        assert_near("behind", response(gpu, lobes, -AWAY), behind, 1e-4);
        let before = COLOR.map(|color| 0.96 * 0.6 * f64::from(color) / PI + 0.04 * peak(ALPHA));
        assert_near("before", response(gpu, lobes, AWAY), before, 1e-4);
    });
}

#[test]
fn panes_tint_what_lies_behind() {
    on_gpu(|gpu| {
        let pane = |base_color: [f32; 4], factor: f32, thickness: f32| Material {
            base_color,
            ..lit(Lobes {
                transmission: Some(Transmission {
                    factor,
                    texture: None,
                    thickness,
                    thickness_texture: None,
                    absorption: [0.1, 0.5, 1.0],
                }),
                ..Lobes::default()
            })
        };
        let mut through = |panes: &[Material]| {
            let mut with = |behind: f32| {
                let mut materials = vec![flat([behind; 4], AlphaMode::Opaque)];
                materials.extend_from_slice(panes);
                let mut stage = Stage::new(materials);
                let corners = [[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]];
                for index in 0..=panes.len() {
                    let distance = 4.0 - index as f64;
                    stage.add_quad(index, corners.map(|at| seen_at(at, distance, SIZE[1])));
                }
                render(gpu, &stage, &[], &everywhere(SIZE, Pattern::Sobol, 1))
            };
            let (bright, dark) = (with(2.0), with(0.0));
            [0, 1, 2].map(|i| (bright[i] - dark[i]) / 2.0)
        };
        // A clear pane reflects about 4 % and transmits the rest.
        let clear = through(&[pane([1.0; 4], 1.0, 0.0)]);
        assert!(clear.iter().all(|t| (t - 0.96).abs() < 0.01), "{clear:?}");
        let base = [0.8, 0.4, 0.2, 1.0];
        let tinted = [0, 1, 2].map(|i| {
            let absorbed = f64::exp(-2.0 * [0.1, 0.5, 1.0][i]);
            clear[i] * 0.75 * f64::from(base[i]) * absorbed
        });
        let pane = pane(base, 0.75, 2.0);
        // Tints are stored with ten bits of their square root.
        assert_near("a pane", through(std::slice::from_ref(&pane)), tinted, 0.02);
        let twice = tinted.map(|t| t * t);
        assert_near("two", through(&[pane.clone(), pane]), twice, 0.04);
    });
}
