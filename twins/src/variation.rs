//! Number of parts in which a triangle is shaded in a superpixel, chosen by the colours of the surrounding pixel
//! centres.

/// Centres of a pixel and its 8 neighbours, row by row from the upper left one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Neighbourhood {
    /// IDs of the visible triangles; 0 for none and outside of the image.
    pub ids: [u32; 9],
    /// Displayed colours: red, green and blue code values.
    pub colours: [[u8; 3]; 9],
}

/// Index of the pixel itself.
const CENTRE: usize = 4;

/// Parts of a superpixel in which a triangle is shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShadedParts {
    /// All parts.
    All,
    /// Parts merged in pairs.
    Pairs,
    /// Parts merged in fours.
    Fours,
    /// A single part.
    One,
}

/// With 65 to 256 samples, largest difference of code values with which parts are merged in pairs.
const PAIRED_RANGE: u32 = 12;

/// Number of samples from which on a triangle is shaded once only where the colours do not differ.
const MANY_SAMPLES: u32 = 128;

/// Parts in which `triangle` is shaded, in a superpixel of `samples` samples.
///
/// Two triangles around the pixel are examined: that of its centre, and the first other one. The rules are, in order:
///
/// - If 4 or more centres see the triangle and their colours differ by at most a quarter of `alike` code values, it is
///   shaded once.
/// - Otherwise, if 3 or more centres see its material, the difference of their colours decides: up to `alike`, or from
///   128 samples on up to 0, it is shaded once; up to four times `alike`, in parts merged in fours; above, in all parts.
///   All parts are merged in pairs if the triangle's own colours differ by at most a quarter of `alike`, though only 2
///   or 3 centres see it. With 65 to 256 samples, they are also merged in pairs if the material's colours differ by at
///   most 12.
/// - If fewer centres see it, or the triangle is neither of the two and has neither of their materials, parts are
///   merged in pairs.
///
/// Parts of a single sample are merged one step less: in pairs instead of fours, and not at all instead of in pairs.
///
/// `alike` is the contrast threshold. In superpixels that grew it is 0, because no centre saw the colours with which
/// they contrast.
#[must_use]
pub fn parts(
    around: &Neighbourhood,
    material_of: impl Fn(u32) -> u32,
    triangle: u32,
    alike: u8,
    samples: u32,
) -> ShadedParts {
    let alike = u32::from(alike);
    let own = around.ids[CENTRE];
    let other = around.ids.into_iter().find(|id| *id != 0 && *id != own).unwrap_or(0);
    let material = |id: u32| (id != 0).then(|| material_of(id));
    let known = [own, other];
    let mut even = false;
    if known.contains(&triangle) {
        let seen = |id: u32| id == triangle;
        let centres = count(around, seen);
        even = centres >= 2 && 4 * range(around, seen) <= alike;
        if even && centres >= 4 {
            return ShadedParts::One;
        }
    } else if !known.map(material).contains(&material(triangle)) {
        return ShadedParts::Pairs;
    }
    let seen = |id: u32| material(id) == material(triangle);
    if count(around, seen) < 3 {
        return ShadedParts::Pairs;
    }
    match range(around, seen) {
        range if range <= if samples < MANY_SAMPLES { alike } else { 0 } => ShadedParts::One,
        range if range <= 4 * alike => ShadedParts::Fours,
        _ if even => ShadedParts::Pairs,
        range if alike != 0 && (65..=256).contains(&samples) && range <= PAIRED_RANGE => ShadedParts::Pairs,
        _ => ShadedParts::All,
    }
}

fn count(around: &Neighbourhood, seen: impl Fn(u32) -> bool) -> usize {
    around.ids.iter().filter(|id| seen(**id)).count()
}

/// Largest difference of a channel among the centres whose ID satisfies `seen`.
fn range(around: &Neighbourhood, seen: impl Fn(u32) -> bool) -> u32 {
    let channel = |channel: usize| {
        let codes = around.ids.iter().zip(&around.colours);
        let codes = codes.filter(|(id, _)| seen(**id)).map(|(_, c)| c[channel]);
        let (low, high) = codes.fold((u8::MAX, 0), |(low, high), code| (low.min(code), high.max(code)));
        u32::from(high.saturating_sub(low))
    };
    (0..3).map(channel).max().unwrap_or(0)
}
