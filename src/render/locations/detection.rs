//! Which cells of an output alias: beside another triangle or the border of a shadow, or crossed by a thin triangle unseen.
//! Passes find them, band by band of the output; the host copies.

use super::crossings::CrossingEngine;
use super::image::Cells;
use super::partition::Partition;
use super::plan::LocationPlan;
use crate::camera::{Pinhole, SampleLocation};
use crate::engine::sampler::footprint::Footprints;
use crate::engine::sampler::uniform::{PlaneBlock, SceneBlock, frame_uniform};
use crate::passes::{
    Cells as CellKind, Content, Detect, DetectMode, DetectOptions, FrameLayout, Offsets,
    ResourceSizes, Resources,
};
use crate::render::passes::{FrameLook, MarkedOutput, Output, SeenLocation, Shown};
use crate::render::{
    Headless, PassTime, PreparedScene, RenderError, Settings, Shadows, Statistics,
};
use crate::vulkan::{Buffer, Limits, Memory, MemoryUse, Recorder, Timings, VulkanError};
use ash::vk;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

/// Most cells of a band, with the rows around it.
const MOST_CELLS: u64 = 1 << 20;
/// Rows around a band on each side: neighbours of its cells.
const HALO: u32 = 1;

/// Rows of an output that are looked at together.
struct Band {
    rows: Range<u32>,
    /// With the rows around them.
    seen: Range<u32>,
}

/// Pipelines and memory to look at bands of an output.
struct DetectionEngine {
    width: u32,
    settings: Settings,
    shown: Output,
    detect: Detect,
    resources: Resources,
    masks: Buffer,
    timings: Timings,
    memory: Memory,
}

impl Headless {
    /// Whether each cell of an output aliases.
    pub(super) fn find_aliasing(
        &mut self,
        scene: &PreparedScene,
        rig: &[(Pinhole, Vec<SampleLocation>)],
        settings: &Settings,
        cells: &Cells,
    ) -> Result<(Vec<bool>, Statistics), RenderError> {
        let layout = self.renderer.layout.clone();
        let mut engine = DetectionEngine::new(&layout, scene, settings)?;
        let mut statistics = Statistics::default();
        let [width, height] = settings.size;
        let mut marked = Vec::with_capacity(width as usize * height as usize);
        for band in bands(height, engine.rows() - 2 * HALO) {
            engine.show(&band, cells);
            // SAFETY: the last submission was waited for; the engine outlives this one, which is waited for.
            self.submit(|commands| unsafe { engine.record_begin(&band, commands) })?;
            if settings.thin {
                for (pinhole, locations) in rig {
                    let taken = band.locations(locations, width);
                    if !taken.is_empty() {
                        let pinhole = (pinhole, &*taken);
                        let mut found =
                            self.find_crossings(scene, pinhole, settings, (&engine, &band), cells)?;
                        found.memory_bytes += engine.memory.used();
                        statistics.append(found);
                    }
                }
            }
            // SAFETY: as above.
            self.submit(|commands| unsafe { engine.record(&band, commands) })?;
            engine.read(&band, &mut marked)?;
            engine.add_statistics(&mut statistics)?;
        }
        Ok((marked, statistics))
    }

    /// Marks the cells of a band that thin triangles cross unseen.
    fn find_crossings(
        &mut self,
        scene: &PreparedScene,
        (pinhole, locations): (&Pinhole, &[SampleLocation]),
        settings: &Settings,
        (engine, band): (&DetectionEngine, &Band),
        cells: &Cells,
    ) -> Result<Statistics, RenderError> {
        let layout = self.renderer.layout.clone();
        let settings = Settings {
            samples: 1,
            shadows: Shadows::None,
            max_memory: settings
                .max_memory
                .map(|limit| limit.saturating_sub(engine.memory.used())),
            ..settings.clone()
        };
        let partition = Partition::new(locations, CellKind::Superpixels)?;
        let plan = LocationPlan::new(&layout, scene, &settings, &partition, false)?;
        let marks = &engine.resources.marks;
        // SAFETY: the marks go with the engine, which outlives all submissions: each is waited for.
        let mut crossings =
            unsafe { CrossingEngine::new(&layout, scene, &settings, &plan, marks) }?;
        let output = MarkedOutput {
            tiles: band.tiles(engine.width),
            width: engine.width,
            pixel: pixel_width(pinhole) as f32,
        };
        let first = band.seen.start * engine.width;
        let mut statistics = Statistics::default();
        let mut waiting: Vec<_> = plan.runs.iter().rev().cloned().collect();
        while let Some(run) = waiting.pop() {
            let window = partition.window(&run);
            let (listed, seen) = crossings.listed_mut(run.len())?;
            partition.list((&run, &window), listed);
            for (seen, place) in seen.iter_mut().zip(run.clone()) {
                *seen = cells.seen_at(partition.location(place).output, first);
            }
            // SAFETY: the last submission was waited for; scene and engine outlive this one, which is waited for. Cells are
            // those of the band.
            self.submit(|commands| unsafe {
                crossings.record(scene, (pinhole, &window), (&output, run.len()), commands);
            })?;
            match crossings.check() {
                Ok(()) => crossings.add_statistics(scene, &mut statistics)?,
                // Half as many locations have fewer pairs; marks of cells stay as they are.
                Err(RenderError::Unfinished { .. }) if run.len() > 1 => {
                    let middle = run.start + run.len() / 2;
                    waiting.push(middle..run.end);
                    waiting.push(run.start..middle);
                }
                Err(error) => return Err(error),
            }
        }
        Ok(statistics)
    }
}

impl Band {
    /// Cells with the rows around, as a range of the output's.
    fn cells(&self, width: u32) -> Range<usize> {
        let cell = |row: u32| row as usize * width as usize;
        cell(self.seen.start)..cell(self.seen.end)
    }

    fn tiles(&self, width: u32) -> [u32; 2] {
        [
            width.div_ceil(8),
            (self.seen.end - self.seen.start).div_ceil(4),
        ]
    }

    /// The locations whose cells are in it.
    fn locations<'a>(
        &self,
        locations: &'a [SampleLocation],
        width: u32,
    ) -> Cow<'a, [SampleLocation]> {
        let inside = |location: &&SampleLocation| self.rows.contains(&(location.output / width));
        if locations.iter().all(|location| inside(&location)) {
            Cow::Borrowed(locations)
        } else {
            Cow::Owned(locations.iter().filter(inside).copied().collect())
        }
    }
}

/// Bands of at most so many rows.
fn bands(height: u32, rows: u32) -> impl Iterator<Item = Band> {
    (0..height).step_by(rows as usize).map(move |first| {
        let end = height.min(first + rows);
        Band {
            rows: first..end,
            seen: first.saturating_sub(HALO)..height.min(end + HALO),
        }
    })
}

/// Width of a pixel of the plane: at a distance of 1 or, where rays are parallel, at any.
fn pixel_width(pinhole: &Pinhole) -> f64 {
    let [a, b] = pinhole.steps();
    let to_plane = if pinhole.is_parallel() {
        1.0
    } else {
        (pinhole.origin() - pinhole.eye()).dot(pinhole.direction())
    };
    a.cross(b).length().sqrt() / to_plane
}

impl DetectionEngine {
    fn new(
        layout: &Arc<FrameLayout>,
        prepared: &PreparedScene,
        settings: &Settings,
    ) -> Result<Self, RenderError> {
        let scene = &*prepared.gpu_scene;
        let taken = prepared.memory_bytes();
        let left = settings.max_memory.map(|limit| limit.saturating_sub(taken));
        let memory = Memory::new(layout.gpu.clone(), left);
        let sizes = band_sizes(layout.gpu.limits(), settings, left);
        sizes.check("a band of the output", layout.gpu.limits())?;
        let shown = Output::new(&memory, sizes.region)?;
        let look = FrameLook::default();
        let no_offsets = Offsets {
            all: &[[0.0; 2]],
            count: 1,
        };
        let resources = Resources::new(
            layout,
            &memory,
            scene,
            (&[], look.lights(scene)),
            &shown.views(),
            sizes,
            &[no_offsets],
        )?;
        let options = DetectOptions {
            mode: DetectMode::of(settings),
            blend_ids: scene.has_blend(),
            thin: settings.thin,
            transparent: true,
            multisampled: false,
            shadow_words: sizes.shadow_words,
            beyond: 0,
        };
        Ok(Self {
            width: settings.size[0],
            settings: settings.clone(),
            detect: Detect::new(layout, &options)?,
            masks: memory.buffer(
                "mask read-back",
                4 * u64::from(sizes.tiles()),
                vk::BufferUsageFlags::TRANSFER_DST,
                MemoryUse::Readback,
            )?,
            timings: Timings::new(&layout.gpu, 4)?,
            shown,
            resources,
            memory,
        })
    }

    /// Rows that there is room for.
    fn rows(&self) -> u32 {
        self.resources.sizes().region[1]
    }

    /// Writes what the cells of a band show, while the device is idle.
    fn show(&mut self, band: &Band, cells: &Cells) {
        let range = band.cells(self.width);
        let Cells {
            attributes,
            blend_ids,
            codes,
            shadows,
            ..
        } = cells;
        let ids = self.shown.words_mut(Shown::Ids);
        for (word, attributes) in ids.iter_mut().zip(&attributes[range.clone()]) {
            *word = attributes.id;
        }
        for (shown, plane) in [
            (Shown::BlendIds, blend_ids),
            (Shown::Codes, codes),
            (Shown::Shadows, shadows),
        ] {
            let plane = &plane[range.clone()];
            let words = self.shown.words_mut(shown);
            if let Some(words) = words.get_mut(..plane.len()) {
                words.copy_from_slice(plane);
            }
        }
    }

    /// Records the way of what was shown to the device, and that nothing is marked yet.
    ///
    /// # Safety
    /// - `commands` is being recorded, outside of a render pass, for the device and queue family of the renderer.
    /// - The commands of the last recording are done: its memory is used again.
    unsafe fn record_begin(&mut self, band: &Band, commands: vk::CommandBuffer) {
        let gpu = self.memory.gpu().clone();
        // SAFETY: passed on to the caller.
        let recorder = unsafe { Recorder::new(&gpu, commands, None) };
        let rows = band.seen.end - band.seen.start;
        self.shown.record(&recorder, &self.resources, rows);
        self.resources.record_upload(&recorder);
        recorder.clear(&self.resources.marks);
        recorder.barrier();
    }

    /// Records detection.
    ///
    /// # Safety
    /// As [`Self::record_begin`], after it.
    unsafe fn record(&mut self, band: &Band, commands: vk::CommandBuffer) {
        let gpu = self.memory.gpu().clone();
        let resources = &self.resources;
        let Some(set) = resources.set(0) else {
            return;
        };
        let tiles = band.tiles(self.width);
        let plane = PlaneBlock {
            size: [self.width, band.seen.end - band.seen.start],
            interior: [
                [0, band.rows.start - band.seen.start],
                [self.width, band.rows.end - band.seen.start],
            ],
            ..PlaneBlock::default()
        };
        let uniform = frame_uniform(
            &SceneBlock::default(),
            &plane,
            &self.settings,
            (1, &Footprints::new(&self.settings, 1)),
            resources.sizes(),
        );
        // SAFETY: passed on to the caller.
        let mut recorder = unsafe { Recorder::new(&gpu, commands, Some(&mut self.timings)) };
        recorder.begin();
        resources.record_begin(&recorder, set, &uniform);
        let count = tiles[0] * tiles[1];
        self.detect.record(&recorder, count);
        recorder.mark("detect");
        recorder.copy(&resources.masks, 4 * u64::from(count), &self.masks, 0);
        recorder.barrier();
    }

    /// Appends whether each cell of the band's rows aliases.
    fn read(&self, band: &Band, marked: &mut Vec<bool>) -> Result<(), VulkanError> {
        let [columns, rows] = band.tiles(self.width);
        let masks: &[u32] = self.masks.read((columns * rows) as usize)?;
        for row in band.rows.clone() {
            let y = row - band.seen.start;
            let tiles = &masks[(y / 4 * columns) as usize..];
            let bit = |x: u32| tiles[x as usize / 8] >> (y % 4 * 8 + x % 8) & 1 != 0;
            marked.extend((0..self.width).map(bit));
        }
        Ok(())
    }

    fn add_statistics(&self, total: &mut Statistics) -> Result<(), VulkanError> {
        for (pass, ms) in self.timings.read()? {
            total.add_time(PassTime { pass, ms });
        }
        Ok(())
    }
}

/// Room for as many rows as suit the device, and a quarter of the memory that is left.
fn band_sizes(limits: &Limits, settings: &Settings, left: Option<u64>) -> ResourceSizes {
    let [width, height] = settings.size;
    let sizes_of = |rows: u32| ResourceSizes {
        region: [width, rows],
        lanes: limits.lanes,
        locations: None,
        survivor_capacity: 0,
        pair_capacity: 0,
        list_capacity: 0,
        record_capacity: 0,
        filtered: 0,
        shadow_words: match settings.shadows {
            Shadows::None => 0,
            Shadows::Exact => 1,
        },
        attributes: false,
        encoded: 0,
    };
    let fits = |sizes: &ResourceSizes| {
        let bytes = sizes.bytes() + Output::bytes(sizes.region);
        u64::from(sizes.pixels()) <= MOST_CELLS
            && sizes.largest_texels() <= limits.max_texel_elements
            && sizes.largest_storage() <= limits.max_storage_bytes
            && left.is_none_or(|left| 4 * bytes <= left)
    };
    let mut rows = height;
    while rows > 1 && !fits(&sizes_of(rows + 2 * HALO)) {
        rows = rows.div_ceil(2);
    }
    sizes_of(rows + 2 * HALO)
}

impl Cells {
    /// What the location of a cell sees, with cells counted from `first` on.
    fn seen_at(&self, cell: u32, first: u32) -> SeenLocation {
        let at = cell as usize;
        SeenLocation {
            distance: self.attributes[at].depth,
            id: self.attributes[at].id,
            blend_id: self.blend_ids[at],
            output: cell - first,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_have_every_row_once_and_its_neighbours() {
        for (height, rows) in [(1, 1), (7, 3), (8, 4), (9, 20)] {
            let mut next = 0;
            for band in bands(height, rows) {
                assert_eq!(band.rows.start, next);
                assert!(band.rows.len() <= rows as usize);
                assert_eq!(band.seen.start, next.saturating_sub(1));
                next = band.rows.end;
                assert_eq!(band.seen.end, height.min(next + 1));
            }
            assert_eq!(next, height);
        }
    }
}
