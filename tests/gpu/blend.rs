//! BLEND surfaces, composited per sample in exact order of depth and compared with a sum over the twin's surfaces.

use gpc::color::srgb;
use gpc::render::{Headless, Method, MethodKind, Rendered, Settings, Shading};
use gpc::sampling::Pattern;
use gpc::scene::{AlphaMode, Material};

use crate::meshes::Random;
use crate::stage::{Stage, centre, everywhere, flat, on_gpu, once, seen_at};
use crate::twin::Twin;

const SIZE: [u32; 2] = [48, 40];
/// Number of panes of [`deep`].
const PANES: usize = 12;

/// Panes that intersect each other, through and in front of an opaque wall with a hole.
pub fn panes() -> Stage {
    let mut stage = Stage::new(vec![
        flat([0.125, 0.5, 0.25, 1.0], AlphaMode::Opaque),
        flat([1.0, 0.0, 0.0, 0.5], AlphaMode::Blend),
        flat([0.0, 0.75, 0.0, 0.25], AlphaMode::Blend),
        flat([0.0, 0.5, 2.0, 0.75], AlphaMode::Blend),
    ]);
    let mut quad = |material, corners: [([f64; 2], f64); 4]| {
        stage.add_quad(material, corners.map(|(at, far)| seen_at(at, far, SIZE[1])));
    };
    let upright = |near, far, left, right| {
        [([left, -18.0], near), ([left, 17.0], near), ([right, 17.0], far), ([right, -18.0], far)]
    };
    quad(0, upright(4.0, 4.0, -22.0, -3.3));
    // Two panes intersect; one of them also intersects the wall.
    quad(1, upright(2.0, 6.0, -20.3, 19.1));
    quad(2, upright(6.5, 1.5, -19.7, 21.4));
    // Three panes are behind one another; two of them coincide.
    quad(3, upright(3.0, 3.0, -9.2, 8.8));
    quad(3, upright(3.0, 3.0, -9.2, 8.8));
    quad(1, upright(3.5, 3.5, -11.9, 6.1));
    let mut random = Random::new(8);
    for _ in 0..10 {
        let mut corner = || {
            let place = [0; 2].map(|_| random.range(-22.0, 22.0));
            seen_at(place, random.range(1.0, 8.0), SIZE[1])
        };
        let corners = [corner(), corner(), corner()];
        stage.add(2, corners);
    }
    stage
}

/// A wall, and intersecting panes in front of and through it: neighbouring samples usually see different layers. With
/// `lit`, every other pane is glossy.
fn deep(lit: bool) -> Stage {
    let mut random = Random::new(3);
    let mut channel = || random.below(65) as f32 / 64.0;
    let mut materials = vec![flat([0.5, 0.25, 0.125, 1.0], AlphaMode::Opaque)];
    materials.extend((0..PANES).map(|pane| Material {
        unlit: !lit,
        roughness: if pane % 2 == 0 { 0.5 } else { 1.0 },
        ..flat([channel(), channel(), channel(), 0.125], AlphaMode::Blend)
    }));
    let mut stage = Stage::new(materials);
    let mut random = Random::new(4);
    for material in 0..=PANES {
        let mut corner = |x: f64, y: f64| {
            let far = if material == 0 { 6.0 } else { random.range(2.0, 7.0) };
            let place = [x * random.range(18.0, 26.0), y * random.range(15.0, 22.0)];
            seen_at(place, far, SIZE[1])
        };
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        stage.add_quad(material, corners.map(|(x, y)| corner(x, y)));
    }
    stage
}

/// Many small panes in each pixel over an empty background.
fn confetti() -> Stage {
    let mut random = Random::new(5);
    let mut stage = Stage::new((0..4).map(|i| flat([1.0, 0.25 * i as f32, 0.5, 0.25], AlphaMode::Blend)).collect());
    for index in 0..600 {
        let middle = SIZE.map(|side| random.range(-0.5, 0.5) * f64::from(side));
        let far = random.range(1.0, 9.0);
        let corners = [0; 3].map(|_| seen_at(middle.map(|at| at + random.range(-3.0, 3.0)), far, SIZE[1]));
        stage.add(index % 4, corners);
    }
    stage
}

/// Premultiplied colour of a sample over a background, and whether rounding may change it. BLEND surfaces are searched
/// first, starting from the nearest.
fn composite(stage: &Stage, twin: &Twin, pixel: usize, sample: [f64; 2], back: [f64; 4]) -> ([f64; 4], bool) {
    let mut layers = Vec::new();
    let mut hidden = Vec::new();
    let mut contested = false;
    let mut color = back;
    loop {
        let seen = twin.without(pixel, sample, &hidden);
        // The coincident panes have bit-identical depths, so that their order is certain.
        let tie = seen.second == seen.nearest.map(|hit| hit.depth);
        contested |= seen.contested() && !tie || seen.edge_margin < 1.0 / 1024.0;
        let Some(hit) = seen.nearest else { break };
        let material = &stage.materials[stage.triangles[hit.id as usize - 1].material];
        let [r, g, b, a] = material.base_color.map(f64::from);
        if material.alpha_mode == AlphaMode::Opaque {
            color = [r, g, b, 1.0];
            break;
        }
        layers.push([r * a, g * a, b * a, a]);
        hidden.push(hit.id);
    }
    for layer in layers.into_iter().rev() {
        color = [0, 1, 2, 3].map(|i| layer[i] + color[i] * (1.0 - layer[3]));
    }
    (color, contested)
}

/// Largest difference of two images, over all channels of all pixels.
fn distance(first: &Rendered, second: &Rendered) -> f32 {
    assert_eq!(first.colors.len(), second.colors.len());
    let channels = |image: &Rendered| image.colors.clone().into_iter().flatten();
    let pairs = channels(first).zip(channels(second));
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

/// A pane of opacity 0 in front of an opaque background, whose colour no tone mapping changes, and of a triangle.
#[test]
fn invisible_panes_change_nothing() {
    let stage = |has_pane: bool| {
        let material = |alpha, mode| Material { unlit: false, roughness: 0.3, ..flat([0.5, 0.25, 1.0, alpha], mode) };
        let mut stage = Stage::new(vec![material(1.0, AlphaMode::Opaque), material(0.0, AlphaMode::Blend)]);
        stage.add(0, [[-18.0, -15.0], [11.0, -9.0], [3.0, 14.0]].map(|place| seen_at(place, 4.0, SIZE[1])));
        if has_pane {
            let corners = [[-15.0, -12.0], [16.0, -12.0], [16.0, 13.0], [-15.0, 13.0]];
            stage.add_quad(1, corners.map(|place| seen_at(place, 2.0, SIZE[1])));
        }
        stage
    };
    on_gpu(|gpu| {
        for method in [MethodKind::None, MethodKind::Ssaa, MethodKind::Superpixel] {
            let background = [13, 170, 240].map(|code| srgb::decode_u8(code) as f32);
            let settings = Settings::new(SIZE[0], SIZE[1]).background(Some(background)).method(method.with_samples(64));
            let mut codes = |has_pane| -> Vec<u8> {
                let rendered = stage(has_pane).render(gpu, &settings);
                let channels = rendered.colors.as_flattened().iter();
                channels.map(|x| (255.0 * srgb::encode(f64::from(*x))).round() as u8).collect()
            };
            let (with, without) = (codes(true), codes(false));
            assert_eq!(without[..4], [13, 170, 240, 255]);
            // A tile with BLEND triangles has samples at points instead of on lines, which shifts edges.
            let is_edge = |i: usize| method == MethodKind::Superpixel && without[i..i + 4] != without[..4];
            let pixels = (0..without.len()).step_by(4);
            let changed = pixels.filter(|&i| with[i..i + 4] != without[i..i + 4] && !is_edge(i)).count();
            assert_eq!(changed, 0, "{method}");
        }
    });
}

/// A visibility sample that several samples share has the colour that each of them would have: exactly for unlit
/// surfaces, and nearly for lit ones.
#[test]
fn shared_layers_are_those_of_each_sample() {
    on_gpu(|gpu| {
        for (name, stage, samples, tolerance) in [
            ("panes", panes(), 64, 1e-5),
            ("panes", panes(), 37, 1e-5),
            ("panes", panes(), 256, 1e-5),
            ("deep", deep(false), 64, 1e-5),
            ("lit", deep(true), 64, 5e-3),
            ("confetti", confetti(), 64, 1e-5),
        ] {
            for background in [None, Some([0.25, 0.5, 0.125])] {
                let shaded = |gpu: &mut Headless, shading| {
                    let settings = everywhere(SIZE, Pattern::Sobol, samples)
                        .background(background)
                        .map_superpixels(|options| options.shading(shading));
                    stage.render(gpu, &settings)
                };
                let each = shaded(gpu, Shading::Sample);
                for shading in [Shading::Triangle, Shading::Part] {
                    let shared = shaded(gpu, shading);
                    let apart = distance(&each, &shared);
                    assert!(apart < tolerance, "{name}, {samples} samples, {shading:?}: {apart}");
                    let [fewer, all] = [&shared, &each].map(|image| image.statistics.visibility_samples);
                    assert!(fewer < all, "{name}, {shading:?}: {fewer} of {all} visibility samples");
                }
            }
        }
    });
}

#[test]
fn panes_are_composited_from_the_farthest_to_the_nearest() {
    for stage in [panes(), deep(false)] {
        assert_is_the_twins(&stage);
    }
}

fn assert_is_the_twins(stage: &Stage) {
    let twin = Twin::new(stage, SIZE);
    on_gpu(|gpu| {
        let none = once(SIZE).method(Method::None);
        let clear = [0.0; 4];
        let grey = [0.25, 0.5, 0.125, 1.0];
        for (settings, back) in [
            (everywhere(SIZE, Pattern::Sobol, 16), clear),
            (everywhere(SIZE, Pattern::Sobol, 37), grey),
            (none.clone(), clear),
            (none, grey),
        ] {
            let settings =
                settings.background((back[3] > 0.0).then_some([back[0] as f32, back[1] as f32, back[2] as f32]));
            let rendered = stage.render(gpu, &settings);
            let offsets = match &settings.method {
                Method::Superpixel(options) => {
                    let cells = &options.cells;
                    cells.pattern.offsets(cells.samples).unwrap()
                }
                _ => vec![[0.0, 0.0]],
            };
            let (mut checked, mut layered) = (0, 0);
            for (pixel, found) in rendered.colors.iter().enumerate() {
                let middle = centre(pixel, SIZE);
                let mut sum = [0.0; 4];
                let mut contested = 0.0;
                for offset in &offsets {
                    let sample = [0, 1].map(|axis| middle[axis] + f64::from(offset[axis]));
                    let (color, doubtful) = composite(stage, &twin, pixel, sample, back);
                    sum = [0, 1, 2, 3].map(|i| sum[i] + color[i] / offsets.len() as f64);
                    contested += f64::from(u8::from(doubtful)) / offsets.len() as f64;
                }
                for channel in 0..4 {
                    let difference = (f64::from(found[channel]) - sum[channel]).abs();
                    assert!(
                        difference < 1e-5 + 2.0 * contested,
                        "{:?}, at {middle:?}: {found:?} instead of {sum:?}, {contested} contested",
                        settings.method
                    );
                }
                checked += u32::from(contested == 0.0);
                layered += u32::from(sum[3] > 0.0);
            }
            let pixels = SIZE[0] * SIZE[1];
            assert!(checked * 10 > pixels * 8 && layered * 2 > pixels, "{checked}, {layered}");
        }
    });
}
