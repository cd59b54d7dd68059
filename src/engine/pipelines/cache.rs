//! Cache of pipelines, which frames of other sizes, poses and scenes use again.

use crate::vulkan::{Constants, Pipeline};
use std::collections::HashMap;
use std::sync::Arc;

/// Key of a pipeline: address of its shader's code, its constants, and a variant of its fixed state.
pub(crate) type PipelineKey = (usize, Constants, u32);

/// Pipelines by key. `P` is a [`Pipeline`], except in tests.
pub(crate) struct Pipelines<P = Pipeline> {
    known: HashMap<PipelineKey, Known<P>>,
    /// Number of requests so far.
    turn: u64,
    /// Largest number of pipelines that are kept although no frame uses them.
    most_unused: usize,
}

struct Known<P> {
    pipeline: Arc<P>,
    /// Number of the request at which the pipeline was last used.
    asked: u64,
}

impl<P> Pipelines<P> {
    pub fn new(most_unused: usize) -> Self {
        Self { known: HashMap::new(), turn: 0, most_unused }
    }

    /// Pipeline with this key, if it is in the cache.
    pub fn get(&mut self, key: &PipelineKey) -> Option<Arc<P>> {
        self.turn += 1;
        let known = self.known.get_mut(key)?;
        known.asked = self.turn;
        Some(known.pipeline.clone())
    }

    /// Adds a pipeline and returns it, or the one with the same key that another thread has added in the meantime. If
    /// too many pipelines are unused, those that were not requested for the longest time are dropped.
    pub fn add(&mut self, key: PipelineKey, made: P) -> Arc<P> {
        self.turn += 1;
        let added = self.known.entry(key).or_insert_with(|| Known { pipeline: Arc::new(made), asked: 0 });
        added.asked = self.turn;
        let added = added.pipeline.clone();
        let is_unused = |known: &&Known<P>| Arc::strong_count(&known.pipeline) == 1;
        let mut unused: Vec<_> = self.known.values().filter(is_unused).collect();
        unused.sort_unstable_by_key(|known| known.asked);
        if let Some(excess) = unused.len().checked_sub(self.most_unused + 1) {
            let last = unused[excess].asked;
            self.known.retain(|_, known| known.asked > last || Arc::strong_count(&known.pipeline) > 1);
        }
        added
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MOST_UNUSED: usize = 64;

    fn key(index: usize) -> PipelineKey {
        (index, Constants::new().with(0, 7), 0)
    }

    #[test]
    fn what_was_not_asked_for_the_longest_goes_unless_it_is_used() {
        let mut pipelines = Pipelines::new(MOST_UNUSED);
        let used = pipelines.add(key(0), 0);
        for index in 1..=MOST_UNUSED {
            pipelines.add(key(index), index);
        }
        // All unused pipelines fit; the first of them was requested last.
        assert_eq!(pipelines.get(&key(1)).as_deref(), Some(&1));
        for index in MOST_UNUSED + 1..MOST_UNUSED + 4 {
            pipelines.add(key(index), index);
        }
        let is_kept = |index: usize| pipelines.known.contains_key(&key(index));
        assert!(is_kept(0) && is_kept(1) && is_kept(MOST_UNUSED + 3));
        assert!(!is_kept(2) && !is_kept(3) && is_kept(4), "{}", pipelines.known.len());
        drop(used);
        pipelines.add(key(MOST_UNUSED + 4), 0);
        assert_eq!(pipelines.get(&key(0)), None);
    }

    #[test]
    fn the_first_of_two_that_are_made_at_once_stays() {
        let mut pipelines = Pipelines::new(MOST_UNUSED);
        let first = pipelines.add(key(0), "first");
        assert!(Arc::ptr_eq(&first, &pipelines.add(key(0), "second")));
    }
}
