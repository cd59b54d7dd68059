//! The order in which a frame's passes are recorded, region by region.

use super::passes::{Multisampling, Passes, PixelShading};
use super::target::Target;
use super::uniform::to_clip;
use crate::camera::{Camera, Pinhole};
use crate::engine::data::{Data, Resources};
use crate::engine::passes::RasterTargets;
use crate::engine::passes::pixel_filter;
use crate::engine::pipelines::Pass;
use crate::engine::sampler::color::display_code;
use crate::engine::sampler::plan::{Plan, Region};
use crate::engine::sampler::{RecordShading, Sampler, SamplerRun, SamplerSettings};
use crate::render::Settings;
use crate::render::data::{FrameGeometry, GpuScene};
use crate::render::passes::{Encoding, StrokeSizes, encode};
use crate::render::shadows::{LightView, ShadowFinder, Shadowed, Sight};
use crate::scene::Moment;
use crate::vulkan::{PassTime, Recorder};
use glam::DVec2;
use std::ops::Range;

/// Index of the descriptor set with a single sample at the pixel's centre.
const CENTRE: usize = 0;
/// Index of the descriptor set with the method's sample offsets.
const OFFSETS: usize = 1;

/// A recording of a frame: the frame's parts, borrowed without its timings, with the camera and the target.
pub(super) struct FrameRecording<'a> {
    pub settings: &'a Settings,
    pub sampler: &'a SamplerSettings,
    pub plan: &'a Plan,
    pub passes: &'a Passes,
    pub targets: &'a RasterTargets,
    pub geometry: &'a FrameGeometry,
    pub resources: &'a Resources,
    pub shadows: Option<&'a ShadowFinder>,
    pub scene: &'a GpuScene,
    pub moment: Option<&'a Moment>,
    pub camera: &'a Camera,
    pub target: &'a Target,
}

/// Shading of a scene's materials, as the engine calls it.
pub(in crate::render) struct SceneShading<'a> {
    pub shade: Option<&'a Pass>,
    /// Passes that find which lights reach a place; `None` without shadows.
    pub shadows: Option<(&'a ShadowFinder, Shadowed<'a>)>,
    /// Pass that then merges and sorts visibility samples; `None` if they are shaded as they are.
    pub merge: Option<&'a Pass>,
}

impl RecordShading for SceneShading<'_> {
    fn record(&self, recorder: &Recorder<'_>, _resources: &Resources) {
        if let Some((shadows, shadowed)) = self.shadows {
            shadows.record_fragments(recorder, shadowed);
        }
        if let Some(merge) = self.merge {
            merge.record(recorder);
        }
        if let Some(shade) = self.shade {
            shade.record(recorder);
        }
    }
}

impl FrameRecording<'_> {
    /// Records some of the frame's regions. The first region also begins the frame, and the last one ends it.
    pub fn record(&self, recorder: &Recorder<'_>, regions: Range<usize>) {
        if regions.start == 0 {
            self.target.record_begin(recorder);
            recorder.begin();
        } else {
            recorder.go_on();
        }
        let count = self.plan.regions.len();
        let all = self.plan.regions.iter().enumerate();
        for (index, region) in all.take(regions.end).skip(regions.start) {
            self.record_region(recorder, index, region);
        }
        if regions.end == count {
            if let Some(shadows) = self.shadows {
                shadows.record_end(recorder);
            }
            self.target.record_end(recorder);
        }
    }

    /// Views of the lights onto the visible part of the scene in a region; `None` without shadows, or if the camera is
    /// impossible.
    fn light_views(&self, region: &Region) -> Option<Vec<LightView>> {
        let place = |pixels: [u32; 2]| DVec2::from_array(pixels.map(f64::from));
        let low = place(region.corner());
        let shadows = self.shadows?;
        Some(shadows.views(&Sight {
            pinhole: Pinhole::from_camera(self.camera, self.settings.size).ok()?,
            whole: [DVec2::ZERO, place(self.settings.size)],
            part: [low, low + place(region.outer())],
            origin: self.scene.geometry.origin,
        }))
    }

    /// Records the passes of a region. `make figures` writes what a pass reads from earlier ones and what it writes.
    fn record_region(&self, recorder: &Recorder<'_>, index: usize, region: &Region) {
        let (passes, resources, scene) = (self.passes, self.resources, self.scene);
        let (Some(centre), Some(offsets)) = (resources.set(CENTRE), resources.set(OFFSETS)) else {
            return;
        };
        let main = if passes.multisampling.is_some() { offsets } else { centre };
        let whole = self.uniform(region, main.count(), false);
        let [width, height] = whole.size;
        let pixels = width * height;
        let side = self.settings.method.side();
        let filtered = pixels / (side * side);
        let tiles = whole.tiles[0] * whole.tiles[1];
        let views = self.light_views(region).unwrap_or_default();
        let shadowed = |set| Shadowed { resources, set, size: whole.size, views: &views };
        let shading_of = |set| SceneShading {
            shade: passes.shade.as_deref(),
            shadows: self.shadows.map(|shadows| (shadows, shadowed(set))),
            merge: passes.merge.as_ref(),
        };
        let shading = shading_of(main);

        resources.record_begin(recorder, main, &whole);
        if let (0, Some(pose), Some(moment)) = (index, &passes.pose, self.moment) {
            pose.record(recorder, scene, self.geometry, moment);
        }
        if let (0, Some(stroke)) = (index, &passes.stroke) {
            let to_clip = to_clip(scene, self.camera, self.settings);
            let sizes = StrokeSizes::new(&self.settings.scene, side);
            stroke.record(recorder, scene, self.geometry, &to_clip, sizes);
        }
        // filter: ─▶ corners, indexed_draws
        // raster: ─▶ ids, blend_ids, raster_depth
        passes.raster.record(
            recorder,
            self.geometry.runs(scene),
            self.targets,
            [width, height],
            region.drawn().map(|place| place.map(|pixels| pixels * side)),
        );
        if let Some(sampler) = &passes.superpixels {
            sampler.record_unmarked(recorder, resources);
        }
        if let Some(shadows) = self.shadows {
            shadows.record_planes(recorder, &views, main);
        }
        if let Some(PixelShading { spans, shade }) = &passes.pixels {
            let background = whole.background;
            let marks = passes.superpixels.as_ref().is_some_and(Sampler::takes_marked);
            recorder.section(PassTime::BACKGROUND, || {
                let code = display_code(background);
                resources.record_background(recorder, pixels, background, code);
            });
            // spans: ids ─▶ shade_order, bins
            spans.record_for(recorder, width.div_ceil(8) * height);
            if let Some(shadows) = self.shadows {
                // receivers: ─▶ locations
                // occlude: tiles, candidates, locations ─▶ words, left, marks_of_pixels
                shadows.record_pixels(recorder, shadowed(main), marks);
            }
            // shade: ids, shade_order, bins ─▶ display, color, shaded
            shade.record(recorder);
        }
        if let Some(Multisampling { multisample, sort, resolve }) = &passes.multisampling {
            multisample.record_for(recorder, 32 * tiles);
            sort.record(recorder);
            shading.record(recorder, resources);
            resolve.record(recorder);
        }
        let run = |set, uniform| SamplerRun { resources, set, uniform, locations: 0, index };
        if let Some(sampler) = &passes.blended {
            resources.record_begin(recorder, main, &whole);
            sampler.record(recorder, &run(main, &whole), &shading);
        }
        if let Some(sampler) = &passes.superpixels {
            let owned = self.uniform(region, offsets.count(), true);
            resources.record_begin(recorder, offsets, &owned);
            sampler.record(recorder, &run(offsets, &owned), &shading_of(offsets));
        }
        if let Some(attributes) = &passes.attributes {
            attributes.record_for(recorder, filtered);
        }
        if let Some(filter) = &passes.filter {
            if side > 1 && !self.settings.pixel_filter.is_box() {
                let weights = pixel_filter::weights(&self.settings.pixel_filter, side);
                recorder.update(resources.buffer(Data::FilterWeights), 0, bytemuck::cast_slice(&weights));
            }
            filter.record_for(recorder, if side > 1 { filtered } else { pixel_filter::columns(tiles) });
            resources.record_keep_filtered(recorder, filtered);
        }
        if let Some((encoding, encode)) = &passes.encode {
            if *encoding == Encoding::StraightRgba8 {
                let thresholds = bytemuck::cast_slice(encode::thresholds());
                recorder.update(resources.buffer(Data::Encoded), 0, thresholds);
            }
            encode.record_for(recorder, filtered);
        }
        recorder.section(PassTime::COPY, || self.deliver(recorder, region));
    }
}
