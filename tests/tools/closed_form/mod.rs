//! Textures for which every pixel is known: a plane to the horizon, integrated over each pixel by quadrature in f64.
//!
//! The expected image is independent of the renderer: of its mipmaps, its choice of levels and its samples. All values
//! are in linear light. `cargo test --release --test tools closed_form -- --nocapture` prints the errors.

mod plane;
mod texture;

use gpc::render::{Footprint, Headless, HeadlessOptions, MethodKind};
use gpc::scene::{Filter, Sampler, TextureTransform, Wrap};
use plane::{Plane, reference, render, rmse, settings};
use std::sync::LazyLock;
use texture::Texture;

/// Largest error of the reference image: root mean squared difference from the integral, for values of 0 to 1.
const TRUTH: f64 = 0.004;
/// Largest error without the row of pixels just below the horizon, where a pixel sees the plane up to infinity, and a
/// texture is read with the same sharpness across as along.
const TRUTH_BELOW: f64 = 0.002;
/// Numbers of samples, and the largest allowed ratio of superpixel error / supersampling error at each.
const BESIDE_SSAA: [(u32, f64); 2] = [(64, 1.5), (256, 1.25)];

fn headless() -> Headless {
    Headless::new(&HeadlessOptions::default()).unwrap()
}

/// A plane with its name, and the image that is expected of it.
struct Case {
    name: &'static str,
    plane: Plane,
    expected: Vec<f64>,
}

impl Case {
    fn new((name, plane): (&'static str, Plane)) -> Self {
        let expected = plane.expected();
        Self { name, plane, expected }
    }
}

/// Planes with squares, and with waves along, across and diagonal. Two tests use them.
static PATTERNS: LazyLock<[Case; 4]> = LazyLock::new(|| {
    let grating = |waves| Plane::new(Texture::grating(Sampler::default(), waves));
    let checker = Plane::new(Texture::checker(Sampler::default(), 8));
    [
        ("checker", checker),
        ("waves along", grating([4, 0])),
        ("waves across", grating([0, 4])),
        ("waves aslant", grating([3, 5])),
    ]
    .map(Case::new)
});

/// Planes with a mosaic under all sampler modes and transforms of coordinates.
fn modes() -> [Case; 8] {
    use Filter::{Linear, Nearest};
    use Wrap::{ClampToEdge, MirroredRepeat, Repeat};
    let sampler = |mag, min, mip, wrap_u| Sampler { mag, min, mip, wrap_u, wrap_v: Repeat };
    let turned = |degrees: f32, scale: [f32; 2]| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        TextureTransform([[cos * scale[0], sin * scale[1], 0.3], [-sin * scale[0], cos * scale[1], -0.2]])
    };
    let plain = turned(0.0, [1.0; 2]);
    let trilinear = Sampler::default();
    let nearest = sampler(Nearest, Nearest, None, Repeat);
    let stepped = sampler(Nearest, Linear, Some(Nearest), Repeat);
    let unmipped = sampler(Linear, Linear, None, MirroredRepeat);
    let mirrored = sampler(Linear, Linear, Some(Linear), MirroredRepeat);
    let clamped = sampler(Linear, Nearest, Some(Nearest), ClampToEdge);
    [
        ("turned", trilinear, turned(30.0, [1.0; 2])),
        ("scaled", trilinear, turned(0.0, [2.0, 0.5])),
        ("turned and scaled", trilinear, turned(-50.0, [0.5, 1.5])),
        ("nearest", nearest, plain),
        ("nearest, mipmapped", stepped, turned(20.0, [1.0; 2])),
        ("without mipmaps", unmipped, plain),
        ("mirrored", mirrored, turned(10.0, [1.0; 2])),
        ("clamped", clamped, plain),
    ]
    .map(|(name, sampler, transform)| {
        let plane = Plane::new(Texture::mosaic(sampler));
        Case::new((name, Plane { transform, ..plane }))
    })
}

/// Asserts that the reference equals the integral, and that the errors of superpixels and supersampling have the
/// allowed ratio.
fn check(headless: &mut Headless, case: &Case) {
    let Case { name, plane, expected } = case;
    let scene = plane.upload(headless);
    let truth = reference(headless, &scene, Footprint::Sample);
    let [whole, below] = [0, 1].map(|rows| rmse(&truth, expected, rows));
    println!("{name}: truth {whole:.5}, below the horizon's row {below:.5}");
    assert!(whole < TRUTH && below < TRUTH_BELOW, "{name}: {whole} {below}");
    for (samples, most) in BESIDE_SSAA {
        let [superpixel, ssaa] = [MethodKind::Superpixel, MethodKind::Ssaa].map(|method| {
            let image = render(headless, &scene, &settings(method, samples));
            rmse(&image, expected, 0)
        });
        let ratio = superpixel / ssaa;
        println!("  {samples} samples: superpixel {superpixel:.5}, ssaa {ssaa:.5}, {ratio:.2}");
        assert!(ratio < most, "{name}, {samples} samples: {ratio}");
    }
}

#[test]
fn patterns_come_to_their_integrals() {
    let mut headless = headless();
    for case in &*PATTERNS {
        check(&mut headless, case);
    }
}

#[test]
fn every_sampler_mode_and_transform_comes_to_its_integral() {
    let mut headless = headless();
    for case in modes() {
        check(&mut headless, &case);
    }
}

/// Supersampling that reads textures over a whole pixel gives another image.
#[test]
fn textures_read_for_pixels_miss_the_integral() {
    let mut headless = headless();
    for case in &*PATTERNS {
        let scene = case.plane.upload(&mut headless);
        let blurred = reference(&mut headless, &scene, Footprint::Pixel);
        let error = rmse(&blurred, &case.expected, 0);
        assert!(error > 5.0 * TRUTH, "{}: {error}", case.name);
    }
}
