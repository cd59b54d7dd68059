//! Load of a round: what tiles need of its memory, and how many rounds suffice for all tiles.

use crate::engine::data::ResourceSizes;
use crate::engine::passes::{FragmentRate, SampleBlocks};
use crate::engine::spirv;
use crate::vulkan::Limits;

/// Needs of tiles whose cells are sampled in these blocks.
pub struct Load {
    blocks: SampleBlocks,
    /// Largest number of pairs of a triangle and a tile in the device's memory.
    most_pairs: u64,
    /// Push constants of `tally`, `schedule` and `enlist`: see `shaders/include/load.glsl`.
    pushed: spirv::SchedulePush,
}

/// Number of pixels of which usually at most one is a superpixel that needs its largest possible room.
const USUAL_PIXELS: u64 = 8;

impl Load {
    /// Needs on a device with these limits. Tiles are admitted with room for `layers` BLEND layers in a list and for twice
    /// as many lists in a block, or for more lists if blocks are shaded by parts.
    #[must_use]
    pub fn new(limits: &Limits, blocks: SampleBlocks, layers: u32) -> Self {
        let options = blocks.options;
        let [teams_first, _, teams_unlisted] = blocks.teams;
        let [longest_list, longest_layered] = options.long_lists.longest();
        Self {
            most_pairs: ResourceSizes::most_pairs(limits),
            pushed: spirv::SchedulePush {
                block: blocks.block,
                per_sample: u32::from(options.fragments == FragmentRate::Sample),
                layers,
                parts: blocks.parts(),
                teams_first,
                teams_unlisted,
                longest_list,
                longest_layered,
                more_fragments: options.more_fragments(),
            },
            blocks,
        }
    }

    /// Push constants of `tally`, `schedule` and `enlist`.
    pub(crate) fn pushed(&self) -> spirv::SchedulePush {
        self.pushed
    }

    /// Numbers of rounds to record for a scene with at most `triangles` triangles: for the cells that are found first,
    /// and for each growth. Without a `factor`, these are the numbers that any image may need. Otherwise, these are
    /// `factor` times the numbers that images usually need; a growth usually needs an eighth of the first rounds.
    pub fn rounds(&self, sizes: &ResourceSizes, triangles: u32, factor: Option<u32>) -> [u32; 2] {
        let most = self.most_rounds(sizes, triangles);
        let Some(factor) = factor else {
            return [most; 2];
        };
        let fragments_of_cell = self.blocks.options.samples + self.pushed.more_fragments;
        let fragments = match sizes.locations {
            None => u64::from(sizes.pixels()) / USUAL_PIXELS * u64::from(fragments_of_cell),
            Some(list) if self.blocks.options.cells.are_points() => list.locations.into(),
            Some(list) => u64::from(list.cells) * u64::from(fragments_of_cell),
        };
        let usual = fragments.div_ceil(u64::from(sizes.fragment_capacity).max(1));
        [1, 8].map(|share| {
            let rounds = usual.div_ceil(share) * u64::from(factor);
            rounds.clamp(1, most.into()) as u32
        })
    }

    /// Number of rounds that suffice for any image of a scene with at most `triangles` triangles. The worst case is
    /// that every pixel is a cell, or all locations of a list lie in one tile, and that each cell needs its largest
    /// possible room.
    #[must_use]
    pub fn most_rounds(&self, sizes: &ResourceSizes, triangles: u32) -> u32 {
        let tiles = u64::from(sizes.tiles());
        let samples = u64::from(self.blocks.options.samples);
        let [pairs, candidates, fragments] =
            [sizes.pair_capacity, sizes.list_capacity, sizes.fragment_capacity].map(u64::from);
        /// Number of pixels of a tile.
        const PIXELS: u64 = 32;
        let fragments_of_cell = samples + u64::from(self.pushed.more_fragments);
        let (cells, all_samples) = match sizes.locations {
            None => (PIXELS * tiles, PIXELS * tiles * fragments_of_cell),
            Some(list) => {
                let of_location = if self.blocks.options.cells.are_points() { 1 } else { samples };
                (list.cells.into(), of_location * u64::from(list.locations))
            }
        };
        let (cells_of_tile, samples_of_tile) = match sizes.locations {
            None => (PIXELS, PIXELS * fragments_of_cell),
            Some(_) => (cells, all_samples),
        };
        let headers = |cells: u64| cells * samples.div_ceil(self.pushed.block.into());
        let listed = [
            (pairs, candidates, candidates),
            (
                self.most_fragments(headers(cells), all_samples),
                fragments,
                self.most_fragments(headers(cells_of_tile), samples_of_tile),
            ),
            (headers(cells), fragments, headers(cells_of_tile)),
        ];
        let needs = listed.into_iter();
        let needs = needs.chain(self.unlisted_needs(sizes, triangles, cells, cells_of_tile));
        let ended: u64 = needs.map(|(all, room, most)| rounds_ended(all, room, most)).sum();
        (1 + ended).min(tiles).max(1) as u32
    }

    /// Needs of tiles without a list, each as the need of all such tiles, the room of a round, and the need of one
    /// tile. `cells` and `cells_of_tile` are the largest numbers of cells, of all tiles and of one.
    fn unlisted_needs(
        &self,
        sizes: &ResourceSizes,
        triangles: u32,
        cells: u64,
        cells_of_tile: u64,
    ) -> Vec<(u64, u64, u64)> {
        if !self.blocks.options.samples_unlisted {
            return Vec::new();
        }
        let [tiles, pairs, candidates] = [sizes.tiles(), sizes.pair_capacity, sizes.list_capacity].map(u64::from);
        let [longest, layers] = match self.blocks.options.has_blend {
            true => [self.pushed.longest_layered, self.pushed.layers / 2],
            false => [self.pushed.longest_list, 1],
        };
        // If memory may grow, a recording need not process the tiles that have no list because pairs lacked room.
        let dense = pairs / (1 + u64::from(longest).min(candidates));
        let dense = if pairs < self.most_pairs { dense.min(tiles) } else { tiles };
        let cells = match sizes.locations {
            None => dense * cells_of_tile,
            Some(_) => cells,
        };
        let owners = |cells: u64| cells * u64::from(self.blocks.options.samples.div_ceil(4) * layers);
        let entries = |cells: u64, tiles: u64| cells / u64::from(sizes.team) + tiles;
        let tried = (spirv::MOST_TRIALS / triangles.max(1)).max(spirv::FEWEST_TRIED);
        vec![
            (owners(cells), candidates, owners(cells_of_tile)),
            (entries(cells, dense), tried.into(), entries(cells_of_tile, 1)),
        ]
    }

    /// Largest number of visibility samples for which tiles with `headers` headers and `samples` samples are admitted.
    fn most_fragments(&self, headers: u64, samples: u64) -> u64 {
        if !self.blocks.options.has_blend {
            return samples;
        }
        let [layers, parts] = [self.pushed.layers, self.pushed.parts].map(u64::from);
        let lists_of_block = if parts > 8 { layers * parts / 4 } else { 2 * layers };
        let lists = match self.pushed.per_sample {
            0 => samples.min(headers * lists_of_block),
            _ => samples,
        };
        samples.max(lists * (2 + layers))
    }
}

/// Largest number of rounds that end because the next tile does not fit. All tiles together need `all`, and no tile
/// needs more than `most`.
fn rounds_ended(all: u64, room: u64, most: u64) -> u64 {
    // Together, a round and the tile after it need more than the room, and each tile is counted at most twice.
    let of_pairs = 2 * all / room.max(1);
    // If each tile fits, the room that a round leaves unused is smaller than the need of one tile.
    let filled = (room + 1).saturating_sub(most);
    of_pairs.min(all.checked_div(filled).unwrap_or(of_pairs))
}
