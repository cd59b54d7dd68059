//! Resampling of photographs: exact where possible, without aliasing where it shrinks.

use glam::{DMat2, DVec2};
use gpc::color::srgb;
use gpc::output::DecodedImage;
use gpc::resample::Photograph;

const SIZE: u32 = 64;

/// A photograph whose light is a function of column and row.
fn photograph(light: impl Fn(u32, u32) -> f64) -> Photograph {
    let encode = |v: f64| srgb::encode(v) as f32;
    let pixel = |i: u32| {
        let v = encode(light(i % SIZE, i / SIZE));
        [v, v, v, 1.0]
    };
    Photograph::from(&DecodedImage { size: [SIZE, SIZE], pixels: (0..SIZE * SIZE).map(pixel).collect() })
}

fn scaled(step: f64) -> DMat2 {
    DMat2::from_diagonal(DVec2::splat(step))
}

#[test]
fn pixels_are_themselves() {
    let image = photograph(|x, y| f64::from((x * 7 + y * 13) % 64) / 64.0);
    let same = image.resample([SIZE, SIZE], |place| (place, DMat2::IDENTITY));
    assert_eq!(same, image.pixels());
    let turned = DMat2::from_angle(0.4);
    let same = image.resample([SIZE, SIZE], |place| (place, turned));
    assert_eq!(same, image.pixels());
}

#[test]
fn straight_ramps_of_light_stay_straight_at_every_scale() {
    let image = photograph(|x, y| 0.1 + f64::from(x) * 0.008 + f64::from(y) * 0.004);
    for step in [0.1, 0.9, 1.0, 1.5, 4.0] {
        for turn in [0.0, 0.3, 1.0] {
            let jacobian = DMat2::from_angle(turn) * scaled(step);
            for place in [DVec2::new(20.3, 30.9), DVec2::new(40.0, 25.5)] {
                let expected = 0.1 + (place.x - 0.5) * 0.008 + (place.y - 0.5) * 0.004;
                let found = f64::from(image.sample(place, jacobian)[0]);
                assert!((found - expected).abs() < 1e-6, "{found} {expected}");
            }
        }
    }
}

#[test]
fn what_is_finer_than_the_output_is_averaged() {
    let board = photograph(|x, y| f64::from((x + y) % 2));
    let stripes = photograph(|x, _| f64::from(x % 2));
    for step in [2.5, 4.0, 7.3] {
        for i in 0..40 {
            let place = DVec2::new(24.0 + 0.37 * f64::from(i), 32.0 + 0.11 * f64::from(i));
            let grey = board.sample(place, scaled(step))[0];
            assert!((grey - 0.5).abs() < 0.03, "{step}: {grey}");
            // A footprint that is long across the stripes averages them; one along the stripes keeps them.
            let across = DMat2::from_diagonal(DVec2::new(step, 1.0));
            assert!((stripes.sample(place, across)[0] - 0.5).abs() < 0.12);
            let along = DMat2::from_diagonal(DVec2::new(1.0, step));
            let line = DVec2::new(32.5, place.y);
            assert!(stripes.sample(line, along)[0] < 1e-6);
        }
    }
}

#[test]
fn the_prefilter_sets_in_without_a_jump() {
    let board = photograph(|x, y| f64::from((x + y) % 2));
    let place = DVec2::new(30.5, 30.5);
    let mut before = board.sample(place, scaled(0.9))[0];
    for i in 1..2000 {
        let after = board.sample(place, scaled(0.9 + 0.0005 * f64::from(i)))[0];
        // The root of a^2 - 1 is steep near a = 1.
        assert!((after - before).abs() < 0.02, "{i}: {before} {after}");
        before = after;
    }
}

#[test]
fn beyond_the_border_the_border_continues() {
    let image = photograph(|x, _| if x == 0 { 0.25 } else { 0.75 });
    let found = image.sample(DVec2::new(-50.0, 1e6), DMat2::IDENTITY);
    assert!((found[0] - 0.25).abs() < 1e-6 && found[3] == 1.0);
}
