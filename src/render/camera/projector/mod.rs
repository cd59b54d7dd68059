//! Several projectors that together show one picture.
//!
//! ```text
//!   projector 0        projector 1            image plane: what the wall shows, in pixels
//!   ┌──────────┐      ┌──────────┐           ┌───────────────────────┐
//!   │ (x, y)   │      │          │           │ ╲────────┬─┬─────────╱│
//!   │   ·──────┼──────┼──────────┼───────────┼──▶·      │ │         ││
//!   └──────────┘      └──────────┘           │ ╱────────┴─┴─────────╲│
//!                                            └──────────overlap──────┘
//! ```
//!
//! A projector's pixel (x, y) lights the location (u, v) of the image plane; calibration finds which. The picture is
//! then sampled exactly there: a projector is an offset sampling set of the picture's pinhole, and no picture is warped.
//! Where projectors overlap their light adds up, so that each is dimmed by a weight; the weights of all add up to 1.

mod eigen;
mod error;
mod homography;
mod warp;

pub use error::ProjectorError;
pub use homography::{Correspondence, Homography};
pub use warp::WarpMap;

use super::LocationMap;
use super::set::{Sample, SamplingSet};
use glam::{DMat2, DVec2};
use rayon::prelude::*;

/// A calibrated projector.
#[derive(Clone, Debug, PartialEq)]
pub struct Projector {
    size: [u32; 2],
    map: ProjectorMap,
}

/// Map from a projector's pixels to locations on the image plane.
#[derive(Clone, Debug, PartialEq)]
pub enum ProjectorMap {
    /// Homography, for a plane wall and a lens that keeps lines straight.
    Planar(Homography),
    /// Dense map, for any other wall or lens.
    Dense(WarpMap),
}

impl Projector {
    /// Makes a projector of `size` = [width, height] pixels in front of a plane wall.
    ///
    /// # Errors
    /// [`ProjectorError`] if it has no pixels, or one of them is behind the homography's horizon.
    pub fn planar(size: [u32; 2], map: Homography) -> Result<Self, ProjectorError> {
        if size.contains(&0) {
            return Err(ProjectorError::Size { size, found: 0 });
        }
        let [width, height] = size.map(f64::from);
        // The distance from the horizon is linear in the place, so that its minimum is in a corner.
        let corners = [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)];
        if !corners.into_iter().all(|corner| map.is_ahead(corner.into())) {
            return Err(ProjectorError::Horizon(size));
        }
        let map = ProjectorMap::Planar(map);
        Ok(Self { size, map })
    }

    /// Makes a projector of `size` = [width, height] pixels from the location of each pixel's centre, row by row; NaN
    /// for a pixel that lights nothing.
    ///
    /// # Errors
    /// As [`WarpMap::new`].
    pub fn dense(size: [u32; 2], locations: Vec<[f64; 2]>) -> Result<Self, ProjectorError> {
        let map = ProjectorMap::Dense(WarpMap::new(size, locations)?);
        Ok(Self { size, map })
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Map of the projector.
    #[must_use]
    pub fn map(&self) -> &ProjectorMap {
        &self.map
    }

    /// Location on the image plane that a pixel lights; `None` if it lights nothing.
    #[must_use]
    pub fn location(&self, row: u32, col: u32) -> Option<DVec2> {
        match &self.map {
            ProjectorMap::Planar(map) => Some(map.location(DVec2::new(f64::from(col) + 0.5, f64::from(row) + 0.5))),
            ProjectorMap::Dense(map) => map.at(row, col),
        }
    }

    /// Jacobian of the location at a place on the projector in pixels: its change per column and per row; `None` if
    /// the place lights nothing.
    #[must_use]
    pub fn jacobian(&self, place: DVec2) -> Option<DMat2> {
        match &self.map {
            ProjectorMap::Planar(map) => Some(map.jacobian(place)),
            ProjectorMap::Dense(map) => map.jacobian(place),
        }
    }

    /// Place on the projector in pixels that lights a location; `None` if no place does.
    #[must_use]
    pub fn place(&self, location: DVec2) -> Option<DVec2> {
        let place = match &self.map {
            ProjectorMap::Planar(map) => map.inverse(location),
            ProjectorMap::Dense(map) => map.inverse(location),
        }?;
        let [width, height] = self.size.map(f64::from);
        let inside = (0.0..=width).contains(&place.x) && (0.0..=height).contains(&place.y);
        inside.then_some(place)
    }

    /// Sampling set of the projector's frame: the locations of its lit pixels, row by row.
    ///
    /// # Errors
    /// [`ProjectorError`] if a location is too far away, or no pixel is lit.
    pub fn set(&self) -> Result<SamplingSet, ProjectorError> {
        const LEAF_SAMPLES: usize = 32;
        let map = match &self.map {
            ProjectorMap::Planar(map) => return Ok(SamplingSet::mapped(self.size, map)?),
            ProjectorMap::Dense(map) => map,
        };
        let [width, height] = self.size;
        let cells = (0..height).flat_map(|row| (0..width).map(move |col| (row, col)));
        let samples: Vec<_> = cells
            .filter_map(|(row, col)| {
                let uv = map.at(row, col)?.to_array();
                Some(Sample { uv, row, col })
            })
            .collect();
        Ok(SamplingSet::offset(self.size, samples.clone())
            .or_else(|_| SamplingSet::no_pattern(self.size, samples, None, LEAF_SAMPLES))?)
    }

    /// Depth of a place inside of the projector's frame: 0 on the border, 1 in the middle.
    fn depth(&self, place: DVec2) -> f64 {
        let size = DVec2::new(f64::from(self.size[0]), f64::from(self.size[1]));
        (2.0 * place.min(size - place) / size).min_element().max(0.0)
    }
}

/// Blending weights of 0 to 1 for each pixel of each projector, row by row. A pixel's weight is its depth inside of
/// its projector's frame / the sum of the depths in all projectors that light the same location. Weights fall
/// continuously to 0 at the border of an overlap, and add up to 1 at each location; where a projector shines alone its
/// weight is 1.
#[must_use]
pub fn blend_weights(projectors: &[Projector]) -> Vec<Vec<f32>> {
    let weights = |own: &Projector| {
        let [width, height] = own.size;
        let row = |row: u32| {
            (0..width).into_par_iter().map(move |col| {
                let place = DVec2::new(f64::from(col) + 0.5, f64::from(row) + 0.5);
                let Some(location) = own.location(row, col) else {
                    return 0.0;
                };
                let others = projectors.iter().filter(|other| !std::ptr::eq(*other, own));
                let others: f64 = others.filter_map(|other| Some(other.depth(other.place(location)?))).sum();
                let depth = own.depth(place);
                (depth / (depth + others)) as f32
            })
        };
        (0..height).into_par_iter().flat_map(row).collect()
    };
    projectors.iter().map(weights).collect()
}
