//! Maps from output pixels to sampling locations.

use glam::{DMat2, DVec2};

/// Where each place of the output looks on an image plane. Places of the output are (x, y) in pixels, (0, 0) its upper
/// left corner, so that the centre of the first pixel is (0.5, 0.5); locations are (u, v) in pixels of the plane.
pub trait LocationMap: Sync {
    /// The location that a place of the output looks at.
    fn location(&self, place: DVec2) -> DVec2;

    /// The derivative of the location: its columns are the changes of (u, v) for each output column and row.
    fn jacobian(&self, place: DVec2) -> DMat2;
}
