//! resolve: computes the colour of each superpixel.

use super::host_image::HostImage;
use super::{Composite, Sample, TileList, spirv};
use crate::engine::data::{Cells, ColorConstants};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, Specialized, VulkanError};
use std::sync::Arc;

/// Later pass that reads more of [`Resolve`]'s output than the colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResolveTarget {
    /// No such pass.
    Nothing,
    /// [`Detect`](super::Detect), which compares the resolved colours.
    Detect,
    /// [`Grow`](super::Grow), for which `resolve` marks neighbours that contrast.
    Grow,
}

/// Averages the visibility samples of each cell.
pub struct Resolve {
    /// Pass that blends layers before this pass; `None` without layers.
    composite: Option<Composite>,
    kernels: Vec<(TileList, Arc<Pipeline>)>,
    /// Host's image with the colours of samples that see no triangle; `None` for the background.
    behind: Option<Arc<HostImage>>,
}

impl Resolve {
    /// Makes a pipeline for each tile list of `sample`.
    ///
    /// `target` is the later pass that reads more than the colours, and `output` holds the colour constants of
    /// `shaders/include/color.glsl`. Samples that see no triangle take the colour of the host's image `behind`, or of
    /// the background if it is `None`. Layers are composited only over the background, so `behind` must be `None` for
    /// scenes that may have layers.
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
        let composite = || Composite::new(layout, output);
        Ok(Self {
            composite: has_blend.then(composite).transpose()?,
            kernels,
            behind: behind.cloned(),
        })
    }

    /// Makes the pipeline for the visibility samples of `multisample`, where each cell has a single header.
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
            composite: None,
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
            locations: cells.are_locations(),
            unsure: layout.is_unsure(lanes),
            tonemap: output.tonemap,
            tonemap_codes: output.tonemap_codes,
            encoded: behind.is_some_and(|image| image.encoded()),
        };
        let code = match behind {
            Some(_) => spirv::RESOLVE_DRAWN,
            None => spirv::RESOLVE,
        };
        layout.compute_variant(code, &shader, layout.subgroup())
    }

    /// Records the pass over the tiles of the round.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        if let Some(composite) = &self.composite {
            composite.record(recorder, arguments);
        }
        if let Some(image) = &self.behind {
            recorder.show(&image.sets);
        }
        recorder.pass(spirv::Resolve::INTERFACE, || {
            for (list, pipeline) in &self.kernels {
                recorder.dispatch_indirect(pipeline, arguments, list.argument());
            }
        });
    }
}
