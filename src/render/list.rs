//! The sampling engine for lists of sample locations: from a list to what its locations see, in rounds.

use super::engine::{RecordShading, can_settle, record_rate, record_shading, with_probes};
use super::plan::{MOST_CANDIDATES, MOST_PAIRS, MOST_RECORDS, records_of_superpixel};
use super::{Coverage, RenderError, Settings};
use crate::passes::{
    Bin, CellSizes, Cells, Content, Cull, Distribute, FrameLayout, Groups, Kept, ListLength,
    ListRegion, LocationSizes, Points, RecordRate, Resolve, ResourceSizes, Resources, Sample,
    SampleOptions, SampleSet, Schedule, Setup, Sort, Then,
};
use crate::vulkan::{Constants, Recorder};
use ash::vk;
use std::sync::Arc;

/// What a [`ListEngine`] is made for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ListKind {
    pub cells: Cells,
    /// Whether locations that are sampled once have attributes.
    pub attributes: bool,
    /// Words of each place that say which lights reach it.
    pub shadow_words: u32,
    /// Whether an application lends the list and takes the colours on the device.
    pub lent: bool,
    /// Whether a subgroup samples one cell at a time.
    pub apart: bool,
    /// Whether there is a kernel for tiles whose list outgrows its buffer.
    pub unlisted: bool,
    /// BLEND layers of a list that tiles are admitted with.
    pub layers: u32,
}

impl ListKind {
    /// Offsets of a cell's samples, and how many these are.
    ///
    /// # Errors
    /// If the pattern has no such number.
    pub fn offsets(
        &self,
        layout: &FrameLayout,
        settings: &Settings,
    ) -> Result<(Vec<[f32; 2]>, u32), RenderError> {
        let (own, count) = if self.cells.are_points() {
            (vec![[0.0; 2]], self.cell_sizes(layout, settings).in_cell)
        } else {
            let own = settings.pattern.offsets(settings.samples)?;
            (own, settings.samples)
        };
        Ok((with_probes(own)?, count))
    }

    fn cell_sizes(&self, layout: &FrameLayout, settings: &Settings) -> CellSizes {
        CellSizes::new(layout.gpu.limits().lanes, self.cells, settings.samples)
    }

    fn sample_options(
        &self,
        layout: &FrameLayout,
        scene: &dyn Content,
        settings: &Settings,
    ) -> SampleOptions {
        let points = self.cells.are_points();
        SampleOptions {
            cells: self.cells,
            samples: if points {
                self.cell_sizes(layout, settings).in_cell
            } else {
                settings.samples
            },
            lines: false,
            records: if points {
                RecordRate::Sample
            } else {
                record_rate(settings, scene)
            },
            exact_areas: settings.coverage == Coverage::Area && settings.samples > 1 && !points,
            can_settle: can_settle(settings, scene),
            apart: self.apart,
            unlisted: self.unlisted,
            has_mask: scene.has_mask(),
            has_blend: scene.has_blend(),
            always_blends: false,
        }
    }

    /// Room for `locations` locations in a region of so many pixels, whole tiles, and for `lists` times the usual candidates.
    pub fn sizes(
        &self,
        layout: &FrameLayout,
        scene: &dyn Content,
        settings: &Settings,
        (locations, region): (u32, [u32; 2]),
        lists: u32,
    ) -> ResourceSizes {
        let limits = layout.gpu.limits();
        let tiles = u64::from(region[0] / 8) * u64::from(region[1] / 4);
        let most = u64::from(locations);
        let records = match self.cells {
            Cells::Points | Cells::Occluders if scene.has_blend() => 4 * most,
            Cells::Points | Cells::Occluders => most,
            Cells::Superpixels | Cells::Pixels => most * records_of_superpixel(settings, scene),
        };
        let triangles = u64::from(scene.index_count());
        let pairs = (triangles * 4 + tiles * 16).clamp(1 << 14, MOST_PAIRS);
        let candidates = (triangles * 3 + tiles * 8).clamp(1 << 14, MOST_CANDIDATES);
        let cell_sizes = self.cell_sizes(layout, settings);
        let at_most = |room: u64, most: u64| (room * u64::from(lists)).min(most) as u32;
        ResourceSizes {
            region,
            lanes: limits.lanes,
            locations: Some(LocationSizes {
                lent: self.lent,
                ..LocationSizes::new(locations, tiles as u32, &cell_sizes)
            }),
            survivor_capacity: scene.index_count(),
            pair_capacity: at_most(pairs, ResourceSizes::most_pairs(limits)),
            list_capacity: at_most(candidates, ResourceSizes::most_candidates(limits)),
            record_capacity: records.clamp(1 << 16, MOST_RECORDS) as u32,
            filtered: 0,
            shadow_words: self.shadow_words,
            attributes: self.attributes,
            encoded: 0,
        }
    }
}

/// The passes that sample the cells of a list: they know triangles and shading keys, no materials.
pub(crate) struct ListEngine {
    distribute: Distribute,
    cull: Cull,
    bin: Bin,
    schedule: Schedule,
    groups: Groups,
    setup: Setup,
    sample: Sample,
    /// Nothing where the triangles of records are all that is asked for.
    values: Option<Values>,
}

/// The passes that make values of records.
struct Values {
    sort: Sort,
    /// Nothing of [`Cells::Occluders`], of which opacities are asked for.
    finish: Option<Finish>,
}

enum Finish {
    Points(Points),
    Resolve(Resolve),
}

impl ListEngine {
    /// Makes the pipelines; `locations` shows a list, and `output` are the colour constants of `shaders/include/color.glsl`.
    ///
    /// # Errors
    /// If the driver refuses one.
    ///
    /// # Safety
    /// The view of `locations` outlives this, and shows as many as the resources have room for.
    pub unsafe fn new(
        layout: &Arc<FrameLayout>,
        scene: &dyn Content,
        settings: &Settings,
        kind: &ListKind,
        (resources, locations): (&Resources, vk::BufferView),
        output: &Constants,
    ) -> Result<Self, RenderError> {
        let sizes = kind.cell_sizes(layout, settings);
        let options = kind.sample_options(layout, scene, settings);
        let sample = Sample::new(layout, scene, &options)?;
        let blend = scene.has_blend();
        let finish = || -> Result<Option<Finish>, RenderError> {
            let of_points = (kind.attributes, kind.shadow_words);
            Ok(match kind.cells {
                Cells::Occluders => None,
                Cells::Points => Some(Finish::Points(Points::new(
                    layout, scene, output, of_points,
                )?)),
                Cells::Superpixels | Cells::Pixels => Some(Finish::Resolve(Resolve::new(
                    layout,
                    &sample,
                    blend,
                    Then::Nothing,
                    output,
                )?)),
            })
        };
        let values = || -> Result<Values, RenderError> {
            Ok(Values {
                sort: Sort::new(layout, scene, scene.bin_count() == 1)?,
                finish: finish()?,
            })
        };
        let shades = kind.cells != Cells::Occluders || blend;
        Ok(Self {
            // SAFETY: passed on to the caller.
            distribute: unsafe {
                Distribute::new(layout, kind.cells, sizes, resources, locations)
            }?,
            cull: Cull::new(layout, scene, Kept::Touching)?,
            bin: Bin::new(layout, scene)?,
            schedule: Schedule::new(layout, &sample, kind.layers)?,
            groups: Groups::new(layout, &sample)?,
            setup: Setup::new(layout, scene)?,
            values: shades.then(values).transpose()?,
            sample,
        })
    }

    /// What the kernels were made for.
    pub fn options(&self) -> &SampleOptions {
        self.sample.options()
    }

    /// Records the sorting of a list and which triangles may show in its tiles. The region has begun.
    pub fn record_candidates(
        &self,
        recorder: &mut Recorder<'_>,
        (resources, set): (&Resources, &SampleSet),
        region: &ListRegion,
        length: ListLength<'_>,
    ) {
        let arguments = &resources.arguments;
        resources.record_locations(recorder, (set, &self.distribute), region, length);
        recorder.mark("distribute");
        self.cull.record(recorder, arguments);
        recorder.mark("cull");
        self.bin.record(recorder, arguments);
        recorder.mark("bin");
        if self.options().probes() {
            recorder.clear(&resources.marks);
            recorder.barrier();
        }
        self.schedule.record_tally(recorder, arguments);
    }

    /// Rounds that sample a list, whatever it sees of a scene of at most so many triangles.
    pub fn most_rounds(&self, sizes: &ResourceSizes, triangles: u32) -> u32 {
        self.schedule.most_rounds(sizes, triangles)
    }

    /// Records the sampling of a round.
    pub fn record_round(&self, recorder: &mut Recorder<'_>, resources: &Resources) {
        let arguments = &resources.arguments;
        self.schedule.record(recorder, arguments);
        self.groups.record(recorder, arguments);
        recorder.mark("schedule");
        self.setup.record(recorder, arguments);
        recorder.mark("setup");
        self.sample.record(recorder, arguments);
        recorder.mark("sample");
    }

    /// Records what makes colours of a round's records, where they are shaded. Locations that are sampled once and see nothing have
    /// none: their colours and attributes stay as they are.
    pub fn record_values(
        &self,
        recorder: &mut Recorder<'_>,
        resources: &Resources,
        shading: &dyn RecordShading,
    ) {
        let Some(Values { sort, finish }) = &self.values else {
            return;
        };
        record_shading(recorder, resources, sort, shading);
        match finish {
            Some(Finish::Points(points)) => {
                points.record(recorder, &resources.arguments);
                recorder.mark("points");
            }
            Some(Finish::Resolve(resolve)) => {
                resolve.record(recorder, &resources.arguments);
                recorder.mark("resolve");
            }
            None => {}
        }
    }
}
