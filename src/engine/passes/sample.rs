//! sample: the nearest triangle of every sub-sample.

use super::arguments::{After, Arguments};
use super::spirv;
use crate::engine::data::{Argument, Cells, Content};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// The lists that `enlist` sorts tiles into, in the order of `shaders/include/load.glsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TileList {
    /// Opaque triangles alone.
    Plain,
    /// Alpha-tested triangles too.
    Masked,
    /// BLEND triangles too.
    Blended,
    /// A list that outgrows its buffer.
    Unlisted,
}

impl TileList {
    /// Whether its tiles have lists of candidates, and none of these is seen through.
    fn is_opaque(self) -> bool {
        matches!(self, Self::Plain | Self::Masked)
    }

    /// The indirect dispatch over the list's entries.
    #[must_use]
    pub fn argument(self) -> u32 {
        Argument::SamplePlain as u32 + self as u32
    }
}

/// What the kernels are made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleOptions {
    /// What a cell is.
    pub cells: Cells,
    /// Sub-samples of a cell, or points at the most.
    pub samples: u32,
    /// Whether these lie on lines, of cells that `sample_lines` can take.
    pub lines: bool,
    /// How often records are written.
    pub records: RecordRate,
    /// Whether triangles that are seen whole weigh the exact area of their part of a cell.
    pub exact_areas: bool,
    /// Whether few samples may settle a cell, so that a first run of few is worth while where there are many to take.
    pub can_settle: bool,
    /// Whether a subgroup takes a block of one cell, for lists that are too long to take several.
    pub apart: bool,
    /// Whether tiles whose list outgrew its buffer are sampled, by a kernel that tries every triangle. Without it they are
    /// left, and counted.
    pub unlisted: bool,
    /// Whether the scene has MASK triangles.
    pub has_mask: bool,
    /// Whether the scene has BLEND triangles.
    pub has_blend: bool,
    /// Whether cells are those that show a BLEND triangle, so that no list without one is sampled.
    pub always_blends: bool,
}

/// How many records the samples of a block that see the same triangle make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RecordRate {
    /// One.
    Triangle,
    /// One for each sixteenth of the samples of a cell, but at least 8 of them and at most those of a block.
    Part,
    /// One for each sample.
    Sample,
}

/// Which samples a kernel takes; the order is that of `RUN` in `shaders/sample.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Run {
    Whole,
    Probe,
    Rest,
}

/// The kernels, one a kind of tile that the scene can have; those of a second run, over cells that the first left, follow.
pub struct Sample {
    kernels: Vec<(TileList, Arc<Pipeline>)>,
    rest: Vec<(TileList, Arc<Pipeline>)>,
    arguments_of_rest: Arguments,
    options: SampleOptions,
    block: u32,
    subgroups: [u32; 2],
}

/// A kernel for each number of register rows that there is, least first.
type Kernels = [(u32, &'static [u8]); 5];

const KERNELS: Kernels = [
    (1, spirv::SAMPLE_1),
    (2, spirv::SAMPLE_2),
    (4, spirv::SAMPLE_4),
    (8, spirv::SAMPLE_8),
    (16, spirv::SAMPLE_16),
];
/// Kernels that hold the samples of a cell as a mask, by how many these can be.
const MASKS: [(u32, &[u8]); 2] = [(16, spirv::SAMPLE_MASKS_16), (64, spirv::SAMPLE_MASKS_64)];
const UNLISTED: Kernels = [
    (1, spirv::SAMPLE_UNLISTED_1),
    (2, spirv::SAMPLE_UNLISTED_2),
    (4, spirv::SAMPLE_UNLISTED_4),
    (8, spirv::SAMPLE_UNLISTED_8),
    (16, spirv::SAMPLE_UNLISTED_16),
];
const LAYERED: Kernels = [
    (1, spirv::SAMPLE_LAYERED_1),
    (2, spirv::SAMPLE_LAYERED_2),
    (4, spirv::SAMPLE_LAYERED_4),
    (8, spirv::SAMPLE_LAYERED_8),
    (16, spirv::SAMPLE_LAYERED_16),
];
const LAYERED_UNLISTED: Kernels = [
    (1, spirv::SAMPLE_LAYERED_UNLISTED_1),
    (2, spirv::SAMPLE_LAYERED_UNLISTED_2),
    (4, spirv::SAMPLE_LAYERED_UNLISTED_4),
    (8, spirv::SAMPLE_LAYERED_UNLISTED_8),
    (16, spirv::SAMPLE_LAYERED_UNLISTED_16),
];

/// Blocks of several cells that a subgroup takes, as in `shaders/sample.comp`.
const BLOCKS_AT_ONCE: u32 = 4;

/// The smallest kernel of at least as many rows, or else the largest.
fn kernel(kernels: &Kernels, rows: u32) -> (u32, &'static [u8]) {
    let largest = kernels[kernels.len() - 1];
    kernels
        .iter()
        .copied()
        .find(|(has, _)| *has >= rows)
        .unwrap_or(largest)
}

/// The constants of kernels that hold masks, by those of the others.
fn of_masks(shader: &spirv::Sample) -> spirv::SampleMasks {
    spirv::SampleMasks {
        local_size: shader.local_size,
        lanes: shader.lanes,
        has_mask: shader.has_mask,
        list: shader.list,
        by_part: shader.by_part,
        exact_areas: shader.exact_areas,
        part: shader.part,
        locations: shader.locations,
        instanced: shader.instanced,
        unsure: shader.unsure,
    }
}

/// The constants of the kernel of lines, by those of the others: a header stands for `header` samples, and a cell has `lines` lines.
fn of_lines(shader: &spirv::Sample, header: u32, lines: u32) -> spirv::SampleLines {
    spirv::SampleLines {
        local_size: shader.local_size,
        lanes: shader.lanes,
        has_mask: shader.has_mask,
        list: shader.list,
        by_part: shader.by_part,
        part: shader.part,
        header,
        lines,
        locations: shader.locations,
        instanced: shader.instanced,
        unsure: shader.unsure,
    }
}

impl Sample {
    /// Samples of the first of two runs; their locations follow those of the cell.
    pub const PROBES: u32 = 64;
    /// Samples that a block aims at: one has more only where as few as that leave invocations idle.
    const BLOCK: u32 = 64;

    /// Makes the kernels.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        scene: &dyn Content,
        options: &SampleOptions,
    ) -> Result<Self, VulkanError> {
        let lanes = layout.gpu.limits().lanes;
        let (rows, _) = kernel(&KERNELS, options.samples.min(Self::BLOCK).div_ceil(lanes));
        let make = |(list, run, kernels, mask): &(TileList, Run, &Kernels, bool)| {
            let first_run = list.is_opaque() && *run != Run::Rest;
            let shader = spirv::Sample {
                local_size: lanes,
                lanes,
                per_sample: options.records == RecordRate::Sample,
                has_mask: *mask,
                list: *list as u32,
                run: *run as u32,
                by_part: options.by_part(*run, rows * lanes),
                exact_areas: options.measures(*list, *run),
                part: options.part_samples(),
                apart: options.apart,
                locations: options.cells.are_locations(),
                points: options.cells.are_points(),
                occluders: options.cells.are_occluders(),
                instanced: scene.is_instanced(),
                unsure: layout.is_unsure(lanes),
            };
            let pipeline = if first_run && options.by_lines() {
                let shader = of_lines(&shader, rows * lanes, options.lines_of_cell(lanes));
                layout.compute(&shader, layout.subgroup())?
            } else if first_run && options.by_masks() {
                let [few, many] = MASKS;
                let (_, code) = if options.samples <= few.0 { few } else { many };
                layout.compute_variant(code, &of_masks(&shader), layout.subgroup())?
            } else {
                let (_, code) = kernel(kernels, rows);
                layout.compute_variant(code, &shader, layout.subgroup())?
            };
            Ok::<_, VulkanError>((*list, pipeline))
        };
        let probes = options.probes();
        let listed = |run: Run| {
            let plain = (TileList::Plain, run, &KERNELS, false);
            let masked = (TileList::Masked, run, &KERNELS, true);
            let wanted = [(plain, true), (masked, options.has_mask)];
            wanted
                .into_iter()
                .filter(|(_, wanted)| *wanted && !options.always_blends)
                .map(|(kernel, _)| kernel)
        };
        let whole = |list, kernels| (list, Run::Whole, kernels, options.has_mask);
        let mut wanted: Vec<_> = listed(if probes { Run::Probe } else { Run::Whole }).collect();
        if options.has_blend {
            wanted.push(whole(TileList::Blended, &LAYERED));
        }
        if options.unlisted {
            let unlisted = if options.has_blend {
                &LAYERED_UNLISTED
            } else {
                &UNLISTED
            };
            wanted.push(whole(TileList::Unlisted, unlisted));
        }
        let first_run = wanted.len();
        if options.leaves_cells() {
            wanted.extend(listed(Run::Rest));
        }
        // They take drivers the longest of all.
        let make = &make;
        let made: Result<Vec<_>, _> = std::thread::scope(|threads| {
            let making: Vec<_> = wanted
                .iter()
                .map(|kernel| threads.spawn(move || make(kernel)))
                .collect();
            making
                .into_iter()
                .map(|thread| {
                    thread
                        .join()
                        .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
                })
                .collect()
        });
        let mut kernels = made?;
        let rest = kernels.split_off(first_run);
        let block = rows * lanes;
        let taking = |samples: u32| {
            let blocks = samples.div_ceil(block);
            if options.apart {
                lanes * blocks
            } else {
                blocks.div_ceil(BLOCKS_AT_ONCE)
            }
        };
        let first = if probes {
            taking(Self::PROBES)
        } else if options.by_lines() {
            1
        } else {
            taking(options.samples)
        };
        let subgroups = [first, taking(options.samples)];
        Ok(Self {
            kernels,
            rest,
            arguments_of_rest: Arguments::of_samples(layout, After::Probe, subgroups)?,
            options: *options,
            block,
            subgroups,
        })
    }

    /// What they were made for.
    #[must_use]
    pub fn options(&self) -> &SampleOptions {
        &self.options
    }

    /// Samples of a block: a header stands for that many.
    #[must_use]
    pub fn block(&self) -> u32 {
        self.block
    }

    /// How many subgroups take an entry of a list: in a first run, and for all samples.
    pub(crate) fn subgroups(&self) -> [u32; 2] {
        self.subgroups
    }

    /// Most records that a block makes of a triangle, where a cell has all its samples.
    #[must_use]
    pub fn parts(&self) -> u32 {
        match self.options.records {
            RecordRate::Part => (self.block / self.options.part_samples()).max(1),
            RecordRate::Triangle | RecordRate::Sample => 1,
        }
    }

    /// The lists that are sampled.
    pub fn lists(&self) -> impl Iterator<Item = TileList> + '_ {
        self.kernels.iter().map(|(list, _)| *list)
    }

    /// Records them over the tiles of the round. Where a run [leaves cells](SampleOptions::leaves_cells), none is marked
    /// before the first round.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        for (list, pipeline) in &self.kernels {
            recorder.dispatch_indirect(pipeline, arguments, list.argument());
        }
        if self.rest.is_empty() {
            return;
        }
        self.arguments_of_rest.record(recorder);
        for (list, pipeline) in &self.rest {
            recorder.dispatch_indirect(
                pipeline,
                arguments,
                Argument::PlainLeft as u32 + *list as u32,
            );
        }
    }
}

impl SampleOptions {
    /// Most triangles that are tried in a cell, whose loops end after so many trips. Cells of longer lists are left, and counted.
    pub(crate) fn longest_list(&self) -> u32 {
        if self.apart {
            spirv::LONGEST_LIST_APART
        } else {
            spirv::LONGEST_LIST
        }
    }

    /// Whether a run measures areas: where it takes all samples of a cell at once. What masks leave sees more triangles
    /// than areas are held of.
    fn measures(&self, list: TileList, run: Run) -> bool {
        let at_once = match run {
            Run::Whole => self.samples <= Sample::PROBES,
            Run::Rest => self.samples <= Sample::PROBES && !self.by_masks() && !self.by_lines(),
            Run::Probe => true,
        };
        self.exact_areas && self.records != RecordRate::Sample && at_once && list.is_opaque()
    }

    /// Whether a run tells parts: not where a part holds a block. A probe leaves what is to be shaded by part.
    fn by_part(&self, run: Run, block: u32) -> bool {
        self.records == RecordRate::Part && (run == Run::Probe || self.part_samples() < block)
    }

    /// Whether cells of opaque and alpha-tested triangles may be taken by kernels of their own, which leave some of them.
    fn by_cell(&self) -> bool {
        self.cells == Cells::Pixels && !self.always_blends && self.records != RecordRate::Sample
    }

    /// Whether these hold the samples of a cell as a mask.
    fn by_masks(&self) -> bool {
        self.by_cell() && !self.by_lines() && !self.apart && (2..=64).contains(&self.samples)
    }

    /// Whether these have samples on lines.
    fn by_lines(&self) -> bool {
        self.by_cell() && self.lines && self.samples >= 16
    }

    /// Lines of 64 samples, for subgroups of so many invocations: each of these has half a line at the least.
    fn lines_of_cell(&self, lanes: u32) -> u32 {
        if self.samples <= 64 && lanes < 32 {
            8
        } else {
            16
        }
    }

    /// Whether a cell has one header where it is not left to a second run.
    pub(super) fn has_one_header(&self) -> bool {
        self.probes() || self.by_lines()
    }

    /// Records that a cell makes beyond its number of samples, at the most.
    pub(super) fn more_records(&self) -> u32 {
        if self.by_lines() {
            spirv::MORE_RECORDS
        } else {
            0
        }
    }

    /// Whether a first run leaves cells to a second one, and marks them.
    #[must_use]
    pub fn leaves_cells(&self) -> bool {
        self.probes() || self.by_masks() || self.by_lines()
    }

    /// Samples of a part: there are 16 parts of 16 samples, 32 of 64, 128 of 256 and 256 of 1,024.
    fn part_samples(&self) -> u32 {
        let few = if self.samples < 32 { 1 } else { 2 };
        (self.samples / 256).max(few).next_power_of_two()
    }

    /// Whether there is a first run.
    #[must_use]
    pub fn probes(&self) -> bool {
        self.can_settle
            && self.exact_areas
            && self.records != RecordRate::Sample
            && self.samples > Sample::PROBES
            && !self.by_lines()
    }
}
