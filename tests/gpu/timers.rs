//! The time of each pass is attributed to that pass.

use glam::DVec3;
use gpc::render::SceneRequest;
use gpc::scene::{AlphaMode, Light, LightKind, Material};

use crate::stage::{Stage, camera, flat, on_gpu, once};

/// Number of lights, so large that shading takes far longer than the passes before and after it.
const LIGHTS: usize = 600;

#[test]
fn a_long_pass_is_long_and_its_neighbours_are_not() {
    let mut stage = Stage::new(vec![Material { unlit: false, ..flat([0.5; 4], AlphaMode::Opaque) }]);
    stage.add(0, [[-9.0, -9.0, -3.0], [9.0, -9.0, -3.0], [0.0, 9.0, -3.0]]);
    let (scene, mut pose) = stage.build();
    pose.lights = vec![
        Light {
            kind: LightKind::Directional,
            position: DVec3::ZERO,
            direction: DVec3::NEG_Z,
            color: [0.01; 3],
            range: None,
        };
        LIGHTS
    ];
    on_gpu(|gpu| {
        let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
        let mut frame = gpu.prepare(&prepared, &once([192, 128])).unwrap();
        // Drivers may compile shaders during the first frame.
        gpu.render(&mut frame, &camera()).unwrap();
        let passes = gpu.render(&mut frame, &camera()).unwrap().statistics.passes;
        if passes.is_empty() {
            return; // The device has no timestamps.
        }
        let of = |name| passes.iter().find(|time| time.pass == name).unwrap().ms;
        let longest = passes.iter().max_by(|a, b| a.ms.total_cmp(&b.ms)).unwrap();
        assert_eq!(longest.pass, "shade", "{passes:?}");
        for beside in ["spans", "attributes"] {
            assert!(of("shade") > 5.0 * of(beside), "{passes:?}");
        }
    });
}
