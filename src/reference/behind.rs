//! What a host has drawn behind its triangles.
//!
//! A sample of a superpixel that sees no triangle shows the host's own image there: sky, gradient, whatever was drawn
//! before. Where the centre of the pixel saw a triangle, the image holds that triangle's colour instead, and the nearest
//! pixel whose centre saw none stands for it.

/// The colour behind the triangles at a pixel, of an image of rows of `width` pixels: `ids` are what the centres of pixels
/// saw, 0 where that was no triangle, `colors` what the host has drawn. It is that of the nearest pixel with an ID of 0, at
/// most two columns and two rows away; of several that are equally near it is the uppermost, and of these the leftmost one.
/// Where there is none, it is the background.
///
/// # Panics
/// The pixel is not in the image, or there are fewer IDs or colours than pixels.
#[must_use]
pub fn behind(
    width: u32,
    ids: &[u32],
    colors: &[[f32; 4]],
    background: [f32; 4],
    pixel: [u32; 2],
) -> [f32; 4] {
    let height = ids.len() as u32 / width;
    assert!(pixel[0] < width && pixel[1] < height);
    let near = |at: u32, end: u32| at.saturating_sub(2)..(at + 3).min(end);
    let pixels = near(pixel[1], height).flat_map(|y| near(pixel[0], width).map(move |x| [x, y]));
    let unseen = pixels.filter(|[x, y]| ids[(y * width + x) as usize] == 0);
    let nearest = unseen.min_by_key(|there| {
        let [x, y] = [0, 1].map(|axis| there[axis].abs_diff(pixel[axis]));
        x * x + y * y
    });
    nearest.map_or(background, |[x, y]| colors[(y * width + x) as usize])
}
