//! Coincident surfaces: the smaller ID wins, in the device's rasterizer and in sampling.

use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;

use crate::meshes::{Depths, Random, delaunay};
use crate::stage::{Stage, everywhere, flat, ids, on_gpu, once};

const SIZE: [u32; 2] = [64, 64];

/// A tiling whose triangles have individual distances from the eye, and therefore tilts.
fn tiling() -> Stage {
    let mesh = delaunay(6, 32.0, 12, Depths::Random);
    let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
    stage.add_mesh(0, &mesh, SIZE[1], |triangle| triangle);
    stage
}

/// The stage followed by shuffled copies of its triangles.
fn with_copies(stage: &Stage, copies: usize) -> Stage {
    let mut random = Random::new(3);
    let mut doubled = stage.clone();
    for _ in 0..copies {
        let mut again = stage.triangles.clone();
        for last in (1..again.len()).rev() {
            again.swap(last, random.below(last as u64 + 1) as usize);
        }
        doubled.triangles.extend(again);
    }
    doubled
}

#[test]
fn of_duplicates_the_smaller_id_wins() {
    on_gpu(|gpu| {
        let stage = tiling();
        let count = stage.triangles.len() as u32;
        let mut doubled = with_copies(&stage, 2);
        doubled.color_by_code();
        let mut alone = stage.clone();
        alone.color_by_code();
        let raster = [&alone, &doubled].map(|stage| ids(&stage.render(gpu, &once(SIZE))));
        assert!(raster[1].iter().all(|&id| id <= count));
        assert_eq!(raster[0], raster[1]);
        for samples in [1, 16] {
            let settings = everywhere(SIZE, Pattern::Sobol, samples);
            let [first, second] = [&alone, &doubled].map(|stage| stage.render(gpu, &settings));
            assert_eq!(first.colors, second.colors, "{samples} samples");
        }
    });
}

/// Copies whose vertices are rotated have depths that differ by rounding, so that either may be visible; but nothing
/// else is, and no sample is lost.
#[test]
fn turned_duplicates_hide_each_other() {
    on_gpu(|gpu| {
        let stage = tiling();
        let mut turned = stage.clone();
        for (index, triangle) in stage.triangles.iter().enumerate() {
            let mut copy = triangle.clone();
            copy.corners.rotate_left(1 + index % 2);
            if index % 3 == 0 {
                copy.corners.swap(0, 1);
            }
            turned.triangles.push(copy);
        }
        let mut alone = stage.clone();
        alone.color_by_code();
        for (index, triangle) in turned.triangles.iter_mut().enumerate() {
            triangle.color = alone.triangles[index % alone.triangles.len()].color;
        }
        let settings = everywhere(SIZE, Pattern::Sobol, 16);
        let [first, second] = [&alone, &turned].map(|stage| stage.render(gpu, &settings));
        for (first, second) in first.colors.iter().zip(&second.colors) {
            let near = |(a, b): (&f32, &f32)| (a - b).abs() < 0.01;
            assert!(first.iter().zip(second).all(near), "{first:?}, {second:?}");
        }
    });
}
