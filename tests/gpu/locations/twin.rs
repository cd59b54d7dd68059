//! Results at locations, compared with the exact twin.

use gpc::camera::SampleLocation;
use gpc::render::Shading;
use gpc::sampling::Pattern;
use twins::sample_lines;

use super::{location, pinhole, planar};
use crate::meshes::Random;
use crate::stage::{cells, code, everywhere, on_gpu};
use crate::twin::Twin;
use crate::visibility::soup;

const SIZE: [u32; 2] = [64, 64];

/// Index of the pixel in which a position relative to the image's centre lies.
fn pixel_of(at: [f64; 2]) -> usize {
    let [x, y] = [0, 1].map(|axis| (at[axis] + f64::from(SIZE[axis]) / 2.0).floor());
    y as usize * SIZE[0] as usize + x as usize
}

#[test]
fn random_points_see_what_the_twin_sees() {
    on_gpu(|gpu| {
        let stage = soup(3, 80, true, [-1.0, 5.0]);
        let prepared = stage.upload(gpu);
        let mut random = Random::new(21);
        // The places are exact in 32 bits and all over the image. The pixels' centres keep the set's middle at the
        // image's.
        let mut place = || random.below(64 << 16) as f64 / 65536.0;
        let count = 1_000_000_u32;
        let mut locations = planar(SIZE);
        locations.extend((0..count).map(|index| location([place(), place()], index)));
        let settings = everywhere(SIZE, Pattern::Sobol, 1);
        let seen = gpu.sample_points(&prepared, &pinhole(SIZE), &locations, &settings.scene).unwrap();
        let twin = Twin::new(&stage, SIZE);
        let (mut contested, mut excused, mut hits) = (0, 0, 0);
        for (location, found) in locations.iter().zip(&seen.values) {
            let at = location.uv.map(|v| v - 32.0);
            let exact = twin.nearest(pixel_of(at), at);
            let id = exact.nearest.map_or(0, |hit| hit.id);
            assert!(found.id == id || exact.contested(), "at {at:?}: {} instead of {id}; {exact:?}", found.id);
            contested += u32::from(exact.contested());
            excused += u32::from(found.id != id);
            hits += u32::from(id != 0);
        }
        assert!(hits > count / 2 && contested < count / 10 && excused < count / 1000);
    });
}

/// Sets of sample places relative to a cell's middle. A cell is sampled at the places of one set, unless it is left to
/// points.
type Offsets = Vec<Vec<[f64; 2]>>;

fn points(samples: u32) -> Offsets {
    let offsets = Pattern::Sobol.offsets(samples).unwrap();
    vec![offsets.iter().map(|at| at.map(f64::from)).collect()]
}

fn rows_or_columns(lines: u32) -> Offsets {
    [false, true].map(|columns| sample_lines::offsets(columns, lines)).to_vec()
}

/// Locations whose cells are rotated, sheared, mirrored, wider and narrower than a pixel, in addition to the pixels.
fn sheared(random: &mut Random, count: usize) -> Vec<SampleLocation> {
    let mut locations = planar(SIZE);
    for index in 0..count {
        let reach = [0.01, 0.5, 2.0, 6.0][index % 4];
        // Multiples of 2^-10 make places exact.
        let mut number = |low: f64, high: f64| (random.range(low, high) * 1024.0).round() / 1024.0;
        locations.push(SampleLocation {
            uv: [number(8.0, 56.0), number(8.0, 56.0)],
            jacobian: [[number(-reach, reach), number(-reach, reach)], [number(-reach, reach), number(-reach, reach)]],
            output: 0,
        });
    }
    locations
}

/// Samples lie where the Jacobians of their locations put them.
#[test]
fn jacobians_place_sub_samples() {
    on_gpu(|gpu| {
        let stage = soup(4, 100, true, [-1.0, 5.0]);
        let prepared = stage.upload(gpu);
        let twin = Twin::new(&stage, SIZE);
        let mut random = Random::new(5);
        for (pattern, samples, sets, count) in [
            (Pattern::Sobol, 16, points(16), 2000),
            (Pattern::Lines, 64, rows_or_columns(8), 200),
            (Pattern::Lines, 256, rows_or_columns(32), 200),
        ] {
            let locations = sheared(&mut random, count);
            let settings =
                everywhere(SIZE, pattern, samples).map_superpixels(|options| options.shading(Shading::Triangle));
            let seen = gpu
                .sample_superpixels(&prepared, &pinhole(SIZE), &locations, &cells(&settings), &settings.scene)
                .unwrap();
            let (mut clear, mut doubtful, mut differ) = (0, 0, 0);
            for (location, found) in locations.iter().zip(&seen.values) {
                let fit = sets.iter().map(|offsets| judge(&twin, location, offsets, *found));
                let (fits, contested) = fit.fold((false, u32::MAX), |a, b| (a.0 || b.0, a.1.min(b.1)));
                differ += u64::from(!fits);
                clear += usize::from(contested == 0);
                doubtful += contested as usize;
            }
            let (left, total) = (seen.statistics.resampled, locations.len());
            assert!(
                differ <= left && left * 4 <= total as u64,
                "{samples} samples: {differ} of {total} cells differ, {left} left to points"
            );
            // Of hundreds of samples of a cell, some are near an edge.
            let few = doubtful * 10 <= total * sets[0].len();
            let is_clear = if sets.len() == 1 { clear * 2 > total } else { few };
            assert!(is_clear, "{clear} of {total} locations are clear, {doubtful} samples are not");
        }
    });
}

/// Whether a colour is the mean of what samples at these offsets see, and how many of them rounding decides.
fn judge(twin: &Twin, location: &SampleLocation, offsets: &[[f64; 2]], found: [f32; 4]) -> (bool, u32) {
    let [column, row] = location.jacobian;
    let mut sum = [0.0; 3];
    let mut contested = 0;
    for [x, y] in offsets {
        let at = [0, 1].map(|axis| location.uv[axis] - 32.0 + column[axis] * x + row[axis] * y);
        let exact = twin.nearest(pixel_of(at), at);
        contested += u32::from(exact.contested());
        let shown = exact.nearest.map_or([0.0; 3], |hit| code(hit.id));
        for (sum, shown) in sum.iter_mut().zip(shown) {
            *sum += f64::from(shown);
        }
    }
    let count = offsets.len() as f64;
    let allowed = 0.004 + 4095.0 * f64::from(contested) / count;
    let fits = (0..3).all(|channel| (f64::from(found[channel]) - sum[channel] / count).abs() <= allowed);
    (fits, contested)
}
