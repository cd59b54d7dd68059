//! Visibility samples that `merge` merges, compared with the twin, and images of merged samples.

use ash::vk;
use gpc::render::{Headless, Settings, Shading, Shadows};
use gpc::testing::{
    Argument, Cells, Counter, Data, FragmentRate, FrameUniform, LongLists, MemoryUse, Random, Recorder, ResourceSizes,
    SampleBlocks, SampleOptions, memory, merge_pass, triangles_of,
};
use twins::merge::{Merged, Sample, merged};

use crate::bare::{Bare, copy};
use crate::rounds::render;
use crate::scenes::ball_over_checker;
use crate::stage::on_gpu;
use crate::submit::submit;

const SIZE: [u32; 2] = [24, 12];
const TILES: u32 = 9;
/// Number of triangles.
const TRIANGLES: u32 = 40;
/// What a header says of a block that was left, as in `shaders/include/frame.glsl`.
const LEFT_BLOCK: u32 = 1 << 31;

/// A block of a cell's samples; `None` if the kernel before had no room for it.
type Block = Option<Vec<Sample>>;

fn sample(random: &mut Random, triangles: u64, lights: u64) -> Sample {
    Sample {
        triangle: random.below(triangles + 1) as u32 * TRIANGLES / triangles as u32,
        shadows: random.below(lights) as u32 * 0x4000_0001,
        offset: [0, 1].map(|_| random.below(4096) as i32 - 2048),
    }
}

/// Word of a place without the side of its square.
fn place(offset: [i32; 2]) -> u32 {
    (offset[0] & 0xfff) as u32 | ((offset[1] & 0xfff) as u32) << 12
}

fn offset_of(place: u32) -> [f64; 2] {
    [place << 20, place << 8].map(|bits| f64::from(bits as i32 >> 20))
}

/// What the device makes of the blocks of cells: for each block, its fragments and their shadow words.
fn run(gpu: &Headless, masks: &[u32], cells: &[Vec<Block>], samples: u32) -> Vec<Vec<([u32; 4], u32)>> {
    let limits = gpu.gpu().limits();
    let capacity = 200_000;
    let sizes = ResourceSizes { fragment_capacity: capacity, shadow_words: 1, ..ResourceSizes::new(SIZE, 1, limits) };
    // The kernel of triangles with one part reads none.
    let format = vk::Format::R32G32B32A32_UINT;
    // SAFETY: as for `Bare`; the buffer outlives the commands.
    let memory = unsafe { memory(gpu.gpu(), None) };
    let usage = vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER;
    let unread = memory.texel_buffer("unread", 1, format, usage, MemoryUse::Device).unwrap();
    let bare = Bare::with(gpu, sizes, samples, &triangles_of(&unread));
    let options = SampleOptions {
        cells: Cells::Pixels,
        samples,
        lines: false,
        fragments: FragmentRate::Sample,
        one_cell: false,
        long_lists: LongLists::SeveralCells,
        samples_unlisted: false,
        has_mask: false,
        has_blend: false,
        always_blends: false,
        spread: None,
    };
    let blocks = SampleBlocks::new(limits.teams, options);
    let merge = merge_pass(&bare.layout, &bare.resources, &blocks).unwrap();

    let pixels = SIZE[0] * SIZE[1];
    let (mut headers, mut fragments, mut shadows) = (Vec::new(), Vec::new(), vec![0; pixels as usize]);
    let (mut tiles, mut entries, mut first_cell) = (Vec::new(), Vec::new(), 0);
    for (tile, mask) in masks.iter().enumerate() {
        tiles.push([0, 0, headers.len() as u32, 0]);
        let count = mask.count_ones();
        entries.extend((0..count.div_ceil(limits.teams.members)).map(|part| (tile as u32) << 3 | part));
        for cell in &cells[first_cell..first_cell + count as usize] {
            for block in cell {
                let block = block.as_deref();
                headers.push(block.map_or([7, LEFT_BLOCK], |block| [fragments.len() as u32, block.len() as u32]));
                for sample in block.unwrap_or_default() {
                    fragments.push([tile as u32, sample.triangle, place(sample.offset), 1_f32.to_bits()]);
                    shadows.push(sample.shadows);
                }
            }
        }
        first_cell += count as usize;
    }
    let mut counters = [0; Counter::COUNT];
    counters[Counter::PlainTiles as usize] = entries.len() as u32;
    let mut arguments = [0; 4 * Argument::Shade as usize];
    let groups = (entries.len() as u32).div_ceil(limits.teams.in_workgroup);
    arguments[4 * Argument::ResolvePlain as usize..][..4].copy_from_slice(&[groups, 1, 1, 0]);
    let upload = |bytes: &[u8]| bare.memory.upload("upload", bytes).unwrap();
    let uploads = [
        (upload(bytemuck::cast_slice(masks)), Data::Masks),
        (upload(bytemuck::cast_slice(&tiles)), Data::Tiles),
        (upload(bytemuck::cast_slice(&entries)), Data::TileLists),
        (upload(bytemuck::cast_slice(&headers)), Data::Headers),
        (upload(bytemuck::cast_slice(&fragments)), Data::Fragments),
        (upload(bytemuck::cast_slice(&shadows)), Data::ShadowWords),
        (upload(bytemuck::cast_slice(&counters)), Data::Counters),
        (upload(bytemuck::cast_slice(&arguments)), Data::Arguments),
    ];
    let uniform = FrameUniform {
        size: SIZE,
        tiles: [3, 3],
        triangle_count: TRIANGLES,
        sample_count: samples,
        fragment_capacity: capacity,
        ..FrameUniform::default()
    };
    let resources = &bare.resources;
    let kept = [Data::Headers, Data::Fragments, Data::ShadowWords].map(|data| bare.like(resources.buffer(data)));
    submit(gpu.gpu(), |commands| {
        // SAFETY: the commands are waited for, and everything to which they refer outlives them.
        let recorder = || unsafe { Recorder::new(gpu.gpu(), commands, None) };
        let set = resources.set(0).unwrap();
        resources.record_upload(&recorder());
        resources.record_begin(&recorder(), set, &uniform);
        for (upload, data) in &uploads {
            copy(gpu, commands, upload, resources.buffer(*data));
        }
        {
            let recorder = recorder();
            set.show(&recorder);
            merge.record(&recorder);
        }
        for (kept, data) in kept.iter().zip([Data::Headers, Data::Fragments, Data::ShadowWords]) {
            copy(gpu, commands, resources.buffer(data), kept);
        }
    });
    let [made, merged_fragments, words] = kept;
    let made: &[[u32; 2]] = made.read(headers.len()).unwrap();
    let merged_fragments: &[[u32; 4]] = merged_fragments.read(fragments.len()).unwrap();
    let words: &[u32] = words.read(shadows.len()).unwrap();
    let block = |(made, asked): (&[u32; 2], &[u32; 2])| {
        assert_eq!(made[0], asked[0]);
        if asked[1] == LEFT_BLOCK {
            assert_eq!(made[1], LEFT_BLOCK);
            return Vec::new();
        }
        let all = &merged_fragments[asked[0] as usize..][..asked[1] as usize];
        let (used, unused) = all.split_at(made[1] as usize);
        assert!(unused.iter().all(|fragment| fragment[1] == 0), "{unused:?}");
        used.iter().copied().zip(words[(pixels + asked[0]) as usize..].iter().copied()).collect()
    };
    made.iter().zip(&headers).map(block).collect()
}

/// Asserts that a fragment is what the twin makes of its samples, of `all` of the cell.
fn assert_is(found: ([u32; 4], u32), expected: &Merged, all: u32, what: &str) {
    let ([_, triangle, place, weight], shadows) = found;
    assert_eq!((triangle, shadows), (expected.triangle, expected.shadows), "{what}");
    assert_eq!(f32::from_bits(weight), expected.samples as f32, "{what}");
    let offset = offset_of(place);
    let near = (0..2).all(|axis| (offset[axis] - expected.offset[axis].min(2047.0)).abs() < 0.501);
    assert!(near, "{what}: {offset:?} {expected:?}");
    let side = -8.0 * (f64::from(expected.samples) / f64::from(all)).log2();
    assert!((f64::from(place >> 24 & 127) - side.min(127.0)).abs() < 0.501, "{what}: {place:x} {expected:?}");
}

#[test]
fn samples_are_merged_as_the_twin_does() {
    on_gpu(|gpu| {
        let mut random = Random::new(5);
        for samples in [4, 16, 64, 100, 256] {
            let masks: Vec<u32> = (0..TILES).map(|_| (random.bits() & random.bits()) as u32).collect();
            let count: u32 = masks.iter().map(|mask| mask.count_ones()).sum();
            let block = |random: &mut Random, length: u32| {
                let (triangles, lights) = (1 + random.below(6), 1 + random.below(4));
                (random.below(20) != 0).then(|| (0..length).map(|_| sample(random, triangles, lights)).collect())
            };
            let mut cell =
                || (0..samples).step_by(64).map(|first| block(&mut random, (samples - first).min(64))).collect();
            let cells: Vec<Vec<Block>> = (0..count).map(|_| cell()).collect();
            let found = run(gpu, &masks, &cells, samples);
            for (number, (found, block)) in found.iter().zip(cells.iter().flatten()).enumerate() {
                let what = format!("{samples} samples, block {number}");
                let expected = merged(block.as_deref().unwrap_or_default());
                assert_eq!(found.len(), expected.len(), "{what}");
                for (found, expected) in found.iter().zip(&expected) {
                    assert_is(*found, expected, samples, &what);
                }
            }
        }
    });
}

/// Where light is the same all over a triangle's share of a pixel, merged samples have the colour of single ones.
#[test]
fn merged_samples_look_like_single_ones() {
    on_gpu(|gpu| {
        let stage = ball_over_checker();
        let image = |gpu: &mut Headless, shading| {
            let settings =
                Settings::new(200, 150).shadows(Shadows::Exact).map_superpixels(|options| options.shading(shading));
            render(gpu, &stage, &settings).colors
        };
        let single = image(gpu, Shading::Sample);
        for shading in [Shading::Triangle, Shading::Part] {
            let merged = image(gpu, shading);
            let pairs = single.as_flattened().iter().zip(merged.as_flattened());
            let squares: f64 = pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum();
            let rmse = (squares / single.as_flattened().len() as f64).sqrt();
            assert!(rmse > 0.0 && rmse < 2e-3, "{shading:?}: {rmse}");
        }
    });
}
