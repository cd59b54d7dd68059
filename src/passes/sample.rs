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
    /// The indirect dispatch over the list's tiles.
    #[must_use]
    pub fn argument(self) -> u32 {
        Argument::SamplePlain as u32 + self as u32
    }
}

/// The kernels, one a kind of tile that the scene can have.
pub struct Sample {
    kernels: Vec<(TileList, Arc<Pipeline>)>,
    plain_block: u32,
    layered_block: u32,
}

/// Register rows of the kernels for tiles with and without layers, least first.
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
    /// Makes the kernels for cells of `samples` sub-samples, or up to `samples` points.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        cells: Cells,
        samples: u32,
        per_sample: bool,
        has_mask: bool,
        has_blend: bool,
    ) -> Result<Self, VulkanError> {
        let lanes = layout.gpu.limits().subgroup_size;
        let rows_needed = samples.div_ceil(lanes);
        // One block size serves all tiles with layers, so that headers have one stride.
        let (plain_rows, plain) = kernel(&PLAIN, rows_needed);
        let layered_rows = if rows_needed <= 1 { 1 } else { 8 };
        let mut kernels = Vec::new();
        let mut add =
            |list: TileList, code: &'static [u8], mask: bool| -> Result<(), VulkanError> {
                let constants = cells
                    .constants(Constants::new())
                    .with(0, lanes)
                    .with(1, lanes)
                    .flag(2, per_sample)
                    .flag(3, mask)
                    .with(4, list as u32);
                kernels.push((list, layout.compute(code, &constants, Some(lanes))?));
                Ok(())
            };
        add(TileList::Plain, plain, false)?;
        if has_mask {
            add(TileList::Masked, kernel(&MASKED, layered_rows).1, true)?;
        }
        if has_blend {
            add(
                TileList::Blended,
                kernel(&CHAINED, layered_rows).1,
                has_mask,
            )?;
            add(
                TileList::Unlisted,
                kernel(&CHAINED_UNLISTED, layered_rows).1,
                has_mask,
            )?;
        } else {
            add(
                TileList::Unlisted,
                kernel(&UNLISTED, layered_rows).1,
                has_mask,
            )?;
        }
        Ok(Self {
            kernels,
            plain_block: plain_rows * lanes,
            layered_block: layered_rows * lanes,
        })
    }

    /// Samples that a kernel holds at once, for tiles of the list.
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

    /// Records them over the tiles of the round.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        for (list, pipeline) in &self.kernels {
            recorder.dispatch_indirect(pipeline, arguments, list.argument());
        }
    }
}
