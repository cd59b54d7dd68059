//! Numbers of parts in which superpixels are shaded, compared with the CPU's numbers. Each part is one visibility
//! sample, and these are counted.

use crate::meshes::Random;
use crate::stage::{Stage, on_gpu, once, seen_at, textured};
use gpc::color::srgb::encode;
use gpc::render::{Detection, Rendered, Shading, SuperpixelOptions};
use gpc::sampling::Pattern;
use gpc::scene::{AlphaMode, Filter, Image, Sampler};
use twins::variation::{Neighbourhood, ShadedParts, parts};

/// Sizes of two images: in one a triangle covers many pixels of a row, in the other a single one.
const SIZES: [[u32; 2]; 2] = [[32, 24], [2, 96]];
/// Thresholds of contrast: those of few and of many samples.
const CONTRASTS: [u8; 2] = [8, 1];
/// Number of samples of a block, which is divided into parts on its own.
const BLOCK: u32 = 64;
/// Numbers of samples, and the number of parts of a superpixel for each.
const RATES: [(u32, u64); 5] = [(4, 4), (16, 16), (64, 32), (256, 128), (1024, 256)];

/// A texture with a texel for each pixel: patches of even, slightly uneven, uneven and very uneven grey.
fn patches([width, height]: [u32; 2], seed: u64) -> Image {
    let mut random = Random::new(seed);
    let side = (width / 5).max(1);
    let mut pixels = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let spread = [1, 3, 9, 17, 33, 90][((x / side + y / 6) % 6) as usize];
            let grey = 80 + random.below(spread) as u8;
            pixels.extend([grey, grey, grey, 255]);
        }
    }
    Image { width, height, pixels }
}

/// Stage of two triangles that fill the image and meet between two columns of pixels, with one or two materials.
fn stage(size: [u32; 2], seed: u64, materials: usize) -> Stage {
    let mut stage = Stage::new(vec![textured(AlphaMode::Opaque); materials]);
    stage.texture = Some((
        patches(size, seed),
        Sampler { mag: Filter::Nearest, min: Filter::Nearest, mip: None, ..Sampler::default() },
    ));
    let [width, height] = size.map(f64::from);
    let at = |x: f64, y: f64| seen_at([x, y], 1.0, size[1]);
    let uv = |x: f64, y: f64| [(x / width + 0.5) as f32, (y / height + 0.5) as f32];
    for (material, side) in [(0, -1.0), (materials - 1, 1.0)] {
        let corners = [[0.0, -120.0], [side * 150.0, 0.0], [0.0, 120.0]];
        let corners = if side > 0.0 { corners } else { [corners[0], corners[2], corners[1]] };
        stage.add(material, corners.map(|[x, y]| at(x, y)));
        if let Some(triangle) = stage.triangles.last_mut() {
            triangle.uvs = corners.map(|[x, y]| uv(x, y));
        }
    }
    stage
}

/// Centres around a pixel, in the form of the twin.
fn around(rendered: &Rendered, size: [u32; 2], x: i64, y: i64) -> Neighbourhood {
    let [width, height] = size.map(i64::from);
    let mut found = Neighbourhood { ids: [0; 9], colours: [[0; 3]; 9] };
    for place in 0..9 {
        let (nx, ny) = (x + place % 3 - 1, y + place / 3 - 1);
        if (0..width).contains(&nx) && (0..height).contains(&ny) {
            let pixel = (ny * width + nx) as usize;
            found.ids[place as usize] = rendered.attributes[pixel].id;
            let [r, g, b, _] = rendered.colors[pixel].map(f64::from);
            found.colours[place as usize] = [r, g, b].map(|v| (255.0 * encode(v)).round() as u8);
        }
    }
    found
}

fn mean(rendered: &Rendered) -> f64 {
    let sum: f64 = rendered.colors.iter().map(|c| f64::from(c[1])).sum();
    sum / rendered.colors.len() as f64
}

#[test]
fn places_are_as_many_as_the_twin_says() {
    on_gpu(|gpu| {
        let mut seen = [0; 4];
        let stages = SIZES.into_iter().flat_map(|size| [(1, 1), (2, 2), (3, 1)].map(|(seed, m)| (size, seed, m)));
        for (size, seed, materials) in stages {
            let stage = stage(size, seed, materials);
            let base = stage.render(gpu, &once(size));
            let rates = CONTRASTS.into_iter().flat_map(|c| RATES.map(|rate| (c, rate)));
            for (contrast, (samples, all)) in rates {
                let settings = |shading| {
                    once(size).method(
                        SuperpixelOptions::new(samples)
                            .detection(Detection::Every)
                            // The twin is made for points; on lines, parts with little of a triangle share a
                            // visibility sample.
                            .pattern(Pattern::Sobol)
                            .contrast(Some(contrast))
                            .shading(shading)
                            .thin(false),
                    )
                };
                let rendered = stage.render(gpu, &settings(Shading::Part));
                let material = |id: u32| if materials == 1 { 0 } else { id };
                let mut expected = 0;
                for y in 0..i64::from(size[1]) {
                    for x in 0..i64::from(size[0]) {
                        let around = around(&base, size, x, y);
                        let own = around.ids[4];
                        assert!(own != 0);
                        let parts = parts(&around, material, own, contrast, samples);
                        seen[parts as usize] += 1;
                        expected += match parts {
                            ShadedParts::All => all,
                            ShadedParts::Pairs => all / if samples < 32 { 1 } else { 2 },
                            ShadedParts::Fours => all / if samples < 32 { 2 } else { 4 },
                            ShadedParts::One => u64::from(samples.div_ceil(BLOCK)),
                        };
                    }
                }
                let fragments = rendered.statistics.visibility_samples;
                assert_eq!(fragments, expected, "{materials} materials, {samples} samples, contrast {contrast}");
                // Texels are pixels, so that all places of a pixel have one colour: nothing is lost or counted twice.
                let sampled = stage.render(gpu, &settings(Shading::Sample));
                let apart = mean(&rendered) / mean(&sampled) - 1.0;
                assert!(apart.abs() < 1e-4, "{samples} samples: {apart}");
            }
        }
        assert!(seen.iter().all(|count| *count > 20), "{seen:?}");
    });
}
