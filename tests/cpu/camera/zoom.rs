//! The zoom map: its formulas as published, absence of folds, inverse, derivative and rates.

use glam::{DMat2, DVec2};
use gpc::camera::LocationMap;
use gpc::camera::zoom::{Shape, Transition, ZoomError, ZoomMap, ZoomRegion};

const REGION: ZoomRegion = ZoomRegion {
    center: [64.0, 40.5],
    radius: [20.0, 20.0],
    multiplicity: 0.4,
    shape: Shape::Circle,
    transition: Transition::Linear,
};

const MULTIPLICITIES: [f64; 5] = [0.02, 0.25, 0.5, 0.9, 1.0];

/// Circles and rectangles with both transitions and several multiplicities.
fn regions() -> Vec<ZoomRegion> {
    let mut all = Vec::new();
    for multiplicity in MULTIPLICITIES {
        for transition in [Transition::Linear, Transition::Smooth] {
            for (shape, radius) in [(Shape::Circle, [20.0, 20.0]), (Shape::Rectangle, [30.0, 12.0])] {
                all.push(ZoomRegion { radius, multiplicity, shape, transition, ..REGION });
            }
        }
    }
    all
}

fn map(region: ZoomRegion) -> ZoomMap {
    ZoomMap::new(vec![region]).unwrap()
}

/// Places around the centre, inside and outside of every part.
fn places() -> impl Iterator<Item = DVec2> {
    (0..2000).map(|i| {
        let i = f64::from(i);
        // Two irrational steps cover all directions.
        let angle = 2.4 * i;
        DVec2::from(REGION.center) + 0.05 * i * DVec2::from_angle(angle)
    })
}

/// Location by the published formula for linear transitions.
fn stated(region: &ZoomRegion, p: DVec2) -> DVec2 {
    let (c, m) = (DVec2::from(region.center), region.multiplicity);
    let [rx, ry] = region.radius;
    let way = p - c;
    // A rectangle is measured in units of its radii, so that r is 1.
    let (rho, r) = match region.shape {
        Shape::Circle => (way.length(), rx),
        Shape::Rectangle => ((way.x.abs() / rx).max(way.y.abs() / ry), 1.0),
        other => unimplemented!("{other:?}"),
    };
    let outside = r + r / m;
    let t = if rho <= r {
        1.0
    } else if rho <= outside {
        (outside - rho) / (r / m)
    } else {
        0.0
    };
    p + t * (c + m * (p - c) - p)
}

#[test]
fn linear_locations_are_those_of_the_formula() {
    for region in regions() {
        if region.transition == Transition::Linear {
            let map = map(region);
            for p in places() {
                let error = (map.location(p) - stated(&region, p)).length();
                assert!(error < 1e-10, "{region:?} at {p}: {error}");
            }
        }
    }
}

#[test]
fn smooth_locations_agree_with_the_formula_outside_of_the_transition() {
    for region in regions() {
        for p in places().filter(|p| !region.in_transition(*p)) {
            assert!((map(region).location(p) - stated(&region, p)).length() < 1e-10);
        }
    }
}

#[test]
fn the_inverse_undoes_the_map() {
    for region in regions() {
        let map = map(region);
        for p in places() {
            let back = map.inverse(map.location(p));
            assert!((back - p).length() < 1e-9, "{region:?} at {p}: {back}");
            let there = map.location(map.inverse(p));
            assert!((there - p).length() < 1e-9, "{region:?} at {p}: {there}");
        }
    }
}

#[test]
fn locations_move_outward_with_their_pixels_and_never_fold() {
    for region in regions() {
        let map = map(region);
        let center = DVec2::from(region.center);
        for direction in (0..16).map(|i| DVec2::from_angle(0.1 + 0.4 * f64::from(i))) {
            let mut before = 0.0;
            for step in 1..3000 {
                let place = center + direction * (0.05 * f64::from(step));
                let way = map.location(place) - center;
                assert!(way.perp_dot(direction).abs() < 1e-9);
                assert!(way.dot(direction) > before, "{region:?} at {place}");
                before = way.dot(direction);
            }
        }
        for p in places() {
            assert!(map.jacobian(p).determinant() > 0.0, "{region:?} at {p}");
        }
    }
}

#[test]
fn jacobians_are_the_differences_of_locations() {
    let h = 1e-5;
    for region in regions() {
        let map = map(region);
        for p in places() {
            let difference = |step: DVec2| (map.location(p + step) - map.location(p - step)) / (2.0 * h);
            let columns = [DVec2::X * h, DVec2::Y * h].map(difference);
            let error = map.jacobian(p) - DMat2::from_cols(columns[0], columns[1]);
            let size = error.x_axis.length().max(error.y_axis.length());
            // On a border or a rectangle's diagonal, the one-sided derivatives differ.
            let kinked = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y].into_iter().any(|step| {
                let change = map.jacobian(p + 2.0 * h * step) - map.jacobian(p);
                change.x_axis.length().max(change.y_axis.length()) > 1e-3
            });
            assert!(size < 1e-6 || kinked, "{region:?} at {p}: {size}");
        }
    }
}

/// Areas that pixels cover just inside and outside of a region's two borders, along x.
fn areas(region: ZoomRegion) -> [f64; 4] {
    let map = map(region);
    let e = 1e-9;
    [1.0 - e, 1.0 + e, region.outer() - e, region.outer() + e].map(|q| {
        let place = DVec2::from(region.center) + DVec2::new(q * region.radius[0], 0.0);
        map.jacobian(place).determinant()
    })
}

#[test]
fn rates_at_the_borders_are_as_derived() {
    for region in regions() {
        let m = region.multiplicity;
        let expected = match region.transition {
            // s' jumps; the other factor of the area is m at the inner border and 1 at the outer one.
            Transition::Linear => [m * m, m * m * (2.0 - m), 2.0 - m * m, 1.0],
            Transition::Smooth => [m * m, m * m, 1.0, 1.0],
            other => unimplemented!("{other:?}"),
        };
        for (found, expected) in areas(region).into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{region:?}: {found} {expected}");
        }
    }
}

#[test]
fn a_smooth_transition_has_a_continuous_rate_along_rays() {
    for region in regions() {
        let map = map(region);
        let steepest = |step: f64| {
            let rate = |i: u32| {
                let way = DVec2::from_angle(0.3) * step * f64::from(i);
                1.0 / map.jacobian(DVec2::from(region.center) + way).determinant()
            };
            let count = (region.outer() * 40.0 / step).min(200_000.0) as u32;
            (1..count).map(|i| (rate(i + 1) - rate(i)).abs() * region.multiplicity.powi(2)).fold(0.0, f64::max)
        };
        if region.multiplicity < 0.95 && region.multiplicity > 0.1 {
            let (coarse, fine) = (steepest(0.02), steepest(0.002));
            match region.transition {
                // Steps that are ten times finer change a continuous rate about ten times less; a jump stays.
                Transition::Smooth => assert!(fine < 0.2 * coarse, "{region:?}: {coarse} {fine}"),
                Transition::Linear => assert!(fine > 0.8 * coarse, "{region:?}: {coarse} {fine}"),
                other => unimplemented!("{other:?}"),
            }
        }
    }
}

#[test]
fn regions_are_composed_in_order() {
    let first = REGION;
    let second = ZoomRegion { center: [90.0, 55.0], shape: Shape::Rectangle, transition: Transition::Smooth, ..REGION };
    let both = ZoomMap::new(vec![first, second]).unwrap();
    for p in places() {
        let expected = map(second).location(map(first).location(p));
        assert_eq!(both.location(p), expected);
        assert!((both.inverse(expected) - p).length() < 1e-8);
        let chain = map(second).jacobian(map(first).location(p)) * map(first).jacobian(p);
        assert_eq!(both.jacobian(p), chain);
    }
}

#[test]
fn impossible_regions_are_refused() {
    for multiplicity in [0.0, -0.5, 1.0001, 1.5, f64::NAN, f64::INFINITY] {
        let error = ZoomMap::new(vec![ZoomRegion { multiplicity, ..REGION }]);
        assert!(matches!(error, Err(ZoomError::Multiplicity(_))));
    }
    for radius in [[0.0, 1.0], [1.0, -1.0], [f64::NAN, 1.0], [f64::INFINITY, 1.0]] {
        let error = ZoomMap::new(vec![ZoomRegion { radius, ..REGION }]);
        assert!(matches!(error, Err(ZoomError::Radius(_))));
    }
    let center = [0.0, f64::NAN];
    let error = ZoomMap::new(vec![ZoomRegion { center, ..REGION }]);
    assert!(matches!(error, Err(ZoomError::Center(_))));
    assert_eq!(ZoomMap::new(vec![]), Err(ZoomError::Empty));
}
