//! A checker floor to the horizon. The tiles are geometry on the left and a texture with mipmaps on the right, so that
//! one picture shows both kinds of aliasing.

use super::glb::{Builder, Placement};
use super::mesh::Mesh;
use super::picture;
use glam::{DQuat, DVec2, DVec3, dvec2, dvec3};
use gpc::testing::Random;
use serde_json::json;

const LIGHT: [u8; 3] = [238, 230, 214];
const DARK: [u8; 3] = [27, 84, 96];
/// Number of tiles along one side of a patch of geometry; a tile is a metre wide.
const PATCH: i32 = 16;
/// Number of rows of patches between camera and mountains.
const ROWS: i32 = 20;
/// Half of the width of the strip between the two halves of the floor.
const STRIP: f64 = 0.35;

/// Builds the scene.
pub fn build() -> Vec<u8> {
    let mut file = Builder::default();
    let light = file.paint("light tile", LIGHT, 0.8);
    let dark = file.paint("dark tile", DARK, 0.8);
    geometry_floor(&mut file, light, dark);
    textured_floor(&mut file);
    strip_and_columns(&mut file);
    mountains(&mut file);
    file.daylight();
    file.perspective("horizon", dvec3(0.0, 1.7, 6.0), dvec3(0.0, 1.05, -6.0), 42.0);
    file.perspective("low", dvec3(-2.6, 0.55, 5.0), dvec3(-0.6, 0.75, -4.0), 50.0);
    file.finish("Checker floor")
}

fn geometry_floor(file: &mut Builder, light: usize, dark: usize) {
    let mut tiles = [Mesh::default(), Mesh::default()];
    for x in 0..PATCH {
        for z in 0..PATCH {
            let [x0, z0] = [x, z].map(f64::from);
            tiles[((x + z) & 1) as usize].polygon(&[
                dvec3(x0, 0.0, z0 + 1.0),
                dvec3(x0 + 1.0, 0.0, z0 + 1.0),
                dvec3(x0 + 1.0, 0.0, z0),
                dvec3(x0, 0.0, z0),
            ]);
        }
    }
    let parts = [file.surface(&tiles[0]), file.surface(&tiles[1])];
    let patch = file.mesh(&[(parts[0], light), (parts[1], dark)]);
    let side = f64::from(PATCH);
    for row in 0..ROWS {
        // This number of patches fills a picture of 16:9 at this distance.
        let columns = row * 3 / 4 + 2;
        for column in 1..=columns {
            let corner = dvec3(-STRIP - side * f64::from(column), 0.0, 8.0 - side * f64::from(row + 1));
            file.place(patch, Placement::at(corner));
        }
    }
}

fn textured_floor(file: &mut Builder) {
    let png = picture::paint(256, |u, v| {
        let [r, g, b] = if (u < 0.5) == (v < 0.5) { LIGHT } else { DARK };
        [r, g, b, 255]
    });
    let texture = file.texture(&png, true);
    let material = file.material(json!({
        "name": "textured tiles",
        "pbrMetallicRoughness": {
            "baseColorTexture": { "index": texture }, "metallicFactor": 0.0, "roughnessFactor": 0.8,
        },
    }));
    let mut floor = Mesh::default();
    let depth = f64::from(PATCH * ROWS);
    // The texture holds two tiles in each direction.
    let corner = |x: f64, z: f64| (dvec3(STRIP + x, 0.0, 8.0 - z), dvec2(x / 2.0, -z / 2.0));
    let [a, b, c, d] = [corner(0.0, 0.0), corner(depth * 0.8, 0.0), corner(depth * 0.8, depth), corner(0.0, depth)];
    floor.textured_quad([a.0, b.0, c.0, d.0], [a.1, b.1, c.1, d.1]);
    let surface = file.surface(&floor);
    let mesh = file.mesh(&[(surface, material)]);
    file.place(mesh, Placement::at(DVec3::ZERO));
}

fn strip_and_columns(file: &mut Builder) {
    let stone = file.paint("stone", [206, 190, 160], 0.7);
    let mut strip = Mesh::default();
    strip.cuboid(dvec3(-STRIP, -0.2, -312.0), dvec3(STRIP, 0.06, 8.0));
    let surface = file.surface(&strip);
    let mesh = file.mesh(&[(surface, stone)]);
    file.place(mesh, Placement::at(DVec3::ZERO));

    let red = file.paint("column", [196, 92, 66], 0.6);
    let octagon: Vec<DVec2> = (0..8)
        .map(|i| {
            let (sin, cos) = (std::f64::consts::TAU * (f64::from(i) + 0.5) / 8.0).sin_cos();
            dvec2(cos, sin)
        })
        .collect();
    let scaled = |factor: f64| octagon.iter().map(|p| *p * factor).collect::<Vec<_>>();
    let mut column = Mesh::default();
    column.prism(&scaled(0.34), 0.0, 0.2);
    column.prism(&scaled(0.22), 0.2, 2.5);
    column.prism(&scaled(0.34), 2.5, 2.7);
    let surface = file.surface(&column);
    let mesh = file.mesh(&[(surface, red)]);
    for i in 0..24 {
        for side in [-1.0, 1.0] {
            file.place(
                mesh,
                Placement {
                    // A prism extends along z; this rotation makes it extend along y.
                    rotation: DQuat::from_rotation_x(-std::f64::consts::FRAC_PI_2),
                    ..Placement::at(dvec3(side * 3.1, 0.0, -2.0 - 6.0 * f64::from(i)))
                },
            );
        }
    }
}

/// A range of mountains that hides the end of the floor.
fn mountains(file: &mut Builder) {
    let near = file.paint("near mountains", [92, 122, 118], 0.9);
    let far = file.paint("far mountains", [136, 160, 172], 0.9);
    let mut random = Random::new(7);
    for (material, distance, height, steps) in [(near, -312.0, 16.0, 84), (far, -330.0, 30.0, 54)] {
        let mut range = Mesh::default();
        let width = 760.0;
        let step = width / f64::from(steps);
        let mut previous = None;
        for i in 0..=steps {
            let x = -width / 2.0 + step * f64::from(i);
            let ridge = height * random.range(0.45, 1.0);
            let foot = dvec3(x, -1.0, distance + random.range(2.0, 7.0));
            let peak = dvec3(x + step * random.range(-0.3, 0.3), ridge, distance - 12.0);
            if let Some((old_foot, old_peak)) = previous {
                range.polygon(&[old_foot, foot, peak]);
                range.polygon(&[old_foot, peak, old_peak]);
            }
            previous = Some((foot, peak));
        }
        let surface = file.surface(&range);
        let mesh = file.mesh(&[(surface, material)]);
        file.place(mesh, Placement::at(DVec3::ZERO));
    }
}
