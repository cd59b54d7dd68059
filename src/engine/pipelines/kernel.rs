//! Kernels, and dispatches of them.

use crate::engine::spirv::Argument;
use crate::engine::spirv::frame_set;
use crate::vulkan::{Buffer, DescriptorSets, Pipeline, Recorder, Specialized};
use std::marker::PhantomData;
use std::sync::Arc;

/// Pipeline of the compute shader whose constants are `S`.
pub(crate) struct Kernel<S> {
    pipeline: Arc<Pipeline>,
    shader: PhantomData<fn() -> S>,
}

/// Number of workgroups of a dispatch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Size {
    /// The number that a pass before has written to the vector with this index in the frame's buffer of indirect dispatches.
    Indirect(u32),
    /// One workgroup.
    One,
    /// Workgroups for a number of items that the caller names when it records the pass. The value is the number of items that an
    /// invocation processes.
    Items(u32),
}

impl From<Argument> for Size {
    fn from(argument: Argument) -> Self {
        Self::Indirect(argument as u32)
    }
}

/// Dispatch of a kernel, with its push constants.
pub(crate) struct Dispatch {
    pipeline: Arc<Pipeline>,
    pushed: Vec<u8>,
    size: Size,
    /// Sets of the kernel's pass besides the frame's, if it has any.
    own: Option<Arc<DescriptorSets>>,
}

impl<S: Specialized> Kernel<S> {
    /// The kernel of a pipeline that was made of this shader.
    pub(super) fn new(pipeline: Arc<Pipeline>) -> Self {
        Self { pipeline, shader: PhantomData }
    }

    /// Dispatch that a pass declares.
    pub fn dispatch(&self, pushed: S::Push, size: impl Into<Size>) -> Dispatch {
        Dispatch {
            pipeline: self.pipeline.clone(),
            pushed: bytemuck::bytes_of(&pushed).to_vec(),
            size: size.into(),
            own: None,
        }
    }

    /// Records a dispatch whose push constants and number of `invocations` are known only now.
    pub fn record(&self, recorder: &Recorder<'_>, pushed: &S::Push, invocations: impl Into<u64>) {
        recorder.push(&self.pipeline, bytemuck::bytes_of(pushed));
        recorder.dispatch_each(&self.pipeline, invocations.into());
    }

    /// Records a dispatch of `teams` teams whose push constants are known only now.
    pub fn record_teams(&self, recorder: &Recorder<'_>, pushed: &S::Push, teams: u32) {
        recorder.push(&self.pipeline, bytemuck::bytes_of(pushed));
        let groups = teams.div_ceil(recorder.limits().teams.in_workgroup);
        recorder.dispatch(&self.pipeline, groups.into());
    }

    /// Records a dispatch whose push constants are known only now. The device reads its size from the frame's indirect
    /// dispatches.
    pub fn record_indirect(&self, recorder: &Recorder<'_>, pushed: &S::Push, argument: Argument) {
        self.dispatch(*pushed, argument).record(recorder, 0);
    }

    /// Records a dispatch whose push constants are known only now. The device reads its size from another frame's indirect
    /// dispatches.
    pub fn record_counted(&self, recorder: &Recorder<'_>, pushed: &S::Push, arguments: &Buffer, argument: Argument) {
        recorder.push(&self.pipeline, bytemuck::bytes_of(pushed));
        recorder.dispatch_indirect(&self.pipeline, arguments.handle(), argument as u32);
    }
}

impl Dispatch {
    /// The dispatch, of a kernel that uses these sets besides the frame's.
    pub fn with(mut self, own: &Arc<DescriptorSets>) -> Self {
        self.own = Some(own.clone());
        self
    }

    /// Records the dispatch for `items` items.
    pub fn record(&self, recorder: &Recorder<'_>, items: u32) {
        let pipeline = &*self.pipeline;
        if let Some(own) = &self.own {
            recorder.show(own);
        }
        recorder.push(pipeline, &self.pushed);
        match self.size {
            Size::Indirect(index) => {
                recorder.dispatch_indirect(pipeline, recorder.shown(frame_set::ARGUMENTS), index);
            }
            Size::One => recorder.dispatch(pipeline, 1),
            Size::Items(of_invocation) => {
                recorder.dispatch_each(pipeline, u64::from(items.div_ceil(of_invocation)));
            }
        }
    }
}
