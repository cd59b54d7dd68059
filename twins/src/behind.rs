//! Colours that a host has drawn behind its triangles.
//!
//! If a sample of a superpixel meets no triangle, it takes its colour from the host's image, such as a sky. The image
//! may show a triangle at the centre of this pixel; the sample then uses the nearest pixel whose centre shows none.

/// Colour behind the triangles at `pixel`.
///
/// The image has rows of `width` pixels. `ids` holds the triangle ID at the centre of each pixel, 0 without a
/// triangle, and `colors` the colours that the host has drawn. The result is the colour of the nearest pixel with ID 0
/// that is at most two columns and two rows away; of equally near pixels the uppermost, and of these the leftmost.
/// Without such a pixel, it is `background`.
///
/// # Panics
/// If the pixel is outside of the image, or there are fewer IDs or colours than pixels.
#[must_use]
pub fn behind(width: u32, ids: &[u32], colors: &[[f32; 4]], background: [f32; 4], pixel: [u32; 2]) -> [f32; 4] {
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
