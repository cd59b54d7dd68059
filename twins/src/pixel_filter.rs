//! Pixel filters, by brute force.

use gpc::sampling::FilterShape;
use std::f64::consts::PI;

/// Value of a filter along an axis at a distance `x` from the pixel's centre, up to a factor.
#[must_use]
pub fn value(shape: FilterShape, radius: f64, x: f64) -> f64 {
    let x = x.abs();
    if x > radius {
        return 0.0;
    }
    match shape {
        FilterShape::Tent => radius - x,
        FilterShape::Gaussian => {
            let deviation = radius / 4.0;
            let bell = |x: f64| (-0.5 * (x / deviation).powi(2)).exp();
            bell(x) - bell(radius)
        }
        FilterShape::Mitchell => {
            // The polynomials for B = C = 1/3, times 18.
            let x = 2.0 * x / radius;
            if x < 1.0 { 16.0 + x * x * (21.0 * x - 36.0) } else { 32.0 + x * (-60.0 + x * (36.0 - 7.0 * x)) }
        }
        FilterShape::BlackmanHarris => {
            let wave = |number: f64| (PI * number * x / radius).cos();
            0.35875 + 0.48829 * wave(1.0) + 0.14128 * wave(2.0) + 0.01168 * wave(3.0)
        }
        _ => f64::from(u8::from(x < 0.5)),
    }
}

/// An image of `size` pixels whose light at a place, in pixels from its upper left corner, is `light`: premultiplied RGBA. Each
/// pixel is averaged over `steps` x `steps` places a pixel. Places outside of the image have no weight. Where negative lobes bring
/// alpha below 0 or above 1, it becomes 0 or 1 and the colour stays the same; light that is negative becomes 0.
#[must_use]
pub fn filtered(
    size: [u32; 2],
    (shape, radius): (FilterShape, f64),
    steps: u32,
    light: impl Fn([f64; 2]) -> [f64; 4],
) -> Vec<[f64; 4]> {
    let [columns, rows] = size.map(|side| side * steps);
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(steps);
    let [across_weights, along_weights] = size.map(|side| weights(side, (shape, radius), steps));
    // First along rows, then along columns.
    let across: Vec<Vec<[f64; 4]>> = (0..rows)
        .map(|row| {
            let lights: Vec<_> = (0..columns).map(|column| light([at(column), at(row)])).collect();
            averages(&across_weights, &lights)
        })
        .collect();
    let by_column: Vec<Vec<[f64; 4]>> = (0..size[0] as usize)
        .map(|x| {
            let lights: Vec<_> = across.iter().map(|row| row[x]).collect();
            averages(&along_weights, &lights)
        })
        .collect();
    let pixels = (0..size[1] as usize).flat_map(|y| by_column.iter().map(move |column| column[y]));
    pixels.map(possible).collect()
}

/// The first place that each of `pixels` pixels of an axis sees, and the weights of this place and those after it. There are `steps`
/// places a pixel.
fn weights(pixels: u32, (shape, radius): (FilterShape, f64), steps: u32) -> Vec<(usize, Vec<f64>)> {
    let steps = f64::from(steps);
    (0..pixels)
        .map(|pixel| {
            let centre = f64::from(pixel) + 0.5;
            let first = ((centre - radius) * steps).floor().max(0.0) as usize;
            let end = ((centre + radius) * steps).ceil().min(f64::from(pixels) * steps) as usize;
            let own: Vec<f64> =
                (first..end).map(|place| value(shape, radius, (place as f64 + 0.5) / steps - centre)).collect();
            let total: f64 = own.iter().sum();
            (first, own.into_iter().map(|weight| weight / total).collect())
        })
        .collect()
}

/// Averages of a line of light by the weights of each pixel.
fn averages(weights: &[(usize, Vec<f64>)], lights: &[[f64; 4]]) -> Vec<[f64; 4]> {
    let average = |(first, own): &(usize, Vec<f64>)| {
        own.iter()
            .zip(&lights[*first..])
            .fold([0.0; 4], |sum, (weight, light)| [0, 1, 2, 3].map(|channel| sum[channel] + weight * light[channel]))
    };
    weights.iter().map(average).collect()
}

fn possible([r, g, b, alpha]: [f64; 4]) -> [f64; 4] {
    let scale = if alpha <= 0.0 { 0.0 } else { 1.0 / alpha.max(1.0) };
    [r, g, b, alpha].map(|channel| (channel * scale).max(0.0))
}
