//! Instances, compared with the same triangles in world space.

use glam::{DAffine3, DMat3, DQuat, DVec3, EulerRot};
use gpc::render::{Headless, MethodKind, Rendered, SceneRequest, Settings};
use gpc::sampling::Pattern;
use gpc::scene::{
    AlphaMode, DrawClass, DrawRange, GeometryError, Image, InstanceFault, Material, MeshInstance, Pose, Sampler, Scene,
};

use crate::locations::{pinhole, planar};
use crate::meshes::Random;
use crate::stage::{Stage, camera, everywhere, flat, ids, on_gpu, once, once_each, textured};

const SIZE: [u32; 2] = [96, 64];
/// Number of instances of each mesh.
const COPIES: usize = 12;

/// A ball, a perforated square and a pane, each drawn several times: rotated, stretched and mirrored.
fn scene() -> (Scene, Pose) {
    let mut stage = Stage::new(vec![
        Material { base_color: [0.8, 0.4, 0.2, 1.0], ..Material::default() },
        textured(AlphaMode::Mask { cutoff: 0.5 }),
        flat([0.2, 0.3, 0.9, 0.5], AlphaMode::Blend),
    ]);
    let texel = |alpha: u8| [90, 200, 120, alpha];
    stage.texture = Some((
        Image { width: 2, height: 2, pixels: [texel(255), texel(0), texel(0), texel(255)].concat() },
        Sampler::default(),
    ));
    // The number of the mesh's triangles is above the size of a block, in which triangles share a look-up of their
    // instance, and no multiple of that size.
    let at = |ring: u32, side: u32| {
        let [up, around] = [f64::from(ring) / 5.0, f64::from(side) / 9.0];
        let (sin, cos) = (up * std::f64::consts::PI).sin_cos();
        let (y, x) = (around * std::f64::consts::TAU).sin_cos();
        [sin * x, sin * y, cos].map(|v| v as f32)
    };
    for ring in 0..5 {
        for side in 0..9 {
            let [a, b] = [at(ring, side), at(ring, side + 1)];
            let [c, d] = [at(ring + 1, side), at(ring + 1, side + 1)];
            stage.add_quad(0, [a, c, d, b]);
        }
    }
    let square = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    for material in [1, 2] {
        stage.add_quad(material, square);
        let first = stage.triangles.len() - 2;
        let corners = [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]];
        stage.triangles[first].uvs = [corners[0], corners[1], corners[2]];
        stage.triangles[first + 1].uvs = [corners[0], corners[2], corners[3]];
    }
    let (scene, mut pose) = stage.build();
    let mut random = Random::new(5);
    let mut first_index = 0;
    for draw in pose.geometry.draws.clone() {
        for copy in 0..COPIES {
            let mut within = |half: f64| random.range(-half, half);
            let turn = DQuat::from_euler(EulerRot::XYZ, within(3.0), within(3.0), within(3.0));
            let place = DVec3::new(within(5.0), within(3.0), -6.0 + within(3.0));
            let mirror = if copy % 3 == 0 { -1.0 } else { 1.0 };
            let size = DVec3::new(mirror, 1.4, 0.6) * 0.8;
            pose.geometry.instances.push(MeshInstance {
                first_triangle: draw.first_triangle,
                triangle_count: draw.triangle_count,
                first_index,
                transform: DAffine3 {
                    matrix3: DMat3::from_quat(turn) * DMat3::from_diagonal(size),
                    translation: place,
                },
            });
            first_index += draw.triangle_count.next_multiple_of(MeshInstance::ALIGNMENT);
        }
    }
    (scene, pose)
}

fn in_world_space(pose: &Pose) -> Pose {
    Pose { geometry: pose.geometry.flat().into_owned(), ..pose.clone() }
}

fn render(gpu: &mut Headless, (scene, pose): (&Scene, &Pose), settings: &Settings) -> Rendered {
    let prepared = gpu.upload(SceneRequest::new(scene, pose)).unwrap();
    let mut frame = gpu.prepare(&prepared, settings).unwrap();
    gpu.render(&mut frame, &camera()).unwrap()
}

/// Root mean squared difference of colours.
fn difference(a: &Rendered, b: &Rendered) -> f64 {
    let pairs = a.colors.as_flattened().iter().zip(b.colors.as_flattened());
    let squares: f64 = pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum();
    (squares / (4 * a.colors.len()) as f64).sqrt()
}

#[test]
fn they_are_what_they_are_in_world_space() {
    on_gpu(|gpu| {
        let (scene, pose) = scene();
        let world = in_world_space(&pose);
        let settings = once(SIZE);
        let found = render(gpu, (&scene, &pose), &settings);
        let expected = render(gpu, (&scene, &world), &settings);
        assert_eq!(found.statistics.triangles.total, pose.geometry.triangle_count());
        let all: Vec<u32> = ids(&found);
        let shown = |first: u32, end: u32| all.iter().any(|id| (first + 1..end + 1).contains(id));
        for instances in pose.geometry.instances.chunks(COPIES).take(2) {
            assert!(shown(instances[0].first_index, instances[COPIES - 1].first_index));
        }
        let pairs = found.attributes.iter().zip(&expected.attributes);
        // The transform to clip space rounds differently, which may change a centre on an edge.
        let other = pairs.clone().filter(|(a, b)| a.id != b.id).count();
        assert!(other <= 2, "{other} pixels show another triangle");
        for (a, b) in pairs.filter(|(a, b)| a.id == b.id) {
            assert!((a.depth - b.depth).abs() < 1e-4, "{a:?} {b:?}");
            let apart = [0, 1, 2].map(|axis| (a.normal[axis] - b.normal[axis]).abs());
            assert!(apart.iter().all(|apart| *apart < 1e-4), "{a:?} {b:?}");
        }
    });
}

#[test]
fn every_method_sees_them() {
    on_gpu(|gpu| {
        let (scene, pose) = scene();
        let world = in_world_space(&pose);
        for (method, samples) in
            [(MethodKind::Msaa, 4), (MethodKind::Ssaa, 4), (MethodKind::Superpixel, 16), (MethodKind::Superpixel, 256)]
        {
            let settings = Settings::new(SIZE[0], SIZE[1]).method(method.with_samples(samples));
            let found = render(gpu, (&scene, &pose), &settings);
            let expected = render(gpu, (&scene, &world), &settings);
            let apart = difference(&found, &expected);
            // A sample on an edge may belong to another triangle: a fraction of one of 6,144 pixels.
            assert!(apart < 4e-3 / f64::from(samples).sqrt(), "{method:?} {samples}: {apart}");
        }
    });
}

#[test]
fn a_crowd_that_outgrows_its_room_is_drawn_all_the_same() {
    /// Number of pairs of a triangle and a tile for which an image of this size has room at first, with more than
    /// enough triangles.
    const FIRST_ROOM: u64 = 160 * 16 * 8;
    const CROWD: u32 = 400;
    on_gpu(|gpu| {
        let (mut scene, mut pose) = scene();
        scene.materials[0].double_sided = true;
        let ball = pose.geometry.draws[0];
        pose.geometry.triangles.truncate(ball.triangle_count as usize);
        pose.geometry.draws = vec![DrawRange { class: DrawClass::OpaqueDoubleSided, ..ball }];
        let mut random = Random::new(9);
        let at = |index: u32, random: &mut Random| MeshInstance {
            first_triangle: 0,
            triangle_count: ball.triangle_count,
            first_index: index * ball.triangle_count.next_multiple_of(MeshInstance::ALIGNMENT),
            transform: DAffine3::from_scale_rotation_translation(
                DVec3::splat(0.3),
                DQuat::IDENTITY,
                DVec3::new(random.range(-2.5, 2.5), random.range(-2.5, 2.5), -4.0),
            ),
        };
        pose.geometry.instances = (0..CROWD).map(|index| at(index, &mut random)).collect();
        let world = in_world_space(&pose);
        let settings = everywhere([64, 64], Pattern::Sobol, 16);
        let found = render(gpu, (&scene, &pose), &settings);
        let expected = render(gpu, (&scene, &world), &settings);
        assert!(found.statistics.triangles.drawn > FIRST_ROOM);
        let apart = difference(&found, &expected);
        assert!(apart < 1e-3, "{apart}");
    });
}

#[test]
fn contradictions_are_named() {
    let (scene, pose) = scene();
    let fault_of = |change: fn(&mut Vec<MeshInstance>)| {
        let mut geometry = pose.geometry.clone();
        change(&mut geometry.instances);
        match geometry.check(scene.materials.len()) {
            Err(GeometryError::Instance { index, fault }) => Some((index, fault)),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(pose.geometry.check(scene.materials.len()), Ok(()));
    for (change, expected) in [
        ((|all| all[2].triangle_count = 0) as fn(&mut Vec<MeshInstance>), (2, InstanceFault::Triangles)),
        (|all| all[30].triangle_count = 9, (30, InstanceFault::Triangles)),
        (|all| all[1].first_index = 64, (1, InstanceFault::Index)),
        (|all| all[3].first_index += 1, (3, InstanceFault::Index)),
        (|all| all[11].first_index = u32::MAX - 63, (11, InstanceFault::Index)),
        (|all| all[4].transform.translation.x = f64::NAN, (4, InstanceFault::Transform)),
        (|all| all[11].triangle_count += 1, (11, InstanceFault::Classes)),
        (|all| (all[0].first_triangle, all[0].triangle_count) = (90, 2), (1, InstanceFault::Order)),
    ] {
        assert_eq!(fault_of(change), Some(expected));
    }
}

#[test]
fn locations_see_them() {
    on_gpu(|gpu| {
        let (scene, pose) = scene();
        let image = render(gpu, (&scene, &pose), &once(SIZE));
        let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
        let locations = planar(SIZE);
        let sampled = gpu.sample_points(&prepared, &pinhole(SIZE), &locations, &once_each()).unwrap();
        let found: Vec<u32> = sampled.values.iter().map(|sample| sample.id).collect();
        let expected = ids(&image);
        let other = found.iter().zip(&expected).filter(|(a, b)| a != b).count();
        assert!(other <= 2, "{other} of {} locations", locations.len());
    });
}
