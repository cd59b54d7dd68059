//! Maps from output pixels to sampling locations.

use glam::{DMat2, DVec2};

/// Map from places of the output to locations on an image plane. Places are (x, y) in pixels of the output, locations
/// (u, v) in pixels of the plane. The upper left corner is (0, 0), so that the centre of the first pixel is (0.5, 0.5).
pub trait LocationMap: Sync {
    /// The location for a place of the output.
    fn location(&self, place: DVec2) -> DVec2;

    /// The Jacobian of the location: its columns are the changes of (u, v) per output column and per output row.
    fn jacobian(&self, place: DVec2) -> DMat2;
}
