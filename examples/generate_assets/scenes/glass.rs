//! Tinted panes, some intersecting, some behind one another, which test translucent edges and exact order.

use super::glb::{Builder, Placement, linear};
use super::mesh::{Mesh, icosphere};
use glam::{DQuat, DVec3, dvec3};
use serde_json::json;
use std::f64::consts::PI;

const TINTS: [[u8; 3]; 5] = [[232, 92, 78], [246, 190, 74], [74, 168, 120], [58, 134, 200], [148, 96, 190]];

/// Builds the scene.
pub fn build() -> Vec<u8> {
    let mut file = Builder::default();
    let glass = TINTS.map(|tint| {
        let [r, g, b] = tint.map(linear);
        file.material(json!({
            "name": "glass", "alphaMode": "BLEND", "doubleSided": true,
            "pbrMetallicRoughness": {
                "baseColorFactor": [r, g, b, 0.42], "metallicFactor": 0.0, "roughnessFactor": 0.2,
            },
        }))
    });
    let brass = file.paint("frame", [92, 74, 52], 0.5);
    table(&mut file);
    // The fan has five panes through one vertical axis.
    let mut leaf = Mesh::default();
    leaf.polygon(&rectangle(-1.25, 1.25, 0.06, 2.3));
    let leaf = file.surface(&leaf);
    let fan = dvec3(-1.45, 0.0, 0.0);
    for (i, &material) in glass.iter().enumerate() {
        let mesh = file.mesh(&[(leaf, material)]);
        file.place(
            mesh,
            Placement { rotation: DQuat::from_rotation_y(PI * (i as f64 + 0.35) / 5.0), ..Placement::at(fan) },
        );
    }
    // The row has framed panes behind one another.
    let mut pane = Mesh::default();
    pane.polygon(&rectangle(-0.8, 0.8, 0.1, 1.9));
    let pane = file.surface(&pane);
    let frame = file.surface(&frame());
    for (i, &material) in glass.iter().rev().enumerate() {
        let mesh = file.mesh(&[(pane, material), (frame, brass)]);
        let i = i as f64;
        file.place(
            mesh,
            Placement {
                rotation: DQuat::from_rotation_y(0.12 * i - 0.1),
                ..Placement::at(dvec3(1.0 + 0.34 * i, 0.0, 0.9 - 0.62 * i))
            },
        );
    }
    behind(&mut file);
    file.perspective("front", dvec3(0.9, 1.75, 6.6), dvec3(0.15, 1.0, 0.0), 36.0);
    file.perspective("corner", dvec3(-4.6, 2.3, 4.4), dvec3(-0.4, 0.9, -0.2), 38.0);
    file.finish("Glass panes")
}

fn rectangle(left: f64, right: f64, bottom: f64, top: f64) -> [DVec3; 4] {
    [dvec3(left, bottom, 0.0), dvec3(right, bottom, 0.0), dvec3(right, top, 0.0), dvec3(left, top, 0.0)]
}

/// Thin bars around a pane of the row, and its feet.
fn frame() -> Mesh {
    let mut mesh = Mesh::default();
    let depth = dvec3(0.0, 0.0, 0.012);
    for x in [-0.82, 0.8] {
        mesh.cuboid(dvec3(x, 0.0, 0.0) - depth, dvec3(x + 0.02, 1.92, 0.0) + depth);
    }
    for y in [0.08, 1.9] {
        mesh.cuboid(dvec3(-0.8, y, 0.0) - depth, dvec3(0.8, y + 0.02, 0.0) + depth);
    }
    mesh
}

fn table(file: &mut Builder) {
    let top = file.paint("table", [236, 228, 214], 0.8);
    let mut slab = Mesh::default();
    slab.cuboid(dvec3(-4.6, -0.14, -3.2), dvec3(4.6, 0.0, 2.6));
    let surface = file.surface(&slab);
    let mesh = file.mesh(&[(surface, top)]);
    file.place(mesh, Placement::at(DVec3::ZERO));
}

/// Objects behind the glass.
fn behind(file: &mut Builder) {
    let ball = file.surface(&icosphere(3, |_| 1.0));
    for (color, place, size) in [
        ([238, 232, 220], dvec3(-0.3, 0.42, -1.9), 0.42),
        ([64, 78, 96], dvec3(1.5, 0.55, -2.3), 0.55),
        ([226, 118, 84], dvec3(-2.6, 0.5, -1.7), 0.5),
    ] {
        let paint = file.paint("ball", color, 0.4);
        let mesh = file.mesh(&[(ball, paint)]);
        file.place(mesh, Placement { scale: DVec3::splat(size), ..Placement::at(place) });
    }
    let dark = file.paint("blinds", [84, 92, 104], 0.7);
    let mut blinds = Mesh::default();
    for i in 0..34 {
        let x = -4.2 + 0.25 * f64::from(i);
        blinds.cuboid(dvec3(x, 0.0, -3.0), dvec3(x + 0.05, 2.6, -2.96));
    }
    blinds.cuboid(dvec3(-4.3, 2.6, -3.03), dvec3(4.2, 2.68, -2.93));
    let surface = file.surface(&blinds);
    let mesh = file.mesh(&[(surface, dark)]);
    file.place(mesh, Placement::at(DVec3::ZERO));
}
