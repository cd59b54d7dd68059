//! The time of each pass is attributed to that pass.

use gpc::render::{MethodKind, SceneRequest, Settings};
use gpc::scene::AlphaMode;

use crate::stage::{Stage, camera, flat, on_gpu};

/// Timed parts come in the order in which the passes of their names are recorded.
#[test]
fn passes_are_timed_in_the_order_in_which_they_run() {
    let mut stage = Stage::new(vec![flat([0.5; 4], AlphaMode::Opaque)]);
    stage.add(0, [[-9.0, -9.0, -3.0], [9.0, -9.0, -3.0], [0.0, 9.0, -3.0]]);
    let (scene, pose) = stage.build();
    let settings = Settings::new(64, 48).method(MethodKind::Superpixel.with_samples(16));
    on_gpu(|gpu| {
        let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
        let mut frame = gpu.prepare(&prepared, &settings).unwrap();
        let recorded = gpu.passes(&mut frame, &camera()).unwrap().passes;
        let timed = gpu.render(&mut frame, &camera()).unwrap().statistics.passes;
        if timed.is_empty() {
            return; // The device has no timestamps.
        }
        let mut recorded: Vec<_> = recorded.iter().map(|pass| pass.name).collect();
        recorded.retain(|name| timed.iter().any(|time| time.pass == *name));
        let mut seen = std::collections::HashSet::new();
        recorded.retain(|name| seen.insert(*name));
        let mut timed: Vec<_> = timed.iter().map(|time| time.pass).collect();
        timed.retain(|name| seen.contains(name));
        assert!(timed.len() > 8, "{timed:?}");
        assert_eq!(timed, recorded);
    });
}
