//! sample: the nearest triangle of every sub-sample.

use super::{Argument, Cells, FrameLayout, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// The lists that `schedule` sorts tiles into, in the order of `shaders/schedule.comp`.
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
    /// How often records are written.
    pub records: RecordRate,
    /// Whether triangles that are seen whole weigh the exact area of their part of a cell.
    pub exact_areas: bool,
    /// Whether a subgroup takes a block of one cell, for lists that are too long to take several.
    pub apart: bool,
    /// Whether the scene has MASK triangles.
    pub has_mask: bool,
    /// Whether the scene has BLEND triangles.
    pub has_blend: bool,
}

/// How many records the samples of a block that see the same triangle make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RecordRate {
    /// One.
    Triangle,
    /// One for each eighth of the block.
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

/// The kernels, one a kind of tile that the scene can have; those of a second run follow the first.
pub struct Sample {
    kernels: Vec<(TileList, Arc<Pipeline>)>,
    rest: Vec<(TileList, Arc<Pipeline>)>,
    arguments_of_rest: Arc<Pipeline>,
    options: SampleOptions,
    plain_block: u32,
    layered_block: u32,
}

/// Register rows of the kernels for tiles without and with alpha tests or layers, least first.
const PLAIN: [(u32, &[u8]); 4] = [
    (1, spirv::SAMPLE_1),
    (2, spirv::SAMPLE_2),
    (8, spirv::SAMPLE_8),
    (32, spirv::SAMPLE_32),
];
const MASKED: [(u32, &[u8]); 3] = [
    (1, spirv::SAMPLE_1),
    (2, spirv::SAMPLE_2),
    (8, spirv::SAMPLE_8),
];
const CHAINED: [(u32, &[u8]); 2] = [(1, spirv::SAMPLE_CHAINED_1), (8, spirv::SAMPLE_CHAINED_8)];
const UNLISTED: [(u32, &[u8]); 2] = [(1, spirv::SAMPLE_UNLISTED_1), (8, spirv::SAMPLE_UNLISTED_8)];
const CHAINED_UNLISTED: [(u32, &[u8]); 2] = [
    (1, spirv::SAMPLE_CHAINED_UNLISTED_1),
    (8, spirv::SAMPLE_CHAINED_UNLISTED_8),
];

/// The smallest kernel that holds all samples at once, or else the largest.
fn kernel(kernels: &[(u32, &'static [u8])], rows_needed: u32) -> (u32, &'static [u8]) {
    kernels
        .iter()
        .find(|(rows, _)| *rows >= rows_needed)
        .or(kernels.last())
        .copied()
        .unwrap_or((1, &[]))
}

impl Sample {
    /// Samples of the first of two runs; their locations follow those of the cell.
    pub const PROBES: u32 = 64;

    /// Makes the kernels.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout, options: &SampleOptions) -> Result<Self, VulkanError> {
        let lanes = layout.gpu.limits().subgroup_size;
        let rows_needed = options.samples.div_ceil(lanes);
        let (plain_rows, plain) = kernel(&PLAIN, rows_needed);
        // One block size serves all tiles with layers, so that headers have one stride.
        let layered_rows = if rows_needed <= 1 { 1 } else { 8 };
        let make = |list: TileList, run: Run, code: &'static [u8], mask: bool| {
            let header_rows = if list == TileList::Plain {
                plain_rows
            } else {
                layered_rows
            };
            let constants = options
                .cells
                .constants(Constants::new())
                .with(0, lanes)
                .with(1, lanes)
                .flag(2, options.records == RecordRate::Sample)
                .flag(3, mask)
                .with(4, list as u32)
                .with(5, run as u32)
                .flag(6, options.records == RecordRate::Part)
                .flag(7, options.measures(list, run))
                .with(8, header_rows * lanes)
                .flag(9, options.apart);
            Ok((list, layout.compute(code, &constants, Some(lanes))?))
        };
        let listed = |run: Run| {
            let plain = match run {
                Run::Probe => kernel(&PLAIN, Self::PROBES.div_ceil(lanes)).1,
                Run::Whole | Run::Rest => plain,
            };
            let mut kernels = vec![make(TileList::Plain, run, plain, false)?];
            if options.has_mask {
                let masked = kernel(&MASKED, layered_rows).1;
                kernels.push(make(TileList::Masked, run, masked, true)?);
            }
            Ok::<_, VulkanError>(kernels)
        };
        let whole = |list, kernels: &[(u32, &'static [u8])]| {
            let code = kernel(kernels, layered_rows).1;
            make(list, Run::Whole, code, options.has_mask)
        };
        let probes = options.probes();
        let mut kernels = listed(if probes { Run::Probe } else { Run::Whole })?;
        if options.has_blend {
            kernels.push(whole(TileList::Blended, &CHAINED)?);
            kernels.push(whole(TileList::Unlisted, &CHAINED_UNLISTED)?);
        } else {
            kernels.push(whole(TileList::Unlisted, &UNLISTED)?);
        }
        let rest = if probes {
            listed(Run::Rest)?
        } else {
            Vec::new()
        };
        Ok(Self {
            kernels,
            rest,
            arguments_of_rest: layout.compute(
                spirv::ARGUMENTS,
                &Constants::new().with(0, 7),
                None,
            )?,
            options: *options,
            plain_block: plain_rows * lanes,
            layered_block: layered_rows * lanes,
        })
    }

    /// What they were made for.
    #[must_use]
    pub fn options(&self) -> &SampleOptions {
        &self.options
    }

    /// Samples that a header stands for, in tiles of the list.
    #[must_use]
    pub fn block(&self, list: TileList) -> u32 {
        if list == TileList::Plain {
            self.plain_block
        } else {
            self.layered_block
        }
    }

    /// The lists that the scene can fill.
    pub fn lists(&self) -> impl Iterator<Item = TileList> + '_ {
        self.kernels.iter().map(|(list, _)| *list)
    }

    /// Records them over the tiles of the round. With two runs, no cell is marked before the first round.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        for (list, pipeline) in &self.kernels {
            recorder.dispatch_indirect(pipeline, arguments, list.argument());
        }
        if self.rest.is_empty() {
            return;
        }
        recorder.dispatch(&self.arguments_of_rest, 1);
        for (list, pipeline) in &self.rest {
            // Cells that are apart go through the whole list again.
            let argument = if self.options.apart {
                list.argument()
            } else {
                Argument::PlainLeft as u32 + *list as u32
            };
            recorder.dispatch_indirect(pipeline, arguments, argument);
        }
    }
}

impl SampleOptions {
    /// Whether a run measures areas: where it takes all samples of a cell at once.
    fn measures(&self, list: TileList, run: Run) -> bool {
        let at_once = match run {
            Run::Whole => self.samples <= Sample::PROBES,
            Run::Probe => true,
            Run::Rest => false,
        };
        let listed = matches!(list, TileList::Plain | TileList::Masked);
        self.exact_areas && self.records != RecordRate::Sample && at_once && listed
    }

    /// Whether a first run of few samples finds the cells that need no more.
    #[must_use]
    pub fn probes(&self) -> bool {
        self.exact_areas && self.records != RecordRate::Sample && self.samples > Sample::PROBES
    }
}
