//! Coverage measured on the device, compared with closed forms for rotated and shrinking squares.

use gpc::render::Headless;
use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;
use twins::edge::triangle_area;

use crate::stage::{Stage, centre, everywhere, flat, on_gpu, seen_at};

const SIZE: [u32; 2] = [128, 128];
/// Distance between the squares' centres in pixels.
const PITCH: f64 = 8.0;

/// Corners of the squares: their sides are from a quarter of a pixel to five pixels, their angles cover a quarter
/// turn, and their centres are anywhere in a pixel.
fn squares() -> Vec<[[f64; 2]; 4]> {
    let count = (f64::from(SIZE[0]) / PITCH) as u32;
    let places = (0..count * count).map(|index| {
        let fraction = |factor: f64| (f64::from(index) * factor).fract();
        let at = [index % count, index / count];
        let middle = [0, 1].map(|axis| {
            let jitter = fraction([0.754_877_67, 0.569_840_29][axis]);
            (f64::from(at[axis]) + 0.5) * PITCH - f64::from(SIZE[axis]) / 2.0 + jitter
        });
        let half = 0.125 * 20.0_f64.powf(fraction(0.371));
        (middle, half, fraction(0.618_034) * std::f64::consts::FRAC_PI_2)
    });
    places
        .map(|(middle, half, angle)| {
            let (sin, cos) = angle.sin_cos();
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]: [f64; 2]| {
                [middle[0] + half * (x * cos - y * sin), middle[1] + half * (x * sin + y * cos)]
            })
        })
        .collect()
}

/// Root mean squared error of the coverage of pixels that an edge crosses.
fn error(gpu: &mut Headless, stage: &Stage, areas: &[f64], pattern: Pattern, samples: u32) -> f64 {
    let rendered = stage.render(gpu, &everywhere(SIZE, pattern, samples));
    let (mut squares, mut count) = (0.0, 0.0);
    let (mut measured, mut exact) = (0.0, 0.0);
    for (color, &area) in rendered.colors.iter().zip(areas) {
        let covered = f64::from(color[3]);
        let empty_or_full = area == 0.0 || area > 1.0 - 1e-9;
        assert!(!empty_or_full || (covered - area).abs() < 1e-6, "{covered} of a pixel whose area is {area}");
        // The square is white on black, so that colour equals coverage.
        assert_eq!(color[0], color[3]);
        if !empty_or_full {
            squares += (covered - area).powi(2);
            count += 1.0;
        }
        measured += covered;
        exact += area;
    }
    assert!(count > 1000.0);
    assert!((measured / exact - 1.0).abs() < 0.02, "{measured} of {exact} pixels");
    f64::sqrt(squares / count)
}

#[test]
fn coverage_converges_to_the_area() {
    on_gpu(|gpu| {
        let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
        let mut areas = vec![0.0; (SIZE[0] * SIZE[1]) as usize];
        for corners in squares() {
            stage.add_quad(0, corners.map(|place| seen_at(place, 3.0, SIZE[1])));
            let [a, b, c, d] = corners;
            for (pixel, area) in areas.iter_mut().enumerate() {
                let middle = centre(pixel, SIZE);
                if (middle[0] - a[0]).hypot(middle[1] - a[1]) < 2.0 * PITCH {
                    *area += triangle_area([a, b, c], middle) + triangle_area([a, c, d], middle);
                }
            }
        }
        let mut slopes = Vec::new();
        for pattern in [Pattern::Sobol, Pattern::Lattice] {
            let counts = [4, 16, 64, 256, 1024];
            let errors = counts.map(|samples| error(gpu, &stage, &areas, pattern.clone(), samples));
            // The bound is a third above that of straight edges, because many of these pixels contain corners.
            for (samples, error) in counts.into_iter().zip(errors) {
                let bound = 0.4 * f64::from(samples).powf(-0.75);
                assert!(error < bound, "{pattern}, {samples}: {error}, bound {bound}");
            }
            slopes.push((errors[4] / errors[0]).ln() / 256.0_f64.ln());
        }
        for slope in slopes {
            assert!((slope + 0.75).abs() < 0.1, "error falls as N^{slope}");
        }
    });
}
