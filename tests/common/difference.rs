//! Differences of images.

/// Root mean squared difference over all channels.
pub fn rmse(a: &[[f32; 4]], b: &[[f32; 4]]) -> f64 {
    assert_eq!(a.len(), b.len());
    let squares = a.as_flattened().iter().zip(b.as_flattened());
    let sum: f64 = squares.map(|(a, b)| f64::from(a - b).powi(2)).sum();
    (sum / (4 * a.len()) as f64).sqrt()
}
