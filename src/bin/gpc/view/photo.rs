//! Photographs and zoomed images, and the part of them that the window shows.

use super::tint::tinted;
use anyhow::Context;
use glam::{DMat2, DVec2};
use gpc::camera::LocationMap;
use gpc::camera::zoom::{Window, ZoomMap};
use gpc::output;
use gpc::resample::{Photograph, Zoomed, zoomed_location};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Half side of the square in which the image is unzoomed, as a share of the window's height.
const LOUPE: f64 = 0.25;
/// Largest enlargement of a photograph, in pixels of the window for one pixel of the photograph.
const MOST: f64 = 64.0;

/// A photograph from a file.
#[derive(Debug)]
pub struct Photo {
    pub path: PathBuf,
    pub photograph: Photograph,
    /// Map of the zoom, if `gpc zoom` made the image.
    pub zoom: Option<ZoomMap>,
}

impl Photo {
    /// Reads a file.
    pub fn open(path: &Path) -> anyhow::Result<Self> {
        let name = path.display().to_string();
        let bytes = std::fs::read(path).with_context(|| format!("{name} can't be read"))?;
        let (photograph, zoom) = if Zoomed::is_in(&bytes) {
            let Zoomed { photograph, map } = Zoomed::decode(&bytes, &name)?;
            (photograph, Some(map))
        } else {
            (Photograph::from(&output::decode(&bytes, &name)?), None)
        };
        Ok(Self { path: path.to_owned(), photograph, zoom })
    }
}

/// The part of a photograph that the window shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Framing {
    /// Place in the photograph at the window's upper left corner, in pixels of the photograph.
    corner: DVec2,
    /// Pixels of the photograph for one pixel of the window.
    step: f64,
}

impl Framing {
    /// Framing of a whole photograph in the middle of the window: pixel for pixel if there is room, otherwise scaled
    /// down.
    pub fn fitting(photograph: [u32; 2], window: [u32; 2]) -> Self {
        let [photograph, window] = [photograph, window].map(|size| DVec2::from(size.map(f64::from)));
        let step = (photograph / window).max_element().max(1.0);
        // A whole number of pixels lets each pixel of the window show one of the photograph.
        let corner = (0.5 * (photograph - step * window)).floor();
        Self { corner, step }
    }

    /// The place in the photograph under a place of the window.
    pub fn place(&self, pointer: DVec2) -> DVec2 {
        self.corner + self.step * pointer
    }

    /// Pixels of the photograph for one pixel of the window.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Moves the photograph by a drag in the window.
    pub fn pan(&mut self, drag: DVec2) {
        self.corner -= self.step * drag;
    }

    /// Enlarges the photograph by a factor around a place of the window.
    pub fn zoom(&mut self, factor: f64, pointer: DVec2) {
        let fixed = self.place(pointer);
        self.step = (self.step / factor).clamp(1.0 / MOST, MOST);
        self.corner = fixed - self.step * pointer;
    }

    fn window(&self, size: [u32; 2]) -> Window {
        Window { size, corner: self.corner.to_array(), step: self.step }
    }
}

/// A photograph that the window shows.
#[derive(Clone, Debug)]
pub struct Easel {
    pub photo: Arc<Photo>,
    pub framing: Framing,
    /// Whether the image is unzoomed around the pointer.
    pub unzooms: bool,
}

impl Easel {
    /// Shows a whole photograph in a window of `window` = [width, height].
    pub fn new(photo: Photo, window: [u32; 2]) -> Self {
        Self { framing: Framing::fitting(photo.photograph.size(), window), photo: Arc::new(photo), unzooms: false }
    }

    /// Picture of the visible part, for a window of `size` = [width, height].
    pub fn view(&self, size: [u32; 2], map: Option<ZoomMap>, tints: bool, pointer: DVec2) -> PhotoView {
        PhotoView {
            photo: self.photo.clone(),
            window: self.framing.window(size),
            map,
            tints,
            loupe: self.unzooms.then_some(pointer),
        }
    }

    /// Index of the zoomed region under a place of the window, if there is one.
    pub fn region_at(&self, pointer: DVec2) -> Option<usize> {
        let place = self.framing.place(pointer);
        let regions = self.photo.zoom.as_ref()?.regions();
        regions.iter().position(|region| region.contains(place))
    }

    /// Picture of the whole photograph with lenses, as `gpc zoom` makes it.
    pub fn whole(&self, map: ZoomMap) -> PhotoView {
        PhotoView {
            photo: self.photo.clone(),
            window: Window { size: self.photo.photograph.size(), corner: [0.0, 0.0], step: 1.0 },
            map: Some(map),
            tints: false,
            loupe: None,
        }
    }
}

/// A picture to make of a photograph.
#[derive(Clone, Debug)]
pub struct PhotoView {
    photo: Arc<Photo>,
    pub window: Window,
    /// Map of the lenses.
    pub map: Option<ZoomMap>,
    tints: bool,
    /// The place in the window around which the image is unzoomed.
    loupe: Option<DVec2>,
}

impl PhotoView {
    /// Pixels of the picture: rows of linear light with premultiplied alpha.
    pub fn pixels(&self) -> Vec<[f32; 4]> {
        self.photo.photograph.resample(self.window.size, |place| self.look(place))
    }

    /// Colour of a pixel whose own colour is `code`, with overlays: black outside of the photograph, a tint, or the
    /// frame of the loupe. `place` is the pixel's centre.
    pub fn covered(&self, code: [u8; 4], place: DVec2) -> [u8; 4] {
        let plane = self.window.location(place);
        if let Some(distance) = self.outside_loupe(place)
            && (0.0..1.0).contains(&distance)
        {
            return [255; 4];
        }
        let location = match self.unzoomed(place) {
            Some((location, _)) => location,
            None => plane,
        };
        let size = DVec2::from(self.photo.photograph.size().map(f64::from));
        if location.cmplt(DVec2::ZERO).any() || location.cmpgt(size).any() {
            return [0, 0, 0, 255];
        }
        match &self.map {
            Some(map) if self.tints => tinted(code, plane, map.regions()),
            _ => code,
        }
    }

    /// Location in the photograph that a place of the window shows, and its Jacobian.
    fn look(&self, place: DVec2) -> (DVec2, DMat2) {
        if let (Some((location, rate)), Some(map)) = (self.unzoomed(place), &self.photo.zoom) {
            return zoomed_location(map, location, DMat2::from_diagonal(DVec2::splat(rate)));
        }
        let plane = self.window.location(place);
        let jacobian = self.window.jacobian(place);
        match &self.map {
            Some(map) => (map.location(plane), map.jacobian(plane) * jacobian),
            None => (plane, jacobian),
        }
    }

    /// Location in the ordinary (not zoomed) view for a place inside of the loupe, and the distance between the
    /// locations of neighbouring pixels. The middle of the loupe shows the same as the image, in the same size.
    fn unzoomed(&self, place: DVec2) -> Option<(DVec2, f64)> {
        let (middle, map) = (self.loupe?, self.photo.zoom.as_ref()?);
        if self.outside_loupe(place)? >= 0.0 {
            return None;
        }
        let plane = self.window.location(middle);
        let rate = map.jacobian(plane).determinant().abs().sqrt() * self.window.step;
        Some((map.location(plane) + rate * (place - middle), rate))
    }

    /// Distance of a place from the loupe's edge, negative inside; `None` without a loupe.
    fn outside_loupe(&self, place: DVec2) -> Option<f64> {
        let half = LOUPE * f64::from(self.window.size[1]);
        Some((place - self.loupe?).abs().max_element() - half)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gpc::camera::zoom::{Shape, Transition, ZoomRegion};
    use gpc::output::{Format, Picture};

    const SIZE: [u32; 2] = [40, 30];

    fn region() -> ZoomRegion {
        ZoomRegion {
            center: [20.0, 15.0],
            radius: [6.0, 6.0],
            multiplicity: 0.5,
            shape: Shape::Circle,
            transition: Transition::Linear,
        }
    }

    /// A photograph whose colours are the locations of its pixels.
    fn easel(map: Option<&ZoomMap>) -> Easel {
        let places = (0..SIZE[1]).flat_map(|row| (0..SIZE[0]).map(move |col| (col, row)));
        let color = |(col, row): (u32, u32)| {
            let place = DVec2::new(f64::from(col) + 0.5, f64::from(row) + 0.5);
            let location = map.map_or(place, |map| map.location(place));
            [location.x as f32 / 40.0, location.y as f32 / 30.0, 0.0, 1.0]
        };
        let pixels: Vec<_> = places.map(color).collect();
        let picture = Picture::new(SIZE, &pixels).unwrap();
        let mut png = output::encode(Format::Png16, &picture, &[]).unwrap();
        if let Some(map) = map {
            png = Zoomed::add_map(&png, SIZE, map).unwrap();
        }
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), png).unwrap();
        assert!(output::is_image(file.path()));
        Easel::new(Photo::open(file.path()).unwrap(), SIZE)
    }

    fn pixel(pixels: &[[f32; 4]], [x, y]: [u32; 2]) -> DVec2 {
        let [r, g, ..] = pixels[(y * SIZE[0] + x) as usize];
        DVec2::new(f64::from(r) * 40.0, f64::from(g) * 30.0)
    }

    #[test]
    fn a_photograph_is_shown_as_it_is_where_there_is_room() {
        let whole = Framing::fitting([100, 50], [300, 200]);
        assert_eq!((whole.corner, whole.step), (DVec2::new(-100.0, -75.0), 1.0));
        let smaller = Framing::fitting([1000, 500], [100, 100]);
        assert_eq!((smaller.corner, smaller.step), (DVec2::new(0.0, -250.0), 10.0));
        let mut framing = smaller;
        let pointer = DVec2::new(30.0, 60.0);
        let fixed = framing.place(pointer);
        framing.zoom(4.0, pointer);
        assert_eq!((framing.place(pointer), framing.step), (fixed, 2.5));
        framing.pan(DVec2::new(-30.0, -60.0));
        assert_eq!(framing.place(DVec2::ZERO), fixed);
        framing.zoom(1e9, pointer);
        assert_eq!(framing.step, 1.0 / MOST);
    }

    #[test]
    fn lenses_show_what_a_zoom_looks_at() {
        let easel = easel(None);
        let map = ZoomMap::new(vec![region()]).unwrap();
        let view = easel.view(SIZE, Some(map.clone()), false, DVec2::ZERO);
        let pixels = view.pixels();
        for place in [[20, 15], [23, 16], [30, 15], [2, 2]] {
            let [x, y] = place.map(|v| f64::from(v) + 0.5);
            let expected = map.location(DVec2::new(x, y));
            let shift = pixel(&pixels, place) - expected;
            assert!(shift.length() < 0.2, "{place:?}: {shift}");
        }
        assert_eq!(easel.whole(map).pixels(), pixels);
    }

    #[test]
    fn a_loupe_shows_the_ordinary_view() {
        let map = ZoomMap::new(vec![region()]).unwrap();
        let mut easel = easel(Some(&map));
        let middle = DVec2::new(20.0, 15.0);
        let zoomed = easel.view(SIZE, None, false, middle).pixels();
        easel.unzooms = true;
        let view = easel.view(SIZE, None, false, middle);
        let pixels = view.pixels();
        // The loupe reaches 7.5 pixels to each side; each pixel is half a pixel of the image plane.
        for place in [[20, 15], [15, 12], [26, 21]] {
            let [x, y] = place.map(|v| f64::from(v) + 0.5);
            let expected = middle + 0.5 * (DVec2::new(x, y) - middle);
            let shift = pixel(&pixels, place) - expected;
            assert!(shift.length() < 0.2, "{place:?}: {shift}");
        }
        assert_eq!(pixel(&pixels, [5, 5]), pixel(&zoomed, [5, 5]));
        let code = [9, 9, 9, 255];
        assert_eq!(view.covered(code, DVec2::new(28.0, 15.0)), [255; 4]);
        assert_eq!(view.covered(code, DVec2::new(20.0, 15.0)), code);
        easel.framing.pan(DVec2::new(10.0, 0.0));
        let beside = easel.view(SIZE, None, false, middle);
        assert_eq!(beside.covered(code, DVec2::new(5.0, 15.0)), [0, 0, 0, 255]);
    }
}
