//! Schedule: the tiles of each round, and the places of their lists of candidates, headers and entries.
//!
//! A round takes tiles in the order of the region as long as their largest possible needs fit, and always its first
//! tile. A tile without superpixels needs nothing.

use std::ops::Range;

/// Largest number of tests of a triangle against a tile in a round, for tiles without a list.
const MOST_TRIALS: u32 = 1 << 28;
/// Number of entries of tiles without a list that a round takes in any case.
const FEWEST_TRIED: u32 = 4096;

/// Facts about a tile before the first round.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tile {
    /// Number of superpixels.
    pub cells: u32,
    /// Number of pairs of a triangle and this tile.
    pub candidates: u32,
    /// Whether some of these pairs did not fit into memory.
    pub overflows: bool,
    /// Whether some of the triangles are alpha-tested.
    pub has_mask: bool,
    /// Whether some of the triangles are BLEND.
    pub has_blend: bool,
}

/// List in which a tile is entered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScheduledList {
    /// Tiles with opaque triangles only.
    Plain,
    /// Tiles that also have alpha-tested triangles.
    Masked,
    /// Tiles that also have BLEND triangles.
    Blended,
    /// Tiles without a list, whose samples test all triangles one by one.
    Unlisted,
}

/// Options of sampling that determine the needs of a tile, and the room that a round has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rounds {
    /// Number of samples of a cell.
    pub samples: u32,
    /// Number of samples of a block.
    pub block: u32,
    /// Whether each sample is a fragment.
    pub per_sample: bool,
    /// Largest number of fragments of a triangle in a block.
    pub parts: u32,
    /// Number of BLEND layers of a list for which a tile is admitted.
    pub layers: u32,
    /// Number of triangles of the scene.
    pub triangles: u32,
    /// Number of members of a team; an entry has as many cells.
    pub team: u32,
    /// Largest number of candidates of a tile with a list.
    pub longest_list: u32,
    /// Largest number of candidates of a tile with a list, if the tile has BLEND triangles.
    pub longest_layered: u32,
    /// Whether the scene has BLEND triangles.
    pub blends: bool,
    /// Number of candidates for which a round has room.
    pub candidates: u32,
    /// Number of fragments, and of headers, for which a round has room.
    pub fragments: u32,
}

/// Place of a tile with superpixels in a round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placed {
    /// Index of the tile in the region.
    pub tile: usize,
    /// List in which the tile is entered.
    pub list: ScheduledList,
    /// Index of its first candidate in the round.
    pub first_candidate: u64,
    /// Index of its first header.
    pub first_header: u64,
}

/// Tiles of a round.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Round {
    /// Range of the tiles, with and without superpixels.
    pub tiles: Range<usize>,
    /// Places of the tiles with superpixels.
    pub placed: Vec<Placed>,
}

impl Rounds {
    /// List in which a tile with superpixels is entered.
    #[must_use]
    pub fn list(&self, tile: Tile) -> ScheduledList {
        let longest = if tile.has_blend { self.longest_layered } else { self.longest_list };
        if tile.overflows || tile.candidates > longest.min(self.candidates) {
            ScheduledList::Unlisted
        } else if tile.has_blend {
            ScheduledList::Blended
        } else if tile.has_mask {
            ScheduledList::Masked
        } else {
            ScheduledList::Plain
        }
    }

    /// Needs of a tile: candidates, or the room that samples take in their place; fragments; headers; and entries without
    /// a list.
    fn needs(&self, tile: Tile) -> [u64; 4] {
        let [samples, block, parts, layers] = [self.samples, self.block, self.parts, self.layers].map(u64::from);
        let unlisted = self.list(tile) == ScheduledList::Unlisted;
        let blocks = samples.div_ceil(block);
        let headers = u64::from(tile.cells) * blocks;
        let all_samples = u64::from(tile.cells) * samples;
        let candidates = u64::from(if unlisted { self.triangles } else { tile.candidates });
        let layered = tile.has_blend || (unlisted && self.blends);
        let fragments = if layered {
            let lists_of_block = if parts > 8 { layers * parts / 4 } else { 2 * layers };
            let lists = if self.per_sample { all_samples } else { all_samples.min(headers * lists_of_block) };
            lists * (2 + candidates.min(layers))
        } else if self.per_sample {
            all_samples
        } else {
            all_samples.min(headers * block.min(parts * candidates))
        };
        let cells = u64::from(tile.cells);
        let owners = all_samples.div_ceil(4) * if layered { layers / 2 } else { 1 };
        match (unlisted, cells) {
            (_, 0) => [0; 4],
            (true, _) => [owners, fragments, headers, cells.div_ceil(self.team.into())],
            (false, _) => [candidates, fragments, headers, 0],
        }
    }

    /// Rounds for all tiles.
    #[must_use]
    pub fn of(&self, tiles: &[Tile]) -> Vec<Round> {
        let [candidates, fragments] = [self.candidates, self.fragments].map(u64::from);
        let tried = (MOST_TRIALS / self.triangles).max(FEWEST_TRIED);
        let room = [candidates, fragments, fragments, tried.into()];
        let mut rounds = Vec::new();
        let mut next = 0;
        while next < tiles.len() {
            let first = next;
            let mut used = [0; 4];
            let mut placed = Vec::new();
            while let Some(&tile) = tiles.get(next) {
                let needs = self.needs(tile);
                let after = [0, 1, 2, 3].map(|what| used[what] + needs[what]);
                let fits = (0..4).all(|what| after[what] <= room[what]);
                if !fits && next > first {
                    break;
                }
                if tile.cells > 0 {
                    placed.push(Placed {
                        tile: next,
                        list: self.list(tile),
                        first_candidate: used[0],
                        first_header: used[2],
                    });
                }
                used = after;
                next += 1;
            }
            rounds.push(Round { tiles: first..next, placed });
        }
        rounds
    }
}
