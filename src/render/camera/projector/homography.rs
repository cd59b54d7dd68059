//! Homographies: maps between planes that keep straight lines straight.

use super::ProjectorError;
use super::eigen;
use crate::camera::LocationMap;
use crate::render::random::Random;
use glam::{DMat2, DMat3, DVec2, DVec3};

/// Place on a projector and its location on the image plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correspondence {
    /// Place on the projector in pixels; (0, 0) is its upper left corner.
    pub place: [f64; 2],
    /// Location on the image plane in pixels; (0, 0) is its upper left corner.
    pub location: [f64; 2],
}

/// Projective map from places on a projector to locations on the image plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Homography {
    matrix: DMat3,
    inverse: DMat3,
}

/// Smallest ratio of the points' spread across their best line to their spread along it. Below this ratio, the points
/// count as collinear.
const THINNEST: f64 = 1e-4;

/// Ratio to the largest eigenvalue, up to which an eigenvalue counts as zero.
const ZERO: f64 = 1e-12;

impl Homography {
    /// Fits a homography to correspondences by the normalised direct linear transform (R. Hartley, "In Defense of the
    /// Eight-Point Algorithm", IEEE TPAMI 19(6), 1997). The fit to four correspondences is exact.
    ///
    /// # Errors
    /// [`ProjectorError`] if there are fewer than four correspondences, one is not finite, or they do not determine a
    /// homography.
    pub fn fit(pairs: &[Correspondence]) -> Result<Self, ProjectorError> {
        if pairs.len() < 4 {
            return Err(ProjectorError::TooFew(pairs.len()));
        }
        let finite = |pair: &Correspondence| {
            let mut numbers = pair.place.iter().chain(&pair.location);
            numbers.all(|number| number.is_finite())
        };
        if let Some(index) = pairs.iter().position(|pair| !finite(pair)) {
            return Err(ProjectorError::NotFinite(index));
        }
        let place = |pair: &Correspondence| DVec2::from(pair.place);
        let location = |pair: &Correspondence| DVec2::from(pair.location);
        let from = normalisation(pairs.iter().map(place)).ok_or(ProjectorError::Collinear("projector"))?;
        let to = normalisation(pairs.iter().map(location)).ok_or(ProjectorError::Collinear("image plane"))?;
        // There are two equations for each pair, in nine numbers that are known up to scale. The solution is the
        // eigenvector of the smallest eigenvalue of their normal matrix.
        let mut normal = [[0.0; 9]; 9];
        for pair in pairs {
            let p = from.transform_point2(place(pair));
            let q = to.transform_point2(location(pair));
            let equations = [
                [p.x, p.y, 1.0, 0.0, 0.0, 0.0, -q.x * p.x, -q.x * p.y, -q.x],
                [0.0, 0.0, 0.0, p.x, p.y, 1.0, -q.y * p.x, -q.y * p.y, -q.y],
            ];
            for equation in equations {
                for (row, a) in normal.iter_mut().zip(equation) {
                    for (sum, b) in row.iter_mut().zip(equation) {
                        *sum += a * b;
                    }
                }
            }
        }
        let [least, second, .., largest] = eigen::symmetric(normal);
        if second.value <= ZERO * largest.value {
            return Err(ProjectorError::Collinear("projector"));
        }
        let h = DMat3::from_cols_array(&least.vector).transpose();
        let matrix = to.inverse() * h * from;
        // The sign is chosen so that the middle of the points is in front of the horizon.
        let middle = from.inverse() * DVec3::Z;
        let matrix = matrix * (matrix * middle).z.signum();
        Self::new(matrix).ok_or(ProjectorError::Collinear("image plane"))
    }

    /// Fits a homography that agrees with most correspondences to `tolerance` pixels of the image plane. Returns the
    /// homography, and for each correspondence whether it agrees. Random fits to four correspondences are scored by
    /// their squared errors, each up to the tolerance (P. Torr and A. Zisserman, "MLESAC", CVIU 78(1), 2000); the best
    /// one is fitted again to all correspondences that agree with it. The same `seed` gives the same result.
    ///
    /// # Errors
    /// [`ProjectorError`] if fewer than half agree, otherwise as [`Homography::fit`].
    pub fn fit_robust(
        pairs: &[Correspondence],
        tolerance: f64,
        seed: u64,
    ) -> Result<(Self, Vec<bool>), ProjectorError> {
        const TRIALS: u32 = 1000;
        // The fit to all correspondences reports their errors, and is the first candidate.
        let mut best = Self::fit(pairs)?;
        let mut lowest = best.cost(pairs, tolerance);
        let mut random = Random::new(seed);
        for _ in 0..TRIALS {
            let chosen: Vec<_> =
                (0..4).filter_map(|_| pairs.get(random.below(pairs.len() as u64) as usize).copied()).collect();
            // Four correspondences that are on a line, or contain duplicates, are skipped.
            let Ok(fitted) = Self::fit(&chosen) else {
                continue;
            };
            let cost = fitted.cost(pairs, tolerance);
            if cost < lowest {
                (best, lowest) = (fitted, cost);
            }
        }
        // Each fit to the correspondences that agree may make more of them agree.
        for _ in 0..5 {
            let agreeing: Vec<_> = pairs.iter().filter(|pair| best.error(pair) <= tolerance).copied().collect();
            if 2 * agreeing.len() < pairs.len() || agreeing.len() < 4 {
                return Err(ProjectorError::Outliers { agreeing: agreeing.len(), count: pairs.len(), tolerance });
            }
            best = Self::fit(&agreeing)?;
        }
        let agrees = pairs.iter().map(|pair| best.error(pair) <= tolerance);
        Ok((best, agrees.collect()))
    }

    fn new(matrix: DMat3) -> Option<Self> {
        let inverse = matrix.inverse();
        let valid = matrix.is_finite() && inverse.is_finite();
        valid.then_some(Self { matrix, inverse })
    }

    /// Matrix from (x, y, 1) to (u w, v w, w); (x, y) is a place and (u, v) its location.
    #[must_use]
    pub fn matrix(&self) -> DMat3 {
        self.matrix
    }

    /// Place that the homography maps to `location`; `None` behind the horizon.
    #[must_use]
    pub fn inverse(&self, location: DVec2) -> Option<DVec2> {
        let p = self.inverse * location.extend(1.0);
        let place = p.truncate() / p.z;
        (place.is_finite() && self.is_ahead(place)).then_some(place)
    }

    /// Whether a place is in front of the horizon.
    pub(super) fn is_ahead(&self, place: DVec2) -> bool {
        (self.matrix * place.extend(1.0)).z > 0.0
    }

    /// Distance in pixels between the pair's location and the location to which the homography maps the pair's place.
    fn error(&self, pair: &Correspondence) -> f64 {
        let place = DVec2::from(pair.place);
        if !self.is_ahead(place) {
            return f64::INFINITY;
        }
        self.location(place).distance(DVec2::from(pair.location))
    }

    fn cost(&self, pairs: &[Correspondence], tolerance: f64) -> f64 {
        let errors = pairs.iter().map(|pair| self.error(pair).min(tolerance));
        errors.map(|error| error * error).sum()
    }
}

impl LocationMap for Homography {
    fn location(&self, place: DVec2) -> DVec2 {
        let p = self.matrix * place.extend(1.0);
        p.truncate() / p.z
    }

    fn jacobian(&self, place: DVec2) -> DMat2 {
        let p = self.matrix * place.extend(1.0);
        let location = p.truncate() / p.z;
        let column = |c: DVec3| (c.truncate() - location * c.z) / p.z;
        DMat2::from_cols(column(self.matrix.x_axis), column(self.matrix.y_axis))
    }
}

/// Similarity transform that gives points the mean 0 and the mean distance sqrt(2) from it; `None` if they are on a
/// line.
fn normalisation(points: impl Iterator<Item = DVec2> + Clone) -> Option<DMat3> {
    let count = points.clone().count() as f64;
    let mean = points.clone().sum::<DVec2>() / count;
    let ways = points.map(|point| point - mean);
    let (mut xx, mut xy, mut yy, mut distance) = (0.0, 0.0, 0.0, 0.0);
    for way in ways {
        xx += way.x * way.x;
        xy += way.x * way.y;
        yy += way.y * way.y;
        distance += way.length() / count;
    }
    // Squared spreads of the points along and across their best line.
    let spread = (0.5 * (xx - yy)).hypot(xy);
    let (along, across) = (0.5 * (xx + yy) + spread, 0.5 * (xx + yy) - spread);
    if across <= THINNEST * THINNEST * along {
        return None;
    }
    let scale = 2.0_f64.sqrt() / distance;
    Some(DMat3::from_scale(DVec2::splat(scale)) * DMat3::from_translation(-mean))
}
