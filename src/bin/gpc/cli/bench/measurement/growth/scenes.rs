//! Scenes of the benchmark of growth.

use super::super::stress::stage::camera;
use super::GrowthStep;
use super::mesh::{Vertex, add_grid, build};
use glam::{DMat3, DVec3, Vec3};
use gpc::camera::Camera;
use gpc::scene::{Material, PosedGeometry};

/// Numbers of triangles of the series [`super::Growth::Triangles`].
pub(super) const TRIANGLES: [u32; 5] = [1_000, 10_000, 100_000, 1_000_000, 10_000_000];
/// Image sizes of the series [`super::Growth::Pixels`].
pub(super) const SIZES: [[u32; 2]; 6] = [[427, 240], [854, 480], [1280, 720], [1920, 1080], [3840, 2160], [7680, 4320]];
/// Percentages of superpixels of the series [`super::Growth::Superpixels`].
pub(super) const PERCENTAGES: [u32; 8] = [0, 1, 5, 10, 25, 50, 75, 100];
/// Numbers of layers of the series [`super::Growth::Depth`].
pub(super) const LAYERS: [u32; 7] = [1, 2, 4, 8, 16, 32, 64];

/// Landscape of hills that occlude each other, seen from above; `value` becomes the step's value.
pub(super) fn landscape(triangles: u32, size: [u32; 2], value: f64) -> GrowthStep {
    const SIDE: f32 = 24.0;
    let cells = (f64::from(triangles) / 2.0).sqrt().round() as u32;
    let height = |x: f32, z: f32| 0.9 * (1.3 * x).sin() * (1.1 * z).cos() + 0.25 * (3.1 * x + 1.7 * z).sin();
    let slope = |x: f32, z: f32| {
        let shared = 0.25 * (3.1 * x + 1.7 * z).cos();
        [
            0.9 * 1.3 * (1.3 * x).cos() * (1.1 * z).cos() + 3.1 * shared,
            -0.9 * 1.1 * (1.3 * x).sin() * (1.1 * z).sin() + 1.7 * shared,
        ]
    };
    let mut geometry = PosedGeometry::default();
    add_grid(&mut geometry, [cells, cells], |u, v| {
        let (x, z) = (SIDE * (u - 0.5), SIDE * (v - 1.0));
        let [across, along] = slope(x, z);
        let y = height(x, z);
        Vertex {
            position: Vec3::new(x, y, z),
            normal: Vec3::new(-across, 1.0, -along).normalize(),
            color: Vec3::new(0.2, 0.35, 0.1).lerp(Vec3::new(0.9, 0.85, 0.8), 0.5 + 0.45 * y),
        }
    });
    let (scene, pose) = build(geometry, double_sided(false));
    // The camera looks down by 22.5 degrees.
    let (sin, cos) = std::f64::consts::FRAC_PI_8.sin_cos();
    let above = Camera {
        eye: DVec3::new(0.0, 3.0, 1.0),
        axes: DMat3::from_cols(DVec3::X, DVec3::new(0.0, cos, -sin), DVec3::new(0.0, sin, cos)),
        ..camera()
    };
    GrowthStep { value, size, scene, pose, camera: above }
}

/// Upright strips two pixels wide, slightly tilted; `percentage` of them alternate between light and dark.
pub(super) fn strips(percentage: u32, size: [u32; 2]) -> GrowthStep {
    const PITCH: f32 = 2.0;
    const ROWS: u32 = 16;
    let [width, height] = size.map(|side| side as f32);
    let lean = 0.02 * height;
    let count = ((width + 2.0 * lean) / PITCH).ceil() as u32;
    let mut geometry = PosedGeometry::default();
    for strip in 0..count {
        let left = strip as f32 * PITCH - lean;
        // At half of the image's height a tilted strip is in the place of an upright one.
        let alternates = match percentage {
            0 => false,
            100 => true,
            share => (left + 0.5 * PITCH) * 100.0 < width * share as f32,
        };
        let dark = alternates && strip % 2 == 1;
        let color = Vec3::splat(if dark { 0.05 } else { 0.7 });
        add_grid(&mut geometry, [1, ROWS], |u, v| {
            let x = left + PITCH * u + lean * (v - 0.5);
            at([x, (v * 1.02 - 0.01) * height], 2.0, color, size)
        });
    }
    let (scene, pose) = build(geometry, double_sided(true));
    GrowthStep { value: f64::from(percentage), size, scene, pose, camera: camera() }
}

/// Layers behind each other with a pattern of two-coloured squares, the farthest drawn first.
pub(super) fn layers(count: u32, size: [u32; 2]) -> GrowthStep {
    let [width, height] = size.map(|side| side as f32);
    let mut geometry = PosedGeometry::default();
    for layer in (0..count).rev() {
        // Numbers of columns differ, so that no two layers have edges in the same places.
        let columns = 16 + layer % 13;
        let rows = 9 + layer % 7;
        let distance = 2.0 + layer as f32;
        for row in 0..rows {
            for column in 0..columns {
                let light = (row + column) % 2 == 0;
                let color = Vec3::splat(if light { 0.7 } else { 0.1 });
                add_grid(&mut geometry, [1, 1], |u, v| {
                    let x = (column as f32 + u) / columns as f32 * 1.1 - 0.05;
                    let y = (row as f32 + v) / rows as f32 * 1.1 - 0.05;
                    // The grid is slanted, so that its lines do not run along the pixels.
                    let place = [(x + 0.03 * y) * width, (y - 0.03 * x) * height];
                    at(place, distance, color, size)
                });
            }
        }
    }
    let (scene, pose) = build(geometry, double_sided(true));
    GrowthStep { value: f64::from(count), size, scene, pose, camera: camera() }
}

/// Vertex at a place of the image in pixels, at `distance` along the direction of view of [`camera`].
fn at([x, y]: [f32; 2], distance: f32, color: Vec3, size: [u32; 2]) -> Vertex {
    let [width, height] = size.map(|side| side as f32);
    let scale = 2.0 * distance / height;
    Vertex {
        position: Vec3::new((x - 0.5 * width) * scale, (0.5 * height - y) * scale, -distance),
        normal: Vec3::Z,
        color,
    }
}

fn double_sided(unlit: bool) -> Material {
    Material { double_sided: true, metallic: 0.0, unlit, ..Material::default() }
}
