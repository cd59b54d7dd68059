//! The methods, compared with each other: with the same samples they give the same image.

use gpc::color::srgb::encode;
use gpc::render::{Detection, MethodKind, Rendered, SceneRequest, Settings, Shading};
use gpc::sampling::Pattern;

use crate::scenes::ball_over_checker;
use crate::stage::on_gpu;

const SIZE: [u32; 2] = [96, 64];

/// Peak signal-to-noise ratio of sRGB-encoded images in decibels.
fn psnr(a: &Rendered, b: &Rendered) -> f64 {
    let encoded = |image: &Rendered| -> Vec<f64> {
        let channels = image.colors.as_flattened().iter();
        channels.map(|&v| encode(f64::from(v))).collect()
    };
    let (a, b) = (encoded(a), encoded(b));
    assert_eq!(a.len(), b.len());
    let squares: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum();
    -10.0 * (squares / a.len() as f64).log10()
}

fn settings(method: MethodKind, samples: u32) -> Settings {
    Settings::new(SIZE[0], SIZE[1]).background(Some([0.2, 0.4, 0.8])).method(method.with_samples(samples))
}

/// Superpixels everywhere, with samples on the grid of supersampling.
fn on_the_grid(samples: u32) -> Settings {
    settings(MethodKind::Superpixel, samples)
        .map_superpixels(|options| options.pattern(Pattern::Grid).shading(Shading::Sample).detection(Detection::Every))
}

#[test]
fn superpixels_on_a_grid_are_brute_force() {
    on_gpu(|gpu| {
        let stage = ball_over_checker();
        for samples in [16, 64] {
            let sampled = stage.render(gpu, &on_the_grid(samples));
            let brute = stage.render(gpu, &settings(MethodKind::Ssaa, samples));
            // The device rounds vertices to 2^-8 of its pixels, which are smaller for supersampling.
            let ratio = psnr(&sampled, &brute);
            assert!(ratio > 55.0, "{samples} samples: {ratio} dB");
        }
    });
}

#[test]
fn one_sample_is_none() {
    on_gpu(|gpu| {
        let stage = ball_over_checker();
        let none = stage.render(gpu, &settings(MethodKind::None, 1));
        let brute = stage.render(gpu, &settings(MethodKind::Ssaa, 1));
        assert_eq!(none.colors, brute.colors);
        // Rounding of vertices moves edges across the centres of a few pixels.
        let sampled = stage.render(gpu, &on_the_grid(1));
        let near = |(a, b): &(&[f32; 4], &[f32; 4])| a.iter().zip(*b).all(|(a, b)| (a - b).abs() < 1e-4);
        let pairs = none.colors.iter().zip(&sampled.colors);
        let different = pairs.filter(|pair| !near(pair)).count();
        assert!(different <= 6, "{different} pixels differ");
    });
}

#[test]
fn superpixels_approach_brute_force_where_it_matters() {
    on_gpu(|gpu| {
        let stage = ball_over_checker();
        let brute = stage.render(gpu, &settings(MethodKind::Ssaa, 256));
        let none = psnr(&stage.render(gpu, &settings(MethodKind::None, 1)), &brute);
        let sampled = stage.render(gpu, &settings(MethodKind::Superpixel, 64));
        let statistics = &sampled.statistics;
        assert!(statistics.superpixels * 2 < u64::from(SIZE[0] * SIZE[1]), "{statistics:?}");
        let ratio = psnr(&sampled, &brute);
        assert!(ratio > none + 8.0, "{ratio} dB, without antialiasing {none}");
    });
}

/// All known devices, lavapipe included, have 4 samples at the standard locations.
#[test]
fn multisampling_is_four_samples_at_the_standard_locations() {
    on_gpu(|gpu| {
        let stage = ball_over_checker();
        let device = stage.render(gpu, &settings(MethodKind::Msaa, 4));
        let own = settings(MethodKind::Superpixel, 4)
            .map_superpixels(|options| options.pattern(Pattern::Rotated).detection(Detection::Every));
        let own = stage.render(gpu, &own);
        let ratio = psnr(&device, &own);
        assert!(ratio > 35.0, "{ratio} dB");
    });
}

/// Numbers of samples that a method can't have are refused before anything runs, with a list of possible ones.
#[test]
fn impossible_counts_are_usage_errors() {
    on_gpu(|gpu| {
        let (scene, pose) = ball_over_checker().build();
        let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
        for (method, samples, named) in [
            (MethodKind::Superpixel, 0, "1 to 1024"),
            (MethodKind::Superpixel, 1025, "1 to 1024"),
            (MethodKind::Ssaa, 10, "1, 4, 9, 16"),
            (MethodKind::Msaa, 3, "4"),
        ] {
            let error = gpu.prepare(&prepared, &settings(method, samples)).err().unwrap();
            assert!(error.is_usage() && error.to_string().contains(named), "{error}");
        }
        let error = gpu.prepare(&prepared, &Settings::new(0, 5)).err().unwrap();
        assert!(error.is_usage(), "{error}");
    });
}
