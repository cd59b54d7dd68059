//! Triangles narrower than a cell, which no location sees.

use gpc::camera::{Pinhole, SampleLocation};
use gpc::render::{Detection, Headless, PreparedScene, Rendered, Settings};
use gpc::scene::AlphaMode;

use super::{pinhole, planar};
use crate::detect::wires;
use crate::meshes::Random;
use crate::stage::{Stage, flat, on_gpu, seen_at};

const SIZE: [u32; 2] = [96, 64];

fn settings(detection: Detection, thin: bool) -> Settings {
    Settings {
        detection,
        thin,
        attributes: true,
        ..Settings::new(SIZE[0], SIZE[1])
    }
}

/// What locations of the stages' pinhole see.
fn seen(
    gpu: &mut Headless,
    scene: &PreparedScene,
    locations: &[SampleLocation],
    settings: &Settings,
) -> Rendered {
    let rig: [(Pinhole, Vec<SampleLocation>); 1] = [(pinhole(SIZE), locations.to_vec())];
    gpu.render_locations(scene, &rig, SIZE, settings).unwrap()
}

fn energy(rendered: &Rendered) -> f64 {
    rendered.colors.iter().map(|c| f64::from(c[0])).sum()
}

/// How much of the energy that superpixels everywhere see is found, with thin triangles looked for and without.
fn shares(gpu: &mut Headless, scene: &PreparedScene, locations: &[SampleLocation]) -> [f64; 2] {
    let all = energy(&seen(
        gpu,
        scene,
        locations,
        &settings(Detection::Every, false),
    ));
    assert!(all > 5.0, "{all}");
    [true, false].map(|thin| {
        let found = seen(gpu, scene, locations, &settings(Detection::Contrast, thin));
        energy(&found) / all
    })
}

/// The planar set stretched about the middle of the image.
fn scaled([across, down]: [f64; 2]) -> Vec<SampleLocation> {
    let [width, height] = SIZE.map(f64::from);
    let stretch = |location: SampleLocation| SampleLocation {
        uv: [
            0.5 * width + across * (location.uv[0] - 0.5 * width),
            0.5 * height + down * (location.uv[1] - 0.5 * height),
        ],
        jacobian: [[across, 0.0], [0.0, down]],
        ..location
    };
    planar(SIZE).into_iter().map(stretch).collect()
}

#[test]
fn wires_of_a_planar_set_are_the_images() {
    on_gpu(|gpu| {
        // Apart from the wall, and painted on it.
        for distance in [2.0, 4.999] {
            let stage = wires(SIZE, distance);
            let settings = settings(Detection::Contrast, true);
            let image = stage.render(gpu, &settings);
            let scene = stage.upload(gpu);
            let locations = seen(gpu, &scene, &planar(SIZE), &settings);
            let pairs = image.attributes.iter().zip(&locations.attributes);
            let differ = pairs.filter(|(a, b)| a.superpixel != b.superpixel).count();
            assert!(image.statistics.superpixels > 1000);
            assert!(differ <= 24, "{differ} superpixels differ at {distance}");
            let far = |(a, b): &(&[f32; 4], &[f32; 4])| (a[0] - b[0]).abs() > 1e-3;
            let differ = image
                .colors
                .iter()
                .zip(&locations.colors)
                .filter(far)
                .count();
            assert!(differ <= 24, "{differ} colours differ at {distance}");
        }
    });
}

/// Thin is what is narrower than a cell: cells a quarter and four times as wide as a pixel, and both.
#[test]
fn wires_keep_their_energy_in_cells_of_any_size() {
    on_gpu(|gpu| {
        let scene = wires(SIZE, 2.0).upload(gpu);
        for stretch in [[0.25, 0.25], [1.0, 0.25], [1.4, 1.4], [1.9, 0.6]] {
            let [with, without] = shares(gpu, &scene, &scaled(stretch));
            assert!((with - 1.0).abs() < 0.03, "{with} at {stretch:?}");
            assert!((without - 1.0).abs() > 0.04, "{without} at {stretch:?}");
        }
    });
}

/// Wires overhead begin before the near plane and end behind the eye: what is seen of them is clipped.
#[test]
fn wires_past_the_eye_keep_their_energy() {
    on_gpu(|gpu| {
        let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
        for wire in 0..10 {
            let x = f64::from(wire) * 0.31 - 1.53;
            let corner = |x: f64, z: f64| [x, 1.5, z].map(|v| v as f32);
            stage.add_quad(
                0,
                [
                    corner(x, 5.0),
                    corner(x + 0.004, 5.0),
                    corner(x + 0.004, -40.0),
                    corner(x, -40.0),
                ],
            );
        }
        let scene = stage.upload(gpu);
        let [with, without] = shares(gpu, &scene, &planar(SIZE));
        assert!((with - 1.0).abs() < 0.03, "{with}");
        assert!((without - 1.0).abs() > 0.1, "{without}");
    });
}

/// A hilly mesh of one colour with several triangles a pixel.
#[test]
fn dense_meshes_make_no_superpixels() {
    on_gpu(|gpu| {
        let mut stage = Stage::new(vec![flat([0.5, 0.5, 0.5, 1.0], AlphaMode::Opaque)]);
        let mut random = Random::new(3);
        let [columns, rows] = [220_usize, 160];
        let distances: Vec<f64> = (0..columns * rows)
            .map(|place| {
                let [x, y] = [place % columns, place / columns].map(|v| v as f64);
                let hills = 0.3 * (0.05 * x).sin() * (0.08 * y).cos();
                3.0 + hills + random.range(-1e-3, 1e-3)
            })
            .collect();
        let at = |column: usize, row: usize| {
            // No vertex lies on a location.
            let place = [column as f64 * 0.5 - 54.87, row as f64 * 0.5 - 39.91];
            seen_at(place, distances[row * columns + column], SIZE[1])
        };
        for row in 1..rows {
            for column in 1..columns {
                let [left, top] = [column - 1, row - 1];
                stage.add_quad(
                    0,
                    [
                        at(left, top),
                        at(left, row),
                        at(column, row),
                        at(column, top),
                    ],
                );
            }
        }
        let scene = stage.upload(gpu);
        for stretch in [[1.0, 1.0], [0.5, 0.5], [1.1, 0.4]] {
            let rendered = seen(
                gpu,
                &scene,
                &scaled(stretch),
                &settings(Detection::Contrast, true),
            );
            assert!(rendered.attributes.iter().all(|seen| seen.id != 0));
            assert_eq!(rendered.statistics.superpixels, 0, "{stretch:?}");
        }
    });
}
