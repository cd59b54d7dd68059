//! List of the passes of a frame, in the order in which they are recorded.

use super::{Frame, Headless, RenderError};
use crate::camera::Camera;
use crate::engine::data::Argument;
use crate::vulkan::{Access, Dispatch, Dispatched};

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

impl FramePass {
    fn new(dispatch: &Dispatch) -> Self {
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

/// What `raster`, the only pass of a frame that draws, draws into, by the names by which other shaders read it.
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
    /// Renders a frame and lists its passes in order. Of consecutive rounds, only the first is listed.
    ///
    /// # Errors
    /// As [`Headless::render`].
    pub fn passes(
        &mut self,
        frame: &mut Frame,
        camera: &Camera,
    ) -> Result<Vec<FramePass>, RenderError> {
        let (rendered, passes) = self.passes_of(|headless| headless.render_once(frame, camera));
        rendered?;
        Ok(passes)
    }

    /// Lists the passes of all that is recorded meanwhile on the device, in order. Of consecutive rounds, only the first is
    /// listed.
    pub fn passes_of<T>(&mut self, record: impl FnOnce(&mut Self) -> T) -> (T, Vec<FramePass>) {
        let gpu = self.gpu().clone();
        let (made, dispatches) = gpu.traced(|| record(self));
        (made, dispatches.iter().map(FramePass::new).collect())
    }
}
