//! Cover: a picture that is shown instead of the frames, for zoom lenses, overlays, an environment or a photograph.

use super::lens::Lenses;
use super::overlay::Overlay;
use super::worker::Subject;
use std::time::{Duration, Instant};

/// Numbers of samples of the first pictures, before the number asked for.
const STEPS: [u32; 2] = [4, 64];
/// Time without changes before a picture with more samples is begun.
const REST: Duration = Duration::from_millis(700);

/// The cover to show, and the progress of making it.
#[derive(Debug, Default)]
pub struct Cover {
    pub lenses: Lenses,
    /// Whether the lenses' transitions are coloured.
    pub tints: bool,
    pub overlay: Option<Overlay>,
    /// Whether pictures show the environment as background; frames don't.
    pub shows_environment: bool,
    /// Whether a photograph is shown, so that there are no frames.
    pub is_photo: bool,
    /// Number of the last order.
    number: u64,
    /// Numbers of samples of the orders since the last change.
    steps: Vec<u32>,
    /// Index in `steps` of the last order.
    step: usize,
    /// Time at which to place the next order, if it has to wait.
    due: Option<Instant>,
    /// Number of the first order since the view changed.
    first: u64,
    is_done: bool,
}

/// Decision about a picture that has arrived.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arrival {
    pub is_shown: bool,
    /// Whether to order a picture with more samples at once.
    pub refines: bool,
}

impl Cover {
    /// Cover over frames. `shows_environment` says whether its pictures show the environment.
    pub fn new(shows_environment: bool) -> Self {
        Self { shows_environment, ..Self::default() }
    }

    /// Cover without lenses and overlays, over frames or a photograph.
    pub fn cleared(&self, is_photo: bool) -> Self {
        Self { is_photo, ..Self::new(self.shows_environment) }
    }

    /// Kind of picture that a scene needs as its cover, if it needs one.
    pub fn subject(&self) -> Option<Subject> {
        match (self.overlay, self.lenses.map()) {
            (Some(overlay), _) => Some(Subject::Overlay(overlay)),
            (None, Some(map)) => Some(Subject::Zoom(map, self.tints)),
            (None, None) => self.shows_environment.then_some(Subject::Still),
        }
    }

    /// Whether a cover hides the frames.
    pub fn is_wanted(&self) -> bool {
        self.is_photo || self.subject().is_some()
    }

    /// Whether the picture with all samples is visible.
    pub fn is_done(&self) -> bool {
        !self.is_wanted() || self.is_done
    }

    /// Number and samples of the first order after a change of the view or, if `view_changed` is false, of the lenses.
    /// `asked` is the number of samples of the last order in the series.
    pub fn begin(&mut self, view_changed: bool, asked: u32) -> (u64, u32) {
        let needs_all = self.is_photo || self.overlay.is_some_and(Overlay::needs_all_samples);
        let below = |samples: &u32| *samples < asked && !needs_all;
        self.steps = STEPS.into_iter().filter(below).collect();
        self.steps.push(asked);
        self.step = 0;
        let order = self.next_order();
        if view_changed {
            self.first = self.number;
        }
        order
    }

    /// Number and samples of the next order.
    pub fn refine(&mut self) -> (u64, u32) {
        self.step += 1;
        self.next_order()
    }

    /// Time at which to place the next order, if it has to wait.
    pub fn due(&self) -> Option<Instant> {
        self.due
    }

    /// Decides how a picture that has arrived is used; `number` is that of its order.
    pub fn arrived(&mut self, number: u64, now: Instant) -> Arrival {
        let is_last = number == self.number;
        let next = self.steps.get(self.step + 1).filter(|_| is_last);
        let waits = next.is_some_and(|samples| *samples > STEPS[1]);
        self.due = waits.then(|| now + REST);
        self.is_done = is_last && next.is_none();
        Arrival { is_shown: number >= self.first && self.is_wanted(), refines: next.is_some() && !waits }
    }

    fn next_order(&mut self) -> (u64, u32) {
        self.number += 1;
        self.is_done = false;
        self.due = None;
        let samples = self.steps.get(self.step).copied().unwrap_or(1);
        (self.number, samples)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    fn cover() -> Cover {
        let mut cover = Cover::default();
        cover.lenses.add(DVec2::ZERO, 100.0);
        cover
    }

    #[test]
    fn pictures_are_refined_where_nothing_changes() {
        let now = Instant::now();
        let mut cover = cover();
        let (first, samples) = cover.begin(true, 1024);
        assert_eq!(samples, 4);
        let arrival = cover.arrived(first, now);
        assert!(arrival.is_shown && arrival.refines && !cover.is_done());
        let (second, samples) = cover.refine();
        assert_eq!(samples, 64);
        // The order with the most samples has to wait.
        let arrival = cover.arrived(second, now);
        assert!(arrival.is_shown && !arrival.refines && !cover.is_done());
        assert_eq!(cover.due(), Some(now + REST));
        let (third, samples) = cover.refine();
        assert_eq!((samples, cover.due()), (1024, None));
        assert!(!cover.arrived(third, now).refines && cover.is_done());
    }

    #[test]
    fn few_samples_and_photographs_take_fewer_pictures() {
        let now = Instant::now();
        let mut cover = cover();
        let (first, _) = cover.begin(true, 64);
        assert!(cover.arrived(first, now).refines);
        let (second, samples) = cover.refine();
        assert_eq!(samples, 64);
        assert!(!cover.arrived(second, now).refines && cover.is_done());
        cover.overlay = Some(Overlay::Error);
        assert_eq!(cover.begin(false, 64).1, 64);
        let mut photo = cover.cleared(true);
        let (first, _) = photo.begin(true, 1);
        assert!(!photo.is_done() && photo.arrived(first, now).is_shown && photo.is_done());
    }

    #[test]
    fn older_lenses_are_shown_and_older_views_are_not() {
        let now = Instant::now();
        let mut cover = cover();
        let (first, _) = cover.begin(true, 64);
        let (moved_lens, _) = cover.begin(false, 64);
        let arrival = cover.arrived(first, now);
        assert!(arrival.is_shown && !arrival.refines);
        let (moved_view, _) = cover.begin(true, 64);
        assert!(!cover.arrived(moved_lens, now).is_shown);
        assert!(cover.arrived(moved_view, now).is_shown);
        cover.lenses.remove();
        assert!(!cover.arrived(moved_view, now).is_shown && cover.is_done());
    }

    #[test]
    fn pictures_of_what_frames_have_not_take_their_place() {
        let mut cover = Cover::new(true);
        assert!(matches!(cover.subject(), Some(Subject::Still)));
        cover.lenses.add(DVec2::ZERO, 100.0);
        assert!(matches!(cover.subject(), Some(Subject::Zoom(..))));
        assert!(matches!(cover.cleared(false).subject(), Some(Subject::Still)));
        assert!(!Cover::default().is_wanted());
    }
}
