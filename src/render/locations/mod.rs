//! Sampling at any set of locations on a pinhole's image plane.
//!
//! A scene is sampled where [`SampleLocation`]s lie, once each ([`Headless::sample_points`]) or as superpixels
//! ([`Headless::sample_superpixels`]); [`Headless::render_locations`] makes an image of both. They run on the sampler that
//! antialiases images; no picture is resampled.

mod crossings;
mod detection;
mod error;
mod image;
mod partition;
mod plan;
mod run;
mod sampler;

pub use error::LocationError;

use super::shadows::Sight;
use super::{Headless, PreparedScene, RenderError, Settings, Statistics};
use crate::camera::{Pinhole, SampleLocation};
use crate::passes::Cells;
use partition::Partition;
use plan::LocationPlan;
use sampler::{LocationSampler, LocationValues};
use std::ops::Range;

/// What a sampling location sees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointSample {
    /// Linear light, premultiplied alpha.
    pub color: [f32; 4],
    /// Distance from the eye along the view direction in world units; 0 for background.
    pub depth: f32,
    /// ID of the nearest opaque or MASK triangle; 0 is background.
    pub id: u32,
    /// ID of the nearest BLEND triangle in front of it; 0 where there is none.
    pub blend_id: u32,
    /// Unit normal of the opaque or MASK triangle in world space; 0 for background.
    pub normal: [f32; 3],
    /// The colour as detection compares it: 8-bit sRGB codes and alpha, red in the lowest byte.
    pub code: u32,
    /// With [`Shadows::Exact`](super::Shadows::Exact), a bit for each light of the pose, the first one lowest, that
    /// another triangle keeps from the opaque or MASK triangle, or which shines on its other side; otherwise 0.
    pub shadows: u32,
}

/// Pinholes, and the locations on the plane of each.
type PinholeLists<'a> = &'a [(Pinhole, Vec<SampleLocation>)];

/// What a run of locations saw.
struct RunValues<'a> {
    /// Its locations, as places in the order of the partition.
    places: Range<usize>,
    seen: LocationValues<'a>,
}

/// What a set of locations sees, in the order of the locations, and what it cost.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sampled<T> {
    /// One value a location.
    pub values: Vec<T>,
    /// Figures of all runs, which count as regions; locations sampled as superpixels count as these.
    pub statistics: Statistics,
}

impl Headless {
    /// Samples a scene once at each location. Of the settings, size, method, samples and detection do not matter.
    ///
    /// # Errors
    /// [`RenderError::Location`] names the first location that can't be sampled; with [`Shadows::Exact`](super::Shadows::Exact),
    /// [`RenderError::NoCasters`] and [`RenderError::ShadowLights`]; otherwise as [`Headless::render`].
    pub fn sample_points(
        &mut self,
        scene: &PreparedScene,
        pinhole: &Pinhole,
        locations: &[SampleLocation],
        settings: &Settings,
    ) -> Result<Sampled<PointSample>, RenderError> {
        let partition = Partition::new(locations, Cells::Points)?;
        let mut values: Vec<PointSample> = Vec::with_capacity(locations.len());
        let statistics = self.run_locations(&partition, (scene, pinhole), settings, |run| {
            partition.put(&run.places, &mut values, |i| {
                let [[depth, id, blend_id, code], normal] = run.seen.attributes[i];
                let [x, y, z, _] = normal.map(f32::from_bits);
                let [.., shadows] = normal;
                PointSample {
                    color: run.seen.colors[i],
                    depth: f32::from_bits(depth),
                    id,
                    blend_id,
                    normal: [x, y, z],
                    code,
                    shadows,
                }
            });
        })?;
        Ok(Sampled { values, statistics })
    }

    /// Samples each location as a superpixel: as often as the settings say, at its location plus its Jacobian times the
    /// offsets of their pattern. The values are resolved colours, linear light with premultiplied alpha. Of the
    /// settings, size, method and detection do not matter. With [`Shadows::Exact`](super::Shadows::Exact) every
    /// sub-sample is shaded by itself, whatever the settings say.
    ///
    /// # Errors
    /// [`RenderError::Location`] names the first location that can't be sampled, [`RenderError::Pattern`] says which numbers of
    /// samples there are; otherwise as [`Headless::render`].
    pub fn sample_superpixels(
        &mut self,
        scene: &PreparedScene,
        pinhole: &Pinhole,
        locations: &[SampleLocation],
        settings: &Settings,
    ) -> Result<Sampled<[f32; 4]>, RenderError> {
        let settings = &settings.with_shadowed_samples();
        let partition = Partition::new(locations, Cells::Superpixels)?;
        let mut values: Vec<[f32; 4]> = Vec::with_capacity(locations.len());
        let statistics = self.run_locations(&partition, (scene, pinhole), settings, |run| {
            partition.put(&run.places, &mut values, |i| run.seen.colors[i]);
        })?;
        Ok(Sampled { values, statistics })
    }

    /// Samples locations run by run, in the partition's order; `take` is given what each run saw.
    fn run_locations(
        &mut self,
        partition: &Partition<'_>,
        (scene, pinhole): (&PreparedScene, &Pinhole),
        settings: &Settings,
        mut take: impl FnMut(&RunValues<'_>),
    ) -> Result<Statistics, RenderError> {
        self.check(&scene.gpu_scene)?;
        let layout = self.renderer.layout.clone();
        let plan = LocationPlan::new(&layout, scene, settings, partition, self.may_stop())?;
        let make = |apart: bool| LocationSampler::new(&layout, scene, settings, &plan, apart);
        let (mut sampler, mut apart) = (make(false)?, false);
        let mut statistics = Statistics::default();
        let ([low, high], beyond) = partition.reach();
        let mut waiting: Vec<_> = plan.runs.iter().rev().cloned().collect();
        while let Some(run) = waiting.pop() {
            let window = partition.window(&run);
            partition.list((&run, &window), sampler.listed_mut(run.len())?);
            let sight = Sight {
                pinhole: *pinhole,
                whole: [low - beyond, high + beyond],
                part: window.rectangle(beyond),
                places: partition.places(),
                origin: scene.gpu_scene.origin(),
            };
            // SAFETY: the last submission was waited for; scene and sampler outlive this one, which is waited for.
            self.submit(|commands| unsafe {
                sampler.record(scene, &sight, &window, run.len(), commands);
            })?;
            match sampler.check(&window) {
                Ok(()) => {}
                // One cell at a time gets through longer lists.
                Err(RenderError::Unfinished { .. })
                    if !apart && sampler.has_long_lists(&window)? =>
                {
                    apart = true;
                    sampler = make(apart)?;
                    waiting.push(run);
                    continue;
                }
                // Half as many locations have half as many records.
                Err(RenderError::Unfinished { cells }) if run.len() > 1 => {
                    log::debug!(
                        "{cells} cells or tiles of {} locations did not fit",
                        run.len()
                    );
                    waiting.extend(LocationPlan::halves(&run));
                    continue;
                }
                Err(error) => return Err(error),
            }
            sampler.add_statistics(scene, &window, &mut statistics)?;
            take(&RunValues {
                seen: sampler.values(run.len())?,
                places: run,
            });
        }
        Ok(statistics)
    }
}
