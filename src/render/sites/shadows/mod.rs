//! Exact shadows. The points that sites see, sub-samples of superpixels included, are projected on the image plane of
//! each light, where they are a sampling set without any pattern. Sampling it tells which of them another triangle lies
//! before: no map of depths is made, and there is nothing of one to alias.
//!
//! A point is in shadow where a triangle other than its own, opaque or passing its alpha test, lies nearer to the light
//! by more than 2^-17 of its distance (of the scene's depth for a distant light); and where its own triangle turns the
//! side that is seen from the light, whatever its interpolated normals say, so that the border of light on a smooth ball
//! of few triangles follows its edges. BLEND triangles neither cast shadows nor receive them.
//!
//! The host stands between the steps: it reads back what sites see, projects it, asks for each light, and hands a word
//! of bits for each site to the run that shades it.

mod casters;
mod light;
mod receivers;

pub(in crate::render) use casters::Casters;

use super::partition::Partition;
use super::{Sampled, Task};
use crate::camera::{Camera, Pinhole, Site};
use crate::passes::Cells;
use crate::render::{
    Headless, PassTime, PreparedScene, RenderError, Rendered, Settings, Statistics,
};
use crate::scene::{Pose, Scene};
use casters::caster_scene;
use receivers::receivers;

/// Most lights that cast shadows: bits of a site's word.
const MOST_LIGHTS: usize = 32;
/// Most sub-samples that are points at once, on the host.
const MOST_POINTS: usize = 1 << 18;

impl Headless {
    /// Makes an uploaded scene ready for [`Shadows::Exact`](crate::render::Shadows::Exact): puts what casts shadows on
    /// the device once more, seen from both sides, and keeps its triangles in the host's memory too. `scene` and `pose`
    /// are those that `prepared` was made of; `max_memory` bounds both together, in bytes.
    ///
    /// # Errors
    /// [`RenderError::ShadowLights`] for more than 32 lights; otherwise as [`Headless::upload`].
    pub fn prepare_shadows(
        &mut self,
        prepared: &mut PreparedScene,
        scene: &Scene,
        pose: &Pose,
        max_memory: Option<u64>,
    ) -> Result<(), RenderError> {
        let found = pose.lights.len();
        if found > MOST_LIGHTS {
            return Err(RenderError::ShadowLights { found });
        }
        prepared.casters = None;
        let left = max_memory.map(|most| most.saturating_sub(prepared.memory_bytes()));
        let (scene, pose) = caster_scene(scene, pose);
        let uploaded = self.upload(&scene, &pose, left)?;
        prepared.casters = Some(Box::new(Casters::new(uploaded, pose)));
        Ok(())
    }

    /// Renders what a camera sees, with the shadows that the settings ask for: [`Headless::render_sites`] with the centres
    /// of an image's pixels.
    ///
    /// # Errors
    /// [`RenderError::Pinhole`] if the size is 0 or the camera is impossible; otherwise as [`Headless::render_sites`].
    pub fn render_with_shadows(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
    ) -> Result<Rendered, RenderError> {
        settings.check(self.gpu().limits())?;
        let size = settings.size;
        let pinhole = Pinhole::from_camera(camera, size)?;
        let site = |(row, column): (u32, u32)| Site {
            uv: [column, row].map(|pixel| f64::from(pixel) + 0.5),
            jacobian: [[1.0, 0.0], [0.0, 1.0]],
            output: row * size[0] + column,
        };
        let pixels = (0..size[1]).flat_map(|row| (0..size[0]).map(move |column| (row, column)));
        let sites = pixels.map(site).collect();
        self.render_sites(scene, &[(pinhole, sites)], size, settings)
    }

    /// A bit for each light that sites see the shadow of.
    pub(super) fn shadows(
        &mut self,
        (scene, pinhole): (&PreparedScene, &Pinhole),
        (sites, partition): (&[Site], &Partition<'_>),
        settings: &Settings,
    ) -> Result<Sampled<u32>, RenderError> {
        let casters = scene.casters.as_deref().ok_or(RenderError::NoCasters)?;
        let mut words = vec![0; sites.len()];
        let mut statistics = Statistics::default();
        let Some(bounds) = casters.bounds.filter(|_| !casters.lights.is_empty()) else {
            return Ok(Sampled {
                values: words,
                statistics,
            });
        };
        let mut ids = vec![0; sites.len()];
        let surfaces = Task {
            scene,
            pinhole,
            colors: false,
            words: &[],
        };
        let run = self.run_sites(partition, surfaces, settings, |index, seen, place| {
            if let (Some(id), Some([[_, nearest, ..], _])) =
                (ids.get_mut(index), seen.attributes.get(place))
            {
                *id = *nearest;
            }
        })?;
        book(&mut statistics, &run);
        let receivers = receivers(scene.triangles.get(), pinhole, sites, &ids);
        let own = scene.memory_bytes() - casters.memory_bytes();
        let settings = Settings {
            max_memory: settings.max_memory.map(|most| most.saturating_sub(own)),
            ..settings.clone()
        };
        for (bit, light) in casters.lights.iter().enumerate() {
            let mut hide = |index: usize| {
                if let Some(word) = words.get_mut(index) {
                    *word |= 1 << bit;
                }
            };
            let [facing, turned] = light::reached(light, &receivers);
            turned.iter().for_each(|receiver| hide(receiver.index));
            if facing.is_empty() {
                continue;
            }
            for view in light::views(light, bounds, &facing)? {
                let partition = Partition::new(&view.sites, Cells::Occluders)?;
                let task = Task {
                    scene: &casters.scene,
                    pinhole: &view.pinhole,
                    colors: false,
                    words: &view.ids,
                };
                let run = self.run_sites(&partition, task, &settings, |index, seen, place| {
                    let occluder = seen.attributes.get(place).map(|[[_, id, ..], _]| *id);
                    if let (Some(1..), Some(receiver)) = (occluder, view.indices.get(index)) {
                        hide(*receiver);
                    }
                })?;
                book(&mut statistics, &run);
            }
        }
        Ok(Sampled {
            values: words,
            statistics,
        })
    }

    /// Superpixels whose sub-samples are points: their means.
    pub(super) fn superpixels_of_points(
        &mut self,
        scene: &PreparedScene,
        pinhole: &Pinhole,
        sites: &[Site],
        settings: &Settings,
    ) -> Result<Sampled<[f32; 4]>, RenderError> {
        let offsets = settings.pattern.offsets(settings.samples)?;
        let mut sampled = Sampled {
            values: Vec::with_capacity(sites.len()),
            statistics: Statistics::default(),
        };
        for sites in sites.chunks((MOST_POINTS / offsets.len().max(1)).max(1)) {
            let point = |site: &Site, offset: &[f32; 2]| {
                let [x, y] = offset.map(f64::from);
                let [column, row] = site.jacobian;
                let at = |axis: usize| site.uv[axis] + column[axis] * x + row[axis] * y;
                Site {
                    uv: [at(0), at(1)],
                    ..*site
                }
            };
            let points: Vec<Site> = sites
                .iter()
                .flat_map(|site| offsets.iter().map(move |offset| point(site, offset)))
                .collect();
            let seen = self.sample_points(scene, pinhole, &points, settings)?;
            sampled.statistics.append(seen.statistics);
            let means = seen.values.chunks(offsets.len()).map(|points| {
                let mut sum = [0.0; 4];
                for point in points {
                    for (sum, channel) in sum.iter_mut().zip(point.color) {
                        *sum += f64::from(channel);
                    }
                }
                sum.map(|sum| (sum / points.len() as f64) as f32)
            });
            sampled.values.extend(means);
        }
        sampled.statistics.superpixels = sites.len() as u64;
        Ok(sampled)
    }
}

/// Books what a run took as the cost of shadows.
fn book(statistics: &mut Statistics, run: &Statistics) {
    statistics.regions += run.regions;
    statistics.memory_bytes = statistics.memory_bytes.max(run.memory_bytes);
    statistics.add_time(PassTime {
        pass: "shadows",
        ms: run.gpu_ms(),
    });
}
