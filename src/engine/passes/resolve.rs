//! resolve: the colour of each superpixel.

use super::host_image::HostImage;
use super::{Sample, TileList, spirv};
use crate::engine::data::{Cells, ColorConstants};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// The pass that reads what [`Resolve`] wrote, beside the colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResolveTarget {
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
    /// What shows in samples that see no triangle; without it the background does.
    behind: Option<Arc<HostImage>>,
}

impl Resolve {
    /// Makes a pipeline for each list of `sample`; `target` is what a pass after it needs, `output` are the colour constants of
    /// `shaders/include/color.glsl`. Samples that see no triangle show what the host has drawn in the image `behind`, or the
    /// background; layers are composited over the background alone, so that there is no image where there may be some.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub(crate) fn new(
        layout: &FrameLayout,
        sample: &Sample,
        has_blend: bool,
        target: ResolveTarget,
        output: &ColorConstants,
        behind: Option<&Arc<HostImage>>,
    ) -> Result<Self, VulkanError> {
        let cells = sample.options().cells;
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
                        target,
                        (cells, output, behind),
                    )?,
                ))
            })
            .collect::<Result<_, VulkanError>>()?;
        Ok(Self {
            kernels,
            behind: behind.cloned(),
        })
    }

    /// For records that `multisample` wrote: one header a cell.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn for_multisample(
        layout: &FrameLayout,
        samples: u32,
        target: ResolveTarget,
        output: &ColorConstants,
    ) -> Result<Self, VulkanError> {
        let pipeline = Self::pipeline(
            layout,
            TileList::Plain,
            samples,
            false,
            false,
            target,
            (Cells::Pixels, output, None),
        )?;
        Ok(Self {
            kernels: vec![(TileList::Plain, pipeline)],
            behind: None,
        })
    }

    fn pipeline(
        layout: &FrameLayout,
        list: TileList,
        block: u32,
        layered: bool,
        probed: bool,
        target: ResolveTarget,
        (cells, output, behind): (Cells, &ColorConstants, Option<&Arc<HostImage>>),
    ) -> Result<Arc<Pipeline>, VulkanError> {
        let lanes = layout.gpu.limits().lanes;
        let shader = spirv::Resolve {
            local_size: lanes,
            lanes,
            block,
            layered,
            list: list as u32,
            display_codes: target == ResolveTarget::Detect,
            probed,
            grows: target == ResolveTarget::Grow,
            tinted: output.tinted,
            locations: cells.are_locations(),
            unsure: layout.is_unsure(lanes),
            tonemap: output.tonemap,
            tonemap_codes: output.tonemap_codes,
            encoded: behind.is_some_and(|image| image.encoded()),
        };
        match behind {
            Some(image) => image.pipeline(layout, spirv::RESOLVE_DRAWN, &shader, layout.subgroup()),
            None => layout.compute_variant(spirv::RESOLVE, &shader, layout.subgroup()),
        }
    }

    /// Records it over the tiles of the round.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        if let Some(image) = &self.behind {
            image.bind(recorder);
        }
        for (list, pipeline) in &self.kernels {
            recorder.dispatch_indirect(pipeline, arguments, list.argument());
        }
    }
}
