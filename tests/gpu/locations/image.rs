//! Images whose pixels are sampled at given locations.

use gpc::camera::{Pinhole, SampleLocation};
use gpc::render::{CellOptions, Method, Rendered, Settings, Shading, SuperpixelOptions};
use gpc::sampling::Pattern;
use gpc::scene::{AlphaMode, Filter, Image, Sampler};

use super::{location, pinhole, planar};
use crate::scenes::ball_over_checker;
use crate::stage::{Stage, on_gpu, once_each, seen_at, textured};

const SIZE: [u32; 2] = [96, 64];

fn differing(a: &Rendered, b: &Rendered) -> usize {
    let far = |(a, b): &(&[f32; 4], &[f32; 4])| (0..4).any(|c| (a[c] - b[c]).abs() > 1e-3);
    a.colors.iter().zip(&b.colors).filter(far).count()
}

/// A square with sides of 64 pixels. Its texture has stripes two texels wide, and is repeated `repeats` times.
fn striped(repeats: f32) -> Stage {
    let mut stage = Stage::new(vec![textured(AlphaMode::Opaque)]);
    // Stripes are two texels wide, across u.
    let texel = |i: u32| {
        if i % 4 < 2 { [255; 4] } else { [0, 0, 0, 255] }
    };
    stage.texture = Some((
        Image { width: 64, height: 64, pixels: (0..64 * 64).flat_map(texel).collect() },
        Sampler { mag: Filter::Linear, min: Filter::Linear, mip: Some(Filter::Linear), ..Sampler::default() },
    ));
    let corner = |x: f64, y: f64| seen_at([x, y], 1.0, SIZE[1]);
    stage.add_quad(0, [corner(-32.0, -32.0), corner(-32.0, 32.0), corner(32.0, 32.0), corner(32.0, -32.0)]);
    stage.triangles[0].uvs = [[0.0, 0.0], [0.0, repeats], [repeats, repeats]];
    stage.triangles[1].uvs = [[0.0, 0.0], [repeats, repeats], [repeats, 0.0]];
    stage
}

/// The antialiased image of a planar set equals the camera's, and a rig whose two pinholes share the pixels shows no
/// seam.
#[test]
fn a_planar_image_is_the_cameras() {
    on_gpu(|gpu| {
        let stage = ball_over_checker();
        let settings = Settings::new(SIZE[0], SIZE[1]).attributes(true).background(Some([0.2, 0.3, 0.4])).method(
            SuperpixelOptions::new(16)
                // Locations have no neighbours to choose the number of parts, and are shaded in all of them.
                .shading(Shading::Triangle)
                // Frames and lists may differ in whether a cell has rows or columns.
                .pattern(Pattern::Sobol),
        );
        let image = stage.render(gpu, &settings);
        let prepared = stage.upload(gpu);
        let pinhole = pinhole(SIZE);
        let one = [(pinhole, planar(SIZE))];
        let whole = gpu.render_locations(&prepared, &one, &settings).unwrap();
        let superpixels = whole.statistics.superpixels;
        assert!(superpixels > 200, "{superpixels}");
        assert!(superpixels.abs_diff(image.statistics.superpixels) <= 12);
        let count = |rendered: &Rendered| {
            let seen = rendered.attributes.iter();
            seen.filter(|p| p.superpixel == 1 && p.samples == 16).count() as u64
        };
        assert_eq!(count(&whole), superpixels);
        assert!(differing(&image, &whole) <= 12);

        let (left, right): (Vec<SampleLocation>, Vec<SampleLocation>) =
            planar(SIZE).into_iter().partition(|location| location.uv[0] < 41.0);
        let rig: [(Pinhole, Vec<SampleLocation>); 2] = [(pinhole, right), (pinhole, left)];
        let shared = gpu.render_locations(&prepared, &rig, &settings).unwrap();
        assert!(shared.statistics.superpixels.abs_diff(superpixels) <= 2);
        // Positions are relative to the middle of each half, so that they are rounded differently.
        assert!(differing(&whole, &shared) <= 6);

        // Supersampling uses a grid of samples in every pixel.
        let brute = settings.clone().method(Method::Ssaa { samples: CellOptions::DEFAULT_SAMPLES });
        let reference = stage.render(gpu, &brute.clone().attributes(false));
        let locations = gpu.render_locations(&prepared, &one, &brute).unwrap();
        assert_eq!(locations.statistics.superpixels, 96 * 64);
        let error: f64 =
            reference.colors.iter().zip(&locations.colors).map(|(a, b)| f64::from((a[0] - b[0]).abs())).sum();
        assert!(error / (96.0 * 64.0) < 2e-3, "{error}");
    });
}

/// A texture of black and white texels is sharp where cells are small, and grey where they are large in the direction
/// of the change.
#[test]
fn the_jacobian_is_the_footprint_of_textures() {
    on_gpu(|gpu| {
        let stage = striped(1.0);
        let prepared = stage.upload(gpu);
        // A texel is as large as a pixel of the plane, and stripes are white from 16 + 4 n to 18 + 4 n.
        let at = |u: f64, side: f64| SampleLocation { jacobian: [[side, 0.0], [0.0, side]], ..location([u, 32.0], 0) };
        let locations: Vec<SampleLocation> =
            [0.01, 0.25, 16.0].into_iter().flat_map(|side| [at(33.0, side), at(35.0, side)]).collect();
        let seen = gpu.sample_points(&prepared, &pinhole(SIZE), &locations, &once_each()).unwrap();
        let red: Vec<f32> = seen.values.iter().map(|v| v.color[0]).collect();
        for pair in red[..4].chunks(2) {
            assert!(pair[0] > 0.999 && pair[1] < 0.001, "{red:?}");
        }
        for grey in &red[4..] {
            assert!((0.15..0.6).contains(grey), "{red:?}");
        }
    });
}

/// Stripes that are finer than pixels are visible to each sample of supersampling, instead of their mean over a whole
/// pixel.
#[test]
fn brute_force_reads_textures_at_its_samples() {
    on_gpu(|gpu| {
        let stage = striped(3.0);
        let settings = Settings::new(SIZE[0], SIZE[1]).method(Method::Ssaa { samples: 16 });
        let image = stage.render(gpu, &settings);
        let prepared = stage.upload(gpu);
        let rig = [(pinhole(SIZE), planar(SIZE))];
        let locations = gpu.render_locations(&prepared, &rig, &settings).unwrap();
        // Pixels of the square without its border.
        let inside = (20..44).flat_map(|y| (20..76).map(move |x| y * SIZE[0] as usize + x));
        let reds = inside.map(|pixel| [&image, &locations].map(|seen| f64::from(seen.colors[pixel][0])));
        let reds: Vec<_> = reds.collect();
        let mean = |of: &dyn Fn(&[f64; 2]) -> f64| reds.iter().map(of).sum::<f64>() / reds.len() as f64;
        let grey = mean(&|[image, _]| *image);
        let contrast = mean(&|[image, _]| (image - grey).abs());
        let difference = mean(&|[image, locations]| (image - locations).abs());
        assert!(contrast > 0.05, "{contrast}");
        assert!(difference < 0.1 * contrast, "{difference} of {contrast}");
    });
}
