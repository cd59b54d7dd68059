//! schedule: chooses the tiles of a round. [`Tally`] counts what they need before, [`Enlist`] lists them afterwards.

use super::enlist::Enlist;
use super::tally::Tally;
use super::{RecordRate, Sample, SampleOptions, spirv};
use crate::engine::data::ResourceSizes;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, Specialized, VulkanError};
use std::sync::Arc;

/// Adds tiles to a round as long as they fit.
pub struct Schedule {
    tally: Tally,
    pipeline: Arc<Pipeline>,
    enlist: Enlist,
    options: SampleOptions,
    /// Largest number of pairs of a triangle and a tile in the device's memory.
    most_pairs: u64,
    /// Push constants of the three shaders: see `shaders/include/load.glsl`.
    pushed: spirv::SchedulePush,
}

/// Number of pixels of which usually at most one is a superpixel that needs its largest possible room.
const USUAL_PIXELS: u64 = 8;

impl Schedule {
    /// Makes the pipelines for the output of `sample`. Tiles are admitted with room for `layers` BLEND layers in a list
    /// and for twice as many lists in a block, or for more lists if blocks are shaded by parts.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout, sample: &Sample, layers: u32) -> Result<Self, VulkanError> {
        let lanes = layout.gpu.limits().lanes;
        let options = sample.options();
        let shader = spirv::Schedule {
            local_size: lanes,
            lanes,
            locations: options.cells.are_locations(),
            points: options.cells.are_points(),
            unsure: layout.is_unsure(lanes),
        };
        let [subgroups_first, subgroups, subgroups_unlisted] = sample.subgroups();
        let [longest_list, longest_layered] = options.long_lists.longest();
        let per_sample = u32::from(options.records == RecordRate::Sample);
        Ok(Self {
            tally: Tally::new(layout, options.cells)?,
            pipeline: layout.compute(&shader, layout.subgroup())?,
            enlist: Enlist::new(layout, options.cells)?,
            options: *options,
            most_pairs: ResourceSizes::most_pairs(layout.gpu.limits()),
            pushed: spirv::SchedulePush {
                block: sample.block(),
                per_sample,
                layers,
                parts: sample.parts(),
                subgroups_first,
                subgroups,
                subgroups_unlisted,
                longest_list,
                longest_layered,
                more_records: options.more_records(),
            },
        })
    }

    /// Numbers of rounds to record for a scene with at most `triangles` triangles: for the cells that are found first,
    /// and for each growth. Without a `factor`, these are the numbers that any image may need. Otherwise, these are
    /// `factor` times the numbers that images usually need; a growth usually needs a quarter of the first rounds.
    pub fn rounds(&self, sizes: &ResourceSizes, triangles: u32, factor: Option<u32>) -> [u32; 2] {
        let most = self.most_rounds(sizes, triangles);
        let Some(factor) = factor else {
            return [most; 2];
        };
        let records_of_cell = self.options.samples + self.pushed.more_records;
        let records = match sizes.locations {
            None => u64::from(sizes.pixels()) / USUAL_PIXELS * u64::from(records_of_cell),
            Some(list) if self.options.cells.are_points() => list.locations.into(),
            Some(list) => u64::from(list.cells) * u64::from(records_of_cell),
        };
        let usual = records.div_ceil(u64::from(sizes.record_capacity).max(1));
        [1, 4].map(|share| {
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
        let samples = u64::from(self.options.samples);
        let [pairs, candidates, records] = [
            sizes.pair_capacity,
            sizes.list_capacity,
            sizes.record_capacity,
        ]
        .map(u64::from);
        /// Number of pixels of a tile.
        const PIXELS: u64 = 32;
        let records_of_cell = samples + u64::from(self.pushed.more_records);
        let (cells, all_samples) = match sizes.locations {
            None => (PIXELS * tiles, PIXELS * tiles * records_of_cell),
            Some(list) => {
                let of_location = if self.options.cells.are_points() {
                    1
                } else {
                    samples
                };
                (list.cells.into(), of_location * u64::from(list.locations))
            }
        };
        let (cells_of_tile, samples_of_tile) = match sizes.locations {
            None => (PIXELS, PIXELS * records_of_cell),
            Some(_) => (cells, all_samples),
        };
        let headers = |cells: u64| cells * samples.div_ceil(self.pushed.block.into());
        let listed = [
            (pairs, candidates, candidates),
            (
                self.most_records(headers(cells), all_samples),
                records,
                self.most_records(headers(cells_of_tile), samples_of_tile),
            ),
            (headers(cells), records, headers(cells_of_tile)),
        ];
        let needs = listed.into_iter();
        let needs = needs.chain(self.unlisted_needs(sizes, triangles, (cells, cells_of_tile)));
        let ended: u64 = needs
            .map(|(all, room, most)| rounds_ended(all, room, most))
            .sum();
        (1 + ended).min(tiles).max(1) as u32
    }

    /// Needs of tiles without a list, each as the need of all such tiles, the room of a round, and the need of one
    /// tile. `cells` and `cells_of_tile` are the largest numbers of cells, of all tiles and of one.
    fn unlisted_needs(
        &self,
        sizes: &ResourceSizes,
        triangles: u32,
        (cells, cells_of_tile): (u64, u64),
    ) -> Vec<(u64, u64, u64)> {
        if !self.options.unlisted {
            return Vec::new();
        }
        let [tiles, pairs, candidates] =
            [sizes.tiles(), sizes.pair_capacity, sizes.list_capacity].map(u64::from);
        let [longest, layers] = match self.options.has_blend {
            true => [self.pushed.longest_layered, self.pushed.layers / 2],
            false => [self.pushed.longest_list, 1],
        };
        // If memory may grow, a recording need not process the tiles that have no list because pairs lacked room.
        let dense = pairs / (1 + u64::from(longest).min(candidates));
        let dense = if pairs < self.most_pairs {
            dense.min(tiles)
        } else {
            tiles
        };
        let cells = match sizes.locations {
            None => dense * cells_of_tile,
            Some(_) => cells,
        };
        let owners = |cells: u64| cells * u64::from(self.options.samples.div_ceil(4) * layers);
        let entries = |cells: u64, tiles: u64| cells / u64::from(sizes.lanes) + tiles;
        let tried = (spirv::MOST_TRIALS / triangles.max(1)).max(spirv::FEWEST_TRIED);
        vec![
            (owners(cells), candidates, owners(cells_of_tile)),
            (
                entries(cells, dense),
                tried.into(),
                entries(cells_of_tile, 1),
            ),
        ]
    }

    /// Largest number of visibility samples for which tiles with `headers` headers and `samples` samples are admitted.
    fn most_records(&self, headers: u64, samples: u64) -> u64 {
        if !self.options.has_blend {
            return samples;
        }
        let [layers, parts] = [self.pushed.layers, self.pushed.parts].map(u64::from);
        let lists_of_block = if parts > 8 {
            layers * parts / 4
        } else {
            2 * layers
        };
        let lists = match self.pushed.per_sample {
            0 => samples.min(headers * lists_of_block),
            _ => samples,
        };
        samples.max(lists * (2 + layers))
    }

    /// Records `tally`, which runs once before all rounds, after `bin`.
    pub fn record_tally(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        self.tally.record(recorder, &self.pushed, arguments);
    }

    /// Records the beginning of a round: this pass and `enlist`.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.pass(spirv::Schedule::INTERFACE, || {
            recorder.push(&self.pipeline, &self.pushed);
            recorder.dispatch(&self.pipeline, 1);
            self.enlist.record(recorder, &self.pushed, arguments);
        });
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
