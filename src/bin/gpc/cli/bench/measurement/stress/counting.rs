//! Counts of how often triangles hit samples.

use super::stage::{Stage, flat};
use gpc::camera::Camera;
use gpc::render::{Headless, RenderError, Settings};
use gpc::scene::AlphaMode;

/// Numbers of hits of samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Hits {
    /// Number of samples that were checked.
    pub samples: u64,
    /// Number of samples that no opaque triangle covers.
    pub holes: f64,
    /// Number of hits by translucent triangles minus the number of samples that opaque triangles cover.
    pub excess: f64,
}

impl Hits {
    pub fn add(&mut self, other: Self) {
        self.samples += other.samples;
        self.holes += other.holes;
        self.excess += other.excess;
    }
}

/// Counts the hits of a stage's triangles, in the pixels for which `counts` is true of column and row.
///
/// The count is read from the alpha. If all triangles are opaque, a pixel's alpha is the share of its samples that
/// were hit. If all have an alpha of one half, a sample that was hit once contributes a half and one that was hit
/// twice three quarters.
pub(super) fn count(
    headless: &mut Headless,
    stage: &Stage,
    settings: &Settings,
    camera: &Camera,
    counts: impl Fn([u32; 2]) -> bool,
) -> Result<Hits, RenderError> {
    let settings = settings.clone().attributes(true);
    let mut alphas = |opacity: f32, mode: AlphaMode| {
        let stage = Stage { materials: vec![flat([1.0, 1.0, 1.0, opacity], mode)], ..stage.clone() };
        stage.seen_by(headless, &settings, camera)
    };
    let opaque = alphas(1.0, AlphaMode::Opaque)?;
    let halves = alphas(0.5, AlphaMode::Blend)?;
    let mut hits = Hits::default();
    let colors = opaque.colors.iter().zip(&halves.colors);
    let pixels = opaque.attributes.iter().zip(&halves.attributes);
    for (pixel, ((opaque, half), seen)) in (0..).zip(colors.zip(pixels)) {
        let [width, _] = settings.size;
        if !counts([pixel % width, pixel / width]) {
            continue;
        }
        let [opaque, half] = [opaque, half].map(|color| f64::from(color[3]));
        // The two materials may make different pixels superpixels.
        let [samples, translucent] = [seen.0, seen.1].map(|seen| f64::from(seen.samples));
        hits.samples += u64::from(seen.0.samples);
        // A mean over a number of samples that is no power of two is rounded, by far less than the weight of a sample.
        hits.holes += (samples * (1.0 - opaque)).round().abs();
        hits.excess += (translucent * (half - 0.5 * opaque) / 0.25).round().abs();
    }
    Ok(hits)
}
