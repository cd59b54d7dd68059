//! Projectors: homographies with noise and outliers, dense maps, blend weights, and a simulated rig.

use glam::{DMat3, DVec2};
use gpc::camera::LocationMap;
use gpc::camera::projector::{Correspondence, Homography, Projector, ProjectorError, blend_weights};

const SIZE: [u32; 2] = [96, 64];

/// Deterministic pseudo-random numbers from -1 to 1.
fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Homography of a projector with keystone, whose part of the picture starts at `x`.
fn keystone(x: f64, tilt: f64) -> DMat3 {
    DMat3::from_translation(DVec2::new(x, 4.0))
        * DMat3::from_cols_array(&[1.1, 0.04, tilt, -0.05, 1.2, tilt * 0.5, 0.0, 0.0, 1.0])
}

fn map(matrix: DMat3, place: DVec2) -> DVec2 {
    let p = matrix * place.extend(1.0);
    p.truncate() / p.z
}

fn pair(matrix: DMat3, place: DVec2) -> Correspondence {
    Correspondence { place: place.to_array(), location: map(matrix, place).to_array() }
}

/// Correspondences on a grid over the projector.
fn grid(matrix: DMat3) -> Vec<Correspondence> {
    let places = (0..8).flat_map(|y| (0..8).map(move |x| DVec2::new(f64::from(x), f64::from(y))));
    places.map(|place| pair(matrix, place * 9.0 + 3.0)).collect()
}

/// Largest distance between the two maps over the projector.
fn error(homography: &Homography, matrix: DMat3) -> f64 {
    let places = grid(matrix).into_iter().map(|pair| DVec2::from(pair.place));
    let errors = places.map(|place| homography.location(place).distance(map(matrix, place)));
    errors.fold(0.0, f64::max)
}

#[test]
fn four_or_more_exact_pairs_give_the_homography() {
    let matrix = keystone(20.0, 0.002);
    assert!(error(&Homography::fit(&grid(matrix)).unwrap(), matrix) < 1e-9);
    let corners = [(0.0, 0.0), (96.0, 0.0), (0.0, 64.0), (96.0, 64.0)];
    let four = corners.map(|corner| pair(matrix, corner.into()));
    let fitted = Homography::fit(&four).unwrap();
    assert!(error(&fitted, matrix) < 1e-9);
    let place = DVec2::new(33.0, 21.0);
    assert!(fitted.inverse(fitted.location(place)).unwrap().distance(place) < 1e-9);
    let h = 1e-5;
    let differences = [DVec2::X, DVec2::Y]
        .map(|axis| (fitted.location(place + h * axis) - fitted.location(place - h * axis)) / (2.0 * h));
    let jacobian = fitted.jacobian(place);
    assert!((jacobian.x_axis - differences[0]).length() < 1e-7);
    assert!((jacobian.y_axis - differences[1]).length() < 1e-7);
}

#[test]
fn noise_is_averaged_and_outliers_are_left_out() {
    let matrix = keystone(20.0, 0.002);
    let mut random = random(5);
    let mut pairs = grid(matrix);
    for (index, pair) in pairs.iter_mut().enumerate() {
        let size = if index % 3 == 0 { 80.0 } else { 0.3 };
        pair.location[0] += size * random();
        pair.location[1] += size * random();
    }
    let (fitted, agree) = Homography::fit_robust(&pairs, 1.5, 1).unwrap();
    assert!(error(&fitted, matrix) < 0.4);
    assert!(agree.iter().enumerate().filter(|(i, _)| i % 3 != 0).all(|(_, agrees)| *agrees));
    assert!(agree.iter().step_by(3).filter(|agrees| **agrees).count() < 3);
    // The same seed gives the same result; the plain fit to all pairs is much worse.
    assert_eq!(Homography::fit_robust(&pairs, 1.5, 1).unwrap(), (fitted, agree));
    assert!(error(&Homography::fit(&pairs).unwrap(), matrix) > 2.0);
    // If most pairs are wrong, there is no agreement.
    for pair in &mut pairs {
        pair.location = [200.0 * random(), 200.0 * random()];
    }
    let refused = Homography::fit_robust(&pairs, 1.5, 1);
    assert!(matches!(refused, Err(ProjectorError::Outliers { count: 64, .. })), "{refused:?}");
}

#[test]
fn what_determines_no_homography_is_refused() {
    let matrix = keystone(0.0, 0.001);
    let line = |t: f64| pair(matrix, DVec2::new(3.0 + 7.0 * t, 5.0 + 2.0 * t));
    let collinear: Vec<_> = (0..20).map(|t| line(f64::from(t))).collect();
    let refused = Homography::fit(&collinear);
    assert_eq!(refused, Err(ProjectorError::Collinear("projector")));
    // All points but one are on a line.
    let mut nearly = collinear.clone();
    nearly.push(pair(matrix, DVec2::new(0.0, 90.0)));
    assert!(matches!(Homography::fit(&nearly), Err(ProjectorError::Collinear(_))));
    let onto_line: Vec<_> = grid(matrix)
        .into_iter()
        .map(|pair| Correspondence { location: [pair.place[0], 2.0 * pair.place[0]], ..pair })
        .collect();
    assert_eq!(Homography::fit(&onto_line), Err(ProjectorError::Collinear("image plane")));
    assert_eq!(Homography::fit(&grid(matrix)[..3]), Err(ProjectorError::TooFew(3)));
    let mut broken = grid(matrix);
    broken[7].location[1] = f64::NAN;
    assert_eq!(Homography::fit(&broken), Err(ProjectorError::NotFinite(7)));
    // This homography has its horizon at x = 50.
    let horizon = DMat3::from_cols_array(&[1.0, 0.0, -0.02, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    let places = [(1.0, 1.0), (30.0, 2.0), (2.0, 40.0), (33.0, 35.0)];
    let fitted = Homography::fit(&places.map(|place| pair(horizon, place.into()))).unwrap();
    assert_eq!(Projector::planar(SIZE, fitted), Err(ProjectorError::Horizon(SIZE)));
}

/// Map through a lens that bends straight lines, followed by a homography.
fn distorted(matrix: DMat3, place: DVec2) -> DVec2 {
    let middle = DVec2::new(48.0, 32.0);
    let way = place - middle;
    let factor = 1.0 + 0.06 * way.length_squared() / middle.length_squared();
    map(matrix, middle + way * factor)
}

fn dense(matrix: DMat3) -> Projector {
    let [width, height] = SIZE;
    let pixels = (0..height).flat_map(|row| (0..width).map(move |col| (row, col)));
    let location = |(row, col)| {
        let place = DVec2::new(f64::from(col) + 0.5, f64::from(row) + 0.5);
        distorted(matrix, place).to_array()
    };
    Projector::dense(SIZE, pixels.map(location).collect()).unwrap()
}

#[test]
fn a_dense_map_is_inverted_where_it_is_lit() {
    let matrix = keystone(10.0, 0.002);
    let projector = dense(matrix);
    for place in [(0.5, 0.5), (48.3, 20.7), (95.0, 63.0), (0.2, 33.0)] {
        let place = DVec2::from(place);
        let found = projector.place(distorted(matrix, place)).unwrap();
        assert!(found.distance(place) < 0.01, "{found} {place}");
    }
    assert_eq!(projector.place(distorted(matrix, DVec2::new(-3.0, 10.0))), None);
    assert_eq!(projector.place(DVec2::new(1e5, -1e5)), None);
    // Dark pixels are left out of the set, and no place is found for their locations.
    let mut locations: Vec<_> =
        (0..SIZE[0] * SIZE[1]).map(|i| projector.location(i / SIZE[0], i % SIZE[0]).unwrap().to_array()).collect();
    for row in 20..30 {
        locations[row * 96 + 40..row * 96 + 60].fill([f64::NAN; 2]);
    }
    let holed = Projector::dense(SIZE, locations).unwrap();
    assert_eq!(holed.set().unwrap().samples().len(), 96 * 64 - 200);
    assert_eq!(holed.place(distorted(matrix, DVec2::new(50.0, 25.0))), None);
    assert_eq!(Projector::dense([2, 2], vec![[f64::NAN; 2]; 4]), Err(ProjectorError::Dark));
    assert!(matches!(Projector::dense([2, 2], vec![]), Err(ProjectorError::Size { .. })));
}

/// Light that the wall should show at a location.
fn ideal(location: DVec2) -> f64 {
    0.5 + 0.3 * (location.x * 0.11).sin() * (location.y * 0.07).cos()
}

#[test]
fn the_light_of_overlapping_projectors_adds_up_to_the_picture() {
    // Two projectors are planar, calibrated from noisy pairs with outliers; one has a bent lens.
    let matrices = [keystone(0.0, 0.001), keystone(70.0, -0.001), keystone(140.0, 0.0015)];
    let mut random = random(11);
    let mut calibrated = |matrix: DMat3| {
        let mut pairs = grid(matrix);
        for (index, pair) in pairs.iter_mut().enumerate() {
            let size = if index % 5 == 0 { 50.0 } else { 0.1 };
            pair.location[0] += size * random();
            pair.location[1] += size * random();
        }
        let (homography, _) = Homography::fit_robust(&pairs, 1.0, 3).unwrap();
        Projector::planar(SIZE, homography).unwrap()
    };
    let projectors = vec![calibrated(matrices[0]), calibrated(matrices[1]), dense(matrices[2])];
    let weights = blend_weights(&projectors);
    assert!(weights.iter().flatten().all(|weight| (0.0..=1.0).contains(weight)));
    // Each frame shows the picture at the locations that the calibration claims.
    let frames: Vec<Vec<f64>> = projectors
        .iter()
        .zip(&weights)
        .map(|(projector, weights)| {
            let pixels = weights.iter().enumerate().map(|(i, weight)| {
                let (row, col) = (i as u32 / SIZE[0], i as u32 % SIZE[0]);
                f64::from(*weight) * ideal(projector.location(row, col).unwrap())
            });
            pixels.collect()
        })
        .collect();
    // The light on the wall is interpolated through each projector's true map.
    let truth = [
        Projector::planar(SIZE, Homography::fit(&grid(matrices[0])).unwrap()).unwrap(),
        Projector::planar(SIZE, Homography::fit(&grid(matrices[1])).unwrap()).unwrap(),
        dense(matrices[2]),
    ];
    let landed = |location: DVec2| {
        let mut seen = 0;
        let mut sum = 0.0;
        for (projector, frame) in truth.iter().zip(&frames) {
            let Some(place) = projector.place(location) else {
                continue;
            };
            let from_first = place - DVec2::splat(0.5);
            let cell = from_first.floor();
            let [x, y] = (from_first - cell).to_array();
            let at = |dx: f64, dy: f64| {
                let [col, row] = [(cell.x + dx).clamp(0.0, 95.0), (cell.y + dy).clamp(0.0, 63.0)];
                frame[row as usize * 96 + col as usize]
            };
            sum += (at(0.0, 0.0) * (1.0 - x) + at(1.0, 0.0) * x) * (1.0 - y)
                + (at(0.0, 1.0) * (1.0 - x) + at(1.0, 1.0) * x) * y;
            seen += 1;
        }
        (seen, sum)
    };
    let (mut counts, mut worst) = ([0; 4], 0.0_f64);
    for y in 12..60 {
        for x in 6..240 {
            let location = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let (seen, light) = landed(location);
            counts[seen] += 1;
            if seen > 0 {
                worst = worst.max((light - ideal(location)).abs());
            }
        }
    }
    assert!(counts[1] > 3000 && counts[2] > 1000, "{counts:?}");
    // The bound is a fifteenth of the picture's contrast, at the edge of an overlap that noise has moved.
    assert!(worst < 0.04, "{worst}");
}
