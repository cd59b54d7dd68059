//! Cover: a picture that is shown instead of the frames, for zoom lenses, overlays, an environment or a photograph.

use super::lens::Lenses;
use super::look::Look;
use super::overlay::Overlay;
use super::samples::{REST, SampleSteps, TARGET_MS};
use super::worker::{DraftTime, Subject};
use gpc::render::Settings;
use std::time::Instant;

/// Milliseconds that a draft may take at most for covers to be shown while the view moves. Where drafts take longer, frames are shown
/// instead, which are smoother.
const LIVE_MS: f64 = 2.0 * TARGET_MS;

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
    /// Antialiasing of the pictures, and their numbers of samples; `None` before the first order.
    refined: Option<(Look, SampleSteps)>,
    /// Number of the last order.
    number: u64,
    /// Picture of the last order.
    last: Option<CoverStep>,
    /// Time of the last change.
    changed: Option<Instant>,
    /// Time at which to place the next order.
    due: Option<Instant>,
    /// Number of the first order whose picture may be shown.
    first: u64,
    /// Whether the last draft was quick enough for covers of a view that moves.
    is_quick: bool,
    is_done: bool,
}

/// What has changed since the pictures before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Lenses or overlays. Covers of the same view stay.
    Cover,
    /// The view. Covers of earlier views stay if drafts are quick.
    View,
    /// The scene, its look or the size of the window.
    Scene,
}

/// A picture of the series that follows a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum CoverStep {
    /// A quick picture with this number of samples.
    Draft(u32),
    /// A picture with the settings of the picture at rest and this number of samples.
    Rest(u32),
}

/// An order for a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct CoverOrder {
    pub number: u64,
    pub settings: Settings,
    pub is_draft: bool,
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

    /// Whether covers from before a change are shown until there are others.
    pub fn keeps_earlier(&self, change: Change) -> bool {
        match change {
            Change::Cover => true,
            Change::View => self.is_quick && self.has_drafts(),
            Change::Scene => false,
        }
    }

    /// The first order after a change. The last order of the series has the number of samples of `look`.
    pub fn begin(&mut self, change: Change, look: &Look, now: Instant) -> CoverOrder {
        let known = self.refined.take().filter(|(known, _)| known == look);
        let (_, samples) = self.refined.insert(known.unwrap_or_else(|| (look.clone(), SampleSteps::for_covers(look))));
        let draft = samples.draft();
        let step = if self.has_drafts() { CoverStep::Draft(draft) } else { CoverStep::Rest(look.samples()) };
        self.changed = Some(now);
        let order = self.order(look, step);
        if !self.keeps_earlier(change) {
            self.first = self.number;
        }
        order
    }

    fn has_drafts(&self) -> bool {
        !self.is_photo && !self.overlay.is_some_and(Overlay::needs_all_samples)
    }

    /// The next order, if there is one.
    pub fn refine(&mut self) -> Option<CoverOrder> {
        let step = self.next()?;
        let (look, samples) = self.refined.as_mut()?;
        samples.rest();
        let look = look.clone();
        Some(self.order(&look, step))
    }

    /// Time at which the next order is due, if there is one.
    pub fn due(&self) -> Option<Instant> {
        self.due
    }

    /// Takes note of a picture that has arrived; `number` is that of its order. Returns whether to show it.
    pub fn arrived(&mut self, number: u64, draft: Option<DraftTime>, now: Instant) -> bool {
        if let (Some((_, samples)), Some(draft)) = (&mut self.refined, draft) {
            samples.learn(draft.samples, draft.ms, now);
            self.is_quick = draft.ms <= LIVE_MS;
        }
        if number == self.number {
            let next = self.next();
            self.is_done = next.is_none();
            self.due = next.and(self.changed).map(|changed| now.max(changed + REST));
        }
        number >= self.first && self.is_wanted()
    }

    /// Takes note that a picture can't be made. Earlier pictures do not stay then.
    pub fn failed(&mut self) {
        self.is_quick = false;
    }

    /// Picture that follows the last order.
    fn next(&self) -> Option<CoverStep> {
        let (_, samples) = self.refined.as_ref()?;
        let next = match self.last? {
            CoverStep::Draft(draft) => samples.first(draft),
            CoverStep::Rest(done) => samples.after(done),
        };
        next.map(CoverStep::Rest)
    }

    fn order(&mut self, look: &Look, step: CoverStep) -> CoverOrder {
        self.number += 1;
        self.last = Some(step);
        self.is_done = false;
        self.due = None;
        let (settings, is_draft) = match step {
            CoverStep::Draft(samples) => (look.draft(samples), true),
            CoverStep::Rest(samples) => (look.at(samples, None), false),
        };
        CoverOrder { number: self.number, settings, is_draft }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use gpc::render::{MethodKind, SuperpixelOptions};
    use std::time::Duration;

    fn cover() -> Cover {
        let mut cover = Cover::default();
        cover.lenses.add(DVec2::ZERO, 100.0);
        cover
    }

    fn look(samples: u32) -> Look {
        let options = SuperpixelOptions::new(samples);
        Look::new(Settings::new(100, 100).method(options.clone()), options)
    }

    fn samples(order: &CoverOrder) -> (u32, bool) {
        (order.settings.method.samples(), order.is_draft)
    }

    #[test]
    fn pictures_are_refined_where_nothing_changes() {
        let now = Instant::now();
        let mut cover = cover();
        let first = cover.begin(Change::Scene, &look(256), now);
        assert_eq!(samples(&first), (1, true));
        assert_eq!(first.settings, look(256).draft(1));
        // The pictures after a draft wait for a rest.
        assert!(cover.arrived(first.number, Some(DraftTime { samples: 1, ms: 100.0 }), now));
        assert_eq!((cover.due(), cover.is_done()), (Some(now + REST), false));
        let second = cover.refine().unwrap();
        assert_eq!((samples(&second), cover.due()), ((64, false), None));
        let later = now + Duration::from_secs(1);
        assert!(cover.arrived(second.number, None, later));
        assert_eq!((cover.due(), cover.is_done()), (Some(later), false));
        let third = cover.refine().unwrap();
        assert_eq!(third.settings, look(256).at(256, None));
        assert!(cover.arrived(third.number, None, later) && cover.is_done());
        assert_eq!((cover.due(), cover.refine()), (None, None));
    }

    #[test]
    fn fast_drafts_get_more_samples() {
        let now = Instant::now();
        let mut cover = cover();
        for (expected, ms) in [(1, 10.0), (2, 10.0), (4, 10.0), (8, 500.0), (8, 500.0), (4, 90.0), (4, 90.0)] {
            let order = cover.begin(Change::Cover, &look(256), now);
            assert_eq!(samples(&order), (expected, true));
            cover.arrived(order.number, Some(DraftTime { samples: expected, ms }), now);
        }
        // Another look has other drafts.
        assert_eq!(samples(&cover.begin(Change::Cover, &look(64), now)), (1, true));
    }

    #[test]
    fn what_has_no_drafts_takes_one_picture() {
        let now = Instant::now();
        let mut cover = cover();
        cover.overlay = Some(Overlay::Error);
        let only = cover.begin(Change::Cover, &look(64), now);
        assert_eq!(samples(&only), (64, false));
        assert!(cover.arrived(only.number, None, now) && cover.is_done());
        let mut photo = cover.cleared(true);
        let only = photo.begin(Change::Scene, &look(64), now);
        assert!(!photo.is_done() && photo.arrived(only.number, None, now) && photo.is_done());
        // Without antialiasing the draft is the picture at rest.
        let mut cover = cover.cleared(false);
        cover.lenses.add(DVec2::ZERO, 100.0);
        let mut once = look(64);
        once.set_method(MethodKind::None);
        let only = cover.begin(Change::Scene, &once, now);
        assert!(cover.arrived(only.number, Some(DraftTime { samples: 1, ms: 1.0 }), now) && cover.is_done());
    }

    #[test]
    fn older_lenses_are_shown_and_older_scenes_are_not() {
        let now = Instant::now();
        let mut cover = cover();
        let first = cover.begin(Change::Scene, &look(64), now);
        let moved_lens = cover.begin(Change::Cover, &look(64), now);
        assert!(cover.arrived(first.number, None, now) && cover.due().is_none());
        let other_scene = cover.begin(Change::Scene, &look(64), now);
        assert!(!cover.arrived(moved_lens.number, None, now));
        assert!(cover.arrived(other_scene.number, None, now));
        cover.lenses.remove();
        assert!(!cover.arrived(other_scene.number, None, now) && cover.is_done());
    }

    #[test]
    fn older_views_are_shown_where_drafts_are_quick() {
        let now = Instant::now();
        let mut cover = cover();
        let shows_older_view = |cover: &mut Cover, ms: f64| {
            let before = cover.begin(Change::Cover, &look(64), now);
            cover.arrived(before.number, Some(DraftTime { samples: 1, ms }), now);
            let older = cover.begin(Change::View, &look(64), now);
            cover.begin(Change::View, &look(64), now);
            let is_shown = cover.arrived(older.number, None, now);
            assert_eq!(is_shown, cover.keeps_earlier(Change::View));
            is_shown
        };
        assert!(!cover.keeps_earlier(Change::View));
        assert!(shows_older_view(&mut cover, LIVE_MS));
        assert!(!shows_older_view(&mut cover, LIVE_MS + 1.0));
        assert!(shows_older_view(&mut cover, 1.0));
        cover.failed();
        assert!(!cover.keeps_earlier(Change::View));
        assert!(shows_older_view(&mut cover, 1.0));
        cover.overlay = Some(Overlay::Error);
        assert!(!cover.keeps_earlier(Change::View));
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
