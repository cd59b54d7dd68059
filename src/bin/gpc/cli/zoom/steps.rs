//! Pictures of the steps of a zoom.

use glam::DVec2;
use gpc::camera::LocationMap;
use gpc::camera::zoom::ZoomMap;

/// Pixels of a picture, rows from the top.
type LinearPixels = Vec<[f32; 4]>;

/// A picture of one step of the zoom.
pub struct StepPicture {
    /// Name of the step's file.
    pub name: String,
    pub size: [u32; 2],
    pub pixels: LinearPixels,
}

impl StepPicture {
    pub fn new(name: &str, size: [u32; 2], pixels: LinearPixels) -> Self {
        Self { name: name.to_owned(), size, pixels }
    }
}

/// The steps that zooms of scenes and of photographs have in common.
pub fn common(size: [u32; 2], original: &[[f32; 4]], result: &[[f32; 4]], map: &ZoomMap) -> Vec<StepPicture> {
    let in_transition = |place| map.regions().iter().any(|region| region.in_transition(place));
    vec![
        StepPicture::new("original", size, original.to_vec()),
        StepPicture::new("locations", size, locations(size, original, map)),
        StepPicture::new("resampled", size, keep(size, result, |place| !in_transition(place))),
        StepPicture::new("transition", size, keep(size, result, in_transition)),
    ]
}

/// Number of locations along the wider side that are drawn.
const DRAWN: u32 = 96;

/// Factor by which the image under the locations is dimmed.
const DIMMED: f32 = 0.15;

/// Picture of the image, dimmed, with a subset of the locations as dots.
fn locations(size: [u32; 2], original: &[[f32; 4]], map: &ZoomMap) -> LinearPixels {
    let dim = |[r, g, b, _]: &[f32; 4]| [r * DIMMED, g * DIMMED, b * DIMMED, 1.0];
    let mut picture: LinearPixels = original.iter().map(dim).collect();
    let [width, height] = size;
    let step = (width.max(height) / DRAWN).max(1);
    let middles = |side: u32| (step / 2..side).step_by(step as usize);
    for (row, col) in middles(height).flat_map(|row| middles(width).map(move |col| (row, col))) {
        let at = map.location(DVec2::new(f64::from(col) + 0.5, f64::from(row) + 0.5));
        // A dot has 2 x 2 pixels, centred on the location.
        for (dx, dy) in [(-0.5, -0.5), (0.5, -0.5), (-0.5, 0.5), (0.5, 0.5)] {
            let pixel = (at + DVec2::new(dx, dy)).floor();
            let inside = pixel.cmpge(DVec2::ZERO).all() && pixel.x < f64::from(width) && pixel.y < f64::from(height);
            let index = pixel.y as usize * width as usize + pixel.x as usize;
            if let Some(dot) = picture.get_mut(index).filter(|_| inside) {
                *dot = [1.0; 4];
            }
        }
    }
    picture
}

/// The pixels at whose places `kept` is true; the others become transparent.
fn keep(size: [u32; 2], pixels: &[[f32; 4]], kept: impl Fn(DVec2) -> bool) -> LinearPixels {
    let places = (0..size[1]).flat_map(|row| (0..size[0]).map(move |col| (col, row)));
    let pixel = |(pixel, (col, row)): (&[f32; 4], (u32, u32))| {
        if kept(DVec2::new(f64::from(col) + 0.5, f64::from(row) + 0.5)) { *pixel } else { [0.0; 4] }
    };
    pixels.iter().zip(places).map(pixel).collect()
}
