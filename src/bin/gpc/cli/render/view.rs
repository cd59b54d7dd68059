//! Cameras through which a pose is seen.

use super::args::CameraArgs;
use super::template::file_name_part;
use crate::cli::exit::Usage;
use glam::DVec3;
use gpc::camera::{Camera, Orbit, Projection, Viewpoint};
use gpc::scene::{Pose, SceneCamera};
use std::collections::HashMap;

/// A camera to render with.
pub struct NamedView {
    /// Text that replaces `{camera}` in the output's name.
    pub label: String,
    pub camera: Camera,
    /// The point on the camera's axis that the camera looks at; without one, the point nearest to the scene's centre.
    pub target: DVec3,
}

/// The box around a pose; a box around the origin if the pose is empty.
pub fn bounds(pose: &Pose) -> (DVec3, DVec3) {
    let bounds = pose.geometry.bounds();
    bounds.unwrap_or((DVec3::splat(-1.0), DVec3::ONE))
}

/// The cameras that the options ask for, at least one; `aspect` is width / height.
pub fn choose(args: &CameraArgs, pose: &Pose, aspect: f64) -> Result<Vec<NamedView>, Usage> {
    choose_among(args, &pose.cameras, bounds(pose), aspect)
}

/// Chooses as [`choose`] does, among `cameras`, for a scene within the box `bounds`.
pub fn choose_among(
    args: &CameraArgs,
    cameras: &[SceneCamera],
    bounds: (DVec3, DVec3),
    aspect: f64,
) -> Result<Vec<NamedView>, Usage> {
    if let Some(view) = describe(args, cameras, bounds, aspect)? {
        return Ok(vec![view]);
    }
    let indices = match args.camera.as_deref() {
        None => vec![0],
        Some("all") if cameras.is_empty() => {
            return Err(Usage("--camera all: the scene has no cameras".to_owned()));
        }
        Some("all") => (0..cameras.len()).collect(),
        Some(asked) => vec![find(asked, cameras)?],
    };
    let labels = labels(cameras);
    let centre = 0.5 * (bounds.0 + bounds.1);
    cameras
        .iter()
        .zip(labels)
        .enumerate()
        .filter(|(index, _)| indices.contains(index))
        .map(|(_, (found, label))| {
            let mut camera = Camera::from_scene(found);
            widen(&mut camera, args.fov, &label)?;
            let ahead = (centre - camera.eye).dot(camera.direction());
            let distance = if ahead > 0.0 { ahead } else { 1.0 };
            Ok(NamedView { label, target: camera.eye + camera.direction() * distance, camera })
        })
        .collect()
}

/// The camera that the options describe; `None` if they ask for one of `cameras`.
pub fn describe(
    args: &CameraArgs,
    cameras: &[SceneCamera],
    bounds: (DVec3, DVec3),
    aspect: f64,
) -> Result<Option<NamedView>, Usage> {
    if let Some(eye) = args.eye {
        return stand_at(eye, args, bounds).map(Some);
    }
    let orbits = args.azimuth.is_some() || args.elevation.is_some() || args.zoom.is_some();
    if orbits || (args.camera.is_none() && cameras.is_empty()) {
        return orbit(args, bounds, aspect).map(Some);
    }
    Ok(None)
}

fn stand_at(eye: DVec3, args: &CameraArgs, (low, high): (DVec3, DVec3)) -> Result<NamedView, Usage> {
    let viewpoint = Viewpoint {
        eye,
        target: args.target.unwrap_or(0.5 * (low + high)),
        up: args.up.unwrap_or(DVec3::Y),
        fov: args.fov.unwrap_or(Orbit::default().fov),
    };
    let camera = viewpoint.frame(low, high).map_err(|error| Usage(error.to_string()))?;
    Ok(NamedView { label: "eye".to_owned(), camera, target: viewpoint.target })
}

fn orbit(args: &CameraArgs, (low, high): (DVec3, DVec3), aspect: f64) -> Result<NamedView, Usage> {
    let default = Orbit::default();
    let orbit = Orbit {
        azimuth: args.azimuth.unwrap_or(default.azimuth),
        elevation: args.elevation.unwrap_or(default.elevation),
        zoom: args.zoom.unwrap_or(default.zoom),
        fov: args.fov.unwrap_or(default.fov),
    };
    let camera = orbit.frame(low, high, aspect).map_err(|error| Usage(error.to_string()))?;
    Ok(NamedView { label: NamedView::ORBIT.to_owned(), camera, target: 0.5 * (low + high) })
}

/// Index of the camera with this name or index.
pub fn find(asked: &str, cameras: &[SceneCamera]) -> Result<usize, Usage> {
    if let Some(index) = SceneCamera::find(cameras, asked) {
        return Ok(index);
    }
    let known: Vec<_> = cameras
        .iter()
        .enumerate()
        .map(|(index, camera)| match &camera.name {
            Some(name) => format!("{index} \"{name}\""),
            None => index.to_string(),
        })
        .collect();
    let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
    Err(Usage(format!("--camera {asked}: there is no such camera; the scene has {known}")))
}

/// A unique part of a file name for each camera.
fn labels(cameras: &[SceneCamera]) -> Vec<String> {
    let name = |(index, camera): (usize, &SceneCamera)| match &camera.name {
        Some(name) => file_name_part(name),
        None => index.to_string(),
    };
    let names: Vec<_> = cameras.iter().enumerate().map(name).collect();
    let mut uses = HashMap::new();
    for name in &names {
        // File systems may ignore the difference of upper and lower case.
        *uses.entry(name.to_lowercase()).or_insert(0) += 1;
    }
    let unique = |(index, name): (usize, &String)| match uses.get(&name.to_lowercase()) {
        Some(1) => name.clone(),
        _ => format!("{index}_{name}"),
    };
    names.iter().enumerate().map(unique).collect()
}

fn widen(camera: &mut Camera, asked: Option<f64>, label: &str) -> Result<(), Usage> {
    match (&mut camera.projection, asked) {
        (_, None) => Ok(()),
        (Projection::Perspective { fov, .. }, Some(asked)) => {
            *fov = asked.to_radians();
            Ok(())
        }
        (Projection::Orthographic { .. }, Some(_)) => {
            Err(Usage(format!("--fov: camera {label} is orthographic and has no field of view")))
        }
    }
}

impl NamedView {
    /// The label of a view of the whole scene.
    pub const ORBIT: &str = "orbit";

    /// The camera turned about the vertical axis through its target, counter-clockwise seen from above.
    pub fn turned(&self, degrees: f64) -> Camera {
        self.camera.turned(self.target, degrees)
    }
}
