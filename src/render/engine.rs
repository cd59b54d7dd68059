//! The sampling engine: from a mask of cells to their colours, in rounds.

use super::plan::Plan;
use super::{Coverage, Detection, RenderError, Settings, Shading};
use crate::passes::{
    Bin, Cells, Content, Cull, Detect, DetectMode, DetectOptions, FrameLayout, FrameUniform, Grow,
    Kept, RecordRate, Resolve, ResourceSizes, Resources, Sample, SampleOptions, SampleSet,
    Schedule, Setup, Sort, Then, Thin,
};
use crate::sampling::Pattern;
use crate::vulkan::{Buffer, Constants, Recorder};
use std::sync::Arc;

/// Shades visibility samples: writes the radiance of each to its place in the buffer of shaded records.
pub(crate) trait RecordShading {
    /// Records the shading of a round, sorted by key. Set 0 is bound before, and bound again after it.
    fn record(&self, recorder: &mut Recorder<'_>, resources: &Resources);

    /// Records marks of pixels that show what their centres do not, beside those of [`Thin`]. Set 0 is bound before, and bound again
    /// after it.
    fn record_marks(&self, _recorder: &mut Recorder<'_>) {}
}

/// Detects cells and samples them: it knows triangles and shading keys, no materials. A frame has one for BLEND pixels and
/// one for superpixels.
pub(crate) struct Engine {
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
    resolve: Resolve,
}

/// What an [`Engine`] is made for.
pub(crate) struct EngineKind {
    /// Which pixels are cells.
    pub mode: DetectMode,
    /// Whether thin triangles that no pixel centre saw make cells too.
    pub thin: bool,
    /// Whether the depth that was drawn grows with distance.
    pub farther_is_larger: bool,
    /// Whether there are IDs of the nearest BLEND triangles, where there are any.
    pub blend_ids: bool,
    /// Whether the triangle IDs are multisampled.
    pub multisampled: bool,
    /// Sub-samples of a cell.
    pub samples: u32,
    /// How often superpixels grow.
    pub growths: u32,
    /// Whether `detect` compares the resolved colours.
    pub detected: bool,
}

impl EngineKind {
    /// What finds and samples the superpixels that settings ask for.
    pub fn superpixels(settings: &Settings) -> Self {
        Self {
            mode: match settings.detection {
                Detection::Contrast => DetectMode::Contrast,
                Detection::Edges => DetectMode::Edges,
                Detection::Exact => DetectMode::Exact,
                Detection::Every => DetectMode::Every,
            },
            thin: settings.thin && settings.detection != Detection::Every,
            farther_is_larger: false,
            blend_ids: true,
            multisampled: false,
            samples: settings.samples,
            growths: settings.growths(),
            detected: false,
        }
    }
}

impl Engine {
    pub fn new(
        layout: &Arc<FrameLayout>,
        scene: &dyn Content,
        settings: &Settings,
        plan: &Plan,
        output: &Constants,
        kind: &EngineKind,
    ) -> Result<Self, RenderError> {
        let options = SampleOptions {
            cells: Cells::Pixels,
            samples: kind.samples,
            lines: settings.pattern == Pattern::Lines,
            records: record_rate(settings, scene),
            exact_areas: settings.coverage == Coverage::Area && kind.samples > 1,
            can_settle: can_settle(settings, scene),
            apart: plan.capacity.apart,
            unlisted: plan.capacity.unlisted,
            has_mask: scene.has_mask(),
            has_blend: scene.has_blend(),
            always_blends: kind.mode == DetectMode::Blended,
        };
        let blend_ids = kind.blend_ids && scene.has_blend();
        let thin = || {
            kind.thin
                .then(|| Thin::new(layout, scene, blend_ids, kind.farther_is_larger))
        };
        let detect = || {
            let options = DetectOptions {
                mode: kind.mode,
                blend_ids,
                thin: kind.thin,
                transparent: settings.background.is_none(),
                multisampled: kind.multisampled,
                shadow_words: match kind.mode {
                    DetectMode::Blended => 0,
                    _ => plan.sizes.shadow_words,
                },
                beyond: kind.growths,
            };
            Detect::new(layout, &options)
        };
        let (sample, others) = std::thread::scope(|scope| {
            let sample = scope.spawn(|| Sample::new(layout, scene, &options));
            let others = (|| {
                Ok::<_, RenderError>((
                    thin().transpose()?,
                    detect()?,
                    Cull::new(layout, scene, Kept::Touching)?,
                    Bin::new(layout, scene)?,
                    Setup::new(layout, scene)?,
                    Sort::new(layout, scene, scene.bin_count() == 1)?,
                ))
            })();
            let sample = sample.join();
            let sample = sample.unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            (sample, others)
        });
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

    /// Records detection, lists, sampling and shading. The region has begun; its IDs and display codes are there.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        resources: &Resources,
        shading: &dyn RecordShading,
        work: &Work,
    ) {
        if let Some(thin) = &self.thin {
            thin.record(
                recorder,
                &resources.marks,
                &resources.arguments,
                work.triangles,
            );
            recorder.mark("thin");
            shading.record_marks(recorder);
        }
        self.detect.record(recorder, work.tiles);
        recorder.mark("detect");
        if !self.growths.is_empty() || self.sample.options().leaves_cells() {
            recorder.clear(&resources.marks);
            recorder.barrier();
        }
        self.record_rounds(recorder, resources, shading, work);
    }

    /// Rounds that sample all superpixels of a region, and as many those that each growth adds, whatever these see of a scene of at
    /// most so many triangles.
    pub fn most_rounds(&self, sizes: &ResourceSizes, triangles: u32) -> u32 {
        self.schedule.most_rounds(sizes, triangles)
    }

    /// How often superpixels grow.
    pub fn growths(&self) -> usize {
        self.growths.len()
    }

    /// Records all growths, after [`Self::record`]: the sampling and shading of pixels that contrast with the superpixels
    /// beside them.
    pub fn record_growths(
        &self,
        recorder: &mut Recorder<'_>,
        shading: &dyn RecordShading,
        growing: &Growing<'_>,
    ) {
        let Growing {
            resources,
            set,
            work,
            counters,
            ..
        } = growing;
        // Centres whose colours are alike miss what superpixels beside them show.
        let uniform = FrameUniform {
            alike: 0,
            ..growing.uniform
        };
        for (slot, grow) in (growing.first_slot..).zip(&self.growths) {
            resources.record_begin(recorder, set, &uniform);
            grow.record(recorder, work.tiles);
            recorder.mark("grow");
            self.record_rounds(recorder, resources, shading, work);
            resources.record_keep_counters(recorder, counters, slot);
        }
    }

    fn record_rounds(
        &self,
        recorder: &mut Recorder<'_>,
        resources: &Resources,
        shading: &dyn RecordShading,
        work: &Work,
    ) {
        let arguments = &resources.arguments;
        self.cull.record(recorder, arguments);
        recorder.mark("cull");
        self.bin.record(recorder, arguments);
        recorder.mark("bin");
        self.schedule.record_tally(recorder, arguments);
        resources.record_rounds(recorder, work.rounds, |recorder| {
            self.schedule.record(recorder, arguments);
            recorder.mark("schedule");
            self.setup.record(recorder, arguments);
            recorder.mark("setup");
            self.sample.record(recorder, arguments);
            recorder.mark("sample");
            record_shading(recorder, resources, &self.sort, shading);
            self.resolve.record(recorder, arguments);
            recorder.mark("resolve");
        });
    }
}

/// How much a recording of an [`Engine`] may find to do.
pub(crate) struct Work {
    /// Triangles of the scene.
    pub triangles: u32,
    /// Tiles of the region.
    pub tiles: u32,
    /// Rounds that are recorded, for what is detected and for each growth of it.
    pub rounds: u32,
}

/// What superpixels of a region grow in.
pub(crate) struct Growing<'a> {
    pub resources: &'a Resources,
    pub set: &'a SampleSet,
    /// That of the region's sampling.
    pub uniform: FrameUniform,
    pub work: Work,
    /// Where what each growth counts is kept, from a slot on.
    pub counters: &'a Buffer,
    pub first_slot: u64,
}

/// Offsets of a cell's samples, followed by those of a first run.
pub(crate) fn with_probes(mut offsets: Vec<[f32; 2]>) -> Result<Vec<[f32; 2]>, RenderError> {
    offsets.extend(Pattern::Sobol.offsets(Sample::PROBES)?);
    Ok(offsets)
}

/// How many records the settings' shading asks for.
pub(crate) fn record_rate(settings: &Settings, scene: &dyn Content) -> RecordRate {
    match settings.shading {
        Shading::Part if scene.has_high_frequency() => RecordRate::Part,
        Shading::Triangle | Shading::Part => RecordRate::Triangle,
        Shading::Sample => RecordRate::Sample,
    }
}

/// Whether few samples may settle superpixels: not those of high-frequency triangles, which are shaded
/// in many places.
pub(crate) fn can_settle(settings: &Settings, scene: &dyn Content) -> bool {
    settings.shading != Shading::Part || !scene.is_mostly_high_frequency()
}

/// Sorts and shades the records of a round.
pub(crate) fn record_shading(
    recorder: &mut Recorder<'_>,
    resources: &Resources,
    sort: &Sort,
    shading: &dyn RecordShading,
) {
    let arguments = &resources.arguments;
    sort.record(recorder, &resources.bins, arguments);
    recorder.mark("sort");
    shading.record(recorder, resources);
    recorder.mark("shade");
}
