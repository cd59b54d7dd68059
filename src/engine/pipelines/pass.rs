//! Declaration of a pass.

use super::Dispatch;
use crate::vulkan::{Binding, Interface, Recorder};

/// Declaration of a pass: its name, and the commands that it records, in their order. The interfaces of the shaders that it
/// dispatches say what it reads and writes.
///
/// A pass needs nothing but a declaration if its push constants are known when it is made. Passes whose push constants
/// are known only when a frame is recorded have a type of their own, with a `Kernel`.
pub struct Pass {
    interface: &'static Interface,
    steps: Vec<Step>,
}

/// Commands of a pass. Each step waits for the data that it needs of the steps before it.
enum Step {
    /// Fills what the frame's sets show at a binding with zeros.
    Clear(Binding),
    /// Dispatches that do not depend on each other.
    Dispatch(Vec<Dispatch>),
}

impl Pass {
    /// A pass with the name of the shader of this interface, which does nothing yet.
    pub(crate) fn named(interface: &'static Interface) -> Self {
        Self { interface, steps: Vec::new() }
    }

    /// The pass, which then fills what the frame's sets show at a binding with zeros.
    pub(crate) fn clear(self, binding: Binding) -> Self {
        self.step(Step::Clear(binding))
    }

    /// The pass, which then dispatches a kernel.
    pub(crate) fn dispatch(self, dispatch: Dispatch) -> Self {
        self.unordered([dispatch])
    }

    /// The pass, which then dispatches kernels that do not depend on each other: they write different places, or what they
    /// write does not depend on their order.
    pub(crate) fn unordered(self, dispatches: impl IntoIterator<Item = Dispatch>) -> Self {
        self.step(Step::Dispatch(dispatches.into_iter().collect()))
    }

    /// The pass, which then does what another pass does.
    pub(crate) fn then(mut self, other: Self) -> Self {
        self.steps.extend(other.steps);
        self
    }

    fn step(mut self, step: Step) -> Self {
        self.steps.push(step);
        self
    }

    /// Records the pass, if the device knows the sizes of all dispatches.
    pub fn record(&self, recorder: &Recorder<'_>) {
        self.record_for(recorder, 0);
    }

    /// Records the pass for `items` items: pixels, tiles or triangles, as the pass says.
    pub fn record_for(&self, recorder: &Recorder<'_>, items: u32) {
        recorder.pass(self.interface, || {
            for step in &self.steps {
                match step {
                    Step::Clear(binding) => recorder.clear_shown(*binding),
                    Step::Dispatch(dispatches) => {
                        let record = |dispatch: &Dispatch| dispatch.record(recorder, items);
                        if let [dispatch] = &dispatches[..] {
                            record(dispatch);
                        } else {
                            recorder.unordered(|| dispatches.iter().for_each(record));
                        }
                    }
                }
            }
        });
    }
}
