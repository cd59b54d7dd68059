//! The reference of a textured scene, and the causes of errors against it.

use crate::difference::rmse;
use crate::measurement::stress::stage::{Stage, camera, flat, seen_at};
use crate::measurement::{PixelTriangles, Stripped, Within, Yardstick, brute_force};
use crate::textured::textured;
use gpc::output::{DecodedImage, Picture};
use gpc::render::{
    Detection, Footprint, Headless, HeadlessOptions, MethodKind, PreparedScene, SceneRequest, Settings, Shading,
};
use gpc::sampling::Pattern;
use gpc::scene::{AlphaMode, Image, Material, Pose, Sampler, Scene};
use gpc::testing::Random;

const SIZE: [u32; 2] = [48; 2];

/// A quadrilateral larger than the image, with a texture of noise whose texels are two thirds of a pixel.
fn noisy(material: Material) -> (Scene, Pose) {
    let [side, _] = SIZE;
    let mut random = Random::new(7);
    let mut stage = Stage::new(vec![material]);
    stage.texture = Some((
        Image { width: side, height: side, pixels: (0..side * side * 4).map(|_| random.below(256) as u8).collect() },
        Sampler::default(),
    ));
    let half = f64::from(side);
    let corners = [[-half, -half], [-half, half], [half, half], [half, -half]];
    stage.add_quad(0, corners.map(|place| seen_at(place, 1.0, side)));
    for triangle in &mut stage.triangles {
        triangle.uvs = triangle.corners.map(|[x, y, _]| [0.75 * x, 0.75 * y]);
    }
    let (scene, mut pose) = stage.build();
    let vertices = pose.geometry.positions.len();
    pose.geometry.streams.tangents = vec![[1.0, 0.0, 0.0, 1.0]; vertices];
    (scene, pose)
}

fn headless() -> Headless {
    Headless::new(&HeadlessOptions::default()).unwrap()
}

fn settings(method: MethodKind, samples: u32, footprint: Footprint) -> Settings {
    Settings::new(SIZE[0], SIZE[1]).footprint(footprint).background(Some([0.8; 3])).method(method.with_samples(samples))
}

fn render(headless: &mut Headless, scene: &PreparedScene, settings: &Settings) -> Vec<[f32; 4]> {
    let mut frame = headless.prepare(scene, settings).unwrap();
    headless.render(&mut frame, &camera()).unwrap().colors
}

fn reference(headless: &mut Headless, scene: &PreparedScene, footprint: Footprint) -> Vec<[f32; 4]> {
    let settings = settings(MethodKind::None, 1, footprint);
    brute_force(headless, scene, &camera(), &settings, 1024, || {}).unwrap()
}

/// Textures read over smaller and smaller samples converge to the reference; those read over whole pixels converge to
/// another image.
#[test]
fn only_textures_read_for_samples_come_to_the_truth() {
    let (scene, pose) = noisy(textured(AlphaMode::Opaque));
    let mut headless = headless();
    let scene = headless.upload(SceneRequest::new(&scene, &pose)).unwrap();
    let truth = reference(&mut headless, &scene, Footprint::Sample);
    let geometry = reference(&mut headless, &scene, Footprint::Pixel);
    let mut error = |footprint, samples| {
        let settings = settings(MethodKind::Ssaa, samples, footprint);
        rmse(&render(&mut headless, &scene, &settings), &truth)
    };
    let errors = [4, 16, 64].map(|samples| error(Footprint::Sample, samples));
    assert!(errors.is_sorted_by(|a, b| *a > 2.0 * b), "{errors:?}");
    let blurred = error(Footprint::Pixel, 1024);
    let apart = rmse(&truth, &geometry);
    assert!((blurred / apart - 1.0).abs() < 0.05 && apart > 5.0 * errors[2], "{blurred} {apart} {errors:?}");
}

/// Error that is left if no pixel is a superpixel, or if all are.
fn left(scene: &Scene, pose: &Pose, superpixels: bool) -> Within {
    let mut headless = headless();
    let whole = headless.upload(SceneRequest::new(scene, pose)).unwrap();
    let plain = settings(MethodKind::None, 1, Footprint::Sample);
    let shown = |colors: &[[f32; 4]]| DecodedImage::from(&Picture::new(SIZE, colors).unwrap());
    let halves = [Stripped::Paint, Stripped::Light].map(|stripped| {
        let scene = headless.upload(SceneRequest::new(&stripped.of(scene), pose)).unwrap();
        let truth = reference(&mut headless, &scene, Footprint::Sample);
        (scene, shown(&truth))
    });
    let truth = reference(&mut headless, &whole, Footprint::Sample);
    let one = render(&mut headless, &whole, &plain);
    let picture = |colors| Picture::new(SIZE, colors).unwrap();
    let yardstick = Yardstick::new(&picture(&truth), &picture(&one)).unwrap();
    let settings = settings(MethodKind::Superpixel, 4, Footprint::Sample)
        .map_superpixels(|options| options.detection(if superpixels { Detection::Every } else { Detection::Edges }));
    let image = render(&mut headless, &whole, &settings);
    let looks = PixelTriangles::new(&mut headless, &whole, &camera(), &plain, || {}).unwrap();
    let causes = looks.causes(&mut headless, &settings).unwrap();
    let image = picture(&image);
    let faults = looks.faults(&mut headless, &halves, &settings, &yardstick, &image, &causes).unwrap();
    yardstick.split_within(&image, &causes, &faults).unwrap()
}

/// Noise in the colour counts as an error of texture, noise in normals as one of lighting, and errors of edges occur only between
/// triangles.
#[test]
fn paint_and_light_are_told_apart() {
    let noise = textured(AlphaMode::Opaque).base_color_texture;
    let lit = Material { unlit: false, metallic: 0.0, roughness: 0.4, ..flat([0.8; 4], AlphaMode::Opaque) };
    let painted = Material { base_color_texture: noise, ..lit.clone() };
    let bumpy = Material { normal_texture: noise, ..lit };
    for (name, material) in [("painted", painted), ("bumpy", bumpy)] {
        let (scene, pose) = noisy(material);
        for superpixels in [false, true] {
            let within = left(&scene, &pose, superpixels);
            println!("{name}, superpixels: {superpixels}: {within:?}");
            let (mine, other) = match (superpixels, name) {
                (false, "painted") => (within.inside_texture, within.inside_light),
                (false, _) => (within.inside_light, within.inside_texture),
                (true, "painted") => (within.superpixel_texture, within.superpixel_light),
                (true, _) => (within.superpixel_light, within.superpixel_texture),
            };
            assert!(mine > 0.05 && mine > 20.0 * other, "{name} {within:?}");
            // The two triangles meet along a diagonal.
            assert!(within.superpixel_edges < 0.1 * mine, "{name} {within:?}");
        }
    }
}

/// Superpixels with samples on a grid, each shaded with the texture levels of a sample, equal supersampling with as
/// many samples: to 60 dB in the three colours, because both compute footprints from their own differences.
#[test]
fn a_grid_of_shaded_samples_is_brute_force() {
    let (scene, pose) = noisy(textured(AlphaMode::Opaque));
    let mut headless = headless();
    let scene = headless.upload(SceneRequest::new(&scene, &pose)).unwrap();
    for samples in [16, 64] {
        let brute_force = settings(MethodKind::Ssaa, samples, Footprint::Sample);
        let superpixels = settings(MethodKind::Superpixel, samples, Footprint::Sample).map_superpixels(|options| {
            options.detection(Detection::Every).shading(Shading::Sample).pattern(Pattern::Grid)
        });
        let [brute_force, superpixels] =
            [brute_force, superpixels].map(|settings| render(&mut headless, &scene, &settings));
        let error = rmse(&superpixels, &brute_force);
        assert!(error < 8.6e-4, "{samples} samples: {error}");
    }
}
