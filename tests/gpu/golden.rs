//! Two golden images, and a test of the comparison itself.

use gpc::color::srgb::encode_u8;
use gpc::render::{Method, Rendered, Settings};
use image::RgbaImage;

use crate::goldens::{compare, folder};
use crate::scenes::ball_over_checker;
use crate::stage::on_gpu;

const SIZE: [u32; 2] = [96, 64];

/// The displayed image, with straight alpha.
fn displayed(rendered: &Rendered) -> RgbaImage {
    RgbaImage::from_fn(SIZE[0], SIZE[1], |x, y| {
        let [r, g, b, a] = rendered.colors[(y * SIZE[0] + x) as usize].map(f64::from);
        let straight = [r, g, b].map(|v| encode_u8(v / a.max(1e-6)));
        let [r, g, b] = straight;
        image::Rgba([r, g, b, (a * 255.0).round() as u8])
    })
}

#[test]
fn images_are_the_goldens() {
    on_gpu(|gpu| {
        let stage = ball_over_checker();
        let none = Settings::new(SIZE[0], SIZE[1]).background(Some([0.2, 0.4, 0.8])).method(Method::None);
        let superpixels = Settings::new(SIZE[0], SIZE[1]);
        let results = [("none", none), ("superpixels", superpixels)].map(|(name, settings)| {
            let image = displayed(&stage.render(gpu, &settings));
            compare(&folder(), name, &image)
        });
        assert_eq!(results, [Ok(()), Ok(())]);
    });
}

#[test]
fn the_comparison_can_fail() {
    let golden = image::open(folder().join("superpixels.png")).unwrap().to_rgba8();
    let check = |image: &RgbaImage| compare(&folder(), "superpixels", image);
    check(&golden).unwrap();

    // A small difference everywhere, or a large one in ten pixels, is accepted.
    let mut close = golden.clone();
    for pixel in close.pixels_mut() {
        pixel.0 = pixel.0.map(|v| v.saturating_add(3));
    }
    check(&close).unwrap();
    let corrupted = |count: u32| {
        let mut image = golden.clone();
        for place in 0..count {
            let channel = &mut image.get_pixel_mut(5 * place, 3 * place).0[place as usize % 4];
            *channel = channel.wrapping_add(128);
        }
        image
    };
    check(&corrupted(10)).unwrap();
    assert!(check(&corrupted(11)).unwrap_err().contains("11 pixels"));

    let smaller = image::imageops::crop_imm(&golden, 0, 0, 95, 64).to_image();
    assert!(check(&smaller).is_err());
    assert!(compare(&folder(), "missing", &golden).is_err());
    assert!(!folder().join("missing.png").exists());
}
