//! Which tiles a round takes, and where their lists of candidates, headers and entries are.
//!
//! A round takes tiles in the order of the region, as long as what they may need fits; its first tile in any case. A tile
//! without a superpixel needs nothing.

use std::ops::Range;

/// Trials of a triangle in a cell that a round takes where tiles have no list.
const MOST_TRIALS: u64 = 1 << 31;

/// What is known of a tile before the first round.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tile {
    /// Superpixels.
    pub cells: u32,
    /// Pairs of a triangle and this tile.
    pub candidates: u32,
    /// Whether some of these pairs were not kept.
    pub overflows: bool,
    /// Whether some are of alpha-tested triangles.
    pub has_mask: bool,
    /// Whether some are of BLEND triangles.
    pub has_blend: bool,
}

/// Which list a tile is entered in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum List {
    /// Opaque triangles alone.
    Plain,
    /// Alpha-tested triangles too.
    Masked,
    /// BLEND triangles too.
    Blended,
    /// Every triangle is a candidate.
    Unlisted,
}

/// What samples write, and the room that a round has for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rounds {
    /// Samples of a cell.
    pub samples: u32,
    /// Samples of a block.
    pub block: u32,
    /// Whether each sample is a record.
    pub per_sample: bool,
    /// Most records of a triangle in a block.
    pub parts: u32,
    /// BLEND layers of a list that a tile is admitted with.
    pub layers: u32,
    /// Triangles of the scene.
    pub triangles: u32,
    /// Most triangles that are tried in a cell.
    pub longest_list: u32,
    /// Whether some of them are BLEND.
    pub blends: bool,
    /// Candidates that a round has room for.
    pub candidates: u32,
    /// Records, and also headers.
    pub records: u32,
}

/// A tile with superpixels in a round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placed {
    /// Its number in the region.
    pub tile: usize,
    /// The list that it is entered in.
    pub list: List,
    /// Its first candidate among those of the round.
    pub first_candidate: u64,
    /// Its first header.
    pub first_header: u64,
}

/// What a round takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Round {
    /// The tiles, with and without superpixels.
    pub tiles: Range<usize>,
    /// Those with superpixels.
    pub placed: Vec<Placed>,
}

impl Rounds {
    /// Which list a tile with superpixels is entered in.
    #[must_use]
    pub fn list(&self, tile: Tile) -> List {
        if tile.overflows || tile.candidates > self.candidates {
            List::Unlisted
        } else if tile.has_blend {
            List::Blended
        } else if tile.has_mask {
            List::Masked
        } else {
            List::Plain
        }
    }

    /// What a tile is admitted with: candidates, records, headers and cells in which every triangle is tried.
    fn needs(&self, tile: Tile) -> [u64; 4] {
        let [samples, block, parts, layers] =
            [self.samples, self.block, self.parts, self.layers].map(u64::from);
        let unlisted = self.list(tile) == List::Unlisted;
        let blocks = samples.div_ceil(block);
        let headers = u64::from(tile.cells) * blocks;
        let all_samples = u64::from(tile.cells) * samples;
        let candidates = u64::from(if unlisted {
            self.triangles
        } else {
            tile.candidates
        });
        let records = if tile.has_blend || (unlisted && self.blends) {
            let lists_of_block = if parts > 8 {
                layers * parts / 4
            } else {
                2 * layers
            };
            let lists = if self.per_sample {
                all_samples
            } else {
                all_samples.min(headers * lists_of_block)
            };
            lists * (2 + candidates.min(layers))
        } else if self.per_sample {
            all_samples
        } else {
            all_samples.min(headers * block.min(parts * candidates))
        };
        let cells = u64::from(tile.cells);
        match (unlisted, cells) {
            (_, 0) => [0; 4],
            (true, _) if self.triangles > self.longest_list => [0, records, headers, 0],
            (true, _) => [0, records, headers, cells],
            (false, _) => [candidates, records, headers, 0],
        }
    }

    /// The rounds that all tiles take.
    #[must_use]
    pub fn of(&self, tiles: &[Tile]) -> Vec<Round> {
        let [candidates, records] = [self.candidates, self.records].map(u64::from);
        let tried = MOST_TRIALS / u64::from(self.triangles);
        let room = [candidates, records, records, tried];
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
            rounds.push(Round {
                tiles: first..next,
                placed,
            });
        }
        rounds
    }
}
