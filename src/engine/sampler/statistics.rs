//! What a frame did, and what it left undone because the scene did not need it.

use super::EngineError;
use crate::engine::data::Counter;
use crate::vulkan::VulkanError;

/// GPU time of one pass.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTime {
    /// The pass.
    pub pass: &'static str,
    /// Milliseconds.
    pub ms: f64,
}

/// Triangles of the scene, and why some were not sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TriangleCounts {
    /// Triangles in the scene.
    pub total: u64,
    /// Triangles that were candidates for sub-samples.
    pub drawn: u64,
    /// Outside of the view.
    pub outside: u64,
    /// Facing away.
    pub backfacing: u64,
    /// Without area.
    pub degenerate: u64,
    /// Touching no superpixel.
    pub untouching: u64,
}

/// Figures of one frame; sums over its regions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Superpixels.
    pub superpixels: u64,
    /// Superpixels that the first few of their samples did not settle.
    pub resampled: u64,
    /// Tiles of 8 x 4 pixels.
    pub tiles: u64,
    /// Tiles that hold superpixels before these grow.
    pub busy_tiles: u64,
    /// Triangles of the antialiasing passes; counted once for each region.
    pub triangles: TriangleCounts,
    /// Triangles in the lists of tiles.
    pub candidates: u64,
    /// Visibility samples.
    pub records: u64,
    /// Tiles whose list outgrew its buffer, for which every triangle was a candidate.
    pub unlisted_tiles: u64,
    /// Rounds that had work.
    pub rounds: u64,
    /// Regions that the image was rendered in.
    pub regions: u64,
    /// Passes that the scene or the image did not need.
    pub skipped_passes: Vec<&'static str>,
    /// GPU time by pass, in order. Of rounds, the passes of the first one are timed each, and all others together as `rounds`.
    pub passes: Vec<PassTime>,
    /// Device memory of scene and frame in bytes.
    pub memory_bytes: u64,
}

impl Statistics {
    /// GPU time of the whole frame in milliseconds.
    #[must_use]
    pub fn gpu_ms(&self) -> f64 {
        self.passes.iter().map(|pass| pass.ms).sum()
    }

    /// Adds the time of a pass to what is booked under its name.
    pub(crate) fn add_time(&mut self, time: PassTime) {
        match self.passes.iter_mut().find(|known| known.pass == time.pass) {
            Some(known) => known.ms += time.ms,
            None => self.passes.push(time),
        }
    }

    /// Adds what other runs over the same scene did.
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
        self.records += other.records;
        self.unlisted_tiles += other.unlisted_tiles;
        self.rounds += other.rounds;
        self.regions += other.regions;
        self.memory_bytes = self.memory_bytes.max(other.memory_bytes);
        for time in other.passes {
            self.add_time(time);
        }
    }

    /// Adds the counters of one region's superpixels.
    pub(crate) fn add(&mut self, counters: &[u32]) {
        let get = |counter: Counter| u64::from(counter.of(counters));
        self.superpixels += get(Counter::Superpixels);
        self.resampled += get(Counter::Resampled);
        self.candidates += get(Counter::CandidatesTotal);
        self.records += get(Counter::RecordsTotal);
        self.unlisted_tiles += get(Counter::UnlistedTotal);
        self.rounds += get(Counter::Rounds);
    }

    /// Adds what the counters of one region's superpixels say of tiles and triangles.
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

/// What the sampling passes could not finish, by what they lacked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Shortfall {
    /// Tiles that no round took.
    pub waiting: u64,
    /// Cells whose records found no room in their round.
    pub crowded: u64,
    /// Cells with more candidates than loops may have trips.
    pub stalled: u64,
    /// Tiles without a list, where no kernel is made for them.
    pub unlisted: u64,
    /// Triangles that found no room among those that may touch a cell, or are thin.
    pub dropped: u64,
    /// Tiles and triangles of a light's view that were left, and cells in them.
    pub unshadowed: u64,
    /// How many times the room there is these would have needed.
    pub rooms: u32,
    /// Whether the device ran kernels in other subgroups than they were made for, which no capacity mends.
    pub other_subgroups: bool,
}

impl Shortfall {
    /// Adds a run of the sampling passes over so many tiles, with room for so many triangles, which sampled tiles without
    /// a list or left them.
    pub fn add(&mut self, counters: &[u32], (tiles, room): (u32, u32), samples_unlisted: bool) {
        let get = |counter: Counter| counter.of(counters);
        if get(Counter::Tiles) != 0 {
            self.waiting += u64::from(tiles.saturating_sub(get(Counter::NextTile)));
        }
        self.crowded += u64::from(get(Counter::Unfinished));
        self.stalled += u64::from(get(Counter::Stalled));
        if !samples_unlisted {
            self.unlisted += u64::from(get(Counter::UnlistedTotal));
        }
        let survivors = get(Counter::Survivors).saturating_add(get(Counter::Large));
        let thin = get(Counter::Thin).saturating_add(get(Counter::ThinLong));
        let listed = survivors.max(thin);
        self.dropped += u64::from(listed.saturating_sub(room));
        self.rooms = self.rooms.max(listed.div_ceil(room.max(1)));
    }

    /// Adds what kernels found of the subgroups that they were run in, as counters say at any later time.
    pub fn add_subgroups(&mut self, counters: &[u32]) {
        self.other_subgroups |= counters.get(Counter::Subgroups as usize) != Some(&0);
    }

    /// Cells and tiles that are left.
    pub fn left(&self) -> u64 {
        let of_lights = self.unshadowed;
        self.waiting + self.crowded + self.stalled + self.unlisted + self.dropped + of_lights
    }

    /// Fails where kernels that count on subgroups of `lanes` invocations had others.
    pub fn check_subgroups(&self, lanes: u32) -> Result<(), VulkanError> {
        if self.other_subgroups {
            return Err(VulkanError::Subgroups { lanes });
        }
        Ok(())
    }

    /// Fails where anything is left.
    pub fn check(&self, lanes: u32) -> Result<(), EngineError> {
        self.check_subgroups(lanes)?;
        match self.left() {
            0 => Ok(()),
            cells => Err(EngineError::Unfinished { cells }),
        }
    }
}
