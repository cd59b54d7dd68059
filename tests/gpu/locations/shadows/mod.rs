//! Exact shadows, compared with their closed form: light above a floor, and objects that block it.

mod casters;
mod dense;
mod edges;
mod facing;
mod parts;
mod probes;
mod rays;
mod shading;
mod superpixels;
mod wires;

use glam::{DVec2, DVec3};
use gpc::camera::{Pinhole, SampleLocation};
use gpc::render::{Footprint, Headless, PointSample, PreparedScene, Rendered, SceneRequest, Settings, Shadows};
use gpc::scene::{AlphaMode, Light, LightKind, Material};

use super::{location, pinhole};
use crate::meshes::Random;
use crate::stage::{Stage, camera, flat, once};

const SIZE: [u32; 2] = [1280, 720];
/// Height of the floor, which consists of the first two triangles of a stage.
const FLOOR: f64 = -1.0;
/// A triangle above the floor.
const OVER: [[f32; 3]; 3] = [[-0.9, 0.3, -2.7], [1.1, 0.5, -3.4], [0.2, 0.9, -2.2]];

fn lit(alpha_mode: AlphaMode) -> Material {
    Material { unlit: false, metallic: 0.0, ..flat([0.7, 0.7, 0.7, 1.0], alpha_mode) }
}

/// A stage with a floor of its first material.
fn floor(materials: Vec<Material>) -> Stage {
    let mut stage = Stage::new(materials);
    let corner = |x: f32, z: f32| [x, FLOOR as f32, z];
    let quad = [corner(-9.0, -0.5), corner(9.0, -0.5), corner(9.0, -14.0), corner(-9.0, -14.0)];
    stage.add_quad(0, quad);
    stage
}

fn light(kind: LightKind, position: DVec3, direction: DVec3) -> Light {
    Light { kind, position, direction: direction.normalize(), color: [3.0; 3], range: None }
}

fn sun() -> Light {
    let direction = DVec3::new(0.25, -1.0, -0.4);
    light(LightKind::Directional, DVec3::ZERO, direction)
}

/// A light above the triangle that points towards it.
fn lamp(kind: LightKind) -> Light {
    let position = DVec3::new(-0.4, 2.9, -2.1);
    light(kind, position, DVec3::new(0.2, -1.0, -0.3))
}

fn spot(outer_degrees: f32) -> LightKind {
    LightKind::Spot { inner_angle: 0.1, outer_angle: outer_degrees.to_radians() }
}

fn upload(gpu: &mut Headless, stage: &Stage, lights: &[Light]) -> PreparedScene {
    let (scene, mut pose) = stage.build();
    pose.lights = lights.to_vec();
    let request = SceneRequest::new(&scene, &pose).shadowed(Shadows::Exact);
    gpu.upload(request).unwrap()
}

fn render(gpu: &mut Headless, prepared: &PreparedScene, settings: &Settings) -> Rendered {
    let mut frame = gpu.prepare(prepared, settings).unwrap();
    gpu.render(&mut frame, &camera()).unwrap()
}

fn exact() -> Settings {
    once(SIZE).shadows(Shadows::Exact).footprint(Footprint::Pixel)
}

fn ask(gpu: &mut Headless, stage: &Stage, lights: &[Light], locations: &[SampleLocation]) -> Vec<PointSample> {
    let prepared = upload(gpu, stage, lights);
    let seen = gpu.sample_points(&prepared, &pinhole(SIZE), locations, &exact().scene);
    seen.unwrap().values
}

/// Place in the image of the shadow that a light casts of a point onto the floor.
fn cast(light: &Light, corner: [f32; 3], pinhole: &Pinhole) -> DVec2 {
    let corner = DVec3::from_array(corner.map(f64::from));
    let along = match light.kind {
        LightKind::Directional => light.direction,
        LightKind::Point | LightKind::Spot { .. } => corner - light.position,
    };
    let on_floor = corner + along * ((FLOOR - corner.y) / along.y);
    pinhole.project(on_floor).unwrap()
}

/// Whether a place lies in a triangle, and its distance from the nearest line through a side.
fn within(place: DVec2, corners: [DVec2; 3]) -> (bool, f64) {
    let sides = [0, 1, 2].map(|i| {
        let (from, to) = (corners[i], corners[(i + 1) % 3]);
        (to - from).normalize().perp_dot(place - from)
    });
    let inside = sides.iter().all(|d| *d > 0.0) || sides.iter().all(|d| *d < 0.0);
    (inside, sides.iter().fold(f64::MAX, |least, d| least.min(d.abs())))
}

/// Locations all over the lower half of the image, and the same number along the sides of a triangle.
fn places(corners: [DVec2; 3]) -> Vec<SampleLocation> {
    let mut random = Random::new(77);
    let mut fraction = || random.below(1 << 20) as f64 / f64::from(1 << 20);
    let mut locations = Vec::new();
    for index in 0..20_000 {
        let anywhere = [fraction() * 1280.0, 361.0 + fraction() * 359.0];
        locations.push(location(anywhere, 0));
        let side = corners[index % 3].lerp(corners[(index + 1) % 3], fraction());
        let near = side + (DVec2::new(fraction(), fraction()) - 0.5) * 0.25_f64.powf(8.0 * fraction());
        locations.push(location(near.to_array(), 0));
    }
    locations
}
