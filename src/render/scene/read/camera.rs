//! Cameras (glTF 2.0, section 3.10). A camera that can't be used is left out with a warning.

use std::f64::consts::PI;

use gltf::json::{
    Camera,
    camera::{Orthographic, Perspective, Type},
};

use super::{Context, model::Model};
use crate::scene::{error::Fault, view::SceneProjection};

/// Reads all cameras; `None` for those that can't be used.
pub fn read_all(context: &mut Context<'_>) -> Vec<Option<SceneProjection>> {
    let model = context.model;
    let read = model.all().map(|found| {
        let (item, place) = found?;
        read(item, &place, model).map(Some)
    });
    read.map(|read| context.tolerate(read, "the camera is left out")).collect()
}

/// Reads the camera at `place`.
pub fn read(item: &Camera, place: &str, model: &Model) -> Result<SceneProjection, Fault> {
    let part = match model.valid(&item.type_, &format!("{place}/type"))? {
        Type::Perspective => "perspective",
        Type::Orthographic => "orthographic",
    };
    let projection = match (part, &item.perspective, &item.orthographic) {
        ("perspective", Some(item), _) => perspective(item),
        ("orthographic", _, Some(item)) => orthographic(item),
        _ => return Err(Fault::new(place, format!("lacks the required \"{part}\""))),
    };
    projection.map_err(|reason| Fault::new(format!("{place}/{part}"), reason))
}

fn perspective(item: &Perspective) -> Result<SceneProjection, String> {
    let (yfov, near, far) = (wide(item.yfov), wide(item.znear), item.zfar.map(wide));
    if !(yfov > 0.0 && yfov < PI) {
        return Err(format!("a vertical field of view of {yfov} is not between 0 and pi"));
    }
    if near <= 0.0 || far.is_some_and(|far| far <= near) {
        let far = far.unwrap_or(f64::INFINITY);
        return Err(format!("the planes {near} and {far} are not positive and ascending"));
    }
    Ok(SceneProjection::Perspective {
        yfov,
        // The aspect ratio is only a hint, so that an invalid one is ignored.
        aspect: item.aspect_ratio.map(wide).filter(|&aspect| aspect > 0.0),
        near,
        far,
    })
}

fn orthographic(item: &Orthographic) -> Result<SceneProjection, String> {
    // The specification discourages negative magnifications, but does not forbid them.
    let (xmag, ymag) = (wide(item.xmag).abs(), wide(item.ymag).abs());
    let (near, far) = (wide(item.znear), wide(item.zfar));
    if xmag == 0.0 || ymag == 0.0 {
        return Err("a magnification of 0 shows nothing".to_owned());
    }
    if near < 0.0 || far <= near {
        return Err(format!("the planes {near} and {far} are not positive and ascending"));
    }
    Ok(SceneProjection::Orthographic { xmag, ymag, near, far })
}

/// Double that the file most likely contains: the shortest decimal that rounds to the float.
fn wide(x: f32) -> f64 {
    x.to_string().parse().unwrap_or(f64::from(x))
}
