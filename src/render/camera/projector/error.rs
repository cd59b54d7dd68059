//! Why a projector can't be calibrated.

use crate::camera::set::SetError;

/// Correspondences or maps that tell nothing about a projector.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ProjectorError {
    /// A homography has eight unknowns, and each correspondence tells two.
    #[error("{0} correspondences; a homography takes at least 4")]
    TooFew(usize),
    /// A coordinate is NaN or infinite.
    #[error("correspondence {0} is not finite")]
    NotFinite(usize),
    /// Points on one line leave the homography undetermined.
    #[error(
        "the points on the {0} are on one line or too nearly so; give some that span the area, no three of four on a line"
    )]
    Collinear(&'static str),
    /// Too few agree on any homography.
    #[error(
        "only {agreeing} of {count} correspondences agree to {tolerance} pixels on a homography; are they of a plane?"
    )]
    Outliers {
        /// How many agree.
        agreeing: usize,
        /// How many there are.
        count: usize,
        /// The tolerance in pixels of the image plane.
        tolerance: f64,
    },
    /// A corner of the projector looks behind the horizon of the plane.
    #[error(
        "the homography has its horizon inside of the projector's {} x {} pixels; the correspondences or the size are wrong",
        .0[0], .0[1]
    )]
    Horizon([u32; 2]),
    /// The projector has no pixels, or the map another number.
    #[error("a projector of {} x {} pixels and a map of {found} locations; there must be one for each pixel", .size[0], .size[1])]
    Size {
        /// Width and height in pixels.
        size: [u32; 2],
        /// Number of locations.
        found: usize,
    },
    /// No pixel of a dense map has a location.
    #[error("the map has too few locations; each pixel that lights the wall needs one")]
    Dark,
    /// The locations make no sampling set.
    #[error(transparent)]
    Set(#[from] SetError),
}
