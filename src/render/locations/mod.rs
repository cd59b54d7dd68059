//! Sampling at any set of locations on a pinhole's image plane.
//!
//! A scene is sampled at [`SampleLocation`]s, once each ([`Headless::sample_points`]) or as superpixels
//! ([`Headless::sample_superpixels`]); [`Headless::render_locations`] makes an image of both. The sampler is the one
//! that antialiases images; no picture is resampled.

mod crossings;
mod detection;
mod error;
mod filter;
mod image;
mod partition;
mod plan;
mod retry;
mod run;
mod sampler;

pub use error::LocationError;

use super::shadows::{Casters, ShadowRequest, Sight};
use super::{CellOptions, Headless, PreparedScene, RenderError, SceneSettings, Shading, Statistics};
use crate::camera::{Pinhole, SampleLocation};
use crate::engine::data::Cells;
use crate::engine::pipelines::FrameLayout;
use crate::engine::sampler::footprint::TextureFilter;
use crate::engine::sampler::{Capacity, SamplerSettings};
use crate::sampling::Bend;
use partition::Partition;
use plan::LocationPlan;
use sampler::{CellSpread, LocationSampler, LocationValues};
use std::ops::Range;
use std::sync::Arc;

/// Colour and nearest surfaces of a scene at a sampling location.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointSample {
    /// Colour in linear light with premultiplied alpha.
    pub color: [f32; 4],
    /// Distance from the eye along the view direction, in world units; 0 for background.
    pub depth: f32,
    /// ID of the nearest opaque or MASK triangle: its index plus 1; 0 for background.
    pub id: u32,
    /// ID of the nearest BLEND triangle in front of that; 0 for none.
    pub blend_id: u32,
    /// Unit normal of the opaque or MASK triangle in world space; 0 for background.
    pub normal: [f32; 3],
    /// Colour as detection compares it: 8-bit sRGB codes and alpha, red in the lowest byte.
    pub code: u32,
    /// Bits of the lights that do not reach the opaque or MASK triangle, the pose's first light in the lowest bit:
    /// another triangle casts a shadow, or the light shines on the other side. 0 without
    /// [`Shadows::Exact`](super::Shadows::Exact).
    pub shadows: u32,
}

/// Pinholes, each with the locations on its plane.
type PinholeLists<'a> = &'a [(Pinhole, Vec<SampleLocation>)];

/// Settings of sampling a list of locations.
#[derive(Clone)]
struct ListSettings {
    scene: SceneSettings,
    sampler: SamplerSettings,
    /// For a pixel filter, the function by which the spread of cells is described.
    spread: Option<Bend>,
}

impl ListSettings {
    /// Request for shadows of these casters on `places` locations.
    fn shadows<'a>(
        &'a self,
        layout: &'a Arc<FrameLayout>,
        casters: &'a Arc<Casters>,
        capacity: Capacity,
        places: u64,
    ) -> ShadowRequest<'a> {
        let max_memory = self.scene.max_memory;
        ShadowRequest { layout, casters, settings: &self.sampler, capacity, places, max_memory }
    }
}

/// Values at a list of locations, in the order of the list, and statistics of sampling them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sampled<T> {
    /// Values, one for each location.
    pub values: Vec<T>,
    /// Statistics of all runs. Runs count as regions, and locations that are sampled as superpixels count as
    /// superpixels.
    pub statistics: Statistics,
}

impl Headless {
    /// Samples a scene once at each location. With [`Footprint::Sample`](super::Footprint::Sample), textures are filtered as
    /// at the centres of pixels that may become superpixels; with [`Footprint::Pixel`](super::Footprint::Pixel), as in images
    /// with one sample a pixel.
    ///
    /// # Errors
    /// [`RenderError::Location`] names the first location that can't be sampled; with
    /// [`Shadows::Exact`](super::Shadows::Exact), [`RenderError::NoCasters`] and [`RenderError::ShadowLights`];
    /// otherwise as [`Headless::render`].
    pub fn sample_points(
        &mut self,
        scene: &PreparedScene,
        pinhole: &Pinhole,
        locations: &[SampleLocation],
        settings: &SceneSettings,
    ) -> Result<Sampled<PointSample>, RenderError> {
        let filter = TextureFilter::of_cells(settings.footprint, Shading::Part);
        self.sample_filtered_points(scene, pinhole, locations, settings, filter)
    }

    /// Samples a scene once at each location, with this filter of textures.
    fn sample_filtered_points(
        &mut self,
        scene: &PreparedScene,
        pinhole: &Pinhole,
        locations: &[SampleLocation],
        settings: &SceneSettings,
        filter: TextureFilter,
    ) -> Result<Sampled<PointSample>, RenderError> {
        let settings = &ListSettings {
            scene: settings.clone(),
            sampler: settings.sampler(CellOptions::new(1), filter),
            spread: None,
        };
        let partition = Partition::new(locations, Cells::Points)?;
        let mut values: Vec<PointSample> = Vec::with_capacity(locations.len());
        let statistics = self.run_locations(&partition, scene, pinhole, settings, |run, seen| {
            partition.put(run, &mut values, |i| {
                let [[depth, id, blend_id, code], normal] = seen.attributes[i];
                let [x, y, z, _] = normal.map(f32::from_bits);
                let [.., shadows] = normal;
                PointSample {
                    color: seen.colors[i],
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

    /// Samples each location as a superpixel: its samples lie at the location plus its Jacobian times the offsets of
    /// the pattern. The values are resolved colours in linear light with premultiplied alpha. With
    /// [`Shadows::Exact`](super::Shadows::Exact) shadows are tested at every sample.
    ///
    /// # Errors
    /// [`RenderError::Location`] names the first location that can't be sampled, [`EngineError::Pattern`](crate::render::EngineError::Pattern) lists the
    /// possible numbers of samples; otherwise as [`Headless::render`].
    pub fn sample_superpixels(
        &mut self,
        scene: &PreparedScene,
        pinhole: &Pinhole,
        locations: &[SampleLocation],
        cells: &CellOptions,
        settings: &SceneSettings,
    ) -> Result<Sampled<[f32; 4]>, RenderError> {
        let (resolved, _) = self.sample_spread_superpixels(scene, pinhole, locations, cells, settings, None)?;
        Ok(resolved)
    }

    /// As [`Self::sample_superpixels`]. Also returns how the light of each location is spread over its cell, described by
    /// the function `spread`, unless that is `None`.
    fn sample_spread_superpixels(
        &mut self,
        scene: &PreparedScene,
        pinhole: &Pinhole,
        locations: &[SampleLocation],
        cells: &CellOptions,
        settings: &SceneSettings,
        spread: Option<Bend>,
    ) -> Result<(Sampled<[f32; 4]>, Vec<CellSpread>), RenderError> {
        let merged = settings.merged(cells, &*scene.gpu_scene, spread.is_some());
        let shadowed = settings.shadowed(cells.clone());
        let filter = TextureFilter::of_cells(settings.footprint, merged.unwrap_or(shadowed.shading));
        let sampler = SamplerSettings { merged, ..settings.sampler(shadowed, filter) };
        let settings = &ListSettings { scene: settings.clone(), sampler, spread };
        let partition = Partition::new(locations, Cells::Superpixels)?;
        let mut values: Vec<[f32; 4]> = Vec::with_capacity(locations.len());
        let mut spreads = Vec::new();
        let statistics = self.run_locations(&partition, scene, pinhole, settings, |run, seen| {
            partition.put(run, &mut values, |i| seen.colors[i]);
            if spread.is_some() {
                partition.put(run, &mut spreads, |i| seen.spreads[i]);
            }
        })?;
        Ok((Sampled { values, statistics }, spreads))
    }

    /// Samples locations run by run, in the partition's order, and passes each run and its values to `take`.
    fn run_locations(
        &mut self,
        partition: &Partition<'_>,
        scene: &PreparedScene,
        pinhole: &Pinhole,
        settings: &ListSettings,
        mut take: impl FnMut(&Range<usize>, &LocationValues<'_>),
    ) -> Result<Statistics, RenderError> {
        self.check(&scene.gpu_scene)?;
        settings.scene.check()?;
        settings.sampler.check()?;
        let layout = self.renderer.layout.clone();
        let may_stop = self.may_stop();
        let make = |capacity: Capacity| {
            let plan = LocationPlan::new(&layout, scene, settings, partition, may_stop, capacity)?;
            let sampler = LocationSampler::new(&layout, scene, settings, &plan)?;
            Ok::<_, RenderError>((plan, sampler))
        };
        let mut statistics = Statistics::default();
        let ([low, high], beyond) = partition.reach();
        self.each_run(
            make,
            |headless, sampler, run| {
                let window = partition.window(run);
                partition.list(run, &window, sampler.listed_mut(run.len())?);
                let sight = Sight {
                    pinhole: *pinhole,
                    whole: [low - beyond, high + beyond],
                    part: window.rectangle(beyond),
                    origin: scene.gpu_scene.geometry.origin,
                };
                // SAFETY: the previous submission has run; scene and sampler outlive this one, which is waited for.
                headless.submit(|commands| unsafe {
                    sampler.record(scene, &sight, &window, run.len(), commands);
                })?;
                Ok(sampler.shortfall(&window)?)
            },
            |sampler, run| {
                sampler.add_statistics(scene, &partition.window(&run), &mut statistics)?;
                take(&run, &sampler.values(run.len())?);
                Ok(())
            },
        )?;
        Ok(statistics)
    }
}
