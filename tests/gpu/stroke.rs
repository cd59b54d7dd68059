//! Points and lines, compared with the areas of their polygons.

use glam::DVec3;
use gpc::camera::{Camera, Projection};
use gpc::render::{Detection, Headless, MethodKind, PixelRect, RenderError, Rendered, SceneRequest, Settings};
use gpc::sampling::Pattern;
use gpc::scene::{Loaded, PoseRequest};
use serde_json::{Value, json};
use twins::edge::triangle_area;
use twins::stroke::{Clip, disc, joint, segment};

use crate::locations::{pinhole, planar};
use crate::meshes::Random;
use crate::scene_builder::Builder;
use crate::stage::{camera, cells, centre, everywhere, on_gpu, once, seen_at};

const SIZE: [u32; 2] = [64, 48];
const POINTS: u32 = 0;
const LINES: u32 = 1;
const LINE_LOOP: u32 = 2;
const LINE_STRIP: u32 = 3;

/// Unlit white points or lines through these vertices.
fn drawn(mode: u32, positions: &[[f32; 3]]) -> Loaded {
    let mut builder = Builder::new();
    let positions = builder.floats(positions);
    let material = builder.push("materials", json!({"extensions": {"KHR_materials_unlit": {}}}));
    builder.json["extensionsUsed"] = json!(["KHR_materials_unlit"]);
    builder.node_with(json!({"attributes": {"POSITION": positions}, "mode": mode, "material": material}), json!({}));
    builder.load().unwrap()
}

fn rendered(gpu: &mut Headless, loaded: &Loaded, settings: &Settings, camera: &Camera) -> Rendered {
    let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
    let prepared = gpu.upload(SceneRequest::new(&loaded.scene, &pose)).unwrap();
    let mut frame = gpu.prepare(&prepared, settings).unwrap();
    gpu.render(&mut frame, camera).unwrap()
}

fn clip(camera: &Camera, position: [f32; 3]) -> Clip {
    let [width, height] = SIZE.map(f64::from);
    let position = DVec3::from_array(position.map(f64::from));
    (camera.pixel_matrix(DVec3::ZERO, width, height) * position.extend(1.0)).to_array()
}

/// Area of a pixel that convex polygons without overlap cover.
fn covered(polygons: &[Vec<[f64; 2]>], pixel: usize) -> f64 {
    let centre = centre(pixel, SIZE);
    let fan = |polygon: &Vec<[f64; 2]>| -> f64 {
        let triangles =
            (1..polygon.len().max(2) - 1).map(|k| triangle_area([polygon[0], polygon[k], polygon[k + 1]], centre));
        triangles.sum()
    };
    polygons.iter().map(fan).sum()
}

/// Root mean squared and largest difference between an image, white on an empty background, and the areas of polygons.
fn difference(image: &Rendered, polygons: &[Vec<[f64; 2]>]) -> (f64, f64) {
    let errors = image.colors.iter().enumerate().map(|(pixel, color)| {
        assert!(color.iter().all(|x| (x - color[3]).abs() < 1e-6), "{color:?}");
        (f64::from(color[3]) - covered(polygons, pixel)).abs()
    });
    let (squares, largest) =
        errors.fold((0.0, 0.0), |(squares, largest): (f64, f64), error| (squares + error * error, largest.max(error)));
    ((squares / image.colors.len() as f64).sqrt(), largest)
}

fn by_lines(line_width: f32) -> Settings {
    everywhere(SIZE, Pattern::Lines, 256).line_width(line_width)
}

/// Segments at irregular angles: in one plane, towards the horizon, and from behind the eye.
fn segments() -> Vec<[[f32; 3]; 2]> {
    let mut random = Random::new(5);
    let mut place = |distance: f64| {
        let at = SIZE.map(|side| random.range(-0.45, 0.45) * f64::from(side));
        seen_at(at, distance, SIZE[1])
    };
    let mut all: Vec<_> = (0..5).map(|_| [place(2.0), place(2.0)]).collect();
    all.extend((0..3).map(|_| [place(0.5), place(300.0)]));
    let behind = [[0.3, 0.4, 1.0], [-5.0, 0.5, 7.0]];
    all.extend(behind.map(|end| [end, place(3.0)]));
    all
}

#[test]
fn a_line_covers_its_area() {
    on_gpu(|gpu| {
        for width in [0.3, 1.0, 5.0] {
            for ends in segments() {
                let image = rendered(gpu, &drawn(LINES, &ends), &by_lines(width), &camera());
                let clips = ends.map(|end| clip(&camera(), end));
                let line = segment(None, clips, None, width.into());
                let (mean, largest) = difference(&image, &[line]);
                let seen = image.colors.iter().filter(|c| c[3] > 0.0).count();
                assert!(seen > 5, "{seen} pixels of {ends:?}");
                assert!(mean < 2e-3 && largest < 0.06, "{ends:?}, width {width}: {mean}, {largest}");
            }
        }
    });
}

/// Detection finds every pixel of a line; sampling everywhere finds no more.
#[test]
fn no_pixel_of_a_thin_line_is_missed() {
    on_gpu(|gpu| {
        for width in [0.3, 1.0] {
            for ends in segments() {
                let settings = by_lines(width).map_superpixels(|options| options.detection(Detection::Contrast));
                let found = rendered(gpu, &drawn(LINES, &ends), &settings, &camera());
                let all = rendered(gpu, &drawn(LINES, &ends), &by_lines(width), &camera());
                let unlike = found.colors.iter().zip(&all.colors);
                let unlike = unlike.filter(|(a, b)| (a[3] - b[3]).abs() > 0.05).count();
                assert!(unlike == 0, "{unlike} pixels of {ends:?}, width {width}");
            }
        }
    });
}

#[test]
fn brute_force_and_multisampling_draw_lines_as_wide() {
    on_gpu(|gpu| {
        let ends = [[-20.3, -11.0], [24.0, 13.7]].map(|at| seen_at(at, 2.0, SIZE[1]));
        let clips = ends.map(|end| clip(&camera(), end));
        for (method, samples, tolerance) in
            [(MethodKind::Ssaa, 64, 0.02), (MethodKind::Msaa, 4, 0.1), (MethodKind::None, 1, 0.2)]
        {
            let settings = by_lines(3.0).line_width(3.0).method(method.with_samples(samples));
            let image = rendered(gpu, &drawn(LINES, &ends), &settings, &camera());
            let line = segment(None, clips, None, 3.0);
            let (mean, _) = difference(&image, &[line]);
            assert!(mean < tolerance, "{method:?}: {mean}");
        }
    });
}

/// Strips and loops with mitred and bevelled joints.
#[test]
fn strips_and_loops_are_joined() {
    let strip = [[-25.0, 10.0], [-10.0, -12.0], [0.5, 14.0], [20.0, -15.0], [21.0, 18.0]];
    let small = [[-8.0, 0.0], [6.0, -9.3], [9.0, 11.0]];
    let spike = [[-25.0, 0.0], [20.0, 1.0], [-24.0, 9.0]];
    on_gpu(|gpu| {
        for (mode, path, overlaps) in
            [(LINE_STRIP, &strip[..], false), (LINE_LOOP, &small[..], false), (LINE_STRIP, &spike[..], true)]
        {
            let width = 3.0;
            let positions: Vec<_> = path.iter().map(|at| seen_at(*at, 2.0, SIZE[1])).collect();
            let clips: Vec<_> = positions.iter().map(|p| clip(&camera(), *p)).collect();
            let at = |index: isize| {
                let count = clips.len() as isize;
                match mode {
                    LINE_LOOP => Some(clips[index.rem_euclid(count) as usize]),
                    _ => usize::try_from(index).ok().and_then(|i| clips.get(i).copied()),
                }
            };
            let mut polygons = Vec::new();
            for s in 0..clips.len() as isize {
                if let (Some(from), Some(to)) = (at(s), at(s + 1)) {
                    polygons.push(segment(at(s - 1), [from, to], at(s + 2), width));
                    polygons.extend(at(s + 2).map(|after| joint(from, to, after, width)));
                }
            }
            let settings = by_lines(width as f32);
            let image = rendered(gpu, &drawn(mode, &positions), &settings, &camera());
            for (pixel, color) in image.colors.iter().enumerate() {
                // Where a line folds back on itself, its polygons overlap.
                let parts = polygons.iter().map(|part| covered(std::slice::from_ref(part), pixel));
                let (least, most) = parts.fold((0.0, 0.0), |(least, most), part| (part.max(least), most + part));
                let least = if overlaps { least } else { most };
                let found = f64::from(color[3]);
                assert!(
                    found > least - 0.06 && found < most + 0.06,
                    "{path:?}, pixel {pixel}: {found}, expected {least} to {most}"
                );
            }
        }
    });
}

#[test]
fn points_are_discs() {
    on_gpu(|gpu| {
        let places = [[-12.3, 5.8], [0.2, 0.4], [13.5, -9.9]];
        let mut points = places.map(|at| seen_at(at, 2.0, SIZE[1])).to_vec();
        points.push([0.0, 0.0, 3.0]);
        for size in [0.5, 1.0, 3.0, 9.0] {
            let settings = by_lines(1.0).point_size(size);
            let image = rendered(gpu, &drawn(POINTS, &points), &settings, &camera());
            let clips = points.iter().map(|p| clip(&camera(), *p));
            let discs: Vec<_> = clips.map(|p| disc(p, size.into())).collect();
            let (mean, largest) = difference(&image, &discs);
            assert!(mean < 3e-3 && largest < 0.06, "{size}: {mean}, {largest}");
        }
    });
}

#[test]
fn a_parallel_projection_has_lines_as_wide() {
    on_gpu(|gpu| {
        let camera =
            Camera { projection: Projection::Orthographic { half_height: 2.0, near: 0.1, far: 10.0 }, ..camera() };
        let ends = [[-2.0, -1.3, -1.0], [1.7, 1.1, -6.0]];
        let image = rendered(gpu, &drawn(LINES, &ends), &by_lines(1.0), &camera);
        let line = segment(None, ends.map(|end| clip(&camera, end)), None, 1.0);
        let (mean, largest) = difference(&image, &[line]);
        assert!(mean < 2e-3 && largest < 0.06, "{mean}, {largest}");
    });
}

#[test]
fn lines_without_length_show_nothing() {
    on_gpu(|gpu| {
        let point = [0.1, 0.2, -2.0];
        // The segments are seen end-on in front of and behind the eye, have no length, or are behind the eye.
        let nothing = [[point, point.map(|x| 3.0 * x)], [point, point], [[1.0, 0.0, 1.0], [-1.0, 0.0, 2.0]]];
        for ends in nothing {
            let image = rendered(gpu, &drawn(LINES, &ends), &by_lines(5.0), &camera());
            let seen: f32 = image.colors.iter().map(|c| c[3]).sum();
            assert!(seen < 1e-3, "{ends:?}: {seen}");
        }
    });
}

#[test]
fn a_region_is_that_part_of_the_whole() {
    on_gpu(|gpu| {
        let ends: Vec<_> = segments().into_iter().flatten().collect();
        let loaded = drawn(LINES, &ends);
        let settings = by_lines(1.5).map_superpixels(|options| options.detection(Detection::Contrast));
        let whole = rendered(gpu, &loaded, &settings, &camera());
        assert_eq!(whole.colors, rendered(gpu, &loaded, &settings, &camera()).colors);
        let region = PixelRect { corner: [17, 9], size: [30, 21] };
        let part = settings.region(Some(region));
        let part = rendered(gpu, &loaded, &part, &camera());
        for (row, colors) in part.colors.chunks(30).enumerate() {
            let first = (9 + row) * SIZE[0] as usize + 17;
            assert_eq!(colors, &whole.colors[first..first + 30], "row {row}");
        }
    });
}

/// With normals a line is lit. Without normals it shows its unlit colour, and its normal points to the camera.
#[test]
fn lines_without_normals_are_unlit() {
    on_gpu(|gpu| {
        let ends = [[-9.0, -4.0], [9.0, 5.0]].map(|at| seen_at(at, 2.0, SIZE[1]));
        let mut seen = |normal: Option<[f32; 3]>| {
            let mut builder = Builder::new();
            let positions = builder.floats(&ends);
            let colors = builder.floats(&[[0.5, 0.25, 0.125], [0.5, 0.25, 0.125]]);
            let mut attributes = json!({"POSITION": positions, "COLOR_0": colors});
            if let Some(normal) = normal {
                attributes["NORMAL"] = Value::from(builder.floats(&[normal; 2]));
            }
            builder.node_with(json!({"attributes": attributes, "mode": LINES}), json!({}));
            let settings = once(SIZE).line_width(4.0);
            let image = rendered(gpu, &builder.load().unwrap(), &settings, &camera());
            let middle = (SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) as usize;
            (image.colors[middle], image.attributes[middle].normal)
        };
        let (unlit, towards) = seen(None);
        let (lit, given) = seen(Some([0.0, 1.0, 0.0]));
        let apart = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(apart(&unlit, &[0.5, 0.25, 0.125, 1.0]) < 1e-6, "{unlit:?}");
        assert!(apart(&towards, &[0.0, 0.0, 1.0]) < 1e-6, "{towards:?}");
        assert!(apart(&lit, &unlit) > 0.02, "{lit:?}");
        assert!(apart(&given, &[0.0, 1.0, 0.0]) < 1e-6, "{given:?}");
    });
}

/// The ends of lines follow joints and morph targets.
#[test]
fn lines_move_with_their_nodes() {
    on_gpu(|gpu| {
        let mut builder = Builder::new();
        let positions = builder.floats(&[[-1.0, 0.0, -2.0], [1.0, 0.3, -2.0], [0.5, -1.0, -2.0]]);
        let node = builder.node_with(json!({"attributes": {"POSITION": positions}, "mode": LINE_STRIP}), json!({}));
        let (times, places) = (builder.floats(&[[0.0], [1.0]]), builder.floats(&[[0.0, 0.0, 0.0], [0.4, 0.5, -1.0]]));
        builder.push(
            "animations",
            json!({
                "channels": [{"sampler": 0, "target": {"node": node, "path": "translation"}}],
                "samplers": [{"input": times, "output": places}],
            }),
        );
        let loaded = builder.load().unwrap();
        let later = PoseRequest { time: 1.0, ..PoseRequest::default() };
        let start = PoseRequest { animation: Some("0".to_owned()), ..PoseRequest::default() };
        let (pose, motion) = loaded.scene.pose_in_motion(&start).unwrap();
        let prepared = gpu.upload(SceneRequest::new(&loaded.scene, &pose).moving(&motion)).unwrap();
        let mut frame = gpu.prepare(&prepared, &by_lines(1.0)).unwrap();
        let first = gpu.render(&mut frame, &camera()).unwrap().colors;
        let moment = motion.at(&loaded.scene, 1.0).unwrap().unwrap();
        frame.show(moment.into()).unwrap();
        let moved = gpu.render(&mut frame, &camera()).unwrap().colors;
        let posed = loaded.scene.pose(&later).unwrap();
        let prepared = gpu.upload(SceneRequest::new(&loaded.scene, &posed)).unwrap();
        let mut frame = gpu.prepare(&prepared, &by_lines(1.0)).unwrap();
        let expected = gpu.render(&mut frame, &camera()).unwrap().colors;
        let apart = |a: &[[f32; 4]], b: &[[f32; 4]]| {
            let pairs = a.as_flattened().iter().zip(b.as_flattened());
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
        };
        assert!(apart(&first, &moved) > 0.5);
        assert!(apart(&moved, &expected) < 1e-3);
    });
}

/// The locations are the centres of an image's pixels.
#[test]
fn locations_see_lines_as_wide() {
    on_gpu(|gpu| {
        let ends: Vec<_> = segments().into_iter().flatten().collect();
        let loaded = drawn(LINES, &ends);
        let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
        let prepared = gpu.upload(SceneRequest::new(&loaded.scene, &pose)).unwrap();
        for width in [0.5, 2.0] {
            let settings = by_lines(width);
            let image = rendered(gpu, &loaded, &settings, &camera());
            let seen = gpu
                .sample_superpixels(&prepared, &pinhole(SIZE), &planar(SIZE), &cells(&settings), &settings.scene)
                .unwrap();
            let pairs = image.colors.iter().zip(&seen.values);
            let apart = pairs.map(|(a, b)| (a[3] - b[3]).abs()).fold(0.0, f32::max);
            assert!(apart < 0.05, "{width}: {apart}");
        }
    });
}

#[test]
fn impossible_sizes_are_refused() {
    on_gpu(|gpu| {
        let loaded = drawn(LINES, &[[-1.0, 0.0, -2.0], [1.0, 0.0, -2.0]]);
        let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
        let prepared = gpu.upload(SceneRequest::new(&loaded.scene, &pose)).unwrap();
        for line_width in [0.0, -1.0, f32::NAN, 1e4] {
            let refused = gpu.prepare(&prepared, &by_lines(line_width));
            assert!(matches!(refused, Err(RenderError::Stroke(_))), "{line_width}");
        }
    });
}
