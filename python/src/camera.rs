//! Cameras as Python describes them. They are resolved when the scene's bounds and the image's size are known.

use crate::error;
use glam::{DMat3, DMat4, DVec2, DVec3};
use gpc::camera::{Camera as View, Orbit, Pinhole, Projection, Viewpoint};
use gpc::scene::SceneCamera;
use pyo3::prelude::*;

type Rows<const R: usize, const C: usize> = [[f64; C]; R];

#[derive(Clone, Debug)]
enum Description {
    /// The scene file's first camera, or a view of the whole scene.
    Usual,
    Orbit(Orbit),
    LookAt {
        eye: DVec3,
        target: Option<DVec3>,
        up: DVec3,
        fov: f64,
        near: Option<f64>,
    },
    OfScene {
        name: String,
        fov: Option<f64>,
    },
    Pose {
        camera_to_world: DMat4,
        fov: f64,
        near: Option<f64>,
    },
    Intrinsics {
        matrix: DMat3,
        world_to_camera: DMat4,
        near: Option<f64>,
    },
}

/// A camera. World space is glTF's: right-handed, y up.
#[pyclass(frozen, from_py_object, module = "gpc")]
#[derive(Clone, Debug)]
pub struct Camera(Description);

/// What a scene tells cameras.
pub struct Surroundings<'a> {
    pub bounds: (DVec3, DVec3),
    pub cameras: &'a [SceneCamera],
}

/// Distance of the near plane for cameras that are given without one: a ten-thousandth of the scene's diagonal.
const NEAR: f64 = 1e-4;

#[pymethods]
impl Camera {
    /// A camera that sees the whole scene from an angle around it, in degrees. `zoom` 2 shows everything twice as large.
    #[staticmethod]
    #[pyo3(signature = (azimuth=35.0, elevation=20.0, zoom=1.0, fov=40.0))]
    fn orbit(azimuth: f64, elevation: f64, zoom: f64, fov: f64) -> Self {
        Self(Description::Orbit(Orbit { azimuth, elevation, zoom, fov }))
    }

    /// A camera at `eye` that looks at `target`, by default the scene's centre. `fov` is the vertical field of view in degrees.
    #[staticmethod]
    #[pyo3(signature = (eye, target=None, up=[0.0, 1.0, 0.0], fov=40.0, near=None))]
    fn look_at(eye: [f64; 3], target: Option<[f64; 3]>, up: [f64; 3], fov: f64, near: Option<f64>) -> Self {
        Self(Description::LookAt { eye: eye.into(), target: target.map(DVec3::from), up: up.into(), fov, near })
    }

    /// The scene file's camera with this name or index. `fov` replaces its vertical field of view in degrees.
    #[staticmethod]
    #[pyo3(signature = (name="0", fov=None))]
    fn of_scene(name: &str, fov: Option<f64>) -> Self {
        Self(Description::OfScene { name: name.to_owned(), fov })
    }

    /// A camera with the pose of a 4 x 4 matrix from camera space (x right, y up, looking along -z, as in OpenGL and glTF) to world
    /// space. Its axes have to be orthonormal.
    #[staticmethod]
    #[pyo3(signature = (camera_to_world, fov=40.0, near=None))]
    fn from_pose(camera_to_world: Rows<4, 4>, fov: f64, near: Option<f64>) -> PyResult<Self> {
        let camera_to_world = DMat4::from_cols_array_2d(&camera_to_world).transpose();
        check_axes(DMat3::from_mat4(camera_to_world), "camera_to_world")?;
        Ok(Self(Description::Pose { camera_to_world, fov, near }))
    }

    /// A camera with intrinsics as OpenCV has them. `matrix` is [[fx, 0, cx], [0, fy, cy], [0, 0, 1]] in pixels, with the centre of
    /// the first pixel at (0, 0). `world_to_camera` is a 4 x 4 matrix to camera space (x right, y down, z forward).
    #[staticmethod]
    #[pyo3(signature = (matrix, world_to_camera, near=None))]
    fn from_intrinsics(matrix: Rows<3, 3>, world_to_camera: Rows<4, 4>, near: Option<f64>) -> PyResult<Self> {
        let matrix = DMat3::from_cols_array_2d(&matrix).transpose();
        let world_to_camera = DMat4::from_cols_array_2d(&world_to_camera).transpose();
        check_axes(DMat3::from_mat4(world_to_camera), "world_to_camera")?;
        if !(matrix.x_axis.x > 0.0 && matrix.y_axis.y > 0.0 && matrix.is_finite()) {
            return Err(error::usage("matrix: fx and fy must be above 0, and all numbers finite"));
        }
        Ok(Self(Description::Intrinsics { matrix, world_to_camera, near }))
    }

    fn __repr__(&self) -> String {
        format!("Camera({:?})", self.0)
    }
}

fn check_axes(axes: DMat3, name: &str) -> PyResult<()> {
    let off = (axes.transpose() * axes - DMat3::IDENTITY)
        .to_cols_array()
        .into_iter()
        .fold(0.0_f64, |most, x| most.max(x.abs()));
    if off > 1e-4 || !axes.is_finite() {
        return Err(error::usage(format!("{name}: its axes must be orthonormal, without scale or shear")));
    }
    Ok(())
}

impl Default for Camera {
    fn default() -> Self {
        Self(Description::Usual)
    }
}

impl Camera {
    /// The camera for an image of `size`; `None` if no planar camera with square pixels is like it.
    pub fn view(&self, scene: &Surroundings<'_>, size: [u32; 2]) -> PyResult<Option<View>> {
        let (low, high) = scene.bounds;
        let [width, height] = size.map(f64::from);
        let usual_near = NEAR * (high - low).length().max(1e-9);
        let view = match &self.0 {
            Description::Usual if !scene.cameras.is_empty() => of_scene(scene.cameras, "0", None)?,
            Description::Usual => Orbit::default().frame(low, high, width / height).map_err(error::usage)?,
            Description::Orbit(orbit) => orbit.frame(low, high, width / height).map_err(error::usage)?,
            &Description::LookAt { eye, target, up, fov, near } => {
                let target = target.unwrap_or(0.5 * (low + high));
                let framed = match near {
                    None => Viewpoint { eye, target, up, fov }.frame(low, high),
                    Some(near) => View::look_at(eye, target, up, fov, near),
                };
                framed.map_err(error::usage)?
            }
            Description::OfScene { name, fov } => of_scene(scene.cameras, name, *fov)?,
            &Description::Pose { camera_to_world, fov, near } => {
                let axes = DMat3::from_mat4(camera_to_world);
                let eye = camera_to_world.w_axis.truncate();
                let (ahead, up) = (-axes.z_axis, axes.y_axis);
                View::look_at(eye, eye + ahead, up, fov, near.unwrap_or(usual_near)).map_err(error::usage)?
            }
            Description::Intrinsics { matrix, world_to_camera, near } => {
                let (fx, fy) = (matrix.x_axis.x, matrix.y_axis.y);
                if (fx - fy).abs() > 1e-9 * fx || matrix.y_axis.x != 0.0 {
                    return Ok(None);
                }
                let (eye, right, down, ahead) = axes_of(world_to_camera);
                View {
                    eye,
                    axes: DMat3::from_cols(right, -down, -ahead),
                    projection: Projection::Perspective {
                        fov: 2.0 * (0.5 * height / fy).atan(),
                        near: near.unwrap_or(usual_near),
                        far: None,
                    },
                    // OpenCV counts from the centre of the first pixel, pinholes from its corner.
                    shift: DVec2::new(0.5 - (matrix.z_axis.x + 0.5) / width, 0.5 - (matrix.z_axis.y + 0.5) / height),
                }
            }
        };
        Ok(Some(view))
    }

    /// The camera's pinhole, whose plane has `size` pixels.
    pub fn pinhole(&self, scene: &Surroundings<'_>, size: [u32; 2]) -> PyResult<Pinhole> {
        if let Description::Intrinsics { matrix, world_to_camera, near } = &self.0 {
            let (eye, right, down, ahead) = axes_of(world_to_camera);
            let inverse = matrix.inverse();
            let towards = |u: f64, v: f64| {
                let ray = inverse * DVec3::new(u - 0.5, v - 0.5, 1.0);
                right * ray.x + down * ray.y + ahead * ray.z
            };
            let corner = towards(0.0, 0.0);
            let (a, b) = (towards(1.0, 0.0) - corner, towards(0.0, 1.0) - corner);
            let usual_near = NEAR * (scene.bounds.1 - scene.bounds.0).length().max(1e-9);
            let near = near.unwrap_or(usual_near);
            return Pinhole::new(eye.extend(1.0), eye + corner, a, b, near, None).map_err(error::usage);
        }
        match self.view(scene, size)? {
            Some(view) => Pinhole::from_camera(&view, size).map_err(error::usage),
            None => Err(error::usage("this camera has no pinhole")),
        }
    }
}

/// Eye, and the directions right, down and ahead in the world, of a rigid matrix to OpenCV's camera space.
fn axes_of(world_to_camera: &DMat4) -> (DVec3, DVec3, DVec3, DVec3) {
    let rows = DMat3::from_mat4(*world_to_camera).transpose();
    let eye = -(rows * world_to_camera.w_axis.truncate());
    (eye, rows.x_axis, rows.y_axis, rows.z_axis)
}

fn of_scene(cameras: &[SceneCamera], name: &str, fov: Option<f64>) -> PyResult<View> {
    let found = SceneCamera::find(cameras, name).and_then(|index| cameras.get(index));
    let Some(found) = found else {
        let names: Vec<_> = cameras.iter().map(|camera| camera.name.clone().unwrap_or_default()).collect();
        return Err(error::usage(format!("the scene has no camera \"{name}\"; it has {}: {names:?}", cameras.len())));
    };
    let mut camera = View::from_scene(found);
    match (&mut camera.projection, fov) {
        (_, None) => {}
        (Projection::Perspective { fov, .. }, Some(asked)) => *fov = asked.to_radians(),
        (Projection::Orthographic { .. }, Some(_)) => {
            return Err(error::usage(format!("fov: camera \"{name}\" is orthographic and has no field of view")));
        }
    }
    Ok(camera)
}
