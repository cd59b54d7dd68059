//! Regions of an image have the same values as in the whole image.

use gpc::render::{
    EngineError, Headless, MethodKind, PixelRect, RenderError, Rendered, SceneRequest, Settings, Shading,
    SuperpixelOptions,
};
use gpc::scene::{AlphaMode, Material};

use crate::devices::within;
use crate::meshes::Random;
use crate::scenes::ball_over_checker;
use crate::stage::{Stage, as_cpu, as_gpu, camera, flat, on_gpu, seen_at};

const SIZE: [u32; 2] = [157, 113];

/// Regions at odd places with odd sizes: among them a single pixel, a column, and the whole image.
const REGIONS: [([u32; 2], [u32; 2]); 6] = [
    ([0, 0], [157, 113]),
    ([17, 29], [61, 43]),
    ([3, 50], [150, 5]),
    ([79, 0], [1, 113]),
    ([101, 71], [56, 42]),
    ([88, 57], [1, 1]),
];

fn region(corner: [u32; 2], size: [u32; 2]) -> PixelRect {
    PixelRect { corner, size }
}

/// A lit scene with wires, and a pane of glass in front.
fn behind_glass() -> Stage {
    let mut stage = ball_over_checker();
    let glass = stage.materials.len();
    stage.materials.push(Material { double_sided: true, ..flat([0.3, 0.6, 0.9, 0.4], AlphaMode::Blend) });
    stage.add_quad(glass, [[-0.2, -0.5, -1.4], [0.6, -0.45, -1.5], [0.7, 0.5, -1.6], [-0.1, 0.4, -1.5]]);
    stage
}

fn render(gpu: &mut Headless, stage: &Stage, settings: &Settings) -> Rendered {
    let (scene, pose) = stage.build();
    let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
    let mut frame = gpu.prepare(&prepared, settings).unwrap();
    gpu.render(&mut frame, &camera()).unwrap()
}

/// Part of an image, row by row.
fn part<T: Copy>(values: &[T], row: u32, region: PixelRect) -> Vec<T> {
    let ([left, top], [width, height]) = (region.corner, region.size);
    (top..top + height)
        .flat_map(|y| {
            let first = (y * row + left) as usize;
            values[first..first + width as usize].iter().copied()
        })
        .collect()
}

fn assert_regions_are_parts(
    gpu: &mut Headless,
    stage: &Stage,
    settings: &Settings,
    regions: &[([u32; 2], [u32; 2])],
    what: &str,
) {
    let whole = render(gpu, stage, settings);
    let row = whole.size[0];
    for (corner, size) in regions.iter().copied() {
        let wanted = region(corner, size);
        let settings = settings.clone().region(Some(wanted));
        let image = render(gpu, stage, &settings);
        assert_eq!(image.size, size);
        assert!(image.colors == part(&whole.colors, row, wanted), "{what}: colours of {wanted:?}");
        if settings.attributes {
            assert!(image.attributes == part(&whole.attributes, row, wanted), "{what}: attributes of {wanted:?}");
            let superpixels = |pixel: &gpc::render::PixelAttributes| pixel.superpixel == 1;
            assert_eq!(
                image.statistics.superpixels as usize,
                image.attributes.iter().copied().filter(superpixels).count(),
                "{what}: superpixels of {wanted:?}"
            );
        }
    }
}

#[test]
fn a_region_is_that_part_of_the_image() {
    on_gpu(|gpu| {
        let methods = [
            (MethodKind::None, 1, Shading::Part),
            (MethodKind::Superpixel, 16, Shading::Part),
            (MethodKind::Superpixel, 256, Shading::Sample),
            (MethodKind::Ssaa, 4, Shading::Part),
            (MethodKind::Msaa, 4, Shading::Part),
        ];
        for (name, stage) in [("ball", ball_over_checker()), ("glass", behind_glass())] {
            for (method, samples, shading) in methods {
                let settings = Settings::new(SIZE[0], SIZE[1])
                    .attributes(method != MethodKind::Msaa)
                    .method(method.with_samples(samples))
                    .map_superpixels(|options| options.shading(shading));
                let what = format!("{name}, {method:?} of {samples}");
                assert_regions_are_parts(gpu, &stage, &settings, &REGIONS, &what);
            }
        }
    });
}

/// Small triangles that lie denser to the right: the lists of some tiles have more than a thousand, and a pixel may see none or
/// more than a kernel has room for.
fn crowd() -> Stage {
    let mut random = Random::new(8);
    let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
    for number in 0..40_000_u32 {
        let across = random.range(0.0, 1.0).sqrt().sqrt();
        let middle = [60.0 * across - 30.0, random.range(-20.0, 20.0)];
        let side = if number % 200 == 0 { 6.0 } else { 0.6 };
        let depth = random.range(2.0, 9.0);
        let corners = [0, 1, 2].map(|_| {
            let place = middle.map(|at| at + side * random.range(-1.0, 1.0));
            seen_at(place, depth, CROWDED[1])
        });
        stage.add(0, corners);
        let color = [0, 1, 2].map(|_| random.range(0.0, 1.0) as f32);
        if let Some(triangle) = stage.triangles.last_mut() {
            triangle.color = [color[0], color[1], color[2], 1.0];
        }
    }
    stage
}

/// Opaque triangles and a few BLEND ones that are smaller than a tile.
fn panes() -> Stage {
    let mut random = Random::new(12);
    let glass = Material { double_sided: true, ..flat([1.0, 1.0, 1.0, 0.4], AlphaMode::Blend) };
    let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque), glass]);
    for number in 0..400_u32 {
        let material = usize::from(number >= 350);
        let middle = [random.range(-30.0, 30.0), random.range(-20.0, 20.0)];
        let side = if material == 1 { 1.5 } else { 5.0 };
        let depth = random.range(2.0, 9.0);
        let corners =
            [0, 1, 2].map(|_| seen_at(middle.map(|at| at + side * random.range(-1.0, 1.0)), depth, CROWDED[1]));
        stage.add(material, corners);
        let color = [0, 1, 2].map(|_| random.range(0.0, 1.0) as f32);
        if let Some(triangle) = stage.triangles.last_mut() {
            triangle.color = [color[0], color[1], color[2], 1.0];
        }
    }
    stage
}

const CROWDED: [u32; 2] = [64, 48];

/// Asserts that regions that cut tiles at random show the same as the image, whether a frame has rounds for a CPU or for a GPU.
fn assert_cut_tiles_are_parts(stage: &Stage) {
    let mut random = Random::new(3);
    let regions = [(); 8].map(|()| {
        let corner = CROWDED.map(|side| random.below(u64::from(side) - 1) as u32);
        let size = [0, 1].map(|axis| {
            let most = u64::from(CROWDED[axis] - corner[axis]);
            1 + random.below(most) as u32
        });
        (corner, size)
    });
    for (name, policy) in
        [("CPU", as_cpu as fn(&mut gpc::vulkan::Limits)), ("GPU", as_gpu as fn(&mut gpc::vulkan::Limits))]
    {
        within(policy, |gpu| {
            for samples in [16, 64] {
                let settings =
                    Settings::new(CROWDED[0], CROWDED[1]).attributes(true).method(SuperpixelOptions::new(samples));
                let what = format!("{name}, {samples} samples");
                assert_regions_are_parts(gpu, stage, &settings, &regions, &what);
            }
        });
    }
}

/// What a pixel is sampled by does not depend on how many triangles touch other pixels of its tile.
#[test]
fn regions_of_crowded_tiles_are_parts_of_the_image() {
    assert_cut_tiles_are_parts(&crowd());
}

/// Nor does it depend on whether a BLEND triangle touches them.
#[test]
fn regions_of_tiles_with_blend_triangles_are_parts_of_the_image() {
    assert_cut_tiles_are_parts(&panes());
}

/// A block with a needle at its right side, which is so thin that no pixel's centre sees it.
fn needle() -> Stage {
    let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
    let corners = |places: [[f64; 2]; 3]| places.map(|place| seen_at(place, 4.0, CROWDED[1]));
    stage.add(0, corners([[-20.0, -5.0], [-10.0, -5.0], [-10.0, 5.0]]));
    stage.add(0, corners([[-20.0, -5.0], [-10.0, 5.0], [-20.0, 5.0]]));
    stage.add(0, corners([[-10.0, 0.2], [20.0, 0.3], [-10.0, 0.4]]));
    stage
}

/// Each growth follows the needle by a pixel, so what a pixel is depends on one that is as far away as there are growths.
#[test]
fn regions_have_the_superpixels_of_all_growths() {
    on_gpu(|gpu| {
        let stage = needle();
        for options in [SuperpixelOptions::new(128), SuperpixelOptions::new(64).growths(Some(8))] {
            let settings = Settings::new(CROWDED[0], CROWDED[1]).attributes(true).method(options.clone().thin(false));
            let whole = render(gpu, &stage, &settings);
            let last = region([22 + options.growth_count(), 24], [1, 1]);
            assert_eq!(part(&whole.attributes, CROWDED[0], last)[0].superpixel, 1, "the growths end before");
            let regions = [(last.corner, [8, 4]), (last.corner, [1, 1])];
            assert_regions_are_parts(gpu, &stage, &settings, &regions, "needle");
        }
    });
}

/// A large image is rendered in parts; a region may span several of them.
#[test]
fn a_region_of_an_image_in_parts_is_that_part_of_it() {
    on_gpu(|gpu| {
        let stage = ball_over_checker();
        let settings = Settings::new(2600, 1700).method(SuperpixelOptions::new(4));
        let regions = [([1297, 801], [151, 203]), ([1299, 0], [3, 1700])];
        assert_regions_are_parts(gpu, &stage, &settings, &regions, "in parts");
        let across = settings.region(Some(region([1297, 801], [151, 203])));
        let parts = render(gpu, &stage, &across).statistics.regions;
        assert!(parts > 1, "{parts} parts");
    });
}

#[test]
fn impossible_regions_are_refused() {
    on_gpu(|gpu| {
        let stage = ball_over_checker();
        let prepared = stage.upload(gpu);
        for (corner, size) in [([150, 0], [8, 8]), ([0, 113], [1, 1]), ([0, 0], [0, 4]), ([1, 1], [u32::MAX, 1])] {
            let settings = Settings::new(SIZE[0], SIZE[1]).region(Some(region(corner, size)));
            let refused = gpu.prepare(&prepared, &settings).err().unwrap();
            assert!(matches!(refused, RenderError::Engine(EngineError::Region { .. })), "{refused}");
        }
        let settings = Settings::new(SIZE[0], SIZE[1]).region(Some(region([0, 0], [8, 8])));
        let refused = gpu.render_locations(&prepared, &[], &settings);
        assert!(matches!(refused, Err(RenderError::LocationRegion)));
    });
}
