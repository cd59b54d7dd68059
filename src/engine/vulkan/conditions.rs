//! Which word dispatches depend on: where blocks of conditional rendering begin and end.

use ash::vk;

/// What is recorded before a command, so that it depends on the right word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Change {
    /// The present block ends.
    pub ends: bool,
    /// Then a block begins that depends on the first word of a buffer.
    pub begins: Option<vk::Buffer>,
}

/// The word that dispatches depend on, and the block that was begun.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Conditions {
    wanted: Option<vk::Buffer>,
    begun: Option<vk::Buffer>,
}

impl Conditions {
    /// The buffer whose first word dispatches depend on, if they depend on any.
    pub fn word(&self) -> Option<vk::Buffer> {
        self.wanted
    }

    /// Has dispatches depend on another word from here on. Returns what [`Self::leave`] takes.
    pub fn enter(&mut self, word: vk::Buffer) -> Option<vk::Buffer> {
        self.wanted.replace(word)
    }

    /// Has dispatches depend on the word that they depended on before [`Self::enter`].
    ///
    /// The block ends, although the next one may depend on the same word: the word may be written in between, and drivers may read it
    /// where a block begins.
    pub fn leave(&mut self, before: Option<vk::Buffer>) -> Change {
        self.wanted = before;
        self.go_to(None)
    }

    /// What is recorded before a dispatch.
    pub fn before_dispatch(&mut self) -> Change {
        self.go_to(self.wanted)
    }

    /// What is recorded before commands that depend on no word.
    pub fn before_others(&mut self) -> Change {
        self.go_to(None)
    }

    fn go_to(&mut self, word: Option<vk::Buffer>) -> Change {
        let begun = std::mem::replace(&mut self.begun, word);
        Change {
            ends: begun.is_some() && begun != word,
            begins: word.filter(|_| begun != word),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ash::vk::Handle;

    const NONE: Change = Change {
        ends: false,
        begins: None,
    };
    const END: Change = Change {
        ends: true,
        begins: None,
    };

    fn begin(word: vk::Buffer) -> Change {
        Change {
            ends: false,
            begins: Some(word),
        }
    }

    /// The word is written between two rounds.
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
