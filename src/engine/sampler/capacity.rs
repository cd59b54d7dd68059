//! Capacity of a recording, and the shortfall of one that was not finished.
//!
//! A recording is made with a [`Capacity`], before anyone knows how much work there will be. Once its commands have run, its
//! [`Shortfall`] says what was left undone. [`Capacity::next`] is the capacity with which it is made again. Frames, lists and
//! hosts all use this.

use super::{EngineError, RoundPolicy};
use crate::engine::data::Counter;
use crate::engine::passes::LongLists;

/// Factor for the room for lists and rounds, and number of layers, from which on more of them is not tried.
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
    /// Room for the casters of shadows.
    pub planes: PlaneRoom,
}

/// Room for the lists of casters of a light's plane, if more is needed than usual.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct PlaneRoom {
    /// Number of pairs of a caster and a tile.
    pub pairs: u32,
    /// Number of casters in a tile.
    pub longest: u32,
}

impl PlaneRoom {
    /// Room that suffices for both.
    pub fn most(self, other: Self) -> Self {
        Self { pairs: self.pairs.max(other.pairs), longest: self.longest.max(other.longest) }
    }
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

    /// Capacity with which a recording is made again that lacked some of this one; `None` if it lacked nothing, or if more
    /// can't be had or no longer helps.
    pub fn next(self, shortfall: &Shortfall) -> Option<Self> {
        let more = self.more(*shortfall);
        let has_grown = self.lists.max(self.layers).max(self.rounds.unwrap_or(0));
        (more != self && has_grown < MOST_GROWTH).then_some(more)
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

    /// Capacity for a frame that needed more than this one: several times as much of each lacking resource, or as much
    /// as the frame is known to need. Tiles without a list are sampled only if more room for lists did not help,
    /// because testing every triangle takes long.
    fn more(self, shortfall: Shortfall) -> Self {
        let factor = |lacked: bool, factor: u32| if lacked { factor } else { 1 };
        let crowded = shortfall.crowded > 0;
        let lists = factor(shortfall.dropped > 0, 2).max(factor(crowded, 4));
        let rounds = factor(shortfall.waiting > 0, 2).max(shortfall.rounds.next_power_of_two());
        Self {
            layers: self.layers.saturating_mul(factor(crowded, 4)),
            rounds: self.rounds.map(|usual| usual.saturating_mul(rounds)),
            long_lists: if shortfall.stalled > 0 { self.long_lists.shorter() } else { self.long_lists },
            samples_unlisted: self.samples_unlisted
                || (shortfall.unlisted_tiles > 0 && (shortfall.rooms <= 1 || self.lists > 1)),
            planes: self.planes.most(shortfall.planes),
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
            planes: PlaneRoom::default(),
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
    /// Number of receivers of light that no list was there for.
    pub unshadowed: u64,
    /// Room that such lists need.
    pub planes: PlaneRoom,
    /// Factor by which the room would have to grow to hold the dropped triangles and all pairs of a triangle and a
    /// tile.
    pub rooms: u32,
}

/// Room of a run whose counters are read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CountedRoom {
    /// Number of tiles.
    pub tiles: u32,
    /// Largest number of triangles that may touch a cell, or that are thin.
    pub triangles: u32,
    /// Largest number of pairs of a triangle and a tile.
    pub pairs: u32,
}

impl Shortfall {
    /// Adds a run of the sampling passes in this room. `samples_unlisted` says whether tiles without a list were sampled or skipped.
    pub fn add(&mut self, counters: &[u32], room: CountedRoom, samples_unlisted: bool) {
        let CountedRoom { tiles, triangles, pairs } = room;
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
        self.waiting + self.crowded + self.stalled + self.unlisted_tiles + self.dropped + self.unshadowed
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
        shortfall.add(&counters, CountedRoom { tiles: 1, triangles: ROOM, pairs: 1 }, false);
        assert_eq!(Capacity::default().more(shortfall).lists, 128);
        counters = [0; Counter::COUNT];
        counters[Counter::Pairs as usize] = 5 * ROOM;
        let mut shortfall = Shortfall::default();
        shortfall.add(&counters, CountedRoom { tiles: 1, triangles: 1, pairs: ROOM }, false);
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
        // Planes of lights get the room that they need, and keep what they have.
        let unshadowed =
            |pairs, longest| Shortfall { unshadowed: 1, planes: PlaneRoom { pairs, longest }, ..Shortfall::default() };
        let more = Capacity::default().more(unshadowed(1000, 0)).more(unshadowed(0, 70));
        let planes = PlaneRoom { pairs: 1000, longest: 70 };
        assert_eq!(more, Capacity { planes, ..Capacity::default() });
        let few = Capacity { rounds: Some(2), ..Capacity::default() };
        let late = Shortfall { waiting: 5, rounds: 3, ..Shortfall::default() };
        assert_eq!(few.more(late).rounds, Some(8));
        assert_eq!(Capacity::default().more(Shortfall::default()), Capacity::default());
    }

    /// A recording is made again with more of what it lacked, until that no longer helps.
    #[test]
    fn growth_ends() {
        let crowded = Shortfall { crowded: 1, ..Shortfall::default() };
        let grown = std::iter::successors(Some(Capacity::default()), |capacity| capacity.next(&crowded));
        assert_eq!(grown.last().map(|capacity| capacity.layers), Some(MOST_GROWTH));
        // All rounds are recorded already, so more can't be had.
        let late = Shortfall { waiting: 1, rounds: 2, ..Shortfall::default() };
        assert_eq!(Capacity::default().next(&late), None);
    }
}
