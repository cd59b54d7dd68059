//! Superpixels that grow beside others, against the CPU's.

use gpc::reference::detect::{Frame, Mode, superpixels};
use gpc::reference::grow::grown;
use gpc::render::{Detection, Method, Settings};
use gpc::scene::AlphaMode;

use crate::detect::{CONTRAST, codes, mosaic, near, pixels};
use crate::stage::{Stage, flat, ids, on_gpu, once, seen_at};

/// With as many samples as let superpixels grow once and twice. Pixels beside one whose code rounding may change are excused,
/// and are few.
#[test]
fn growths_are_the_twins() {
    on_gpu(|gpu| {
        let size = [61, 43];
        let stage = mosaic(7, size);
        let base = stage.render(gpu, &once(size));
        let (seen, _) = codes(&base);
        let ids = ids(&base);
        let blend = vec![0; ids.len()];
        let frame = Frame::new(size[0], size[1], &ids, &blend, &seen).unwrap();
        for (samples, growths) in [(4, 1), (144, 2)] {
            let rendered = stage.render(
                gpu,
                &Settings {
                    method: Method::Superpixel,
                    samples,
                    contrast: Some(CONTRAST),
                    ..once(size)
                },
            );
            let (resolved, doubtful) = codes(&rendered);
            let mut expected = superpixels(&frame, Mode::Contrast(CONTRAST));
            let first = pixels(size, &expected);
            for _ in 0..growths {
                let grown = grown(size[0], &seen, &resolved, &expected, CONTRAST);
                for (word, grown) in expected.iter_mut().zip(grown) {
                    *word |= grown;
                }
            }
            let expected = pixels(size, &expected);
            let count = |mask: &[bool]| mask.iter().filter(|&&superpixel| superpixel).count();
            assert!(count(&expected) > count(&first) + 30, "{samples} samples");
            assert!(count(&expected) < expected.len(), "{samples} samples");
            let mut excused = 0;
            for (pixel, attributes) in rendered.attributes.iter().enumerate() {
                let same = (attributes.superpixel == 1) == expected[pixel];
                assert!(
                    same || near(&doubtful, size, pixel),
                    "{samples} samples, pixel {pixel}"
                );
                excused += u32::from(!same);
            }
            assert!(excused <= 4, "{samples} samples: {excused} pixels differ");
        }
    });
}

/// The tips of wedges, narrower than a pixel, which no centre sees but superpixels beside them do. With as many samples as
/// let superpixels grow twice.
#[test]
fn tips_that_no_centre_saw_are_found() {
    on_gpu(|gpu| {
        let size = [64, 64];
        let mut stage = Stage::new(vec![
            flat([1.0; 4], AlphaMode::Opaque),
            flat([0.0, 0.0, 0.0, 1.0], AlphaMode::Opaque),
        ]);
        let wall = [[-90.0, -90.0], [-90.0, 90.0], [90.0, 90.0], [90.0, -90.0]];
        stage.add_quad(1, wall.map(|place| seen_at(place, 5.0, size[1])));
        for wedge in 0..12 {
            let y = f64::from(wedge) * 5.03 - 28.4;
            let corners = [[-20.3, y - 1.2], [-20.3, y + 1.2], [-9.0, y + 0.17]];
            stage.add(0, corners.map(|place| seen_at(place, 2.0, size[1])));
        }
        let mut energy = |detection| {
            let settings = Settings {
                method: Method::Superpixel,
                samples: 144,
                thin: false,
                detection,
                ..once(size)
            };
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
