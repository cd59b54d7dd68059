//! Images that the device encodes, compared with the encoding of image files.

use gpc::color::srgb;
use gpc::render::{Headless, Method, PixelRect, RenderError, Rendered, Settings};
use gpc::scene::AlphaMode;
use gpc::testing::Random;

use crate::scenes::{ball_over_checker, layered};
use crate::stage::{Stage, camera, flat, on_gpu};

/// Codes of a colour, as image files have them.
fn codes([r, g, b, a]: [f32; 4]) -> [u8; 4] {
    let alpha = (f64::from(a).clamp(0.0, 1.0) * 255.0).round() as u8;
    let color = |channel: f32| match alpha {
        0 => 0,
        _ => srgb::encode_u8(f64::from(channel) / f64::from(a)),
    };
    [color(r), color(g), color(b), alpha]
}

/// The image of a stage in linear light, and in codes.
fn both(gpu: &mut Headless, stage: &Stage, settings: &Settings) -> (Rendered, Rendered<[u8; 4]>) {
    let prepared = stage.upload(gpu);
    let mut frame = gpu.prepare(&prepared, settings).unwrap();
    let light = gpu.render(&mut frame, &camera()).unwrap();
    let mut frame = gpu.prepare_pixels::<[u8; 4]>(&prepared, settings).unwrap();
    let encoded = gpu.render_pixels(&mut frame, &camera()).unwrap();
    (light, encoded)
}

/// Squares of many colours, of which some are near the thresholds of codes.
fn colorful() -> Stage {
    const SQUARES: u16 = 64;
    let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
    let mut random = Random::new(5);
    let mut share = || random.below(1 << 24) as f32 * 2.0_f32.powi(-24);
    for (row, column) in (0..SQUARES).flat_map(|row| (0..SQUARES).map(move |column| (row, column))) {
        let place = |index: u16| 4.0 * f32::from(index) / f32::from(SQUARES) - 2.0;
        let [left, right, low, high] = [place(column), place(column + 1), place(row), place(row + 1)];
        stage.add_quad(0, [[left, low, -2.0], [right, low, -2.0], [right, high, -2.0], [left, high, -2.0]]);
        let color = [share(), share(), share(), 1.0];
        stage.triangles.iter_mut().rev().take(2).for_each(|triangle| triangle.color = color);
    }
    stage
}

#[test]
fn images_have_the_codes_of_image_files() {
    let settings = Settings::new(150, 70);
    let region = PixelRect { corner: [33, 17], size: [61, 40] };
    on_gpu(|gpu| {
        for stage in [layered(), ball_over_checker(), colorful()] {
            for settings in [
                settings.clone(),
                settings.clone().background(Some([0.2, 0.4, 0.8])),
                settings.clone().region(Some(region)).attributes(true),
                settings.clone().method(Method::Ssaa { samples: 16 }),
                settings.clone().method(Method::None),
            ] {
                let (light, encoded) = both(gpu, &stage, &settings);
                let expected: Vec<_> = light.colors.into_iter().map(codes).collect();
                assert!(encoded.colors == expected, "{settings:?}");
                assert!(encoded.attributes == light.attributes);
                assert_eq!(encoded.size, light.size);
            }
        }
    });
}

#[test]
fn pixels_of_another_type_are_refused() {
    on_gpu(|gpu| {
        let prepared = layered().upload(gpu);
        let settings = Settings::new(32, 32);
        let mut frame = gpu.prepare_pixels::<[u8; 4]>(&prepared, &settings).unwrap();
        let refused = gpu.render(&mut frame, &camera()).err();
        assert!(matches!(refused, Some(RenderError::OtherPixels { .. })), "{refused:?}");
    });
}
