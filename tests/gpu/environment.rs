//! Surfaces lit by an environment map: a white furnace, in which a surface that loses no light is invisible, and skies
//! with a closed form.

use std::sync::Arc;

use glam::DVec3;
use gpc::color::srgb;
use gpc::render::{Headless, SceneRequest};
use gpc::sampling::Pattern;
use gpc::scene::{
    AlphaMode, Anisotropy, Clearcoat, DiffuseTransmission, Environment, Iridescence, Lobes,
    Material, Sheen, Specular, SpecularGlossiness, Transmission,
};
use serde_json::json;

use crate::scene_builder::Builder;
use crate::stage::{Stage, camera, everywhere, flat, on_gpu};

/// Size of the image; it is odd, so that a pixel's centre is the image's centre.
const SIZE: [u32; 2] = [9, 9];
const MIDDLE: usize = 40;

/// Colour at the image's centre of a surface that is turned by `degrees` about the vertical axis.
fn seen(gpu: &mut Headless, material: &Material, sky: &Environment, degrees: f64) -> [f64; 4] {
    let mut stage = Stage::new(vec![material.clone()]);
    let (sin, cos) = degrees.to_radians().sin_cos();
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    stage.add_quad(
        0,
        corners.map(|[x, y]: [f64; 2]| [x * cos, y, x * sin - 2.0].map(|v| v as f32)),
    );
    let (mut scene, mut pose) = stage.build();
    scene.environment = Some(Arc::new(sky.clone()));
    let along = [cos as f32, 0.0, sin as f32, 1.0];
    pose.geometry.streams.tangents = vec![along; pose.geometry.positions.len()];
    let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
    let settings = everywhere(SIZE, Pattern::Sobol, 1);
    let mut frame = gpu.prepare(&prepared, &settings).unwrap();
    let rendered = gpu.render(&mut frame, &camera()).unwrap();
    rendered.colors[MIDDLE].map(f64::from)
}

fn white(roughness: f32, lobes: Lobes) -> Material {
    Material {
        unlit: false,
        metallic: 0.0,
        roughness,
        lobes,
        ..flat([1.0; 4], AlphaMode::Opaque)
    }
}

/// Environment whose radiance is a function of the direction.
fn sky(radiance: impl Fn(DVec3) -> [f32; 3]) -> Environment {
    let (width, height) = (64_u32, 32_u32);
    let pixels: Vec<[f32; 3]> = (0..width * height)
        .map(|i| {
            let angle = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
            let longitude = (angle(i % width, width) - 0.5) * std::f64::consts::TAU;
            let latitude = (0.5 - angle(i / width, height)) * std::f64::consts::PI;
            let ((sin, cos), (up, across)) = (longitude.sin_cos(), latitude.sin_cos());
            radiance(DVec3::new(sin * across, up, -cos * across))
        })
        .collect();
    Environment::from_equirectangular(width, height, pixels).unwrap()
}

#[test]
fn a_white_furnace_neither_gains_nor_loses() {
    on_gpu(|gpu| {
        let furnace = sky(|_| [1.0; 3]);
        let plain = Lobes::default();
        let all = [
            ("the base", plain),
            (
                "specular",
                Lobes {
                    specular: Some(Specular {
                        reflectance: 0.2,
                        factor: 0.7,
                        color: [1.0; 3],
                        texture: None,
                        color_texture: None,
                    }),
                    ..plain
                },
            ),
            (
                "sheen",
                Lobes {
                    sheen: Some(Sheen {
                        color: [1.0; 3],
                        roughness: 0.3,
                        color_texture: None,
                        roughness_texture: None,
                    }),
                    ..plain
                },
            ),
            (
                "a coat",
                Lobes {
                    clearcoat: Some(Clearcoat {
                        factor: 1.0,
                        roughness: 0.0,
                        normal_scale: 1.0,
                        texture: None,
                        roughness_texture: None,
                        normal_texture: None,
                    }),
                    ..plain
                },
            ),
            (
                "anisotropy",
                Lobes {
                    anisotropy: Some(Anisotropy {
                        strength: 0.8,
                        rotation: 0.3,
                        texture: None,
                    }),
                    ..plain
                },
            ),
            (
                "a film",
                Lobes {
                    iridescence: Some(Iridescence {
                        factor: 1.0,
                        ior: 1.7,
                        thickness: [380.0; 2],
                        texture: None,
                        thickness_texture: None,
                    }),
                    ..plain
                },
            ),
            (
                "a leaf",
                Lobes {
                    diffuse_transmission: Some(DiffuseTransmission {
                        factor: 0.4,
                        color: [1.0; 3],
                        texture: None,
                        color_texture: None,
                    }),
                    ..plain
                },
            ),
            (
                "specular-glossiness",
                Lobes {
                    specular_glossiness: Some(SpecularGlossiness {
                        specular: [0.0; 3],
                        glossiness: 0.5,
                        texture: None,
                    }),
                    ..plain
                },
            ),
        ];
        for (name, lobes) in all {
            for degrees in [0.0, 45.0, 75.0] {
                let found = seen(gpu, &white(0.4, lobes), &furnace, degrees);
                let near = found.iter().take(3).all(|x| (0.97..=1.002).contains(x));
                assert!(near, "{name} at {degrees} degrees: {found:?}");
            }
        }
        // A pane transmits the light that it does not reflect.
        let pane = Lobes {
            transmission: Some(Transmission {
                factor: 1.0,
                texture: None,
                thickness: 1.0,
                thickness_texture: None,
                absorption: [0.0; 3],
            }),
            ..plain
        };
        let found = seen(gpu, &white(0.4, pane), &furnace, 45.0);
        for light in &found[..3] {
            let sum = light + 1.0 - found[3];
            assert!((sum - 1.0).abs() < 0.005, "a pane: {found:?}");
        }
        // The model of a single bounce loses 0.55 at the roughness of this metal.
        let metal = Material {
            metallic: 1.0,
            ..white(0.4, plain)
        };
        let found = seen(gpu, &metal, &furnace, 45.0);
        assert!((found[0] - 0.78).abs() < 1e-3, "metal: {found:?}");
    });
}

/// In a sky that changes with the direction, a matt surface has the irradiance of the coefficients, and a mirror shows
/// the place at which it looks, however the sky is turned.
#[test]
fn the_sky_turns() {
    on_gpu(|gpu| {
        let colors = |d: DVec3| [1.0 + d.x, 1.0 + d.y, 1.0 + d.z].map(|x| x as f32);
        let matt = white(
            1.0,
            Lobes {
                specular: Some(Specular {
                    reflectance: 0.0,
                    factor: 0.0,
                    color: [0.0; 3],
                    texture: None,
                    color_texture: None,
                }),
                ..Lobes::default()
            },
        );
        let mirror = Material {
            metallic: 1.0,
            roughness: 0.0,
            ..white(0.0, Lobes::default())
        };
        for turn in [0.0_f64, 30.0, 200.0] {
            let sky = sky(colors).turned(turn.to_radians());
            // Direction in the map for a direction in the world.
            let (sin, cos) = turn.to_radians().sin_cos();
            let in_map = |d: DVec3| DVec3::new(d.x * cos - d.z * sin, d.y, d.x * sin + d.z * cos);
            for degrees in [0.0_f64, 35.0] {
                let normal =
                    DVec3::new(-degrees.to_radians().sin(), 0.0, degrees.to_radians().cos());
                let found = seen(gpu, &matt, &sky, degrees);
                let expected = in_map(normal);
                let expected = [expected.x, expected.y, expected.z].map(|x| 1.0 + x * 2.0 / 3.0);
                let reflected = 2.0 * normal.z * normal - DVec3::Z;
                let shown = seen(gpu, &mirror, &sky, degrees);
                let looked_at = colors(in_map(reflected));
                for channel in 0..3 {
                    let (found, expected) = (found[channel], expected[channel]);
                    assert!(
                        (found - expected).abs() < 0.02,
                        "matt, {turn}, {degrees}: {found}, expected {expected}"
                    );
                    // The mirror's roughness of 0.04 costs 2.2 %.
                    let (shown, expected) = (shown[channel], f64::from(looked_at[channel]));
                    assert!(
                        (shown - expected * 0.978).abs() < 0.03,
                        "mirror, {turn}, {degrees}: {shown}, expected {expected}"
                    );
                }
            }
        }
    });
}

/// A light that is too bright for half floats keeps its brightness.
#[test]
fn a_bright_sky_is_not_cut_off() {
    on_gpu(|gpu| {
        let sky = sky(|_| [3e5; 3]);
        let found = seen(gpu, &white(0.4, Lobes::default()), &sky, 20.0);
        assert!((found[0] / 3e5 - 1.0).abs() < 2e-3, "{found:?}");
    });
}

/// A uniform environment in a glTF file equals one that is made from an image.
#[test]
fn a_files_own_light_shines_as_an_image_does() {
    on_gpu(|gpu| {
        let mut builder = Builder::new();
        builder.triangle(json!({}));
        let faces = [(); 6].map(|()| builder.rgba([188, 188, 188, 64]));
        let radiance = srgb::decode_u8(188) * 255.0 / 64.0;
        let mut coefficients = [[0.0; 3]; 9];
        coefficients[0] = [radiance * std::f64::consts::PI / 0.282_095; 3];
        builder.json["extensions"] = json!({"EXT_lights_image_based": {"lights": [{
            "irradianceCoefficients": coefficients, "specularImageSize": 1, "specularImages": [faces],
        }]}});
        let chosen = json!({"EXT_lights_image_based": {"light": 0}});
        builder.json["scenes"] = json!([{"nodes": [0], "extensions": chosen}]);
        let own = builder.pose().environment.unwrap();
        let image = sky(|_| [radiance as f32; 3]);
        for roughness in [0.0, 0.5, 1.0] {
            let material = white(roughness, Lobes::default());
            let found = seen(gpu, &material, &own, 30.0);
            let expected = seen(gpu, &material, &image, 30.0);
            let pairs = found.into_iter().zip(expected);
            let off = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 2e-3 * radiance, "{found:?}, not {expected:?}");
        }
    });
}
