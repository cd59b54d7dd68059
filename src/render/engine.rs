//! The sampling engine: from a mask of cells to their colours, in rounds.

use super::plan::Plan;
use super::{Coverage, RenderError, Settings, Shading};
use crate::passes::{
    Bin, Cells, Cull, Detect, DetectMode, FrameLayout, GpuScene, Grow, RecordRate, Resolve,
    Resources, Sample, SampleOptions, Schedule, Setup, Shade, ShadeSource, Sort, Then, Thin,
};
use crate::vulkan::{Constants, Recorder};
use std::sync::Arc;

/// Detects cells and samples them; one for BLEND pixels, one for superpixels.
pub(super) struct Engine {
    thin: Option<Thin>,
    detect: Detect,
    /// In the order in which they run.
    growths: Vec<Grow>,
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
    /// How often superpixels grow.
    pub growths: u32,
    /// Whether `detect` compares the resolved colours.
    pub detected: bool,
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
        let thin = || kind.thin.then(|| Thin::new(layout, scene));
        let detect = || {
            Detect::new(
                layout,
                kind.mode,
                scene.has_blend(),
                kind.thin,
                settings.background.is_none(),
                kind.multisampled,
                kind.growths,
            )
        };
        // The kernels of `sample` take about as long to make as all others.
        let (sample, others) = rayon::join(
            || Sample::new(layout, scene, &options),
            || {
                Ok::<_, RenderError>((
                    thin().transpose()?,
                    detect()?,
                    Cull::new(layout, scene)?,
                    Bin::new(layout, scene)?,
                    Setup::new(layout, scene)?,
                    Sort::new(layout, scene, scene.bin_count() == 1)?,
                ))
            },
        );
        let (sample, (thin, detect, cull, bin, setup, sort)) = (sample?, others?);
        Ok(Self {
            thin,
            detect,
            growths: (0..kind.growths)
                .rev()
                .map(|beyond| Grow::new(layout, beyond))
                .collect::<Result<_, _>>()?,
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
                match (kind.growths > 0, kind.detected) {
                    (true, _) => Then::Grow,
                    (false, true) => Then::Detect,
                    (false, false) => Then::Nothing,
                },
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
        if let Some(thin) = &self.thin {
            thin.record(
                recorder,
                &resources.marks,
                &resources.arguments,
                scene.index_count(),
            );
            recorder.mark("thin");
        }
        self.detect.record(recorder, tiles);
        recorder.mark("detect");
        if !self.growths.is_empty() || self.sample.options().probes() {
            recorder.clear(&resources.marks);
            recorder.barrier();
        }
        self.record_rounds(recorder, scene, resources, rounds);
    }

    /// How often [`Self::record_growth`] has to follow.
    pub fn growths(&self) -> usize {
        self.growths.len()
    }

    /// Records growth number `growth`: the sampling and shading of pixels that contrast with the superpixels beside them.
    /// The region has begun again, after [`Self::record`] or the growth before.
    pub fn record_growth(
        &self,
        recorder: &mut Recorder<'_>,
        scene: &GpuScene,
        resources: &Resources,
        tiles: u32,
        growth: usize,
        rounds: u32,
    ) {
        if let Some(grow) = self.growths.get(growth) {
            grow.record(recorder, tiles);
            recorder.mark("grow");
            self.record_rounds(recorder, scene, resources, rounds);
        }
    }

    fn record_rounds(
        &self,
        recorder: &mut Recorder<'_>,
        scene: &GpuScene,
        resources: &Resources,
        rounds: u32,
    ) {
        let arguments = &resources.arguments;
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
