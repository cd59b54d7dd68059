//! Triangles that are narrower than a cell and cover no location.

use glam::DVec3;
use gpc::camera::{Camera, Pinhole, Projection, SampleLocation};
use gpc::render::{Detection, Headless, PreparedScene, Rendered, Settings};
use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;
use twins::crossings::{Mark, PinholeView};
use twins::thin::{FOLD, cosine};

use super::{pinhole, planar};
use crate::detect::{check_folds, specks, wires};
use crate::meshes::Random;
use crate::stage::{Stage, camera, flat, on_gpu, seen_at};

const SIZE: [u32; 2] = [96, 64];

fn settings(detection: Detection, thin: bool) -> Settings {
    Settings::new(SIZE[0], SIZE[1]).attributes(true).map_superpixels(|options| options.detection(detection).thin(thin))
}

/// Colours at locations on the stages' pinhole.
fn seen(gpu: &mut Headless, scene: &PreparedScene, locations: &[SampleLocation], settings: &Settings) -> Rendered {
    let rig: [(Pinhole, Vec<SampleLocation>); 1] = [(pinhole(SIZE), locations.to_vec())];
    gpu.render_locations(scene, &rig, settings).unwrap()
}

fn energy(rendered: &Rendered) -> f64 {
    rendered.colors.iter().map(|c| f64::from(c[0])).sum()
}

/// Energy of the image, with and without the search for thin triangles, as a share of its energy with superpixels
/// everywhere.
fn shares(gpu: &mut Headless, scene: &PreparedScene, locations: &[SampleLocation]) -> [f64; 2] {
    let all = energy(&seen(gpu, scene, locations, &settings(Detection::Every, false)));
    assert!(all > 5.0, "{all}");
    [true, false].map(|thin| {
        let found = seen(gpu, scene, locations, &settings(Detection::Contrast, thin));
        energy(&found) / all
    })
}

/// Planar set, scaled about the middle of the image.
fn scaled([across, down]: [f64; 2]) -> Vec<SampleLocation> {
    let [width, height] = SIZE.map(f64::from);
    let stretch = |location: SampleLocation| SampleLocation {
        uv: [
            0.5 * width + across * (location.uv[0] - 0.5 * width),
            0.5 * height + down * (location.uv[1] - 0.5 * height),
        ],
        jacobian: [[across, 0.0], [0.0, down]],
        ..location
    };
    planar(SIZE).into_iter().map(stretch).collect()
}

#[test]
fn wires_of_a_planar_set_are_the_images() {
    on_gpu(|gpu| {
        // The first distance separates the wires from the wall; the second paints them on it.
        for distance in [2.0, 4.999] {
            let stage = wires(SIZE, distance);
            // Frames and lists may differ in whether a cell has rows or columns.
            let settings =
                settings(Detection::Contrast, true).map_superpixels(|options| options.pattern(Pattern::Sobol));
            let image = stage.render(gpu, &settings);
            let scene = stage.upload(gpu);
            let locations = seen(gpu, &scene, &planar(SIZE), &settings);
            let pairs = image.attributes.iter().zip(&locations.attributes);
            let differ = pairs.filter(|(a, b)| a.superpixel != b.superpixel).count();
            assert!(image.statistics.superpixels > 1000);
            assert!(differ <= 24, "{differ} superpixels differ at {distance}");
            let far = |(a, b): &(&[f32; 4], &[f32; 4])| (a[0] - b[0]).abs() > 1e-3;
            let differ = image.colors.iter().zip(&locations.colors).filter(far).count();
            assert!(differ <= 24, "{differ} colours differ at {distance}");
        }
    });
}

/// The search depends on the cell's size: cells are a quarter of a pixel wide, four times as wide, and both.
#[test]
fn wires_keep_their_energy_in_cells_of_any_size() {
    on_gpu(|gpu| {
        let scene = wires(SIZE, 2.0).upload(gpu);
        for stretch in [[0.25, 0.25], [1.0, 0.25], [1.4, 1.4], [1.9, 0.6]] {
            let [with, without] = shares(gpu, &scene, &scaled(stretch));
            assert!((with - 1.0).abs() < 0.03, "{with} at {stretch:?}");
            assert!((without - 1.0).abs() > 0.04, "{without} at {stretch:?}");
        }
    });
}

/// Wires overhead start in front of the near plane and end behind the eye, so that their visible part is clipped.
#[test]
fn wires_past_the_eye_keep_their_energy() {
    on_gpu(|gpu| {
        let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
        for wire in 0..10 {
            let x = f64::from(wire) * 0.31 - 1.53;
            let corner = |x: f64, z: f64| [x, 1.5, z].map(|v| v as f32);
            stage.add_quad(0, [corner(x, 5.0), corner(x + 0.004, 5.0), corner(x + 0.004, -40.0), corner(x, -40.0)]);
        }
        let scene = stage.upload(gpu);
        let [with, without] = shares(gpu, &scene, &planar(SIZE));
        assert!((with - 1.0).abs() < 0.03, "{with}");
        assert!((without - 1.0).abs() > 0.1, "{without}");
    });
}

/// A hilly mesh of one colour, with several triangles in each pixel.
#[test]
fn dense_meshes_make_no_superpixels() {
    on_gpu(|gpu| {
        let mut stage = Stage::new(vec![flat([0.5, 0.5, 0.5, 1.0], AlphaMode::Opaque)]);
        let mut random = Random::new(3);
        let [columns, rows] = [220_usize, 160];
        let distances: Vec<f64> = (0..columns * rows)
            .map(|place| {
                let [x, y] = [place % columns, place / columns].map(|v| v as f64);
                let hills = 0.3 * (0.05 * x).sin() * (0.08 * y).cos();
                3.0 + hills + random.range(-1e-3, 1e-3)
            })
            .collect();
        let at = |column: usize, row: usize| {
            // The offsets keep vertices away from locations.
            let place = [column as f64 * 0.5 - 54.87, row as f64 * 0.5 - 39.91];
            seen_at(place, distances[row * columns + column], SIZE[1])
        };
        for row in 1..rows {
            for column in 1..columns {
                let [left, top] = [column - 1, row - 1];
                stage.add_quad(0, [at(left, top), at(left, row), at(column, row), at(column, top)]);
            }
        }
        let scene = stage.upload(gpu);
        for stretch in [[1.0, 1.0], [0.5, 0.5], [1.1, 0.4]] {
            let rendered = seen(gpu, &scene, &scaled(stretch), &settings(Detection::Contrast, true));
            assert!(rendered.attributes.iter().all(|seen| seen.id != 0));
            assert_eq!(rendered.statistics.superpixels, 0, "{stretch:?}");
        }
    });
}

#[test]
fn specks_at_an_angle_to_the_wall_make_cells_superpixels() {
    on_gpu(|gpu| {
        let (stage, cosines) = specks(64);
        let scene = stage.upload(gpu);
        let rig = [(pinhole([64; 2]), planar([64; 2]))];
        check_folds(64, &cosines, |settings| gpu.render_locations(&scene, &rig, settings).unwrap());
    });
}

/// A wall, with slivers in front of it, on it, behind it and past the eye.
fn slivers(random: &mut Random) -> Stage {
    let mut material = flat([1.0; 4], AlphaMode::Opaque);
    material.double_sided = true;
    let mut stage = Stage::new(vec![material]);
    let corner = |x: f64, y: f64| seen_at([x, y], 5.0, SIZE[1]);
    for [left, right] in [[-60.0, -20.3], [-20.3, 9.7], [9.7, 31.0]] {
        let wall = [(left, -50.0), (left, 21.2), (right, 21.2), (right, -50.0)];
        stage.add_quad(0, wall.map(|(x, y)| corner(x, y)));
    }
    for sliver in 0..160 {
        let distance = [2.0, 4.9, 4.999, 5.0, 8.0][sliver % 5];
        let at = [random.range(-55.0, 55.0), random.range(-38.0, 38.0)];
        let turn = random.range(0.0, 6.3);
        let (length, width) = (random.range(0.5, 40.0), random.range(0.05, 2.5));
        let along = [turn.cos(), turn.sin()];
        let place = |far: f64, aside: f64, depth: f64| {
            let x = at[0] + far * along[0] - aside * along[1];
            seen_at([x, at[1] + far * along[1] + aside * along[0]], depth, SIZE[1])
        };
        let mut corners = [
            place(-length, 0.0, distance),
            place(length, 0.0, distance * random.range(0.999, 1.001)),
            place(random.range(-length, length), width, distance),
        ];
        if sliver % 8 == 7 {
            // The corner is behind the eye, which looks along -z.
            corners[0] = [0.3 * corners[0][0], 0.3 * corners[0][1], 1.0];
        }
        stage.add(0, corners);
    }
    stage
}

/// Cells of an output that become superpixels, compared with the twin: thin triangles in front of, on and at an angle to
/// surfaces, cells of any shape, and perspective and parallel rays.
#[test]
fn cells_are_marked_as_the_twin_has_it() {
    on_gpu(|gpu| {
        let mut random = Random::new(29);
        let stage = slivers(&mut random);
        let scene = stage.upload(gpu);
        let level =
            Camera { projection: Projection::Orthographic { half_height: 2.7, near: 0.5, far: 50.0 }, ..camera() };
        let level = Pinhole::from_camera(&level, SIZE).unwrap();
        // Parallel rays are seen from very far away.
        let far = level.eye() - 1e9 * level.direction();
        for (pinhole, eye, samples) in
            [(pinhole(SIZE), DVec3::ZERO, 64), (pinhole(SIZE), DVec3::ZERO, 128), (level, far, 64), (level, far, 128)]
        {
            let locations: Vec<SampleLocation> = planar(SIZE)
                .into_iter()
                .map(|location| {
                    let reach = [0.3, 0.7, 1.2][location.output as usize % 3];
                    let mut number = || random.range(-reach, reach);
                    SampleLocation { jacobian: [[number() + 0.9, number()], [number(), number() + 0.9]], ..location }
                })
                .collect();
            // No colours differ by more than 255, and detection of edges leaves second differences out.
            let settings = settings(Detection::Edges, true)
                .map_superpixels(|options| options.samples(samples).contrast(Some(255)));
            let corners = |id: u32| {
                let corners = stage.triangles[id as usize - 1].corners;
                corners.map(|corner| DVec3::from_array(corner.map(f64::from)))
            };
            let rig = [(pinhole, locations)];
            let rendered = gpu.render_locations(&scene, &rig, &settings).unwrap();
            let [(_, locations)] = &rig;
            let view = PinholeView::new(&pinhole, DVec3::ZERO);
            let ids: Vec<u32> = rendered.attributes.iter().map(|seen| seen.id).collect();
            let (mut marked, mut doubtful) = (0, 0);
            for (location, seen) in locations.iter().zip(&rendered.attributes) {
                let (mut sure, mut unsure) = (false, false);
                for id in 1..=stage.triangles.len() as u32 {
                    let Some(crossing) = view.crossing(corners(id), location) else {
                        continue;
                    };
                    let other = seen.id != 0 && seen.id != id && samples >= 128;
                    let cosine = if other { cosine(corners(id), corners(seen.id), eye) } else { 1.0 };
                    let marks = |by: f64, cosine: f64| {
                        let behind = view.behind(f64::from(seen.depth)) + by;
                        let mark = crossing.mark(behind, cosine < FOLD);
                        let amid = || seen.id != id && amid(&ids, location.output, id);
                        mark == Mark::Apart || mark == Mark::Painted && amid()
                    };
                    let found = marks(0.0, cosine);
                    let about = [
                        marks(-1e-5, cosine),
                        marks(1e-5, cosine),
                        marks(0.0, cosine - 0.01),
                        marks(0.0, cosine + 0.01),
                    ];
                    let same = about == [found; 4] && crossing.clearance > 0.01;
                    sure |= same && found;
                    unsure |= !same;
                }
                marked += u32::from(sure);
                doubtful += u32::from(unsure && !sure);
                let found = seen.superpixel == 1;
                assert!(found == sure || unsure && !sure, "{location:?} shows {} at {}: {found}", seen.id, seen.depth);
            }
            assert!(marked > 300 && doubtful < 300, "{marked} {doubtful}");
        }
    });
}

/// Whether a cell lies in the middle of a triangle other than `id`: it and both of its horizontal neighbours, or both
/// of its vertical ones, show that triangle. Beyond the border, cells repeat.
fn amid(ids: &[u32], cell: u32, id: u32) -> bool {
    let [width, height] = SIZE;
    let [x, y] = [cell % width, cell / width];
    let shown = |x: u32, y: u32| ids[(y.min(height - 1) * width + x.min(width - 1)) as usize];
    let here = shown(x, y);
    let beside = shown(x.saturating_sub(1), y) == here && shown(x + 1, y) == here;
    let above = shown(x, y.saturating_sub(1)) == here && shown(x, y + 1) == here;
    here != 0 && here != id && (beside || above)
}

/// An output with more cells than a band holds. The output repeats the same picture, and the band ends in the middle of
/// one.
#[test]
fn bands_of_an_output_find_what_the_whole_does() {
    on_gpu(|gpu| {
        let [width, height] = SIZE;
        let scene = slivers(&mut Random::new(29)).upload(gpu);
        let times = 187;
        let copy = |copy: u32| {
            planar(SIZE)
                .into_iter()
                .map(move |location| SampleLocation { output: location.output + copy * width * height, ..location })
        };
        let rig = [(pinhole(SIZE), (0..times).flat_map(copy).collect())];
        let size = [width, times * height];
        let settings = settings(Detection::Exact, true).size(size).map_superpixels(|options| options.samples(4));
        let rendered = gpu.render_locations(&scene, &rig, &settings).unwrap();
        let row = |row: u32| {
            let first = (row * width) as usize;
            rendered.attributes[first..first + width as usize].iter()
        };
        let mut marked = 0;
        for y in 2 * height..(times - 1) * height {
            // Cells at the ends have other neighbours than in the image.
            if !(3..height - 3).contains(&(y % height)) {
                continue;
            }
            let first = row(height + y % height);
            let differ = row(y).zip(first).filter(|(a, b)| a != b).count();
            assert_eq!(differ, 0, "row {y}");
            marked += row(y).filter(|seen| seen.superpixel == 1).count();
        }
        assert!(marked > 200_000, "{marked}");
    });
}
