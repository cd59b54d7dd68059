//! Warnings about images that show nothing of the scene.

use super::view::NamedView;
use glam::DVec3;
use gpc::camera::Camera;
use gpc::scene::{Pose, SceneCamera};

/// A warning about an image whose pixels all have the same colour, which means that nothing of the scene is in view. The
/// warning names cameras that see the scene. `aspect` is width / height.
pub fn warning(view: &NamedView, pose: &Pose, cameras: &[SceneCamera], aspect: f64) -> String {
    if pose.geometry.bounds().is_none() {
        return "the image is empty, like the scene; `gpc info` lists what the file has".to_owned();
    }
    let geometry = pose.geometry.flat();
    let points = || geometry.positions.iter().map(|p| DVec3::from_array(p.map(f64::from)) + geometry.origin);
    let seeing: Vec<String> = cameras
        .iter()
        .enumerate()
        .filter(|(_, camera)| {
            let camera = Camera::from_scene(camera);
            camera.eye != view.camera.eye && points().any(|point| sees(&camera, point, aspect))
        })
        .map(|(index, camera)| match &camera.name {
            Some(name) => format!("--camera '{name}'"),
            None => format!("--camera {index}"),
        })
        .collect();
    let found = if points().any(|point| sees(&view.camera, point, aspect)) {
        "every pixel has the same colour: one surface hides all others, or its colour is the background's"
    } else {
        "every pixel shows the background: nothing of the scene is in view"
    };
    let mut ways = seeing;
    if view.label != NamedView::ORBIT {
        ways.push("--azimuth 35, which frames the whole scene".to_owned());
    }
    let ways = match ways.len() {
        0 => "see `gpc info` for what the scene holds".to_owned(),
        _ => format!("try {}", ways.join(", or ")),
    };
    format!("camera {}: {found}; {ways}", view.label)
}

/// Whether a point lies in front of a camera and within the sides of its image.
fn sees(camera: &Camera, point: DVec3, aspect: f64) -> bool {
    let clip = camera.projection_matrix(aspect) * camera.view() * point.extend(1.0);
    clip.w > 0.0 && clip.x.abs() <= clip.w && clip.y.abs() <= clip.w
}
