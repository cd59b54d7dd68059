//! Schedule of rendering: few samples while anything moves, more and more at rest, in bands short enough for the
//! window to stay responsive.

use super::look::Look;
use gpc::render::{MethodKind, Statistics};
use std::ops::Range;
use std::time::{Duration, Instant};

/// Time without changes before a picture is refined.
const REST: Duration = Duration::from_millis(150);
/// Device milliseconds that a band, or a picture while something moves, should take.
const TARGET_MS: f64 = 80.0;
/// Number of slow pictures in a row that are tolerated before the number of samples is reduced: other programs may be
/// busy for a moment.
const MOST_SLOW: u32 = 2;
/// Time before a number of samples that was too slow is tried again; a rest ends it early.
const AGAIN: Duration = Duration::from_secs(2);
/// Number of rows of which the height of a band is a multiple: the height of a tile.
const ROW_STEP: u32 = 4;
/// Expected ratio of a row's time with the next number of samples to its time with the present one, until a row has
/// been measured.
const STEP_COST: f64 = 2.0;
/// Passes over the scene's triangles, which take as long for one row as for all.
const OF_TRIANGLES: [&str; 5] = ["pose", "stroke", "thin", "cull", "shadows"];
/// Numbers of samples while something moves, the largest first.
const DRAFTS: [u32; 5] = [16, 8, 4, 2, 1];
/// Numbers of samples between a draft and the number asked for.
const STEPS: [u32; 2] = [64, 256];

/// A piece of work on a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PictureWork {
    /// The whole picture at once.
    Draft {
        /// Samples a pixel.
        samples: u32,
    },
    /// A band: some rows of the picture.
    Band {
        /// Samples a pixel.
        samples: u32,
        /// Range of the rows.
        rows: Range<u32>,
    },
}

/// Device milliseconds that a piece of work took.
#[derive(Clone, Copy, Debug)]
pub struct Took {
    pub ms: f64,
    /// Milliseconds that do not depend on the number of rows, included in `ms`.
    pub fixed_ms: f64,
}

impl Took {
    pub fn of(statistics: &Statistics) -> Self {
        let passes = statistics.passes.iter();
        let fixed = passes.filter(|pass| OF_TRIANGLES.contains(&pass.pass));
        Self { ms: statistics.gpu_ms(), fixed_ms: fixed.map(|pass| pass.ms).sum() }
    }

    /// Milliseconds per row of `rows` rows, without the fixed part.
    fn of_row(self, rows: u32) -> f64 {
        (self.ms - self.fixed_ms) / f64::from(rows.max(1))
    }
}

/// Work that is left to do on a picture.
#[derive(Debug)]
pub struct PictureSchedule {
    /// Numbers of samples while something moves, the largest first.
    drafts: Vec<u32>,
    /// Number of samples of the draft that equals the picture at rest, if there is one.
    final_draft: Option<u32>,
    /// Index in `drafts` of the number that is fast enough.
    draft: usize,
    /// Number of pictures in a row that were too slow.
    slow: u32,
    /// Time at which the draft with the next larger number of samples was found to be too slow.
    too_slow: Option<Instant>,
    /// Numbers of samples at rest, up to the one asked for.
    steps: Vec<u32>,
    height: u32,
    /// Time at which the picture last changed.
    changed: Instant,
    step: Phase,
    /// Expected milliseconds of a row.
    row_ms: f64,
    /// Expected milliseconds of a band that do not depend on its number of rows.
    fixed_ms: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    Draft,
    /// Rendering bands with `samples` samples, the next one from row `row` on.
    Band {
        samples: u32,
        row: u32,
    },
    Done,
}

impl PictureSchedule {
    /// Schedule of a picture that has not been rendered.
    pub fn new(look: &Look, now: Instant) -> Self {
        let asked = look.samples();
        let below = |samples: &u32| *samples < asked && look.can_have(*samples);
        // Supersampling shades every sample of every pixel, so that only one sample is fast.
        let is_brute = look.method() == MethodKind::Ssaa;
        let is_quick = |samples: &u32| below(samples) && (!is_brute || *samples == 1);
        let mut drafts: Vec<_> = DRAFTS.into_iter().filter(is_quick).collect();
        if drafts.is_empty() || (asked <= DRAFTS[0] && !is_brute) {
            drafts.insert(0, asked);
        }
        let is_final = |samples: &u32| look.draft(*samples) == look.at(asked, None);
        let final_draft = drafts.iter().copied().find(is_final);
        let mut steps: Vec<_> = STEPS.into_iter().filter(below).collect();
        steps.push(asked);
        let height = look.settings.size[1];
        Self {
            drafts,
            final_draft,
            draft: 0,
            slow: 0,
            too_slow: None,
            steps,
            height,
            changed: now,
            step: Phase::Draft,
            row_ms: TARGET_MS / f64::from(height.max(1)),
            fixed_ms: 0.0,
        }
    }

    /// Starts again because the view or the scene has changed.
    pub fn restart(&mut self, now: Instant) {
        self.changed = now;
        self.step = Phase::Draft;
    }

    /// Takes the next piece of work, if any is due.
    pub fn take(&mut self, now: Instant) -> Option<PictureWork> {
        match self.step {
            Phase::Draft => {
                let samples = self.draft_samples();
                self.step = match (self.final_draft == Some(samples), self.steps.first()) {
                    (false, Some(first)) => Phase::Band { samples: *first, row: 0 },
                    _ => Phase::Done,
                };
                Some(PictureWork::Draft { samples })
            }
            Phase::Band { row: 0, .. } if now < self.changed + REST => None,
            Phase::Band { samples, row } => {
                if row == 0 {
                    self.too_slow = None;
                    self.row_ms *= STEP_COST;
                }
                // The rows take at least half of a band's time; otherwise a picture of many triangles would never be
                // finished.
                let target = TARGET_MS.max(2.0 * self.fixed_ms) - self.fixed_ms;
                let rows = (target / self.row_ms).min(f64::from(self.height)) as u32;
                let rows = (rows / ROW_STEP * ROW_STEP).max(ROW_STEP);
                let end = (row + rows).min(self.height);
                self.step = if end < self.height { Phase::Band { samples, row: end } } else { self.after(samples) };
                Some(PictureWork::Band { samples, rows: row..end })
            }
            Phase::Done => None,
        }
    }

    /// Whether the draft has still to be rendered.
    pub fn is_draft(&self) -> bool {
        self.step == Phase::Draft
    }

    /// Time at which the next piece of work is due, if any is left.
    pub fn due(&self) -> Option<Instant> {
        match self.step {
            Phase::Done => None,
            Phase::Draft => Some(self.changed),
            Phase::Band { .. } => Some(self.changed + REST),
        }
    }

    /// Whether all work has been taken: the picture has all its samples once that work is done.
    pub fn is_done(&self) -> bool {
        self.step == Phase::Done
    }

    /// Adapts the schedule to the time that a piece of work took on the device.
    pub fn learn(&mut self, work: &PictureWork, took: Took, now: Instant) {
        match work {
            PictureWork::Draft { samples } => {
                self.row_ms = took.of_row(self.height);
                self.fixed_ms = took.fixed_ms;
                if *samples == self.draft_samples() {
                    self.learn_draft(took.ms, now);
                }
            }
            PictureWork::Band { samples, rows } if self.is_rendering(*samples) => {
                self.fixed_ms = took.fixed_ms;
                let found = took.of_row(rows.end - rows.start);
                // Rows differ within an image, so the estimate moves half of the way, but stays near the last
                // measurement.
                let halfway = (self.row_ms * found).sqrt();
                self.row_ms = halfway.clamp(0.5 * found, 2.0 * found);
            }
            // The last bands of a step may finish after the next step has begun.
            PictureWork::Band { .. } => {}
        }
    }

    /// Reduces the samples of drafts after several slow ones in a row, and raises them after fast ones, but not at
    /// once to a number that was too slow.
    fn learn_draft(&mut self, ms: f64, now: Instant) {
        if ms <= 1.25 * TARGET_MS {
            self.slow = 0;
            let may_try = self.too_slow.is_none_or(|then| now > then + AGAIN);
            if ms < 0.6 * TARGET_MS && self.draft > 0 && may_try {
                self.draft -= 1;
            }
            return;
        }
        self.slow += 1;
        if self.slow >= MOST_SLOW && self.draft + 1 < self.drafts.len() {
            self.draft += 1;
            self.slow = 0;
            self.too_slow = Some(now);
        }
    }

    /// Whether bands with `samples` samples are being rendered.
    fn is_rendering(&self, samples: u32) -> bool {
        matches!(self.step, Phase::Band { samples: at_hand, .. } if at_hand == samples)
    }

    /// Number of samples while something moves.
    fn draft_samples(&self) -> u32 {
        // The list is never empty, and the index stays within it.
        self.drafts.get(self.draft).copied().unwrap_or(1)
    }

    /// Phase that follows a picture with `done` samples.
    fn after(&self, done: u32) -> Phase {
        let next = self.steps.iter().find(|step| **step > done);
        next.map_or(Phase::Done, |samples| Phase::Band { samples: *samples, row: 0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gpc::render::{Settings, SuperpixelOptions};
    use gpc::sampling::Pattern;

    fn schedule(method: MethodKind, samples: u32, height: u32, now: Instant) -> PictureSchedule {
        let settings = Settings::new(100, height).method(method.with_samples(samples));
        PictureSchedule::new(&Look::new(settings, SuperpixelOptions::new(64)), now)
    }

    fn after(ms: u64, start: Instant) -> Instant {
        start + Duration::from_millis(ms)
    }

    /// Samples and rows of all bands until the picture is done, if each row takes `ms` milliseconds.
    fn bands(schedule: &mut PictureSchedule, ms: f64, now: Instant) -> Vec<(u32, Range<u32>)> {
        let mut bands = Vec::new();
        while let Some(work) = schedule.take(now) {
            if let PictureWork::Band { samples, rows } = &work {
                let fixed_ms = schedule.fixed_ms;
                let ms = fixed_ms + ms * f64::from(rows.end - rows.start);
                schedule.learn(&work, Took { ms, fixed_ms }, now);
                bands.push((*samples, rows.clone()));
            }
        }
        bands
    }

    #[test]
    fn refines_at_rest_and_every_row_once() {
        let start = Instant::now();
        let mut schedule = schedule(MethodKind::Superpixel, 1024, 540, start);
        assert_eq!(schedule.take(start), Some(PictureWork::Draft { samples: 16 }));
        assert_eq!(schedule.take(after(149, start)), None);
        assert_eq!(schedule.due(), Some(after(150, start)));
        let bands = bands(&mut schedule, 2.0, after(150, start));
        for samples in [64, 256, 1024] {
            let mut row = 0;
            for (_, rows) in bands.iter().filter(|band| band.0 == samples) {
                assert_eq!(rows.start, row);
                assert!(rows.end == 540 || rows.end % ROW_STEP == 0);
                row = rows.end;
            }
            assert_eq!(row, 540);
        }
        assert!(schedule.is_done() && schedule.due().is_none());
        // Bands adapt their height: 80 ms are 40 rows.
        let last = &bands[bands.len() - 2].1;
        assert!((36..=44).contains(&(last.end - last.start)), "{last:?}");
    }

    #[test]
    fn bands_of_many_triangles_are_higher() {
        let start = Instant::now();
        let mut schedule = schedule(MethodKind::Superpixel, 64, 540, start);
        let draft = schedule.take(start).unwrap();
        let took = Took { ms: 740.0, fixed_ms: 200.0 };
        schedule.learn(&draft, took, start);
        let bands = bands(&mut schedule, 2.0, after(150, start));
        // 200 ms are fixed, and 100 rows take another 200 ms.
        let heights: Vec<_> = bands.iter().map(|(_, rows)| rows.end - rows.start).collect();
        assert_eq!(heights, [100, 100, 100, 100, 100, 40]);
    }

    #[test]
    fn a_change_begins_again() {
        let start = Instant::now();
        let mut schedule = schedule(MethodKind::Superpixel, 64, 100, start);
        schedule.take(start);
        assert!(matches!(schedule.take(after(200, start)), Some(PictureWork::Band { samples: 64, .. })));
        schedule.restart(after(210, start));
        assert_eq!(schedule.take(after(210, start)), Some(PictureWork::Draft { samples: 16 }));
        assert_eq!(schedule.take(after(300, start)), None);
    }

    #[test]
    fn drafts_get_cheaper_until_they_are_fluid() {
        let start = Instant::now();
        let mut schedule = schedule(MethodKind::Superpixel, 1024, 100, start);
        let draft = |schedule: &mut PictureSchedule, ms: f64, now: Instant| {
            schedule.restart(now);
            let work = schedule.take(now).unwrap();
            schedule.learn(&work, Took { ms, fixed_ms: 0.0 }, now);
            work
        };
        // One slow draft changes nothing; two in a row do.
        for (ms, samples) in [(200.0, 16), (90.0, 16), (200.0, 16), (200.0, 16), (90.0, 8)] {
            let work = draft(&mut schedule, ms, start);
            assert_eq!(work, PictureWork::Draft { samples });
        }
        for samples in [8, 8, 4, 4, 2, 2, 1, 1, 1] {
            let work = draft(&mut schedule, 200.0, start);
            assert_eq!(work, PictureWork::Draft { samples });
        }
        // A number that was too slow is tried again only after a while.
        let soon = after(1000, start);
        assert_eq!(draft(&mut schedule, 10.0, soon), PictureWork::Draft { samples: 1 });
        assert_eq!(draft(&mut schedule, 10.0, soon), PictureWork::Draft { samples: 1 });
        let later = after(2001, start);
        draft(&mut schedule, 10.0, later);
        assert_eq!(draft(&mut schedule, 90.0, later), PictureWork::Draft { samples: 2 });
        // A rest also lets it be tried again.
        for _ in 0..2 {
            draft(&mut schedule, 200.0, later);
        }
        schedule.take(after(2200, start));
        draft(&mut schedule, 10.0, later);
        assert_eq!(draft(&mut schedule, 90.0, later), PictureWork::Draft { samples: 2 });
    }

    #[test]
    fn methods_with_one_number_of_samples_are_done_at_once() {
        let start = Instant::now();
        for (method, samples) in [(MethodKind::None, 1), (MethodKind::Msaa, 4), (MethodKind::Ssaa, 1)] {
            let mut schedule = schedule(method, samples, 100, start);
            assert_eq!(schedule.take(start), Some(PictureWork::Draft { samples }));
            assert!(schedule.is_done());
        }
        // Drafts of superpixels have cheaper settings, so that the same number of samples is rendered again at rest.
        let mut few = schedule(MethodKind::Superpixel, 4, 100, start);
        assert_eq!(few.take(start), Some(PictureWork::Draft { samples: 4 }));
        let rest = after(150, start);
        assert!(matches!(few.take(rest), Some(PictureWork::Band { samples: 4, .. })));
        let mut brute = schedule(MethodKind::Ssaa, 256, 100, start);
        assert_eq!(brute.take(start), Some(PictureWork::Draft { samples: 1 }));
        let mut samples: Vec<_> = bands(&mut brute, 0.1, after(150, start)).into_iter().map(|band| band.0).collect();
        samples.dedup();
        assert_eq!(samples, [64, 256]);
    }

    #[test]
    fn steps_are_what_the_pattern_can_have() {
        let start = Instant::now();
        let options = SuperpixelOptions::new(1024).pattern(Pattern::Grid);
        let settings = Settings::new(100, 100).method(options.clone());
        let schedule = PictureSchedule::new(&Look::new(settings, options), start);
        assert_eq!(schedule.drafts, [16, 4, 1]);
        assert_eq!(schedule.steps, [64, 256, 1024]);
    }
}
