//! Superpixels of an image that is sampled at locations. They are cells that alias, and cells that contrast with a
//! superpixel beside them once that superpixel has been sampled. Passes find them in one band of the output after the
//! other, by the rules that frames use for pixels; the host copies data between bands.

use super::crossings::CrossingFinder;
use super::image::OutputImage;
use super::partition::Partition;
use super::plan::LocationPlan;
use super::{ListSettings, PinholeLists, PointSample};
use crate::camera::{Pinhole, SampleLocation};
use crate::engine::data::tiles::{mask_bit, tiles};
use crate::engine::data::{Cells, Content, Data, Offsets, ResourceRequest, ResourceSizes, ShownIds};
use crate::engine::passes::detect::{self, DetectMode, DetectOptions};
use crate::engine::passes::grow;
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::sampler::footprint::Footprints;
use crate::engine::sampler::uniform::{PlaneBlock, SceneBlock, frame_uniform};
use crate::engine::sampler::{Capacity, Job, JobRecording};
use crate::render::data::{OutputCells, OutputPlane};
use crate::render::passes::{MarkedOutput, PROBES, neighbours};
use crate::render::{CellOptions, Headless, PreparedScene, RenderError, Settings, Shadows, Statistics};
use crate::vulkan::{Buffer, Limits, Memory, MemoryUse, VulkanError};
use ash::vk;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

/// Largest number of cells of a band, including the rows around it.
const MOST_CELLS: u64 = 1 << 20;

/// Rows of an output that are searched together.
struct Band {
    rows: Range<u32>,
    /// The rows of the band, and rows around it from which superpixels may grow into it.
    sampled: Range<u32>,
    /// The sampled rows and their neighbours.
    seen: Range<u32>,
}

/// Kind of superpixels to search for.
#[derive(Clone, Copy)]
enum Search {
    /// Cells that alias, judged by the surfaces and colours at their locations.
    Aliasing,
    /// Cells that contrast with a superpixel beside them; holds the number of earlier growths.
    Growth(usize),
}

/// Pipelines and memory for the search in bands of an output.
struct BandDetector {
    settings: Settings,
    cells: OutputCells,
    detect: Pass,
    neighbours: Pass,
    /// Passes for each growth, in the order in which they run.
    growths: Vec<Pass>,
    masks: Buffer,
    job: Job,
}

impl Headless {
    /// Samples the cells of an output that alias as superpixels.
    pub(super) fn sample_aliasing(
        &mut self,
        scene: &PreparedScene,
        rig: PinholeLists<'_>,
        settings: &Settings,
        image: &mut OutputImage,
    ) -> Result<Statistics, RenderError> {
        let mut statistics = Statistics::default();
        let looks_for_shadows = settings.superpixels().thin && settings.scene.shadows == Shadows::Exact;
        let mut shadowed = vec![false; if looks_for_shadows { image.len() } else { 0 }];
        if looks_for_shadows {
            statistics.append(self.mark_shadows(scene, rig, settings, image, &mut shadowed)?);
        }
        let layout = self.renderer.layout.clone();
        let mut detector = BandDetector::new(&layout, scene, settings)?;
        for band in detector.bands() {
            detector.show(&band, image, &shadowed);
            // SAFETY: the previous submission has run; the detector outlives this one, which is waited for.
            self.submit(|commands| unsafe { detector.record_begin(&band, commands) })?;
            if settings.superpixels().thin {
                for (pinhole, locations) in rig {
                    let taken = band.locations(locations, settings.size[0]);
                    if !taken.is_empty() {
                        let mut found = self.find_crossings(scene, pinhole, &taken, &detector, &band, image)?;
                        found.memory_bytes += detector.job.memory().used();
                        statistics.append(found);
                    }
                }
            }
            let growths = (0..detector.growths.len()).map(Search::Growth);
            for search in std::iter::once(Search::Aliasing).chain(growths) {
                if let Search::Growth(_) = search {
                    detector.show_colors(&band, image);
                }
                // SAFETY: as above.
                self.submit(|commands| unsafe { detector.record(&band, search, commands) })?;
                detector.add_statistics(&mut statistics)?;
                statistics.append(self.sample_found(scene, rig, &detector, &band, image)?);
            }
        }
        Ok(statistics)
    }

    /// Samples the superpixels that the last search found, without those that an earlier band has sampled.
    fn sample_found(
        &mut self,
        scene: &PreparedScene,
        rig: PinholeLists<'_>,
        detector: &BandDetector,
        band: &Band,
        image: &mut OutputImage,
    ) -> Result<Statistics, RenderError> {
        let settings = detector.settings_beside();
        let width = settings.size[0];
        let masks = detector.masks(band)?;
        let is_found = |cell: u32| {
            let (x, row) = (cell % width, cell / width);
            band.seen.contains(&row) && !image.is_superpixel(cell) && {
                let y = row - band.seen.start;
                let (tile, bit) = mask_bit([x, y], width);
                masks[tile] & bit != 0
            }
        };
        let found = rig.iter().map(|(pinhole, locations)| {
            let locations = locations.iter().filter(|location| is_found(location.output)).copied();
            (*pinhole, locations.collect())
        });
        self.sample_cells(scene, &found.collect::<Vec<_>>(), &settings, image)
    }

    /// Marks the cells in which a probe sees the location's triangle but is reached by other lights: the shadow of
    /// something narrower than a cell falls there. `docs/decisions.md` says why the passes of frames can't find these cells.
    fn mark_shadows(
        &mut self,
        scene: &PreparedScene,
        rig: PinholeLists<'_>,
        settings: &Settings,
        image: &OutputImage,
        shadowed: &mut [bool],
    ) -> Result<Statistics, RenderError> {
        let mut statistics = Statistics::default();
        for (pinhole, locations) in rig.iter().filter(|(_, locations)| !locations.is_empty()) {
            for probe in PROBES {
                let probes: Vec<SampleLocation> = locations.iter().map(|location| location.at(probe)).collect();
                let seen = self.sample_filtered_points(scene, pinhole, &probes, &settings.scene, settings.filter())?;
                statistics.append(seen.statistics);
                for (location, seen) in locations.iter().zip(&seen.values) {
                    let PointSample { id, shadows, .. } = *seen;
                    let cell = location.output as usize;
                    shadowed[cell] |= image.attributes[cell].id == id && image.shadows[cell] != shadows;
                }
            }
        }
        Ok(statistics)
    }

    /// Marks the cells of a band that thin triangles cross without covering a location.
    fn find_crossings(
        &mut self,
        scene: &PreparedScene,
        pinhole: &Pinhole,
        locations: &[SampleLocation],
        detector: &BandDetector,
        band: &Band,
        image: &OutputImage,
    ) -> Result<Statistics, RenderError> {
        let layout = self.renderer.layout.clone();
        let settings = detector.settings_beside();
        let scene_settings = settings.scene.clone().shadows(Shadows::None);
        let settings = ListSettings {
            sampler: scene_settings.sampler(CellOptions::new(1), settings.filter()),
            scene: scene_settings,
            spread: None,
        };
        let partition = Partition::new(locations, Cells::Superpixels)?;
        let width = detector.settings.size[0];
        let output = MarkedOutput { tiles: band.tiles(width), width, pixel: pixel_width(pinhole) as f32 };
        let marks = detector.job.resources().buffer(Data::Marks);
        let folds = detector.settings.superpixels().has_many_samples();
        let make = |capacity| {
            let plan = LocationPlan::new(&layout, scene, &settings, &partition, false, capacity)?;
            // SAFETY: the marks live as long as the detector, which outlives all submissions: each is waited for.
            let finder = unsafe { CrossingFinder::new(&layout, scene, &settings, &plan, output, marks, folds) }?;
            Ok((plan, finder))
        };
        let first = band.seen.start * width;
        let mut statistics = Statistics::default();
        // Cells that a run marked stay marked if it is repeated.
        self.each_run(
            make,
            |headless, finder, run| {
                let window = partition.window(run);
                let (listed, seen) = finder.listed_mut(run.len())?;
                partition.list(run, &window, listed);
                for (seen, place) in seen.iter_mut().zip(run.clone()) {
                    *seen = image.seen_at(partition.location(place).output, first);
                }
                // SAFETY: the previous submission has run; scene and finder outlive this one, which is waited for. The
                // cells are those of the band.
                headless.submit(|commands| unsafe {
                    finder.record(scene, pinhole, &window, run.len(), commands);
                })?;
                Ok(finder.shortfall()?)
            },
            |finder, _| Ok(finder.add_statistics(scene, &mut statistics)?),
        )?;
        Ok(statistics)
    }
}

impl Band {
    /// Cells of the band and of all rows around it, as a range of the output's cells.
    fn cells(&self, width: u32) -> Range<usize> {
        let cell = |row: u32| row as usize * width as usize;
        cell(self.seen.start)..cell(self.seen.end)
    }

    fn height(&self) -> u32 {
        self.seen.end - self.seen.start
    }

    fn tiles(&self, width: u32) -> [u32; 2] {
        tiles([width, self.height()])
    }

    /// Locations whose cells may become superpixels in this band.
    fn locations<'a>(&self, locations: &'a [SampleLocation], width: u32) -> Cow<'a, [SampleLocation]> {
        let inside = |location: &&SampleLocation| self.sampled.contains(&(location.output / width));
        if locations.iter().all(|location| inside(&location)) {
            Cow::Borrowed(locations)
        } else {
            Cow::Owned(locations.iter().filter(inside).copied().collect())
        }
    }
}

/// Bands of at most `rows` rows each, for superpixels that grow `growths` times.
fn bands(height: u32, rows: u32, growths: u32) -> impl Iterator<Item = Band> {
    (0..height).step_by(rows as usize).map(move |first| {
        let end = height.min(first + rows);
        let around = |beyond: u32| first.saturating_sub(beyond)..height.min(end + beyond);
        Band { rows: first..end, sampled: around(growths), seen: around(growths + 1) }
    })
}

/// Width of a pixel of the plane: at distance 1, or at any distance for parallel rays.
fn pixel_width(pinhole: &Pinhole) -> f64 {
    let [a, b] = pinhole.steps();
    let to_plane =
        if pinhole.is_parallel() { 1.0 } else { (pinhole.origin() - pinhole.eye()).dot(pinhole.direction()) };
    a.cross(b).length().sqrt() / to_plane
}

impl BandDetector {
    fn new(layout: &Arc<FrameLayout>, prepared: &PreparedScene, settings: &Settings) -> Result<Self, RenderError> {
        let scene = &*prepared.gpu_scene;
        let taken = prepared.memory_bytes();
        let left = settings.scene.max_memory.map(|limit| limit.saturating_sub(taken));
        let memory = Memory::new(layout.gpu.clone(), left);
        let sizes = band_sizes(layout.gpu.limits(), settings, left);
        sizes.check(layout.gpu.limits())?;
        let cells = OutputCells::new(&memory, sizes.region)?;
        let masks = memory.buffer(
            "mask read-back",
            4 * u64::from(sizes.tiles()),
            vk::BufferUsageFlags::TRANSFER_DST,
            MemoryUse::Readback,
        )?;
        let request = ResourceRequest {
            sizes,
            others: &[],
            ids: ShownIds::Drawn(cells.views()),
            offsets: &[Offsets { all: &[[0.0; 2]], count: 1 }],
            scratch: None,
        };
        let superpixels = settings.superpixels();
        let growths = superpixels.growth_count();
        let options = DetectOptions {
            mode: DetectMode::of(&superpixels),
            blend_ids: scene.has_blend(),
            thin: superpixels.thin,
            transparent: true,
            multisampled: false,
            shadow_words: sizes.shadow_words,
            beyond: growths,
        };
        let grow = |beyond: u32| grow::pass(layout, beyond);
        Ok(Self {
            settings: settings.clone(),
            detect: detect::pass(layout, &options)?,
            neighbours: neighbours::pass(layout, &settings.sampler().color_constants(scene))?,
            growths: (0..growths).rev().map(grow).collect::<Result<_, _>>()?,
            masks,
            cells,
            job: Job::new(layout, memory, &settings.sampler(), Capacity::default(), &request)?,
        })
    }

    /// The settings, with the memory limit reduced by the memory of this detector.
    fn settings_beside(&self) -> Settings {
        let allowed = self.settings.scene.max_memory;
        let left = allowed.map(|limit| limit.saturating_sub(self.job.memory().used()));
        self.settings.clone().max_memory(left)
    }

    /// The bands of the output.
    fn bands(&self) -> impl Iterator<Item = Band> + use<> {
        let growths = self.growths.len() as u32;
        let rows = self.job.resources().sizes().region[1] - 2 * (growths + 1);
        bands(self.settings.size[1], rows, growths)
    }

    /// Writes the visible surfaces and colours of a band's cells. Unless `shadowed` is empty, it says which cells have
    /// shadows narrower than a cell. The device must be idle.
    fn show(&mut self, band: &Band, image: &OutputImage, shadowed: &[bool]) {
        let width = self.settings.size[0];
        let range = band.cells(width);
        let ids = self.cells.words_mut(OutputPlane::Ids);
        for (word, attributes) in ids.iter_mut().zip(&image.attributes[range.clone()]) {
            *word = attributes.id;
        }
        for (plane, values) in [
            (OutputPlane::BlendIds, &image.blend_ids),
            (OutputPlane::Codes, &image.codes),
            (OutputPlane::Shadows, &image.shadows),
        ] {
            let values = &values[range.clone()];
            if let Some(words) = self.cells.words_mut(plane).get_mut(..values.len()) {
                words.copy_from_slice(values);
            }
        }
        let marks = self.cells.words_mut(OutputPlane::Marks);
        marks.fill(0);
        for (cell, _) in (0_u32..).zip(shadowed.get(range).unwrap_or(&[])).filter(|(_, shadowed)| **shadowed) {
            let (tile, bit) = mask_bit([cell % width, cell / width], width);
            if let Some(word) = marks.get_mut(tile) {
                *word |= bit;
            }
        }
    }

    /// Writes the colours of the cells of a band. The device must be idle.
    fn show_colors(&mut self, band: &Band, image: &OutputImage) {
        let colors = &image.colors[band.cells(self.settings.size[0])];
        let words = self.cells.words_mut(OutputPlane::Colors);
        if let Some(words) = words.get_mut(..4 * colors.len()) {
            words.copy_from_slice(bytemuck::cast_slice(colors));
        }
    }

    /// Records the upload of the band's cells.
    ///
    /// # Safety
    /// - `commands` is being recorded, outside of a render pass, for the device and queue family of the renderer.
    /// - The commands of the last recording have run: its memory is used again.
    unsafe fn record_begin(&mut self, band: &Band, commands: vk::CommandBuffer) {
        // SAFETY: guaranteed by the caller.
        let recording = unsafe { self.job.begin(commands, |_| ()) };
        self.cells.record(&recording.recorder, recording.resources, band.height());
        recording.end();
    }

    /// Records a search for superpixels, and the copy of their masks to host memory.
    ///
    /// # Safety
    /// As [`Self::record_begin`], which was recorded before for this band; searches of a band are recorded in their
    /// order.
    unsafe fn record(&mut self, band: &Band, search: Search, commands: vk::CommandBuffer) {
        let width = self.settings.size[0];
        let Self { settings, cells, detect, neighbours, growths, masks, job } = self;
        // SAFETY: guaranteed by the caller.
        let recording = unsafe { job.begin(commands, |_| ()) };
        let JobRecording { recorder, resources, settings: of_sampler, .. } = &recording;
        let Some(set) = resources.set(0) else {
            return;
        };
        let row = |row: u32| row - band.seen.start;
        let plane = PlaneBlock {
            size: [width, band.height()],
            interior: [[0, row(band.rows.start)], [width, row(band.rows.end)]],
            contrast: u32::from(settings.superpixels().threshold()),
            ..PlaneBlock::default()
        };
        let uniform = frame_uniform(
            &SceneBlock::default(),
            &plane,
            of_sampler,
            1,
            &Footprints::new(settings.filter(), 1),
            resources.sizes(),
        );
        let [columns, rows] = uniform.tiles;
        let tiles = columns * rows;
        recorder.begin();
        resources.record_begin(recorder, set, &uniform);
        match search {
            Search::Aliasing => {
                detect.record_for(recorder, tiles);
                recorder.clear(resources.buffer(Data::Marks));
            }
            Search::Growth(growth) => {
                cells.record_colors(recorder, resources, band.height());
                neighbours.record_for(recorder, width * band.height());
                growths[growth].record_for(recorder, tiles);
            }
        }
        recorder.copy(resources.buffer(Data::Masks), 4 * u64::from(tiles), masks, 0);
        recording.end();
    }

    /// Masks of the superpixels that the last search in a band found.
    fn masks(&self, band: &Band) -> Result<&[u32], VulkanError> {
        let [columns, rows] = band.tiles(self.settings.size[0]);
        self.masks.read((columns * rows) as usize)
    }

    fn add_statistics(&self, total: &mut Statistics) -> Result<(), VulkanError> {
        let found = self.job.statistics(None, &[], 0, 0)?;
        for time in found.passes {
            total.add_time(time);
        }
        Ok(())
    }
}

/// Sizes for a band with as many rows as the device allows and as fit into a quarter of `left`, the free memory in
/// bytes.
fn band_sizes(limits: &Limits, settings: &Settings, left: Option<u64>) -> ResourceSizes {
    let [width, height] = settings.size;
    let halo = 2 * (settings.superpixels().growth_count() + 1);
    let sizes_of = |rows: u32| ResourceSizes {
        shadow_words: match settings.scene.shadows {
            Shadows::None => 0,
            Shadows::Exact => 1,
        },
        ..ResourceSizes::new([width, rows], 0, limits)
    };
    let fits = |sizes: &ResourceSizes| {
        let bytes = sizes.bytes() + OutputCells::bytes(sizes.region);
        u64::from(sizes.pixels()) <= MOST_CELLS
            && sizes.check(limits).is_ok()
            && left.is_none_or(|left| 4 * bytes <= left)
    };
    let mut rows = height;
    while rows > 1 && !fits(&sizes_of(rows + halo)) {
        rows = rows.div_ceil(2);
    }
    sizes_of(rows + halo)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_have_every_row_once_and_the_rows_that_superpixels_grow_from() {
        for (height, rows, growths) in [(1, 1, 0), (7, 3, 1), (8, 4, 2), (9, 20, 2)] {
            let mut next = 0;
            for band in bands(height, rows, growths) {
                assert_eq!(band.rows.start, next);
                assert!(band.rows.len() <= rows as usize);
                next = band.rows.end;
                for (around, beyond) in [(band.sampled, growths), (band.seen, growths + 1)] {
                    assert_eq!(around.start, band.rows.start.saturating_sub(beyond));
                    assert_eq!(around.end, height.min(next + beyond));
                }
            }
            assert_eq!(next, height);
        }
    }
}
