//! Samples on lines, compared with the exact twin and with closed forms.

use std::f64::consts::TAU;
use std::process::Command;

use gpc::render::{Headless, Settings, Shading};
use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;
use twins::edge::triangle_area;
use twins::sample_lines::offsets;

use crate::meshes::{Depths, Mesh, Random, fan, slivers, tilings};
use crate::stage::{Stage, centre, code, everywhere, flat, on_gpu, seen_at};
use crate::twin::Twin;
use crate::visibility::soup;

const SIZE: [u32; 2] = [32, 24];

/// Numbers of samples of a superpixel, and the numbers of lines that belong to them.
const SAMPLES: [(u32, u32); 4] = [(4, 8), (64, 8), (256, 32), (1024, 64)];
/// Those for tests of many meshes: 64 lines take the twin longest.
const FEW_SAMPLES: &[(u32, u32)] = SAMPLES.split_at(3).0;

fn on_lines(samples: u32) -> Settings {
    everywhere(SIZE, Pattern::Lines, samples).map_superpixels(|options| options.shading(Shading::Triangle))
}

fn coded(mesh: &Mesh) -> Stage {
    let mut material = flat([1.0; 4], AlphaMode::Opaque);
    material.double_sided = true;
    let mut stage = Stage::new(vec![material]);
    stage.add_mesh(0, mesh, SIZE[1], |triangle| triangle);
    stage.color_by_code();
    stage
}

/// Asserts that each pixel shows the mean of its samples on rows or on columns, as far as rounding does not decide.
/// Returns the largest number of pixels of an image that were sampled by points.
fn compare(gpu: &mut Headless, stage: &Stage, name: &str, tried: &[(u32, u32)]) -> u64 {
    let twin = Twin::new(stage, SIZE);
    let ids = 1..=stage.triangles.len() as u32;
    let codes: Vec<_> = ids.map(|id| code(id).map(f64::from)).collect();
    let mut most_left = 0;
    for &(samples, lines) in tried {
        let rendered = stage.render(gpu, &on_lines(samples));
        let sets = [false, true].map(|columns| offsets(columns, lines));
        let (mut differ, mut doubtful) = (0_u32, 0);
        for (pixel, found) in rendered.colors.iter().enumerate() {
            let middle = centre(pixel, SIZE);
            // The number of contested samples of a set, if its mean is what the pixel shows.
            let contested_of_fit = |places: &Vec<[f64; 2]>| {
                let mut sum = [0.0; 3];
                let mut contested = 0;
                for offset in places {
                    let sample = [0, 1].map(|axis| middle[axis] + offset[axis]);
                    let seen = twin.nearest(pixel, sample);
                    contested += u32::from(seen.contested());
                    if let Some(hit) = seen.nearest {
                        let shown = codes[hit.id as usize - 1];
                        sum = [0, 1, 2].map(|channel| sum[channel] + shown[channel]);
                    }
                }
                let count = places.len() as f64;
                let bound = 0.01 + 4095.0 * f64::from(contested) / count;
                let errs = |channel: usize| (f64::from(found[channel]) - sum[channel] / count).abs() > bound;
                (!(0..3).any(errs)).then_some(contested)
            };
            match sets.iter().find_map(contested_of_fit) {
                Some(contested) => doubtful += contested,
                None => differ += 1,
            }
        }
        let left = rendered.statistics.resampled;
        let all = u64::from(SIZE[0] * SIZE[1]);
        assert!(
            u64::from(differ) <= left && left * 4 <= all,
            "{name}, {samples} samples: {differ} pixels differ, {left} left to points"
        );
        let few = u64::from(doubtful) * 10 <= all * sets[0].len() as u64;
        assert!(few, "{name}: {doubtful} contested samples say little");
        most_left = most_left.max(left);
    }
    most_left
}

#[test]
fn tilings_are_seen_as_the_twin_sees_them() {
    on_gpu(|gpu| {
        for mesh in tilings(7, 16.0) {
            compare(gpu, &coded(&mesh), &mesh.name, FEW_SAMPLES);
        }
    });
}

/// A vertex that 12 or 24 triangles share, and triangles that are thinner than the distance between samples. No pixel sees
/// more triangles than lines have room for.
#[test]
fn fans_and_slivers_are_seen_as_the_twin_sees_them() {
    on_gpu(|gpu| {
        for mesh in
            [fan(3, 16.0, 12, Depths::Random), fan(3, 16.0, 24, Depths::Random), slivers(5, 16.0, 30, Depths::Random)]
        {
            assert_eq!(compare(gpu, &coded(&mesh), &mesh.name, &SAMPLES), 0);
        }
    });
}

/// Planes that intersect.
#[test]
fn intersecting_triangles_are_seen_as_the_twin_sees_them() {
    on_gpu(|gpu| {
        compare(gpu, &soup(2, 40, true, [-1.0, 5.0]), "soup", &SAMPLES);
    });
}

/// Edges at many angles cover their areas, except for a fraction of a sample on each line.
#[test]
fn edges_at_all_angles_cover_their_areas() {
    on_gpu(|gpu| {
        let (mut worst, mut squares, mut count) = (0.0_f64, 0.0, 0.0);
        for step in 0..90 {
            let angle = TAU * (f64::from(step) + 0.37) / 90.0;
            let (sin, cos) = angle.sin_cos();
            // The triangle is a half-plane through the image's middle, as far as the image extends.
            let corners = [[-90.0, 0.03], [90.0, 0.03], [0.0, 120.0]]
                .map(|[x, y]: [f64; 2]| [x * cos - y * sin, x * sin + y * cos]);
            let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
            stage.add(0, corners.map(|at| seen_at(at, 2.0, SIZE[1])));
            let image = stage.render(gpu, &on_lines(256));
            assert_eq!(image.statistics.resampled, 0);
            for (pixel, color) in image.colors.iter().enumerate() {
                let area = triangle_area(corners, centre(pixel, SIZE));
                let error = (f64::from(color[0]) - area).abs();
                worst = worst.max(error);
                if area > 0.0 && area < 1.0 {
                    squares += error * error;
                    count += 1.0;
                }
            }
        }
        // 1,024 points have a mean error of 0.0017, and 0.0022 at the worst angle.
        let mean = f64::sqrt(squares / count);
        assert!(worst < 0.008, "an area errs by {worst}");
        assert!(mean < 0.0012, "areas err by {mean}");
    });
}

/// Triangles that meet in a vertex on another triangle's side leave no gap and no overlap.
#[test]
fn shares_add_up_to_one() {
    on_gpu(|gpu| {
        let mut random = Random::new(4);
        for _ in 0..8 {
            let at = random.range(-10.0, 10.0);
            let turn = random.range(0.0, TAU);
            let (sin, cos) = turn.sin_cos();
            let place = |[x, y]: [f64; 2]| seen_at([x * cos - y * sin, x * sin + y * cos], 2.0, SIZE[1]);
            let mut stage = Stage::new(vec![
                flat([1.0, 0.0, 0.0, 1.0], AlphaMode::Opaque),
                flat([0.0, 1.0, 0.0, 1.0], AlphaMode::Opaque),
                flat([0.0, 0.0, 1.0, 1.0], AlphaMode::Opaque),
            ]);
            for material in &mut stage.materials {
                material.double_sided = true;
            }
            stage.add(0, [[-90.0, 0.0], [90.0, 0.0], [0.0, -90.0]].map(place));
            stage.add(1, [[-90.0, 0.0], [at, 0.0], [0.0, 90.0]].map(place));
            stage.add(2, [[at, 0.0], [90.0, 0.0], [0.0, 90.0]].map(place));
            let image = stage.render(gpu, &on_lines(64));
            for (pixel, color) in image.colors.iter().enumerate() {
                let [red, green, blue, alpha] = color.map(f64::from);
                assert!(alpha <= 1.0 + 1e-6 && (red + green + blue - alpha).abs() < 1e-6, "pixel {pixel}: {color:?}");
            }
        }
    });
}

/// A cell that 64 candidates touch, each of them in another word of the tile's list, sees the last one, too, although more words
/// follow. The order of lists is known if lavapipe has one thread.
#[test]
fn the_last_of_many_words_is_seen() {
    const THREADS: &str = "LP_NUM_THREADS";
    if std::env::var(THREADS).as_deref() != Ok("1") {
        let child = Command::new(std::env::current_exe().unwrap())
            .args(["lines::the_last_of_many_words_is_seen", "--exact", "--nocapture"])
            .env(THREADS, "1")
            .output()
            .unwrap();
        let [said, errors] = [&child.stdout, &child.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
        assert!(child.status.success() && said.contains("1 passed"), "{said}{errors}");
        return;
    }
    let mut material = flat([1.0; 4], AlphaMode::Opaque);
    material.double_sided = true;
    let mut stage = Stage::new(vec![material]);
    // `cull` lists 512 triangles so: triangles 0, 64, ... 448, then 1, 65, ... 449, and so on. So every 32nd entry of the list is one of
    // the first 64 triangles of 512, whose number is a multiple of 4.
    const LAST: u32 = 3 * 512 + 60;
    for triangle in 0..5 * 512 {
        let touches = triangle < 4 * 512 && triangle % 512 < 64 && triangle % 4 == 0;
        let (middle, size, distance) = match (touches, triangle) {
            (true, LAST) => ([0.5, 0.5], 2.0, 2.0),
            (true, _) => ([0.5, 0.5], 0.1, 4.0),
            (false, _) => ([6.5, 2.5], 0.1, 4.0),
        };
        let corners = [[-1.0, -1.0], [2.0, -1.0], [-1.0, 2.0]];
        stage.add(0, corners.map(|[x, y]| seen_at([middle[0] + size * x, middle[1] + size * y], distance, SIZE[1])));
    }
    stage.color_by_code();
    on_gpu(|gpu| {
        let image = stage.render(gpu, &on_lines(64));
        let seen = (0..image.colors.len()).find(|pixel| centre(*pixel, SIZE) == [0.5, 0.5]).unwrap();
        let [red, green, blue] = code(LAST + 1);
        let found = image.colors[seen];
        let differs =
            found.iter().zip([red, green, blue, 1.0]).any(|(found, expected)| (found - expected).abs() > 0.01);
        assert!(!differs, "{found:?} instead of {:?}", code(LAST + 1));
        // Only the cell that all other triangles touch is left to points.
        assert_eq!(image.statistics.resampled, 1);
    });
}

/// Of coplanar triangles, only the one with the smaller ID is visible.
#[test]
fn the_smaller_id_of_coplanar_triangles_is_seen() {
    on_gpu(|gpu| {
        let mut stage = Stage::new(vec![
            flat([1.0, 0.0, 0.0, 1.0], AlphaMode::Opaque),
            flat([0.0, 1.0, 0.0, 1.0], AlphaMode::Opaque),
        ]);
        for material in &mut stage.materials {
            material.double_sided = true;
        }
        let corners = [[-90.0, -70.0], [90.0, -60.0], [3.0, 90.0]];
        for (material, turn) in [(0, 0), (1, 1), (1, 2), (0, 1)] {
            let turned = [0, 1, 2].map(|i: usize| corners[(i + turn) % 3]);
            stage.add(material, turned.map(|at| seen_at(at, 2.0, SIZE[1])));
        }
        let image = stage.render(gpu, &on_lines(64));
        for (pixel, color) in image.colors.iter().enumerate() {
            assert!(color[1] == 0.0, "pixel {pixel}: {color:?}");
        }
    });
}
