//! Coverage by exact areas.

use gpc::reference::edge::triangle_area;
use gpc::render::{Coverage, Settings, Shading};
use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;

use crate::meshes::Random;
use crate::stage::{Stage, everywhere, flat, on_gpu, seen_at};

const SIZE: [u32; 2] = [48, 32];

fn by_area(samples: u32) -> Settings {
    everywhere(SIZE, Pattern::Sobol, samples)
        .map_superpixels(|options| options.coverage(Coverage::Area).shading(Shading::Part))
}

/// Random place in and around the image, in pixels from its centre.
fn place(random: &mut Random) -> [f64; 2] {
    SIZE.map(|side| random.range(-0.6, 0.6) * f64::from(side))
}

/// Centre of pixel `index`, relative to the image's centre.
fn centre(index: usize) -> [f64; 2] {
    let [width, height] = SIZE.map(|side| side as usize);
    [
        (index % width) as f64 + 0.5 - width as f64 / 2.0,
        (index / width) as f64 + 0.5 - height as f64 / 2.0,
    ]
}

/// Tolerance of a covered area: small and large areas may come from few samples, or be lost entirely.
fn tolerance(area: f64) -> f64 {
    if (0.1..0.95).contains(&area) {
        2e-5
    } else {
        0.06
    }
}

/// A triangle on its own covers its exact area, whatever the number of samples.
#[test]
fn a_triangle_covers_its_area() {
    on_gpu(|gpu| {
        let mut random = Random::new(11);
        for samples in [64, 256, 1024] {
            for _ in 0..6 {
                let corners = [(); 3].map(|()| place(&mut random));
                let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
                stage.add(0, corners.map(|at| seen_at(at, 2.0, SIZE[1])));
                let image = stage.render(gpu, &by_area(samples));
                for (index, color) in image.colors.iter().enumerate() {
                    let area = triangle_area(corners, centre(index));
                    let tolerance = tolerance(area);
                    let error = (f64::from(color[0]) - area).abs();
                    assert!(
                        error <= tolerance,
                        "{corners:?}, pixel {index}: {color:?}, {area}"
                    );
                }
            }
        }
    });
}

/// Two surfaces of two triangles each overlap: their shares add up to one everywhere, and the nearer surface has its
/// exact area.
#[test]
fn what_is_left_goes_to_what_lies_behind() {
    on_gpu(|gpu| {
        let mut random = Random::new(12);
        for _ in 0..6 {
            let behind = flat([0.0, 1.0, 0.0, 1.0], AlphaMode::Opaque);
            let mut stage = Stage::new(vec![flat([1.0, 0.0, 0.0, 1.0], AlphaMode::Opaque), behind]);
            let quad = [[-60.0, -60.0], [60.0, -60.0], [60.0, 60.0], [-60.0, 60.0]];
            for corners in [[0, 1, 2], [0, 2, 3]] {
                stage.add(1, corners.map(|i: usize| seen_at(quad[i], 4.0, SIZE[1])));
            }
            let front = [(); 3].map(|()| place(&mut random));
            stage.add(0, front.map(|at| seen_at(at, 2.0, SIZE[1])));
            let image = stage.render(gpu, &by_area(64));
            for (index, color) in image.colors.iter().enumerate() {
                let [red, green, ..] = color.map(f64::from);
                assert!((red + green - 1.0).abs() < 1e-6, "pixel {index}: {color:?}");
                let area = triangle_area(front, centre(index));
                let tolerance = tolerance(area);
                assert!(
                    (red - area).abs() <= tolerance,
                    "pixel {index}: {color:?}, {area}"
                );
            }
        }
    });
}

/// Areas do not depend on the number of samples.
#[test]
fn superpixels_that_few_samples_settle_take_no_more() {
    on_gpu(|gpu| {
        let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
        let corners = [[-20.0, -13.0], [19.0, -9.0], [3.0, 14.0]];
        stage.add(0, corners.map(|at| seen_at(at, 2.0, SIZE[1])));
        let image = stage.render(gpu, &by_area(1024));
        let statistics = &image.statistics;
        assert_eq!(statistics.superpixels, u64::from(SIZE[0] * SIZE[1]));
        assert!(
            statistics.resampled * 50 < statistics.superpixels,
            "{statistics:?}"
        );
    });
}
