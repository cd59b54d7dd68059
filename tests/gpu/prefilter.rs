//! Reflection of environments: `prefilter`, compared with its twin and with closed forms.

use glam::DVec3;
use gpc::render::Headless;
use gpc::testing::prefilter::{Prefilter, levels, lobe};
use gpc::testing::{MemoryUse, Recorder, frame_layout, memory};
use half::f16;
use twins::prefilter::{Cube, average};

use crate::stage::on_gpu;
use crate::submit::submit;

/// Side of the finest cube's faces, in texels.
const SIDE: u32 = 32;

/// A cube and its halves down to one texel a face, in colours that half floats represent.
fn cubes(color: impl Fn(u32, DVec3) -> DVec3) -> Vec<Cube> {
    (0..=SIDE.ilog2())
        .map(|level| {
            let side = SIDE >> level;
            let texels = (0..6 * side * side).map(|i| {
                let color = color(level, Cube::direction(side, i));
                color.to_array().map(|x| f64::from(f16::from_f64(x))).into()
            });
            Cube { side, texels: texels.collect() }
        })
        .collect()
}

/// Ratio of a texel's solid angle to that of a texel in the middle of a face.
fn solid_angle(side: u32, index: u32) -> f64 {
    Cube::direction(side, index).abs().max_element().powi(3)
}

/// A cube of half the side, whose texels are averages.
fn halved(fine: &Cube) -> Cube {
    let side = fine.side / 2;
    let texel = |i: u32| {
        let (row, column) = (i / side, i % side);
        let first = 2 * (row * fine.side + column);
        let four = [first, first + 1, first + fine.side, first + fine.side + 1];
        let weights = four.map(|i| solid_angle(fine.side, i));
        let sum = |total: DVec3, (i, weight): (u32, f64)| total + fine.texels[i as usize] * weight;
        four.into_iter().zip(weights).fold(DVec3::ZERO, sum) / weights.iter().sum::<f64>()
    };
    Cube { side, texels: (0..6 * side * side).map(texel).collect() }
}

/// Filtered levels, from the first that is not the finest cube itself.
fn filtered(gpu: &Headless, cubes: &[Cube]) -> Vec<Cube> {
    let mut texels: Vec<[f16; 4]> = Vec::new();
    for texel in cubes.iter().flat_map(|cube| &cube.texels) {
        texels.push(texel.extend(1.0).to_array().map(f16::from_f64));
    }
    let levels: Vec<_> = levels(SIDE).collect();
    let (side, first) = levels[levels.len() - 1];
    texels.resize((first + 6 * side * side) as usize, [f16::ZERO; 4]);
    // SAFETY: the buffer holds all levels, and is read once the commands have run.
    let (layout, memory) = unsafe { (frame_layout(gpu.gpu()).unwrap(), memory(gpu.gpu(), None)) };
    let bytes: &[u8] = bytemuck::cast_slice(&texels);
    let usage = ash::vk::BufferUsageFlags::STORAGE_BUFFER;
    let mut buffer = memory.buffer("texels", bytes.len() as u64, usage, MemoryUse::Readback).unwrap();
    buffer.bytes_mut()[..bytes.len()].copy_from_slice(bytes);
    let prefilter = Prefilter::new(&layout, &memory, buffer, SIDE).unwrap();
    submit(gpu.gpu(), |commands| {
        // SAFETY: the commands are waited for, and the buffers outlive them.
        let recorder = unsafe { Recorder::new(gpu.gpu(), commands, None) };
        prefilter.record(&recorder);
    });
    let texels: &[[f16; 4]] = prefilter.texels().read(texels.len()).unwrap();
    let cube = |&(side, first): &(u32, u32)| Cube {
        side,
        texels: texels[first as usize..(first + 6 * side * side) as usize]
            .iter()
            .map(|texel| texel.map(f64::from))
            .map(|[r, g, b, _]| DVec3::new(r, g, b))
            .collect(),
    };
    levels[1..].iter().map(cube).collect()
}

/// Rays of the levels around +z, in the order of [`filtered`].
fn lobes(count: usize) -> impl Iterator<Item = Vec<[f32; 4]>> {
    (1..=count as u32).map(move |level| lobe(level, count as u32, SIDE))
}

/// Every texel of every level equals the twin's, for unrelated colours from one ten-thousandth to ten thousand.
#[test]
fn every_texel_is_the_twins() {
    on_gpu(|gpu| {
        let sources = cubes(|level, d| {
            let mut state = (d * 1e4).to_array().map(|x| x as i64 as u64);
            state.iter_mut().for_each(|x| {
                *x = (*x + u64::from(level) + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
                *x = (*x ^ (*x >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9) >> 40;
            });
            DVec3::from_array(state.map(|x| 10.0_f64.powf(x as f64 / f64::from(1 << 21) - 4.0)))
        });
        let found = filtered(gpu, &sources);
        assert_eq!(found.len(), 5);
        for (cube, rays) in found.iter().zip(lobes(found.len())) {
            for (i, texel) in (0..).zip(&cube.texels) {
                let expected = average(&sources, &rays, Cube::direction(cube.side, i));
                // A half float has 11 bits, and drivers may round either way.
                let off = ((texel - expected) / expected).abs().max_element();
                assert!(off < 1.2 / 1024.0, "{} a side, texel {i}: {texel}, expected {expected}", cube.side);
            }
        }
    });
}

#[test]
fn what_is_alike_all_around_stays_so() {
    on_gpu(|gpu| {
        let color = DVec3::new(0.5, 1.0, 40.0);
        for cube in filtered(gpu, &cubes(|_, _| color)) {
            for texel in cube.texels {
                assert!(((texel - color) / color).abs().max_element() < 1e-3, "{texel}");
            }
        }
    });
}

/// In an environment with radiance 1 + d.v, a surface with normal n reflects 1 + s n.v, where s is the mean of n.l
/// over its lobe: two thirds for the roughest one, like a matt surface.
#[test]
fn a_sky_brighter_to_one_side_has_a_closed_form() {
    on_gpu(|gpu| {
        let towards = DVec3::new(0.48, 0.64, -0.6);
        let found = filtered(gpu, &cubes(|_, d| DVec3::splat(1.0 + d.dot(towards))));
        let mut expected = 0.0;
        for (cube, rays) in found.iter().zip(lobes(found.len())) {
            let sum = |power: i32| rays.iter().map(|ray| f64::from(ray[2]).powi(power)).sum::<f64>();
            expected = sum(2) / sum(1);
            for (i, texel) in (0..).zip(&cube.texels) {
                let expected = 1.0 + expected * Cube::direction(cube.side, i).dot(towards);
                let off = (texel.x - expected).abs();
                assert!(off < 0.03, "{} a side: {texel}, expected {expected}", cube.side);
            }
        }
        assert!((expected - 2.0 / 3.0).abs() < 1e-3, "{expected}");
    });
}

/// A single bright texel causes no fireflies: rough levels show it as one smooth hill with the same total light.
#[test]
fn a_small_light_makes_no_sparks() {
    on_gpu(|gpu| {
        // The texel is straight ahead along -z.
        let mut sources = cubes(|_, d| {
            let place = (d / -d.z).truncate() - 1.0 / f64::from(SIDE);
            let lit = d.z < 0.0 && place.abs().max_element() < 1.0 / f64::from(SIDE);
            DVec3::splat(if lit { 1e4 } else { 0.0 })
        });
        for level in 1..sources.len() {
            sources[level] = halved(&sources[level - 1]);
        }
        let mean = |cube: &Cube| {
            let texels = (0..).zip(&cube.texels);
            let (sum, weights) = texels.fold((0.0, 0.0), |(sum, weights), (i, texel)| {
                let weight = solid_angle(cube.side, i);
                (sum + texel.x * weight, weights + weight)
            });
            sum / weights
        };
        let expected = mean(&sources[0]);
        assert!(expected > 0.0);
        for cube in &filtered(gpu, &sources)[1..] {
            let found = mean(cube);
            assert!((found / expected - 1.0).abs() < 0.25, "{found}, expected {expected}");
            // Along the row of the light, the values rise towards it and fall after it.
            let start = (5 * cube.side + cube.side / 2) * cube.side;
            let row: Vec<_> = (start..start + cube.side).map(|i| cube.texels[i as usize].x).collect();
            let peak = row.iter().copied().fold(0.0, f64::max);
            let turns =
                row.windows(3).filter(|w| (w[1] - w[0]) * (w[2] - w[1]) < 0.0 && (w[1] - w[0]).abs() > 0.02 * peak);
            assert!(turns.count() <= 1, "{row:?}");
        }
    });
}
