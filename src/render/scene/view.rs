//! Cameras of a file.

use glam::{DMat3, DVec3};

/// Projection of a glTF camera (glTF 2.0, section 3.10).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SceneProjection {
    /// Perspective projection.
    Perspective {
        /// Vertical field of view in radians, above 0 and below pi.
        yfov: f64,
        /// Width / height, if the file prescribes it.
        aspect: Option<f64>,
        /// Distance of the near plane, above 0.
        near: f64,
        /// Distance of the far plane; `None` for infinity.
        far: Option<f64>,
    },
    /// Orthographic projection.
    Orthographic {
        /// Half of the width.
        xmag: f64,
        /// Half of the height.
        ymag: f64,
        /// Distance of the near plane, 0 or more.
        near: f64,
        /// Distance of the far plane, above `near`.
        far: f64,
    },
}

impl SceneCamera {
    /// Index of the camera with this name, or otherwise with this index.
    #[must_use]
    pub fn find(cameras: &[Self], asked: &str) -> Option<usize> {
        let by_name = cameras.iter().position(|camera| camera.name.as_deref() == Some(asked));
        let by_index = || asked.parse().ok().filter(|index| *index < cameras.len());
        by_name.or_else(by_index)
    }
}

/// Camera in the world, at the moment of the pose.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneCamera {
    /// Name of the camera, or otherwise of its node.
    pub name: Option<String>,
    /// Position in world space.
    pub eye: DVec3,
    /// Columns: right, up and backward in world space, orthonormal. The camera looks along the negative third one.
    pub axes: DMat3,
    /// Projection of the camera.
    pub projection: SceneProjection,
}
