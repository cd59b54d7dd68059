//! Growth of superpixels, compared with the CPU's.

use gpc::render::{Detection, Rendered, Settings, SuperpixelOptions};
use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;
use twins::detect::{DetectionImage, Mode, superpixels};
use twins::grow::grown;

use crate::detect::{CONTRAST, codes, mosaic, near, pixels};
use crate::locations::{pinhole, planar};
use crate::stage::{Stage, flat, ids, on_gpu, once, seen_at};

const SIZE: [u32; 2] = [61, 43];

/// Compares the superpixels of a mosaic with the twin's, with numbers of samples that let them grow once and four times.
/// Pixels beside one whose code rounding may change are excused; there are few of them.
fn check_growths(mut render: impl FnMut(&Settings) -> Rendered) {
    let base = render(&once(SIZE));
    let (seen, _) = codes(&base);
    let ids = ids(&base);
    let blend = vec![0; ids.len()];
    let frame = DetectionImage::new(SIZE[0], SIZE[1], &ids, &blend, &seen).unwrap();
    // The last number is a bound on how many superpixels grow.
    for (samples, growths, mode, fewest) in
        [(4, 1, Mode::Contrast(CONTRAST), 30), (144, 4, Mode::SecondDifferences(CONTRAST), 10)]
    {
        let rendered = render(&once(SIZE).method(SuperpixelOptions::new(samples).contrast(Some(CONTRAST)).thin(false)));
        let (resolved, doubtful) = codes(&rendered);
        let mut expected = superpixels(&frame, mode);
        let first = pixels(SIZE, &expected);
        for _ in 0..growths {
            let grown = grown(SIZE[0], &seen, &resolved, &expected, CONTRAST);
            for (word, grown) in expected.iter_mut().zip(grown) {
                *word |= grown;
            }
        }
        let expected = pixels(SIZE, &expected);
        let count = |mask: &[bool]| mask.iter().filter(|&&superpixel| superpixel).count();
        let counts = [count(&first), count(&expected)];
        assert!(counts[1] > counts[0] + fewest, "{samples} samples: {counts:?}");
        assert!(count(&expected) < expected.len(), "{samples} samples");
        let mut excused = 0;
        for (pixel, attributes) in rendered.attributes.iter().enumerate() {
            let same = (attributes.superpixel == 1) == expected[pixel];
            assert!(same || near(&doubtful, SIZE, pixel), "{samples} samples, pixel {pixel}");
            excused += u32::from(!same);
        }
        assert!(excused <= 4, "{samples} samples: {excused} pixels differ");
    }
}

#[test]
fn growths_are_the_twins() {
    on_gpu(|gpu| {
        let stage = mosaic(7, SIZE);
        check_growths(|settings| stage.render(gpu, settings));
    });
}

#[test]
fn growths_of_locations_are_the_twins() {
    on_gpu(|gpu| {
        let prepared = mosaic(7, SIZE).upload(gpu);
        let rig = [(pinhole(SIZE), planar(SIZE))];
        check_growths(|settings| gpu.render_locations(&prepared, &rig, settings).unwrap());
    });
}

/// Growth crosses the borders of the bands in which an output's cells are searched when memory is limited.
#[test]
fn growths_of_locations_do_not_depend_on_memory() {
    on_gpu(|gpu| {
        let size = [64, 512];
        let prepared = mosaic(11, size).upload(gpu);
        let rig = [(pinhole(size), planar(size))];
        let mut render = |max_memory| {
            let settings = once(size).max_memory(max_memory).method(
                SuperpixelOptions::new(144)
                    // On lines, rounding may move a few of 1,024 samples: docs/limits.md.
                    .pattern(Pattern::Sobol)
                    .contrast(Some(CONTRAST))
                    .thin(false),
            );
            gpu.render_locations(&prepared, &rig, &settings)
        };
        let whole = render(None).unwrap();
        // A single band for all cells would take more than a quarter of either limit.
        for bound in [10 << 20, 8 << 20] {
            let parts = render(Some(bound)).unwrap();
            assert!(parts.attributes == whole.attributes, "{bound} bytes");
            assert_eq!(parts.statistics.superpixels, whole.statistics.superpixels);
            let pairs = parts.colors.iter().flatten().zip(whole.colors.iter().flatten());
            let farthest = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(farthest < 1e-5, "{bound} bytes: colours differ by {farthest}");
        }
    });
}

/// The tips of wedges are narrower than a pixel and cover no centre, but show in the superpixels beside them.
/// Superpixels grow four times here.
#[test]
fn tips_that_no_centre_saw_are_found() {
    on_gpu(|gpu| {
        let size = [64, 64];
        let mut stage =
            Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque), flat([0.0, 0.0, 0.0, 1.0], AlphaMode::Opaque)]);
        let wall = [[-90.0, -90.0], [-90.0, 90.0], [90.0, 90.0], [90.0, -90.0]];
        stage.add_quad(1, wall.map(|place| seen_at(place, 5.0, size[1])));
        for wedge in 0..12 {
            let y = f64::from(wedge) * 5.03 - 28.4;
            let corners = [[-20.3, y - 1.2], [-20.3, y + 1.2], [-9.0, y + 0.17]];
            stage.add(0, corners.map(|place| seen_at(place, 2.0, size[1])));
        }
        let mut energy = |detection| {
            let settings = once(size).method(SuperpixelOptions::new(144).thin(false).detection(detection));
            let rendered = stage.render(gpu, &settings);
            rendered.colors.iter().map(|c| f64::from(c[0])).sum::<f64>()
        };
        let all = energy(Detection::Every);
        let edges = (energy(Detection::Edges) - all).abs();
        let grown = (energy(Detection::Contrast) - all).abs();
        assert!(edges > 0.002 * all, "{edges} of {all}");
        assert!(3.0 * grown < edges, "{grown}, {edges} without growth");
    });
}
