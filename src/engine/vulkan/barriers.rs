//! Barriers between commands that depend on each other.

use ash::vk;

/// Buffers that commands read and write.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Accesses {
    reads: Vec<vk::Buffer>,
    writes: Vec<vk::Buffer>,
}

impl Accesses {
    /// Accesses of a copy.
    pub fn copy(from: vk::Buffer, to: vk::Buffer) -> Self {
        Self { reads: vec![from], writes: vec![to] }
    }

    pub fn read(&mut self, buffer: vk::Buffer) {
        add(&mut self.reads, buffer);
    }

    pub fn write(&mut self, buffer: vk::Buffer) {
        add(&mut self.writes, buffer);
    }

    /// Whether `later` accesses have to wait for these.
    fn order(&self, later: &Self) -> bool {
        let writes_what = |read: &vk::Buffer| self.writes.contains(read);
        let uses_what = |written: &vk::Buffer| self.writes.contains(written) || self.reads.contains(written);
        later.reads.iter().any(writes_what) || later.writes.iter().any(uses_what)
    }

    fn extend(&mut self, other: &Self) {
        other.reads.iter().for_each(|buffer| self.read(*buffer));
        other.writes.iter().for_each(|buffer| self.write(*buffer));
    }

    fn clear(&mut self) {
        self.reads.clear();
        self.writes.clear();
    }
}

fn add(list: &mut Vec<vk::Buffer>, buffer: vk::Buffer) {
    if !list.contains(&buffer) {
        list.push(buffer);
    }
}

/// Commands that a barrier orders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ordered {
    /// Dispatches, and copies and fills of buffers.
    Dispatches,
    /// Commands of any kind.
    All,
}

impl Ordered {
    /// Barrier that makes the writes of earlier commands visible to later ones, for commands of this kind. With
    /// `can_skip`, the writes are also visible to the test of conditional rendering.
    pub fn barrier(self, can_skip: bool) -> vk::MemoryBarrier2<'static> {
        use vk::{AccessFlags2 as A, PipelineStageFlags2 as S};
        let (stages, writes, reads) = match self {
            Self::Dispatches => (
                S::COMPUTE_SHADER | S::DRAW_INDIRECT | S::ALL_TRANSFER,
                A::SHADER_WRITE | A::TRANSFER_WRITE,
                A::SHADER_READ | A::UNIFORM_READ | A::INDIRECT_COMMAND_READ | A::TRANSFER_READ,
            ),
            Self::All => (S::ALL_COMMANDS, A::MEMORY_WRITE, A::MEMORY_READ),
        };
        let (stages, reads) = if can_skip {
            (stages | S::CONDITIONAL_RENDERING_EXT, reads | A::CONDITIONAL_RENDERING_READ_EXT)
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

/// Accesses that were recorded since the last barriers, with which later commands are compared.
#[derive(Debug)]
pub(super) struct Barriers {
    /// Accesses of dispatches, copies and fills since the last barrier.
    pending: Accesses,
    /// Accesses of a group of commands that do not depend on each other; `None` outside of groups.
    group: Option<Accesses>,
    /// Whether commands of unknown kinds and accesses were recorded since the last barrier for all commands.
    unknown: bool,
    /// Whether any command was recorded since the last barrier for all commands.
    recorded: bool,
}

impl Barriers {
    /// State at the beginning of a recording, after unknown commands.
    pub fn new() -> Self {
        Self { pending: Accesses::default(), group: None, unknown: true, recorded: true }
    }

    /// Barrier that must be recorded before a dispatch, a copy or a fill with these accesses, if any.
    pub fn before(&mut self, accesses: &Accesses) -> Option<Ordered> {
        let barrier = if self.unknown {
            self.all_ordered();
            Some(Ordered::All)
        } else if self.pending.order(accesses) {
            self.pending.clear();
            Some(Ordered::Dispatches)
        } else {
            None
        };
        self.recorded = true;
        self.group.as_mut().unwrap_or(&mut self.pending).extend(accesses);
        barrier
    }

    /// Barrier that must be recorded before commands with unknown accesses, if any.
    pub fn before_unknown(&mut self) -> Option<Ordered> {
        let barrier = self.recorded.then_some(Ordered::All);
        self.all_ordered();
        self.unknown = true;
        self.recorded = true;
        barrier
    }

    /// Notes that a barrier for all commands was recorded.
    pub fn all_ordered(&mut self) {
        self.pending.clear();
        self.unknown = false;
        self.recorded = false;
    }

    /// Begins a group of commands that do not depend on each other, unless a group has already begun.
    ///
    /// Returns whether a group began.
    pub fn begin_group(&mut self) -> bool {
        let begins = self.group.is_none();
        self.group.get_or_insert_default();
        begins
    }

    /// Ends a group.
    pub fn end_group(&mut self) {
        if let Some(group) = self.group.take() {
            self.pending.extend(&group);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ash::vk::Handle;

    /// Command of a test: whether it reads and writes each of two buffers, or has unknown accesses.
    #[derive(Clone, Copy, Debug, PartialEq)]
    enum Command {
        Known { reads: [bool; 2], writes: [bool; 2] },
        Unknown,
    }

    /// In order: a read; a write; a read and write of the other buffer; a copy; a read of both buffers; a command
    /// without accesses; a command with unknown accesses.
    const COMMANDS: [Command; 7] = {
        const fn known(reads: [bool; 2], writes: [bool; 2]) -> Command {
            Command::Known { reads, writes }
        }
        [
            known([true, false], [false, false]),
            known([false, false], [true, false]),
            known([false, true], [false, true]),
            known([true, false], [false, true]),
            known([true, true], [false, false]),
            known([false, false], [false, false]),
            Command::Unknown,
        ]
    };

    impl Command {
        fn accesses(self) -> Option<Accesses> {
            let Self::Known { reads, writes } = self else {
                return None;
            };
            let named = |flags: [bool; 2]| {
                let buffers = [1, 2].map(vk::Buffer::from_raw).into_iter().zip(flags);
                buffers.filter_map(|(buffer, named)| named.then_some(buffer))
            };
            let mut accesses = Accesses::default();
            named(reads).for_each(|buffer| accesses.read(buffer));
            named(writes).for_each(|buffer| accesses.write(buffer));
            Some(accesses)
        }

        /// Kinds of barriers that suffice between this command and a later one; `None` if they need no barrier.
        fn needs(self, later: Self) -> Option<&'static [Ordered]> {
            let (Self::Known { reads, writes }, Self::Known { reads: r, writes: w }) = (self, later) else {
                return Some(&[Ordered::All]);
            };
            let conflict = |n: usize| writes[n] && (r[n] || w[n]) || reads[n] && w[n];
            (conflict(0) || conflict(1)).then_some(&[Ordered::All, Ordered::Dispatches])
        }
    }

    fn barrier_before(barriers: &mut Barriers, command: Command) -> Option<Ordered> {
        match command.accesses() {
            Some(accesses) => barriers.before(&accesses),
            None => barriers.before_unknown(),
        }
    }

    /// Tests all sequences of five commands after unknown ones. Commands that depend on each other must be ordered, and
    /// each barrier must be necessary.
    #[test]
    fn commands_that_depend_on_each_other_are_ordered() {
        const LENGTH: u32 = 5;
        for number in 0..COMMANDS.len().pow(LENGTH) {
            let of = |place| COMMANDS[number / COMMANDS.len().pow(place) % COMMANDS.len()];
            let mut commands = vec![Command::Unknown];
            commands.extend((0..LENGTH).map(of));
            let mut barriers = Barriers::new();
            let mut before = vec![None];
            before.extend(commands[1..].iter().map(|command| barrier_before(&mut barriers, *command)));
            for (last, command) in commands.iter().enumerate() {
                for first in 0..last {
                    if let Some(sufficient) = commands[first].needs(*command) {
                        let between = before[first + 1..=last].iter().flatten();
                        assert!(
                            between.into_iter().any(|barrier| sufficient.contains(barrier)),
                            "{commands:?} {before:?}: {first}, {last}"
                        );
                    }
                }
                if before[last].is_some() {
                    let mut earlier = commands[..last].iter();
                    assert!(earlier.any(|first| first.needs(*command).is_some()));
                }
            }
        }
    }

    #[test]
    fn commands_of_a_group_wait_for_those_before_it_and_not_for_each_other() {
        let mut barriers = Barriers::new();
        let [read, write, ..] = COMMANDS;
        assert_eq!(barrier_before(&mut barriers, read), Some(Ordered::All));
        barriers.begin_group();
        assert_eq!(barrier_before(&mut barriers, write), Some(Ordered::Dispatches));
        assert_eq!(barrier_before(&mut barriers, write), None);
        barriers.end_group();
        assert_eq!(barrier_before(&mut barriers, write), Some(Ordered::Dispatches));
    }
}
