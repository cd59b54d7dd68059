//! Stopping between submissions.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use gpc::render::{Headless, HeadlessOptions, Method, RenderError, Settings};

use crate::locations::{pinhole, planar};
use crate::scenes::ball_over_checker;
use crate::stage::camera;

const SIZE: [u32; 2] = [96, 64];

fn headless() -> Headless {
    let options = HeadlessOptions::default().validation(true);
    Headless::new(&options).unwrap()
}

#[test]
fn what_is_unwanted_is_not_begun_and_the_device_goes_on() {
    let mut gpu = headless();
    let prepared = ball_over_checker().upload(&mut gpu);
    let mut frame = gpu.prepare(&prepared, &Settings::new(96, 64)).unwrap();
    let image = gpu.render(&mut frame, &camera()).unwrap();
    let is_unwanted = Arc::new(AtomicBool::new(true));
    let asked = is_unwanted.clone();
    gpu.stop_when(move || asked.load(Ordering::Relaxed));
    let stopped = gpu.render(&mut frame, &camera());
    assert!(matches!(stopped, Err(RenderError::Stopped)));
    is_unwanted.store(false, Ordering::Relaxed);
    assert_eq!(gpu.render(&mut frame, &camera()).unwrap().colors, image.colors);
    assert_eq!(gpu.validation_messages(), Vec::<String>::new());
}

#[test]
fn locations_are_stopped_between_runs_that_see_the_same() {
    let mut gpu = headless();
    let prepared = ball_over_checker().upload(&mut gpu);
    let locations = planar(SIZE);
    let settings = Settings::new(96, 64).method(Method::Ssaa { samples: 1024 });
    let rig = [(pinhole(SIZE), locations)];
    let whole = gpu.render_locations(&prepared, &rig, &settings).unwrap();
    // The function counts submissions, and stops before the first one that is not allowed.
    let left = Arc::new(AtomicUsize::new(usize::MAX));
    let counted = left.clone();
    gpu.stop_when(move || counted.fetch_sub(1, Ordering::Relaxed) == 0);
    let runs = gpu.render_locations(&prepared, &rig, &settings).unwrap();
    assert_eq!(whole.colors, runs.colors);
    let submissions = usize::MAX - left.load(Ordering::Relaxed);
    assert!(submissions > 3, "{submissions}");
    left.store(submissions - 1, Ordering::Relaxed);
    let stopped = gpu.render_locations(&prepared, &rig, &settings);
    assert!(matches!(stopped, Err(RenderError::Stopped)));
    assert_eq!(gpu.validation_messages(), Vec::<String>::new());
}
