//! Zoomed images that hold their map, so that an ordinary view can be made of them without the scene.

use super::Photograph;
use crate::camera::LocationMap;
use crate::camera::zoom::{ZoomError, ZoomMap, ZoomRegion};
use crate::output::{self, OutputError};
use glam::{DMat2, DVec2};
use serde::{Deserialize, Serialize};

/// Keyword of the text in a PNG.
const KEYWORD: &str = "gpc zoom";

/// What the text says, as JSON.
#[derive(Serialize, Deserialize)]
struct Record {
    /// Width and height of the image, in whose pixels the regions are given.
    size: [u32; 2],
    regions: Vec<ZoomRegion>,
}

/// An image of which regions were enlarged, and the map that it was made with.
#[derive(Clone, Debug, PartialEq)]
pub struct Zoomed {
    photograph: Photograph,
    map: ZoomMap,
}

/// A file holds no zoomed image.
#[derive(Debug, thiserror::Error)]
pub enum ZoomedError {
    /// It is no image.
    #[error(transparent)]
    Image(#[from] OutputError),
    /// It says nothing of a zoom.
    #[error("{0}: it holds no zoom; give a PNG as gpc zoom wrote it, not converted")]
    NoRecord(String),
    /// What it says of a zoom makes no sense.
    #[error("{name}: the zoom that it holds can't be read: {source}")]
    Record {
        /// The file.
        name: String,
        /// What is wrong.
        source: serde_json::Error,
    },
    /// What it says is possible for no zoom.
    #[error("{name}: {source}")]
    Map {
        /// The file.
        name: String,
        /// What is wrong.
        source: ZoomError,
    },
    /// It was cropped or scaled since.
    #[error(
        "{name}: its zoom is one of {} x {} pixels, but it has {} x {}; give it as gpc zoom wrote it",
        .recorded[0], .recorded[1], .found[0], .found[1]
    )]
    Size {
        /// The file.
        name: String,
        /// Width and height that the zoom is of.
        recorded: [u32; 2],
        /// Width and height of the image.
        found: [u32; 2],
    },
}

impl Zoomed {
    /// Puts the map of a zoomed image of `size` = width and height in pixels into the PNG that holds it.
    ///
    /// # Errors
    /// [`OutputError::Encode`] if the bytes are no PNG.
    pub fn add_map(png: &[u8], size: [u32; 2], map: &ZoomMap) -> Result<Vec<u8>, OutputError> {
        let record = Record {
            size,
            regions: map.regions().to_vec(),
        };
        let text = serde_json::to_string(&record)
            .map_err(|error| OutputError::Encode(error.to_string()))?;
        output::add_text(png, KEYWORD, &text)
    }

    /// Whether a file says that it holds a zoomed image.
    #[must_use]
    pub fn is_in(bytes: &[u8]) -> bool {
        output::find_text(bytes, KEYWORD).is_some()
    }

    /// Reads a PNG that holds its map; `name` is for errors.
    ///
    /// # Errors
    /// If it is no image, or its map is missing or not its own.
    pub fn decode(bytes: &[u8], name: &str) -> Result<Self, ZoomedError> {
        let photograph = Photograph::from(&output::decode(bytes, name)?);
        let name = name.to_owned();
        let Some(text) = output::find_text(bytes, KEYWORD) else {
            return Err(ZoomedError::NoRecord(name));
        };
        let record: Record = match serde_json::from_str(&text) {
            Ok(record) => record,
            Err(source) => return Err(ZoomedError::Record { name, source }),
        };
        let found = photograph.size();
        if record.size != found {
            let recorded = record.size;
            return Err(ZoomedError::Size {
                name,
                recorded,
                found,
            });
        }
        match ZoomMap::new(record.regions) {
            Ok(map) => Ok(Self { photograph, map }),
            Err(source) => Err(ZoomedError::Map { name, source }),
        }
    }

    /// The image as it is.
    #[must_use]
    pub fn photograph(&self) -> &Photograph {
        &self.photograph
    }

    /// The map that it was made with.
    #[must_use]
    pub fn map(&self) -> &ZoomMap {
        &self.map
    }

    /// Where in the image a location of the plane is found, given what it changes by for each column and row of the
    /// output; what [`Photograph::sample`] takes.
    #[must_use]
    pub fn place(&self, location: DVec2, jacobian: DMat2) -> (DVec2, DMat2) {
        let place = self.map.inverse(location);
        (place, self.map.jacobian(place).inverse() * jacobian)
    }
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
        assert_eq!(zoomed.map(), &map);
        let (place, jacobian) = zoomed.place(DVec2::new(9.0, 6.0), 0.5 * DMat2::IDENTITY);
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
