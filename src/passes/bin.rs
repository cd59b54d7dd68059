//! bin: triangles into pairs with the tiles they touch.

use super::{Argument, Content, FrameLayout, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Lists the pairs and counts each tile's.
pub struct Bin {
    arguments: Arc<Pipeline>,
    small: Arc<Pipeline>,
    large: Arc<Pipeline>,
}

impl Bin {
    /// Makes the pipelines.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout, scene: &dyn Content) -> Result<Self, VulkanError> {
        let make = |code, constants| layout.compute(code, &constants, None);
        let bin = |large| make(spirv::BIN, scene.constants(Constants::new().flag(0, large)));
        Ok(Self {
            arguments: make(spirv::ARGUMENTS, Constants::new().with(0, 1))?,
            small: bin(false)?,
            large: bin(true)?,
        })
    }

    /// Records it.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.dispatch(&self.arguments, 1);
        recorder.dispatch_indirect_unordered(&self.small, arguments, Argument::BinSmall as u32);
        recorder.dispatch_indirect(&self.large, arguments, Argument::BinLarge as u32);
    }
}
