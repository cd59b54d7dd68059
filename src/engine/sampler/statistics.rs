//! Statistics of a frame.

use crate::engine::data::Counter;
use crate::vulkan::PassTime;

/// Numbers of triangles of the scene, and reasons why some were not sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TriangleCounts {
    /// Number of triangles in the scene.
    pub total: u64,
    /// Number of triangles that were candidates for samples.
    pub drawn: u64,
    /// Number of triangles outside of the view.
    pub outside: u64,
    /// Number of triangles that face away.
    pub backfacing: u64,
    /// Number of triangles without an area.
    pub degenerate: u64,
    /// Number of triangles that touch no superpixel.
    pub untouching: u64,
}

/// Statistics of a frame: sums over its regions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Number of superpixels.
    pub superpixels: u64,
    /// Number of superpixels that are sampled by points, although samples of others lie on lines.
    pub resampled: u64,
    /// Number of tiles of 8 x 4 pixels.
    pub tiles: u64,
    /// Number of tiles that hold superpixels, before these grow.
    pub busy_tiles: u64,
    /// Triangles of the antialiasing passes, counted once for each region.
    pub triangles: TriangleCounts,
    /// Number of entries in the candidate lists of all tiles.
    pub candidates: u64,
    /// Number of visibility samples.
    pub visibility_samples: u64,
    /// Number of tiles without a candidate list: they have too many triangles, or the list outgrew its buffer.
    pub unlisted_tiles: u64,
    /// Number of rounds that had work to do.
    pub rounds: u64,
    /// Number of regions of the image.
    pub regions: u64,
    /// Names of the passes that the scene or the image did not need, and [`Self::BLEND`].
    pub skipped_passes: Vec<&'static str>,
    /// Device times of the passes, in order. The passes of the first round are timed separately, all further rounds
    /// together as [`PassTime::ROUNDS`].
    pub passes: Vec<PassTime>,
    /// Device memory of scene and frame, in bytes.
    pub memory_bytes: u64,
}

impl Statistics {
    /// Name of all passes that composite BLEND triangles in every pixel.
    pub const BLEND: &'static str = "blend";

    /// Device time of the whole frame in milliseconds, without the [output of the image](PassTime::is_output).
    #[must_use]
    pub fn gpu_ms(&self) -> f64 {
        PassTime::total(&self.passes)
    }

    /// Adds the time of a pass to the time under its name.
    pub(crate) fn add_time(&mut self, time: PassTime) {
        match self.passes.iter_mut().find(|known| known.pass == time.pass) {
            Some(known) => known.ms += time.ms,
            None => self.passes.push(time),
        }
    }

    /// Adds the statistics of other runs over the same scene.
    pub fn append(&mut self, other: Self) {
        self.superpixels += other.superpixels;
        self.resampled += other.resampled;
        self.tiles += other.tiles;
        self.busy_tiles += other.busy_tiles;
        self.triangles.total = self.triangles.total.max(other.triangles.total);
        self.triangles.drawn += other.triangles.drawn;
        self.triangles.outside += other.triangles.outside;
        self.triangles.backfacing += other.triangles.backfacing;
        self.triangles.degenerate += other.triangles.degenerate;
        self.triangles.untouching += other.triangles.untouching;
        self.candidates += other.candidates;
        self.visibility_samples += other.visibility_samples;
        self.unlisted_tiles += other.unlisted_tiles;
        self.rounds += other.rounds;
        self.regions += other.regions;
        self.memory_bytes = self.memory_bytes.max(other.memory_bytes);
        for time in other.passes {
            self.add_time(time);
        }
    }

    /// Adds the counters of a region's superpixels.
    pub(crate) fn add(&mut self, counters: &[u32]) {
        let get = |counter: Counter| u64::from(counter.of(counters));
        self.superpixels += get(Counter::Superpixels);
        self.resampled += get(Counter::Resampled);
        self.candidates += get(Counter::CandidatesTotal);
        self.visibility_samples += get(Counter::FragmentsTotal);
        self.unlisted_tiles += get(Counter::UnlistedTotal);
        self.rounds += get(Counter::Rounds);
    }

    /// Adds the counters of a region that are about tiles and triangles.
    pub(super) fn add_scene(&mut self, counters: &[u32]) {
        let get = |counter: Counter| u64::from(counter.of(counters));
        self.busy_tiles += get(Counter::Tiles);
        self.triangles.drawn += get(Counter::Survivors) + get(Counter::Large);
        self.triangles.outside += get(Counter::Outside);
        self.triangles.backfacing += get(Counter::Backfacing);
        self.triangles.degenerate += get(Counter::Degenerate);
        self.triangles.untouching += get(Counter::Untouching);
    }
}
