//! Brightness of points that some lights do not reach.

use glam::DVec2;
use gpc::camera::SampleLocation;
use gpc::render::{Headless, PointSample};
use gpc::scene::{AlphaMode, Light, LightKind, Material};

use super::{OVER, SIZE, ask, cast, floor, lamp, lit, pinhole, places, sun, upload, within};
use crate::stage::{Stage, on_gpu, once_each};

/// Each light has its own shadows, and a point is lit by exactly the lights in whose shadow it does not lie.
#[test]
fn shading_leaves_out_the_lights_that_are_hidden() {
    on_gpu(|gpu| {
        let mut stage = floor(vec![lit(AlphaMode::Opaque)]);
        stage.add(0, OVER);
        let lights = [sun(), lamp(LightKind::Point)];
        let corners = OVER.map(|corner| cast(&lights[0], corner, &pinhole(SIZE)));
        let locations = places(corners);
        let both = ask(gpu, &stage, &lights, &locations);
        let dark = |light: &Light| Light { color: [0.0; 3], ..*light };
        let mut found = [0; 4];
        for hidden in 0..4_u32 {
            let mut shining = lights;
            for (bit, light) in shining.iter_mut().enumerate() {
                if hidden >> bit & 1 != 0 {
                    *light = dark(light);
                }
            }
            let prepared = upload(gpu, &stage, &shining);
            let open = gpu.sample_points(&prepared, &pinhole(SIZE), &locations, &once_each()).unwrap();
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

/// BLEND triangles reduce the light by their opacities, one after the other, unless they lie behind the receiver.
#[test]
fn blend_lets_pass_what_its_opacity_leaves() {
    on_gpu(|gpu| {
        let blend = |opacity: f32| Material { base_color: [1.0, 1.0, 1.0, opacity], ..lit(AlphaMode::Blend) };
        let mut stage = floor(vec![lit(AlphaMode::Opaque), blend(0.25), blend(0.6)]);
        // Both triangles block the first light; for the second light one lies behind the floor.
        let above = |height: f32| OVER.map(|[x, y, z]| [x + 0.2 * height, y + height, z]);
        stage.add(1, OVER);
        stage.add(2, above(0.3));
        stage.add(2, above(-4.0));
        let lights = [sun(), lamp(LightKind::Point)];
        let shades = [OVER, above(0.3)];
        let cast_by =
            |light: usize| shades.map(|corners| corners.map(|corner| cast(&lights[light], corner, &pinhole(SIZE))));
        let locations = places(cast_by(0)[0]);
        let seen = ask(gpu, &stage, &lights, &locations);
        // This is the contribution of each light on its own, without casters.
        let dark = |light: &Light| Light { color: [0.0; 3], ..*light };
        let open = |gpu: &mut Headless, shining: [Light; 2]| {
            let prepared = upload(gpu, &stage, &shining);
            let seen = gpu.sample_points(&prepared, &pinhole(SIZE), &locations, &once_each());
            seen.unwrap().values
        };
        let none = open(gpu, [dark(&lights[0]), dark(&lights[1])]);
        let first = open(gpu, [lights[0], dark(&lights[1])]);
        let second = open(gpu, [dark(&lights[0]), lights[1]]);
        let mut found = [0; 4];
        for (i, location) in locations.iter().enumerate() {
            let seen = &seen[i];
            if !(1..=2).contains(&seen.id) || seen.blend_id != 0 {
                continue;
            }
            let place = DVec2::from_array(location.uv);
            let in_shades = [0, 1].map(|light| cast_by(light).map(|corners| within(place, corners)));
            if in_shades.iter().flatten().any(|(_, distance)| *distance < 0.01) {
                continue;
            }
            let share = |light: usize| {
                let [a, b] = in_shades[light].map(|(inside, _)| inside);
                f64::from(if a { 0.75_f32 } else { 1.0 } * if b { 0.4 } else { 1.0 })
            };
            let green = |of: &[PointSample]| f64::from(of[i].color[1]);
            let ambient = green(&none);
            let expected = ambient + (green(&first) - ambient) * share(0) + (green(&second) - ambient) * share(1);
            let got = f64::from(seen.color[1]);
            assert!((got - expected).abs() < 1e-4 * expected.max(1.0), "{got} {expected} at {place}");
            let bits = [0, 1].map(|light| u32::from(share(light) < 1.0) << light);
            assert_eq!(seen.shadows, bits[0] | bits[1]);
            found[usize::from(in_shades[0][0].0) + 2 * usize::from(in_shades[0][1].0)] += 1;
        }
        assert!(found.iter().all(|count| *count > 300), "{found:?}");
    });
}

/// A translucent layer lies in the same shadows as an opaque surface in its place, whatever its opacity; so does the
/// surface behind it.
#[test]
fn blend_receives_shadows() {
    on_gpu(|gpu| {
        let lights = [sun(), lamp(LightKind::Point)];
        let shades = lights.map(|light| OVER.map(|corner| cast(&light, corner, &pinhole(SIZE))));
        let is_clear = |place: &SampleLocation| {
            let distances = shades.map(|shade| within(DVec2::from_array(place.uv), shade).1);
            distances.into_iter().all(|distance| distance > 0.01)
        };
        let locations: Vec<_> = places(shades[0]).into_iter().filter(is_clear).collect();
        let seen = |gpu: &mut Headless, material: Material| {
            let mut stage = Stage::new(vec![lit(AlphaMode::Opaque), material]);
            stage.add(0, OVER);
            stage.triangles.append(&mut floor(Vec::new()).triangles);
            let on_floor = stage.triangles.iter_mut().skip(1);
            on_floor.for_each(|triangle| triangle.material = 1);
            ask(gpu, &stage, &lights, &locations)
        };
        let opaque = seen(gpu, lit(AlphaMode::Opaque));
        for opacity in [1.0, 0.4] {
            let layer = Material { base_color: [0.7, 0.7, 0.7, opacity], ..lit(AlphaMode::Blend) };
            let mut found = [0; 4];
            for (expected, layer) in opaque.iter().zip(seen(gpu, layer)) {
                if !(2..=3).contains(&expected.id) {
                    continue;
                }
                assert_eq!([layer.id, layer.blend_id], [0, expected.id]);
                for (got, expected) in layer.color.into_iter().zip(expected.color) {
                    assert!((got - opacity * expected).abs() < 1e-5, "{layer:?} {expected}");
                }
                found[expected.shadows as usize] += 1;
            }
            assert!(found.iter().all(|count| *count > 300), "{found:?}");
        }
    });
}
