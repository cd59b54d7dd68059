//! Maps from output pixels to sampling locations.

use glam::{DMat2, DVec2};

/// Map from places of the output to locations on an image plane. Places are (x, y) in pixels of the output, locations
/// (u, v) in pixels of the plane. The upper left corner is (0, 0), so that the centre of the first pixel is (0.5, 0.5).
pub trait LocationMap: Sync {
    /// The location that a place of the output looks at.
    fn location(&self, place: DVec2) -> DVec2;

    /// The derivative of the location: its columns are the changes of (u, v) for each output column and row.
    fn jacobian(&self, place: DVec2) -> DMat2;
}
