//! Regularly sampled rectangle of an image plane.

use crate::camera::LocationMap;
use glam::{DMat2, DVec2};

/// Rectangle of an image plane that is sampled at regular distances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Number of columns and rows.
    pub size: [u32; 2],
    /// Location of the upper left corner, in pixels of the plane.
    pub corner: [f64; 2],
    /// Distance between columns and between rows, in pixels of the plane.
    pub step: f64,
}

impl LocationMap for Window {
    fn location(&self, place: DVec2) -> DVec2 {
        DVec2::from(self.corner) + self.step * place
    }

    fn jacobian(&self, _: DVec2) -> DMat2 {
        DMat2::from_diagonal(DVec2::splat(self.step))
    }
}
