//! bin: makes pairs of triangles and the tiles that they touch.

use super::arguments::{After, Arguments};
use super::spirv;
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, Specialized, VulkanError};
use std::sync::Arc;

/// Lists the pairs, and counts the pairs of each tile.
pub struct Bin {
    arguments: Arguments,
    pipeline: Arc<Pipeline>,
}

impl Bin {
    /// Makes the pipelines.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout, scene: &dyn Content) -> Result<Self, VulkanError> {
        let instanced = scene.is_instanced();
        Ok(Self {
            arguments: Arguments::new(layout, After::Cull)?,
            pipeline: layout.compute(&spirv::Bin { instanced }, None)?,
        })
    }

    /// Records the pass: first for small triangles, then for large ones.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.pass(spirv::Bin::INTERFACE, || {
            self.arguments.record(recorder);
            recorder.unordered(|| {
                for (large, argument) in [(0, Argument::BinSmall), (1, Argument::BinLarge)] {
                    recorder.push(&self.pipeline, &spirv::BinPush { large });
                    recorder.dispatch_indirect(&self.pipeline, arguments, argument as u32);
                }
            });
        });
    }
}
