//! List of the passes of a frame, in the order in which they are recorded.

use super::{Headless, RenderError, SceneFrame};
use crate::camera::Camera;
use crate::engine::data::Argument;
use crate::vulkan::{Access, Dispatched, Traced, TracedDispatch};

/// A pass of a frame: a dispatch of a compute shader, or a draw with a pair of shaders.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct FramePass {
    /// Name of the shader's file in `shaders/`, with the stage for shaders that draw.
    pub name: &'static str,
    /// Source of the number of workgroups: a number, the name of an indirect dispatch's vector, or `drawn`.
    pub dispatch: String,
    /// Data that the shader may read, by its names in `shaders/`. Data that is both read and written is in both lists.
    pub reads: Vec<&'static str>,
    /// Data that the shader may write.
    pub writes: Vec<&'static str>,
}

/// The commands of a recording.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct RecordedPasses {
    /// Passes in the order in which they were recorded. Of consecutive rounds, only the first is listed.
    pub passes: Vec<FramePass>,
    /// Number of all dispatches, of all rounds.
    pub dispatches: u64,
    /// Number of all barriers, of all rounds.
    pub barriers: u64,
}

impl From<Traced> for RecordedPasses {
    fn from(traced: Traced) -> Self {
        Self {
            passes: traced.dispatches.iter().map(FramePass::new).collect(),
            dispatches: traced.dispatch_count,
            barriers: traced.barrier_count,
        }
    }
}

impl FramePass {
    fn new(dispatch: &TracedDispatch) -> Self {
        let interface = dispatch.interface;
        Self {
            name: interface.name,
            dispatch: match dispatch.size {
                Dispatched::Workgroups(groups) => groups.to_string(),
                Dispatched::Indirect(index) => argument(index),
                Dispatched::Drawn => "drawn".to_owned(),
            },
            reads: interface.data(Access::Read),
            writes: match dispatch.size {
                Dispatched::Drawn => ATTACHMENTS.to_vec(),
                _ => interface.data(Access::Write),
            },
        }
    }
}

/// Attachments of `raster`, the only pass of a frame that draws, by the names that other shaders use for them.
const ATTACHMENTS: [&str; 3] = ["ids", "blend_ids", "raster_depth"];

/// Name of an indirect dispatch.
fn argument(index: u32) -> String {
    let first = Argument::Shade as u32;
    match Argument::NAMES.get(index as usize) {
        Some(name) if index < first => (*name).to_owned(),
        _ => format!("shade {}", index.saturating_sub(first)),
    }
}

impl Headless {
    /// Renders a frame and lists its passes.
    ///
    /// # Errors
    /// As [`Headless::render`].
    pub fn passes(&mut self, frame: &mut SceneFrame, camera: &Camera) -> Result<RecordedPasses, RenderError> {
        let (rendered, passes) = self.passes_of(|headless| headless.render_once::<[f32; 4]>(frame, camera));
        rendered?;
        Ok(passes)
    }

    /// Calls `record`. Returns its result, and a list of the passes that were recorded on the device meanwhile.
    pub fn passes_of<T>(&mut self, record: impl FnOnce(&mut Self) -> T) -> (T, RecordedPasses) {
        let gpu = self.gpu().clone();
        let (made, traced) = gpu.traced(|| record(self));
        (made, traced.into())
    }
}
