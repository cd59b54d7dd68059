//! In how many parts of a superpixel a triangle is shaded, from the colours that pixels' centres see around it.

/// What the centres of a pixel and of the 8 around it see, in the order of rows from the upper left one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Neighbourhood {
    /// IDs of triangles, 0 for none and outside of the image.
    pub ids: [u32; 9],
    /// Colours as they will be displayed: red, green and blue code values.
    pub colours: [[u8; 3]; 9],
}

/// The pixel itself.
const CENTRE: usize = 4;

/// In which parts of a superpixel a triangle is shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parts {
    /// In all that there are.
    All,
    /// In these, merged in pairs.
    Pairs,
    /// In these, merged in fours.
    Fours,
    /// In one.
    One,
}

/// In which parts `triangle` is shaded.
///
/// Around the pixel, two triangles are looked at: that of its centre, and the first other one. Where 4 centres or more
/// see the triangle and their colours differ by at most a quarter of `alike` code values, it is shaded once. Otherwise
/// the colours of its material count, where 3 centres or more see it: it is shaded once if they differ by at most `alike`,
/// in parts merged in fours if by at most four times that, and in all parts otherwise; these are merged in pairs where the
/// triangle's own colours differ as little as said, though but 2 or 3 centres see it. Where fewer centres tell, or the
/// triangle is neither of the two and not of their materials, parts are merged in pairs.
///
/// Parts of one sample are merged once less: in pairs in the place of fours, and not in that of pairs.
///
/// `alike` is the threshold of contrast, but 0 in superpixels that grew: what these contrast with, no centre saw.
#[must_use]
pub fn parts(
    around: &Neighbourhood,
    material_of: impl Fn(u32) -> u32,
    triangle: u32,
    alike: u8,
) -> Parts {
    let alike = u32::from(alike);
    let own = around.ids[CENTRE];
    let other = around
        .ids
        .into_iter()
        .find(|id| *id != 0 && *id != own)
        .unwrap_or(0);
    let material = |id: u32| (id != 0).then(|| material_of(id));
    let known = [own, other];
    let mut even = false;
    if known.contains(&triangle) {
        let seen = |id: u32| id == triangle;
        let centres = count(around, seen);
        even = centres >= 2 && 4 * range(around, seen) <= alike;
        if even && centres >= 4 {
            return Parts::One;
        }
    } else if !known.map(material).contains(&material(triangle)) {
        return Parts::Pairs;
    }
    let seen = |id: u32| material(id) == material(triangle);
    if count(around, seen) < 3 {
        return Parts::Pairs;
    }
    match range(around, seen) {
        range if range <= alike => Parts::One,
        range if range <= 4 * alike => Parts::Fours,
        _ if even => Parts::Pairs,
        _ => Parts::All,
    }
}

fn count(around: &Neighbourhood, seen: impl Fn(u32) -> bool) -> usize {
    around.ids.iter().filter(|id| seen(**id)).count()
}

/// The widest difference of a channel among centres that see what is asked for.
fn range(around: &Neighbourhood, seen: impl Fn(u32) -> bool) -> u32 {
    let channel = |channel: usize| {
        let codes = around.ids.iter().zip(&around.colours);
        let codes = codes.filter(|(id, _)| seen(**id)).map(|(_, c)| c[channel]);
        let (low, high) = codes.fold((u8::MAX, 0), |(low, high), code| {
            (low.min(code), high.max(code))
        });
        u32::from(high.saturating_sub(low))
    };
    (0..3).map(channel).max().unwrap_or(0)
}
