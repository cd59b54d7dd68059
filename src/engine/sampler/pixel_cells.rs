//! Cells that are pixels of an image.

use super::{Sampler, SamplerContext, Source, averaging};
use crate::engine::data::{Cells, HostImage};
use crate::engine::passes::detect::{self, DetectMode, DetectOptions};
use crate::engine::passes::resolve::ResolveTarget;
use crate::engine::passes::{SampleOptions, grow, thin};
use crate::engine::sampler::{Detection, EngineError, SuperpixelOptions};
use crate::sampling::{Bend, PixelFilter};
use std::sync::Arc;

/// The pixels of an image that become cells.
pub(crate) struct PixelCells {
    /// Rule by which pixels become cells.
    pub mode: DetectMode,
    /// Whether pixels that a thin triangle crosses without covering a centre become cells too.
    pub thin: bool,
    /// Whether pixels in which such a triangle stands at an angle to the surface at the centre become cells too.
    pub folds: bool,
    /// Factor and offset that convert values of the depth image to reversed depth, in which larger values are nearer.
    pub depth_of_image: [f32; 2],
    /// Whether IDs of the nearest BLEND triangles exist.
    pub blend_ids: bool,
    /// Whether the triangle IDs are multisampled.
    pub multisampled: bool,
    /// Number of samples of a cell.
    pub samples: u32,
    /// Number of times that superpixels grow.
    pub growths: u32,
    /// Whether a later `detect`, of another sampler, compares the resolved colours.
    pub detected: bool,
    /// Image of the host with the colours behind the triangles; `None` for the settings' background.
    pub behind: Option<Arc<HostImage>>,
    /// For a pixel filter, the function by which the spread of cells is described; `None` if it is not stored.
    pub spread: Option<Bend>,
    /// Distance in pixels from the region's own pixels to the farthest cells that they depend on.
    pub reach: u32,
}

impl DetectMode {
    /// Rule of `detect` for a setting.
    pub(crate) fn of(options: &SuperpixelOptions) -> Self {
        match options.detection {
            Detection::Contrast if options.has_many_samples() => Self::SecondDifferences,
            Detection::Contrast => Self::Contrast,
            Detection::Edges => Self::Edges,
            Detection::Exact => Self::Exact,
            Detection::Every => Self::Every,
        }
    }
}

impl PixelCells {
    /// Superpixels with these options.
    pub fn superpixels(options: &SuperpixelOptions) -> Self {
        Self {
            mode: DetectMode::of(options),
            thin: options.thin && options.detection != Detection::Every,
            folds: options.has_many_samples(),
            depth_of_image: [1.0, 0.0],
            blend_ids: true,
            multisampled: false,
            samples: options.cells.samples,
            growths: options.growth_count(),
            detected: false,
            behind: None,
            spread: None,
            reach: 0,
        }
    }

    /// These cells, for a pixel filter.
    pub fn filtered(self, filter: &PixelFilter) -> Self {
        Self { spread: filter.spread(), reach: filter.reach(), ..self }
    }

    /// Makes a sampler for these cells.
    ///
    /// # Errors
    /// If the driver refuses a pipeline, or memory runs out.
    pub fn sampler(&self, context: &SamplerContext<'_>) -> Result<Sampler, EngineError> {
        let SamplerContext { layout, scene, settings, sizes, .. } = *context;
        let options = SampleOptions {
            always_blends: self.mode == DetectMode::Blended,
            spread: self.spread,
            ..context.sample_options(Cells::Pixels, self.samples)
        };
        let blend_ids = self.blend_ids && scene.has_blend();
        let source = || {
            let options = DetectOptions {
                mode: self.mode,
                blend_ids,
                thin: self.thin,
                transparent: settings.background.is_none() || self.behind.is_some(),
                multisampled: self.multisampled,
                shadow_words: match self.mode {
                    DetectMode::Blended => 0,
                    _ => sizes.shadow_words,
                },
                beyond: self.growths + self.reach,
            };
            let thin = || thin::pass(layout, scene, blend_ids, self.folds, self.depth_of_image);
            Ok(Source::Pixels {
                thin: self.thin.then(thin).transpose()?,
                detect: detect::pass(layout, &options)?,
                growths: (0..self.growths)
                    .rev()
                    .map(|beyond| grow::pass(layout, beyond + self.reach))
                    .collect::<Result<_, _>>()?,
            })
        };
        let target = match (self.growths > 0, self.detected) {
            (true, _) => ResolveTarget::Grow,
            (false, true) => ResolveTarget::Detect,
            (false, false) => ResolveTarget::Nothing,
        };
        Sampler::new(context, &options, source, |blocks| averaging(context, blocks, target, self.behind.as_ref()))
    }
}
