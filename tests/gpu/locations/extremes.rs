//! Sets of locations that are empty, invalid, crowded or far apart.

use gpc::camera::SampleLocation;
use gpc::render::{LocationError, Method, RenderError, Settings};
use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;

use super::{location, pinhole, planar};
use crate::stage::{Stage, cells, everywhere, flat, on_gpu, once_each, seen_at};
use crate::visibility::soup;

const SIZE: [u32; 2] = [64, 64];

#[test]
fn sets_that_cannot_be_sampled_are_named() {
    on_gpu(|gpu| {
        let prepared = soup(1, 3, true, [-1.0, 5.0]).upload(gpu);
        let mut error = |locations: &[SampleLocation]| match gpu.sample_points(
            &prepared,
            &pinhole(SIZE),
            locations,
            &once_each(),
        ) {
            Err(RenderError::Location(error)) => error,
            other => panic!("{other:?}"),
        };
        assert_eq!(error(&[]), LocationError::Empty);
        let good = location([3.0, 4.0], 0);
        for bad in [
            location([f64::NAN, 1.0], 0),
            location([1.0, f64::INFINITY], 0),
            SampleLocation { jacobian: [[1.0, 0.0], [f64::NAN, 1.0]], ..good },
        ] {
            let error = error(&[good, good, bad, bad]);
            assert!(matches!(error, LocationError::NotFinite { index: 2, .. }));
        }
        for far in [location([2e6, 0.0], 0), location([0.0, -1.1e6], 0)] {
            assert!(matches!(error(&[good, far]), LocationError::TooFar { index: 1, .. }));
        }
        // A point has no extent, but a superpixel has.
        let wide = [SampleLocation { jacobian: [[1.0, 0.0], [0.0, 4e6]], ..good }];
        let settings = everywhere(SIZE, Pattern::Sobol, 4);
        assert!(gpu.sample_points(&prepared, &pinhole(SIZE), &wide, &settings.scene).is_ok());
        assert!(matches!(
            gpu.sample_superpixels(&prepared, &pinhole(SIZE), &wide, &cells(&settings), &settings.scene),
            Err(RenderError::Location(LocationError::TooFar { index: 0, .. }))
        ));
        let rig = [(pinhole(SIZE), vec![good, location([1.0, 1.0], 4096)])];
        let rendered = gpu.render_locations(&prepared, &rig, &Settings::new(64, 64));
        assert!(matches!(
            rendered,
            Err(RenderError::Location(LocationError::Output { index: 1, output: 4096, cells: 4096 }))
        ));
        let msaa = Settings::new(64, 64).method(Method::Msaa { samples: 4 });
        let rendered = gpu.render_locations(&prepared, &rig, &msaa);
        assert_eq!(rendered.unwrap_err().to_string(), "msaa can't sample locations; none, superpixel and ssaa can");
    });
}

/// In a tile with far more locations than pixels, many of them equal, each location shows what it would show alone.
#[test]
fn a_crowd_in_one_pixel_sees_what_each_would_alone() {
    on_gpu(|gpu| {
        let stage = soup(9, 200, true, [-1.0, 5.0]);
        let prepared = stage.upload(gpu);
        let mut locations = planar(SIZE);
        locations.extend((0..100_000).map(|index| {
            let step = |v: u32| 30.0 + f64::from(v) / 64.0;
            location([step(index % 64), step(index / 64 % 64)], index)
        }));
        let settings = everywhere(SIZE, Pattern::Sobol, 4);
        let pinhole = pinhole(SIZE);
        let seen = gpu.sample_points(&prepared, &pinhole, &locations, &settings.scene).unwrap();
        let crowd = &seen.values[4096..];
        for (index, value) in crowd.iter().enumerate() {
            assert_eq!(*value, crowd[index % 4096]);
        }
        // The other locations keep the middle of the set where it is.
        for chosen in [0, 1234, 4095] {
            let few = [locations[0], locations[4095], locations[4096 + chosen]];
            let alone = gpu.sample_points(&prepared, &pinhole, &few, &settings.scene).unwrap();
            assert_eq!(alone.values[2], crowd[chosen]);
        }
        let seen = gpu.sample_superpixels(&prepared, &pinhole, &locations, &cells(&settings), &settings.scene).unwrap();
        let crowd = &seen.values[4096..];
        for (index, value) in crowd.iter().enumerate() {
            assert_eq!(*value, crowd[index % 4096]);
        }
    });
}

#[test]
fn locations_a_million_pixels_apart_cost_no_area() {
    on_gpu(|gpu| {
        let mut stage = Stage::new(vec![
            flat([1.0, 0.0, 0.0, 1.0], AlphaMode::Opaque),
            flat([0.0, 1.0, 0.0, 1.0], AlphaMode::Opaque),
        ]);
        // Two walls at distance 1 meet in a line through the image, and extend far beyond its sides.
        let end = 1.5e6;
        let corner = |x: f64, y: f64| seen_at([x, y], 1.0, SIZE[1]);
        stage.add_quad(0, [corner(-end, -end), corner(-end, end), corner(3.25, end), corner(3.25, -end)]);
        stage.add_quad(1, [corner(3.25, -end), corner(3.25, end), corner(end, end), corner(end, -end)]);
        let prepared = stage.upload(gpu);
        let locations = [
            location([-1_000_000.5, 20.5], 0),
            location([35.0, 40.0], 1),
            location([35.5, 40.0], 2),
            location([1_000_000.25, -1_000_000.0], 3),
        ];
        let settings = everywhere(SIZE, Pattern::Sobol, 16);
        let seen = gpu.sample_points(&prepared, &pinhole(SIZE), &locations, &settings.scene).unwrap();
        let sides: Vec<bool> = seen.values.iter().map(|v| v.id > 2).collect();
        assert_eq!(sides, [false, false, true, true]);
        assert!(seen.statistics.tiles <= 4, "{}", seen.statistics.tiles);
        assert!(seen.values.iter().all(|v| (v.depth - 1.0).abs() < 1e-4));
        let seen =
            gpu.sample_superpixels(&prepared, &pinhole(SIZE), &locations, &cells(&settings), &settings.scene).unwrap();
        let red: Vec<f32> = seen.values.iter().map(|v| v[0]).collect();
        // The line passes through the middle of both cells in the image.
        assert!(red[0] == 1.0 && red[3] == 0.0, "{red:?}");
        assert!((red[1] - 0.75).abs() < 0.07 && (red[2] - 0.25).abs() < 0.07, "{red:?}");
    });
}
