//! neighbours: finds cells of an output that contrast with a superpixel beside them.

use crate::engine::data::ColorConstants;
use crate::engine::passes::spirv;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Marks cells for [`Grow`](crate::engine::passes::Grow) in an output whose superpixels are sampled as a list of
/// locations.
pub struct Neighbours {
    pipeline: Arc<Pipeline>,
}

impl Neighbours {
    /// Makes the pipeline; `output` holds the constants that turn radiance into the image's colours.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, output: &ColorConstants) -> Result<Self, VulkanError> {
        let shader = spirv::Neighbours {
            tonemap: output.tonemap,
            tonemap_codes: output.tonemap_codes,
        };
        Ok(Self {
            pipeline: layout.compute(&shader, None)?,
        })
    }

    /// Records the pass for an output of `cells` cells.
    pub fn record(&self, recorder: &Recorder<'_>, cells: u32) {
        recorder.dispatch_each(&self.pipeline, u64::from(cells));
    }
}
