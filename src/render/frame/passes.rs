//! The passes that a frame's settings need.

use crate::engine::data::{Cells, Content};
use crate::engine::passes::detect::DetectMode;
use crate::engine::passes::pixel_filter::{self, Alpha, Superpixels};
use crate::engine::passes::{FragmentRate, Raster, resolve, sort};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::sampler::{Job, PixelCells, Sampler, fragment_rate};
use crate::render::data::GpuScene;
use crate::render::passes::{Encoding, PosePass, ShadeSource, StrokePass};
use crate::render::passes::{attributes, box_filter, encode, merge, multisample, shade, spans};
use crate::render::{Detection, Method, RenderError, Settings};
use ash::vk;
use std::sync::Arc;

/// Passes that shade the centres of pixels.
pub(super) struct PixelShading {
    pub spans: Pass,
    pub shade: Pass,
}

/// Passes that turn the device's multisampling into colours.
pub(super) struct Multisampling {
    pub multisample: Pass,
    pub sort: Pass,
    pub resolve: Pass,
}

/// The pipelines of a frame, in the order in which they run.
pub(super) struct Passes {
    pub pose: Option<PosePass>,
    pub stroke: Option<StrokePass>,
    pub raster: Raster,
    pub pixels: Option<PixelShading>,
    pub multisampling: Option<Multisampling>,
    /// Shading of visibility samples, shared by samplers and multisampling.
    pub shade: Option<Arc<Pass>>,
    pub blended: Option<Sampler>,
    pub superpixels: Option<Sampler>,
    /// Merging and sorting of the superpixels' visibility samples.
    pub merge: Option<Pass>,
    pub attributes: Option<Pass>,
    /// Filter of the pixels, unless each is a colour of its own.
    pub filter: Option<Pass>,
    /// Conversion of the colours to the encoding of the target; `None` for floats of 32 bits.
    pub encode: Option<(Encoding, Pass)>,
}

/// Number of samples a pixel with which the rasterizer draws.
pub(super) fn raster_samples(settings: &Settings) -> vk::SampleCountFlags {
    match settings.method {
        Method::Msaa { samples } => vk::SampleCountFlags::from_raw(samples),
        _ => vk::SampleCountFlags::TYPE_1,
    }
}

impl Passes {
    /// Makes the pipelines, for recordings of `regions` regions in the memory of `job`; `encoding` is that of the target.
    ///
    /// # Errors
    /// [`RenderError`] if the driver refuses a pipeline.
    pub fn new(
        layout: &Arc<FrameLayout>,
        job: &Job,
        scene: &GpuScene,
        settings: &Settings,
        regions: usize,
        encoding: Option<Encoding>,
    ) -> Result<Self, RenderError> {
        let context = job.context(scene, regions);
        let output = context.output;
        let multisampled = matches!(settings.method, Method::Msaa { .. });
        let antialiased = matches!(settings.method, Method::Superpixel(_));
        let superpixels = settings.superpixels();
        let detection = superpixels.detection;
        let grows = antialiased && superpixels.growth_count() > 0;
        let side = settings.method.side();
        let compares = !matches!(detection, Detection::Exact | Detection::Every);
        let merged = context.settings.merged;
        let rate = merged.unwrap_or(context.settings.cells.shading);
        let by_part = fragment_rate(rate, scene) == FragmentRate::Part;
        let words = context.sizes.shadow_words;
        let display_codes = antialiased && (compares || by_part);
        let pixels = || -> Result<_, RenderError> {
            let source = ShadeSource::Pixels { display_codes };
            Ok(PixelShading {
                spans: spans::pass(layout, scene)?,
                shade: shade::pass(layout, scene, source, words, &output)?,
            })
        };
        let fragments = ShadeSource::Fragments { cells: Cells::Pixels, merged: merged.is_some() };
        let shading = || shade::pass(layout, scene, fragments, words, &output);
        let shades_fragments = scene.has_blend() || antialiased || multisampled;
        let (pixels, shading) =
            rayon::join(|| (!multisampled).then(pixels).transpose(), || shades_fragments.then(shading).transpose());
        let (pixels, shading) = (pixels?, shading?.map(Arc::new));
        let blended = PixelCells {
            mode: DetectMode::Blended,
            thin: false,
            multisampled,
            samples: if multisampled { settings.method.samples() } else { 1 },
            growths: 0,
            detected: display_codes,
            ..PixelCells::superpixels(&superpixels)
        };
        let blended = || blended.sampler(&context);
        let pixel_filter = settings.pixel_filter;
        let antialiasing = || PixelCells::superpixels(&superpixels).filtered(&pixel_filter).sampler(&context);
        let filter = || match &settings.method {
            Method::Accumulate { .. } => Ok(None),
            _ if pixel_filter.is_box() => (side > 1).then(|| box_filter::pass(layout, side)).transpose(),
            _ => {
                let among = match (antialiased, grows) {
                    (false, _) => Superpixels::None,
                    (true, false) => Superpixels::Detected,
                    (true, true) => Superpixels::Grown,
                };
                pixel_filter::pass(layout, &pixel_filter, side > 1, among, Alpha::Premultiplied).map(Some)
            }
        };
        let multisampling = || -> Result<_, RenderError> {
            Ok(Multisampling {
                multisample: multisample::pass(layout)?,
                sort: sort::pass(layout, scene, scene.bin_count() == 1)?,
                resolve: resolve::for_multisample(layout, settings.method.samples(), &output)?,
            })
        };
        let superpixels = antialiased.then(antialiasing).transpose()?;
        let merge =
            |(sampler, rate): (&Sampler, _)| merge::pass(layout, scene, job.resources(), &sampler.blocks(), rate);
        Ok(Self {
            merge: superpixels.as_ref().zip(merged).map(merge).transpose()?,
            pose: scene.moves().then(|| PosePass::new(layout)).transpose()?,
            stroke: scene.has_strokes().then(|| StrokePass::new(layout)).transpose()?,
            raster: Raster::new(layout, raster_samples(settings), scene, context.sizes.filtered_triangles > 0)?,
            pixels,
            multisampling: multisampled.then(multisampling).transpose()?,
            shade: shading,
            blended: scene.has_blend().then(blended).transpose()?,
            superpixels,
            attributes: settings.attributes.then(|| attributes::pass(layout, scene, antialiased, grows)).transpose()?,
            filter: filter()?,
            encode: encoding
                .filter(|e| *e != Encoding::Rgba32Float)
                .map(|e| Ok::<_, RenderError>((e, encode::pass(layout, e)?)))
                .transpose()?,
        })
    }
}
