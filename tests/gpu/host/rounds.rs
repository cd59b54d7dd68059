//! Rounds of a recording: as many as an image needs, or a limited number. Rounds are small here, as on a CPU, so that there are
//! many.

use super::machine::{Base, Machine, Seen};
use super::world::{PLACED, SIZE, World};
use crate::devices::within;
use crate::stage::{as_cpu, on_cpu};
use gpc::host::Options;
use gpc::render::{Detection, Headless, Shading};
use gpc::vulkan::Limits;

fn bits(colors: &[[f32; 4]]) -> Vec<[u32; 4]> {
    let pixels = colors.iter();
    pixels.map(|color| color.map(f32::to_bits)).collect()
}

/// Options with which all pixels are superpixels, with room for a visibility sample for each sample.
fn options(size: [u32; 2]) -> Options {
    Options::new(size[0], size[1]).detection(Detection::Every)
}

/// A device with small rounds that can't skip commands.
fn without_conditional_rendering(limits: &mut Limits) {
    as_cpu(limits);
    limits.conditional_rendering = false;
}

fn finishes_in_little_memory(gpu: &mut Headless) {
    let world = World::new();
    let machine = Machine::new(gpu, &world);
    let lent = world.lent(&PLACED);
    let size = [256, 192];
    let see = |max_memory| {
        let options = options(size).shading(Shading::Sample).max_memory(max_memory);
        machine.see_lent(&PLACED, &lent, Base::Nothing, options)
    };
    let roomy = see(None);
    let bytes = roomy.outcome.statistics.memory_bytes;
    let tight = see(Some(bytes / 6));
    let [few, many] = [&roomy, &tight].map(|seen| seen.outcome.statistics.rounds);
    eprintln!("{few} {many} {bytes} {}", tight.outcome.statistics.memory_bytes);
    assert!(few < 5 && many > 20, "{few} and {many} rounds");
    for seen in [&roomy, &tight] {
        assert_eq!(seen.outcome.left_over, 0);
    }
    assert!(bits(&roomy.colors) == bits(&tight.colors));
}

/// Work that does not fit into a round is done in a later round of the same recording, with the same bytes.
#[test]
fn a_recording_finishes_its_frame() {
    on_cpu(finishes_in_little_memory);
}

#[test]
fn a_recording_finishes_its_frame_without_conditional_rendering() {
    within(without_conditional_rendering, finishes_in_little_memory);
}

fn keeps_what_bounded_rounds_leave(gpu: &mut Headless) {
    let world = World::new();
    let (machine, drawn) = (Machine::new(gpu, &world), world.drawn());
    let lent = world.lent(&PLACED);
    let see = |max_rounds| {
        let options = options(SIZE).samples(1024).shading(Shading::Sample).max_rounds(max_rounds);
        machine.see_lent(&PLACED, &lent, Base::All(&drawn), options)
    };
    let whole = see(None);
    assert_eq!(whole.outcome.left_over, 0);
    let rounds = whole.outcome.statistics.rounds;
    assert!(rounds > 5, "{rounds}");
    let part = |seen: &Seen| {
        let pixels = seen.colors.iter().zip(whole.colors.iter().zip(&drawn.colors));
        let [mut kept, mut sampled] = [0, 0];
        for (found, (whole, drawn)) in pixels {
            assert!(found == whole || found == drawn);
            kept += u64::from(found == drawn);
            sampled += u64::from(found == whole);
        }
        (kept, sampled)
    };
    for bound in [1, 3] {
        let bounded = see(Some(bound));
        assert_eq!(bounded.outcome.statistics.rounds, u64::from(bound));
        let left = bounded.outcome.left_over;
        let tiles = u64::from(SIZE[0] / 8 * (SIZE[1] / 4));
        assert!(left > tiles / 4 && left < tiles, "{left}");
        // Samples of a flat surface give the colour that was drawn.
        let (kept, sampled) = part(&bounded);
        assert!(kept >= 32 * left, "{kept} of {left} tiles");
        assert!(sampled >= 32 * (tiles - left), "{sampled}");
        assert!(bits(&bounded.colors) != bits(&whole.colors));
    }
    // A limit above the needed number changes nothing.
    assert!(bits(&see(Some(1000)).colors) == bits(&whole.colors));
}

#[test]
fn bounded_rounds_leave_pixels_as_they_were_drawn() {
    on_cpu(keeps_what_bounded_rounds_leave);
}

#[test]
fn bounded_rounds_leave_pixels_as_they_were_drawn_without_conditional_rendering() {
    within(without_conditional_rendering, keeps_what_bounded_rounds_leave);
}

/// A host that skips its shading in idle rounds gets the same picture as a host that does not. Dispatches in idle
/// rounds have no workgroups.
fn dispatches_nothing_in_vain(gpu: &mut Headless) {
    let world = World::new();
    let mut machine = Machine::new(gpu, &world);
    let lent = world.lent(&PLACED);
    let [skipping, calling] = [true, false].map(|skips| {
        machine.skips = skips;
        let options = Options::new(SIZE[0], SIZE[1]);
        let seen = machine.see_lent(&PLACED, &lent, Base::Nothing, options);
        let called = seen.dispatched.iter().filter(|groups| **groups > 0).count() as u64;
        // One call shades the centres.
        assert_eq!(called, 1 + seen.outcome.statistics.rounds);
        assert!(seen.dispatched.len() as u64 > 2 * called, "{:?}", seen.dispatched);
        bits(&seen.colors)
    });
    assert!(skipping == calling);
}

#[test]
fn idle_rounds_shade_nothing() {
    on_cpu(dispatches_nothing_in_vain);
}

#[test]
fn idle_rounds_shade_nothing_without_conditional_rendering() {
    within(without_conditional_rendering, dispatches_nothing_in_vain);
}
