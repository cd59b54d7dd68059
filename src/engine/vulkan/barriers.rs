//! Barriers between commands, and the commands that each of them orders.

use ash::vk;

/// Kind of commands that a barrier orders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Commands {
    /// Dispatches, and copies and fills of buffers.
    Dispatches,
    /// Commands of any kind.
    Any,
}

impl Commands {
    /// Barrier that makes the writes of such earlier commands visible to later ones. If the device can skip commands,
    /// the writes are also visible to the test whether commands are skipped.
    pub fn barrier(self, can_skip: bool) -> vk::MemoryBarrier2<'static> {
        use vk::{AccessFlags2 as A, PipelineStageFlags2 as S};
        let (stages, writes, reads) = match self {
            Self::Dispatches => (
                S::COMPUTE_SHADER | S::DRAW_INDIRECT | S::ALL_TRANSFER,
                A::SHADER_WRITE | A::TRANSFER_WRITE,
                A::SHADER_READ | A::UNIFORM_READ | A::INDIRECT_COMMAND_READ | A::TRANSFER_READ,
            ),
            Self::Any => (S::ALL_COMMANDS, A::MEMORY_WRITE, A::MEMORY_READ),
        };
        let (stages, reads) = if can_skip {
            (
                stages | S::CONDITIONAL_RENDERING_EXT,
                reads | A::CONDITIONAL_RENDERING_READ_EXT,
            )
        } else {
            (stages, reads)
        };
        vk::MemoryBarrier2::default()
            .src_stage_mask(stages)
            .src_access_mask(writes)
            .dst_stage_mask(stages)
            .dst_access_mask(reads | writes)
    }
}

/// Commands that were recorded since the last barrier, and whether a barrier was requested.
///
/// If a barrier was requested between two commands, one is recorded that orders both: a barrier for commands of any
/// kind, if either of them is not a dispatch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Barriers {
    /// Whether a barrier was requested.
    asked: bool,
    /// Whether other commands than dispatches may have been recorded since the last barrier.
    others: bool,
    /// Whether all barriers since the last one for commands of any kind were for dispatches only.
    narrow: bool,
}

impl Barriers {
    /// State at the beginning of a recording, after unknown commands.
    pub const fn new() -> Self {
        Self {
            asked: false,
            others: true,
            narrow: false,
        }
    }

    /// Requests a barrier between the earlier and the later commands.
    pub fn ask(&mut self) {
        self.asked = true;
    }

    /// Barrier that has to be recorded before a command of kind `next`, if any.
    pub fn before(&mut self, next: Commands) -> Option<Commands> {
        let others_next = next == Commands::Any;
        let wide = self.asked && (self.others || others_next) || self.narrow && others_next;
        let narrow = self.asked && !wide;
        if wide || narrow {
            self.others = false;
            self.narrow = narrow;
        }
        self.asked = false;
        self.others |= others_next;
        match (wide, narrow) {
            (true, _) => Some(Commands::Any),
            (_, true) => Some(Commands::Dispatches),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Copy, Debug, PartialEq)]
    enum Step {
        Ask,
        Record(Commands),
    }

    const STEPS: [Step; 3] = [
        Step::Ask,
        Step::Record(Commands::Dispatches),
        Step::Record(Commands::Any),
    ];

    /// Step of a recording: a command, or a request for a barrier.
    #[derive(Clone, Copy, Debug, PartialEq)]
    enum Recorded {
        Asked,
        Barrier(Commands),
        Command(Commands),
    }

    fn record(steps: impl Iterator<Item = Step>) -> Vec<Recorded> {
        let mut barriers = Barriers::new();
        // The commands before the recording count as a command too.
        let mut recorded = vec![Recorded::Command(Commands::Any)];
        for step in steps {
            match step {
                Step::Ask => {
                    barriers.ask();
                    recorded.push(Recorded::Asked);
                }
                Step::Record(command) => {
                    recorded.extend(barriers.before(command).map(Recorded::Barrier));
                    recorded.push(Recorded::Command(command));
                }
            }
        }
        recorded
    }

    /// Tests all sequences of nine steps.
    #[test]
    fn commands_with_a_barrier_asked_for_between_them_are_ordered() {
        for number in 0..3_usize.pow(9) {
            let steps = (0..9).map(|place| STEPS[number / 3_usize.pow(place) % 3]);
            let recorded = record(steps);
            for (first, last) in
                (0..recorded.len()).flat_map(|last| (0..last).map(move |first| (first, last)))
            {
                let (Recorded::Command(before), Recorded::Command(after)) =
                    (recorded[first], recorded[last])
                else {
                    continue;
                };
                let between = &recorded[first..last];
                if between.contains(&Recorded::Asked) {
                    let for_both = Recorded::Barrier(Commands::Dispatches);
                    let dispatches = [before, after] == [Commands::Dispatches; 2];
                    assert!(
                        between.contains(&Recorded::Barrier(Commands::Any))
                            || dispatches && between.contains(&for_both),
                        "{recorded:?}: {first}, {last}"
                    );
                }
            }
        }
    }

    #[test]
    fn barriers_between_dispatches_are_for_these_alone() {
        let dispatch = Step::Record(Commands::Dispatches);
        let steps = [Step::Ask, dispatch, Step::Ask, dispatch, dispatch];
        let barriers = |recorded: Vec<Recorded>| {
            let barriers = recorded.into_iter().filter_map(|item| match item {
                Recorded::Barrier(commands) => Some(commands),
                _ => None,
            });
            barriers.collect::<Vec<_>>()
        };
        let found = barriers(record(steps.into_iter()));
        assert_eq!(found, [Commands::Any, Commands::Dispatches]);
    }
}
