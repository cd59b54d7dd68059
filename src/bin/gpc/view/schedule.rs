//! Schedule of rendering: few samples while anything moves, more and more at rest, in bands short enough for the
//! window to stay responsive.

use super::band::{BandHeights, Took};
use super::look::Look;
use super::samples::{REST, SampleSteps};
use std::ops::Range;
use std::time::Instant;

/// Expected ratio of a row's time with the next number of samples to its time with the present one, until a row has
/// been measured.
const STEP_COST: f64 = 2.0;

/// A piece of work on a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PictureWork {
    /// Samples a pixel.
    pub samples: u32,
    /// Rows of the picture; all of them for a draft.
    pub rows: Range<u32>,
    /// Whether the whole picture is rendered at once, with the cheaper settings of a draft.
    pub is_draft: bool,
}

/// Work that is left to do on a picture.
#[derive(Debug)]
pub struct PictureSchedule {
    samples: SampleSteps,
    bands: BandHeights,
    height: u32,
    /// Time at which the picture last changed.
    changed: Instant,
    step: Phase,
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

impl Phase {
    /// Phase that begins with the first row of a picture with `samples` samples, if there is such a picture.
    fn of(samples: Option<u32>) -> Self {
        samples.map_or(Self::Done, |samples| Self::Band { samples, row: 0 })
    }
}

impl PictureSchedule {
    /// Schedule of a picture that has not been rendered.
    pub fn new(look: &Look, now: Instant) -> Self {
        let height = look.settings.size[1];
        Self {
            samples: SampleSteps::new(look),
            bands: BandHeights::new(height, height),
            height,
            changed: now,
            step: Phase::Draft,
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
                let samples = self.samples.draft();
                self.step = Phase::of(self.samples.first(samples));
                Some(PictureWork { samples, rows: 0..self.height, is_draft: true })
            }
            Phase::Band { row: 0, .. } if now < self.changed + REST => None,
            Phase::Band { samples, row } => {
                if row == 0 {
                    self.samples.rest();
                    self.bands.expect(STEP_COST);
                }
                let rows = self.bands.band(row);
                self.step = match rows.end < self.height {
                    true => Phase::Band { samples, row: rows.end },
                    false => Phase::of(self.samples.after(samples)),
                };
                Some(PictureWork { samples, rows, is_draft: false })
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
        if work.is_draft {
            self.bands.learn_all(took);
            self.samples.learn(work.samples, took.ms, now);
        } else if self.is_rendering(work.samples) {
            // The last bands of a step may finish after the next step has begun.
            self.bands.learn(work.rows.end - work.rows.start, took);
        }
    }

    /// Whether bands with `samples` samples are being rendered.
    fn is_rendering(&self, samples: u32) -> bool {
        matches!(self.step, Phase::Band { samples: at_hand, .. } if at_hand == samples)
    }
}

#[cfg(test)]
mod tests {
    use super::super::band::ROW_STEP;
    use super::*;
    use gpc::render::{MethodKind, Settings, SuperpixelOptions};
    use std::time::Duration;

    fn schedule(method: MethodKind, samples: u32, height: u32, now: Instant) -> PictureSchedule {
        let settings = Settings::new(100, height).method(method.with_samples(samples));
        PictureSchedule::new(&Look::new(settings, SuperpixelOptions::new(64)), now)
    }

    /// Samples of the next work if it is a draft, or if it is a band.
    fn next(schedule: &mut PictureSchedule, is_draft: bool, now: Instant) -> Option<u32> {
        schedule.take(now).filter(|work| work.is_draft == is_draft).map(|work| work.samples)
    }

    fn after(ms: u64, start: Instant) -> Instant {
        start + Duration::from_millis(ms)
    }

    /// Samples and rows of all bands until the picture is done, if each band takes `fixed_ms` milliseconds and each row `row_ms`.
    fn bands(schedule: &mut PictureSchedule, fixed_ms: f64, row_ms: f64, now: Instant) -> Vec<(u32, Range<u32>)> {
        let mut bands = Vec::new();
        while let Some(work) = schedule.take(now) {
            if !work.is_draft {
                let ms = fixed_ms + row_ms * f64::from(work.rows.end - work.rows.start);
                schedule.learn(&work, Took { ms, fixed_ms }, now);
                bands.push((work.samples, work.rows));
            }
        }
        bands
    }

    #[test]
    fn refines_at_rest_and_every_row_once() {
        let start = Instant::now();
        let mut schedule = schedule(MethodKind::Superpixel, 1024, 540, start);
        assert_eq!(next(&mut schedule, true, start), Some(16));
        assert_eq!(schedule.take(after(149, start)), None);
        assert_eq!(schedule.due(), Some(after(150, start)));
        let bands = bands(&mut schedule, 0.0, 2.0, after(150, start));
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
        let bands = bands(&mut schedule, took.fixed_ms, 2.0, after(150, start));
        // 200 ms are fixed, and 100 rows take another 200 ms.
        let heights: Vec<_> = bands.iter().map(|(_, rows)| rows.end - rows.start).collect();
        assert_eq!(heights, [100, 100, 100, 100, 100, 40]);
    }

    #[test]
    fn a_change_begins_again() {
        let start = Instant::now();
        let mut schedule = schedule(MethodKind::Superpixel, 64, 100, start);
        schedule.take(start);
        assert_eq!(next(&mut schedule, false, after(200, start)), Some(64));
        schedule.restart(after(210, start));
        assert_eq!(next(&mut schedule, true, after(210, start)), Some(16));
        assert_eq!(schedule.take(after(300, start)), None);
    }

    #[test]
    fn methods_with_one_number_of_samples_are_done_at_once() {
        let start = Instant::now();
        for (method, samples) in [(MethodKind::None, 1), (MethodKind::Msaa, 4), (MethodKind::Ssaa, 1)] {
            let mut schedule = schedule(method, samples, 100, start);
            assert_eq!(next(&mut schedule, true, start), Some(samples));
            assert!(schedule.is_done());
        }
        // Drafts of superpixels have cheaper settings, so that the same number of samples is rendered again at rest.
        let mut few = schedule(MethodKind::Superpixel, 4, 100, start);
        assert_eq!(next(&mut few, true, start), Some(4));
        let rest = after(150, start);
        assert_eq!(next(&mut few, false, rest), Some(4));
        let mut brute = schedule(MethodKind::Ssaa, 256, 100, start);
        assert_eq!(next(&mut brute, true, start), Some(1));
        let mut samples: Vec<_> =
            bands(&mut brute, 0.0, 0.1, after(150, start)).into_iter().map(|band| band.0).collect();
        samples.dedup();
        assert_eq!(samples, [64, 256]);
    }
}
