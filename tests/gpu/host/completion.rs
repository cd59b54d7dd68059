//! Recordings that are discarded, and queries before a recording has been executed.

use super::list::pixels;
use super::machine::{Base, Machine, is_not_done};
use super::mask;
use super::world::{PLACED, SIZE, World};
use crate::stage::on_gpu;
use gpc::host::Options;
use gpc::scene::Sampler;

/// Uploads of a first recording that was discarded are repeated by the next recording.
#[test]
fn a_discarded_recording_changes_nothing() {
    on_gpu(|gpu| {
        let world = mask::world(&Sampler::default());
        let mut machine = Machine::new(gpu, &world);
        let options = Options::new(SIZE[0], SIZE[1]);
        let lent = world.lent(&PLACED);
        let [seen, again] = [false, true].map(|discards| {
            machine.discards = discards;
            let frame = machine.see_lent(&PLACED, &lent, Base::Nothing, options.clone());
            let (list, _) = machine.see_list(&PLACED, &pixels(), options.clone());
            (frame.colors, list)
        });
        assert!(seen == again);
    });
}

/// An application may record its commands once and submit them for each frame.
#[test]
fn a_recording_that_is_submitted_again_makes_the_same_picture() {
    on_gpu(|gpu| {
        for world in [World::new(), mask::world(&Sampler::default())] {
            let machine = Machine::new(gpu, &world);
            let [first, second] = machine.see_twice(&PLACED, &world.lent(&PLACED));
            assert!(first.colors == second.colors);
        }
    });
}

/// Results of commands that still run are neither waited for nor read.
#[test]
fn what_still_runs_is_not_read() {
    on_gpu(|gpu| {
        let world = World::new();
        let machine = Machine::new(gpu, &world);
        let options = Options::new(SIZE[0], SIZE[1]);
        let [early, late] = machine.asked_early(&PLACED, &pixels(), &options);
        assert!(is_not_done(early.err()));
        assert_eq!(late.unwrap().left_over, 0);
    });
}
