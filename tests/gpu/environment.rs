//! Surfaces lit by an environment map: a white furnace, in which a surface that loses no light is invisible, and skies
//! with a closed form.

use std::{collections::BTreeSet, sync::Arc};

use glam::DVec3;
use gpc::color::srgb;
use gpc::render::{Headless, SceneRequest};
use gpc::sampling::Pattern;
use gpc::scene::{
    AlphaMode, Anisotropy, Clearcoat, DiffuseTransmission, Environment, Iridescence, Lobes, Material, Sheen, Specular,
    SpecularGlossiness, Transmission,
};
use serde_json::json;
use twins::prefilter::density;

use crate::scene_builder::Builder;
use crate::stage::{Stage, camera, centre, everywhere, flat, on_gpu, once, seen_at};

/// Size of the image; it is odd, so that a pixel's centre is the image's centre.
const SIZE: [u32; 2] = [9, 9];
const MIDDLE: usize = 40;

/// Colour at the image's centre of a surface that is turned by `degrees` about the vertical axis.
fn seen(gpu: &mut Headless, material: &Material, sky: &Environment, degrees: f64) -> [f64; 4] {
    let mut stage = Stage::new(vec![material.clone()]);
    let (sin, cos) = degrees.to_radians().sin_cos();
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    stage.add_quad(0, corners.map(|[x, y]: [f64; 2]| [x * cos, y, x * sin - 2.0].map(|v| v as f32)));
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
    Material { unlit: false, metallic: 0.0, roughness, lobes, ..flat([1.0; 4], AlphaMode::Opaque) }
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
                Lobes { anisotropy: Some(Anisotropy { strength: 0.8, rotation: 0.3, texture: None }), ..plain },
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
        let metal = Material { metallic: 1.0, ..white(0.4, plain) };
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
        let mirror = Material { metallic: 1.0, roughness: 0.0, ..white(0.0, Lobes::default()) };
        for turn in [0.0_f64, 30.0, 200.0] {
            let sky = sky(colors).turned(turn.to_radians());
            // Direction in the map for a direction in the world.
            let (sin, cos) = turn.to_radians().sin_cos();
            let in_map = |d: DVec3| DVec3::new(d.x * cos - d.z * sin, d.y, d.x * sin + d.z * cos);
            for degrees in [0.0_f64, 35.0] {
                let normal = DVec3::new(-degrees.to_radians().sin(), 0.0, degrees.to_radians().cos());
                let found = seen(gpu, &matt, &sky, degrees);
                let expected = in_map(normal);
                let expected = [expected.x, expected.y, expected.z].map(|x| 1.0 + x * 2.0 / 3.0);
                let reflected = 2.0 * normal.z * normal - DVec3::Z;
                let shown = seen(gpu, &mirror, &sky, degrees);
                let looked_at = colors(in_map(reflected));
                for channel in 0..3 {
                    let (found, expected) = (found[channel], expected[channel]);
                    assert!((found - expected).abs() < 0.02, "matt, {turn}, {degrees}: {found}, expected {expected}");
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

/// Size of the map with bright texels.
const MAP: [u32; 2] = [1024, 512];

/// Direction of a place in that map, in texels.
fn towards([x, y]: [f64; 2]) -> DVec3 {
    let longitude = (x / f64::from(MAP[0]) - 0.5) * std::f64::consts::TAU;
    let latitude = (0.5 - y / f64::from(MAP[1])) * std::f64::consts::PI;
    let ((sin, cos), (up, across)) = (longitude.sin_cos(), latitude.sin_cos());
    DVec3::new(sin * across, up, -cos * across)
}

fn middle(place: [u32; 2]) -> [f64; 2] {
    place.map(|i| f64::from(i) + 0.5)
}

/// Small parts of the light of bright texels, which is interpolated to the texels beside them: directions, and light.
fn parts_of(sky: &Environment, bright: &[[u32; 2]], fine: u32) -> Vec<(DVec3, f64)> {
    let around = |[x, y]: [u32; 2]| (0..9).map(move |i| [(x + i % 3 + MAP[0] - 1) % MAP[0], y + i / 3 - 1]);
    let texels: BTreeSet<[u32; 2]> = bright.iter().flat_map(|place| around(*place)).collect();
    let divided = texels.into_iter().flat_map(|[x, y]| {
        let all = (0..fine * fine).map(move |i| [i % fine, i / fine]);
        all.map(move |[dx, dy]| [(x, dx), (y, dy)].map(|(i, d)| f64::from(i) + (f64::from(d) + 0.5) / f64::from(fine)))
    });
    let area = std::f64::consts::TAU * std::f64::consts::PI / f64::from(MAP[0] * MAP[1] * fine * fine);
    let part = |place| {
        let direction = towards(place);
        let across = (1.0 - direction.y * direction.y).sqrt();
        (direction, (sky.radiance(direction).x - 0.5) * area * across)
    };
    divided.map(part).filter(|(_, light)| *light > 0.0).collect()
}

/// Suns of several sizes: every roughness reflects them as smooth spots with the map's light, which is what averaging very many
/// directions gives.
#[test]
fn suns_are_smooth_highlights() {
    let square = |side: u32| (0..side * side).map(|i| [362 + i % side, 161 + i / side]).collect::<Vec<_>>();
    let skies = [("a texel", square(1)), ("8 x 8", square(8)), ("32 x 32", square(32))];
    on_gpu(|gpu| {
        for (name, bright) in skies {
            const SUN: f32 = 2e5;
            let mut pixels = vec![[0.5; 3]; (MAP[0] * MAP[1]) as usize];
            for [x, y] in &bright {
                pixels[(y * MAP[0] + x) as usize] = [SUN; 3];
            }
            let sky = Environment::from_equirectangular(MAP[0], MAP[1], pixels).unwrap();
            let [coarse, fine] = [3, 8].map(|fine| parts_of(&sky, &bright, fine));
            let centre = towards(middle(bright[0]));
            let (right, up) = centre.any_orthonormal_pair();
            // A surface is at least as rough as 0.04.
            for roughness in [0.04_f64, 0.08, 0.11, 0.15, 0.2, 0.3, 0.5, 0.7] {
                let alpha = roughness * roughness;
                // Reflected directions in rows over the centre, at least twice as wide as the highlight of a texel.
                let wide = 6.0 * alpha.min(0.3) + if bright.len() > 1 { 0.04 } else { 0.01 };
                let step = wide / f64::from(WIDE[0]);
                let reflected = |pixel: u32| {
                    let [x, y] = [pixel % WIDE[0], pixel / WIDE[0]].map(f64::from);
                    let off = [x - f64::from(WIDE[0]) / 2.0, (y - f64::from(WIDE[1]) / 2.0) * 3.0];
                    (centre + step * (off[0] * right + off[1] * up)).normalize()
                };
                let directions: Vec<DVec3> = (0..WIDE[0] * WIDE[1]).map(reflected).collect();
                let found = reflections(gpu, &sky, roughness as f32, &directions);
                let parts = if alpha < 0.02 { &fine } else { &coarse };
                // Parts beyond these have no share in a narrow lobe that counts.
                let farthest = 0.5 * wide + 60.0 * alpha;
                let near: Vec<_> = parts.iter().filter(|(d, _)| d.distance(centre) < farthest).collect();
                let average = |towards: &DVec3| {
                    let of_suns = near.iter().map(|(d, light)| light * density(alpha, d.dot(*towards)));
                    0.5 + of_suns.sum::<f64>()
                };
                let expected: Vec<f64> = directions.iter().map(average).collect();
                let peak = expected.iter().copied().fold(0.0, f64::max);
                assert!(peak > 2.0, "{name}: {peak}");
                let mut worst = 0.0_f64;
                for (found, expected) in found.iter().zip(&expected) {
                    worst = worst.max((found - expected).abs() / peak);
                }
                // Nor are there edges: the second differences are those of the average.
                let (mut sharpest, mut sharp) = (0.0_f64, 0.0_f64);
                for row in 0..WIDE[1] as usize {
                    let row = row * WIDE[0] as usize..(row + 1) * WIDE[0] as usize;
                    let bend = |values: &[f64]| {
                        let bends = values.windows(3).map(|w| (w[0] - 2.0 * w[1] + w[2]).abs() / peak);
                        bends.fold(0.0, f64::max)
                    };
                    sharp = sharp.max(bend(&found[row.clone()]));
                    sharpest = sharpest.max(bend(&expected[row]));
                }
                assert!(worst < 0.04, "{name}, roughness {roughness}: {worst} of {peak}");
                assert!(sharp < 1.3 * sharpest + 2e-3, "{name}, roughness {roughness}: {sharp}, {sharpest}");
            }
        }
    });
}

/// The highlight of a sun of one texel grows darker with the distance from its middle, far into the tail of the lobe, where a
/// thousandth of the peak still shows.
#[test]
fn a_highlight_falls_off_to_all_sides() {
    let bright = [362, 161];
    let mut pixels = vec![[0.5; 3]; (MAP[0] * MAP[1]) as usize];
    pixels[(bright[1] * MAP[0] + bright[0]) as usize] = [5e4; 3];
    let sky = Environment::from_equirectangular(MAP[0], MAP[1], pixels).unwrap();
    let centre = towards(middle(bright));
    let (right, up) = centre.any_orthonormal_pair();
    // From the middle outwards, a row for each side.
    let outwards = |pixel: u32| {
        let turn = f64::from(pixel / WIDE[0]) * 1.3;
        let away = 0.0012 * f64::from(pixel % WIDE[0]);
        (centre + away * (turn.cos() * right + turn.sin() * up)).normalize()
    };
    let directions: Vec<DVec3> = (0..WIDE[0] * WIDE[1]).map(outwards).collect();
    on_gpu(|gpu| {
        for roughness in [0.04, 0.06, 0.1] {
            let found = reflections(gpu, &sky, roughness, &directions);
            for row in found.chunks(WIDE[0] as usize) {
                let rises = row.windows(2).position(|w| w[1] > 1.01 * w[0]);
                assert_eq!(rises, None, "roughness {roughness}: {row:?}");
            }
        }
    });
}

/// Size of an image whose pixels see one direction each.
const WIDE: [u32; 2] = [48, 5];

/// Radiance around each of these directions, averaged over the lobe of a white metal of this roughness.
fn reflections(gpu: &mut Headless, sky: &Environment, roughness: f32, directions: &[DVec3]) -> Vec<f64> {
    let metal = Material { metallic: 1.0, ..white(roughness, Lobes::default()) };
    let mut stage = Stage::new(vec![metal]);
    let corners = [[-0.4, -0.4], [-0.4, 0.4], [0.4, 0.4], [0.4, -0.4]];
    let mut normals = Vec::new();
    for (pixel, direction) in directions.iter().enumerate() {
        let [x, y] = centre(pixel, WIDE);
        stage.add_quad(0, corners.map(|[dx, dy]| seen_at([x + dx, y + dy], 1.0, WIDE[1])));
        let to_eye = -DVec3::from_array(seen_at([x, y], 1.0, WIDE[1]).map(f64::from)).normalize();
        normals.push((to_eye + *direction).normalize());
    }
    let uniform = self::sky(|_| [1.0; 3]);
    let mut seen = |sky: &Environment| -> Vec<f64> {
        let (mut scene, mut pose) = stage.build();
        scene.environment = Some(Arc::new(sky.clone()));
        let of_normal = |n: &DVec3| [n.as_vec3().to_array(); 6];
        pose.geometry.streams.normals = normals.iter().flat_map(of_normal).collect();
        let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
        let mut frame = gpu.prepare(&prepared, &once(WIDE)).unwrap();
        let rendered = gpu.render(&mut frame, &camera()).unwrap();
        rendered.colors.iter().map(|color| f64::from(color[0])).collect()
    };
    let (lit, share) = (seen(sky), seen(&uniform));
    lit.iter().zip(share).map(|(lit, share)| lit / share).collect()
}
