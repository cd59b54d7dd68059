//! Zoomed images that store the map of their zoom, so that ordinary views can be made from them without the scene.

use super::Photograph;
use crate::camera::LocationMap;
use crate::camera::zoom::{ZoomError, ZoomMap, ZoomRegion};
use crate::output::{self, OutputError};
use glam::{DMat2, DVec2};
use serde::{Deserialize, Serialize};

/// Keyword of the text chunk that stores the map.
const KEYWORD: &str = "gpc zoom";

/// Content of the text chunk, in JSON.
#[derive(Serialize, Deserialize)]
struct ZoomText {
    /// Width and height of the image in pixels, in which the regions are given.
    size: [u32; 2],
    regions: Vec<ZoomRegion>,
}

/// Zoomed image and its map.
#[derive(Clone, Debug, PartialEq)]
pub struct Zoomed {
    /// Zoomed image as a photograph.
    pub photograph: Photograph,
    /// Map of the zoom.
    pub map: ZoomMap,
}

/// Error: a file that is not a zoomed image.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ZoomedError {
    /// File that is not an image.
    #[error(transparent)]
    Image(#[from] OutputError),
    /// Image without a zoom's map.
    #[error("{0}: it holds no zoom; give a PNG as gpc zoom wrote it, not converted")]
    NoZoom(String),
    /// Map that is not a valid JSON text of a zoom.
    #[error("{name}: the zoom that it holds can't be read: {source}")]
    Broken {
        /// Name of the file.
        name: String,
        /// Error of the JSON reader.
        source: serde_json::Error,
    },
    /// Text whose regions are not a valid map.
    #[error("{name}: {source}")]
    Map {
        /// Name of the file.
        name: String,
        /// Error of the map.
        source: ZoomError,
    },
    /// Image that was cropped or scaled after it was zoomed.
    #[error(
        "{name}: its zoom is one of {} x {} pixels, but it has {} x {}; give it as gpc zoom wrote it",
        .stored_size[0], .stored_size[1], .found[0], .found[1]
    )]
    Size {
        /// Name of the file.
        name: String,
        /// Width and height of the image when it was zoomed.
        stored_size: [u32; 2],
        /// Width and height of the image now.
        found: [u32; 2],
    },
}

impl Zoomed {
    /// Inserts the map of a zoomed image of `size` = [width, height] into its PNG.
    ///
    /// # Errors
    /// [`OutputError::Encode`] if the bytes are no PNG.
    pub fn add_map(png: &[u8], size: [u32; 2], map: &ZoomMap) -> Result<Vec<u8>, OutputError> {
        let stored = ZoomText { size, regions: map.regions().to_vec() };
        let text = serde_json::to_string(&stored).map_err(|error| OutputError::Encode(error.to_string()))?;
        output::add_text(png, KEYWORD, &text)
    }

    /// Whether a file holds the map of a zoom.
    #[must_use]
    pub fn is_in(bytes: &[u8]) -> bool {
        output::find_text(bytes, KEYWORD).is_some()
    }

    /// Decodes a zoomed PNG and its map; `name` stands for the file in messages.
    ///
    /// # Errors
    /// [`ZoomedError`] if the file is no image, or if its map is missing, broken or for another size.
    pub fn decode(bytes: &[u8], name: &str) -> Result<Self, ZoomedError> {
        let photograph = Photograph::from(&output::decode(bytes, name)?);
        let name = name.to_owned();
        let Some(text) = output::find_text(bytes, KEYWORD) else {
            return Err(ZoomedError::NoZoom(name));
        };
        let stored: ZoomText = match serde_json::from_str(&text) {
            Ok(stored) => stored,
            Err(source) => return Err(ZoomedError::Broken { name, source }),
        };
        let found = photograph.size();
        if stored.size != found {
            let stored_size = stored.size;
            return Err(ZoomedError::Size { name, stored_size, found });
        }
        match ZoomMap::new(stored.regions) {
            Ok(map) => Ok(Self { photograph, map }),
            Err(source) => Err(ZoomedError::Map { name, source }),
        }
    }
}

/// Location in a zoomed image, and its Jacobian, for a location in the ordinary image plane; `jacobian` is the change of that
/// location per column and row of the output. [`Photograph::sample`] takes the result.
#[must_use]
pub fn zoomed_location(map: &ZoomMap, location: DVec2, jacobian: DMat2) -> (DVec2, DMat2) {
    let place = map.inverse(location);
    (place, map.jacobian(place).inverse() * jacobian)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::zoom::{Shape, Transition};
    use crate::output::{Format, Picture};

    fn region() -> ZoomRegion {
        ZoomRegion {
            center: [8.0, 6.0],
            radius: [3.0, 3.0],
            multiplicity: 0.5,
            shape: Shape::Circle,
            transition: Transition::Linear,
        }
    }

    fn png() -> Vec<u8> {
        let pixels = vec![[0.5, 0.25, 0.0, 1.0]; 16 * 12];
        let picture = Picture::new([16, 12], &pixels).unwrap();
        output::encode(Format::Png8, &picture, &[]).unwrap()
    }

    #[test]
    fn a_map_is_found_in_its_image() {
        let map = ZoomMap::new(vec![region()]).unwrap();
        let bytes = Zoomed::add_map(&png(), [16, 12], &map).unwrap();
        assert!(Zoomed::is_in(&bytes) && !Zoomed::is_in(&png()));
        let zoomed = Zoomed::decode(&bytes, "a.png").unwrap();
        assert_eq!(zoomed.map, map);
        let (place, jacobian) = zoomed_location(&map, DVec2::new(9.0, 6.0), 0.5 * DMat2::IDENTITY);
        assert!((place - DVec2::new(10.0, 6.0)).length() < 1e-9);
        assert!((jacobian.col(0) - DVec2::X).length() < 1e-9);
    }

    #[test]
    fn what_is_no_zoom_is_refused() {
        let refused = |bytes: &[u8]| Zoomed::decode(bytes, "a.png").unwrap_err().to_string();
        assert!(refused(&png()).contains("it holds no zoom"));
        let map = ZoomMap::new(vec![region()]).unwrap();
        let other = Zoomed::add_map(&png(), [12, 16], &map).unwrap();
        assert!(refused(&other).contains("one of 12 x 16 pixels, but it has 16 x 12"));
        let nonsense = output::add_text(&png(), KEYWORD, "{}").unwrap();
        assert!(refused(&nonsense).contains("can't be read"));
        let empty = output::add_text(&png(), KEYWORD, r#"{"size":[16,12],"regions":[]}"#).unwrap();
        assert!(refused(&empty).contains("no region"));
    }
}
