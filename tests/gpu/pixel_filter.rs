//! Pixel filters, compared with the twin.

use gpc::camera::SampleLocation;
use gpc::render::{Detection, Headless, Method, MethodKind, PixelRect, Reference, Rendered, Settings, Shading};
use gpc::sampling::{FilterShape, Pattern, PixelFilter};
use gpc::scene::{AlphaMode, Material};
use twins::pixel_filter::filtered;

use crate::locations::{pinhole, planar};
use crate::scenes::{ball_over_checker, layered};
use crate::stage::{Stage, flat, on_gpu, seen_at};

const SIZE: [u32; 2] = [45, 37];

const SHAPES: [FilterShape; 4] =
    [FilterShape::Tent, FilterShape::Gaussian, FilterShape::Mitchell, FilterShape::BlackmanHarris];

/// A flat triangle in pixels from the image's upper left corner, y down.
struct Flat {
    corners: [[f64; 2]; 3],
    color: [f64; 4],
}

impl Flat {
    fn contains(&self, [x, y]: [f64; 2]) -> bool {
        let [a, b, c] = self.corners;
        let side = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| (bx - ax) * (y - ay) - (by - ay) * (x - ax);
        let sides = [side(a, b), side(b, c), side(c, a)];
        sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
    }
}

/// Triangles from the farthest on: broad ones, wires, and a fan whose blades are thinner than a pixel.
fn triangles(last: AlphaMode) -> Vec<Flat> {
    let mut all = vec![
        Flat { corners: [[-3.0, 2.3], [30.4, 9.1], [7.2, 33.9]], color: [0.9, 0.2, 0.1, 1.0] },
        Flat { corners: [[12.1, -4.0], [49.0, 14.8], [21.7, 30.2]], color: [0.1, 0.7, 0.3, 1.0] },
        Flat { corners: [[2.0, 34.1], [43.3, 20.6], [43.6, 21.2]], color: [1.0, 1.0, 0.9, 1.0] },
        Flat { corners: [[39.2, 1.4], [40.1, 36.0], [40.9, 36.0]], color: [0.05, 0.05, 0.2, 1.0] },
    ];
    for blade in 0..6 {
        let angle = f64::from(blade) * 0.31 + 0.11;
        let tip = |angle: f64| [24.3 - 19.0 * angle.cos(), 35.1 - 19.0 * angle.sin()];
        all.push(Flat { corners: [[24.3, 35.1], tip(angle), tip(angle + 0.03)], color: [1.0, 0.8, 0.2, 1.0] });
    }
    if last == AlphaMode::Blend {
        all.push(Flat { corners: [[9.3, 8.7], [36.1, 11.9], [17.0, 29.3]], color: [0.2, 0.4, 1.0, 0.6] });
    }
    all
}

fn stage_of(triangles: &[Flat]) -> Stage {
    let mut stage = Stage::new(Vec::new());
    for (number, triangle) in triangles.iter().enumerate() {
        let mode = if triangle.color[3] < 1.0 { AlphaMode::Blend } else { AlphaMode::Opaque };
        let color = triangle.color.map(|channel| channel as f32);
        stage.materials.push(Material { double_sided: true, ..flat(color, mode) });
        let distance = 9.0 - 0.5 * number as f64;
        let middle = SIZE.map(|side| f64::from(side) / 2.0);
        let corner = |[x, y]: [f64; 2]| seen_at([x - middle[0], y - middle[1]], distance, SIZE[1]);
        stage.add(number, triangle.corners.map(corner));
    }
    stage
}

/// Light at a place over a background: premultiplied.
fn light(triangles: &[Flat], background: [f64; 4], at: [f64; 2]) -> [f64; 4] {
    triangles.iter().filter(|triangle| triangle.contains(at)).fold(background, |behind, triangle| {
        let [r, g, b, alpha] = triangle.color;
        let own = [r * alpha, g * alpha, b * alpha, alpha];
        [0, 1, 2, 3].map(|channel| own[channel] + (1.0 - alpha) * behind[channel])
    })
}

fn settings(filter: impl Into<PixelFilter>) -> Settings {
    Settings::new(SIZE[0], SIZE[1])
        .reference(Reference::Scene { tonemapped_detection: false })
        .pixel_filter(filter.into())
}

/// Root of the mean square and the largest of the differences of an image from what is expected.
fn differences(image: &Rendered, expected: &[[f64; 4]]) -> [f64; 2] {
    assert_eq!(image.colors.len(), expected.len());
    let pairs = image.colors.as_flattened().iter().zip(expected.as_flattened());
    let all: Vec<f64> = pairs.map(|(found, expected)| (f64::from(*found) - expected).abs()).collect();
    let squares: f64 = all.iter().map(|difference| difference * difference).sum();
    [(squares / all.len() as f64).sqrt(), all.into_iter().fold(0.0, f64::max)]
}

/// Asserts that an image differs from the twin's by at most these [`differences`].
fn assert_near(image: &Rendered, expected: &[[f64; 4]], most: [f64; 2], what: &str) {
    let found = differences(image, expected);
    assert!(found[0] <= most[0] && found[1] <= most[1], "{what}: {found:?} instead of at most {most:?}");
}

/// Each pixel of an image of one sample is of one colour everywhere.
#[test]
fn pixels_of_one_sample_are_filtered_as_the_twin_does() {
    on_gpu(|gpu| {
        let stage = stage_of(&triangles(AlphaMode::Opaque));
        let plain = stage.render(gpu, &settings(PixelFilter::BOX).method(Method::None));
        let color = |[x, y]: [f64; 2]| plain.colors[(y as u32 * SIZE[0] + x as u32) as usize].map(f64::from);
        for shape in SHAPES {
            for radius in [0.7, 1.0, 1.5, shape.default_radius(), 2.5] {
                let filter = PixelFilter::from(shape).with_radius(radius);
                let image = stage.render(gpu, &settings(filter).method(Method::None));
                let expected = filtered(SIZE, (shape, radius), 60, color);
                assert_near(&image, &expected, [2e-4, 1e-3], &format!("{shape} of {radius}"));
            }
        }
    });
}

/// Methods that sample pixels more than once, and the error that each may have.
fn methods() -> Vec<(&'static str, Settings, [f64; 2])> {
    let every = |samples: u32| {
        settings(PixelFilter::BOX)
            .method(MethodKind::Superpixel.with_samples(samples))
            .map_superpixels(|options| options.detection(Detection::Every))
    };
    let detected = settings(PixelFilter::BOX).method(MethodKind::Superpixel.with_samples(64));
    let points = |samples: u32| every(samples).map_superpixels(|options| options.pattern(Pattern::Sobol));
    vec![
        ("ssaa", settings(PixelFilter::BOX).method(MethodKind::Ssaa.with_samples(256)), [0.003, 0.02]),
        ("accumulate", settings(PixelFilter::BOX).method(MethodKind::Accumulate.with_samples(256)), [0.005, 0.05]),
        ("lines of 64", every(64), [0.002, 0.02]),
        ("lines of 256", every(256), [0.002, 0.01]),
        ("lines of 1024", every(1024), [0.002, 0.01]),
        ("lines of detected superpixels", detected, [0.003, 0.03]),
        ("points of 64", points(64), [0.006, 0.05]),
        ("points of 256", points(256), [0.004, 0.03]),
        ("single samples", every(64).map_superpixels(|options| options.shading(Shading::Sample)), [0.006, 0.05]),
    ]
}

#[test]
fn samples_are_filtered_as_the_twin_does() {
    on_gpu(|gpu| {
        for (mode, background) in [(AlphaMode::Opaque, None), (AlphaMode::Blend, Some([0.3, 0.5, 0.8]))] {
            let triangles = triangles(mode);
            let stage = stage_of(&triangles);
            let behind = background.map_or([0.0; 4], |[r, g, b]: [f32; 3]| [r, g, b, 1.0].map(f64::from));
            for shape in SHAPES {
                let filter = PixelFilter::from(shape);
                let expected = filtered(SIZE, (shape, filter.radius), 48, |at| light(&triangles, behind, at));
                for (name, settings, most) in methods() {
                    let image = stage.render(gpu, &settings.background(background).pixel_filter(filter));
                    // A pane's samples are points.
                    let most = if mode == AlphaMode::Blend { most.map(|most| 2.0 * most) } else { most };
                    assert_near(&image, &expected, most, &format!("{name}, {shape}, {mode:?}"));
                }
            }
        }
    });
}

/// Superpixels of one colour stay of this colour, to the precision of 32-bit floating point.
#[test]
fn an_even_image_stays_even() {
    on_gpu(|gpu| {
        let color = [0.8, 0.4, 0.2, 1.0];
        let mut stage = Stage::new(vec![Material { double_sided: true, ..flat(color, AlphaMode::Opaque) }]);
        let corners = [[-90.0, -90.0], [-90.0, 90.0], [90.0, 90.0], [90.0, -90.0]];
        stage.add_quad(0, corners.map(|place| seen_at(place, 5.0, SIZE[1])));
        for shape in SHAPES {
            for shading in [Shading::Part, Shading::Sample] {
                let settings = settings(shape)
                    .method(MethodKind::Superpixel.with_samples(64))
                    .map_superpixels(|options| options.detection(Detection::Every).shading(shading));
                let image = stage.render(gpu, &settings);
                let far = |pixel: &[f32; 4]| pixel.iter().zip(color).any(|(found, color)| (found - color).abs() > 2e-6);
                assert_eq!(image.colors.iter().copied().find(far), None, "{shape}, {shading:?}");
            }
        }
    });
}

/// Negative lobes neither make alpha negative or greater than 1, nor change the colour of what covers a pixel.
#[test]
fn negative_lobes_keep_alpha_and_colour() {
    on_gpu(|gpu| {
        let color = [0.8, 0.4, 0.2];
        let one = [Flat { corners: [[4.2, 3.1], [40.3, 11.7], [15.0, 33.2]], color: [0.8, 0.4, 0.2, 1.0] }];
        let stage = stage_of(&one);
        for method in [MethodKind::Superpixel, MethodKind::Ssaa, MethodKind::Accumulate] {
            let image = stage.render(gpu, &settings(FilterShape::Mitchell).method(method.with_samples(64)));
            let mut opaque = 0;
            for pixel in &image.colors {
                let alpha = pixel[3];
                assert!((0.0..=1.0).contains(&alpha), "{method}: alpha {alpha}");
                opaque += u32::from(alpha == 1.0);
                if alpha > 0.05 {
                    let straight = [0, 1, 2].map(|channel| pixel[channel] / alpha);
                    let near = straight.iter().zip(color).all(|(found, color)| (found - color).abs() < 1e-3);
                    assert!(near, "{method}: {pixel:?}");
                }
            }
            assert!(opaque > 100, "{method}: {opaque} pixels are opaque");
        }
    });
}

fn render(gpu: &mut Headless, stage: &Stage, settings: &Settings) -> Rendered {
    stage.render(gpu, settings)
}

/// Regions equal that part of the whole image, and a second rendering equals the first.
#[test]
fn regions_are_parts_of_the_filtered_image() {
    const SIZE: [u32; 2] = [157, 113];
    const REGIONS: [([u32; 2], [u32; 2]); 4] =
        [([17, 29], [61, 43]), ([79, 0], [1, 113]), ([101, 71], [56, 42]), ([88, 57], [1, 1])];
    on_gpu(|gpu| {
        for (name, stage) in [("ball", ball_over_checker()), ("layers", layered())] {
            for (method, samples) in [
                (MethodKind::None, 1),
                (MethodKind::Superpixel, 16),
                (MethodKind::Superpixel, 64),
                (MethodKind::Ssaa, 4),
                (MethodKind::Accumulate, 4),
                (MethodKind::Msaa, 4),
            ] {
                for shape in [FilterShape::BlackmanHarris, FilterShape::Mitchell] {
                    let settings =
                        Settings::new(SIZE[0], SIZE[1]).method(method.with_samples(samples)).pixel_filter(shape.into());
                    let what = format!("{name}, {shape}, {method} of {samples}");
                    let whole = render(gpu, &stage, &settings);
                    assert!(render(gpu, &stage, &settings).colors == whole.colors, "{what}: again");
                    for (corner, size) in REGIONS {
                        let region = PixelRect { corner, size };
                        let image = render(gpu, &stage, &settings.clone().region(Some(region)));
                        let part: Vec<_> = (0..size[1])
                            .flat_map(|y| {
                                let first = ((corner[1] + y) * SIZE[0] + corner[0]) as usize;
                                whole.colors[first..first + size[0] as usize].iter().copied()
                            })
                            .collect();
                        assert!(image.colors == part, "{what}: {region:?}");
                    }
                }
            }
        }
    });
}

/// An image that memory divides into regions equals the one that is rendered at once.
#[test]
fn a_filtered_image_in_parts_is_the_same() {
    on_gpu(|gpu| {
        let stage = ball_over_checker();
        let settings = Settings::new(512, 400)
            .method(MethodKind::Superpixel.with_samples(16))
            .pixel_filter(FilterShape::Mitchell.into());
        let whole = render(gpu, &stage, &settings);
        let parts = render(gpu, &stage, &settings.max_memory(Some(24 << 20)));
        assert!(parts.statistics.regions > 1 && whole.statistics.regions == 1, "{}", parts.statistics.regions);
        let pairs = whole.colors.as_flattened().iter().zip(parts.colors.as_flattened());
        let farthest = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(farthest < 1e-5, "colours differ by {farthest}");
    });
}

#[test]
fn impossible_filters_are_refused() {
    on_gpu(|gpu| {
        let prepared = stage_of(&triangles(AlphaMode::Opaque)).upload(gpu);
        for filter in [PixelFilter::BOX.with_radius(1.0), PixelFilter::from(FilterShape::Tent).with_radius(3.0)] {
            let error = gpu.prepare(&prepared, &settings(filter)).err().unwrap();
            assert!(error.is_usage() && error.to_string().contains("radius"), "{error}");
        }
        let filter = PixelFilter::from(FilterShape::Tent).with_radius(3.0);
        let error = gpu.render_locations(&prepared, &[], &settings(filter)).err().unwrap();
        assert!(error.is_usage() && error.to_string().contains("radius"), "{error}");
    });
}

/// Locations whose output is the image mirrored at its diagonal.
fn turned([columns, rows]: [u32; 2]) -> Vec<SampleLocation> {
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| [column, row]));
    cells
        .zip(0..)
        .map(|([column, row], output)| SampleLocation {
            uv: [f64::from(row) + 0.5, f64::from(column) + 0.5],
            jacobian: [[0.0, 1.0], [1.0, 0.0]],
            output,
        })
        .collect()
}

#[test]
fn images_of_locations_are_filtered_as_the_twin_does() {
    on_gpu(|gpu| {
        let all = triangles(AlphaMode::Blend);
        let scene = stage_of(&all).upload(gpu);
        let size = [SIZE[1], SIZE[0]];
        for (name, method, most) in [
            ("every cell", MethodKind::Ssaa.with_samples(256), [0.004, 0.03]),
            ("detected superpixels", MethodKind::Superpixel.with_samples(64), [0.004, 0.04]),
        ] {
            for shape in SHAPES {
                let settings = settings(shape).size(size).method(method.clone());
                let image = gpu.render_locations(&scene, &[(pinhole(SIZE), turned(size))], &settings).unwrap();
                let expected =
                    filtered(size, (shape, shape.default_radius()), 60, |[x, y]| light(&all, [0.0; 4], [y, x]));
                assert_near(&image, &expected, most, &format!("{name}, {shape}"));
            }
        }
    });
}

/// Memory divides the locations into other runs, whose positions are rounded differently: colours differ by 0.003 with the box, too.
#[test]
fn images_of_locations_in_parts_are_the_same() {
    on_gpu(|gpu| {
        let size = [700, 500];
        let settings = settings(FilterShape::Mitchell).size(size);
        let scene = stage_of(&triangles(AlphaMode::Opaque)).upload(gpu);
        let rig = [(pinhole(size), planar(size))];
        let whole = gpu.render_locations(&scene, &rig, &settings).unwrap();
        // Bands have fewer rows.
        let limit = whole.statistics.memory_bytes / 2;
        let parts = gpu.render_locations(&scene, &rig, &settings.max_memory(Some(limit))).unwrap();
        let pairs = whole.colors.as_flattened().iter().zip(parts.colors.as_flattened());
        let farthest = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(farthest < 0.005, "colours differ by {farthest}");
    });
}
