//! Exact shadows. The points that locations see, sub-samples of superpixels included, are projected on the image plane of
//! each light, where they are a sampling set without any pattern. Sampling it tells which of them another triangle lies
//! before: no map of depths is made, and there is nothing of one to alias.
//!
//! A point is in shadow where a triangle other than its own, opaque or passing its alpha test, lies nearer to the light
//! by more than 2^-17 of its distance (of the scene's depth for a distant light); and where its own triangle turns the
//! side that is seen from the light, whatever its interpolated normals say, so that the border of light on a smooth ball
//! of few triangles follows its edges. BLEND triangles neither cast shadows nor receive them.
//!
//! The host stands between the steps: it is given the visibility samples of a run, projects the places at which they
//! are shaded, asks for each light, and hands a word of bits for each record back to the run, which shades them.

mod casters;
mod light;
mod receivers;

pub(in crate::render) use casters::Casters;
pub(super) use receivers::Receivers;

use super::Task;
use super::partition::Partition;
use crate::camera::{Camera, Pinhole, SampleLocation};
use crate::passes::Cells;
use crate::render::{
    Headless, PassTime, PreparedScene, RenderError, Rendered, Settings, Statistics,
};
use crate::scene::{Pose, Scene};
use casters::caster_scene;
use light::{LightView, Sight};

/// Most lights that cast shadows: bits of a record's word.
const MOST_LIGHTS: usize = 32;

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

    /// Renders what a camera sees, with the shadows that the settings ask for: [`Headless::render_locations`] with the centres
    /// of an image's pixels.
    ///
    /// # Errors
    /// [`RenderError::Pinhole`] if the size is 0 or the camera is impossible; otherwise as [`Headless::render_locations`].
    pub fn render_with_shadows(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
    ) -> Result<Rendered, RenderError> {
        settings.check(self.gpu().limits())?;
        let size = settings.size;
        let pinhole = Pinhole::from_camera(camera, size)?;
        let location = |(row, column): (u32, u32)| SampleLocation {
            uv: [column, row].map(|pixel| f64::from(pixel) + 0.5),
            jacobian: [[1.0, 0.0], [0.0, 1.0]],
            output: row * size[0] + column,
        };
        let pixels = (0..size[1]).flat_map(|row| (0..size[0]).map(move |column| (row, column)));
        let locations = pixels.map(location).collect();
        self.render_locations(scene, &[(pinhole, locations)], size, settings)
    }

    /// A word for each record of a run: a bit for each light that it lies in the shadow of.
    pub(super) fn shadows(
        &mut self,
        run: &Receivers<'_>,
        settings: &Settings,
        statistics: &mut Statistics,
    ) -> Result<Vec<u32>, RenderError> {
        let scene = run.scene;
        let casters = scene.casters.as_deref().ok_or(RenderError::NoCasters)?;
        let mut shadows = vec![0; run.records.len()];
        let Some(bounds) = casters.bounds.filter(|_| !casters.lights.is_empty()) else {
            return Ok(shadows);
        };
        let receivers = run.receivers();
        if receivers.is_empty() {
            return Ok(shadows);
        }
        let own = scene.memory_bytes() - casters.memory_bytes() + run.held_bytes;
        let settings = Settings {
            max_memory: settings.max_memory.map(|most| most.saturating_sub(own)),
            ..settings.clone()
        };
        for (bit, light) in casters.lights.iter().enumerate() {
            let (pinholes, sights) = light::sights(light, bounds, &receivers)?;
            for (receiver, sight) in receivers.iter().zip(&sights) {
                if *sight == Sight::Turned {
                    shadows[receiver.index] |= 1 << bit;
                }
            }
            for (number, pinhole) in pinholes.into_iter().enumerate() {
                let view = LightView::new(pinhole, number, &receivers, &sights);
                if view.locations.is_empty() {
                    continue;
                }
                let partition = Partition::new(&view.locations, Cells::Occluders)?;
                let task = Task {
                    scene: &casters.scene,
                    pinhole: &view.pinhole,
                    shadows: false,
                    rest: Some(&|location| view.surface(location)),
                };
                let run = self.run_locations(&partition, task, &settings, |run| {
                    for record in run.seen.records.iter().filter(|record| record.id() != 0) {
                        let location = partition.index(run.places.start + record.location());
                        shadows[view.indices[location]] |= 1 << bit;
                    }
                })?;
                book(statistics, &run);
            }
        }
        Ok(shadows)
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
