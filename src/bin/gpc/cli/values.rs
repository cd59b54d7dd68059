//! Parsers of option values.

use super::exit::Usage;
use glam::DVec3;
use gpc::color::srgb;
use gpc::render::{PixelRect, SceneSettings};
use std::ops::RangeInclusive;

/// Parses a number that is neither infinite nor NaN.
pub fn finite(text: &str) -> Result<f64, String> {
    number(text, |_| true, "a number, such as 1.5")
}

/// Parses a number of 0 or more.
pub fn not_negative(text: &str) -> Result<f64, String> {
    number(text, |number| number >= 0.0, "a number of 0 or more")
}

/// Parses a number above 0.
pub fn positive(text: &str) -> Result<f64, String> {
    number(text, |number| number > 0.0, "a number above 0")
}

/// Parses a width of lines or a size of points, in pixels.
pub fn stroke(text: &str) -> Result<f64, String> {
    let largest = f64::from(SceneSettings::LARGEST_STROKE);
    let expected = format!("pixels above 0 and at most {largest}, such as 1.5");
    number(text, |size| size > 0.0 && size <= largest, &expected)
}

/// Parses a number of frames per second.
pub fn rate(text: &str) -> Result<f64, String> {
    number(text, |rate| (0.001..=1000.0).contains(&rate), "a number from 0.001 to 1000, such as 23.976")
}

/// Parses a field of view in degrees, above 0 and below 180.
pub fn field_of_view(text: &str) -> Result<f64, String> {
    number(text, |degrees| degrees > 0.0 && degrees < 180.0, "degrees above 0 and below 180")
}

/// Parses a finite number that is accepted; the message says what is expected.
fn number(text: &str, accepts: impl Fn(f64) -> bool, expected: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(number) if f64::is_finite(number) && accepts(number) => Ok(number),
        _ => Err(format!("expected {expected}")),
    }
}

/// A share of a sequence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Number of the part, from 1 to `count`.
    pub number: u32,
    pub count: u32,
}

/// Parses `I/N`: the I-th of N shares.
pub fn shard(text: &str) -> Result<Shard, String> {
    text.split_once('/')
        .and_then(|(number, count)| Some(Shard { number: number.parse().ok()?, count: count.parse().ok()? }))
        .filter(|shard| (1..=shard.count).contains(&shard.number))
        .ok_or_else(|| "expected I/N with I from 1 to N, such as 1/4".to_owned())
}

/// Parses a width and height in pixels: `1280x720`.
pub fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| text.parse().ok().filter(|side| (1..=65_535).contains(side));
    text.split_once(['x', 'X'])
        .and_then(|(width, height)| Some([side(width)?, side(height)?]))
        .ok_or_else(|| "expected width x height in pixels, each 1 to 65535, such as 1280x720".to_owned())
}

/// Parses a part of an image: column and row of its upper left pixel, width and height, as `640,360,320x180`.
pub fn region(text: &str) -> Result<PixelRect, String> {
    let region = || {
        let mut parts = text.splitn(3, ',');
        let mut corner = || parts.next()?.parse().ok();
        Some(PixelRect { corner: [corner()?, corner()?], size: size(parts.next()?).ok()? })
    };
    region().ok_or_else(|| {
        "expected column, row, width x height in pixels of the image, such as 640,360,320x180".to_owned()
    })
}

/// Parses a point or direction: `X,Y,Z`.
pub fn vector(text: &str) -> Result<DVec3, String> {
    numbers(text).map(DVec3::from_array).ok_or_else(|| "expected three numbers X,Y,Z, such as 0,1.5,-4".to_owned())
}

fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers: Option<Vec<_>> = text.split(',').map(|t| finite(t.trim()).ok()).collect();
    numbers?.try_into().ok()
}

/// Parses a place: `X,Y`.
pub fn place(text: &str) -> Result<[f64; 2], String> {
    numbers(text).ok_or_else(|| "expected two numbers X,Y, such as 320,240".to_owned())
}

/// Parses radii above 0: `R` for both axes, or `RX,RY`.
pub fn radii(text: &str) -> Result<[f64; 2], String> {
    let radii = match numbers(text) {
        Some([radius]) => Some([radius; 2]),
        None => numbers(text),
    };
    radii
        .filter(|radii| radii.iter().all(|radius| *radius > 0.0))
        .ok_or_else(|| "expected a radius R or RX,RY above 0, such as 80 or 120,60".to_owned())
}

/// Background of the image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// No background: the image is transparent there.
    Transparent,
    /// An sRGB-encoded colour, each component 0 to 1.
    Color([f64; 3]),
    /// The environment that lights the scene.
    Environment,
}

impl Background {
    /// Linear light of the colour behind the scene, if there is one.
    pub fn color(self) -> Option<[f32; 3]> {
        match self {
            Self::Transparent | Self::Environment => None,
            Self::Color(color) => Some(linear(color)),
        }
    }
}

/// Parses a background: `none`, `environment`, `R,G,B` with sRGB components of 0 to 1, or `#rrggbb`.
pub fn background(text: &str) -> Result<Background, String> {
    if text == "none" {
        return Ok(Background::Transparent);
    }
    if text == "environment" {
        return Ok(Background::Environment);
    }
    color(text).map(Background::Color).ok_or_else(|| {
        "expected none, environment, an sRGB colour R,G,B of 0 to 1, such as 0.8,0.9,1, or #rrggbb".to_owned()
    })
}

/// Linear light of an sRGB-encoded colour.
pub fn linear(color: [f64; 3]) -> [f32; 3] {
    color.map(|v| srgb::decode(v) as f32)
}

/// Parses a colour: `R,G,B` with sRGB components of 0 to 1, or `#rrggbb`.
fn color(text: &str) -> Option<[f64; 3]> {
    match text.strip_prefix('#') {
        Some(digits) => hexadecimal(digits),
        None => numbers(text).filter(|color: &[f64; 3]| color.iter().all(|v| (0.0..=1.0).contains(v))),
    }
}

/// Width and colour of the edge lines of meshes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeLines {
    /// Width in pixels.
    pub width: f64,
    /// An sRGB-encoded colour, each component 0 to 1.
    pub color: [f64; 3],
}

/// Parses a width in pixels with an optional colour, black by default: `1.5` or `1.5,#204060`.
pub fn edges(text: &str) -> Result<EdgeLines, String> {
    let (width, colour) = match text.split_once(',') {
        Some((width, colour)) => (width, color(colour)),
        None => (text, Some([0.0; 3])),
    };
    let lines = stroke(width).ok().zip(colour);
    lines.map(|(width, color)| EdgeLines { width, color }).ok_or_else(|| {
        let largest = SceneSettings::LARGEST_STROKE;
        format!("expected pixels above 0 and at most {largest}, and an sRGB colour, such as 1.5 or 1.5,#204060")
    })
}

fn hexadecimal(digits: &str) -> Option<[f64; 3]> {
    if digits.len() != 6 || !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    let code = u32::from_str_radix(digits, 16).ok()?;
    Some([16, 8, 0].map(|shift| f64::from(code >> shift & 0xff) / 255.0))
}

/// Parses a number of bytes, with K, M, G or T for powers of 1,024.
pub fn bytes(text: &str) -> Result<u64, String> {
    let upper = text.to_ascii_uppercase();
    let upper = upper.strip_suffix("IB").unwrap_or(&upper);
    let (digits, shift) = [('K', 10), ('M', 20), ('G', 30), ('T', 40)]
        .into_iter()
        .find_map(|(unit, shift)| Some((upper.strip_suffix(unit)?, shift)))
        .unwrap_or((upper, 0));
    digits
        .parse::<u64>()
        .ok()
        .and_then(|number| number.checked_mul(1 << shift))
        .filter(|bytes| *bytes > 0)
        .ok_or_else(|| "expected a number of bytes, such as 512M or 2G".to_owned())
}

/// Parses frame numbers, first and last included: `0..47`.
pub fn frames(text: &str) -> Result<RangeInclusive<u32>, String> {
    text.split_once("..")
        .and_then(|(first, last)| Some(first.parse().ok()?..=last.parse().ok()?))
        .filter(|range: &RangeInclusive<u32>| !range.is_empty())
        .ok_or_else(|| "expected the first and last frame, such as 0..47".to_owned())
}

/// A value for each of the `count` uses of the option `of`, from one value for all or one for each.
pub fn each<T: Copy>(of: &str, count: usize, option: &str, values: &[T]) -> Result<Vec<T>, Usage> {
    match values {
        [value] => Ok(vec![*value; count]),
        _ if values.len() == count => Ok(values.to_vec()),
        _ => Err(Usage(format!("{count} {of} and {} {option}; give one for all or one for each", values.len()))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes() {
        assert_eq!(size("1280x720"), Ok([1280, 720]));
        for wrong in ["1280", "0x5", "5x", "-1x5", "70000x1", "1x2x3", "1.5x2"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn rates_and_shards() {
        assert_eq!(rate("29.97"), Ok(29.97));
        let expected = Shard { number: 4, count: 4 };
        assert_eq!(shard("4/4"), Ok(expected));
        for wrong in ["", "0/4", "5/4", "4", "-1/4", "1/0", "1/4/4", "a/b"] {
            assert!(shard(wrong).is_err(), "{wrong}");
        }
        for wrong in ["0", "0.0001", "1001", "24/1"] {
            assert!(rate(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn regions() {
        let expected = PixelRect { corner: [3, 0], size: [20, 10] };
        assert_eq!(region("3,0,20x10"), Ok(expected));
        for wrong in ["", "3,0", "3,0,20", "3,0,0x10", "-3,0,20x10", "3,0,20x10,1"] {
            assert!(region(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn vectors() {
        assert_eq!(vector("-1,2.5,3e1"), Ok(DVec3::new(-1.0, 2.5, 30.0)));
        for wrong in ["1,2", "1,2,3,4", "a,b,c", "nan,0,0", "1,,2", ""] {
            assert!(vector(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn places_and_radii() {
        assert_eq!(place("3,-4.5"), Ok([3.0, -4.5]));
        assert_eq!(radii("3"), Ok([3.0, 3.0]));
        assert_eq!(radii("3,4"), Ok([3.0, 4.0]));
        for wrong in ["0", "1,0", "-1", "1,2,3", "nan", ""] {
            assert!(radii(wrong).is_err() && place(wrong).is_err() || wrong == "1,0", "{wrong}");
        }
    }

    #[test]
    fn backgrounds() {
        assert_eq!(background("none"), Ok(Background::Transparent));
        assert_eq!(background("0,0.5,1"), Ok(Background::Color([0.0, 0.5, 1.0])));
        assert_eq!(background("#ff0033"), Ok(Background::Color([1.0, 0.0, 0.2])));
        for wrong in ["", "#ff", "#+f0033", "1,2,3", "red", "#ff003é"] {
            assert!(background(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn byte_counts() {
        assert_eq!(bytes("1000"), Ok(1000));
        assert_eq!(bytes("512M"), Ok(512 << 20));
        assert_eq!(bytes("2gib"), Ok(2 << 30));
        for wrong in ["", "M", "-1", "1.5G", "0", "99999999T"] {
            assert!(bytes(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn frame_ranges() {
        assert_eq!(frames("3..5"), Ok(3..=5));
        assert_eq!(frames("3..3"), Ok(3..=3));
        for wrong in ["5..3", "3", "..", "a..b", "0..4294967296"] {
            assert!(frames(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn numbers() {
        assert!(finite("inf").is_err() && finite("1e999").is_err());
        assert!(positive("0").is_err() && not_negative("-0.1").is_err());
        assert!(field_of_view("180").is_err() && field_of_view("90").is_ok());
    }
}
