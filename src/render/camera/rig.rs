//! Several pinholes that share their centre: together they see what no single plane can.
//!
//! ```text
//!            ┌────────┐
//!            │  up    │            a cube of six pinholes around C; each sees 90 x 90 degrees
//!   ┌────────┼────────┼────────┬────────┐
//!   │ left   │ front  │ right  │ back   │
//!   └────────┼────────┼────────┴────────┘
//!            │ down   │
//!            └────────┘
//! ```
//!
//! Every direction belongs to exactly one pinhole: the first of those whose axes are nearest to the direction.

use super::set::{Sample, SamplingSet, SetError};
use super::{Pinhole, PinholeError};
use glam::{DMat2, DMat3, DVec2, DVec3};

/// Pinholes with a common centre of projection.
#[derive(Clone, Debug, PartialEq)]
pub struct Rig {
    pinholes: Vec<Pinhole>,
}

/// Error: pinholes that make no rig, or directions that a rig can't sample.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RigError {
    /// Rig without pinholes.
    #[error("a rig without pinholes; give at least one")]
    Empty,
    /// Pinhole with parallel rays, which has no centre to share; holds its index.
    #[error("pinhole {0} of the rig has parallel rays; all must meet in one centre")]
    Parallel(usize),
    /// Pinhole whose centre differs from that of the first; holds its index.
    #[error("pinhole {0} of the rig has another centre than the first; all must have the same")]
    Centre(usize),
    /// Pinhole that can't exist.
    #[error(transparent)]
    Pinhole(#[from] PinholeError),
    /// Locations that make no sampling set.
    #[error(transparent)]
    Set(#[from] SetError),
}

/// Cosine of the largest angle between a sampled ray and the axis of its pinhole, about 80 degrees. A pixel at that
/// angle covers 30 times as many pixels of the plane as one on the axis.
const FLATTEST: f64 = 0.17;

/// Step for the numerical differentiation of Jacobians, in pixels.
const STEP: f64 = 1.0 / 64.0;

impl Rig {
    /// Makes a rig of pinholes with a common centre.
    ///
    /// # Errors
    /// [`RigError`] if there are no pinholes, or one has parallel rays or another centre than the first.
    pub fn new(pinholes: Vec<Pinhole>) -> Result<Self, RigError> {
        let Some(first) = pinholes.first() else {
            return Err(RigError::Empty);
        };
        for (index, pinhole) in pinholes.iter().enumerate() {
            if pinhole.is_parallel() {
                return Err(RigError::Parallel(index));
            }
            if pinhole.centre() != first.centre() {
                return Err(RigError::Centre(index));
            }
        }
        Ok(Self { pinholes })
    }

    /// Makes six pinholes around `eye`: right, left, up, down, back and front of `axes` (columns right, up and
    /// backward). Each has a plane of `side` x `side` pixels with a field of view of 90 degrees, and its near plane at
    /// the distance `near`.
    ///
    /// # Errors
    /// [`RigError`] if a number is not finite or `near` is not above 0.
    pub fn cube(eye: DVec3, axes: DMat3, side: u32, near: f64) -> Result<Self, RigError> {
        if side == 0 {
            let (width, height) = (side, side);
            return Err(PinholeError::Size { width, height }.into());
        }
        let [right, up, back] = [axes.x_axis, axes.y_axis, axes.z_axis];
        // Forward direction and the image's right for each face; they determine the third axis.
        let faces = [(right, back), (-right, -back), (up, right), (-up, right), (back, -right), (-back, right)];
        let pixel = 2.0 / f64::from(side);
        let pinhole = |(forward, a): (DVec3, DVec3)| {
            let b = forward.cross(a);
            Pinhole::new(eye.extend(1.0), eye + forward - a - b, a * pixel, b * pixel, near, None)
        };
        let pinholes: Result<Vec<_>, _> = faces.into_iter().map(pinhole).collect();
        Self::new(pinholes?)
    }

    /// Pinholes of the rig.
    #[must_use]
    pub fn pinholes(&self) -> &[Pinhole] {
        &self.pinholes
    }

    /// Index of the pinhole to which a direction belongs, and the direction's location there in pixels; `None` if the
    /// direction is more than about 80 degrees from the axes of all pinholes.
    #[must_use]
    pub fn locate(&self, direction: DVec3) -> Option<(usize, DVec2)> {
        let mut nearest = (0, f64::NEG_INFINITY);
        for (index, pinhole) in self.pinholes.iter().enumerate() {
            let cosine = pinhole.direction().dot(direction);
            if cosine > nearest.1 {
                nearest = (index, cosine);
            }
        }
        let (index, cosine) = nearest;
        if cosine <= FLATTEST * direction.length() {
            return None;
        }
        let location = self.pinholes.get(index)?.project_direction(direction)?;
        Some((index, location))
    }

    /// Makes the sampling sets of an output of `size` = [columns, rows]: one for each pinhole, `None` for a pinhole
    /// without samples. `look` gives the direction for a place of the output in pixels, or `None` where the output is
    /// empty. Jacobians are differences on the plane of the pixel's own pinhole, so that they have no seams between
    /// pinholes.
    ///
    /// # Errors
    /// [`RigError`] if the output has no cells or too many, or a location is not finite or too far away.
    pub fn sets(
        &self,
        size: [u32; 2],
        look: impl Fn(DVec2) -> Option<DVec3>,
    ) -> Result<Vec<Option<SamplingSet>>, RigError> {
        let mut samples = vec![Vec::new(); self.pinholes.len()];
        for row in 0..size[1] {
            for col in 0..size[0] {
                let place = DVec2::new(f64::from(col) + 0.5, f64::from(row) + 0.5);
                let Some((index, uv)) = look(place).and_then(|direction| self.locate(direction)) else {
                    continue;
                };
                let along = |step: DVec2| {
                    let at = |place: DVec2| {
                        let direction = look(place)?;
                        self.pinholes.get(index)?.project_direction(direction)
                    };
                    match (at(place - step), at(place + step)) {
                        (Some(before), Some(after)) => (after - before) / (2.0 * STEP),
                        (None, Some(after)) => (after - uv) / STEP,
                        (Some(before), None) => (uv - before) / STEP,
                        (None, None) => step / STEP,
                    }
                };
                let jacobian = DMat2::from_cols(along(DVec2::X * STEP), along(DVec2::Y * STEP));
                let uv = uv.to_array();
                if let Some(samples) = samples.get_mut(index) {
                    samples.push((Sample { uv, row, col }, jacobian));
                }
            }
        }
        let set = |samples: Vec<_>| match samples.is_empty() {
            true => Ok(None),
            false => SamplingSet::with_jacobians(size, samples).map(Some),
        };
        Ok(samples.into_iter().map(set).collect::<Result<_, _>>()?)
    }
}
