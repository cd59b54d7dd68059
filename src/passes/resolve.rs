//! resolve: the colour of each superpixel.

use super::{FrameLayout, Sample, TileList, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Averages what the sub-samples of a cell see.
pub struct Resolve {
    kernels: Vec<(TileList, Arc<Pipeline>)>,
}

impl Resolve {
    /// Makes a pipeline for each list of `sample`; `output` are the colour constants of `shaders/include/color.glsl`.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        sample: &Sample,
        has_blend: bool,
        display_codes: bool,
        output: &Constants,
    ) -> Result<Self, VulkanError> {
        let output = &sample.options().cells.constants(output.clone());
        let kernels = sample
            .lists()
            .map(|list| {
                let chained = has_blend && matches!(list, TileList::Blended | TileList::Unlisted);
                Ok((
                    list,
                    Self::pipeline(
                        layout,
                        list,
                        sample.block(),
                        chained,
                        sample.options().probes()
                            && matches!(list, TileList::Plain | TileList::Masked),
                        display_codes,
                        output,
                    )?,
                ))
            })
            .collect::<Result<_, VulkanError>>()?;
        Ok(Self { kernels })
    }

    /// For records that `multisample` wrote: one header a cell.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn for_multisample(
        layout: &FrameLayout,
        samples: u32,
        display_codes: bool,
        output: &Constants,
    ) -> Result<Self, VulkanError> {
        let pipeline = Self::pipeline(
            layout,
            TileList::Plain,
            samples,
            false,
            false,
            display_codes,
            output,
        )?;
        Ok(Self {
            kernels: vec![(TileList::Plain, pipeline)],
        })
    }

    fn pipeline(
        layout: &FrameLayout,
        list: TileList,
        block: u32,
        chained: bool,
        probed: bool,
        display_codes: bool,
        output: &Constants,
    ) -> Result<Arc<Pipeline>, VulkanError> {
        let lanes = layout.gpu.limits().subgroup_size;
        let constants = output
            .clone()
            .with(0, lanes)
            .with(1, lanes)
            .with(2, block)
            .flag(3, chained)
            .with(4, list as u32)
            .flag(5, display_codes)
            .flag(6, probed);
        layout.compute(spirv::RESOLVE, &constants, Some(lanes))
    }

    /// Records it over the tiles of the round.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        for (list, pipeline) in &self.kernels {
            recorder.dispatch_indirect(pipeline, arguments, list.argument());
        }
    }
}
