//! Capacity of a recording, and the shortfall of one that was not finished.
//!
//! A recording is made with a [`Capacity`], before anyone knows how much work there will be. Once its commands have run, its
//! [`Shortfall`] says what was left undone. [`Capacity::more`] is the capacity with which it is made again. Frames, lists and
//! hosts all use this.

use super::{EngineError, RoundPolicy};
use crate::engine::data::Counter;
use crate::engine::passes::LongLists;

/// Factor for the number of rounds from which on more rounds no longer help.
const MANY_ROUNDS: u32 = 8;
/// Factor for the room for lists, and number of layers, from which on more of them is not tried.
const MOST_GROWTH: u32 = 1 << 16;

/// Capacity of a frame. It is raised if a frame turns out to need more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Capacity {
    /// Number of BLEND layers of a list for which tiles are admitted; half of the number of lists in a block.
    pub layers: u32,
    /// Factor for the room for candidates and pairs.
    pub lists: u32,
    /// Factor on the number of recorded rounds that images usually need; `None` to record all rounds that any image may
    /// need.
    pub rounds: Option<u32>,
    /// How cells with long lists of candidates are sampled.
    pub long_lists: LongLists,
    /// Whether tiles without a list of candidates are sampled.
    pub samples_unlisted: bool,
    /// Whether receivers of light are looked up in the lists of the tiles of a light's plane. Otherwise they are sampled, which takes
    /// several times as long, but does not need the lists.
    pub looks_up_occluders: bool,
}

impl Capacity {
    /// Number of BLEND layers of a list for which a frame is first planned.
    pub const LAYERS: u32 = 4;

    /// This capacity with `factor` times the room for candidates.
    pub fn with_lists(self, factor: u32) -> Self {
        Self { lists: self.lists.saturating_mul(factor.next_power_of_two()), ..self }
    }

    /// Capacity for the first of a device's frames that are made again if they need more rounds than images usually do.
    pub fn usual(policy: RoundPolicy) -> Self {
        Self {
            rounds: match policy {
                RoundPolicy::Small => None,
                RoundPolicy::Large { .. } => Some(1),
            },
            ..Self::default()
        }
    }

    /// Whether more than this may be tried: memory that has grown so much no longer helps.
    pub fn can_grow(&self) -> bool {
        self.lists.max(self.layers) < MOST_GROWTH
    }

    /// Factor by which the memory has grown since the first frame.
    pub fn growth(&self) -> u64 {
        u64::from(self.lists.max(self.layers / Self::LAYERS))
    }

    /// This capacity without the kernels for tiles without a list, which few frames need. Compiling these kernels may
    /// take longer than a frame.
    pub fn without_unlisted_tiles(self) -> Self {
        Self { samples_unlisted: false, ..self }
    }

    /// This capacity for an owner whose memory may be limited. The lists in which receivers of light are looked up take much memory.
    pub fn within(self, max_memory: Option<u64>) -> Self {
        Self { looks_up_occluders: self.looks_up_occluders && max_memory.is_none(), ..self }
    }

    /// Capacity for a frame that needed more than this one: several times as much of each lacking resource, or as much
    /// as the frame is known to need. Tiles without a list are sampled only if more room for lists did not help,
    /// because testing every triangle takes long.
    pub fn more(self, shortfall: Shortfall) -> Self {
        let factor = |lacked: bool, factor: u32| if lacked { factor } else { 1 };
        let looks_up_occluders = self.looks_up_occluders && shortfall.unshadowed == 0;
        // If receivers could not be looked up, they are sampled with the capacity that there is.
        let unshadowed = shortfall.unshadowed > 0 && !self.looks_up_occluders;
        // The counters don't say what passes of lights lacked. Rounds are raised first, as long as there are few.
        let of_lights = unshadowed && self.rounds.is_none_or(|rounds| rounds >= MANY_ROUNDS);
        let crowded = shortfall.crowded > 0;
        // Lists are lengthened next, and layers are raised last.
        let deeper = of_lights && self.long_lists == LongLists::Scattered;
        let lists = factor(shortfall.dropped > 0 || of_lights, 2).max(factor(crowded, 4));
        let rounds =
            factor(shortfall.waiting > 0, 2).max(factor(unshadowed, 4)).max(shortfall.rounds.next_power_of_two());
        Self {
            layers: self.layers.saturating_mul(factor(crowded, 4).max(factor(deeper, 2))),
            rounds: self.rounds.map(|usual| usual.saturating_mul(rounds)),
            long_lists: if of_lights || shortfall.stalled > 0 { self.long_lists.shorter() } else { self.long_lists },
            samples_unlisted: self.samples_unlisted
                || (shortfall.unlisted_tiles > 0 && (shortfall.rooms <= 1 || self.lists > 1)),
            looks_up_occluders,
            ..self.with_lists(lists.max(shortfall.rooms))
        }
    }

    /// Number of visibility samples for `samples` samples with all layers; 0 if the frame is not known to need more
    /// layers than usual.
    pub fn layered(&self, samples: u64) -> u64 {
        match self.layers {
            Self::LAYERS => 0,
            layers => samples * (2 + u64::from(layers)),
        }
    }
}

impl Default for Capacity {
    fn default() -> Self {
        Self {
            layers: Self::LAYERS,
            lists: 1,
            rounds: None,
            long_lists: LongLists::default(),
            samples_unlisted: true,
            looks_up_occluders: true,
        }
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
    pub unlisted_tiles: u64,
    /// Number of triangles that did not fit into the list of triangles that may touch a cell, or into the list of thin
    /// triangles.
    pub dropped: u64,
    /// Number of tiles, triangles and cells of lights' views that were not processed.
    pub unshadowed: u64,
    /// Factor by which the room would have to grow to hold the dropped triangles and all pairs of a triangle and a
    /// tile.
    pub rooms: u32,
}

impl Shortfall {
    /// Adds a run of the sampling passes over `tiles` tiles, with room for `triangles` triangles and `pairs` pairs.
    /// `samples_unlisted` says whether tiles without a list were sampled or skipped.
    pub fn add(&mut self, counters: &[u32], (tiles, triangles, pairs): (u32, u32, u32), samples_unlisted: bool) {
        let get = |counter: Counter| counter.of(counters);
        if get(Counter::Tiles) != 0 {
            let done = get(Counter::NextTile);
            self.waiting += u64::from(tiles.saturating_sub(done));
            self.rounds = self.rounds.max(tiles.div_ceil(done.max(1)));
        }
        self.crowded += u64::from(get(Counter::Unfinished));
        self.stalled += u64::from(get(Counter::Stalled));
        if !samples_unlisted {
            self.unlisted_tiles += u64::from(get(Counter::UnlistedTotal));
        }
        let survivors = get(Counter::Survivors).saturating_add(get(Counter::Large));
        let thin = get(Counter::Thin).saturating_add(get(Counter::ThinLong));
        let listed = survivors.max(thin);
        self.dropped += u64::from(listed.saturating_sub(triangles));
        let needed = [(listed, triangles), (get(Counter::Pairs), pairs)];
        let rooms = needed.map(|(needed, room)| needed.div_ceil(room.max(1)));
        self.rooms = self.rooms.max(rooms[0]).max(rooms[1]);
    }

    /// Number of cells and tiles that were not finished.
    pub fn left(&self) -> u64 {
        let of_lights = self.unshadowed;
        self.waiting + self.crowded + self.stalled + self.unlisted_tiles + self.dropped + of_lights
    }

    /// Returns an error if any work was not finished.
    pub fn check(&self) -> Result<(), EngineError> {
        match self.left() {
            0 => Ok(()),
            cells => Err(EngineError::Unfinished { cells }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A frame that dropped triangles reports how many. The next frame then has lists that are long enough, instead of
    /// repeatedly too short ones.
    #[test]
    fn lists_grow_to_what_they_are_known_to_need() {
        const ROOM: u32 = 1 << 14;
        let mut counters = [0; Counter::COUNT];
        counters[Counter::Survivors as usize] = 70 * ROOM + 1;
        let mut shortfall = Shortfall::default();
        shortfall.add(&counters, (1, ROOM, 1), false);
        assert_eq!(Capacity::default().more(shortfall).lists, 128);
        counters = [0; Counter::COUNT];
        counters[Counter::Pairs as usize] = 5 * ROOM;
        let mut shortfall = Shortfall::default();
        shortfall.add(&counters, (1, 1, ROOM), false);
        assert_eq!(Capacity::default().more(shortfall).lists, 8);
        // A shortage of unknown size multiplies only the capacity that was short.
        let crowded = Shortfall { crowded: 1, ..Shortfall::default() };
        let more = Capacity::default().without_unlisted_tiles().more(crowded);
        assert_eq!((more.layers, more.lists, more.samples_unlisted), (16, 4, false));
        let unlisted = Shortfall { unlisted_tiles: 1, ..Shortfall::default() };
        assert_eq!(Capacity::default().without_unlisted_tiles().more(unlisted), Capacity::default());
        // If pairs lacked room, tiles without a list may get one once there is room.
        let outgrown = Shortfall { unlisted_tiles: 1, rooms: 2, ..Shortfall::default() };
        let more = Capacity::default().without_unlisted_tiles().more(outgrown);
        assert_eq!((more.lists, more.samples_unlisted), (2, false));
        assert!(more.more(outgrown).samples_unlisted);
        // Lights may lack rounds.
        let unshadowed = Shortfall { unshadowed: 1, ..Shortfall::default() };
        let few = Capacity { rounds: Some(2), ..Capacity::default() };
        let few = few.more(unshadowed);
        assert_eq!((few.rounds, few.looks_up_occluders), (Some(2), false));
        let more = few.more(unshadowed);
        let unlike = |capacity: &Capacity| (capacity.rounds, capacity.lists, capacity.long_lists);
        assert_eq!(unlike(&more), (Some(8), 1, LongLists::SeveralCells));
        let longer = more.more(unshadowed);
        assert_eq!(unlike(&longer), (Some(32), 2, LongLists::OneCell));
        let late = Shortfall { waiting: 5, rounds: 3, ..Shortfall::default() };
        assert_eq!(few.more(late).rounds, Some(8));
        assert_eq!(Capacity::default().more(Shortfall::default()), Capacity::default());
    }
}
