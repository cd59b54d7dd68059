//! Error of each pattern in measuring the area behind a straight edge, over all orientations and offsets of the edge.
//!
//! `cargo test --release --test cpu coverage_chart -- --nocapture` prints the chart.

use std::f64::consts::PI;

use gpc::sampling::{MAX_SAMPLES, Pattern, owen_sobol};
use twins::edge::half_plane_area;

/// Numbers of samples in the chart, which all patterns but the rotated one support.
const COUNTS: [u32; 5] = [4, 16, 64, 256, 1024];

/// Number of orientations of the edge, evenly spaced over half a turn and including both axes and both diagonals. The
/// other half of the turn swaps the two sides, which does not change the error.
const ORIENTATIONS: usize = 720;

/// Root mean squared errors of a set of samples, in areas of a pixel.
struct Errors {
    /// Error over all orientations.
    mean: f64,
    /// Error over edges within 2 degrees of an axis.
    near_axis: f64,
    /// Error at the worst orientation.
    worst: f64,
}

/// Mean squared error of the covered area that samples report for edges of one orientation (in radians), over all
/// offsets at which the edge crosses the pixel.
///
/// Between two samples' projections onto the edge's normal, the reported area is constant and the true one smooth.
/// Three-point Gauss quadrature of each gap is therefore exact, except for gaps in which the edge passes a corner.
fn mean_square(samples: &[[f32; 2]], angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let reach = (sin.abs() + cos.abs()) / 2.0;
    let mut ends: Vec<f64> = samples.iter().map(|&[x, y]| f64::from(x) * cos + f64::from(y) * sin).collect();
    ends.sort_unstable_by(f64::total_cmp);
    ends.insert(0, -reach);
    ends.push(reach);
    let nodes = [(-0.6_f64.sqrt(), 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.6_f64.sqrt(), 5.0 / 18.0)];
    let mut integral = 0.0;
    for (below, gap) in ends.windows(2).enumerate() {
        let reported = below as f64 / samples.len() as f64;
        let (centre, half) = ((gap[0] + gap[1]) / 2.0, (gap[1] - gap[0]) / 2.0);
        for (node, weight) in nodes {
            let covered = half_plane_area([-cos, -sin, centre + half * node]);
            integral += 2.0 * half * weight * (covered - reported).powi(2);
        }
    }
    integral / (2.0 * reach)
}

/// Errors of a set of samples over `orientations` orientations.
fn errors(samples: &[[f32; 2]], orientations: usize) -> Errors {
    let squares: Vec<(f64, f64)> = (0..orientations)
        .map(|step| PI * step as f64 / orientations as f64)
        .map(|angle| (angle, mean_square(samples, angle)))
        .collect();
    let root = |squares: &[f64]| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
    let all: Vec<f64> = squares.iter().map(|&(_, square)| square).collect();
    let near: Vec<f64> = squares
        .iter()
        .filter(|&&(angle, _)| {
            let from_axis = angle % (PI / 2.0);
            from_axis.min(PI / 2.0 - from_axis) < 2.0_f64.to_radians()
        })
        .map(|&(_, square)| square)
        .collect();
    Errors { mean: root(&all), near_axis: root(&near), worst: all.iter().copied().fold(0.0, f64::max).sqrt() }
}

/// Errors of a pattern at each of [`COUNTS`], which are also printed.
fn chart(pattern: &Pattern) -> [Errors; 5] {
    COUNTS.map(|count| {
        let found = errors(&pattern.offsets(count).unwrap(), ORIENTATIONS);
        println!(
            "{:8} N = {count:4}: RMSE {:.5}, within 2 degrees of an axis {:.5}, worst orientation {:.5}",
            pattern.to_string(),
            found.mean,
            found.near_axis,
            found.worst
        );
        found
    })
}

/// Slope of log RMSE over log N, by least squares.
fn slope(chart: &[Errors; 5]) -> f64 {
    let points = COUNTS.map(f64::from).map(f64::ln).into_iter().zip(chart.iter().map(|e| e.mean.ln()));
    let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / COUNTS.len() as f64;
    let centre = [mean(&mut points.clone().map(|p| p.0)), mean(&mut points.clone().map(|p| p.1))];
    let (mut products, mut squares) = (0.0, 0.0);
    for (x, y) in points {
        products += (x - centre[0]) * (y - centre[1]);
        squares += (x - centre[0]).powi(2);
    }
    products / squares
}

/// Asserts that a pattern's error decreases fast enough, and is below `bound` at every orientation.
fn assert_chart(pattern: &Pattern, bound: impl Fn(f64) -> f64) -> [Errors; 5] {
    let chart = chart(pattern);
    let slope = slope(&chart);
    println!("{pattern}: RMSE falls as N^{slope:.3}");
    assert!((slope + 0.75).abs() < 0.1, "{pattern}: N^{slope}");
    for (count, errors) in COUNTS.into_iter().zip(&chart) {
        let bound = bound(f64::from(count));
        assert!(errors.worst <= bound, "{pattern} {count}: worst {}, bound {bound}", errors.worst);
    }
    chart
}

/// The error and its bound decrease equally at every orientation, unlike those of other patterns.
#[test]
fn sobol() {
    let chart = assert_chart(&Pattern::Sobol, |n| 0.4 * n.powf(-0.75));
    // These are the expected errors of random scramblings; the chosen one must not be worse.
    for (errors, expected) in chart.iter().skip(1).zip([0.0379, 0.0133, 0.0047, 0.0017]) {
        assert!(errors.mean < expected * 1.02, "{} where {expected} is usual", errors.mean);
    }
}

/// The worst edges of every lattice run along one of its rows, whose samples they cross all at once: N^-1/2.
#[test]
fn lattice() {
    assert_chart(&Pattern::Lattice, |n| 0.3 * n.powf(-0.5));
}

#[test]
fn korobov() {
    let lattice = assert_chart(&Pattern::Korobov, |n| 0.4 * n.powf(-0.5));
    let sobol = chart(&Pattern::Sobol);
    // From 64 samples on, its error is smaller than that of Sobol points, on average and along the axes.
    for (lattice, sobol) in lattice.iter().zip(&sobol).skip(2) {
        assert!(lattice.mean < sobol.mean && lattice.near_axis < sobol.near_axis);
    }
}

/// An edge along an axis has an error of up to half a row: 1 / (k sqrt 12).
#[test]
fn grid() {
    let chart = assert_chart(&Pattern::Grid, |n| 1.001 / (12.0 * n).sqrt());
    for (count, errors) in COUNTS.into_iter().zip(&chart) {
        let along_axis = 1.0 / (12.0 * f64::from(count)).sqrt();
        assert!((errors.worst / along_axis - 1.0).abs() < 1e-3, "{count}: {}", errors.worst);
    }
}

/// The standard patterns are better than the grid along the axes, for which they were made.
#[test]
fn rotated() {
    for count in [4, 16] {
        let rotated = errors(&Pattern::Rotated.offsets(count).unwrap(), ORIENTATIONS);
        let grid = errors(&Pattern::Grid.offsets(count).unwrap(), ORIENTATIONS);
        println!(
            "rotated  N = {count:4}: RMSE {:.5}, within 2 degrees of an axis {:.5}, worst orientation {:.5}",
            rotated.mean, rotated.near_axis, rotated.worst
        );
        assert!(rotated.near_axis < 0.6 * grid.near_axis);
        assert!(rotated.worst < grid.worst);
    }
}

/// Numbers of samples that are no powers of two are as good as others.
#[test]
fn any_count_is_a_good_one() {
    for pattern in [Pattern::Sobol, Pattern::Lattice, Pattern::Korobov] {
        for count in (3..=MAX_SAMPLES).step_by(29) {
            let found = errors(&pattern.offsets(count).unwrap(), 60).mean;
            let bound = 0.42 * f64::from(count).powf(-0.75);
            assert!(found < bound, "{pattern} {count}: {found}, bound {bound}");
        }
    }
}

/// The chart's quadrature is correct for one sample in the centre and edges along an axis: the mean square of a value
/// that is evenly distributed over -1/2 to 1/2 is 1/12.
#[test]
fn mean_square_of_one_sample_is_known() {
    assert!((mean_square(&[[0.0, 0.0]], 0.0) - 1.0 / 12.0).abs() < 1e-12);
    assert!((mean_square(&[[0.0, 0.0]], PI / 2.0) - 1.0 / 12.0).abs() < 1e-12);
}

/// The scrambling of [`Pattern::Sobol`] has the smallest product, over all counts, of the mean error and the error at
/// the worst orientation.
#[test]
#[ignore = "takes a quarter of a minute; run it when the scrambling's hash changes"]
fn scrambling_is_the_best_of_4096() {
    let cost = |seed: u32| -> f64 {
        let costs = COUNTS.map(|count| {
            let errors = errors(&owen_sobol(count, seed), 90);
            errors.mean.ln() + errors.worst.ln()
        });
        costs.iter().sum()
    };
    let costs = (0..4096).map(|seed| (cost(seed), seed));
    let (_, best) = costs.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    println!("the best seed is {best}");
    let sorted = |mut points: Vec<[f32; 2]>| {
        points.sort_by(|a, b| a.partial_cmp(b).unwrap());
        points
    };
    let chosen = Pattern::Sobol.offsets(MAX_SAMPLES).unwrap();
    // `assert_eq` would print all samples.
    assert!(sorted(chosen) == sorted(owen_sobol(MAX_SAMPLES, best)), "seed {best} is better");
}
