//! Footprints: the part of a photograph that an output pixel covers.

use glam::{DMat2, DVec2};

/// Largest number of places along each axis of a footprint.
const MOST: f64 = 64.0;

/// Places at which a photograph is read for one output pixel: a grid along the principal axes of the pixel's
/// footprint.
///
/// The footprint of a pixel is an ellipse whose axes are the singular values of the Jacobian. Along an axis of length
/// a <= 1 the reconstruction suffices. For a longer axis, a box filter of width sqrt(a^2 - 1) is added. Variances of
/// successive filters add up, and the width grows from 0, so that the result is continuous where the prefilter begins.
pub(super) struct SampleGrid {
    axes: [DVec2; 2],
    counts: [u32; 2],
}

impl SampleGrid {
    pub(super) fn new(jacobian: DMat2) -> Self {
        // Eigenvalues and eigenvectors of J J^T = ((p, q), (q, r)).
        let rows = jacobian.transpose();
        let (p, q, r) = (rows.x_axis.length_squared(), rows.x_axis.dot(rows.y_axis), rows.y_axis.length_squared());
        let (mean, half) = (0.5 * (p + r), 0.5 * (p - r));
        let spread = half.hypot(q);
        let major = DVec2::from_angle(0.5 * q.atan2(half));
        let width = |eigenvalue: f64| (eigenvalue - 1.0).max(0.0).sqrt();
        let widths = [width(mean + spread), width(mean - spread)];
        Self {
            axes: [major * widths[0], major.perp() * widths[1]],
            counts: widths.map(|width| {
                // Places are at most half a pixel apart, because the reconstruction is not linear between pixels.
                if width > 0.0 { ((2.0 * width).ceil() + 1.0).min(MOST) as u32 } else { 1 }
            }),
        }
    }

    pub(super) fn count(&self) -> f64 {
        f64::from(self.counts[0] * self.counts[1])
    }

    /// Offsets of the places from the middle of the footprint, in pixels of the photograph.
    pub(super) fn offsets(&self) -> impl Iterator<Item = DVec2> {
        let [across, down] = self.counts;
        let place = |index: u32, count: u32| (f64::from(index) + 0.5) / f64::from(count) - 0.5;
        let axes = self.axes;
        (0..down).flat_map(move |j| (0..across).map(move |i| axes[0] * place(i, across) + axes[1] * place(j, down)))
    }
}
