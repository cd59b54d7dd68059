//! Detection, compared with its definition pixel by pixel.

use twins::detect::{DetectionImage, Mode, PlaneError, superpixels};

use super::meshes::Random;

/// A small image with few surfaces and similar colours.
struct Image {
    width: u32,
    height: u32,
    ids: Vec<u32>,
    blend_ids: Vec<u32>,
    colours: Vec<u32>,
}

impl Image {
    fn random(random: &mut Random, width: u32, height: u32) -> Self {
        let mut plane = |value: &dyn Fn(&mut Random) -> u32| (0..width * height).map(|_| value(random)).collect();
        // Most values are equal, so that all outcomes of each comparison occur.
        Self {
            ids: plane(&|r| (r.below(5) == 0).into()),
            blend_ids: plane(&|r| if r.below(9) == 0 { 3 } else { 0 }),
            colours: plane(&|r| {
                0x8080_8080 + if r.below(4) == 0 { (r.below(25) as u32) << (8 * r.below(4)) } else { 0 }
            }),
            width,
            height,
        }
    }

    fn frame(&self) -> DetectionImage<'_> {
        DetectionImage::new(self.width, self.height, &self.ids, &self.blend_ids, &self.colours).unwrap()
    }

    /// Whether a pixel is a superpixel by definition.
    fn is_superpixel(&self, x: i64, y: i64, mode: Mode) -> bool {
        if let Mode::SecondDifferences(threshold) = mode {
            return self.is_superpixel(x, y, Mode::Contrast(threshold)) || self.bends(x, y, threshold);
        }
        let at = |x: i64, y: i64| (y * i64::from(self.width) + x) as usize;
        let inside =
            |x: i64, y: i64| (0..i64::from(self.width)).contains(&x) && (0..i64::from(self.height)).contains(&y);
        let here = at(x, y);
        (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (x + dx, y + dy))).any(|(nx, ny)| {
            if (nx, ny) == (x, y) || !inside(nx, ny) {
                return false;
            }
            let there = at(nx, ny);
            let other = self.ids[here] != self.ids[there] || self.blend_ids[here] != self.blend_ids[there];
            let largest = (0..4)
                .map(|channel| {
                    let code = |pixel: usize| i64::from(self.colours[pixel] >> (8 * channel) & 255);
                    (code(here) - code(there)).abs()
                })
                .max()
                .unwrap();
            match mode {
                Mode::Contrast(threshold) => largest > i64::from(threshold),
                Mode::Edges(threshold) => other && largest > i64::from(threshold),
                Mode::Exact => other,
                Mode::SecondDifferences(_) => unreachable!("see above"),
            }
        })
    }

    /// Whether three pixels in a line, among the 9 around a pixel, have a second difference above the threshold.
    fn bends(&self, x: i64, y: i64, threshold: u8) -> bool {
        let (right, bottom) = (i64::from(self.width) - 1, i64::from(self.height) - 1);
        let code = |x: i64, y: i64, channel: u32| {
            let pixel = y.clamp(0, bottom) * i64::from(self.width) + x.clamp(0, right);
            i64::from(self.colours[pixel as usize] >> (8 * channel) & 255)
        };
        // Every line has its middle in the 9 pixels, and its ends beside the middle on both sides.
        let steps = [(1, 0), (0, 1), (1, 1), (1, -1)];
        let middles = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)));
        let lines = middles.flat_map(|middle| steps.map(|step| (middle, step)));
        let mut within = lines.filter(|((mx, my), (dx, dy))| {
            [mx - dx, my - dy, mx + dx, my + dy].iter().all(|place: &i64| place.abs() <= 1)
        });
        within.any(|((mx, my), (dx, dy))| {
            (0..4).any(|channel| {
                let at = |side: i64| code(x + mx + side * dx, y + my + side * dy, channel);
                (at(-1) - 2 * at(0) + at(1)).abs() > i64::from(threshold)
            })
        })
    }
}

#[test]
fn mask_is_the_definition() {
    let mut random = Random::new(4);
    let modes = [
        Mode::Contrast(0),
        Mode::Contrast(12),
        Mode::Contrast(255),
        Mode::Exact,
        Mode::Edges(12),
        Mode::SecondDifferences(12),
    ];
    let mut found = [[0_u32; 2]; 6];
    for (width, height) in [(1, 1), (1, 9), (9, 1), (8, 4), (16, 8), (7, 3), (9, 5), (33, 21)] {
        for _ in 0..20 {
            let image = Image::random(&mut random, width, height);
            for (mode, found) in modes.into_iter().zip(&mut found) {
                let mask = superpixels(&image.frame(), mode);
                let tiles_x = width.div_ceil(8);
                assert_eq!(mask.len() as u32, tiles_x * height.div_ceil(4));
                for (tile, word) in mask.into_iter().enumerate() {
                    for bit in 0..32 {
                        let x = tile as u32 % tiles_x * 8 + bit % 8;
                        let y = tile as u32 / tiles_x * 4 + bit / 8;
                        let expected = x < width && y < height && image.is_superpixel(x.into(), y.into(), mode);
                        assert_eq!(word >> bit & 1 == 1, expected, "{width} x {height}, ({x}, {y}), {mode:?}");
                        found[usize::from(expected)] += 1;
                    }
                }
            }
        }
    }
    // Each mode has found superpixels and other pixels, except for a threshold that no contrast exceeds.
    for (mode, [no, yes]) in modes.into_iter().zip(found) {
        assert!(no > 0, "{mode:?}");
        assert_eq!(yes > 0, mode != Mode::Contrast(255), "{mode:?}");
    }
}

#[test]
fn threshold_must_be_exceeded() {
    let (ids, colours) = ([1, 2], [0x1000_0000, 0x1C00_0000]);
    let frame = DetectionImage::new(2, 1, &ids, &[0, 0], &colours).unwrap();
    assert_eq!(superpixels(&frame, Mode::Contrast(12)), [0]);
    assert_eq!(superpixels(&frame, Mode::Contrast(11)), [3]);
}

#[test]
fn one_surface_contrasts_with_itself_unless_edges_are_asked_for() {
    let mask = |ids: [u32; 2], mode| {
        let colours = [0xFF00_0000, 0xFF00_0020];
        let frame = DetectionImage::new(2, 1, &ids, &[0, 0], &colours).unwrap();
        superpixels(&frame, mode)
    };
    assert_eq!(mask([1, 1], Mode::Contrast(12)), [3]);
    assert_eq!(mask([1, 1], Mode::Contrast(32)), [0]);
    assert_eq!(mask([1, 1], Mode::Edges(12)), [0]);
    assert_eq!(mask([1, 2], Mode::Edges(12)), [3]);
    assert_eq!(mask([1, 1], Mode::Exact), [0]);
}

/// A gradient rises by one code every other pixel. A texture alternates between two codes at the end of the row.
#[test]
fn textures_bend_and_gradients_do_not() {
    let codes = [10, 10, 11, 11, 12, 12, 13, 13, 14, 13, 14, 13];
    let (ids, blend_ids) = ([1; 12], [0; 12]);
    let colours = codes.map(|code| 0xFF00_0000 | (code * 0x01_0101));
    let frame = DetectionImage::new(12, 1, &ids, &blend_ids, &colours).unwrap();
    assert_eq!(superpixels(&frame, Mode::Contrast(1)), [0, 0]);
    assert_eq!(superpixels(&frame, Mode::SecondDifferences(2)), [0, 0]);
    // The pixels 8 to 10 are the middles of lines that bend.
    assert_eq!(superpixels(&frame, Mode::SecondDifferences(1)), [0, 0b111]);
}

#[test]
fn planes_of_another_size_are_refused() {
    let error = DetectionImage::new(2, 2, &[0; 4], &[0; 3], &[0; 4]).unwrap_err();
    let expected = PlaneError { plane: "blend IDs", width: 2, height: 2, found: 3 };
    assert_eq!(error, expected);
    assert!(DetectionImage::new(u32::MAX, u32::MAX, &[], &[], &[]).is_err());
    assert!(superpixels(&DetectionImage::new(0, 5, &[], &[], &[]).unwrap(), Mode::Exact).is_empty());
}
