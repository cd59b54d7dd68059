//! Sampling sets: different variants with the same locations give the same results.

use gpc::camera::set::{Layout, SamplingSet};
use gpc::render::Shading;
use gpc::sampling::Pattern;

use super::pinhole;
use crate::scenes::ball_over_checker;
use crate::stage::{cells, everywhere, on_gpu, once_each};

const SIZE: [u32; 2] = [48, 32];

#[test]
fn sets_that_hold_the_same_locations_see_the_same() {
    on_gpu(|gpu| {
        let prepared = ball_over_checker().upload(gpu);
        let settings = once_each();
        let planar = SamplingSet::planar(SIZE).unwrap();
        let offset = SamplingSet::offset(SIZE, planar.samples().to_vec()).unwrap();
        let mut reversed = planar.samples().to_vec();
        reversed.reverse();
        let no_pattern = SamplingSet::no_pattern(SIZE, reversed, None, 5).unwrap();
        assert!(matches!(no_pattern.layout(), Layout::Tree(leaves) if leaves.len() > 300));
        let mut sample = |set: &SamplingSet| {
            gpu.sample_points(&prepared, &pinhole(SIZE), &set.locations(), &settings).unwrap().values
        };
        let expected = sample(&planar);
        assert!(expected.iter().any(|sample| sample.id != 0));
        assert_eq!(sample(&offset), expected);
        let mut found = sample(&no_pattern);
        found.reverse();
        assert_eq!(found, expected);
    });
}

#[test]
fn a_superpixel_set_of_points_is_the_superpixels() {
    on_gpu(|gpu| {
        let prepared = ball_over_checker().upload(gpu);
        let settings = everywhere(SIZE, Pattern::Sobol, 16).map_superpixels(|options| options.shading(Shading::Sample));
        let marks: Vec<_> = (0..SIZE[0] * SIZE[1]).map(|pixel| pixel % 3 != 0).collect();
        let offsets = Pattern::Sobol.offsets(16).unwrap();
        let set = SamplingSet::superpixel(SIZE, &marks, &offsets).unwrap();
        let points = gpu.sample_points(&prepared, &pinhole(SIZE), &set.locations(), &settings.scene).unwrap();
        let colors: Vec<_> = points.values.iter().map(|sample| sample.color).collect();
        let means = set.image(&colors);
        let planar = SamplingSet::planar(SIZE).unwrap().locations();
        let superpixels =
            gpu.sample_superpixels(&prepared, &pinhole(SIZE), &planar, &cells(&settings), &settings.scene).unwrap();
        let pixels = marks.iter().zip(means.iter().zip(&superpixels.values));
        for (mean, color) in pixels.filter(|(marked, _)| **marked).map(|(_, pair)| pair) {
            let error = (0..4).map(|i| (mean[i] - color[i]).abs() / (1.0 + color[i].abs()));
            assert!(error.fold(0.0, f32::max) < 2e-3, "{mean:?} {color:?}");
        }
    });
}
