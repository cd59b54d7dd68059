//! resolve: the colour of each superpixel.

use super::{FrameLayout, Sample, TileList, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// The pass that reads what [`Resolve`] wrote, beside the colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Then {
    /// None.
    Nothing,
    /// [`Detect`](super::Detect), which compares the resolved colours.
    Detect,
    /// [`Grow`](super::Grow): neighbours that contrast are marked.
    Grow,
}

/// Averages what the sub-samples of a cell see.
pub struct Resolve {
    kernels: Vec<(TileList, Arc<Pipeline>)>,
}

impl Resolve {
    /// Makes a pipeline for each list of `sample`; `then` is what a pass after it needs, `output` are the colour constants of
    /// `shaders/include/color.glsl`.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        sample: &Sample,
        has_blend: bool,
        then: Then,
        output: &Constants,
    ) -> Result<Self, VulkanError> {
        let output = &sample.options().cells.constants(output.clone());
        let kernels = sample
            .lists()
            .map(|list| {
                let layered = has_blend && matches!(list, TileList::Blended | TileList::Unlisted);
                Ok((
                    list,
                    Self::pipeline(
                        layout,
                        list,
                        sample.block(),
                        layered,
                        sample.options().has_one_header()
                            && matches!(list, TileList::Plain | TileList::Masked),
                        then,
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
        then: Then,
        output: &Constants,
    ) -> Result<Self, VulkanError> {
        let pipeline =
            Self::pipeline(layout, TileList::Plain, samples, false, false, then, output)?;
        Ok(Self {
            kernels: vec![(TileList::Plain, pipeline)],
        })
    }

    fn pipeline(
        layout: &FrameLayout,
        list: TileList,
        block: u32,
        layered: bool,
        probed: bool,
        then: Then,
        output: &Constants,
    ) -> Result<Arc<Pipeline>, VulkanError> {
        let lanes = layout.gpu.limits().lanes;
        let constants = layout
            .lane_constants(output.clone(), lanes)
            .with(0, lanes)
            .with(2, block)
            .flag(3, layered)
            .with(4, list as u32)
            .flag(5, then == Then::Detect)
            .flag(6, probed)
            .flag(7, then == Then::Grow);
        layout.compute(spirv::RESOLVE, &constants, layout.subgroup())
    }

    /// Records it over the tiles of the round.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        for (list, pipeline) in &self.kernels {
            recorder.dispatch_indirect(pipeline, arguments, list.argument());
        }
    }
}
