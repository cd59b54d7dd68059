//! Continuous local zooming: focus plus context in one image.
//!
//! ```text
//!   ┌───────────────────────────┐   c   centre of the region, in pixels of the output
//!   │       outside             │   r   its radius there
//!   │      . ─ ─ ─ .            │   m   multiplicity: inside, locations are the regular ones scaled about c by m,
//!   │    /   ┌───┐   \  r/m     │       so that things look 1/m times as large
//!   │   ╎   (  c──)───╎         │
//!   │    \   └─r─┘   /          │   transition: r < distance <= r + r/m
//!   │      ` ─ ─ ─ ´            │
//!   └───────────────────────────┘
//! ```
//!
//! An output pixel p at the distance q from the centre, in radii of the region, looks at c + (s(q) / q) (p - c). Inside,
//! `s` is m q, and outside `s` is q. In the transition, either the displacement of locations is linear, or their rate is
//! continuous (see [`Transition`]). For a circle q = |p - c| / r; for a rectangle of half sides RX and RY,
//! q = max(|x| / RX, |y| / RY).
//!
//! The factor s(q) / q lies in [m, 1], so that each pixel looks at a location between itself and the centre. If the
//! centre is inside the image, all locations are.

mod profile;
mod window;

pub use profile::Transition;
pub use window::Window;

use super::LocationMap;
use glam::{DMat2, DVec2};
use profile::Profile;
use serde::{Deserialize, Serialize};

/// Outline of a zoomed region.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Shape {
    /// Ellipse whose semi-axes are the region's radii; a circle if they are equal.
    #[default]
    Circle,
    /// Rectangle whose half sides are the region's radii.
    Rectangle,
}

/// Region of the output that is enlarged.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ZoomRegion {
    /// Centre in pixels of the output; the upper left corner is (0, 0).
    pub center: [f64; 2],
    /// Radii along x and y in pixels of the output, above 0.
    pub radius: [f64; 2],
    /// Multiplicity m, above 0 and at most 1: the inside is enlarged by 1/m.
    pub multiplicity: f64,
    /// Outline of the region.
    pub shape: Shape,
    /// Transition between the region and its surroundings.
    pub transition: Transition,
}

/// Error: regions that make no zoom.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ZoomError {
    /// Multiplicity that is not above 0 and at most 1. Above 1 the region would shrink, and above the square root of 2
    /// the map would fold.
    #[error("a multiplicity of {0}: it must be above 0 and at most 1; 0.5 shows things twice as large")]
    Multiplicity(f64),
    /// Radii that are not finite, or not above 0.
    #[error("a radius of {} x {} pixels: both must be above 0", .0[0], .0[1])]
    Radius([f64; 2]),
    /// Centre that is not finite.
    #[error("a centre at ({}, {}): both must be finite", .0[0], .0[1])]
    Center([f64; 2]),
    /// Zoom without any region.
    #[error("no region to zoom; give at least one")]
    Empty,
}

impl ZoomRegion {
    fn check(&self) -> Result<(), ZoomError> {
        if !self.center.iter().all(|v| v.is_finite()) {
            return Err(ZoomError::Center(self.center));
        }
        if !self.radius.iter().all(|v| v.is_finite() && *v > 0.0) {
            return Err(ZoomError::Radius(self.radius));
        }
        if !(self.multiplicity > 0.0 && self.multiplicity <= 1.0) {
            return Err(ZoomError::Multiplicity(self.multiplicity));
        }
        Ok(())
    }

    fn profile(&self) -> Profile {
        Profile::new(self.multiplicity, self.transition)
    }

    /// Distance of a place from the centre, in radii of the region, and the gradient of this distance.
    fn distance(&self, place: DVec2) -> (f64, DVec2) {
        let scaled = (place - DVec2::from(self.center)) / DVec2::from(self.radius);
        let (q, gradient) = match self.shape {
            Shape::Circle => (scaled.length(), scaled.normalize_or_zero()),
            Shape::Rectangle if scaled.x.abs() >= scaled.y.abs() => {
                (scaled.x.abs(), DVec2::new(scaled.x.signum(), 0.0))
            }
            Shape::Rectangle => (scaled.y.abs(), DVec2::new(0.0, scaled.y.signum())),
        };
        (q, gradient / DVec2::from(self.radius))
    }

    /// Distance from the centre at which the transition ends, in radii of the region: 1 + 1/m.
    #[must_use]
    pub fn outer(&self) -> f64 {
        self.profile().outer()
    }

    /// Window for an ordinary image of the inside. The image has the size in pixels that the rectangle around the
    /// region has in the output.
    #[must_use]
    pub fn window(&self) -> Window {
        let size = self.radius.map(|radius| (2.0 * radius).ceil().clamp(1.0, 65_535.0));
        let half = 0.5 * self.multiplicity * DVec2::from(size);
        Window {
            size: size.map(|side| side as u32),
            corner: (DVec2::from(self.center) - half).to_array(),
            step: self.multiplicity,
        }
    }

    /// Whether a place of the output is inside the region; the transition counts as outside.
    #[must_use]
    pub fn contains(&self, place: DVec2) -> bool {
        self.distance(place).0 <= 1.0
    }

    /// Whether a place of the output is in the region's transition.
    #[must_use]
    pub fn in_transition(&self, place: DVec2) -> bool {
        let q = self.distance(place).0;
        q > 1.0 && q <= self.outer()
    }

    fn location(&self, place: DVec2) -> DVec2 {
        let [factor, _] = self.profile().factor_and_slope(self.distance(place).0);
        if factor == 1.0 {
            return place;
        }
        let center = DVec2::from(self.center);
        center + factor * (place - center)
    }

    fn inverse(&self, location: DVec2) -> DVec2 {
        let s = self.distance(location).0;
        let q = self.profile().inverse(s);
        if q == s {
            return location;
        }
        let center = DVec2::from(self.center);
        center + (q / s) * (location - center)
    }

    fn jacobian(&self, place: DVec2) -> DMat2 {
        let (q, gradient) = self.distance(place);
        let [factor, slope] = self.profile().factor_and_slope(q);
        // Derivative of factor * way: factor * identity + way * (gradient of the factor)^T.
        let scaled = DMat2::from_diagonal(DVec2::splat(factor));
        if slope == factor {
            return scaled;
        }
        let way = place - DVec2::from(self.center);
        let change = gradient * ((slope - factor) / q);
        scaled + DMat2::from_cols(way * change.x, way * change.y)
    }
}

/// Location map of several zoomed regions. The first region's map is applied to the place in the output, and the map
/// of each further region to the result.
#[derive(Clone, Debug, PartialEq)]
pub struct ZoomMap {
    regions: Vec<ZoomRegion>,
}

impl ZoomMap {
    /// Makes the map of several regions, applied in their order.
    ///
    /// # Errors
    /// [`ZoomError`] if there are none, or one of them has a multiplicity outside of (0, 1], a radius that is not
    /// above 0 or a centre that is not finite.
    pub fn new(regions: Vec<ZoomRegion>) -> Result<Self, ZoomError> {
        if regions.is_empty() {
            return Err(ZoomError::Empty);
        }
        regions.iter().try_for_each(ZoomRegion::check)?;
        Ok(Self { regions })
    }

    /// Regions in the order in which their maps are applied.
    #[must_use]
    pub fn regions(&self) -> &[ZoomRegion] {
        &self.regions
    }

    /// Place of the output that shows a location: the inverse of [`LocationMap::location`].
    #[must_use]
    pub fn inverse(&self, location: DVec2) -> DVec2 {
        let regions = self.regions.iter().rev();
        regions.fold(location, |location, region| region.inverse(location))
    }
}

impl LocationMap for ZoomMap {
    fn location(&self, place: DVec2) -> DVec2 {
        let regions = self.regions.iter();
        regions.fold(place, |place, region| region.location(place))
    }

    fn jacobian(&self, place: DVec2) -> DMat2 {
        let start = (place, DMat2::IDENTITY);
        let chain = |(place, so_far): (DVec2, DMat2), region: &ZoomRegion| {
            (region.location(place), region.jacobian(place) * so_far)
        };
        self.regions.iter().fold(start, chain).1
    }
}
