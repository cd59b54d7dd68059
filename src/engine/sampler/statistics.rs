//! Statistics of a frame, and the work that it left unfinished.

use super::EngineError;
use crate::engine::data::Counter;
use crate::vulkan::{PassTime, VulkanError};

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
    /// Number of superpixels whose first few samples did not suffice.
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
    pub records: u64,
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

    /// Device time of the whole frame in milliseconds.
    #[must_use]
    pub fn gpu_ms(&self) -> f64 {
        self.passes.iter().map(|pass| pass.ms).sum()
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
        self.records += other.records;
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
        self.records += get(Counter::RecordsTotal);
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

/// Work that the sampling passes could not finish, by the lacking resource.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Shortfall {
    /// Number of tiles that no round processed.
    pub waiting: u64,
    /// Factor by which the number of rounds would have to grow for the waiting tiles, if these need as much as others.
    pub rounds: u32,
    /// Number of cells whose visibility samples did not fit into their round.
    pub crowded: u64,
    /// Number of cells with more candidates than a loop may process.
    pub stalled: u64,
    /// Number of tiles without a list that were skipped, because the frame has no kernel for them.
    pub unlisted: u64,
    /// Number of triangles that did not fit into the list of triangles that may touch a cell, or into the list of thin
    /// triangles.
    pub dropped: u64,
    /// Number of tiles, triangles and cells of lights' views that were not processed.
    pub unshadowed: u64,
    /// Factor by which the room would have to grow to hold the dropped triangles and all pairs of a triangle and a
    /// tile.
    pub rooms: u32,
    /// Whether the device ran kernels with another subgroup size than they were made for; more capacity does not help
    /// then.
    pub other_subgroups: bool,
}

impl Shortfall {
    /// Adds a run of the sampling passes over `tiles` tiles, with room for `triangles` triangles and `pairs` pairs.
    /// `samples_unlisted` says whether tiles without a list were sampled or skipped.
    pub fn add(
        &mut self,
        counters: &[u32],
        (tiles, triangles, pairs): (u32, u32, u32),
        samples_unlisted: bool,
    ) {
        let get = |counter: Counter| counter.of(counters);
        if get(Counter::Tiles) != 0 {
            let done = get(Counter::NextTile);
            self.waiting += u64::from(tiles.saturating_sub(done));
            self.rounds = self.rounds.max(tiles.div_ceil(done.max(1)));
        }
        self.crowded += u64::from(get(Counter::Unfinished));
        self.stalled += u64::from(get(Counter::Stalled));
        if !samples_unlisted {
            self.unlisted += u64::from(get(Counter::UnlistedTotal));
        }
        let survivors = get(Counter::Survivors).saturating_add(get(Counter::Large));
        let thin = get(Counter::Thin).saturating_add(get(Counter::ThinLong));
        let listed = survivors.max(thin);
        self.dropped += u64::from(listed.saturating_sub(triangles));
        let needed = [(listed, triangles), (get(Counter::Pairs), pairs)];
        let rooms = needed.map(|(needed, room)| needed.div_ceil(room.max(1)));
        self.rooms = self.rooms.max(rooms[0]).max(rooms[1]);
    }

    /// Adds the counter of wrong subgroup sizes, which may be read at any later time.
    pub fn add_subgroups(&mut self, counters: &[u32]) {
        self.other_subgroups |= counters.get(Counter::Subgroups as usize) != Some(&0);
    }

    /// Number of cells and tiles that were not finished.
    pub fn left(&self) -> u64 {
        let of_lights = self.unshadowed;
        self.waiting + self.crowded + self.stalled + self.unlisted + self.dropped + of_lights
    }

    /// Returns an error if kernels that need subgroups of `lanes` invocations ran in others.
    pub fn check_subgroups(&self, lanes: u32) -> Result<(), VulkanError> {
        if self.other_subgroups {
            return Err(VulkanError::Subgroups { lanes });
        }
        Ok(())
    }

    /// Returns an error if any work was not finished.
    pub fn check(&self, lanes: u32) -> Result<(), EngineError> {
        self.check_subgroups(lanes)?;
        match self.left() {
            0 => Ok(()),
            cells => Err(EngineError::Unfinished { cells }),
        }
    }
}
