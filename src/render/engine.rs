//! The sampling engine: from a mask of cells to their colours, in rounds.

use super::plan::Plan;
use super::{RenderError, Settings, Shading};
use crate::passes::{
    Bin, Cells, Cull, Detect, DetectMode, FrameLayout, GpuScene, Resolve, Resources, Sample,
    Schedule, Setup, Shade, ShadeSource, Sort, Thin,
};
use crate::vulkan::{Constants, Recorder};
use std::sync::Arc;

/// Detects cells and samples them; one for BLEND pixels, one for superpixels.
pub(super) struct Engine {
    thin: Option<Thin>,
    detect: Detect,
    cull: Cull,
    bin: Bin,
    schedule: Schedule,
    setup: Setup,
    sample: Sample,
    sort: Sort,
    shade: Arc<Shade>,
    resolve: Resolve,
}

/// What an [`Engine`] is made for.
pub(super) struct EngineKind {
    /// Which pixels are cells.
    pub mode: DetectMode,
    /// Whether thin triangles that no pixel centre saw make cells too.
    pub thin: bool,
    /// Whether the triangle IDs are multisampled.
    pub multisampled: bool,
    /// Sub-samples of a cell.
    pub samples: u32,
    /// Whether detection still follows, and compares the resolved colours.
    pub display_codes: bool,
}

impl Engine {
    pub fn new(
        layout: &Arc<FrameLayout>,
        scene: &GpuScene,
        settings: &Settings,
        plan: &Plan,
        shade: &Arc<Shade>,
        output: &Constants,
        kind: &EngineKind,
    ) -> Result<Self, RenderError> {
        let per_sample = settings.shading == Shading::Sample;
        let sample = Sample::new(
            layout,
            Cells::Pixels,
            kind.samples,
            per_sample,
            scene.has_mask(),
            scene.has_blend(),
        )?;
        Ok(Self {
            thin: kind
                .thin
                .then(|| Thin::new(layout, scene.has_blend()))
                .transpose()?,
            detect: Detect::new(
                layout,
                kind.mode,
                scene.has_blend(),
                kind.thin,
                settings.background.is_none(),
                kind.multisampled,
            )?,
            cull: Cull::new(layout)?,
            bin: Bin::new(layout)?,
            schedule: Schedule::new(layout, Cells::Pixels, &sample, per_sample, plan.layers)?,
            setup: Setup::new(layout)?,
            sort: Sort::new(layout, scene.bin_count() == 1)?,
            shade: shade.clone(),
            resolve: Resolve::new(
                layout,
                Cells::Pixels,
                &sample,
                scene.has_blend(),
                kind.display_codes,
                output,
            )?,
            sample,
        })
    }

    /// Makes the shading of records, which engines of a frame share.
    pub fn shading(
        layout: &Arc<FrameLayout>,
        scene: &GpuScene,
        output: &Constants,
    ) -> Result<Arc<Shade>, RenderError> {
        Ok(Arc::new(Shade::new(
            layout,
            scene,
            ShadeSource::Records(Cells::Pixels),
            output,
        )?))
    }

    /// Records detection, lists, sampling and shading. The region has begun; its IDs and display codes are there.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        scene: &GpuScene,
        resources: &Resources,
        tiles: u32,
        rounds: u32,
    ) {
        let arguments = &resources.arguments;
        if let Some(thin) = &self.thin {
            thin.record(
                recorder,
                &resources.marks,
                arguments,
                scene.triangle_count(),
            );
            recorder.mark("thin");
        }
        self.detect.record(recorder, tiles);
        recorder.mark("detect");
        self.cull.record(recorder, arguments);
        recorder.mark("cull");
        self.bin.record(recorder, arguments);
        recorder.mark("bin");
        for _ in 0..rounds {
            self.schedule.record(recorder);
            recorder.mark("schedule");
            self.setup.record(recorder, arguments);
            recorder.mark("setup");
            self.sample.record(recorder, arguments);
            recorder.mark("sample");
            record_shading(recorder, scene, resources, &self.sort, &self.shade);
            self.resolve.record(recorder, arguments);
            recorder.mark("resolve");
        }
    }
}

/// Sorts and shades the records of a round.
pub(super) fn record_shading(
    recorder: &mut Recorder<'_>,
    scene: &GpuScene,
    resources: &Resources,
    sort: &Sort,
    shade: &Shade,
) {
    let arguments = &resources.arguments;
    sort.record(recorder, &resources.bins, arguments);
    recorder.mark("sort");
    shade.record(recorder, scene, arguments);
    recorder.mark("shade");
}
