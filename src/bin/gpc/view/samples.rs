//! Numbers of samples a pixel of a picture that is refined: few while something moves, then more in steps.

use super::look::Look;
use gpc::render::MethodKind;
use std::time::{Duration, Instant};

/// Time without changes before a picture is refined.
pub const REST: Duration = Duration::from_millis(150);
/// Milliseconds that a picture should take while something moves.
pub const TARGET_MS: f64 = 80.0;
/// Number of slow pictures in a row that are tolerated before the number of samples is reduced: other programs may be
/// busy for a moment.
const MOST_SLOW: u32 = 2;
/// Time before a number of samples that was too slow is tried again; a rest ends it early.
const AGAIN: Duration = Duration::from_secs(2);
/// Numbers of samples while something moves, the largest first.
const DRAFTS: [u32; 5] = [16, 8, 4, 2, 1];
/// Numbers of samples between a draft and the number asked for.
const STEPS: [u32; 2] = [64, 256];

/// Numbers of samples of the pictures of a look.
#[derive(Debug)]
pub struct SampleSteps {
    /// Numbers of samples while something moves, the largest first.
    drafts: Vec<u32>,
    /// Number of samples of the draft that equals the picture at rest, if there is one.
    final_draft: Option<u32>,
    /// Index in `drafts` of the number that is fast enough.
    draft: usize,
    /// Number of drafts in a row that were too slow.
    slow: u32,
    /// Time at which the draft with the next larger number of samples was found to be too slow.
    too_slow: Option<Instant>,
    /// Numbers of samples at rest, up to the one asked for.
    steps: Vec<u32>,
}

impl SampleSteps {
    /// Numbers for pictures that take longer than frames. Drafts have the fewest samples until these are known to be fast.
    pub fn for_covers(look: &Look) -> Self {
        let steps = Self::new(look);
        Self { draft: steps.drafts.len().saturating_sub(1), ..steps }
    }

    /// Numbers for frames. Drafts have the most samples until these are known to be slow.
    pub fn new(look: &Look) -> Self {
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
        Self { drafts, final_draft, draft: 0, slow: 0, too_slow: None, steps }
    }

    /// Number of samples while something moves.
    pub fn draft(&self) -> u32 {
        // The list is never empty, and the index stays within it.
        self.drafts.get(self.draft).copied().unwrap_or(1)
    }

    /// Number of samples of the first picture at rest after a draft with `draft` samples; `None` if the draft equals it.
    pub fn first(&self, draft: u32) -> Option<u32> {
        self.steps.first().copied().filter(|_| self.final_draft != Some(draft))
    }

    /// Number of samples of the next picture at rest after one with `done` samples.
    pub fn after(&self, done: u32) -> Option<u32> {
        self.steps.iter().copied().find(|step| *step > done)
    }

    /// Lets a number of samples that was too slow be tried again.
    pub fn rest(&mut self) {
        self.too_slow = None;
    }

    /// Adapts the number of samples of drafts to the time that one took. The number is reduced after several slow drafts in
    /// a row, and raised after fast ones, but not at once to a number that was too slow.
    pub fn learn(&mut self, samples: u32, ms: f64, now: Instant) {
        if samples != self.draft() {
            return;
        }
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use gpc::render::{Settings, SuperpixelOptions};
    use gpc::sampling::Pattern;

    fn superpixels(samples: u32) -> SampleSteps {
        let options = SuperpixelOptions::new(samples);
        SampleSteps::new(&Look::new(Settings::new(100, 100).method(options.clone()), options))
    }

    fn after(ms: u64, start: Instant) -> Instant {
        start + Duration::from_millis(ms)
    }

    #[test]
    fn drafts_get_cheaper_until_they_are_fluid() {
        let start = Instant::now();
        let mut steps = superpixels(1024);
        let draft = |steps: &mut SampleSteps, ms: f64, now: Instant| {
            let samples = steps.draft();
            steps.learn(samples, ms, now);
            samples
        };
        // One slow draft changes nothing; two in a row do.
        for (ms, samples) in [(200.0, 16), (90.0, 16), (200.0, 16), (200.0, 16), (90.0, 8)] {
            assert_eq!(draft(&mut steps, ms, start), samples);
        }
        for samples in [8, 8, 4, 4, 2, 2, 1, 1, 1] {
            assert_eq!(draft(&mut steps, 200.0, start), samples);
        }
        // A number that was too slow is tried again only after a while.
        let soon = after(1000, start);
        assert_eq!(draft(&mut steps, 10.0, soon), 1);
        assert_eq!(draft(&mut steps, 10.0, soon), 1);
        let later = after(2001, start);
        draft(&mut steps, 10.0, later);
        assert_eq!(draft(&mut steps, 90.0, later), 2);
        // A rest also lets it be tried again.
        for _ in 0..2 {
            draft(&mut steps, 200.0, later);
        }
        steps.rest();
        draft(&mut steps, 10.0, later);
        assert_eq!(draft(&mut steps, 90.0, later), 2);
    }

    #[test]
    fn steps_are_what_the_pattern_can_have() {
        let options = SuperpixelOptions::new(1024).pattern(Pattern::Grid);
        let settings = Settings::new(100, 100).method(options.clone());
        let steps = SampleSteps::new(&Look::new(settings, options));
        assert_eq!(steps.drafts, [16, 4, 1]);
        assert_eq!(steps.steps, [64, 256, 1024]);
        assert_eq!((steps.first(16), steps.after(64), steps.after(1024)), (Some(64), Some(256), None));
    }
}
