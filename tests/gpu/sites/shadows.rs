//! Exact shadows against their closed form.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use gpc::camera::{Pinhole, Site};
use gpc::render::{
    Detection, Headless, PointSample, PreparedScene, RenderError, Settings, Shading, Shadows,
};
use gpc::sampling::Pattern;
use gpc::scene::{AlphaMode, Filter, Image, Light, LightKind, Material, Sampler};

use super::{pinhole, site};
use crate::meshes::Random;
use crate::scenes::ball_over_checker;
use crate::stage::{Stage, camera, everywhere, flat, on_gpu, once, textured};

const SIZE: [u32; 2] = [1280, 720];
/// Height of the floor, which is the first two triangles of a stage.
const FLOOR: f64 = -1.0;
/// A triangle over the floor.
const OVER: [[f32; 3]; 3] = [[-0.9, 0.3, -2.7], [1.1, 0.5, -3.4], [0.2, 0.9, -2.2]];

fn lit(alpha_mode: AlphaMode) -> Material {
    Material {
        unlit: false,
        metallic: 0.0,
        ..flat([0.7, 0.7, 0.7, 1.0], alpha_mode)
    }
}

/// A floor, of the stage's first material.
fn floor(materials: Vec<Material>) -> Stage {
    let mut stage = Stage::new(materials);
    let corner = |x: f32, z: f32| [x, FLOOR as f32, z];
    let quad = [
        corner(-9.0, -0.5),
        corner(9.0, -0.5),
        corner(9.0, -14.0),
        corner(-9.0, -14.0),
    ];
    stage.add_quad(0, quad);
    stage
}

fn light(kind: LightKind, position: DVec3, direction: DVec3) -> Light {
    Light {
        kind,
        position,
        direction: direction.normalize(),
        color: [3.0; 3],
        range: None,
    }
}

fn sun() -> Light {
    let direction = DVec3::new(0.25, -1.0, -0.4);
    light(LightKind::Directional, DVec3::ZERO, direction)
}

/// Lights from a point over the triangle, towards it.
fn lamp(kind: LightKind) -> Light {
    let position = DVec3::new(-0.4, 2.9, -2.1);
    light(kind, position, DVec3::new(0.2, -1.0, -0.3))
}

fn spot(outer_degrees: f32) -> LightKind {
    LightKind::Spot {
        inner_angle: 0.1,
        outer_angle: outer_degrees.to_radians(),
    }
}

fn upload(gpu: &mut Headless, stage: &Stage, lights: &[Light]) -> PreparedScene {
    let (scene, mut pose) = stage.build();
    pose.lights = lights.to_vec();
    let mut prepared = gpu.upload(&scene, &pose, None).unwrap();
    gpu.prepare_shadows(&mut prepared, &scene, &pose, None)
        .unwrap();
    prepared
}

fn exact() -> Settings {
    Settings {
        shadows: Shadows::Exact,
        ..once(SIZE)
    }
}

fn ask(gpu: &mut Headless, stage: &Stage, lights: &[Light], sites: &[Site]) -> Vec<PointSample> {
    let prepared = upload(gpu, stage, lights);
    let seen = gpu.sample_points(&prepared, &pinhole(SIZE), sites, &exact());
    seen.unwrap().values
}

/// Where a light casts a point's shadow on the floor, as the camera sees it.
fn cast(light: &Light, corner: [f32; 3], pinhole: &Pinhole) -> DVec2 {
    let corner = DVec3::from_array(corner.map(f64::from));
    let along = match light.kind {
        LightKind::Directional => light.direction,
        LightKind::Point | LightKind::Spot { .. } => corner - light.position,
    };
    let on_floor = corner + along * ((FLOOR - corner.y) / along.y);
    pinhole.project(on_floor).unwrap()
}

/// Whether a place lies in a triangle, and how far from the lines of its sides.
fn within(place: DVec2, corners: [DVec2; 3]) -> (bool, f64) {
    let sides = [0, 1, 2].map(|i| {
        let (from, to) = (corners[i], corners[(i + 1) % 3]);
        (to - from).normalize().perp_dot(place - from)
    });
    let inside = sides.iter().all(|d| *d > 0.0) || sides.iter().all(|d| *d < 0.0);
    (
        inside,
        sides.iter().fold(f64::MAX, |least, d| least.min(d.abs())),
    )
}

/// Places all over the lower half of the image, and as many along the sides of a triangle.
fn places(corners: [DVec2; 3]) -> Vec<Site> {
    let mut random = Random::new(77);
    let mut fraction = || random.below(1 << 20) as f64 / f64::from(1 << 20);
    let mut sites = Vec::new();
    for index in 0..20_000 {
        let anywhere = [fraction() * 1280.0, 361.0 + fraction() * 359.0];
        sites.push(site(anywhere, 0));
        let side = corners[index % 3].lerp(corners[(index + 1) % 3], fraction());
        let near =
            side + (DVec2::new(fraction(), fraction()) - 0.5) * 0.25_f64.powf(8.0 * fraction());
        sites.push(site(near.to_array(), 0));
    }
    sites
}

#[test]
fn edges_of_shadows_lie_where_light_casts_them() {
    on_gpu(|gpu| {
        let mut stage = floor(vec![lit(AlphaMode::Opaque)]);
        stage.add(0, OVER);
        let pinhole = pinhole(SIZE);
        for light in [
            sun(),
            lamp(LightKind::Point),
            lamp(spot(40.0)),
            lamp(spot(85.0)),
        ] {
            let corners = OVER.map(|corner| cast(&light, corner, &pinhole));
            let sites = places(corners);
            let (mut inside, mut close, mut tight) = (0, 0, 0);
            for (site, seen) in sites.iter().zip(ask(gpu, &stage, &[light], &sites)) {
                let place = DVec2::from_array(site.uv);
                let (expected, distance) = within(place, corners);
                if !(1..=2).contains(&seen.id) {
                    continue;
                }
                if distance < 1.0 / 1024.0 {
                    close += 1;
                    continue;
                }
                tight += u32::from(distance < 1.0 / 64.0);
                let found = seen.shadows;
                assert_eq!(
                    found,
                    u32::from(expected),
                    "{distance} from an edge at {place}"
                );
                inside += found;
            }
            assert!(
                inside > 3_000 && close > 1_000 && tight > 3_000,
                "{inside} {close} {tight}"
            );
        }
    });
}

/// What is outside a cone or out of reach is not asked, and lies in no shadow.
#[test]
fn light_that_does_not_reach_casts_no_shadow() {
    on_gpu(|gpu| {
        let mut stage = floor(vec![lit(AlphaMode::Opaque)]);
        stage.add(0, OVER);
        let wide = lamp(spot(40.0));
        let corners = OVER.map(|corner| cast(&wide, corner, &pinhole(SIZE)));
        let narrow = lamp(spot(15.0));
        let short = Light {
            range: Some(1.0),
            ..wide
        };
        let sites = places(corners);
        let seen = ask(gpu, &stage, &[wide, narrow, short], &sites);
        let count = |bit: u32| {
            seen.iter()
                .filter(|seen| seen.shadows >> bit & 1 != 0)
                .count()
        };
        let [all, some, none] = [0, 1, 2].map(count);
        assert!(
            some > 1_000 && some < all - 1_000 && none == 0,
            "{all} {some} {none}"
        );
    });
}

/// Of a convex mesh, facets that face the light are lit all over, up to a degree from grazing it; those that face away
/// lie in the shadow of the others.
#[test]
fn a_ball_shadows_its_far_side_alone() {
    const RINGS: usize = 40;
    const SECTORS: usize = 80;
    on_gpu(|gpu| {
        let mut stage = Stage::new(vec![lit(AlphaMode::Opaque)]);
        let at = |ring: usize, sector: usize| {
            let (polar, azimuth) = (
                PI * ring as f64 / RINGS as f64,
                TAU * sector as f64 / SECTORS as f64,
            );
            let around = DVec3::new(
                polar.sin() * azimuth.sin(),
                polar.cos(),
                polar.sin() * azimuth.cos(),
            );
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
        let mut place = |from: f64, to: f64| {
            from + (to - from) * random.below(1 << 20) as f64 / f64::from(1 << 20)
        };
        let sites: Vec<Site> = (0..60_000)
            .map(|_| site([place(480.0, 840.0), place(180.0, 520.0)], 0))
            .collect();
        let lights = [
            light(
                LightKind::Directional,
                DVec3::ZERO,
                DVec3::new(0.8, -0.5, -0.2),
            ),
            light(LightKind::Point, DVec3::new(-1.2, 1.9, -1.7), DVec3::NEG_Y),
        ];
        let (mut day, mut night, mut grazing, mut edges) = ([0; 2], [0; 2], 0, 0);
        for seen in ask(gpu, &stage, &lights, &sites) {
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
                // Just behind an edge, what lies before a facet that faces away is as near as itself.
                assert!(
                    !shadowed || cosine < 0.0,
                    "{seen:?}: {cosine} towards light {bit}"
                );
                edges += u32::from(!shadowed && cosine < 0.0);
                day[bit] += u32::from(!shadowed);
                night[bit] += u32::from(shadowed);
            }
        }
        assert!(
            day.iter().chain(&night).all(|count| *count > 3_000),
            "{day:?} {night:?}"
        );
        assert!(grazing < 8_000 && edges < 20, "{grazing} {edges}");
    });
}

/// A plane of many triangles does not shadow itself, however long their shadows would be.
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
        let sites = places([
            DVec2::new(600.0, 400.0),
            DVec2::new(700.0, 450.0),
            DVec2::new(640.0, 700.0),
        ]);
        let seen = ask(gpu, &stage, &[sun], &sites);
        assert!(seen.iter().filter(|seen| seen.id != 0).count() > 30_000);
        assert_eq!(seen.iter().filter(|seen| seen.shadows != 0).count(), 0);
    });
}

/// A MASK quadrilateral casts the shadow of what passes its alpha test; BLEND ones cast none, and single-sided ones do
/// from behind.
#[test]
fn what_casts_shadows_is_what_stands_in_the_way() {
    on_gpu(|gpu| {
        let mask = AlphaMode::Mask { cutoff: 0.5 };
        let single = Material {
            double_sided: false,
            ..lit(AlphaMode::Opaque)
        };
        let mut stage = floor(vec![
            lit(AlphaMode::Opaque),
            single,
            textured(mask),
            lit(AlphaMode::Blend),
        ]);
        stage.triangles.iter_mut().for_each(|t| t.material = 0);
        let texel = |i: u32| [255, 255, 255, 255 * (1 - (i + i / 4) as u8 % 2)];
        stage.texture = Some((
            Image {
                width: 4,
                height: 4,
                pixels: (0..16).flat_map(texel).collect(),
            },
            Sampler {
                mag: Filter::Nearest,
                min: Filter::Nearest,
                mip: None,
                ..Sampler::default()
            },
        ));
        // Squares at the height 1 whose middles cast their shadows abreast, under light from straight above.
        let square = |x: f32| {
            [
                [x, 1.0, -4.0],
                [x + 1.0, 1.0, -4.0],
                [x + 1.0, 1.0, -5.0],
                [x, 1.0, -5.0],
            ]
        };
        let [a, b, c, d] = square(-2.5);
        // Single-sided triangles come first; these show the floor their backs, and light their backs too.
        let mut order = Stage::new(stage.materials.clone());
        order.texture = stage.texture.clone();
        order.add_quad(1, [d, c, b, a]);
        order.triangles.append(&mut stage.triangles);
        order.add_quad(2, square(-0.5));
        order.add_quad(3, square(1.5));
        let uvs = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        order.triangles[4].uvs = [uvs[0], uvs[1], uvs[2]];
        order.triangles[5].uvs = [uvs[0], uvs[2], uvs[3]];
        let down = light(LightKind::Directional, DVec3::ZERO, DVec3::NEG_Y);
        let pinhole = pinhole(SIZE);
        let mut random = Random::new(8);
        let mut fraction = || random.below(1 << 20) as f64 / f64::from(1 << 20);
        let on_floor: Vec<DVec3> = (0..30_000)
            .map(|_| DVec3::new(6.0 * fraction() - 3.0, FLOOR, -3.5 - 2.0 * fraction()))
            .collect();
        let sites: Vec<Site> = on_floor
            .iter()
            .map(|p| site(pinhole.project(*p).unwrap().to_array(), 0))
            .collect();
        let mut shadowed = [0; 3];
        for (p, seen) in on_floor.iter().zip(ask(gpu, &order, &[down], &sites)) {
            let of_square = |x: f64| [p.x - x, -4.0 - p.z];
            let is_in = |at: [f64; 2]| at.iter().all(|v| (0.0..1.0).contains(v));
            let (back, masked) = (of_square(-2.5), of_square(-0.5));
            let doubtful = |at: &[f64; 2]| {
                at.iter()
                    .any(|v| (4.0 * v - (4.0 * v).round()).abs() < 1e-3)
            };
            if [back, masked].iter().any(doubtful) || !(3..=4).contains(&seen.id) {
                continue;
            }
            let texel = masked.map(|v| (4.0 * v).floor() as i64);
            let expected = is_in(back) || is_in(masked) && (texel[0] + texel[1]) % 2 == 0;
            assert_eq!(seen.shadows, u32::from(expected), "{p}");
            shadowed[0] += u32::from(expected && is_in(back));
            shadowed[1] += u32::from(expected && is_in(masked));
            shadowed[2] += u32::from(is_in(of_square(1.5)));
        }
        assert!(shadowed.iter().all(|count| *count > 800), "{shadowed:?}");
    });
}

/// Each light has shadows of its own, and a point is as bright as the lights make it that it does not lie in the shadow of.
#[test]
fn shading_leaves_out_the_lights_that_are_hidden() {
    on_gpu(|gpu| {
        let mut stage = floor(vec![lit(AlphaMode::Opaque)]);
        stage.add(0, OVER);
        let lights = [sun(), lamp(LightKind::Point)];
        let corners = OVER.map(|corner| cast(&lights[0], corner, &pinhole(SIZE)));
        let sites = places(corners);
        let both = ask(gpu, &stage, &lights, &sites);
        let dark = |light: &Light| Light {
            color: [0.0; 3],
            ..*light
        };
        let mut found = [0; 4];
        for hidden in 0..4_u32 {
            let mut shining = lights;
            for (bit, light) in shining.iter_mut().enumerate() {
                if hidden >> bit & 1 != 0 {
                    *light = dark(light);
                }
            }
            let prepared = upload(gpu, &stage, &shining);
            let open = gpu
                .sample_points(&prepared, &pinhole(SIZE), &sites, &once(SIZE))
                .unwrap();
            for (seen, expected) in both.iter().zip(&open.values) {
                assert_eq!(expected.shadows, 0);
                if seen.id != 0 && seen.shadows == hidden {
                    found[hidden as usize] += 1;
                    assert_eq!(seen.color, expected.color);
                }
            }
        }
        assert!(found.iter().all(|count| *count > 500), "{found:?}");
    });
}

/// The pixels that the border of a shadow crosses are superpixels, although they show one triangle, and as dark as the
/// part of their samples in shadow.
#[test]
fn borders_of_shadows_are_antialiased() {
    const SIZE: [u32; 2] = [128, 96];
    on_gpu(|gpu| {
        let mut stage = floor(vec![lit(AlphaMode::Opaque)]);
        stage.add(0, OVER);
        let pinhole = pinhole(SIZE);
        let corners = OVER.map(|corner| cast(&sun(), corner, &pinhole));
        let settings = Settings {
            samples: 64,
            shadows: Shadows::Exact,
            detection: Detection::Contrast,
            attributes: true,
            ..everywhere(SIZE, Pattern::Sobol, 64)
        };
        let prepared = upload(gpu, &stage, &[sun()]);
        let image = gpu
            .render_with_shadows(&prepared, &camera(), &settings)
            .unwrap();
        let once = Settings {
            method: gpc::render::Method::None,
            ..settings
        };
        let single = gpu
            .render_with_shadows(&prepared, &camera(), &once)
            .unwrap();
        let offsets = Pattern::Sobol.offsets(64).unwrap();
        let value = |x: u32, y: u32| f64::from(single.colors[(y * SIZE[0] + x) as usize][1]);
        let shadow = |x: f64, y: f64| within(DVec2::new(x, y), corners).0;
        let mut partly = 0;
        for y in 50..SIZE[1] - 1 {
            for x in 1..SIZE[0] - 1 {
                let index = (y * SIZE[0] + x) as usize;
                let (column, row) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
                let around = |dx: i32, dy: i32| shadow(column + f64::from(dx), row + f64::from(dy));
                let one = (-1..=1).all(|dy| {
                    let at = |dx: i32| {
                        (index as i64 + i64::from(dy) * i64::from(SIZE[0]) + i64::from(dx)) as usize
                    };
                    (-1..=1).all(|dx| single.attributes[at(dx)].id == single.attributes[index].id)
                });
                let differs = (-1..=1).any(|dy| (-1..=1).any(|dx| around(dx, dy) != around(0, 0)));
                if !one || single.attributes[index].id > 2 {
                    continue;
                }
                let superpixel = image.attributes[index].superpixel == 1;
                assert_eq!(superpixel, differs, "{x}, {y}");
                // Two pixels to each side along the row, lit and in shadow, tell the share of the samples.
                let ends = [value(x - 1, y), value(x + 1, y)];
                if !superpixel || around(-1, 0) == around(1, 0) {
                    continue;
                }
                let darker = ends[0].min(ends[1]);
                let lighter = ends[0].max(ends[1]);
                let lit = offsets
                    .iter()
                    .filter(|[dx, dy]| !shadow(column + f64::from(*dx), row + f64::from(*dy)));
                let expected = darker + (lighter - darker) * lit.count() as f64 / 64.0;
                let found = f64::from(image.colors[index][1]);
                assert!(
                    (found - expected).abs() < 0.04 * lighter,
                    "{x}, {y}: {found} {expected}"
                );
                partly += 1;
            }
        }
        assert!(partly > 15, "{partly}");
    });
}

/// Where no light is hidden, superpixels are those of the engine that shades every sample.
#[test]
fn superpixels_without_shadows_stay_as_they_were() {
    on_gpu(|gpu| {
        let stage = ball_over_checker();
        let settings = Settings {
            shading: Shading::Sample,
            ..everywhere(SIZE, Pattern::Sobol, 16)
        };
        let black = Light {
            color: [0.0; 3],
            ..sun()
        };
        let prepared = upload(gpu, &stage, &[black]);
        let sites: Vec<Site> = (0..300)
            .map(|i| {
                site(
                    [
                        390.0 + f64::from(i % 60) * 7.3,
                        200.0 + f64::from(i / 60) * 61.7,
                    ],
                    0,
                )
            })
            .collect();
        let mut values = [Shadows::None, Shadows::Exact].map(|shadows| {
            let settings = Settings {
                shadows,
                ..settings.clone()
            };
            gpu.sample_superpixels(&prepared, &pinhole(SIZE), &sites, &settings)
                .unwrap()
                .values
        });
        let [open, shadowed] = &mut values;
        for (a, b) in open.iter().zip(shadowed) {
            assert!((0..4).all(|c| (a[c] - b[c]).abs() < 1e-4), "{a:?} {b:?}");
        }
    });
}

#[test]
fn what_can_not_be_shadowed_is_refused() {
    on_gpu(|gpu| {
        let stage = floor(vec![lit(AlphaMode::Opaque)]);
        let (scene, mut pose) = stage.build();
        let mut prepared = gpu.upload(&scene, &pose, None).unwrap();
        let sites = [site([1.5, 2.5], 0)];
        let asked = gpu.sample_points(&prepared, &pinhole(SIZE), &sites, &exact());
        assert!(matches!(asked, Err(RenderError::NoCasters)), "{asked:?}");
        let frame = gpu.prepare(&prepared, &exact()).map(|_| ());
        assert!(matches!(frame, Err(RenderError::FrameShadows)), "{frame:?}");
        pose.lights = vec![sun(); 33];
        let many = gpu.prepare_shadows(&mut prepared, &scene, &pose, None);
        assert!(
            matches!(many, Err(RenderError::ShadowLights { found: 33 })),
            "{many:?}"
        );
        // 32 lights, of which the last has the highest bit.
        pose.lights.truncate(32);
        gpu.prepare_shadows(&mut prepared, &scene, &pose, None)
            .unwrap();
        let seen = gpu.sample_points(&prepared, &pinhole(SIZE), &sites, &exact());
        assert_eq!(seen.unwrap().values[0].shadows, 0);
    });
}
