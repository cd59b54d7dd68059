//! The comparison of images, which must be able to fail.

use gpc::compare::{CompareError, compare, heatmap};
use gpc::output::DecodedImage;

fn grey(value: f32) -> DecodedImage {
    DecodedImage { size: [32, 24], pixels: vec![[value, value, value, 1.0]; 32 * 24] }
}

#[test]
fn identical_images_are_identical() {
    let comparison = compare(&grey(0.4), &grey(0.4)).unwrap();
    assert_eq!((comparison.rmse, comparison.max, comparison.flip), (0.0, 0.0, 0.0));
    assert_eq!(comparison.psnr, None);
}

#[test]
fn one_corrupted_pixel_is_seen() {
    let mut image = grey(0.4);
    image.pixels[100][1] = 0.9;
    let comparison = compare(&grey(0.4), &image).unwrap();
    assert!((comparison.max - 0.5).abs() < 1e-6);
    let expected = (0.25_f64 / (32.0 * 24.0 * 3.0)).sqrt();
    assert!((comparison.rmse - expected).abs() < 1e-7);
    assert!((comparison.psnr.unwrap() + 20.0 * expected.log10()).abs() < 1e-4);
    assert!(comparison.flip > 0.0);
    let map = heatmap(&grey(0.4), &image).unwrap();
    let calm = heatmap(&grey(0.4), &grey(0.4)).unwrap();
    assert_ne!(map[100], calm[100]);
    assert_eq!(map[24 * 32 - 1], calm[24 * 32 - 1]);
}

#[test]
fn one_step_of_8_bits_is_seen() {
    let mut image = grey(0.4);
    image.pixels[7][2] += 1.0 / 255.0;
    assert!(compare(&grey(0.4), &image).unwrap().rmse > 0.0);
}

#[test]
fn pixels_are_counted_by_codes() {
    let mut image = grey(0.4);
    for (pixel, codes) in [2.0, 3.0, 8.0, 9.0, -9.0].into_iter().enumerate() {
        image.pixels[pixel][pixel % 3] += codes / 255.0;
    }
    let comparison = compare(&grey(0.4), &image).unwrap();
    assert_eq!((comparison.over_2, comparison.over_8), (4, 2));
}

#[test]
fn a_uniform_difference_is_its_own_rmse() {
    let comparison = compare(&grey(0.25), &grey(0.5)).unwrap();
    assert!((comparison.rmse - 0.25).abs() < 1e-7);
    assert!((comparison.psnr.unwrap() - 12.0412).abs() < 1e-3);
}

#[test]
fn alpha_counts_where_it_is_not_opaque() {
    let mut image = grey(0.0);
    image.pixels[5][3] = 0.5;
    let comparison = compare(&grey(0.0), &image).unwrap();
    assert!((comparison.max - 0.5).abs() < 1e-7);
    let expected = (0.25_f64 / (32.0 * 24.0 * 4.0)).sqrt();
    assert!((comparison.rmse - expected).abs() < 1e-7);
    let map = heatmap(&grey(0.0), &image).unwrap();
    assert_ne!(map[5], map[6]);
}

#[test]
fn images_of_different_size_are_refused() {
    let mut image = grey(0.4);
    image.size = [24, 32];
    let expected = CompareError::Size { first: [32, 24], second: [24, 32] };
    assert_eq!(compare(&grey(0.4), &image), Err(expected));
    assert_eq!(heatmap(&grey(0.4), &image), Err(expected));
}
