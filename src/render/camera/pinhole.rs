//! The pinhole: a centre of projection and an image plane.
//!
//! ```text
//!   C (centre of projection)         the ray of (u, v) starts at C and goes through
//!    \                               O + a u + b v
//!     \      O ──── a ───▶ u
//!      \     │ ┌──┬──┬──┐            O       upper left corner of the image
//!       \    b ├──┼──┼──┤            a       step to the next pixel of a row
//!        \   │ ├──┼──┼──┤            b       step to the next row
//!         \  ▼ └──┴──┴──┘            (u, v)  pixels; the centre of the first one is (0.5, 0.5)
//!          \ v      ·───────▶ ray
//! ```
//!
//! C is homogeneous: `(x, y, z, 1)` is a point, and `(x, y, z, 0)` is infinitely far away in the direction (x, y, z), so
//! that all rays are parallel to -(x, y, z): orthographic cameras and directional lights.

use super::{Camera, CameraError, Projection};
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, Vec4Swizzles};

/// Pinhole: a centre of projection C, an image plane (O, a, b) and a range of depths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pinhole {
    centre: DVec4,
    origin: DVec3,
    a: DVec3,
    b: DVec3,
    near: f64,
    far: Option<f64>,
    /// Inverse of the projection. The inverse maps world vectors relative to C to (u w, v w, w), w being the distance
    /// from C along the normal. For parallel rays, vectors relative to O are mapped to (u, v, distance along a ray).
    inverse: DMat3,
    /// Unit normal of the plane that points away from C.
    normal: DVec3,
}

/// Line of sight with a start and a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Start of the ray: C, or a point of the image plane for parallel rays.
    pub start: DVec3,
    /// Unit vector along the ray.
    pub direction: DVec3,
}

/// Error: a pinhole that can't exist.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PinholeError {
    /// Coordinate that is NaN or infinite; holds its name.
    #[error("{0} of the pinhole is not finite")]
    NotFinite(&'static str),
    /// Centre of projection that is neither a point (w = 1) nor a direction (w = 0), or is zero.
    #[error("the centre of projection is {0}; give a point (x, y, z, 1) or a direction (x, y, z, 0) other than zero")]
    Centre(DVec4),
    /// Image plane whose steps a and b are parallel or zero.
    #[error("a = {a} and b = {b} span no image plane; they must be independent")]
    Plane {
        /// Step to the next pixel of a row.
        a: DVec3,
        /// Step to the next row.
        b: DVec3,
    },
    /// Centre of projection in the image plane, so that every ray would lie in the plane.
    #[error("the centre of projection {0} lies in the image plane; move it out")]
    CentreInPlane(DVec4),
    /// Range of depths that is empty or impossible.
    #[error(
        "depths from {near} to {far}: far must be above near, near above 0 where rays meet, and far finite where they are parallel"
    )]
    Depths {
        /// Distance of the near plane.
        near: f64,
        /// Distance of the far plane; infinite if there is none.
        far: f64,
    },
    /// Image without pixels.
    #[error("an image of {width} x {height} pixels; both must be at least 1")]
    Size {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// Matrix that belongs to no pinhole; holds the reason.
    #[error("the projection matrix is none of a pinhole: {0}")]
    Matrix(&'static str),
    /// Camera that can't exist.
    #[error(transparent)]
    Camera(#[from] CameraError),
}

/// Sine of the angle between a plane and a ray, below which the ray counts as parallel to the plane: no digit of (u, v)
/// would be right.
const FLAT: f64 = 1e-12;

impl Pinhole {
    /// Makes a pinhole from world-space vectors: `centre` C, homogeneous with w = 1 or 0; `origin` O, the upper left
    /// corner of the image; `a` and `b`, the steps to the next pixel of a row and to the next row. Depths from `near`
    /// to `far` are visible. Depths are distances along the plane's normal: from C, or for parallel rays from the
    /// plane.
    ///
    /// # Errors
    /// [`PinholeError`] if a number is not finite, C is neither point nor direction or lies in the plane, a and b span
    /// no plane, or nothing lies between near and far.
    pub fn new(
        centre: DVec4,
        origin: DVec3,
        a: DVec3,
        b: DVec3,
        near: f64,
        far: Option<f64>,
    ) -> Result<Self, PinholeError> {
        let finite = [
            (centre.is_finite(), "the centre of projection"),
            (origin.is_finite(), "the corner O"),
            (a.is_finite(), "the step a"),
            (b.is_finite(), "the step b"),
            (near.is_finite(), "the near distance"),
            (far.is_none_or(f64::is_finite), "the far distance"),
        ];
        if let Some((_, name)) = finite.into_iter().find(|(finite, _)| !finite) {
            return Err(PinholeError::NotFinite(name));
        }
        let parallel = centre.w == 0.0;
        if !(centre.w == 1.0 || parallel && centre.xyz() != DVec3::ZERO) {
            return Err(PinholeError::Centre(centre));
        }
        let ordered = far.is_none_or(|far| far > near);
        if !ordered || (if parallel { far.is_none() } else { near <= 0.0 }) {
            let far = far.unwrap_or(f64::INFINITY);
            return Err(PinholeError::Depths { near, far });
        }
        let cross = a.cross(b);
        if cross.length() <= FLAT * a.length() * b.length() {
            return Err(PinholeError::Plane { a, b });
        }
        // The vector from C to O; for parallel rays their direction.
        let ahead = centre.w * origin - centre.xyz();
        let upright = cross.normalize();
        let height = ahead.dot(upright);
        if height.abs() <= FLAT * ahead.length() {
            return Err(PinholeError::CentreInPlane(centre));
        }
        let normal = upright * height.signum();
        let inverse = if parallel {
            DMat3::from_cols(a, b, ahead).inverse()
        } else {
            DMat3::from_cols(a, b, ahead).inverse() * height.abs()
        };
        if !inverse.is_finite() {
            return Err(PinholeError::Plane { a, b });
        }
        Ok(Self { centre, origin, a, b, near, far, inverse, normal })
    }

    /// Makes the pinhole of a camera and an image of `size` = [width, height] in pixels.
    ///
    /// # Errors
    /// [`PinholeError`] if the size is 0, or a number of the camera is not finite or out of range.
    pub fn from_camera(camera: &Camera, size: [u32; 2]) -> Result<Self, PinholeError> {
        let [width, height] = size;
        if width == 0 || height == 0 {
            return Err(PinholeError::Size { width, height });
        }
        let [width, height] = size.map(f64::from);
        let [right, up, back] = [camera.axes.x_axis, camera.axes.y_axis, camera.axes.z_axis];
        // Half of the image's height on the plane, and the distance of the plane from the eye.
        let (half_height, distance) = match camera.projection {
            Projection::Perspective { fov, .. } => ((0.5 * fov).tan(), 1.0),
            Projection::Orthographic { half_height, .. } => (half_height, 0.0),
        };
        let pixel = 2.0 * half_height / height;
        let (a, b) = (right * pixel, up * -pixel);
        let middle = camera.eye - back * distance;
        let corner = (camera.shift - DVec2::splat(0.5)) * DVec2::new(width, height);
        let origin = middle + a * corner.x + b * corner.y;
        match camera.projection {
            Projection::Perspective { near, far, .. } => Self::new(camera.eye.extend(1.0), origin, a, b, near, far),
            Projection::Orthographic { near, far, .. } => Self::new(back.extend(0.0), origin, a, b, near, Some(far)),
        }
    }

    /// Makes a pinhole at `eye` that looks at `target`; the image's upward direction is as close to `up` as possible.
    /// `fov_degrees` is the vertical field of view of an image of `size` = [width, height] in pixels, `near` the
    /// distance of the near plane.
    ///
    /// # Errors
    /// [`PinholeError`] if the vectors give no direction, or the field of view is not between 0 and 180 degrees;
    /// otherwise as [`Pinhole::new`].
    pub fn from_field_of_view(
        eye: DVec3,
        target: DVec3,
        up: DVec3,
        fov_degrees: f64,
        near: f64,
        size: [u32; 2],
    ) -> Result<Self, PinholeError> {
        let camera = Camera::look_at(eye, target, up, fov_degrees, near)?;
        Self::from_camera(&camera, size)
    }

    /// Makes the pinhole of a matrix from world space to clip space, for an image of `size` = [width, height] in
    /// pixels. Clip space is that of [`Camera`]: y up, depth from 1 at the near plane to 0 at the far plane.
    ///
    /// # Errors
    /// [`PinholeError`] if the matrix is singular, or its near and far planes are not parallel to the image plane.
    pub fn from_projection_matrix(matrix: DMat4, size: [u32; 2]) -> Result<Self, PinholeError> {
        let [width, height] = size;
        if width == 0 || height == 0 {
            return Err(PinholeError::Size { width, height });
        }
        if !matrix.is_finite() {
            return Err(PinholeError::NotFinite("the projection matrix"));
        }
        let [x, y, depth, w] = [matrix.row(0), matrix.row(1), matrix.row(2), matrix.row(3)];
        // From clip space to pixels: u = width (x + w) / 2, v = height (w - y) / 2.
        let u = 0.5 * f64::from(width) * (x + w);
        let v = 0.5 * f64::from(height) * (w - y);
        if w.xyz().length() > FLAT * x.xyz().length().max(y.xyz().length()) {
            perspective_of_rows(u, v, depth, w)
        } else {
            parallel_of_rows(u, v, depth, w)
        }
    }

    /// Centre of projection C, homogeneous: w is 1, or 0 if rays are parallel.
    #[must_use]
    pub fn centre(&self) -> DVec4 {
        self.centre
    }

    /// Upper left corner O of the image in world space.
    #[must_use]
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Steps a and b on the image plane, in world space: to the next pixel of a row, and to the next row.
    #[must_use]
    pub fn steps(&self) -> [DVec3; 2] {
        [self.a, self.b]
    }

    /// Whether rays are parallel.
    #[must_use]
    pub fn is_parallel(&self) -> bool {
        self.centre.w == 0.0
    }

    /// Point in which the rays meet. Parallel rays do not meet; for these, the point is O, and depths are measured from
    /// the image plane.
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        if self.is_parallel() { self.origin } else { self.centre.xyz() }
    }

    /// Unit normal of the image plane that points away from C; depths are distances along it.
    #[must_use]
    pub fn direction(&self) -> DVec3 {
        self.normal
    }

    /// Unit vector towards C for parallel rays, otherwise `None`.
    #[must_use]
    pub fn parallel_direction(&self) -> Option<DVec3> {
        self.is_parallel().then(|| self.centre.xyz().normalize())
    }

    /// Distance of the near plane.
    #[must_use]
    pub fn near(&self) -> f64 {
        self.near
    }

    /// Distance of the far plane; `None` for infinity.
    #[must_use]
    pub fn far(&self) -> Option<f64> {
        self.far
    }

    /// Ray through a location, which is in pixels of the image plane.
    #[must_use]
    pub fn ray(&self, uv: DVec2) -> Ray {
        let point = self.origin + self.a * uv.x + self.b * uv.y;
        let direction = (self.centre.w * point - self.centre.xyz()).normalize();
        let start = if self.is_parallel() { point } else { self.centre.xyz() };
        Ray { start, direction }
    }

    /// Location of a world-space point in pixels of the image plane; `None` for points beside or behind C.
    #[must_use]
    pub fn project(&self, point: DVec3) -> Option<DVec2> {
        let p = self.inverse * (point - self.eye());
        if self.is_parallel() {
            return Some(p.truncate());
        }
        (p.z > 0.0).then(|| p.truncate() / p.z)
    }

    /// Location of a direction from C in pixels of the image plane; `None` for directions away from the plane, and for
    /// parallel rays.
    #[must_use]
    pub fn project_direction(&self, direction: DVec3) -> Option<DVec2> {
        let p = self.inverse * direction;
        (!self.is_parallel() && p.z > 0.0).then(|| p.truncate() / p.z)
    }

    /// Matrix from positions relative to `origin` to (u w, v w, depth w, w). (u, v) are pixels relative to the location
    /// `window`, depth runs from 1 at the near plane to 0 at the far plane, and w is the distance from C (1 for
    /// parallel rays). The computation is in double precision, so that large coordinates of `origin` and C cancel
    /// before anything is rounded.
    #[must_use]
    pub fn pixel_matrix(&self, origin: DVec3, window: DVec2) -> DMat4 {
        let from_eye = origin - self.eye();
        let row = |r: DVec3| r.extend(r.dot(from_eye));
        let [u, v, third] = [0, 1, 2].map(|i| row(self.inverse.row(i)));
        let distance = row(self.normal);
        let one = DVec4::W;
        let w = if self.is_parallel() { one } else { third };
        let depth = match (self.is_parallel(), self.far) {
            (true, far) => {
                let far = far.unwrap_or(f64::INFINITY);
                (far * one - distance) / (far - self.near)
            }
            (false, Some(far)) => self.near * (far * one - distance) / (far - self.near),
            (false, None) => self.near * one,
        };
        DMat4::from_cols(u - window.x * w, v - window.y * w, depth, w).transpose()
    }
}

fn perspective_of_rows(u: DVec4, v: DVec4, depth: DVec4, w: DVec4) -> Result<Pinhole, PinholeError> {
    // The rows give u w, v w and w for points relative to C; C is the point for which all three vanish.
    let rows = DMat3::from_cols(u.xyz(), v.xyz(), w.xyz()).transpose();
    let inverse = rows.inverse();
    if !inverse.is_finite() {
        return Err(PinholeError::Matrix("rows x, y and w are not independent"));
    }
    let centre = -(inverse * DVec3::new(u.w, v.w, w.w));
    // Depth and w are linear in the distance from C: depth w = slope * distance + its value at C, w = scale *
    // distance.
    let scale = w.xyz().length();
    let slope = depth.xyz().dot(w.xyz()) / scale;
    if (depth.xyz() - w.xyz() * (slope / scale)).length() > 1e-9 * scale {
        return Err(PinholeError::Matrix("the near plane is not parallel to the image plane"));
    }
    let at_centre = depth.xyz().dot(centre) + depth.w;
    let near = at_centre / (scale - slope);
    let far = (slope < -1e-15 * scale).then(|| at_centre / -slope);
    // The image plane is placed at distance 1.
    let [a, b, corner] = [inverse.x_axis, inverse.y_axis, inverse.z_axis].map(|c| c * scale);
    Pinhole::new(centre.extend(1.0), centre + corner, a, b, near, far)
}

fn parallel_of_rows(u: DVec4, v: DVec4, depth: DVec4, w: DVec4) -> Result<Pinhole, PinholeError> {
    let rows = DMat3::from_cols(u.xyz(), v.xyz(), depth.xyz()).transpose();
    let inverse = rows.inverse() * w.w;
    if !inverse.is_finite() || w.w == 0.0 {
        return Err(PinholeError::Matrix("rows x, y and depth are not independent"));
    }
    // The image plane is the near plane, where depth is 1; a step of -1 in depth leads to the far plane.
    let offsets = DVec3::new(u.w, v.w, depth.w) / w.w;
    let origin = inverse * (DVec3::Z - offsets);
    let normal = inverse.x_axis.cross(inverse.y_axis).normalize();
    let far = inverse.z_axis.dot(normal).abs();
    let centre = inverse.z_axis.normalize().extend(0.0);
    Pinhole::new(centre, origin, inverse.x_axis, inverse.y_axis, 0.0, Some(far))
}
