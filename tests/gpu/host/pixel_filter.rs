//! Pixel filters of a host's frames.

use super::behind::{backdrop, drawn_before};
use super::farthest;
use super::machine::{AROUND, Base, Machine};
use super::mask;
use super::world::{Drawn, PLACED, SIZE, SKY, Way, World};
use crate::difference::rmse;
use crate::stage::{ids, on_gpu, once};
use gpc::host::Options;
use gpc::render::{CellOptions, Detection, Shading, SuperpixelOptions};
use gpc::sampling::{FilterShape, PixelFilter};
use gpc::scene::Sampler;
use twins::pixel_filter::filtered;

const SHAPES: [FilterShape; 2] = [FilterShape::BlackmanHarris, FilterShape::Mitchell];

/// A filtered frame shows what the same scene of a file does, whoever draws IDs.
#[test]
fn frames_are_filtered_as_those_of_files() {
    on_gpu(|gpu| {
        let sampler = Sampler::default();
        let (stage, world) = (mask::stage(sampler), mask::world(&sampler));
        let machine = Machine::new(gpu, &world);
        let lent = world.lent(&PLACED);
        for detection in [Detection::Contrast, Detection::Every] {
            // The place of a part is rounded, so that places computed in two ways may differ by a step.
            let shading = Shading::Triangle;
            let superpixels =
                SuperpixelOptions::new(CellOptions::DEFAULT_SAMPLES).shading(shading).detection(detection).thin(false);
            let plain = once(SIZE).method(superpixels);
            let unfiltered = stage.render(gpu, &plain);
            let own =
                Drawn { ids: ids(&unfiltered), depths: vec![0.0; (SIZE[0] * SIZE[1]) as usize], colors: Vec::new() };
            for filter in [PixelFilter::BOX, SHAPES[0].into(), SHAPES[1].into()] {
                let expected = stage.render(gpu, &plain.clone().pixel_filter(filter));
                for base in [Base::Nothing, Base::Ids(&own)] {
                    let options = Options::new(SIZE[0], SIZE[1])
                        .thin(false)
                        .shading(shading)
                        .detection(detection)
                        .pixel_filter(filter);
                    let found = machine.see_lent(&PLACED, &lent, base, options);
                    assert_eq!(found.outcome.left_over, 0);
                    assert_eq!(found.outcome.statistics.superpixels, expected.statistics.superpixels);
                    let worst = farthest(&found.colors, &expected.colors);
                    assert!(worst < 2e-6, "{}, {detection:?}: {worst}", filter.shape);
                    let moved = farthest(&expected.colors, &unfiltered.colors);
                    assert!(filter.is_box() || moved > 0.05, "{}, {detection:?}: {moved}", filter.shape);
                }
            }
        }
    });
}

/// Superpixels that see what the host has drawn, and the host's own pixels, are filtered as the twin does.
#[test]
fn what_the_host_has_drawn_is_filtered_as_the_twin_does() {
    on_gpu(|gpu| {
        let world = World::new();
        let (machine, drawn) = (Machine::new(gpu, &world), drawn_before(&world));
        let lent = world.lent(&PLACED);
        let surfaces = world.surfaces();
        let light = |at| {
            let color = surfaces.at(at).map_or_else(|| backdrop(at), |(.., [r, g, b])| [r, g, b, 1.0]);
            color.map(f64::from)
        };
        let see = |filter: PixelFilter, detection| {
            let options = Options::new(SIZE[0], SIZE[1]).detection(detection).pixel_filter(filter);
            let seen = machine.see_lent(&PLACED, &lent, Base::All(&drawn), options);
            assert_eq!(seen.outcome.left_over, 0);
            seen.colors
        };
        for shape in SHAPES {
            let filter = PixelFilter::from(shape);
            let expected = filtered(SIZE, (shape, filter.radius), 16, light);
            let expected: Vec<_> = expected.into_iter().map(|color| color.map(|channel| channel as f32)).collect();
            for detection in [Detection::Contrast, Detection::Every] {
                let found = rmse(&see(filter, detection), &expected);
                let unfiltered = rmse(&see(PixelFilter::BOX, detection), &expected);
                println!("{shape}, {detection:?}: {found}, without a filter {unfiltered}");
                assert!(4.0 * found < unfiltered, "{shape}, {detection:?}: {found} of {unfiltered}");
            }
        }
    });
}

/// Parts of an image are filtered as a whole image, whether it is read or copied, and what is around them stays.
#[test]
fn what_is_around_the_part_is_neither_read_nor_written() {
    on_gpu(|gpu| {
        let world = World::new();
        let (machine, drawn) = (Machine::new(gpu, &world), drawn_before(&world));
        let see = |way: &Way| {
            let options = Options::new(SIZE[0], SIZE[1]).pixel_filter(FilterShape::Mitchell.into());
            machine.see_lent(way, &world.lent(way), Base::All(&drawn), options).colors
        };
        let whole = see(&PLACED);
        for copied in [false, true] {
            let way = Way { corner: [13, 5], copied, ..PLACED };
            let framed = way.framed(&whole, SIZE, AROUND);
            assert!(see(&way) == framed, "copied: {copied}");
        }
    });
}

/// Hosts may keep anything in alpha: the light is the same.
#[test]
fn alpha_does_not_change_the_light() {
    on_gpu(|gpu| {
        let world = World::new();
        let machine = Machine::new(gpu, &world);
        let lent = world.lent(&PLACED);
        let opaque = world.drawn();
        let mut drawn = world.drawn();
        for (number, color) in drawn.colors.iter_mut().enumerate() {
            color[3] = if number < drawn.ids.len() / 2 { 0.0 } else { (number % 7) as f32 / 8.0 };
        }
        for shape in SHAPES {
            let see = |drawn: &Drawn, keep_alpha| {
                let options = Options::new(SIZE[0], SIZE[1])
                    .flat_background(true)
                    .detection(Detection::Exact)
                    .keep_alpha(keep_alpha)
                    .pixel_filter(shape.into());
                machine.see_lent(&PLACED, &lent, Base::All(drawn), options).colors
            };
            let expected = see(&opaque, false);
            assert!(expected.iter().all(|color| (color[3] - 1.0).abs() < 1e-6));
            for keep_alpha in [false, true] {
                let found = see(&drawn, keep_alpha);
                for ((found, expected), before) in found.iter().zip(&expected).zip(&drawn.colors) {
                    assert_eq!(found[..3], expected[..3], "{shape}");
                    assert!((0.0..=1.0).contains(&found[3]), "{shape}: {found:?}");
                    assert!(!keep_alpha || found[3] == before[3], "{shape}: {found:?}, {before:?}");
                }
            }
            let is_sky = |color: &&[f32; 4]| (0..3).all(|channel| (color[channel] - SKY[channel]).abs() < 1e-6);
            let sky = expected.iter().filter(is_sky).count();
            assert!(sky > 100, "{sky} pixels of sky");
        }
    });
}
