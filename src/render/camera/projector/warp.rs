//! Dense maps of projectors whose lenses or walls bend straight lines.

use super::ProjectorError;
use super::homography::{Correspondence, Homography};
use glam::{DMat2, DVec2};

/// Dense map: a location on the image plane for each pixel of a projector.
#[derive(Clone, Debug, PartialEq)]
pub struct WarpMap {
    size: [u32; 2],
    /// Locations row by row; NaN for a pixel that lights nothing.
    locations: Vec<DVec2>,
    /// Homography that approximates the map, for first guesses of places.
    rough: Homography,
}

/// Number of pixels along each side to which the rough homography is fitted.
const FITTED: u32 = 24;

/// Largest distance, in pixels of the image plane, between the location that [`WarpMap::inverse`] is given and the
/// location of the place that it finds.
const NEAR: f64 = 1e-6;

impl WarpMap {
    /// Makes a map from the locations of the centres of `size` = [width, height] pixels, row by row; NaN for a pixel
    /// that lights nothing.
    ///
    /// # Errors
    /// [`ProjectorError`] if the number of locations is not that of the pixels, or too few of them are finite or span
    /// an area.
    pub fn new(size: [u32; 2], locations: Vec<[f64; 2]>) -> Result<Self, ProjectorError> {
        let [width, height] = size;
        let found = locations.len();
        if found == 0 || found as u64 != u64::from(width) * u64::from(height) {
            return Err(ProjectorError::Size { size, found });
        }
        let locations: Vec<_> = locations.into_iter().map(DVec2::from).collect();
        let step = |side: u32| (side / FITTED).max(1) as usize;
        let mut pairs = Vec::new();
        for row in (0..height).step_by(step(height)) {
            for col in (0..width).step_by(step(width)) {
                let index = row as usize * width as usize + col as usize;
                let location = locations.get(index).filter(|location| location.is_finite());
                pairs.extend(location.map(|location| Correspondence {
                    place: [f64::from(col) + 0.5, f64::from(row) + 0.5],
                    location: location.to_array(),
                }));
            }
        }
        if pairs.len() < 4 {
            return Err(ProjectorError::Dark);
        }
        let rough = Homography::fit(&pairs)?;
        Ok(Self { size, locations, rough })
    }

    /// Location of a pixel's centre; `None` if the pixel lights nothing.
    #[must_use]
    pub fn at(&self, row: u32, col: u32) -> Option<DVec2> {
        let index = row as usize * self.size[0] as usize + col as usize;
        let location = self.locations.get(index).copied();
        location.filter(|location| location.is_finite())
    }

    /// Place that lights a location, found by Newton's method on the bilinear map between the centres of pixels;
    /// `None` if no lit pixel lights it.
    #[must_use]
    pub fn inverse(&self, location: DVec2) -> Option<DVec2> {
        let [width, height] = self.size.map(f64::from);
        let size = DVec2::new(width, height);
        let mut place = self.rough.inverse(location)?.clamp(DVec2::ZERO, size);
        for _ in 0..30 {
            let (here, slope) = self.bilinear(place)?;
            if here.distance(location) < NEAR {
                return Some(place);
            }
            let next = place + slope.inverse() * (location - here);
            // A step beyond the border is clamped to it; the search ends if that does not lead to a solution.
            let next = next.is_finite().then(|| next.clamp(DVec2::ZERO, size))?;
            if next == place {
                return None;
            }
            place = next;
        }
        None
    }

    /// Jacobian of the location at a place: its change per column and per row; `None` if the pixels around the place
    /// light nothing.
    #[must_use]
    pub fn jacobian(&self, place: DVec2) -> Option<DMat2> {
        self.bilinear(place).map(|(_, slope)| slope)
    }

    /// Location of a place and its Jacobian, bilinear between the centres of four pixels. The half pixel along the
    /// border is extrapolated.
    fn bilinear(&self, place: DVec2) -> Option<(DVec2, DMat2)> {
        let [width, height] = self.size;
        let last = DVec2::new(f64::from(width), f64::from(height)) - DVec2::splat(2.0);
        let from_first = place - DVec2::splat(0.5);
        let cell = from_first.floor().clamp(DVec2::ZERO, last.max(DVec2::ZERO));
        let [x, y] = (from_first - cell).to_array();
        let at = |right: u32, down: u32| self.at(cell.y as u32 + down, cell.x as u32 + right);
        let [a, b, c, d] = [at(0, 0)?, at(1, 0)?, at(0, 1)?, at(1, 1)?];
        let location = (a * (1.0 - x) + b * x) * (1.0 - y) + (c * (1.0 - x) + d * x) * y;
        let along = (b - a) * (1.0 - y) + (d - c) * y;
        let down = (c - a) * (1.0 - x) + (d - b) * x;
        Some((location, DMat2::from_cols(along, down)))
    }
}
