//! Tiles with more triangles, or more layers, than a list of candidates may have.

use gpc::render::{Headless, Rendered, Shading};
use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;

use crate::blend::panes;
use crate::devices::{few_texel_elements, within};
use crate::locations::{pinhole, planar};
use crate::mask::checker;
use crate::meshes::Random;
use crate::stage::{Stage, cells, everywhere, flat, on_gpu, once_each, seen_at};
use crate::visibility::soup;

/// Size of the image in whole tiles, so that an image and its locations have the same middle.
const SIZE: [u32; 2] = [32, 32];

/// The stage with 16,500 more triangles in a tile beside the image's middle. On a device with few texel elements, a
/// list has no room for so many, although all pairs fit into memory. The triangles are so small that they lie between
/// nearly all samples.
fn with_specks(mut stage: Stage) -> Stage {
    let mut random = Random::new(9);
    let mut specks = Stage::new(stage.materials.clone());
    for _ in 0..16_500 {
        let middle = [random.range(0.25, 7.5), random.range(0.25, 3.5)];
        let distance = random.range(0.5, 9.0);
        let corners = [0; 3].map(|_| {
            let place = middle.map(|middle| middle + random.range(-1e-4, 1e-4));
            seen_at(place, distance, SIZE[1])
        });
        specks.add(0, corners);
    }
    specks.triangles.append(&mut stage.triangles);
    stage.triangles = std::mem::take(&mut specks.triangles);
    stage
}

fn stages() -> [(&'static str, Stage); 3] {
    [("opaque", soup(7, 300, true, [-1.0, 5.0])), ("mask", checker()), ("blend", panes())]
}

fn assert_same(found: &[[f32; 4]], expected: &[[f32; 4]], what: &str) {
    let pairs = found.iter().zip(expected);
    let differ = pairs.filter(|(found, expected)| found != expected).count();
    assert_eq!(differ, 0, "{what}: so many colours differ");
    assert_eq!(found.len(), expected.len(), "{what}");
}

/// Samples in tiles without a list see the same as those in tiles with a list, to the bit.
#[test]
fn tiles_see_the_same_without_a_list() {
    let test = |gpu: &mut Headless, small: &mut Headless| {
        for (name, stage) in stages() {
            let dense = with_specks(stage.clone());
            for (shading, samples) in [(Shading::Triangle, 16), (Shading::Sample, 64), (Shading::Part, 100)] {
                let settings =
                    everywhere(SIZE, Pattern::Sobol, samples).map_superpixels(|options| options.shading(shading));
                let what = format!("{name}, {samples} samples");
                let listed = dense.render(gpu, &settings);
                let found = dense.render(small, &settings);
                let unlisted = |image: &Rendered| image.statistics.unlisted_tiles;
                assert_eq!((unlisted(&listed), unlisted(&found)), (0, 1), "{what}");
                assert_same(&found.colors, &listed.colors, &what);
            }
        }
    };
    on_gpu(|gpu| within(few_texel_elements, |small| test(gpu, small)));
}

/// Locations in tiles without a list see the same as those in tiles with a list.
#[test]
fn locations_see_the_same_in_dense_tiles() {
    let test = |gpu: &mut Headless, small: &mut Headless| {
        let (pinhole, locations) = (pinhole(SIZE), planar(SIZE));
        for (name, stage) in stages() {
            let dense = with_specks(stage.clone());
            let settings = everywhere(SIZE, Pattern::Sobol, 80);
            let [listed, found] = [&mut *gpu, &mut *small].map(|gpu| {
                let prepared = dense.upload(gpu);
                let cells = gpu.sample_superpixels(&prepared, &pinhole, &locations, &cells(&settings), &settings.scene);
                let points = gpu.sample_points(&prepared, &pinhole, &locations, &once_each());
                (cells.unwrap(), points.unwrap().values)
            });
            let unlisted = [&listed, &found].map(|seen| seen.0.statistics.unlisted_tiles);
            assert_eq!(unlisted, [0, 1], "{name}");
            assert_same(&found.0.values, &listed.0.values, name);
            let colors = [&found.1, &listed.1].map(|points| points.iter().map(|point| point.color).collect::<Vec<_>>());
            assert_same(&colors[0], &colors[1], name);
        }
    };
    on_gpu(|gpu| within(few_texel_elements, |small| test(gpu, small)));
}

/// Panes before each other are composited in order, however many there are and in whatever order they are drawn.
#[test]
fn layers_may_be_any_number() {
    on_gpu(|gpu| {
        const PANES: usize = 600;
        const ALPHA: f32 = 1.0 / 64.0;
        const SMALL: [u32; 2] = [8, 4];
        let colors = |pane: usize| [pane % 2, pane / 2 % 2, pane % 3 % 2].map(|bit| bit as f32);
        let mut random = Random::new(4);
        let mut order: Vec<usize> = (0..PANES).collect();
        for last in (1..PANES).rev() {
            order.swap(last, random.below(last as u64 + 1) as usize);
        }
        let materials = (0..PANES).map(|pane| {
            let [r, g, b] = colors(pane);
            flat([r, g, b, ALPHA], AlphaMode::Blend)
        });
        let mut stage = Stage::new(materials.collect());
        for pane in order {
            let distance = 1.0 + pane as f64 / 64.0;
            let corners = [[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]];
            stage.add_quad(pane, corners.map(|at| seen_at(at, distance, SMALL[1])));
        }
        let mut expected = [0.0_f64; 4];
        for pane in (0..PANES).rev() {
            let [r, g, b] = colors(pane).map(f64::from);
            let alpha = f64::from(ALPHA);
            for (channel, own) in expected.iter_mut().zip([r, g, b, 1.0]) {
                *channel = alpha * own + (1.0 - alpha) * *channel;
            }
        }
        for samples in [1, 16] {
            let settings = everywhere(SMALL, Pattern::Sobol, samples);
            let image = stage.render(gpu, &settings);
            for (pixel, color) in image.colors.iter().enumerate() {
                let apart = (0..4).map(|i| (f64::from(color[i]) - expected[i]).abs());
                let most = apart.fold(0.0, f64::max);
                assert!(most < 1e-4, "{samples} samples, pixel {pixel}: {color:?}, not {expected:?}");
            }
        }
    });
}
