//! How bright points are that lights do not reach.

use gpc::scene::{AlphaMode, Light, LightKind};

use super::{OVER, SIZE, ask, cast, floor, lamp, lit, pinhole, places, sun, upload};
use crate::stage::{on_gpu, once};

/// Each light has shadows of its own, and a point is as bright as the lights make it that it does not lie in the shadow of.
#[test]
fn shading_leaves_out_the_lights_that_are_hidden() {
    on_gpu(|gpu| {
        let mut stage = floor(vec![lit(AlphaMode::Opaque)]);
        stage.add(0, OVER);
        let lights = [sun(), lamp(LightKind::Point)];
        let corners = OVER.map(|corner| cast(&lights[0], corner, &pinhole(SIZE)));
        let locations = places(corners);
        let both = ask(gpu, &stage, &lights, &locations);
        let dark = |light: &Light| Light {
            color: [0.0; 3],
            ..*light
        };
        let mut found = [0; 4];
        for hidden in 0..4_u32 {
            let mut shining = lights;
            for (bit, light) in shining.iter_mut().enumerate() {
                if hidden >> bit & 1 != 0 {
                    *light = dark(light);
                }
            }
            let prepared = upload(gpu, &stage, &shining);
            let open = gpu
                .sample_points(&prepared, &pinhole(SIZE), &locations, &once(SIZE))
                .unwrap();
            for (seen, expected) in both.iter().zip(&open.values) {
                assert_eq!(expected.shadows, 0);
                if seen.id != 0 && seen.shadows == hidden {
                    found[hidden as usize] += 1;
                    assert_eq!(seen.color, expected.color);
                }
            }
        }
        assert!(found.iter().all(|count| *count > 500), "{found:?}");
    });
}
