//! Alpha maps of a host, compared with scenes of files that have the same maps.

use super::farthest;
use super::machine::{Base, Machine};
use super::world::{Drawn, Map, Mesh, PLACED, Part, SIZE, Way, World};
use crate::stage::{NEAR, Stage, flat, ids, on_gpu, once, seen_at, textured};
use ash::vk;

use gpc::host::Options;
use gpc::render::{CellOptions, SuperpixelOptions};
use gpc::scene::{AlphaMode, Filter, Image, Sampler, Wrap};

const SIDE: u32 = 8;
const CUTOFF: f32 = 0.5;

/// White texels with irregular alpha.
fn texels() -> Vec<u8> {
    let alpha = |i: u32| (i * i * 37 + i * 11 + 90) as u8;
    let texel = |i: u32| [255, 255, 255, alpha(i)];
    (0..SIDE * SIDE).flat_map(texel).collect()
}

/// All mipmap levels of an image whose side is a power of two.
fn levels(image: Vec<u8>) -> Vec<Vec<u8>> {
    let mut levels = vec![image];
    let mut side = SIDE as usize;
    while side > 1 {
        let above = &levels[levels.len() - 1];
        let half = side / 2;
        let mean = |i: usize| {
            let (x, y) = (2 * ((i / 4) % half), 2 * (i / 4 / half));
            let at = |x: usize, y: usize| u32::from(above[4 * (y * side + x) + i % 4]);
            let sum = at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1);
            ((sum + 2) / 4) as u8
        };
        let level = (0..4 * half * half).map(mean).collect();
        levels.push(level);
        side = half;
    }
    levels
}

/// A wall with leaves in front: a slanted one, whose map is magnified near and small far away, and a small one.
fn quads() -> [([[f32; 3]; 4], f32); 3] {
    let aslant = |x: f64, y: f64, distance: f64| seen_at([x * 0.9, y], distance, SIZE[1]);
    let square = |half: f64, distance: f64| {
        [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]]
            .map(|[x, y]| seen_at([x * half + 3.3, y * half - 2.1], distance, SIZE[1]))
    };
    [
        (square(60.0, 9.0), 0.0),
        ([aslant(-28.0, -20.0, 4.0), aslant(-31.0, 27.0, 0.7), aslant(30.0, 25.0, 0.8), aslant(27.0, -19.0, 5.0)], 3.3),
        (square(6.2, 0.6), 1.0),
    ]
}

const CORNERS: [[f32; 2]; 4] = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]];

pub fn stage(sampler: Sampler) -> Stage {
    let mask = AlphaMode::Mask { cutoff: CUTOFF };
    let mut stage = Stage::new(vec![flat([0.0, 0.0, 1.0, 1.0], AlphaMode::Opaque), textured(mask)]);
    let image = Image { width: SIDE, height: SIDE, pixels: texels() };
    stage.texture = Some((image, sampler));
    for (number, (corners, repeats)) in quads().into_iter().enumerate() {
        let first = stage.triangles.len();
        stage.add_quad(usize::from(number > 0), corners);
        let [a, b, c, d] = CORNERS.map(|corner| corner.map(|at| at * repeats - 0.2));
        stage.triangles[first].uvs = [a, b, c];
        stage.triangles[first + 1].uvs = [a, c, d];
    }
    stage
}

fn filter(filter: Filter) -> vk::Filter {
    match filter {
        Filter::Nearest => vk::Filter::NEAREST,
        Filter::Linear => vk::Filter::LINEAR,
    }
}

fn address(wrap: Wrap) -> vk::SamplerAddressMode {
    match wrap {
        Wrap::Repeat => vk::SamplerAddressMode::REPEAT,
        Wrap::MirroredRepeat => vk::SamplerAddressMode::MIRRORED_REPEAT,
        Wrap::ClampToEdge => vk::SamplerAddressMode::CLAMP_TO_EDGE,
    }
}

pub fn world(sampler: &Sampler) -> World {
    let mut camera = [[0.0; 4]; 4];
    (camera[0][0], camera[1][1]) = (1.0, -1.0);
    (camera[2][3], camera[3][2]) = (-1.0, NEAR as f32);
    let mesh = |(corners, repeats): ([[f32; 3]; 4], f32)| Mesh {
        positions: corners.to_vec(),
        paints: vec![1.0; 4],
        coordinates: CORNERS.map(|corner| corner.map(|at| at * repeats - 0.2)).to_vec(),
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    };
    let part = |number: usize| Part {
        mesh: number,
        to_clip: camera,
        color: if number == 0 { [0.0, 0.0, 1.0] } else { [1.0; 3] },
        opacity: 1.0,
        alpha_map: (number > 0).then_some(1),
    };
    let map = |levels: Vec<Vec<u8>>, side| Map {
        side,
        levels,
        mag_filter: filter(sampler.mag),
        min_filter: filter(sampler.min),
        mipmap_mode: match sampler.mip {
            Some(Filter::Nearest) => vk::SamplerMipmapMode::NEAREST,
            _ => vk::SamplerMipmapMode::LINEAR,
        },
        address: [sampler.wrap_u, sampler.wrap_v].map(address),
        cutoff: CUTOFF,
    };
    World {
        meshes: quads().map(mesh).into(),
        parts: (0..3).map(part).collect(),
        // The first map is not used.
        maps: vec![map(vec![vec![7; 4]], 1), map(levels(texels()), SIDE)],
        projection: camera,
    }
}

#[test]
fn alpha_maps_are_tested_as_those_of_files() {
    on_gpu(|gpu| {
        let object = Way { object_space: true, stride: 12, short_indices: true, ..PLACED };
        for sampler in [
            Sampler::default(),
            Sampler { wrap_u: Wrap::ClampToEdge, wrap_v: Wrap::MirroredRepeat, ..Sampler::default() },
            Sampler { mag: Filter::Nearest, mip: Some(Filter::Nearest), ..Sampler::default() },
            Sampler { min: Filter::Nearest, ..Sampler::default() },
        ] {
            let settings = once(SIZE).method(SuperpixelOptions::new(CellOptions::DEFAULT_SAMPLES).thin(true));
            let stage = stage(sampler);
            let expected = stage.render(gpu, &settings);
            // A host that discards fragments itself draws these images.
            let own =
                Drawn { ids: ids(&expected), depths: vec![0.0; (SIZE[0] * SIZE[1]) as usize], colors: Vec::new() };
            let without_depth = settings.clone().map_superpixels(|options| options.thin(false));
            let expected_of_own = stage.render(gpu, &without_depth);
            let world = world(&sampler);
            let machine = Machine::new(gpu, &world);
            for (way, base, expected) in [
                (PLACED, Base::Nothing, &expected),
                (object, Base::Nothing, &expected),
                (object, Base::Ids(&own), &expected_of_own),
            ] {
                let lent = world.lent(&way);
                let options = Options::new(SIZE[0], SIZE[1]).thin(matches!(base, Base::Nothing));
                let found = machine.see_lent(&way, &lent, base, options);
                assert_eq!(found.outcome.left_over, 0);
                let superpixels = found.outcome.statistics.superpixels;
                assert_eq!(superpixels, expected.statistics.superpixels);
                let mixed = found.colors.iter().filter(|c| (0.1..0.9).contains(&c[0]));
                assert!(mixed.count() > 100, "{superpixels} superpixels");
                // The colours of the scene file come from a texture, which rounds them.
                let worst = farthest(&found.colors, &expected.colors);
                assert!(worst < 1e-6, "{sampler:?}, {way:?}: {worst}");
            }
        }
    });
}
