//! scatter: finds the visible triangles of samples in tiles without a list of candidates.

use super::arguments::{After, Arguments};
use super::{SampleOptions, spirv};
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Tests the triangles of a tile one by one, so that their number is not limited.
pub struct Scatter {
    pipeline: Arc<Pipeline>,
    /// Sizes of the dispatches over layers; `None` without BLEND triangles.
    of_layers: Option<Arguments>,
}

impl Scatter {
    /// Makes the pipelines for the cells and the scene of `options`.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        scene: &dyn Content,
        options: &SampleOptions,
    ) -> Result<Self, VulkanError> {
        let shader = spirv::Scatter {
            lanes: layout.gpu.limits().lanes,
            has_mask: options.has_mask,
            locations: options.cells.are_locations(),
            points: options.cells.are_points(),
            occluders: options.cells.are_occluders(),
            instanced: scene.is_instanced(),
        };
        let of_layers = || Arguments::new(layout, After::Scatter);
        Ok(Self {
            pipeline: layout.compute(&shader, None)?,
            of_layers: options.has_blend.then(of_layers).transpose()?,
        })
    }

    /// Records the pass over the tiles of the round that have no list. The pass overwrites the lists of candidates.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        let step = |step, every, argument: Argument| {
            recorder.push(&self.pipeline, &spirv::ScatterPush { step, every });
            recorder.dispatch_indirect(&self.pipeline, arguments, argument as u32);
        };
        let of_owners = |name| step(name, 0, Argument::Owners);
        let of_triangles = |name| {
            recorder.unordered(|| {
                step(name, 0, Argument::Scatter);
                step(name, 1, Argument::ScatterEvery);
            });
        };
        of_owners(spirv::SCATTER_CLEAR);
        of_triangles(spirv::SCATTER_DEPTHS);
        of_triangles(spirv::SCATTER_IDS);
        if let Some(of_layers) = &self.of_layers {
            of_triangles(spirv::SCATTER_COUNT);
            of_owners(spirv::SCATTER_PLACE);
            of_triangles(spirv::SCATTER_LAYERS);
            of_layers.record(recorder);
            step(spirv::SCATTER_ORDER, 0, Argument::Layers);
        }
    }
}
