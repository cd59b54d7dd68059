//! Partition of unity: triangles of a tiling hit each sample exactly once.

use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;

use crate::meshes::{Depths, delaunay, tilings};
use crate::stage::{Stage, everywhere, flat, on_gpu};

/// Numbers of samples, and the side of the image for each.
const COUNTS: [(u32, u32); 8] = [(1, 64), (2, 64), (4, 64), (16, 48), (64, 32), (100, 32), (256, 16), (1024, 8)];

/// Renders white tilings of one material over an empty background, and compares all channels of each pixel.
fn assert_every_pixel_is(alpha_mode: AlphaMode, opacity: f32, expected: f32) {
    on_gpu(|gpu| {
        for (round, (samples, side)) in COUNTS.into_iter().enumerate() {
            let half = f64::from(side) / 2.0;
            for (index, mesh) in tilings(round as u64, half).into_iter().enumerate() {
                // Each number of samples uses two of the eight meshes.
                if (index + index / 4 + round) % 4 != 0 {
                    continue;
                }
                // Crowded tiles have their own test.
                if samples > 64 && mesh.triangles.len() > 1000 {
                    continue;
                }
                let mut stage = Stage::new(vec![flat([1.0, 1.0, 1.0, opacity], alpha_mode)]);
                stage.add_mesh(0, &mesh, side, |triangle| triangle);
                let pattern = if index < 4 { Pattern::Sobol } else { Pattern::Lattice };
                let settings = everywhere([side, side], pattern.clone(), samples);
                let rendered = stage.render(gpu, &settings);
                assert_eq!(rendered.colors.len(), (side * side) as usize);
                // For a power of two, the mean is exact. Otherwise it is off by a bit or two, far less than the weight
                // of a sample.
                let tolerance = if samples.is_power_of_two() { 0.0 } else { 1e-6 };
                for (pixel, color) in rendered.colors.into_iter().enumerate() {
                    assert!(
                        color.iter().all(|v| (v - expected).abs() <= tolerance),
                        "{}, {samples} samples, {pattern}, pixel {pixel}: {color:?} instead of {expected}",
                        mesh.name
                    );
                }
            }
        }
    });
}

#[test]
fn opaque_tilings_have_no_holes() {
    assert_every_pixel_is(AlphaMode::Opaque, 1.0, 1.0);
}

/// A sample that belongs to two triangles would be composited twice.
#[test]
fn blended_tilings_have_no_holes_and_no_double_hits() {
    assert_every_pixel_is(AlphaMode::Blend, 0.5, 0.5);
}

/// Tiles hold thousands of triangles, with the largest number of samples.
#[test]
fn crowded_tiles_have_no_holes() {
    on_gpu(|gpu| {
        let side = 16;
        for (cells, mode, samples) in
            [(100, AlphaMode::Opaque, 1024), (200, AlphaMode::Opaque, 64), (40, AlphaMode::Blend, 1024)]
        {
            let mesh = delaunay(8, f64::from(side) / 2.0, cells, Depths::Random);
            let mut stage = Stage::new(vec![flat([0.5; 4], mode)]);
            stage.add_mesh(0, &mesh, side, |triangle| triangle);
            let settings = everywhere([side, side], Pattern::Sobol, samples);
            let expected = if mode == AlphaMode::Blend { 0.25 } else { 0.5 };
            let rendered = stage.render(gpu, &settings);
            let holes = rendered.colors.iter().filter(|c| c[0] != expected);
            let holes = holes.count();
            assert_eq!(holes, 0, "pixels with holes: {cells} cells, {mode:?}, {samples} samples");
        }
    });
}
