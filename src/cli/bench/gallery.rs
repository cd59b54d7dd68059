//! Pictures for the report, as data URIs.

use super::pictures::{ErrorMap, Window, colors, small_jpeg};
use gpc::bench::Yardstick;
use gpc::output::DecodedImage;

/// The pictures of one scene.
pub struct Gallery {
    /// The whole image in several versions, small.
    pub overview: Vec<Version>,
    /// Parts that are enlarged.
    pub parts: Vec<Part>,
}

/// A picture and its caption.
pub struct Version {
    pub caption: String,
    pub data: String,
}

/// A part of the image in several versions.
pub struct Part {
    /// What it is an example of.
    pub title: &'static str,
    pub window: Window,
    pub versions: Vec<Version>,
}

impl Gallery {
    /// Draws the pictures; `superpixels` is an image and its samples a superpixel.
    pub fn new(
        yardstick: &Yardstick,
        superpixels: Option<&(u32, DecodedImage)>,
    ) -> anyhow::Result<Self> {
        let reference = yardstick.reference();
        let mut images = vec![("one sample".to_owned(), yardstick.one_sample())];
        if let Some((samples, image)) = superpixels {
            images.push((format!("superpixel {samples}"), image));
        }
        let images: Vec<_> = images
            .into_iter()
            .map(|(name, image)| Method {
                errors: ErrorMap::new(reference, image),
                name,
                image,
            })
            .collect();
        let mut overview = vec![version(
            "reference",
            small_jpeg(reference.size, &colors(reference))?,
        )];
        for Method { name, errors, .. } in &images {
            let picture = small_jpeg(reference.size, &errors.colors())?;
            overview.push(version(&format!("error of {name}"), picture));
        }
        let mut parts = Vec::new();
        for (worst, title) in images.iter().zip([
            "Where one sample a pixel errs most",
            "Where superpixels err most",
        ]) {
            let window = worst.errors.worst_window();
            parts.push(Part {
                title,
                versions: versions(window, reference, &images)?,
                window,
            });
        }
        Ok(Self { overview, parts })
    }
}

/// The image of a method.
struct Method<'a> {
    name: String,
    image: &'a DecodedImage,
    errors: ErrorMap,
}

fn versions(
    window: Window,
    reference: &DecodedImage,
    images: &[Method<'_>],
) -> anyhow::Result<Vec<Version>> {
    let size = reference.size;
    let mut versions = vec![version("reference", window.png(size, &colors(reference))?)];
    for Method { name, image, .. } in images {
        versions.push(version(name, window.png(size, &colors(image))?));
    }
    // The last method is the one that the report is about.
    if let Some(Method { name, errors, .. }) = images.last() {
        let picture = window.png(size, &errors.colors())?;
        versions.push(version(&format!("error of {name}"), picture));
    }
    Ok(versions)
}

fn version(caption: &str, data: String) -> Version {
    Version {
        caption: caption.to_owned(),
        data,
    }
}
