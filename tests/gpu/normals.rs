//! Normals that point anywhere, also away from the eye: the colour follows them without a jump, and is the twin's.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;
use gpc::camera::Camera;
use gpc::render::{Headless, SceneRequest};
use gpc::scene::{AlphaMode, Anisotropy, Clearcoat, Iridescence, Light, LightKind, Lobes, Material, Sheen};
use twins::reflection::{Surface, reflected};

use crate::meshes::Random;
use crate::stage::{Stage, camera, centre, flat, on_gpu, once, seen_at};

const SIZE: [u32; 2] = [64, 48];
const PIXELS: usize = (SIZE[0] * SIZE[1]) as usize;
const COLOR: [f32; 3] = [0.8, 0.4, 0.2];
/// Direction to the light.
const LIGHT: DVec3 = DVec3::new(0.48, 0.64, 0.6);
/// Angle, in radians, by which a normal turns; distance, in distances of the surface, by which the eye moves.
const TURN: f64 = 2e-4;

fn lit(roughness: f32, lobes: Lobes) -> Material {
    let [r, g, b] = COLOR;
    Material { unlit: false, metallic: 0.0, roughness, lobes, ..flat([r, g, b, 1.0], AlphaMode::Opaque) }
}

/// Directions to the eye from the middle of each pixel.
fn to_eye(pixel: usize) -> DVec3 {
    let [x, y] = centre(pixel, SIZE);
    let [x, y, z] = seen_at([x, y], 1.0, SIZE[1]).map(f64::from);
    -DVec3::new(x, y, z).normalize()
}

/// Colours of an image in which each pixel sees a front face with a normal of its own, and with a tangent if there are any.
fn seen(
    gpu: &mut Headless,
    material: &Material,
    (normals, tangents): (&[DVec3], &[DVec3]),
    light: f32,
    eye: DVec3,
) -> Vec<DVec3> {
    let mut stage = Stage::new(vec![material.clone()]);
    let corners = [[-0.4, -0.4], [-0.4, 0.4], [0.4, 0.4], [0.4, -0.4]];
    for pixel in 0..PIXELS {
        let [x, y] = centre(pixel, SIZE);
        stage.add_quad(0, corners.map(|[dx, dy]| seen_at([x + dx, y + dy], 1.0, SIZE[1])));
    }
    let (scene, mut pose) = stage.build();
    let streams = &mut pose.geometry.streams;
    let of_normal = |n: &DVec3| [n.as_vec3().to_array(); 6];
    streams.normals = normals.iter().flat_map(of_normal).collect();
    let of_tangent = |t: &DVec3| [t.as_vec3().extend(1.0).to_array(); 6];
    streams.tangents = tangents.iter().flat_map(of_tangent).collect();
    pose.lights = vec![Light {
        kind: LightKind::Directional,
        position: DVec3::ZERO,
        direction: -LIGHT,
        color: [light; 3],
        range: None,
    }];
    let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
    let mut frame = gpu.prepare(&prepared, &once(SIZE)).unwrap();
    let rendered = gpu.render(&mut frame, &Camera { eye, ..camera() }).unwrap();
    assert!(rendered.attributes.iter().all(|pixel| pixel.id != 0));
    let colors = rendered.colors.iter();
    colors.map(|&[r, g, b, _]| DVec3::new(r.into(), g.into(), b.into())).collect()
}

fn unit(random: &mut Random) -> DVec3 {
    let mut fraction = || f64::from(random.below(1 << 20) as u32) / f64::from(1 << 20);
    let (z, turn) = (2.0 * fraction() - 1.0, TAU * fraction());
    let across = (1.0 - z * z).sqrt();
    DVec3::new(across * turn.cos(), across * turn.sin(), z)
}

/// Normals for all pixels: a third anywhere, a third about straight away from the eye, a third about perpendicular to the view.
fn normals(random: &mut Random) -> Vec<DVec3> {
    let of = |pixel: usize| {
        let (any, eye) = (unit(random), to_eye(pixel));
        let near = match pixel % 3 {
            0 => any,
            1 => -eye + 5.0 * TURN * any,
            _ => any.reject_from_normalized(eye).normalize() + 5.0 * TURN * unit(random),
        };
        near.normalize()
    };
    (0..PIXELS).map(of).collect()
}

fn turned(normals: &[DVec3], random: &mut Random) -> Vec<DVec3> {
    let turn = |normal: &DVec3| {
        let sideways = unit(random).reject_from_normalized(*normal).normalize();
        (*normal + TURN * sideways).normalize()
    };
    normals.iter().map(turn).collect()
}

#[test]
fn small_turns_of_normal_or_view_are_small_changes_of_the_colour() {
    on_gpu(|gpu| {
        let plain = Lobes::default();
        let sheen = Sheen { color: [0.3, 0.6, 0.9], roughness: 0.5, color_texture: None, roughness_texture: None };
        let clearcoat = Clearcoat {
            factor: 1.0,
            roughness: 0.5,
            normal_scale: 1.0,
            texture: None,
            roughness_texture: None,
            normal_texture: None,
        };
        let iridescence =
            Iridescence { factor: 1.0, ior: 1.8, thickness: [400.0; 2], texture: None, thickness_texture: None };
        let metal = Material { metallic: 1.0, ..lit(0.6, plain) };
        let all = [
            ("a metal", metal),
            ("the base", lit(0.6, plain)),
            ("sheen", lit(0.6, Lobes { sheen: Some(sheen), ..plain })),
            ("a coat", lit(0.6, Lobes { clearcoat: Some(clearcoat), ..plain })),
            ("a film", lit(0.6, Lobes { iridescence: Some(iridescence), ..plain })),
        ];
        let mut random = Random::new(11);
        for (name, material) in all {
            let before = normals(&mut random);
            let after = turned(&before, &mut random);
            let moved = TURN * unit(&mut random);
            let [first, turned, moved] = [(&before, DVec3::ZERO), (&after, DVec3::ZERO), (&before, moved)]
                .map(|(normals, eye)| seen(gpu, &material, (normals, &[]), 3.0, eye));
            // Where both eye and light graze a surface, a lobe of the model rises from 0 to its full height within less than a turn.
            let grazed = |pixel: usize| {
                let normal = before[pixel];
                [to_eye(pixel), LIGHT].map(|d| normal.dot(d).abs()).iter().all(|cosine| *cosine < 0.05)
            };
            for pixel in (0..PIXELS).filter(|pixel| !grazed(*pixel)) {
                for (what, second) in [("normal", turned[pixel]), ("view", moved[pixel])] {
                    let off = (first[pixel] - second).abs().max_element();
                    assert!(
                        off < 60.0 * TURN,
                        "{name}: {} and {second} for a {what} about {} and {}",
                        first[pixel],
                        before[pixel],
                        to_eye(pixel)
                    );
                }
            }
        }
    });
}

/// The axis of a stretched reflection has no direction where a mirrored normal points along it.
#[test]
fn stretched_reflections_fade_with_their_axis() {
    on_gpu(|gpu| {
        let anisotropy = Anisotropy { strength: 1.0, rotation: 0.0, texture: None };
        let material = lit(0.6, Lobes { anisotropy: Some(anisotropy), ..Lobes::default() });
        // A normal at 45 degrees beyond the horizon is mirrored at a right angle, here to its tangent.
        let mut random = Random::new(12);
        let side = |pixel: usize| (to_eye(pixel), to_eye(pixel).any_orthonormal_vector());
        let mut away = |pixel: usize| {
            let (eye, side) = side(pixel);
            (side - eye + 5.0 * TURN * unit(&mut random)).normalize()
        };
        let before: Vec<_> = (0..PIXELS).map(&mut away).collect();
        let along = |pixel: usize| {
            let (eye, side) = side(pixel);
            (side + eye).normalize()
        };
        let tangents: Vec<_> = (0..PIXELS).map(along).collect();
        let after = turned(&before, &mut random);
        let [first, second] =
            [&before, &after].map(|normals| seen(gpu, &material, (normals, &tangents), 3.0, DVec3::ZERO));
        for pixel in 0..PIXELS {
            let off = (first[pixel] - second[pixel]).abs().max_element();
            assert!(off < 60.0 * TURN, "{} and {}", first[pixel], second[pixel]);
        }
    });
}

#[test]
fn light_on_normals_of_any_direction_is_the_twins() {
    on_gpu(|gpu| {
        let mut random = Random::new(13);
        for roughness in [0.4_f32, 0.8] {
            let material = lit(roughness, Lobes::default());
            let normals = normals(&mut random);
            // The studio lights both images, so that it cancels.
            let [lit, dark] = [3.0, 0.0].map(|light| seen(gpu, &material, (&normals, &[]), light, DVec3::ZERO));
            let mut away = 0;
            for pixel in 0..PIXELS {
                let surface = Surface {
                    normal: normals[pixel],
                    diffuse: DVec3::from_array(COLOR.map(f64::from)),
                    f0: DVec3::splat(0.04),
                    alpha: f64::from(roughness).powi(2),
                };
                let expected = 3.0 * reflected(&surface, to_eye(pixel), LIGHT);
                let found = lit[pixel] - dark[pixel];
                let off = (found - expected).abs() / (0.05 + expected);
                // Close to the horizon, a rounded normal changes the light that is reflected.
                assert!(
                    off.max_element() < 0.02,
                    "{found}, expected {expected}, for {} seen from {}",
                    normals[pixel],
                    to_eye(pixel)
                );
                away += usize::from(normals[pixel].angle_between(to_eye(pixel)) > FRAC_PI_2);
            }
            assert!(away > PIXELS / 3, "{away}");
        }
    });
}
