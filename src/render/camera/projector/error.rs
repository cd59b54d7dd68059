//! Errors of calibrating a projector.

use crate::camera::set::SetError;

/// Error: correspondences or maps that calibrate no projector.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProjectorError {
    /// Fewer than four correspondences; holds their number. A homography has eight unknowns, and each correspondence
    /// determines two.
    #[error("{0} correspondences; a homography takes at least 4")]
    TooFew(usize),
    /// Coordinate that is NaN or infinite; holds the index of its correspondence.
    #[error("correspondence {0} is not finite")]
    NotFinite(usize),
    /// Points on one line, which leave the homography undetermined; names the plane that they are on.
    #[error(
        "the points on the {0} are on one line or too nearly so; give some that span the area, no three of four on a line"
    )]
    Collinear(&'static str),
    /// Correspondences that disagree: too few of them fit one homography.
    #[error(
        "only {agreeing} of {count} correspondences agree to {tolerance} pixels on a homography; are they of a plane?"
    )]
    Outliers {
        /// Number of correspondences that agree.
        agreeing: usize,
        /// Number of all correspondences.
        count: usize,
        /// Tolerance in pixels of the image plane.
        tolerance: f64,
    },
    /// Projector with a corner that looks behind the horizon of the plane; holds its width and height in pixels.
    #[error(
        "the homography has its horizon inside of the projector's {} x {} pixels; the correspondences or the size are wrong",
        .0[0], .0[1]
    )]
    Horizon([u32; 2]),
    /// Projector without pixels, or with a map that does not have one location for each pixel.
    #[error("a projector of {} x {} pixels and a map of {found} locations; there must be one for each pixel", .size[0], .size[1])]
    Size {
        /// Width and height in pixels.
        size: [u32; 2],
        /// Number of locations.
        found: usize,
    },
    /// Dense map without any location.
    #[error("the map has too few locations; each pixel that lights the wall needs one")]
    Dark,
    /// Locations that make no sampling set.
    #[error(transparent)]
    Set(#[from] SetError),
}
