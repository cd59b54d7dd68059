//! Sampling at locations that other paths sample too: the results are the same.

use gpc::render::{EngineError, PreparedScene, RenderError, Sampled, Settings, Shading, Statistics};
use gpc::sampling::Pattern;

use super::{pinhole, planar};
use crate::blend::panes;
use crate::mask::checker;
use crate::meshes::Random;
use crate::scenes::ball_over_checker;
use crate::stage::{Stage, cells, centre, everywhere, ids, on_gpu, once, once_each};
use crate::twin::Twin;
use crate::visibility::soup;

/// Size of the image in whole tiles, so that an image and its locations have the same middle.
const SIZE: [u32; 2] = [64, 64];
/// Size for many samples a pixel.
const FEW_PIXELS: [u32; 2] = [32, 32];

fn stages() -> [(&'static str, Stage); 4] {
    [("soup", soup(7, 300, true, [-1.0, 5.0])), ("lit", ball_over_checker()), ("mask", checker()), ("blend", panes())]
}

/// The device's rasterizer rounds vertices to 2^-8 pixel, so that a few pixels may differ.
#[test]
fn a_planar_set_sees_what_raster_sees() {
    on_gpu(|gpu| {
        let stage = soup(5, 300, true, [-1.0, 5.0]);
        let raster = ids(&stage.render(gpu, &once(SIZE)));
        let prepared = stage.upload(gpu);
        let seen = gpu.sample_points(&prepared, &pinhole(SIZE), &planar(SIZE), &once_each()).unwrap();
        let twin = Twin::new(&stage, SIZE);
        let mut differ = 0;
        for (pixel, (raster, seen)) in raster.into_iter().zip(seen.values).enumerate() {
            let (_, doubtful) = twin.rasterized(pixel, centre(pixel, SIZE));
            assert!(raster == seen.id || doubtful, "pixel {pixel}: {raster} and {}", seen.id);
            differ += u32::from(raster != seen.id);
        }
        assert!(differ <= 41, "{differ} of 4096");
    });
}

/// For opaque, MASK and BLEND surfaces, a superpixel with one sample at its centre is bit-identical to a point.
#[test]
fn points_are_superpixels_of_one_sample() {
    on_gpu(|gpu| {
        for (name, stage) in stages() {
            let settings = everywhere(SIZE, Pattern::Sobol, 1).background(Some([0.25, 0.5, 0.75]));
            let image = stage.render(gpu, &settings);
            let prepared = stage.upload(gpu);
            let points = gpu.sample_points(&prepared, &pinhole(SIZE), &planar(SIZE), &settings.scene).unwrap();
            for (pixel, (image, point)) in image.colors.iter().zip(&points.values).enumerate() {
                assert_eq!(image, &point.color, "{name}, pixel {pixel}");
            }
            // Both also equal the image without antialiasing, except for the rasterizer's rounding.
            let once = once(SIZE).background(settings.scene.background);
            let none = stage.render(gpu, &once);
            let far = |(a, b): &([f32; 4], [f32; 4])| (0..4).any(|c| (a[c] - b[c]).abs() > 1e-4);
            let pairs = none.colors.iter().zip(&points.values);
            let differ = pairs.map(|(a, b)| (*a, b.color)).filter(far).count();
            assert!(differ <= 41, "{name}: {differ} of 4096");
            let pairs = none.attributes.iter().zip(&points.values);
            for (image, point) in pairs.filter(|(a, b)| a.id == b.id) {
                assert!((image.depth - point.depth).abs() <= 1e-5 * image.depth);
                assert!((0..3).all(|c| (image.normal[c] - point.normal[c]).abs() < 1e-5));
            }
        }
    });
}

#[test]
fn superpixels_of_pixels_are_the_antialiased_image() {
    on_gpu(|gpu| {
        for (name, stage) in stages() {
            let prepared = stage.upload(gpu);
            use {Pattern as P, Shading as S};
            let mut cases = vec![
                (P::Sobol, S::Part, 256),
                (P::Sobol, S::Triangle, 17),
                (P::Lines, S::Part, 256),
                (P::Lines, S::Triangle, 17),
            ];
            match name {
                "soup" => cases.extend([(P::Sobol, S::Triangle, 300), (P::Lines, S::Triangle, 300)]),
                "lit" => cases.extend([(P::Sobol, S::Part, 64), (P::Sobol, S::Sample, 64), (P::Lines, S::Part, 64)]),
                _ => {}
            }
            for (pattern, shading, samples) in cases {
                let settings = everywhere(FEW_PIXELS, pattern.clone(), samples)
                    .map_superpixels(|options| options.shading(shading));
                let image = stage.render(gpu, &settings);
                let (pinhole, places) = (pinhole(FEW_PIXELS), planar(FEW_PIXELS));
                let locations =
                    gpu.sample_superpixels(&prepared, &pinhole, &places, &cells(&settings), &settings.scene).unwrap();
                let pairs = || image.colors.iter().zip(&locations.values);
                if shading == S::Part {
                    // Locations have no neighbours whose colours could be compared, and are shaded in all parts.
                    let sum = |value: &dyn Fn([f32; 4], [f32; 4]) -> f32| -> f32 {
                        pairs().map(|(a, b)| value(*a, *b)).sum()
                    };
                    let apart = sum(&|a, b| (a[1] - b[1]).abs()) / sum(&|a, _| a[1].abs());
                    assert!(apart < 0.01, "{name}, {samples} samples: {apart}");
                    continue;
                }
                let differ = pairs().filter(|(a, b)| a != b).count();
                if pattern == P::Lines {
                    // Frames know more exactly which triangles touch a pixel, and the first of these triangles decides
                    // between rows and columns.
                    assert!(differ * 50 < image.colors.len(), "{name}, {samples} samples: {differ}");
                    continue;
                }
                assert_eq!(differ, 0, "{name}, {samples} samples");
                let counts = |statistics: &Statistics| (statistics.superpixels, statistics.resampled);
                assert_eq!(counts(&locations.statistics), counts(&image.statistics));
            }
        }
    });
}

/// Result of a call with the smallest memory limit that the call accepts. The limit divides the locations into runs.
fn least<T: std::fmt::Debug>(
    prepared: &PreparedScene,
    settings: &Settings,
    mut call: impl FnMut(&Settings) -> Result<Sampled<T>, RenderError>,
) -> Sampled<T> {
    for extra in (0..256).map(|step| step << 16) {
        let tight = settings.clone().max_memory(Some(prepared.memory_bytes() + extra));
        match call(&tight) {
            Err(RenderError::Engine(EngineError::Memory { .. })) => {}
            sampled => {
                let sampled = sampled.unwrap();
                assert!(sampled.statistics.regions > 1);
                return sampled;
            }
        }
    }
    panic!("no memory is enough");
}

/// The results do not depend on the order of locations, on duplicates, or on memory that divides them into runs.
#[test]
fn the_order_of_locations_does_not_matter() {
    on_gpu(|gpu| {
        let pinhole = pinhole(SIZE);
        for (name, stage) in stages() {
            let prepared = stage.upload(gpu);
            let settings = everywhere(SIZE, Pattern::Sobol, 16);
            let locations = planar(SIZE);
            let mut random = Random::new(11);
            let mut shuffled: Vec<_> = locations.iter().chain(&locations[100..900]).copied().collect();
            for last in (1..shuffled.len()).rev() {
                shuffled.swap(last, random.below(last as u64 + 1) as usize);
            }
            let first = gpu.sample_points(&prepared, &pinhole, &locations, &settings.scene).unwrap();
            let again =
                least(&prepared, &settings, |tight| gpu.sample_points(&prepared, &pinhole, &shuffled, &tight.scene));
            for (location, value) in shuffled.iter().zip(&again.values) {
                assert_eq!(*value, first.values[location.output as usize], "{name}");
            }
            let first =
                gpu.sample_superpixels(&prepared, &pinhole, &locations, &cells(&settings), &settings.scene).unwrap();
            let again = least(&prepared, &settings, |tight| {
                gpu.sample_superpixels(&prepared, &pinhole, &shuffled, &cells(tight), &tight.scene)
            });
            for (location, value) in shuffled.iter().zip(&again.values) {
                assert_eq!(*value, first.values[location.output as usize], "{name}");
            }
        }
    });
}
