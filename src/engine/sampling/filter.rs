//! Pixel filters: how much what lies near a pixel's centre weighs in the pixel.

use std::fmt;

/// Shape of a [`PixelFilter`] along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FilterShape {
    /// Constant over the pixel.
    Box,
    /// A triangle.
    Tent,
    /// A Gaussian whose standard deviation is a quarter of the radius, lowered so that it ends at 0.
    Gaussian,
    /// The cubic spline of Mitchell and Netravali with B = C = 1/3, which has negative lobes.
    Mitchell,
    /// The window of Blackman and Harris with four terms.
    BlackmanHarris,
}

impl FilterShape {
    /// Default radius in pixels. Those of tent, Gaussian and Mitchell are Mitsuba's, and that of Blackman-Harris is
    /// Blender's, whose *filter width* of 1.5 means this radius.
    #[must_use]
    pub fn default_radius(self) -> f64 {
        match self {
            Self::Box => 0.5,
            Self::Tent => 1.0,
            Self::BlackmanHarris => 1.5,
            Self::Gaussian | Self::Mitchell => 2.0,
        }
    }

    /// Name of the filter.
    fn name(self) -> &'static str {
        match self {
            Self::Box => "box",
            Self::Tent => "tent",
            Self::Gaussian => "gaussian",
            Self::Mitchell => "mitchell",
            Self::BlackmanHarris => "blackman-harris",
        }
    }
}

impl fmt::Display for FilterShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Filter by which a pixel's colour is averaged: the product of a shape along x and the same shape along y, around the
/// pixel's centre. Its integral is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PixelFilter {
    /// Shape along an axis.
    pub shape: FilterShape,
    /// Distance from the pixel's centre at which the filter ends, along each axis, in pixels: 0.5 for a box, otherwise
    /// from [`Self::LEAST_RADIUS`] to [`Self::MOST_RADIUS`].
    pub radius: f64,
}

/// Impossible radius of a filter.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FilterError {
    /// Radius of a box that is not half a pixel.
    #[error("a box filter of radius {0}: it is the pixel, whose radius is 0.5; other filters have other radii")]
    Box(f64),
    /// Radius of another filter that is outside of the limits.
    #[error(
        "a {shape} filter of radius {radius}: the radius must be from {least} to {most} pixels",
        least = PixelFilter::LEAST_RADIUS, most = PixelFilter::MOST_RADIUS
    )]
    Radius {
        /// Shape of the filter.
        shape: FilterShape,
        /// Radius that was asked for.
        radius: f64,
    },
}

impl Default for PixelFilter {
    fn default() -> Self {
        Self::BOX
    }
}

impl From<FilterShape> for PixelFilter {
    fn from(shape: FilterShape) -> Self {
        Self::new(shape, None)
    }
}

/// Functions that describe how light is spread over a pixel along an axis, by the place x from -0.5 to 0.5: 1, x and a
/// bent one. Each has the mean 0, except the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bend {
    /// The bent function is x² - 1/12.
    Square,
    /// The bent function is |x| - 1/4. Together they describe a tent exactly.
    Absolute,
}

impl Bend {
    /// The three functions at a place.
    fn functions(self, x: f64) -> [f64; 3] {
        let bent = match self {
            Self::Square => x * x - 1.0 / 12.0,
            Self::Absolute => x.abs() - 0.25,
        };
        [1.0, x, bent]
    }
}

/// Factors by which the functions are divided where they are stored: none exceeds 1 then.
pub(crate) const SPREAD_SCALES: [f64; 3] = [1.0, 0.5, 0.25];

/// Number of steps in which a pixel's width is integrated.
const STEPS: u32 = 1024;

impl PixelFilter {
    /// The pixel itself, with the same weight everywhere.
    pub const BOX: Self = Self { shape: FilterShape::Box, radius: 0.5 };
    /// Smallest radius of filters other than the box, in pixels.
    pub const LEAST_RADIUS: f64 = 0.5;
    /// Largest radius, in pixels.
    pub const MOST_RADIUS: f64 = 2.5;

    /// The filter of a shape, with a radius in pixels; `None` is [the shape's default](FilterShape::default_radius).
    #[must_use]
    pub fn new(shape: FilterShape, radius: Option<f64>) -> Self {
        Self { shape, radius: radius.unwrap_or_else(|| shape.default_radius()) }
    }

    /// The function by which the spread of superpixels is described; `None` for the box, which needs no spread.
    pub(crate) fn spread(&self) -> Option<Bend> {
        (!self.is_box()).then(|| self.bend())
    }

    /// This filter with another radius in pixels.
    #[must_use]
    pub fn with_radius(self, radius: f64) -> Self {
        Self { radius, ..self }
    }

    /// Whether the filter is the pixel itself, so that no pixel depends on others.
    #[must_use]
    pub fn is_box(&self) -> bool {
        self.shape == FilterShape::Box
    }

    /// Checks the radius.
    ///
    /// # Errors
    /// [`FilterError`] if it is impossible.
    pub fn check(&self) -> Result<(), FilterError> {
        let Self { shape, radius } = *self;
        if self.is_box() {
            return if radius == Self::BOX.radius { Ok(()) } else { Err(FilterError::Box(radius)) };
        }
        match (Self::LEAST_RADIUS..=Self::MOST_RADIUS).contains(&radius) {
            true => Ok(()),
            false => Err(FilterError::Radius { shape, radius }),
        }
    }

    /// Distance in pixels, rounded up, to the farthest pixels whose area the filter reaches.
    pub(crate) fn reach(&self) -> u32 {
        (self.radius - 0.5).ceil().max(0.0) as u32
    }

    /// Number of pixels along an axis whose area the filter reaches.
    pub(crate) fn span(&self) -> u32 {
        2 * self.reach() + 1
    }

    /// Value along an axis at a distance from the pixel's centre, up to a factor.
    fn value(&self, x: f64) -> f64 {
        let t = x.abs() / self.radius;
        if t > 1.0 {
            return 0.0;
        }
        match self.shape {
            FilterShape::Box => 1.0,
            FilterShape::Tent => 1.0 - t,
            FilterShape::Gaussian => (-8.0 * t * t).exp() - (-8.0_f64).exp(),
            FilterShape::Mitchell => {
                let (x, b, c) = (2.0 * t, 1.0 / 3.0, 1.0 / 3.0);
                if x < 1.0 {
                    ((12.0 - 9.0 * b - 6.0 * c) * x * x * x + (-18.0 + 12.0 * b + 6.0 * c) * x * x + 6.0 - 2.0 * b)
                        / 6.0
                } else {
                    ((-b - 6.0 * c) * x * x * x
                        + (6.0 * b + 30.0 * c) * x * x
                        + (-12.0 * b - 48.0 * c) * x
                        + 8.0 * b
                        + 24.0 * c)
                        / 6.0
                }
            }
            FilterShape::BlackmanHarris => {
                let angle = std::f64::consts::PI * (t + 1.0);
                0.35875 - 0.48829 * angle.cos() + 0.14128 * (2.0 * angle).cos() - 0.01168 * (3.0 * angle).cos()
            }
        }
    }

    /// Value at an offset from the pixel's centre, up to a factor.
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> f64 {
        self.value(x) * self.value(y)
    }

    /// Samples of the filter. `offsets` lie evenly in a pixel, from -0.5 to 0.5. The returned offsets are as dense as the filter's
    /// absolute value is large, and each has its sign as its weight.
    pub(crate) fn samples(&self, offsets: &[[f32; 2]]) -> Vec<([f64; 2], f64)> {
        let even = offsets.iter().map(|offset| offset.map(f64::from));
        if self.is_box() {
            return even.map(|offset| (offset, 1.0)).collect();
        }
        let step = 2.0 * self.radius / f64::from(STEPS);
        let low = |i: usize| i as f64 * step - self.radius;
        // The integrals of the absolute value up to the beginning of each step, and up to the end.
        let mut sums = vec![0.0];
        sums.extend((0..STEPS as usize).scan(0.0, |sum, i| {
            *sum += self.value(low(i) + 0.5 * step).abs();
            Some(*sum)
        }));
        let whole = sums.last().copied().unwrap_or_default();
        let place = |offset: f64| {
            let share = (offset + 0.5) * whole;
            let i = sums.partition_point(|sum| *sum <= share).clamp(1, STEPS as usize) - 1;
            low(i) + step * ((share - sums[i]) / (sums[i + 1] - sums[i]).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
        };
        even.map(|offset| offset.map(place)).map(|offset| (offset, self.at(offset).signum())).collect()
    }

    /// Side in pixels of the square over which so many even samples would be as dense as [`Self::samples`] are on average; 1 for
    /// the box.
    pub(crate) fn sampled_side(&self) -> f64 {
        if self.is_box() {
            return 1.0;
        }
        let width = 2.0 * self.radius;
        let sum = self.integral(0.0, width, |x| self.value(x).signum());
        let squares = self.integral(0.0, width, |x| self.value(x));
        sum * sum / squares
    }

    /// Integral along an axis over an interval of this width, times a function of the place relative to the interval's
    /// middle, up to a factor.
    fn integral(&self, middle: f64, width: f64, times: impl Fn(f64) -> f64) -> f64 {
        let step = width / f64::from(STEPS);
        let places = (0..STEPS).map(|i| (f64::from(i) + 0.5) * step - 0.5 * width);
        places.map(|x| self.value(middle + x) * times(x) * step).sum()
    }

    /// Weights of the pixels along an axis that the filter reaches, or, with `side` > 1, of as many parts of each: the
    /// filter's integrals over them. Their sum is 1.
    pub(crate) fn weights(&self, side: u32) -> Vec<f64> {
        let width = 1.0 / f64::from(side);
        let count = self.span() * side;
        let middle = |i: u32| (f64::from(i) + 0.5 - 0.5 * f64::from(count)) * width;
        let integrals: Vec<f64> = (0..count).map(|i| self.integral(middle(i), width, |_| 1.0)).collect();
        let sum: f64 = integrals.iter().sum();
        integrals.into_iter().map(|integral| integral / sum).collect()
    }

    /// Functions with which light spread over a pixel is described for this filter.
    pub(crate) fn bend(&self) -> Bend {
        match self.shape {
            FilterShape::Tent => Bend::Absolute,
            _ => Bend::Square,
        }
    }

    /// For each pixel along an axis that the filter reaches, the multiples of the three functions of [`Bend`] whose sum is
    /// nearest to the filter there. The first ones are the weights of [`Self::weights`].
    pub(crate) fn fits(&self) -> Vec<[f64; 3]> {
        let bend = self.bend();
        let reach = i64::from(self.reach());
        let whole: f64 = (-reach..=reach).map(|pixel| self.integral(pixel as f64, 1.0, |_| 1.0)).sum();
        // The functions are orthogonal.
        let squared = |k: usize| {
            let places = (0..STEPS).map(|i| (f64::from(i) + 0.5) / f64::from(STEPS) - 0.5);
            places.map(|x| bend.functions(x)[k].powi(2)).sum::<f64>() / f64::from(STEPS)
        };
        let squares = [0, 1, 2].map(squared);
        (-reach..=reach)
            .map(|pixel| {
                [0, 1, 2].map(|k| {
                    let product = self.integral(pixel as f64, 1.0, |x| bend.functions(x)[k]);
                    product / (whole * squares[k])
                })
            })
            .collect()
    }

    /// Light that is negative, or brighter than its alpha allows, because the filter has negative lobes or rounds: alpha is
    /// brought to 0 to 1 without changing the colour, and what is still negative becomes 0.
    pub(crate) fn clip(color: [f64; 4]) -> [f64; 4] {
        let alpha = color[3];
        let factor = if alpha > 1.0 { 1.0 / alpha } else { f64::from(u8::from(alpha > 0.0)) };
        color.map(|channel| (factor * channel).max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [FilterShape; 4] =
        [FilterShape::Tent, FilterShape::Gaussian, FilterShape::Mitchell, FilterShape::BlackmanHarris];

    fn filters() -> impl Iterator<Item = PixelFilter> {
        let radii = [0.5, 0.8, 1.0, 1.5, 1.7, 2.0, 2.5];
        SHAPES.into_iter().flat_map(move |shape| radii.map(|radius| PixelFilter::from(shape).with_radius(radius)))
    }

    #[test]
    fn weights_are_symmetric_and_their_sum_is_1() {
        for filter in filters() {
            for side in [1, 3, 8, 32] {
                let weights = filter.weights(side);
                assert_eq!(weights.len() as u32, (2 * filter.reach() + 1) * side);
                assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
                let turned = weights.iter().rev();
                assert!(weights.iter().zip(turned).all(|(a, b)| (a - b).abs() < 1e-12), "{filter:?}");
            }
        }
    }

    #[test]
    fn samples_have_the_moments_of_the_filter() {
        for filter in filters() {
            let count = 4096;
            let even: Vec<_> = (0..count).map(|i| [(i as f32 + 0.5) / count as f32 - 0.5, 0.0]).collect();
            let samples = filter.samples(&even);
            assert!(samples.iter().all(|(at, _)| at[0].abs() <= filter.radius && at[1].abs() < 1e-9), "{filter:?}");
            let whole = filter.integral(0.0, 2.0 * filter.radius, |_| 1.0);
            let weights: f64 = samples.iter().map(|(_, weight)| weight).sum();
            for power in 1..4 {
                let found: f64 = samples.iter().map(|(at, weight)| weight * at[0].powi(power)).sum();
                let exact = filter.integral(0.0, 2.0 * filter.radius, |x| x.powi(power)) / whole;
                assert!((found / weights - exact).abs() < 2e-3, "{filter:?}, {power}: {} {exact}", found / weights);
            }
        }
    }

    #[test]
    fn parts_of_a_pixel_weigh_as_much_as_the_pixel() {
        for filter in filters() {
            let parts = filter.weights(8);
            let sums = parts.chunks_exact(8).map(|parts| parts.iter().sum::<f64>());
            for ((sum, weight), fit) in sums.zip(filter.weights(1)).zip(filter.fits()) {
                assert!((sum - weight).abs() < 1e-5, "{filter:?}");
                assert!((weight - fit[0]).abs() < 1e-12, "{filter:?}");
            }
        }
    }

    /// A tent that ends in the middle or at the border of a pixel is described exactly. The others have an error of at most
    /// some hundredths of their largest value, and none on average.
    #[test]
    fn fits_are_near_the_filter() {
        for (filter, most) in [
            (PixelFilter::from(FilterShape::Tent), 1e-6),
            (PixelFilter::from(FilterShape::Tent).with_radius(1.5), 1e-6),
            (PixelFilter::from(FilterShape::Gaussian), 0.02),
            (PixelFilter::from(FilterShape::Mitchell), 0.03),
            (PixelFilter::from(FilterShape::BlackmanHarris), 0.035),
        ] {
            let reach = f64::from(filter.reach());
            let whole = filter.integral(0.0, 2.0 * reach + 1.0, |_| 1.0);
            for (index, fit) in filter.fits().into_iter().enumerate() {
                for i in 0..100 {
                    let x = f64::from(i) / 100.0 - 0.495;
                    let functions = filter.bend().functions(x);
                    let fitted: f64 = fit.iter().zip(functions).map(|(factor, function)| factor * function).sum();
                    let exact = filter.value(index as f64 - reach + x) / whole;
                    assert!((fitted - exact).abs() < most, "{filter:?}, {index}, {x}: {fitted} instead of {exact}");
                }
            }
        }
    }

    #[test]
    fn known_values() {
        let mitchell = PixelFilter::from(FilterShape::Mitchell);
        assert!((mitchell.value(0.0) - 8.0 / 9.0).abs() < 1e-12);
        assert!((mitchell.value(1.0) - 1.0 / 18.0).abs() < 1e-12);
        assert!(mitchell.value(1.5) < 0.0 && mitchell.value(2.0).abs() < 1e-12);
        let harris = PixelFilter::from(FilterShape::BlackmanHarris);
        assert!((harris.value(0.0) - 1.0).abs() < 1e-12 && harris.value(1.499) < 1e-4);
        let gaussian = PixelFilter::from(FilterShape::Gaussian);
        let ratio = (gaussian.value(0.5) + (-8.0_f64).exp()) / (gaussian.value(0.0) + (-8.0_f64).exp());
        assert!((ratio - (-0.5_f64).exp()).abs() < 1e-12, "0.5 is a standard deviation: {ratio}");
    }

    #[test]
    fn impossible_radii_are_refused() {
        for filter in filters() {
            assert_eq!(filter.check(), Ok(()));
        }
        assert_eq!(PixelFilter::BOX.check(), Ok(()));
        assert_eq!(PixelFilter::BOX.with_radius(1.0).check(), Err(FilterError::Box(1.0)));
        for radius in [0.0, -1.0, 2.6, f64::NAN, f64::INFINITY] {
            assert!(PixelFilter::from(FilterShape::Tent).with_radius(radius).check().is_err(), "{radius}");
        }
    }

    #[test]
    fn clipping_keeps_colours_of_opaque_pixels() {
        assert_eq!(PixelFilter::clip([0.55, 0.0, 1.1, 1.1]), [0.55 / 1.1, 0.0, 1.0, 1.0]);
        assert_eq!(PixelFilter::clip([-0.1, 0.2, 3.0, 0.5]), [0.0, 0.2, 3.0, 0.5]);
        assert_eq!(PixelFilter::clip([-0.1, 0.2, 0.0, -0.01]), [0.0; 4]);
    }
}
