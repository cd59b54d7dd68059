//! Overlays: values of pixels, shown instead of colours.

use gpc::compare::heat_color;
use gpc::names::name;
use gpc::output::AovKind;

/// Kind of value that is shown instead of colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overlay {
    /// Values of an AOV, as `gpc render --aov` writes them.
    Stored(AovKind),
    /// Number of triangles in a pixel.
    Triangles,
    /// Difference between a pixel's colour and that of supersampling.
    Error,
}

/// Side of the grid of samples in a pixel at which triangles are counted.
pub const COUNT_SIDE: u32 = 4;
/// Largest number of triangles that these samples can tell apart: the top of the scale.
const MOST_TRIANGLES: u32 = COUNT_SIDE * COUNT_SIDE;
/// Difference at the top of the scale, in 8-bit code values.
const LARGEST_ERROR: u8 = 16;

impl Overlay {
    pub const ALL: [Self; 7] = [
        Self::Stored(AovKind::Depth),
        Self::Stored(AovKind::Id),
        Self::Stored(AovKind::Normal),
        Self::Stored(AovKind::Superpixels),
        Self::Stored(AovKind::Samples),
        Self::Triangles,
        Self::Error,
    ];

    pub fn name(self) -> String {
        match self {
            Self::Stored(kind) => name(&kind),
            Self::Triangles => "triangles".to_owned(),
            Self::Error => "error".to_owned(),
        }
    }

    /// The overlay after `current`, or `None` after the last. `None` is followed by the first overlay.
    pub fn next(current: Option<Self>) -> Option<Self> {
        let index = current.and_then(|current| Self::ALL.iter().position(|one| *one == current));
        Self::ALL.get(index.map_or(0, |index| index + 1)).copied()
    }

    /// Whether the overlay needs all samples at once, so that no quick preview is made.
    pub fn needs_all_samples(self) -> bool {
        matches!(self, Self::Triangles | Self::Error)
    }

    /// Legend of the colours: labels at equal distances on the scale from the first to the last; none without a scale.
    pub fn scale(self) -> &'static [&'static str] {
        match self {
            Self::Stored(_) => &[],
            Self::Triangles => &["1", "2", "4", "8", "16"],
            Self::Error => &["0", "4", "8", "12", "16"],
        }
    }
}

/// Colour for the number of triangles in a pixel. `ids` are the triangle IDs of its samples, 0 for none.
pub fn triangles(ids: &mut [u32]) -> [u8; 4] {
    ids.sort_unstable();
    let mut distinct = 0;
    let mut last = 0;
    for id in ids {
        if *id != last {
            distinct += 1;
            last = *id;
        }
    }
    let doublings = f64::from(distinct.max(1)).log2();
    opaque(heat_color((doublings / f64::from(MOST_TRIANGLES).log2()) as f32))
}

/// Colour for the largest difference of two pixels' channels.
pub fn error(first: [u8; 4], second: [u8; 4]) -> [u8; 4] {
    let differences = first.iter().zip(second).map(|(a, b)| a.abs_diff(b));
    let largest = differences.max().unwrap_or(0);
    opaque(heat_color(f32::from(largest) / f32::from(LARGEST_ERROR)))
}

fn opaque([r, g, b]: [u8; 3]) -> [u8; 4] {
    [r, g, b, 255]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlays_go_round() {
        let mut overlay = None;
        for expected in Overlay::ALL {
            overlay = Overlay::next(overlay);
            assert_eq!(overlay, Some(expected));
        }
        assert_eq!(Overlay::next(overlay), None);
    }

    #[test]
    fn triangles_are_counted_once_and_nothing_is_none() {
        let count = |mut ids: Vec<u32>| triangles(&mut ids);
        assert_eq!(count(vec![0, 0, 0]), opaque(heat_color(0.0)));
        assert_eq!(count(vec![7, 7, 0]), opaque(heat_color(0.0)));
        assert_eq!(count(vec![7, 9, 7, 9, 0]), opaque(heat_color(0.25)));
        assert_eq!(count((1..=16).collect()), opaque(heat_color(1.0)));
    }

    #[test]
    fn the_largest_channel_is_the_error() {
        let error = error([10, 20, 30, 255], [10, 12, 32, 255]);
        assert_eq!(error, opaque(heat_color(0.5)));
    }

    #[test]
    fn scales_say_what_colours_are() {
        let of_difference = |difference: u8| error([difference, 0, 0, 255], [0, 0, 0, 255]);
        let of_count = |count: u8| triangles(&mut (1..=u32::from(count)).collect::<Vec<_>>());
        let shares = [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| opaque(heat_color(share)));
        let labels = |overlay: Overlay| overlay.scale().iter().map(|label| label.parse().unwrap());
        assert_eq!(labels(Overlay::Triangles).map(of_count).collect::<Vec<_>>(), shares);
        assert_eq!(labels(Overlay::Error).map(of_difference).collect::<Vec<_>>(), shares);
    }
}
