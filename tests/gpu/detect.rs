//! Detection on the device, compared with the CPU's pixel by pixel.

use glam::DVec3;
use gpc::color::srgb::{decode_u8, encode};
use gpc::render::{
    CellOptions, Detection, Footprint, Headless, MethodKind, Reference, Rendered, Settings, Shading, SuperpixelOptions,
};
use gpc::scene::{AlphaMode, Filter, Image, Sampler};
use twins::detect::{DetectionImage, Mode, superpixels};
use twins::thin::{FOLD, cosine};

use crate::meshes::{Depths, Random, delaunay};
use crate::stage::{Stage, flat, ids, on_gpu, once, seen_at, textured};

const SIZES: [[u32; 2]; 3] = [[64, 64], [37, 23], [8, 4]];
pub const CONTRAST: u8 = 12;

/// A tiling with holes, whose colours differ by about the threshold.
pub fn mosaic(seed: u64, size: [u32; 2]) -> Stage {
    let mut random = Random::new(seed);
    let mesh = delaunay(seed, f64::from(size[0]) / 2.0, 20, Depths::Random);
    let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
    stage.add_mesh(0, &mesh, size[1], |triangle| triangle);
    stage.triangles.retain(|_| random.below(12) != 0);
    for triangle in &mut stage.triangles {
        let mut channel = || {
            let code = [100, 100, 111, 112, 113, 124][random.below(6) as usize];
            decode_u8(code) as f32
        };
        triangle.color = [channel(), channel(), channel(), 1.0];
    }
    stage
}

/// Superpixels that the device finds, including those that grow.
fn found(gpu: &mut Headless, stage: &Stage, settings: &Settings, detection: Detection) -> Vec<bool> {
    let settings =
        settings.clone().method(SuperpixelOptions::new(4).thin(false).contrast(Some(CONTRAST)).detection(detection));
    let rendered = stage.render(gpu, &settings);
    let marked: Vec<bool> = rendered.attributes.iter().map(|p| p.superpixel == 1).collect();
    let count = marked.iter().filter(|&&m| m).count() as u64;
    assert_eq!(rendered.statistics.superpixels, count);
    for (pixel, &marked) in rendered.attributes.iter().zip(&marked) {
        assert_eq!(pixel.samples, if marked { 4 } else { 1 });
    }
    marked
}

/// Code values of a linear image, red in the lowest byte, and whether each pixel is too close to a rounding boundary
/// to be certain.
pub fn codes(rendered: &Rendered) -> (Vec<u32>, Vec<bool>) {
    let each = rendered.colors.iter().map(|&[r, g, b, a]| {
        let exact = [r, g, b].map(|v| 255.0 * encode(f64::from(v)));
        let exact = [exact[0], exact[1], exact[2], 255.0 * f64::from(a)];
        let doubtful = exact.iter().any(|v| (v - v.floor() - 0.5).abs() < 0.01);
        (u32::from_le_bytes(exact.map(|v| v.round() as u8)), doubtful)
    });
    each.unzip()
}

/// Superpixels that the CPU finds, without growth.
fn expected(size: [u32; 2], ids: &[u32], blend: &[u32], codes: &[u32], mode: Mode) -> Vec<bool> {
    let [width, height] = size;
    let frame = DetectionImage::new(width, height, ids, blend, codes).unwrap();
    pixels(size, &superpixels(&frame, mode))
}

/// Mask of tiles as a value for each pixel.
pub fn pixels(size: [u32; 2], mask: &[u32]) -> Vec<bool> {
    let [width, height] = size;
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    pixels
        .map(|(x, y)| {
            let word = mask[(y / 4 * width.div_ceil(8) + x / 8) as usize];
            word >> (y % 4 * 8 + x % 8) & 1 == 1
        })
        .collect()
}

/// Whether a pixel or one of its neighbours is marked.
pub fn near(marks: &[bool], size: [u32; 2], pixel: usize) -> bool {
    let [width, height] = size.map(|side| side as usize);
    let (x, y) = (pixel % width, pixel / width);
    (y.saturating_sub(1)..(y + 2).min(height))
        .any(|y| (x.saturating_sub(1)..(x + 2).min(width)).any(|x| marks[y * width + x]))
}

/// Whether the device may have found a superpixel that the CPU did not, because it grew.
fn may_grow(found: bool, expected: &[bool], size: [u32; 2], pixel: usize, mode: Mode) -> bool {
    found && matches!(mode, Mode::Contrast(_)) && near(expected, size, pixel)
}

const MODES: [(Detection, Mode); 3] = [
    (Detection::Edges, Mode::Edges(CONTRAST)),
    (Detection::Exact, Mode::Exact),
    (Detection::Contrast, Mode::Contrast(CONTRAST)),
];

/// Every colour is exactly a code value, so that nothing is rounded and the masks are identical.
#[test]
fn masks_of_whole_codes_are_the_twins() {
    on_gpu(|gpu| {
        for (seed, size) in SIZES.into_iter().enumerate() {
            let stage = mosaic(seed as u64, size);
            let base = stage.render(gpu, &once(size));
            let (codes, doubtful) = codes(&base);
            assert!(!doubtful.contains(&true));
            let ids = ids(&base);
            let blend = vec![0; ids.len()];
            let mut sums = Vec::new();
            for (detection, mode) in MODES {
                let found = found(gpu, &stage, &once(size), detection);
                let expected = expected(size, &ids, &blend, &codes, mode);
                for (pixel, &found) in found.iter().enumerate() {
                    assert!(
                        found == expected[pixel] || may_grow(found, &expected, size, pixel, mode),
                        "{detection:?}, {size:?}, pixel {pixel}"
                    );
                }
                sums.push(found.iter().filter(|&&marked| marked).count());
            }
            if size == SIZES[0] {
                let all = base.colors.len();
                assert!(0 < sums[0] && sums[0] < sums[1] && sums[1] < all, "{sums:?}");
            }
        }
    });
}

/// Scenes with tone mapping, BLEND panes and colours between two codes. Pixels beside one that rounding may change are
/// excused; there are few of them.
#[test]
fn masks_of_blended_scenes_are_the_twins() {
    on_gpu(|gpu| {
        let size = [64, 64];
        let mut random = Random::new(5);
        let mut stage = mosaic(9, size);
        stage.materials.push(flat([0.9, 0.5, 0.4, 0.25], AlphaMode::Blend));
        let opaque = stage.triangles.len() as u32;
        for _ in 0..12 {
            let mut corner = || {
                let place = [0; 2].map(|_| random.range(-32.0, 32.0));
                seen_at(place, random.range(0.05, 0.3), size[1])
            };
            let corners = [corner(), corner(), corner()];
            stage.add(1, corners);
        }
        let settings = once(size).reference(Reference::Display);
        let base = stage.render(gpu, &settings);
        let (codes, doubtful) = codes(&base);
        // With BLEND made opaque, the device shows the nearest of these triangles.
        let mut solid = stage.clone();
        solid.materials[1].alpha_mode = AlphaMode::Opaque;
        let nearest = ids(&solid.render(gpu, &settings)).into_iter();
        let blend: Vec<u32> = nearest.map(|id| if id > opaque { id } else { 0 }).collect();
        assert!(blend.iter().filter(|&&id| id != 0).count() > 500);
        for (detection, mode) in MODES {
            let found = found(gpu, &stage, &settings, detection);
            let expected = expected(size, &ids(&base), &blend, &codes, mode);
            let mut excused = 0;
            for pixel in 0..found.len() {
                let same = found[pixel] == expected[pixel] || may_grow(found[pixel], &expected, size, pixel, mode);
                let excuse = detection != Detection::Exact && near(&doubtful, size, pixel);
                assert!(same || excuse, "{detection:?}, pixel {pixel}: {}", found[pixel]);
                excused += u32::from(!same);
            }
            assert!(excused <= 4, "{detection:?}: {excused} pixels differ");
        }
    });
}

/// Squares as large as pixels, whose colours or alphas differ at random.
fn squares(seed: u64, size: [u32; 2], alpha_mode: AlphaMode) -> Stage {
    let mut random = Random::new(seed);
    let mut stage = Stage::new(vec![flat([1.0; 4], alpha_mode)]);
    let half = size.map(|side| f64::from(side) / 2.0);
    for (x, y) in (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))) {
        let [left, top] = [f64::from(x) - half[0], f64::from(y) - half[1]];
        let corners = [[-0.1, -0.3], [-0.1, 0.7], [0.9, 0.7], [0.9, -0.3]];
        let place = |[right, down]: [f64; 2]| seen_at([left + right, top + down], 1.0, size[1]);
        let first = stage.triangles.len();
        stage.add_quad(0, corners.map(place));
        let mut code = || 100 + (random.below(20) == 0) as u8 * random.below(10) as u8;
        let color = if alpha_mode == AlphaMode::Blend {
            [0.0, 0.0, 0.0, f32::from(code()) / 255.0]
        } else {
            let [r, g, b] = [code(), code(), code()].map(|code| decode_u8(code) as f32);
            [r, g, b, 1.0]
        };
        for triangle in &mut stage.triangles[first..] {
            triangle.color = color;
        }
    }
    stage
}

/// From 128 samples on, second differences count as well, but not with detection of edges.
#[test]
fn masks_of_second_differences_are_the_twins() {
    on_gpu(|gpu| {
        for (seed, size) in SIZES.into_iter().enumerate() {
            for alpha_mode in [AlphaMode::Opaque, AlphaMode::Blend] {
                let stage = squares(seed as u64, size, alpha_mode);
                let base = stage.render(gpu, &once(size));
                let (codes, doubtful) = codes(&base);
                assert!(!doubtful.contains(&true));
                let ids = ids(&base);
                let blend = vec![0; ids.len()];
                let mut render = |samples, detection| {
                    let options = SuperpixelOptions::new(samples)
                        .growths(Some(0))
                        .thin(false)
                        .contrast(Some(6))
                        .detection(detection);
                    stage.render(gpu, &once(size).method(options))
                };
                let mut sums = Vec::new();
                for (samples, mode) in [(127, Mode::Contrast(6)), (128, Mode::SecondDifferences(6))] {
                    let rendered = render(samples, Detection::Contrast);
                    let found = rendered.attributes.iter().map(|pixel| pixel.superpixel == 1);
                    assert!(found.eq(expected(size, &ids, &blend, &codes, mode)), "{size:?}, {alpha_mode:?}, {mode:?}");
                    sums.push(rendered.statistics.superpixels);
                }
                let edges = render(128, Detection::Edges).statistics.superpixels;
                assert!(edges <= sums[0], "{edges}, {sums:?}");
                assert!(size[0] < 37 || sums[0] < sums[1], "{sums:?}");
            }
        }
    });
}

/// Alpha alone distinguishes a black surface from a transparent background.
#[test]
fn black_contrasts_with_a_transparent_background() {
    on_gpu(|gpu| {
        let size = [32, 32];
        let mut stage = Stage::new(vec![flat([0.0, 0.0, 0.0, 1.0], AlphaMode::Opaque)]);
        let corners = [[-9.0, -7.0], [-8.0, 11.0], [12.0, 3.0]];
        stage.add(0, corners.map(|place| seen_at(place, 1.0, size[1])));
        let exact = found(gpu, &stage, &once(size), Detection::Exact);
        assert!(exact.contains(&true));
        let edges = found(gpu, &stage, &once(size), Detection::Edges);
        assert!(edges == exact);
        // Detection by contrast also finds superpixels that grew.
        let contrast = found(gpu, &stage, &once(size), Detection::Contrast);
        let mut pairs = contrast.iter().zip(&exact);
        assert!(pairs.all(|(&contrast, &exact)| contrast || !exact));
    });
}

/// Twelve wires a tenth of a pixel wide at `distance`, in front of a black wall.
pub fn wires(size: [u32; 2], distance: f64) -> Stage {
    let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque), flat([0.0, 0.0, 0.0, 1.0], AlphaMode::Opaque)]);
    let wall = [[-90.0, -90.0], [-90.0, 90.0], [90.0, 90.0], [90.0, -90.0]];
    stage.add_quad(1, wall.map(|place| seen_at(place, 5.0, size[1])));
    for wire in 0..12 {
        let y = f64::from(wire) * 5.0 - 28.0;
        let [rise, left, right] = [f64::from(wire) * 0.61 - 3.0, -43.7, 41.9];
        let corners = [[left, y], [left, y + 0.1], [right, y + rise + 0.1], [right, y + rise]];
        stage.add_quad(0, corners.map(|place| seen_at(place, distance, size[1])));
    }
    stage
}

/// Wires that cover few pixel centres keep their energy only if the pixels that they cross become superpixels.
#[test]
fn unseen_wires_make_superpixels() {
    on_gpu(|gpu| {
        let size = [96, 64];
        let stage = wires(size, 2.0);
        let mut energy = |detection, thin| {
            let settings =
                once(size).method(SuperpixelOptions::new(CellOptions::DEFAULT_SAMPLES).thin(thin).detection(detection));
            let rendered = stage.render(gpu, &settings);
            rendered.colors.iter().map(|c| f64::from(c[0])).sum::<f64>()
        };
        let all = energy(Detection::Every, false);
        assert!(all > 90.0, "{all}");
        let found = energy(Detection::Contrast, true);
        assert!((found / all - 1.0).abs() < 0.02, "{found} of {all}");
        let seen = energy(Detection::Contrast, false);
        assert!((seen / all - 1.0).abs() > 0.05, "{seen} of {all}");
    });
}

/// Specks that no centre sees stand on a wall, at random angles to it, in an image of `side` x `side` pixels. The wall
/// consists of triangles as small as pixels. For each pixel there is the cosine of the angle between speck and wall; 1
/// without a speck.
pub fn specks(side: u32) -> (Stage, Vec<f64>) {
    let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque), flat([0.0, 0.0, 0.0, 1.0], AlphaMode::Opaque)]);
    let mut random = Random::new(5);
    let half = f64::from(side) / 2.0;
    let place = |x: u32, y: u32| [x, y].map(|v| f64::from(v) - half);
    let position = |at: [f64; 2], distance: f64| seen_at(at, distance, side);
    let cells = (0..=side).flat_map(|y| (0..=side).map(move |x| (x, y)));
    let wall = |x: u32, y: u32| {
        let [x, y] = place(x, y);
        let corners = [[-0.1, -0.3], [-0.1, 0.7], [0.9, 0.7], [0.9, -0.3]];
        corners.map(|[right, down]| position([x + right, y + down], 5.0))
    };
    for (x, y) in cells {
        stage.add_quad(1, wall(x, y));
    }
    let mut cosines = vec![1.0; (side * side) as usize];
    for (x, y) in (2..side).step_by(3).flat_map(|y| (2..side).step_by(3).map(move |x| (x, y))) {
        let [left, top] = place(x, y);
        let lifts = [0, 1, 2].map(|_| random.below(1000) as f64 * 3e-4);
        let least = lifts.into_iter().fold(f64::INFINITY, f64::min);
        let corners = [[0.6, 0.6], [0.9, 0.65], [0.7, 0.9]];
        let corners = [0, 1, 2].map(|corner| {
            let [right, down] = corners[corner];
            position([left + right, top + down], 4.999 - lifts[corner] + least)
        });
        stage.add(0, corners);
        let exact = |corner: [f32; 3]| DVec3::from(corner.map(f64::from));
        let [a, b, c, _] = wall(x, y).map(exact);
        cosines[(y * side + x) as usize] = cosine(corners.map(exact), [a, b, c], DVec3::ZERO);
    }
    (stage, cosines)
}

/// Checks that the superpixels are the pixels whose speck and wall are a fold, and none below 128 samples. `render`
/// renders the specks in an image of `side` x `side` pixels.
pub fn check_folds(side: u32, cosines: &[f64], mut render: impl FnMut(&Settings) -> Rendered) {
    for samples in [64, 128] {
        let settings = once([side; 2]).method(SuperpixelOptions::new(samples).growths(Some(0)));
        let rendered = render(&settings);
        let mut folds = 0;
        for (pixel, (attributes, cosine)) in rendered.attributes.iter().zip(cosines).enumerate() {
            let fold = samples >= 128 && *cosine < FOLD;
            folds += u32::from(fold);
            assert!(
                (attributes.superpixel == 1) == fold || (cosine - FOLD).abs() < 0.01,
                "{samples} samples, pixel {pixel}, cosine {cosine}"
            );
        }
        let expected = if samples >= 128 { 100..350 } else { 0..1 };
        assert!(expected.contains(&folds), "{samples} samples: {folds} folds");
    }
}

#[test]
fn specks_at_an_angle_to_the_wall_make_superpixels() {
    on_gpu(|gpu| {
        let (stage, cosines) = specks(64);
        check_folds(64, &cosines, |settings| stage.render(gpu, settings));
    });
}

/// If nothing contrasts, nothing is sampled, and the passes after detection are reported as skipped.
#[test]
fn an_image_without_edges_has_no_superpixels() {
    on_gpu(|gpu| {
        let size = [64, 64];
        let mut stage = mosaic(1, size);
        stage.materials.push(flat([0.2, 0.2, 0.2, 1.0], AlphaMode::Opaque));
        // A triangle covers everything.
        let wall = [[0.0, -200.0], [-200.0, 200.0], [200.0, 200.0]];
        stage.add(1, wall.map(|place| seen_at(place, 0.05, size[1])));
        for (detection, _) in MODES {
            let marked = found(gpu, &stage, &once(size), detection);
            assert!(!marked.contains(&true), "{detection:?}");
        }
        let settings = once(size).method(SuperpixelOptions::new(CellOptions::DEFAULT_SAMPLES).thin(false));
        let statistics = stage.render(gpu, &settings).statistics;
        assert!(statistics.skipped_passes.contains(&"sample"), "{statistics:?}");
        assert_eq!((statistics.busy_tiles, statistics.visibility_samples), (0, 0));
    });
}

/// A triangle with painted stripes, whose texture has this filter.
fn stripes(size: [u32; 2], filter: Filter, alpha: AlphaMode) -> Stage {
    let mut stage = Stage::new(vec![textured(alpha)]);
    stage.texture = Some((
        Image { width: 2, height: 1, pixels: vec![0, 0, 0, 255, 255, 255, 255, 255] },
        Sampler { mag: filter, min: filter, mip: Some(Filter::Linear), ..Sampler::default() },
    ));
    let corners = [[-90.0, -80.0], [95.0, -85.0], [5.0, 120.0]];
    stage.add(0, corners.map(|place| seen_at(place, 1.0, size[1])));
    stage.triangles[0].uvs = [[0.0, 0.0], [12.4, 3.6], [6.8, 13.2]];
    stage
}

/// Contrasting paint on a single triangle makes superpixels, which are shaded in parts; detection of edges alone
/// ignores paint.
#[test]
fn paint_makes_superpixels() {
    on_gpu(|gpu| {
        let size = [64, 48];
        let error = |rendered: &Rendered, truth: &Rendered| {
            let pairs = rendered.colors.iter().zip(&truth.colors);
            pairs.map(|(a, b)| f64::from(a[0] - b[0]).powi(2)).sum::<f64>()
        };
        let with = |method: MethodKind, samples| {
            once(size)
                .footprint(Footprint::Pixel)
                .method(method.with_samples(samples))
                .map_superpixels(|options| options.thin(false).contrast(Some(CONTRAST)))
        };
        for (filter, alpha) in [
            (Filter::Nearest, AlphaMode::Opaque),
            (Filter::Linear, AlphaMode::Opaque),
            (Filter::Linear, AlphaMode::Blend),
        ] {
            let stage = stripes(size, filter, alpha);
            let truth = stage.render(gpu, &with(MethodKind::Ssaa, 1024));
            let aliased = stage.render(gpu, &with(MethodKind::None, 1));
            let settings = with(MethodKind::Superpixel, 64)
                .map_superpixels(|options| options.detection(Detection::Contrast).shading(Shading::Part));
            let smooth = stage.render(gpu, &settings);
            let marked = smooth.statistics.superpixels;
            assert!(marked > 300, "{filter:?}: {marked}");
            let [before, after] = [&aliased, &smooth].map(|rendered| error(rendered, &truth));
            assert!(after * 3.0 < before, "{filter:?}: {after} of {before}");

            if alpha == AlphaMode::Blend {
                continue; // IDs of BLEND triangles are not in the image.
            }
            let (codes, doubtful) = codes(&aliased);
            let ids = ids(&aliased);
            let blend = vec![0; ids.len()];
            let settings = with(MethodKind::Superpixel, 4);
            for mode in [Mode::Contrast(CONTRAST), Mode::Edges(CONTRAST)] {
                let detection = if mode == Mode::Contrast(CONTRAST) { Detection::Contrast } else { Detection::Edges };
                let expected = expected(size, &ids, &blend, &codes, mode);
                let found = found(gpu, &stage, &settings, detection);
                let excuse =
                    |pixel: usize| near(&doubtful, size, pixel) || may_grow(found[pixel], &expected, size, pixel, mode);
                assert!(
                    (0..found.len()).all(|pixel| found[pixel] == expected[pixel] || excuse(pixel)),
                    "{filter:?}, {mode:?}"
                );
            }
        }
    });
}
