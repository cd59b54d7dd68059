//! Zoom lenses: enlarged regions of the picture, which the mouse moves.

use glam::DVec2;
use gpc::camera::zoom::{Shape, Transition, ZoomMap, ZoomRegion};

/// Radius of a new lens / height of the picture.
const FIRST_RADIUS: f64 = 1.0 / 6.0;
/// Shortest drag that resizes a lens, in pixels; a shorter one only moves it.
const LEAST_RADIUS: f64 = 8.0;
/// Smallest multiplicity of a lens: the wheel enlarges by at most 1 / multiplicity.
const LEAST_MULTIPLICITY: f64 = 0.01;

/// Lenses in the order in which their maps are applied. The mouse changes one of them, the active one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lenses {
    regions: Vec<ZoomRegion>,
    active: usize,
}

impl Lenses {
    /// Regions of all lenses.
    pub fn regions(&self) -> &[ZoomRegion] {
        &self.regions
    }

    /// The map of all lenses; `None` without lenses.
    pub fn map(&self) -> Option<ZoomMap> {
        // The regions that the mouse makes are always valid.
        ZoomMap::new(self.regions.clone()).ok()
    }

    /// Index of the active lens.
    pub fn active(&self) -> usize {
        self.active
    }

    /// Adds a lens that shows the surroundings of a place twice as large, in a picture of height `height` in pixels.
    pub fn add(&mut self, place: DVec2, height: f64) {
        self.active = self.regions.len();
        self.regions.push(ZoomRegion {
            center: place.round().to_array(),
            radius: [(FIRST_RADIUS * height).round().max(LEAST_RADIUS); 2],
            multiplicity: 0.5,
            shape: Shape::Circle,
            transition: Transition::Linear,
        });
    }

    /// Removes the active lens; the one before it becomes active.
    pub fn remove(&mut self) {
        if self.active < self.regions.len() {
            self.regions.remove(self.active);
            self.active = self.active.saturating_sub(1);
        }
    }

    /// Changes the outline and transition of the active lens.
    pub fn set(&mut self, shape: Shape, transition: Transition) {
        self.change(|lens| {
            lens.shape = shape;
            lens.transition = transition;
        });
    }

    /// Makes the lens at a place the active one, or moves the active lens there if there is none.
    pub fn press(&mut self, place: DVec2) {
        let is_at_hand = |index: usize| index == self.active;
        let other =
            (0..self.regions.len()).rev().find(|index| !is_at_hand(*index) && self.regions[*index].contains(place));
        match other {
            Some(other) => self.active = other,
            None => self.change(|lens| lens.center = place.round().to_array()),
        }
    }

    /// Resizes the active lens so that it reaches a place.
    pub fn drag(&mut self, place: DVec2) {
        self.change(|lens| {
            let radius = (place - DVec2::from(lens.center)).length().round();
            if radius >= LEAST_RADIUS {
                lens.radius = [radius; 2];
            }
        });
    }

    /// Multiplies the enlargement of the active lens by a factor.
    pub fn enlarge(&mut self, factor: f64) {
        self.change(|lens| {
            let multiplicity = (lens.multiplicity / factor).clamp(LEAST_MULTIPLICITY, 1.0);
            // Four digits keep the copied command readable.
            lens.multiplicity = (1e4 * multiplicity).round() / 1e4;
        });
    }

    fn change(&mut self, change: impl FnOnce(&mut ZoomRegion)) {
        if let Some(lens) = self.regions.get_mut(self.active) {
            change(lens);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lenses(places: &[DVec2]) -> Lenses {
        let mut lenses = Lenses::default();
        for place in places {
            lenses.add(*place, 300.0);
        }
        lenses
    }

    #[test]
    fn the_mouse_sets_place_size_and_enlargement() {
        let mut lenses = lenses(&[DVec2::new(100.4, 50.0)]);
        let lens = |lenses: &Lenses| (lenses.regions[0].center, lenses.regions[0].radius);
        assert_eq!(lens(&lenses), ([100.0, 50.0], [50.0, 50.0]));
        lenses.press(DVec2::new(200.0, 60.0));
        lenses.drag(DVec2::new(203.0, 60.0));
        assert_eq!(lens(&lenses), ([200.0, 60.0], [50.0, 50.0]));
        lenses.drag(DVec2::new(230.0, 100.0));
        assert_eq!(lens(&lenses).1, [50.0, 50.0]);
        lenses.drag(DVec2::new(260.0, 140.0));
        assert_eq!(lens(&lenses).1, [100.0, 100.0]);
        lenses.enlarge(2.0);
        assert_eq!(lenses.regions[0].multiplicity, 0.25);
    }

    #[test]
    fn a_press_takes_the_lens_that_is_there() {
        let mut lenses = lenses(&[DVec2::new(100.0, 100.0), DVec2::new(300.0, 100.0)]);
        assert_eq!(lenses.active(), 1);
        lenses.press(DVec2::new(110.0, 90.0));
        assert_eq!((lenses.active(), lenses.regions[0].center), (0, [100.0; 2]));
        lenses.press(DVec2::new(120.0, 90.0));
        assert_eq!(lenses.regions[0].center, [120.0, 90.0]);
        lenses.remove();
        assert_eq!(lenses.regions.len(), 1);
        assert_eq!(lenses.regions[lenses.active()].center, [300.0, 100.0]);
        lenses.remove();
        lenses.remove();
        assert!(lenses.map().is_none());
    }

    #[test]
    fn every_lens_is_possible() {
        let mut lenses = lenses(&[DVec2::ZERO, DVec2::ONE]);
        for factor in [1e9, 1e-9] {
            lenses.enlarge(factor);
            assert!(lenses.map().is_some(), "{lenses:?}");
        }
        let mut tiny = Lenses::default();
        tiny.add(DVec2::ZERO, 1.0);
        assert!(tiny.map().is_some());
    }
}
