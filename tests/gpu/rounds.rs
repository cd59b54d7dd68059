//! Rounds of a device with plenty of memory and of one without. One of them is simulated.

use gpc::render::{Headless, PassTime, Rendered, SceneFrame, SceneRequest, Settings, Shadows, SuperpixelOptions};

use crate::devices::within;
use crate::scenes::{ball_over_checker, distant_lamp, layered};
use crate::stage::{Stage, as_gpu, camera, on_cpu, on_gpu};

fn settings(samples: u32) -> Settings {
    Settings::new(160, 96).method(SuperpixelOptions::new(samples))
}

/// Prepares a frame of a stage in the light of a distant lamp.
fn prepare(gpu: &mut Headless, stage: &Stage, settings: &Settings) -> SceneFrame {
    let (scene, mut pose) = stage.build();
    pose.lights = vec![distant_lamp()];
    let request = SceneRequest::new(&scene, &pose).shadowed(settings.scene.shadows);
    let prepared = gpu.upload(request).unwrap();
    gpu.prepare(&prepared, settings).unwrap()
}

/// An image of a stage in the light of a distant lamp.
pub fn render(gpu: &mut Headless, stage: &Stage, settings: &Settings) -> Rendered {
    let mut frame = prepare(gpu, stage, settings);
    gpu.render(&mut frame, &camera()).unwrap()
}

/// Images of both divisions.
fn both(stage: &Stage, settings: &Settings) -> [Rendered; 2] {
    let [mut small, mut large] = [None, None];
    on_cpu(|gpu| small = Some(render(gpu, stage, settings)));
    within(as_gpu, |gpu| large = Some(render(gpu, stage, settings)));
    [small, large].map(Option::unwrap)
}

#[test]
fn large_rounds_make_the_same_image() {
    for (stage, settings) in [
        (layered(), settings(16)),
        (layered(), settings(256)),
        (ball_over_checker(), settings(64).shadows(Shadows::Exact)),
    ] {
        let [small, large] = both(&stage, &settings);
        assert!(small.statistics.superpixels > 100);
        assert!(small.colors == large.colors);
    }
}

/// With little memory, a frame needs many rounds, of which the first recording has too few.
#[test]
fn a_frame_that_needs_more_rounds_is_recorded_again() {
    let stage = layered();
    let mut settings = settings(1024);
    settings.scene.max_memory = Some(24 << 20);
    let [small, large] = both(&stage, &settings);
    assert!(large.statistics.rounds > 8, "{}", large.statistics.rounds);
    assert!(small.colors == large.colors);
}

/// Each pass of all rounds has its own time, however many there are, and the image does not change.
#[test]
fn the_passes_of_all_rounds_are_timed() {
    let stage = layered();
    let mut together = settings(1024);
    together.scene.max_memory = Some(24 << 20);
    let one_by_one = together.clone().time_rounds(true);
    on_gpu(|gpu| {
        let [together, one_by_one] = [together, one_by_one].map(|settings| render(gpu, &stage, &settings));
        assert!(together.colors == one_by_one.colors);
        assert!(together.statistics.rounds > 8);
        let passes = [&together, &one_by_one].map(|image| &image.statistics.passes);
        if passes[0].is_empty() {
            return; // The device has no timestamps.
        }
        let names = |passes: &[PassTime]| passes.iter().map(|time| time.pass).collect::<Vec<_>>();
        let mut timed = names(passes[0]);
        assert!(timed.contains(&PassTime::ROUNDS), "{passes:?}");
        timed.retain(|name| *name != PassTime::ROUNDS);
        assert_eq!(timed, names(passes[1]));
    });
}

/// The commands of a frame do not depend on what it shows, so that a small frame stands for a large one.
#[test]
fn a_frame_takes_few_commands() {
    let stage = layered();
    let count = |gpu: &mut Headless, settings: &Settings| {
        let mut frame = prepare(gpu, &stage, settings);
        let recorded = gpu.passes(&mut frame, &camera()).unwrap();
        assert!(recorded.barriers <= recorded.dispatches + 30);
        recorded.dispatches
    };
    let shadowed = settings(64).shadows(Shadows::Exact);
    within(as_gpu, |gpu| {
        let dispatches = [&settings(64), &shadowed].map(|settings| count(gpu, settings));
        assert!(dispatches[0] <= 120, "{dispatches:?}");
        assert!(dispatches[1] <= 400, "{dispatches:?}");
    });
    on_cpu(|gpu| assert!(count(gpu, &settings(64)) > 120));
}
