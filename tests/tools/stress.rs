//! The short stress suite, under the validation layer.

use crate::measurement::stress::stage::camera;
use crate::measurement::stress::{Check, Finding, Length};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::DVec3;
use gpc::camera::Camera;
use gpc::render::{Headless, HeadlessOptions, SceneRequest, Settings};
use gpc::scene::{PoseRequest, Scene};

fn headless() -> Headless {
    Headless::new(&HeadlessOptions::default().validation(true)).unwrap()
}

/// Runs a check of the suite, which must have findings, all of them within their bounds.
fn hold(name: &str) {
    let check = Check::ALL.iter().find(|check| check.name == name).unwrap();
    let mut headless = headless();
    let findings = check.run(&mut headless, Length { is_long: false }).unwrap();
    assert!(!findings.is_empty());
    for finding in &findings {
        println!("{finding:?}");
        assert!(finding.checked > 0, "{finding:?}");
    }
    let failed: Vec<_> = findings.iter().filter(|finding| !finding.holds()).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    assert_eq!(headless.validation_messages(), Vec::<String>::new());
}

#[test]
fn every_sample_of_a_tiling_is_hit_once() {
    hold("partition of unity");
}

#[test]
fn surfaces_around_the_camera_are_closed() {
    hold("near plane and fields of view");
}

#[test]
fn size_and_place_do_not_matter() {
    hold("scale, origin and depth");
}

#[test]
fn coincident_surfaces_are_stable() {
    hold("coincident surfaces");
}

#[test]
fn hostile_vertices_do_no_harm() {
    hold("hostile vertices");
}

#[test]
fn attributes_of_slivers_stay_in_range() {
    hold("attributes of slivers");
}

#[test]
fn nothing_else_changes_an_image() {
    hold("invariance");
}

#[test]
fn wires_keep_their_energy() {
    hold("motion");
}

/// A file whose vertices are exact at a distance of a million units, and its camera.
fn far_away(offset: f32) -> (Scene, Camera) {
    let corner = |x: f32, y: f32, z: f32| [x + offset, y + offset, z - offset];
    let positions = [
        corner(-2.0625, -1.0, -4.0),
        corner(1.9375, -1.5, -4.5),
        corner(0.1875, 1.8125, -3.5),
        corner(-1.5, 1.25, -4.25),
        corner(0.0625, -2.125, -3.75),
        corner(2.25, 1.0, -4.0),
    ];
    let bytes: Vec<u8> = positions.as_flattened().iter().flat_map(|v| v.to_le_bytes()).collect();
    let [low, high] = [f32::min as fn(f32, f32) -> f32, f32::max].map(|pick| {
        let mut corners = positions.into_iter();
        let first = corners.next().unwrap();
        corners.fold(first, |a, b| [0, 1, 2].map(|axis| pick(a[axis], b[axis])))
    });
    let file = serde_json::json!({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{
            "bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3", "min": low, "max": high,
        }],
        "bufferViews": [{"buffer": 0, "byteLength": bytes.len()}],
        "buffers": [{
            "byteLength": bytes.len(),
            "uri": format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes)),
        }],
    });
    let scene = Scene::from_slice(file.to_string().as_bytes(), "far", None).unwrap();
    let eye = DVec3::new(1.0, 1.0, -1.0) * f64::from(offset);
    let camera = Camera { eye, ..camera() };
    (scene.scene, camera)
}

/// Vertices of a file lose no precision on their way to the device, however far from the origin they are.
#[test]
fn a_file_far_from_the_origin_is_the_same_picture() {
    let mut headless = headless();
    let settings = Settings::new(90, 60);
    let images = [0.0, 1e6].map(|offset| {
        let (scene, camera) = far_away(offset);
        let pose = scene.pose(&PoseRequest::default()).unwrap();
        let prepared = headless.upload(SceneRequest::new(&scene, &pose)).unwrap();
        let mut frame = headless.prepare(&prepared, &settings).unwrap();
        headless.render(&mut frame, &camera).unwrap()
    });
    assert!(images[0].statistics.superpixels > 50);
    assert_eq!(images[0].colors, images[1].colors);
}

/// Neither a value above its bound nor NaN is accepted.
#[test]
fn a_finding_can_fail() {
    let finding = |measured, allowed| Finding { case: String::new(), checked: 1, unit: "", measured, allowed };
    assert!(finding(1.0, Some(1.0)).holds() && finding(9.0, None).holds());
    assert!(!finding(1.1, Some(1.0)).holds() && !finding(f64::NAN, Some(1.0)).holds());
}
