//! Casters of shadows, and surfaces without shadows.

use glam::DVec3;
use gpc::camera::SampleLocation;
use gpc::render::{RenderError, SceneRequest, Shadows};
use gpc::scene::{AlphaMode, Filter, Image, LightKind, Material, Sampler};

use super::{FLOOR, SIZE, ask, exact, floor, light, lit, location, pinhole, sun};
use crate::meshes::Random;
use crate::stage::{Stage, on_gpu, textured};

/// A MASK quadrilateral casts a shadow where it passes its alpha test; BLEND ones dim the light, and single-sided ones
/// also cast shadows when lit from behind.
#[test]
fn what_casts_shadows_is_what_stands_in_the_way() {
    on_gpu(|gpu| {
        let mask = AlphaMode::Mask { cutoff: 0.5 };
        let single = Material { double_sided: false, ..lit(AlphaMode::Opaque) };
        let mut stage = floor(vec![lit(AlphaMode::Opaque), single, textured(mask), lit(AlphaMode::Blend)]);
        stage.triangles.iter_mut().for_each(|t| t.material = 0);
        let texel = |i: u32| [255, 255, 255, 255 * (1 - (i + i / 4) as u8 % 2)];
        stage.texture = Some((
            Image { width: 4, height: 4, pixels: (0..16).flat_map(texel).collect() },
            Sampler { mag: Filter::Nearest, min: Filter::Nearest, mip: None, ..Sampler::default() },
        ));
        // The squares are at height 1, and light from straight above casts the shadows of their middles side by side.
        let square = |x: f32| [[x, 1.0, -4.0], [x + 1.0, 1.0, -4.0], [x + 1.0, 1.0, -5.0], [x, 1.0, -5.0]];
        let [a, b, c, d] = square(-2.5);
        // Single-sided triangles come first; their backs face the floor, and later the light.
        let mut order = Stage::new(stage.materials.clone());
        order.texture = stage.texture.clone();
        order.add_quad(1, [d, c, b, a]);
        order.triangles.append(&mut stage.triangles);
        order.add_quad(2, square(-0.5));
        order.add_quad(3, square(1.5));
        let uvs = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        order.triangles[4].uvs = [uvs[0], uvs[1], uvs[2]];
        order.triangles[5].uvs = [uvs[0], uvs[2], uvs[3]];
        let down = light(LightKind::Directional, DVec3::ZERO, DVec3::NEG_Y);
        let pinhole = pinhole(SIZE);
        let mut random = Random::new(8);
        let mut fraction = || random.below(1 << 20) as f64 / f64::from(1 << 20);
        let on_floor: Vec<DVec3> =
            (0..30_000).map(|_| DVec3::new(6.0 * fraction() - 3.0, FLOOR, -3.5 - 2.0 * fraction())).collect();
        let locations: Vec<SampleLocation> =
            on_floor.iter().map(|p| location(pinhole.project(*p).unwrap().to_array(), 0)).collect();
        let mut shadowed = [0; 3];
        for (p, seen) in on_floor.iter().zip(ask(gpu, &order, &[down], &locations)) {
            let of_square = |x: f64| [p.x - x, -4.0 - p.z];
            let is_in = |at: [f64; 2]| at.iter().all(|v| (0.0..1.0).contains(v));
            let (back, masked) = (of_square(-2.5), of_square(-0.5));
            let doubtful = |at: &[f64; 2]| at.iter().any(|v| (4.0 * v - (4.0 * v).round()).abs() < 1e-3);
            if [back, masked, of_square(1.5)].iter().any(doubtful) || !(3..=4).contains(&seen.id) {
                continue;
            }
            let texel = masked.map(|v| (4.0 * v).floor() as i64);
            let blended = is_in(of_square(1.5));
            let expected = blended || is_in(back) || is_in(masked) && (texel[0] + texel[1]) % 2 == 0;
            assert_eq!(seen.shadows, u32::from(expected), "{p}");
            shadowed[0] += u32::from(expected && is_in(back));
            shadowed[1] += u32::from(expected && is_in(masked));
            shadowed[2] += u32::from(blended);
        }
        assert!(shadowed.iter().all(|count| *count > 800), "{shadowed:?}");
    });
}

#[test]
fn what_can_not_be_shadowed_is_refused() {
    on_gpu(|gpu| {
        let stage = floor(vec![lit(AlphaMode::Opaque)]);
        let (scene, mut pose) = stage.build();
        let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
        let locations = [location([1.5, 2.5], 0)];
        let asked = gpu.sample_points(&prepared, &pinhole(SIZE), &locations, &exact().scene);
        assert!(matches!(asked, Err(RenderError::NoCasters)), "{asked:?}");
        let frame = gpu.prepare(&prepared, &exact()).map(|_| ());
        assert!(matches!(frame, Err(RenderError::NoCasters)), "{frame:?}");
        pose.lights = vec![sun(); 33];
        let request = SceneRequest::new(&scene, &pose).shadowed(Shadows::Exact);
        let many = gpu.upload(request).map(|_| ());
        assert!(matches!(many, Err(RenderError::ShadowLights { found: 33 })), "{many:?}");
        // With 32 lights, the last one has the highest bit.
        pose.lights.truncate(32);
        let request = SceneRequest::new(&scene, &pose).shadowed(Shadows::Exact);
        let prepared = gpu.upload(request).unwrap();
        let seen = gpu.sample_points(&prepared, &pinhole(SIZE), &locations, &exact().scene);
        assert_eq!(seen.unwrap().values[0].shadows, 0);
    });
}
