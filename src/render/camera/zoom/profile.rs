//! Profile of a zoomed region: the distance from the centre at which an output pixel looks, along any line through the
//! centre.
//!
//! Distances are in radii of the region: an output pixel at distance q looks at distance s(q). With multiplicity m and
//! Q = 1 + 1/m, the outer end of the transition,
//!
//! ```text
//! s(q) = m q          for q <= 1        inside: the regular locations scaled by m
//! s(q) = q            for q >= Q        outside: the regular locations
//! ```
//!
//! and in between
//!
//! - *linear*: the displacement that pixels have inside, q (1 - m), is multiplied by t = (Q - q) m:
//!   s(q) = q (1 - t (1 - m)), a parabola. Its slope is a line, from m (2 - m) at q = 1 to 2 - m^2 at q = Q. The slope is
//!   positive for 0 < m < sqrt(2), so that nothing folds, but jumps from m to m (2 - m) at the inner border and from
//!   2 - m^2 to 1 at the outer one.
//! - *smooth*: the cubic with the values m and Q and the slopes m and 1 at the two borders. There is exactly one. Its mean
//!   slope is D = m (Q - m) = 1 + m - m^2 and the second derivative of its slope, per unit of the transition squared,
//!   6 (m + 1 - 2 D) = 6 (2 m + 1) (m - 1), which is not positive for m <= 1: the slope is concave, and so at least
//!   min(m, 1) = m everywhere.
//!
//! The area that an output pixel looks at is s'(q) s(q) / q for circles and rectangles alike, since s depends on q alone
//! and q grows in proportion along lines through the centre. s is continuous, so the *rate* of sampling, 1 / area, is
//! continuous exactly where the slope is: everywhere for the smooth transition.

use serde::{Deserialize, Serialize};

/// Transition from a zoomed region to its surroundings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Transition {
    /// Linear transition: the displacement of locations fades linearly with the distance. Locations are continuous,
    /// but their rate jumps at both borders.
    #[default]
    Linear,
    /// Smooth transition, by a cubic profile: locations and their rate are continuous.
    Smooth,
}

/// The function s(q) for one multiplicity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Profile {
    m: f64,
    transition: Transition,
}

impl Profile {
    pub(super) fn new(m: f64, transition: Transition) -> Self {
        Self { m, transition }
    }

    /// Distance Q at which the transition ends.
    pub(super) fn outer(&self) -> f64 {
        1.0 + 1.0 / self.m
    }

    /// The factor s(q) / q, by which the vector from the centre is scaled, and the slope s'(q).
    pub(super) fn factor_and_slope(&self, q: f64) -> [f64; 2] {
        let m = self.m;
        if q <= 1.0 {
            return [m, m];
        }
        if q >= self.outer() {
            return [1.0, 1.0];
        }
        match self.transition {
            Transition::Linear => {
                let t = (self.outer() - q) * m;
                let factor = 1.0 - t * (1.0 - m);
                [factor, factor + q * m * (1.0 - m)]
            }
            Transition::Smooth => {
                // Bernstein form: x is 0 at the inner border and 1 at the outer one, over a width of 1/m.
                let (x, width) = ((q - 1.0) * m, 1.0 / m);
                let y = 1.0 - x;
                let outer = self.outer();
                let [p0, p1, p2, p3] = [m, m + m * width / 3.0, outer - width / 3.0, outer];
                let value = y * y * y * p0 + 3.0 * x * y * (y * p1 + x * p2) + x * x * x * p3;
                let rise = y * y * (p1 - p0) + 2.0 * x * y * (p2 - p1) + x * x * (p3 - p2);
                [value / q, 3.0 * rise / width]
            }
        }
    }

    /// The q for which s(q) = `s`, by Newton's method within a bracket; a step that would leave the bracket is
    /// replaced by bisection.
    pub(super) fn inverse(&self, s: f64) -> f64 {
        let outer = self.outer();
        if s <= self.m {
            return s / self.m;
        }
        if s >= outer {
            return s;
        }
        let (mut low, mut high) = (1.0, outer);
        let mut q = 0.5 * (low + high);
        // Bisection alone would take as many steps as a double has bits, 53.
        for _ in 0..64 {
            let [factor, slope] = self.factor_and_slope(q);
            let excess = factor * q - s;
            if excess > 0.0 {
                high = q;
            } else {
                low = q;
            }
            let next = q - excess / slope;
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if (next - q).abs() <= 1e-16 * q {
                return next;
            }
            q = next;
        }
        q
    }
}
