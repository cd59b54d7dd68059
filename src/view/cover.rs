//! What is looked at in the stead of the frames: a zoom lens, what pixels hold beside their colours, or shadows.

use super::studio::Subject;
use gpc::camera::zoom::{ZoomMap, ZoomRegion};
use gpc::output::AovKind;

/// Samples of the first picture, and of the one that follows where nothing has changed meanwhile.
const STEPS: [u32; 2] = [4, 64];

/// What is wanted, and how much of it is there.
#[derive(Debug, Default)]
pub struct Cover {
    pub lens: Option<ZoomRegion>,
    pub attribute: Option<AovKind>,
    /// Whether pictures have shadows, which frames have not.
    has_shadows: bool,
    /// Of the last order.
    number: u64,
    /// Index into [`STEPS`] of the last order.
    step: usize,
    /// Number of the first order since something moved.
    first: u64,
    is_done: bool,
}

/// What to do with a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arrival {
    pub is_shown: bool,
    /// Whether to ask for a better one.
    pub refines: bool,
}

impl Cover {
    /// Over frames, which have no shadows, of pictures that have them or not.
    pub fn new(has_shadows: bool) -> Self {
        Self {
            has_shadows,
            ..Self::default()
        }
    }

    /// What the studio is asked for, if anything is wanted.
    pub fn subject(&self) -> Option<Subject> {
        match (self.attribute, self.lens) {
            (Some(kind), _) => Some(Subject::Attribute(kind)),
            // Lenses that the mouse makes are possible.
            (None, Some(lens)) => ZoomMap::new(vec![lens]).ok().map(Subject::Zoom),
            (None, None) => self.has_shadows.then_some(Subject::Still),
        }
    }

    /// Whether all that is wanted is seen.
    pub fn is_done(&self) -> bool {
        self.subject().is_none() || self.is_done
    }

    /// Number and samples of the first order after a change: of the view, or of the lens alone.
    pub fn begin(&mut self, view_changed: bool) -> (u64, u32) {
        self.step = 0;
        self.next_order(view_changed)
    }

    /// Number and samples of the order that follows.
    pub fn refine(&mut self) -> (u64, u32) {
        self.step += 1;
        self.next_order(false)
    }

    /// What to do with the picture of an order.
    pub fn arrived(&mut self, number: u64) -> Arrival {
        let is_last = number == self.number;
        let refines = is_last && self.step + 1 < STEPS.len();
        self.is_done = is_last && !refines;
        Arrival {
            is_shown: number >= self.first && self.subject().is_some(),
            refines,
        }
    }

    fn next_order(&mut self, view_changed: bool) -> (u64, u32) {
        self.number += 1;
        self.is_done = false;
        if view_changed {
            self.first = self.number;
        }
        (self.number, STEPS[self.step])
    }

    /// Goes on to what else pixels hold, and at last to their colours.
    pub fn next_attribute(&mut self) {
        let all = AovKind::ALL;
        let index = self
            .attribute
            .and_then(|kind| all.iter().position(|known| *known == kind));
        self.attribute = match index {
            None => all.first().copied(),
            Some(index) => all.get(index + 1).copied(),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::super::lens;
    use super::*;
    use glam::DVec2;

    fn cover() -> Cover {
        Cover {
            lens: Some(lens::at(DVec2::ZERO, 100.0)),
            ..Cover::default()
        }
    }

    #[test]
    fn pictures_are_refined_where_nothing_changes() {
        let mut cover = cover();
        let (first, samples) = cover.begin(true);
        assert_eq!(samples, 4);
        let arrival = cover.arrived(first);
        assert!(arrival.is_shown && arrival.refines && !cover.is_done());
        let (second, samples) = cover.refine();
        assert_eq!(samples, 64);
        let arrival = cover.arrived(second);
        assert!(arrival.is_shown && !arrival.refines && cover.is_done());
    }

    #[test]
    fn older_lenses_are_shown_and_older_views_are_not() {
        let mut cover = cover();
        let (first, _) = cover.begin(true);
        let (moved_lens, _) = cover.begin(false);
        let arrival = cover.arrived(first);
        assert!(arrival.is_shown && !arrival.refines);
        let (moved_view, _) = cover.begin(true);
        assert!(!cover.arrived(moved_lens).is_shown);
        assert!(cover.arrived(moved_view).is_shown);
        cover.lens = None;
        assert!(!cover.arrived(moved_view).is_shown && cover.is_done());
    }

    #[test]
    fn pictures_with_shadows_take_the_place_of_frames() {
        let mut cover = Cover::new(true);
        assert!(matches!(cover.subject(), Some(Subject::Still)));
        cover.lens = Some(lens::at(DVec2::ZERO, 100.0));
        assert!(matches!(cover.subject(), Some(Subject::Zoom(_))));
        assert!(Cover::new(false).subject().is_none());
    }

    #[test]
    fn attributes_go_round() {
        let mut cover = Cover::default();
        for kind in AovKind::ALL {
            cover.next_attribute();
            assert_eq!(cover.attribute, Some(kind));
        }
        cover.next_attribute();
        assert_eq!(cover.attribute, None);
    }
}
