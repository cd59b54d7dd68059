//! Blocks of conditional rendering: their beginnings and ends in a recording, and the words on which they depend.

use ash::vk;

/// Commands to record before another command, so that it depends on the right word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Change {
    /// Whether the present block ends.
    pub ends: bool,
    /// Buffer on whose first word a new block depends; `None` if no block begins.
    pub begins: Option<vk::Buffer>,
}

/// State of conditional rendering: the word on which dispatches shall depend, and the block that has begun.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Conditions {
    wanted: Option<vk::Buffer>,
    begun: Option<vk::Buffer>,
}

impl Conditions {
    /// Buffer on whose first word dispatches depend; `None` if they depend on none.
    pub fn word(&self) -> Option<vk::Buffer> {
        self.wanted
    }

    /// Makes dispatches depend on another word from here on. Returns the previous buffer, for [`Self::leave`].
    pub fn enter(&mut self, word: vk::Buffer) -> Option<vk::Buffer> {
        self.wanted.replace(word)
    }

    /// Makes dispatches depend on the word before [`Self::enter`] again, which was returned as `before`.
    ///
    /// The block ends even if the next one depends on the same word, because the word may be written in between, and
    /// drivers may read it only where a block begins.
    pub fn leave(&mut self, before: Option<vk::Buffer>) -> Change {
        self.wanted = before;
        self.go_to(None)
    }

    /// Change to record before a dispatch.
    pub fn before_dispatch(&mut self) -> Change {
        self.go_to(self.wanted)
    }

    /// Change to record before commands that depend on no word.
    pub fn before_others(&mut self) -> Change {
        self.go_to(None)
    }

    fn go_to(&mut self, word: Option<vk::Buffer>) -> Change {
        let begun = std::mem::replace(&mut self.begun, word);
        Change { ends: begun.is_some() && begun != word, begins: word.filter(|_| begun != word) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ash::vk::Handle;

    const NONE: Change = Change { ends: false, begins: None };
    const END: Change = Change { ends: true, begins: None };

    fn begin(word: vk::Buffer) -> Change {
        Change { ends: false, begins: Some(word) }
    }

    /// A word is written between two rounds, so each round must begin a new block.
    #[test]
    fn each_round_reads_its_word_anew() {
        let word = vk::Buffer::from_raw(1);
        let mut conditions = Conditions::default();
        for _ in 0..2 {
            let before = conditions.enter(word);
            assert_eq!(conditions.before_dispatch(), begin(word));
            assert_eq!(conditions.before_dispatch(), NONE);
            assert_eq!(conditions.leave(before), END);
            assert_eq!(conditions.before_dispatch(), NONE);
        }
    }

    #[test]
    fn an_inner_word_takes_the_place_of_the_outer_one() {
        let [outer, inner] = [1, 2].map(vk::Buffer::from_raw);
        let mut conditions = Conditions::default();
        let before_outer = conditions.enter(outer);
        assert_eq!(conditions.before_dispatch(), begin(outer));
        let before_inner = conditions.enter(inner);
        let change = conditions.before_dispatch();
        assert!(change.ends && change.begins == Some(inner));
        assert_eq!(conditions.before_others(), END);
        assert_eq!(conditions.before_dispatch(), begin(inner));
        assert_eq!(conditions.leave(before_inner), END);
        assert_eq!(conditions.before_dispatch(), begin(outer));
        assert_eq!(conditions.leave(before_outer), END);
        assert_eq!(conditions.word(), None);
    }
}
