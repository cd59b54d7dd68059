//! Borders of triangles' shadows on a floor.

use glam::DVec2;
use gpc::scene::{AlphaMode, Light, LightKind};

use super::{OVER, SIZE, ask, cast, floor, lamp, lit, pinhole, places, spot, sun, within};
use crate::stage::on_gpu;

#[test]
fn edges_of_shadows_lie_where_light_casts_them() {
    on_gpu(|gpu| {
        let mut stage = floor(vec![lit(AlphaMode::Opaque)]);
        stage.add(0, OVER);
        let pinhole = pinhole(SIZE);
        for light in [sun(), lamp(LightKind::Point), lamp(spot(40.0)), lamp(spot(85.0))] {
            let corners = OVER.map(|corner| cast(&light, corner, &pinhole));
            let locations = places(corners);
            let (mut inside, mut close, mut tight) = (0, 0, 0);
            for (location, seen) in locations.iter().zip(ask(gpu, &stage, &[light], &locations)) {
                let place = DVec2::from_array(location.uv);
                let (expected, distance) = within(place, corners);
                if !(1..=2).contains(&seen.id) {
                    continue;
                }
                if distance < 1.0 / 1024.0 {
                    close += 1;
                    continue;
                }
                tight += u32::from(distance < 1.0 / 64.0);
                let found = seen.shadows;
                assert_eq!(found, u32::from(expected), "{distance} from an edge at {place}");
                inside += found;
            }
            assert!(inside > 3_000 && close > 1_000 && tight > 3_000, "{inside} {close} {tight}");
        }
    });
}

/// Places outside of a light's cone or range are not tested, and count as lit.
#[test]
fn light_that_does_not_reach_casts_no_shadow() {
    on_gpu(|gpu| {
        let mut stage = floor(vec![lit(AlphaMode::Opaque)]);
        stage.add(0, OVER);
        let wide = lamp(spot(40.0));
        let corners = OVER.map(|corner| cast(&wide, corner, &pinhole(SIZE)));
        let narrow = lamp(spot(15.0));
        let short = Light { range: Some(1.0), ..wide };
        let locations = places(corners);
        let seen = ask(gpu, &stage, &[wide, narrow, short], &locations);
        let count = |bit: u32| seen.iter().filter(|seen| seen.shadows >> bit & 1 != 0).count();
        let [all, some, none] = [0, 1, 2].map(count);
        assert!(some > 1_000 && some < all - 1_000 && none == 0, "{all} {some} {none}");
    });
}
