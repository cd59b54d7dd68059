//! A texture in closed form: its texels in linear light, with the magnification filter and the wrap modes.

use gpc::color::srgb;
use gpc::scene::{Filter, Image, Sampler, Wrap};

/// Number of texels along each side.
pub const SIDE: u32 = 64;

/// A grey texture.
pub struct Texture {
    pub image: Image,
    pub sampler: Sampler,
    /// Linear values of the image's texels, row by row.
    linear: Vec<f64>,
}

impl Texture {
    /// Texture whose texel (x, y) is the 8-bit sRGB code nearest to `value(x, y)`, which is in linear light.
    pub fn new(sampler: Sampler, value: impl Fn(u32, u32) -> f64) -> Self {
        let places = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
        let codes: Vec<u8> = places.map(|(x, y)| srgb::encode_u8(value(x, y))).collect();
        Self {
            linear: codes.iter().map(|code| srgb::decode(f64::from(*code) / 255.0)).collect(),
            image: Image {
                width: SIDE,
                height: SIDE,
                pixels: codes.iter().flat_map(|&code| [code, code, code, 255]).collect(),
            },
            sampler,
        }
    }

    /// Squares of `size` texels, alternately light and dark.
    pub fn checker(sampler: Sampler, size: u32) -> Self {
        let light = |x: u32, y: u32| (x / size + y / size).is_multiple_of(2);
        Self::new(sampler, |x, y| if light(x, y) { 0.9 } else { 0.05 })
    }

    /// A sine grating with whole numbers of waves along both sides.
    pub fn grating(sampler: Sampler, waves: [u32; 2]) -> Self {
        Self::new(sampler, |x, y| {
            let phase = f64::from(waves[0] * x + waves[1] * y) / f64::from(SIDE);
            0.5 + 0.45 * (std::f64::consts::TAU * phase).sin()
        })
    }

    /// Blocks of texels with irregular greys, so that a mistake in wrapping is visible.
    pub fn mosaic(sampler: Sampler) -> Self {
        Self::new(sampler, |x, y| {
            let [x, y] = [x / 8, y / 8];
            f64::from((x * 5 + y * 3 + x * y) % 11) / 10.0
        })
    }

    fn texel(&self, x: i64, y: i64) -> f64 {
        let x = wrapped(x, self.sampler.wrap_u);
        let y = wrapped(y, self.sampler.wrap_v);
        self.linear[y * SIDE as usize + x]
    }

    /// Value at texture coordinates, magnified.
    pub fn at(&self, [u, v]: [f64; 2]) -> f64 {
        let side = f64::from(SIDE);
        if self.sampler.mag == Filter::Nearest {
            return self.texel((u * side).floor() as i64, (v * side).floor() as i64);
        }
        let [x, y] = [u * side - 0.5, v * side - 0.5];
        let [left, top] = [x.floor(), y.floor()];
        let [across, down] = [x - left, y - top];
        let row = |y: i64| {
            let [a, b] = [0, 1].map(|step| self.texel(left as i64 + step, y));
            a + across * (b - a)
        };
        let [a, b] = [0, 1].map(|step| row(top as i64 + step));
        a + down * (b - a)
    }

    /// Mean along the straight line between two places. It is exact up to rounding, by Simpson's rule between the
    /// lines of texels, where the value is a quadratic function.
    pub fn mean_along(&self, from: [f64; 2], to: [f64; 2]) -> f64 {
        let mut cuts = vec![0.0, 1.0];
        for axis in 0..2 {
            self.cut(&mut cuts, from[axis], to[axis]);
        }
        cuts.sort_by(f64::total_cmp);
        let place = |t: f64| [0, 1].map(|axis| from[axis] + t * (to[axis] - from[axis]));
        let piece = |ends: &[f64]| {
            let (length, middle) = (ends[1] - ends[0], 0.5 * (ends[0] + ends[1]));
            // The points lie inside of the piece, so that steps at its ends don't matter.
            let near = |t: f64| self.at(place(middle + (t - middle) * (1.0 - 1e-9)));
            length * (near(ends[0]) + 4.0 * near(middle) + near(ends[1])) / 6.0
        };
        cuts.windows(2).map(piece).sum()
    }

    /// Adds the parameters at which a coordinate between two values crosses a line where the texture's formula
    /// changes.
    fn cut(&self, cuts: &mut Vec<f64>, from: f64, to: f64) {
        let shift = if self.sampler.mag == Filter::Nearest { 0.0 } else { 0.5 };
        let line = |value: f64| value * f64::from(SIDE) - shift;
        let (low, high) = (line(from.min(to)), line(from.max(to)));
        let length = line(to) - line(from);
        if length == 0.0 {
            return;
        }
        let first = low.ceil();
        for index in 0..(high - first).max(-1.0).floor() as i64 + 1 {
            cuts.push(((first + index as f64 - line(from)) / length).clamp(0.0, 1.0));
        }
    }
}

/// Index of the texel that a wrap mode gives for an index.
fn wrapped(index: i64, wrap: Wrap) -> usize {
    let side = i64::from(SIDE);
    let texel = match wrap {
        Wrap::Repeat => index.rem_euclid(side),
        Wrap::ClampToEdge => index.clamp(0, side - 1),
        Wrap::MirroredRepeat => {
            let place = index.rem_euclid(2 * side);
            place.min(2 * side - 1 - place)
        }
    };
    texel as usize
}

#[test]
fn a_mean_along_a_line_is_that_of_many_points() {
    let filters = [Filter::Nearest, Filter::Linear];
    let wraps = [Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge];
    for (mag, wrap) in filters.into_iter().flat_map(|f| wraps.map(|w| (f, w))) {
        let texture = Texture::mosaic(Sampler { mag, wrap_u: wrap, ..Sampler::default() });
        for (from, to) in [([-1.3, 0.2], [1.7, 0.9]), ([0.4, -2.1], [0.1, 1.0]), ([0.25, 0.5], [0.75, 0.5])] {
            let points = 100_000;
            let point = |index: i32| {
                let t = (f64::from(index) + 0.5) / f64::from(points);
                texture.at([0, 1].map(|axis: usize| from[axis] + t * (to[axis] - from[axis])))
            };
            let many = (0..points).map(point).sum::<f64>() / f64::from(points);
            let found = texture.mean_along(from, to);
            assert!((found - many).abs() < 2e-4, "{mag:?} {wrap:?} {found} {many}");
        }
    }
}
