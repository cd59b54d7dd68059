//! Pictures for the report, as data URIs.

use super::measurement::Yardstick;
use super::pictures::{CropBox, ErrorMap, colors, small_jpeg};
use super::split::{Pieces, reason};
use gpc::output::DecodedImage;

/// The pictures of one scene.
#[derive(Default)]
pub struct Gallery {
    /// The whole image in several versions, scaled down.
    pub overview: Vec<Version>,
    /// Enlarged parts of the image.
    pub parts: Vec<Part>,
}

/// An image of superpixels, and its error, split.
pub struct GalleryImage {
    /// Samples a superpixel.
    pub samples: u32,
    pub image: DecodedImage,
    pub pieces: Pieces,
}

/// A picture and its caption.
pub struct Version {
    pub caption: String,
    pub data: String,
}

/// A part of the image in several versions.
pub struct Part {
    /// Title: the effect that the example shows.
    pub title: String,
    pub window: CropBox,
    pub versions: Vec<Version>,
}

impl Gallery {
    /// Makes the pictures; `ssaa` is the image of supersampling with as many samples as the superpixels.
    pub fn new(
        yardstick: &Yardstick,
        ssaa: Option<&DecodedImage>,
        superpixels: Option<&GalleryImage>,
    ) -> anyhow::Result<Self> {
        let truth = yardstick.reference();
        let method = |name: String, image| MethodKind { errors: ErrorMap::new(truth, image), name, image };
        let mut images = vec![method("one sample".to_owned(), yardstick.one_sample())];
        let mut worst = vec![(0, "Where one sample a pixel errs most".to_owned())];
        if let Some(shown) = superpixels {
            if let Some(ssaa) = ssaa {
                images.push(method(format!("ssaa {}", shown.samples), ssaa));
            }
            let superpixels = method(format!("superpixel {}", shown.samples), &shown.image);
            let window = superpixels.errors.worst_window();
            let blame = shown.blame(&superpixels.errors, window);
            worst.push((images.len(), format!("Where superpixels err most: {blame}")));
            images.push(superpixels);
        }
        let mut overview = vec![version("truth", small_jpeg(truth.size, &colors(truth))?)];
        for MethodKind { name, errors, .. } in &images {
            let picture = small_jpeg(truth.size, &errors.colors())?;
            overview.push(version(&format!("error of {name}"), picture));
        }
        let mut parts = Vec::new();
        for (index, title) in worst {
            let Some(method) = images.get(index) else {
                continue;
            };
            let window = method.errors.worst_window();
            parts.push(Part { title, versions: versions(window, truth, &images)?, window });
        }
        Ok(Self { overview, parts })
    }
}

impl GalleryImage {
    /// Causes of the squared error in a window, the largest share first.
    fn blame(&self, errors: &ErrorMap, window: CropBox) -> String {
        let mut shares: Vec<(&str, f64)> = Vec::new();
        for (pixel, square) in errors.squares(window) {
            let cause = self.pieces.causes.get(pixel).copied();
            let name = reason(cause, self.pieces.faults.get(pixel).copied().flatten());
            match shares.iter_mut().find(|(known, _)| *known == name) {
                Some((_, share)) => *share += square,
                None => shares.push((name, square)),
            }
        }
        let whole: f64 = shares.iter().map(|(_, share)| share).sum();
        if whole <= 0.0 {
            return "nowhere".to_owned();
        }
        shares.sort_by(|a, b| b.1.total_cmp(&a.1));
        let named: Vec<_> = shares
            .iter()
            .map(|(name, share)| (name, 100.0 * share / whole))
            .filter(|(_, percent)| *percent >= LEAST_PERCENT)
            .map(|(name, percent)| format!("{name} {percent:.0} %"))
            .collect();
        named.join(", ")
    }
}

/// Smallest share of a window's error that is named, in percent.
const LEAST_PERCENT: f64 = 5.0;

/// The image that a method made, and its errors.
struct MethodKind<'a> {
    name: String,
    image: &'a DecodedImage,
    errors: ErrorMap,
}

fn versions(window: CropBox, reference: &DecodedImage, images: &[MethodKind<'_>]) -> anyhow::Result<Vec<Version>> {
    let size = reference.size;
    let mut versions = vec![version("truth", window.png(size, &colors(reference))?)];
    for MethodKind { name, image, .. } in images {
        versions.push(version(name, window.png(size, &colors(image))?));
    }
    // The last method is the one that the gallery is about.
    if let Some(MethodKind { name, errors, .. }) = images.last() {
        let picture = window.png(size, &errors.colors())?;
        versions.push(version(&format!("error of {name}"), picture));
    }
    Ok(versions)
}

fn version(caption: &str, data: String) -> Version {
    Version { caption: caption.to_owned(), data }
}
