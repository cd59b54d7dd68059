//! The parameters of a zoom, in the image that it made.

use gpc::camera::zoom::{ZoomMap, ZoomRegion};
use serde::{Deserialize, Serialize};

/// Keyword of the text in a PNG.
pub const KEYWORD: &str = "gpc zoom";

/// What `gpc unzoom` needs to know.
#[derive(Serialize, Deserialize)]
pub struct Record {
    /// Width and height of the image, in whose pixels the regions are given.
    pub size: [u32; 2],
    pub regions: Vec<ZoomRegion>,
}

impl Record {
    pub fn new(size: [u32; 2], map: &ZoomMap) -> Self {
        Self {
            size,
            regions: map.regions().to_vec(),
        }
    }
}
