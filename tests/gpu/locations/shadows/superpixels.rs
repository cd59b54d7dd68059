//! Shadows in superpixels.

use glam::DVec2;
use gpc::camera::SampleLocation;
use gpc::render::{Detection, Method, Shading, Shadows};
use gpc::sampling::Pattern;
use gpc::scene::{AlphaMode, Light};
use twins::shadow::PROBES;

use super::{OVER, SIZE, cast, floor, lit, location, pinhole, render, sun, upload, within};
use crate::scenes::ball_over_checker;
use crate::stage::{cells, everywhere, on_gpu};

/// Pixels in which the border of a shadow lies between their centre and a neighbour's, or a probe, are superpixels
/// even on a single triangle, and their brightness is the share of their samples that are lit.
#[test]
fn borders_of_shadows_are_antialiased() {
    const SIZE: [u32; 2] = [128, 96];
    on_gpu(|gpu| {
        let mut stage = floor(vec![lit(AlphaMode::Opaque)]);
        stage.add(0, OVER);
        let pinhole = pinhole(SIZE);
        let corners = OVER.map(|corner| cast(&sun(), corner, &pinhole));
        let settings = everywhere(SIZE, Pattern::Sobol, 64)
            .shadows(Shadows::Exact)
            .attributes(true)
            .map_superpixels(|options| options.samples(64).detection(Detection::Edges));
        let prepared = upload(gpu, &stage, &[sun()]);
        let image = render(gpu, &prepared, &settings);
        let once = settings.method(Method::None);
        let single = render(gpu, &prepared, &once);
        let offsets = Pattern::Sobol.offsets(64).unwrap();
        let value = |x: u32, y: u32| f64::from(single.colors[(y * SIZE[0] + x) as usize][1]);
        let shadow = |x: f64, y: f64| within(DVec2::new(x, y), corners).0;
        let mut partly = 0;
        for y in 50..SIZE[1] - 1 {
            for x in 1..SIZE[0] - 1 {
                let index = (y * SIZE[0] + x) as usize;
                let (column, row) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
                let around = |dx: i32, dy: i32| shadow(column + f64::from(dx), row + f64::from(dy));
                let one = (-1..=1).all(|dy| {
                    let at = |dx: i32| (index as i64 + i64::from(dy) * i64::from(SIZE[0]) + i64::from(dx)) as usize;
                    (-1..=1).all(|dx| single.attributes[at(dx)].id == single.attributes[index].id)
                });
                let differs = (-1..=1).any(|dy| (-1..=1).any(|dx| around(dx, dy) != around(0, 0)));
                let probes = PROBES.map(|[dx, dy]| shadow(column + dx, row + dy));
                let differs = differs || probes.iter().any(|probe| *probe != around(0, 0));
                if !one || single.attributes[index].id > 2 {
                    continue;
                }
                let superpixel = image.attributes[index].superpixel == 1;
                assert_eq!(superpixel, differs, "{x}, {y}");
                // Pixels two to each side in the row, one lit and one in shadow, give the range of values.
                let ends = [value(x - 1, y), value(x + 1, y)];
                if !superpixel || around(-1, 0) == around(1, 0) {
                    continue;
                }
                let darker = ends[0].min(ends[1]);
                let lighter = ends[0].max(ends[1]);
                let lit = offsets.iter().filter(|[dx, dy]| !shadow(column + f64::from(*dx), row + f64::from(*dy)));
                let expected = darker + (lighter - darker) * lit.count() as f64 / 64.0;
                let found = f64::from(image.colors[index][1]);
                assert!((found - expected).abs() < 0.04 * lighter, "{x}, {y}: {found} {expected}");
                partly += 1;
            }
        }
        assert!(partly > 15, "{partly}");
    });
}

/// If nothing casts a shadow, superpixels equal those of shading every sample.
#[test]
fn superpixels_without_shadows_stay_as_they_were() {
    on_gpu(|gpu| {
        let stage = ball_over_checker();
        let settings = everywhere(SIZE, Pattern::Sobol, 16).map_superpixels(|options| options.shading(Shading::Sample));
        let black = Light { color: [0.0; 3], ..sun() };
        let prepared = upload(gpu, &stage, &[black]);
        let locations: Vec<SampleLocation> = (0..300)
            .map(|i| location([390.0 + f64::from(i % 60) * 7.3, 200.0 + f64::from(i / 60) * 61.7], 0))
            .collect();
        let mut values = [Shadows::None, Shadows::Exact].map(|shadows| {
            let settings = settings.clone().shadows(shadows);
            gpu.sample_superpixels(&prepared, &pinhole(SIZE), &locations, &cells(&settings), &settings.scene)
                .unwrap()
                .values
        });
        let [open, shadowed] = &mut values;
        for (a, b) in open.iter().zip(shadowed) {
            assert!((0..4).all(|c| (a[c] - b[c]).abs() < 1e-4), "{a:?} {b:?}");
        }
    });
}
