//! Extreme scenes and images.

use gpc::render::{Headless, HeadlessOptions, MethodKind, Rendered, SceneRequest, Settings};
use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;

use crate::meshes::{Depths, delaunay};
use crate::stage::{Stage, camera, everywhere, flat, ids, on_gpu, once, seen_at};

/// Settings for every method, with attributes if it supports them.
fn all_methods(size: [u32; 2]) -> [Settings; 5] {
    let method = |method: MethodKind, samples| {
        once(size)
            // With multisampling, pixel centres have no IDs.
            .attributes(method != MethodKind::Msaa)
            .method(method.with_samples(samples))
            .map_superpixels(|options| options.thin(false))
    };
    let sampled = everywhere(size, Pattern::Sobol, 16).attributes(true);
    [
        method(MethodKind::None, 1),
        method(MethodKind::Superpixel, 64),
        sampled,
        method(MethodKind::Ssaa, 9),
        method(MethodKind::Msaa, 4),
    ]
}

fn assert_empty(gpu: &mut Headless, stage: &Stage, what: &str) {
    for settings in all_methods([20, 11]) {
        for background in [None, Some([0.25, 0.5, 1.0])] {
            let settings = settings.clone().background(background);
            let rendered = stage.render(gpu, &settings);
            let expected = background.map_or([0.0; 4], |[r, g, b]| [r, g, b, 1.0]);
            assert_eq!(rendered.colors, [expected; 220], "{what}, {:?}", settings.method);
            assert!(rendered.attributes.iter().all(|p| p.id == 0 && p.depth == 0.0));
        }
    }
}

#[test]
fn a_scene_without_triangles_is_background() {
    on_gpu(|gpu| assert_empty(gpu, &Stage::default(), "no triangles"));
}

#[test]
fn what_is_out_of_view_is_background() {
    on_gpu(|gpu| {
        let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
        // The triangles are behind the eye, in front of the near plane, and to the left, right, top and bottom of the
        // view.
        stage.add(0, [[-1.0, -1.0, 3.0], [1.0, -1.0, 3.0], [0.0, 1.0, 3.0]]);
        stage.add(0, [[-0.1, -0.1, -0.001], [0.1, -0.1, -0.001], [0.0, 0.1, -0.001]]);
        for [x, y] in [[-500.0, 0.0], [500.0, 0.0], [0.0, -500.0], [0.0, 500.0]] {
            let corners = [[0.0, -20.0], [-20.0, 20.0], [20.0, 20.0]];
            stage.add(0, corners.map(|[u, v]| seen_at([x + u, y + v], 2.0, 11)));
        }
        assert_empty(gpu, &stage, "out of view");
    });
}

/// Triangles without an area, edge-on, or thinner than the distance between samples.
#[test]
fn degenerate_triangles_cover_nothing() {
    on_gpu(|gpu| {
        let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
        stage.add(0, [[0.0, 0.0, -2.0]; 3]);
        stage.add(0, [[-1.0, 0.1, -2.0], [1.0, 0.1, -2.0], [0.0, 0.1, -2.0]]);
        stage.add(0, [[0.25, -1.0, -1.0], [0.25, 0.0, -1.0], [0.25, 1.0, -1.0]]);
        // The triangle is in a plane through the eye.
        stage.add(0, [[0.0, 1.0, -1.0], [0.0, -1.0, -1.0], [0.0, 0.0, -9.0]]);
        stage.add(0, [[1e-40, 0.0, -1.0], [0.0, 1e-40, -1.0], [0.0, 0.0, -1.0]]);
        stage.add(0, [[1e30, 0.0, -1.0], [-1e30, 0.0, -1.0], [0.0, 0.0, 1e30]]);
        assert_empty(gpu, &stage, "degenerate");
    });
}

#[test]
fn images_of_any_size_are_covered_to_their_borders() {
    on_gpu(|gpu| {
        for size in [[1, 1], [37, 23], [1, 70], [70, 1], [8, 4], [9, 5], [7, 3]] {
            let half = f64::from(size[0].max(size[1])) / 2.0 + 1.0;
            let mesh = delaunay(2, half, 9, Depths::Random);
            let mut stage = Stage::new(vec![flat([0.5, 0.25, 0.125, 1.0], AlphaMode::Opaque)]);
            stage.add_mesh(0, &mesh, size[1], |triangle| triangle);
            for settings in all_methods(size) {
                let rendered = stage.render(gpu, &settings);
                assert_eq!(rendered.size, size);
                assert_eq!(rendered.colors.len(), (size[0] * size[1]) as usize);
                let near = |color: &[f32; 4]| {
                    let expected = [0.5, 0.25, 0.125, 1.0];
                    color.iter().zip(expected).all(|(v, e): (&f32, f32)| (v - e).abs() < 1e-6)
                };
                let covered = rendered.colors.iter().all(near);
                assert!(covered, "{size:?}, {:?}", settings.method);
                assert!(!ids(&rendered).contains(&0), "{size:?}, {:?}", settings.method);
            }
        }
    });
}

/// Depth is the distance along the view direction, over five powers of ten.
#[test]
fn attributes_are_those_of_the_surface() {
    on_gpu(|gpu| {
        let size = [24, 24];
        for distance in [0.02, 1.0, 300.0, 2e4] {
            let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
            let corners = [[0.0, -40.0], [-40.0, 40.0], [40.0, 40.0]];
            stage.add(0, corners.map(|place| seen_at(place, distance, size[1])));
            for pixel in stage.render(gpu, &once(size)).attributes {
                assert!((f64::from(pixel.depth) / distance - 1.0).abs() < 1e-5, "{pixel:?}");
                assert_eq!((pixel.id, pixel.samples, pixel.superpixel), (1, 1, 0));
                assert!((pixel.normal[2] - 1.0).abs() < 1e-6, "{pixel:?}");
            }
        }
    });
}

/// A device is created, used and destroyed without a message of the validation layer.
#[test]
fn a_whole_life_is_valid() {
    let options = HeadlessOptions::default().validation(true);
    let mut gpu = Headless::new(&options).unwrap();
    let instance = gpu.gpu().instance().unwrap().clone();
    let (scene, pose) = crate::scenes::ball_over_checker().build();
    let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
    let mut frame = gpu.prepare(&prepared, &Settings::new(40, 30)).unwrap();
    let rendered: Rendered = gpu.render(&mut frame, &camera()).unwrap();
    assert!(rendered.statistics.superpixels > 0 && rendered.statistics.gpu_ms() > 0.0);
    drop((frame, prepared, gpu));
    assert_eq!(instance.validation_messages(), Vec::<String>::new());
}
