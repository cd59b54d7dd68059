//! Cameras (glTF 2.0, section 3.10). One that cannot be used is left out with a warning.

use std::f64::consts::PI;

use super::{Context, json::Item};
use crate::scene::{document::Camera, error::Fault, view::SceneProjection};

/// Reads all cameras; `None` for those that cannot be used.
pub fn read_all(context: &mut Context<'_>) -> Result<Vec<Option<Camera>>, Fault> {
    let items = context.root.objects("cameras")?;
    Ok(items
        .iter()
        .map(|item| context.tolerate(read(item).map(Some), "the camera is left out"))
        .collect())
}

fn read(item: &Item<'_>) -> Result<Camera, Fault> {
    let kind = item.require("type")?;
    let projection = match kind.as_str()? {
        "perspective" => read_perspective(&item.require("perspective")?)?,
        "orthographic" => read_orthographic(&item.require("orthographic")?)?,
        other => return Err(kind.fault(format!("\"{other}\" is no camera type"))),
    };
    Ok(Camera {
        name: item.name(),
        projection,
    })
}

fn read_perspective(item: &Item<'_>) -> Result<SceneProjection, Fault> {
    let yfov = item.require("yfov")?.as_f64()?;
    if !(yfov > 0.0 && yfov < PI) {
        return Err(item.fault(format!(
            "a vertical field of view of {yfov} is not between 0 and pi"
        )));
    }
    let near = item.require("znear")?.as_f64()?;
    let far = item.get("zfar").map(|far| far.as_f64()).transpose()?;
    if near <= 0.0 || far.is_some_and(|far| far <= near) {
        return Err(item.fault(format!(
            "the planes {near} and {} are not positive and ascending",
            far.unwrap_or(f64::INFINITY)
        )));
    }
    let aspect = item.get("aspectRatio").map(|a| a.as_f64()).transpose()?;
    Ok(SceneProjection::Perspective {
        yfov,
        // A ratio is advice only, so that a useless one is no reason to lose the camera.
        aspect: aspect.filter(|&aspect| aspect > 0.0),
        near,
        far,
    })
}

fn read_orthographic(item: &Item<'_>) -> Result<SceneProjection, Fault> {
    let number = |key: &str| item.require(key)?.as_f64();
    // The specification discourages negative magnifications, but does not forbid them.
    let (xmag, ymag) = (number("xmag")?.abs(), number("ymag")?.abs());
    let (near, far) = (number("znear")?, number("zfar")?);
    if xmag == 0.0 || ymag == 0.0 {
        return Err(item.fault("a magnification of 0 shows nothing"));
    }
    if near < 0.0 || far <= near {
        return Err(item.fault(format!(
            "the planes {near} and {far} are not positive and ascending"
        )));
    }
    Ok(SceneProjection::Orthographic {
        xmag,
        ymag,
        near,
        far,
    })
}
