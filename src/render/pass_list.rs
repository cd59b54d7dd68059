//! The passes of a frame, as they are recorded.

use super::{Frame, Headless, RenderError};
use crate::camera::Camera;
use crate::passes::Argument;
use crate::vulkan::{Access, Dispatch, Dispatched};

/// A pass of a frame: a dispatch of a compute shader, or what a pair of shaders draws.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct FramePass {
    /// The shader's name: that of its file in `shaders/` and, where it is drawn with, of its stage.
    pub name: &'static str,
    /// What tells how many workgroups there are: a number, the name of the vector of an indirect dispatch, or `drawn`.
    pub dispatch: String,
    /// What the shader may read, by the names in `shaders/`; what is read and written is in both lists.
    pub reads: Vec<&'static str>,
    /// What it may write.
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
            writes: interface.data(Access::Write),
        }
    }
}

/// The name of an indirect dispatch.
fn argument(index: u32) -> String {
    let first = Argument::Shade as u32;
    match Argument::NAMES.get(index as usize) {
        Some(name) if index < first => (*name).to_owned(),
        _ => format!("shade {}", index.saturating_sub(first)),
    }
}

impl Headless {
    /// Renders a frame and says what passes that takes, in their order. Of the rounds that follow one another, the first one alone is
    /// listed.
    ///
    /// # Errors
    /// As [`Headless::render`].
    pub fn passes(
        &mut self,
        frame: &mut Frame,
        camera: &Camera,
    ) -> Result<Vec<FramePass>, RenderError> {
        let gpu = self.gpu().clone();
        let (rendered, dispatches) = gpu.traced(|| self.render_once(frame, camera));
        rendered?;
        Ok(dispatches.iter().map(FramePass::new).collect())
    }
}
