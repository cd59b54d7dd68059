//! The embedding example, run as a separate program: the host's image equals a headless render.

use crate::example;
use gpc::camera::Camera;
use gpc::color::srgb;
use gpc::render::{Headless, HeadlessOptions, SceneRequest, Settings, Shadows};
use gpc::scene::{PoseRequest, Scene};
use std::path::Path;
use std::process::Command;

const SCENE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/fence.glb");

/// sRGB codes of a headless render with the example's settings, under the validation layer.
fn headless(width: u32, height: u32) -> Vec<[u8; 4]> {
    let mut headless = Headless::new(&HeadlessOptions::default().validation(true)).unwrap();
    let scene = Scene::load(Path::new(SCENE)).unwrap().scene;
    let pose = scene.pose(&PoseRequest::default()).unwrap();
    let camera = Camera::from_scene(pose.cameras.first().unwrap());
    let request = SceneRequest::new(&scene, &pose).shadowed(Shadows::Exact);
    let prepared = headless.upload(request).unwrap();
    let settings = Settings::new(width, height).background(Some([0.2, 0.3, 0.5])).shadows(Shadows::Exact);
    let mut frame = headless.prepare(&prepared, &settings).unwrap();
    let rendered = headless.render(&mut frame, &camera).unwrap();
    assert!(rendered.statistics.superpixels > 0);
    assert_eq!(headless.validation_messages(), Vec::<String>::new());
    let code = |linear: f32| srgb::encode_u8(f64::from(linear));
    let alpha = |alpha: f32| (alpha.clamp(0.0, 1.0) * 255.0).round() as u8;
    rendered.colors.iter().map(|[r, g, b, a]| [code(*r), code(*g), code(*b), alpha(*a)]).collect()
}

#[test]
fn embed_refuses_arguments_that_it_does_not_know() {
    let program = || Command::new(example::built("embed"));
    example::takes_only(program, 2, "embed [SCENE [OUT.png]]");
}

#[test]
fn a_hosts_image_holds_what_a_headless_render_gives() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("embed.png");
    example::validated(Command::new(example::built("embed")).args([Path::new(SCENE), &out]));

    let image = image::open(&out).unwrap().into_rgba8();
    let expected = headless(image.width(), image.height());
    assert_eq!(image.pixels().len(), expected.len());
    let farthest = image
        .pixels()
        .zip(&expected)
        .flat_map(|(found, expected)| found.0.into_iter().zip(*expected))
        .map(|(found, expected)| found.abs_diff(expected))
        .max();
    assert!(farthest.is_some_and(|codes| codes <= 1), "differs by {farthest:?} codes");
}
