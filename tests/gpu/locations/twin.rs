//! Results at locations, compared with the exact twin.

use gpc::camera::SampleLocation;
use gpc::sampling::Pattern;

use super::{location, pinhole, planar};
use crate::meshes::Random;
use crate::stage::{code, everywhere, on_gpu};
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
        let seen = gpu
            .sample_points(&prepared, &pinhole(SIZE), &locations, &settings)
            .unwrap();
        let twin = Twin::new(&stage, SIZE);
        let (mut contested, mut excused, mut hits) = (0, 0, 0);
        for (location, found) in locations.iter().zip(&seen.values) {
            let at = location.uv.map(|v| v - 32.0);
            let exact = twin.nearest(pixel_of(at), at);
            let id = exact.nearest.map_or(0, |hit| hit.id);
            assert!(
                found.id == id || exact.contested(),
                "at {at:?}: {} instead of {id}; {exact:?}",
                found.id
            );
            contested += u32::from(exact.contested());
            excused += u32::from(found.id != id);
            hits += u32::from(id != 0);
        }
        assert!(hits > count / 2 && contested < count / 10 && excused < count / 1000);
    });
}

/// Cells are rotated, sheared, mirrored, wider and narrower than a pixel; samples lie where the Jacobian puts them.
#[test]
fn jacobians_place_sub_samples() {
    on_gpu(|gpu| {
        let stage = soup(4, 100, true, [-1.0, 5.0]);
        let prepared = stage.upload(gpu);
        let mut random = Random::new(5);
        let samples = 16;
        let offsets = Pattern::Sobol.offsets(samples).unwrap();
        let mut locations = planar(SIZE);
        for index in 0..2000 {
            let reach = [0.01, 0.5, 2.0, 6.0][index % 4];
            // Multiples of 2^-10 make places exact.
            let mut number =
                |low: f64, high: f64| (random.range(low, high) * 1024.0).round() / 1024.0;
            locations.push(SampleLocation {
                uv: [number(8.0, 56.0), number(8.0, 56.0)],
                jacobian: [
                    [number(-reach, reach), number(-reach, reach)],
                    [number(-reach, reach), number(-reach, reach)],
                ],
                output: 0,
            });
        }
        let settings = everywhere(SIZE, Pattern::Sobol, samples);
        let seen = gpu
            .sample_superpixels(&prepared, &pinhole(SIZE), &locations, &settings)
            .unwrap();
        let twin = Twin::new(&stage, SIZE);
        let (mut clear, mut total) = (0, 0);
        for (location, found) in locations.iter().zip(&seen.values) {
            let [column, row] = location.jacobian;
            let mut sum = [0.0; 3];
            let mut contested = 0;
            for offset in &offsets {
                let [x, y] = offset.map(f64::from);
                let at =
                    [0, 1].map(|axis| location.uv[axis] - 32.0 + column[axis] * x + row[axis] * y);
                let exact = twin.nearest(pixel_of(at), at);
                contested += u32::from(exact.contested());
                let shown = exact.nearest.map_or([0.0; 3], |hit| code(hit.id));
                for (sum, shown) in sum.iter_mut().zip(shown) {
                    *sum += f64::from(shown);
                }
            }
            let allowed = 0.004 + 4095.0 * f64::from(contested) / f64::from(samples);
            for (channel, sum) in sum.iter().enumerate() {
                let mean = sum / f64::from(samples);
                let difference = (f64::from(found[channel]) - mean).abs();
                assert!(
                    difference <= allowed,
                    "{location:?}: {found:?} instead of {mean}"
                );
            }
            clear += u32::from(contested == 0);
            total += 1;
        }
        assert!(clear * 2 > total, "{clear} of {total} locations are clear");
    });
}
