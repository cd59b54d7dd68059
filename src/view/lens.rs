//! The zoom lens: a region of the picture that is enlarged, as the mouse sets it.

use glam::DVec2;
use gpc::camera::zoom::{Shape, Transition, ZoomRegion};

/// Radius of a new lens, as a share of the picture's height.
const FIRST_RADIUS: f64 = 1.0 / 6.0;
/// Drags shorter than this only move the lens.
const LEAST_RADIUS: f64 = 8.0;
/// The most that the wheel enlarges by is one over it.
const LEAST_MULTIPLICITY: f64 = 0.01;

/// A lens that shows what is around a place twice as large, in a picture of that height.
pub fn at(place: DVec2, height: f64) -> ZoomRegion {
    ZoomRegion {
        center: place.round().to_array(),
        radius: [(FIRST_RADIUS * height).round(); 2],
        multiplicity: 0.5,
        shape: Shape::Circle,
        transition: Transition::Linear,
    }
}

/// Puts the lens at a place.
pub fn press(lens: &mut ZoomRegion, place: DVec2) {
    lens.center = place.round().to_array();
}

/// Makes it as large as to reach a place.
pub fn drag(lens: &mut ZoomRegion, place: DVec2) {
    let radius = (place - DVec2::from(lens.center)).length().round();
    if radius >= LEAST_RADIUS {
        lens.radius = [radius; 2];
    }
}

/// Enlarges by a factor more, or less below 1.
pub fn enlarge(lens: &mut ZoomRegion, factor: f64) {
    let multiplicity = (lens.multiplicity / factor).clamp(LEAST_MULTIPLICITY, 1.0);
    // Four digits are enough for a command to be read.
    lens.multiplicity = (1e4 * multiplicity).round() / 1e4;
}

#[cfg(test)]
mod tests {
    use super::*;
    use gpc::camera::zoom::ZoomMap;

    #[test]
    fn the_mouse_sets_place_size_and_enlargement() {
        let mut lens = at(DVec2::new(100.4, 50.0), 300.0);
        assert_eq!((lens.center, lens.radius), ([100.0, 50.0], [50.0, 50.0]));
        press(&mut lens, DVec2::new(200.0, 60.0));
        drag(&mut lens, DVec2::new(203.0, 60.0));
        assert_eq!((lens.center, lens.radius), ([200.0, 60.0], [50.0, 50.0]));
        drag(&mut lens, DVec2::new(230.0, 100.0));
        assert_eq!(lens.radius, [50.0, 50.0]);
        drag(&mut lens, DVec2::new(260.0, 140.0));
        assert_eq!(lens.radius, [100.0, 100.0]);
        enlarge(&mut lens, 2.0);
        assert_eq!(lens.multiplicity, 0.25);
    }

    #[test]
    fn every_lens_is_possible() {
        let mut lens = at(DVec2::ZERO, 100.0);
        for factor in [1e9, 1e-9] {
            enlarge(&mut lens, factor);
            assert!(ZoomMap::new(vec![lens]).is_ok(), "{lens:?}");
        }
    }
}
