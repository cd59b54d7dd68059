//! The sampling engine: from a mask of cells to their colours, in rounds.

use super::plan::Plan;
use super::{Coverage, RenderError, Settings, Shading};
use crate::passes::{
    Bin, Cells, Cull, Detect, DetectMode, FrameLayout, GpuScene, RecordRate, Resolve, Resources,
    Sample, SampleOptions, Schedule, Setup, Shade, ShadeSource, Sort, Thin,
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
        let options = SampleOptions {
            cells: Cells::Pixels,
            samples: kind.samples,
            records: record_rate(settings, scene),
            exact_areas: settings.coverage == Coverage::Area && kind.samples > 1,
            can_settle: can_settle(settings, scene),
            apart: plan.effort.apart,
            unlisted: plan.effort.unlisted,
            has_mask: scene.has_mask(),
            has_blend: scene.has_blend(),
        };
        let thin = || kind.thin.then(|| Thin::new(layout, scene.has_blend()));
        let detect = || {
            Detect::new(
                layout,
                kind.mode,
                scene.has_blend(),
                kind.thin,
                settings.background.is_none(),
                kind.multisampled,
            )
        };
        // The kernels of `sample` take about as long to make as all others.
        let (sample, others) = rayon::join(
            || Sample::new(layout, &options),
            || {
                Ok::<_, RenderError>((
                    thin().transpose()?,
                    detect()?,
                    Cull::new(layout)?,
                    Bin::new(layout)?,
                    Setup::new(layout)?,
                    Sort::new(layout, scene.bin_count() == 1)?,
                ))
            },
        );
        let (sample, (thin, detect, cull, bin, setup, sort)) = (sample?, others?);
        Ok(Self {
            thin,
            detect,
            cull,
            bin,
            schedule: Schedule::new(layout, &sample, plan.layers)?,
            setup,
            sort,
            shade: shade.clone(),
            resolve: Resolve::new(
                layout,
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
        if self.sample.options().probes() {
            recorder.clear(&resources.marks);
            recorder.barrier();
        }
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

/// How many records the settings' shading asks for.
pub(super) fn record_rate(settings: &Settings, scene: &GpuScene) -> RecordRate {
    match settings.shading {
        Shading::Part if scene.has_high_frequency() => RecordRate::Part,
        Shading::Triangle | Shading::Part => RecordRate::Triangle,
        Shading::Sample => RecordRate::Sample,
    }
}

/// Whether few samples may settle superpixels: not those of high-frequency triangles, which are shaded
/// in many places.
pub(super) fn can_settle(settings: &Settings, scene: &GpuScene) -> bool {
    settings.shading != Shading::Part || !scene.is_mostly_high_frequency()
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
