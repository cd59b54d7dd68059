//! Exact shadows. The places at which surfaces are shaded, those of every sub-sample of a superpixel included, are projected on
//! the image plane of each light, where they are a sampling set without any pattern: a list of sample locations, which the
//! engine of all lists samples. That tells which of them another triangle lies before: no map of depths is made, and there is
//! nothing of one to alias.
//!
//! A place is in shadow where a triangle other than its own, opaque or passing its alpha test, lies nearer to the light
//! by more than 2^-17 of its distance (of the scene's depth for a distant light); and where its own triangle turns the
//! side that is seen from the light, whatever its interpolated normals say, so that the border of light on a smooth ball
//! of few triangles follows its edges; but not where light from behind shines through it (`KHR_materials_diffuse_transmission`).
//! BLEND triangles keep as much of the light as their opacities say, and each layer of them receives shadows as other surfaces do.
//!
//! Before superpixels are detected, three more places of each pixel are asked. Where a light reaches them otherwise than the
//! centre, the pixel is one: so shadows that are narrower than a pixel are found.
//!
//! ```text
//! shaded next: pixels or records ─▶ receivers ─▶ a list on the light's plane ─▶ distribute ─▶ … ─▶ sample ─▶ shadow ─▶ a word for each
//!                                   └──────────────────────── for each plane of each light ────────────────────────┘      ▼
//!                                                                                                                       shade
//! ```

mod casters;
mod engine;
mod light;

pub(super) use casters::Casters;
pub(super) use engine::{ShadowEngine, Shadowed};
pub(super) use light::{LightView, Rectangle, Sight};

use super::{Headless, PreparedScene, RenderError, Renderer};
use crate::scene::{Motion, Pose, Scene};
use casters::caster_scene;
use std::sync::Arc;

/// Most lights that cast shadows: bits of a word.
const MOST_LIGHTS: usize = 32;

impl Renderer {
    /// Makes a scene ready for [`Shadows::Exact`](super::Shadows::Exact): puts what casts shadows beside it once more, seen from
    /// both sides, for [`PreparedScene::record_upload`] to upload with the rest. `scene` and `pose` are those that `prepared` was
    /// made of; `max_memory` bounds both together, in bytes.
    ///
    /// # Errors
    /// [`RenderError::ShadowLights`] for more than 32 lights; otherwise as [`Renderer::prepare_scene`].
    pub fn prepare_shadows(
        &self,
        prepared: &mut PreparedScene,
        scene: &Scene,
        pose: &Pose,
        max_memory: Option<u64>,
    ) -> Result<(), RenderError> {
        self.prepare_casters(prepared, scene, (pose, None), max_memory)
    }

    /// As [`Self::prepare_shadows`], for a scene that moves: its frames show the shadows of other moments of the motion, too.
    ///
    /// # Errors
    /// As [`Self::prepare_shadows`]; [`RenderError::OtherMotion`] for a pose and motion that were not made together.
    pub fn prepare_shadows_in_motion(
        &self,
        prepared: &mut PreparedScene,
        scene: &Scene,
        (pose, motion): (&Pose, &Motion),
        max_memory: Option<u64>,
    ) -> Result<(), RenderError> {
        if !motion.is_of(pose) {
            return Err(RenderError::OtherMotion);
        }
        self.prepare_casters(prepared, scene, (pose, Some(motion)), max_memory)
    }

    fn prepare_casters(
        &self,
        prepared: &mut PreparedScene,
        scene: &Scene,
        (pose, motion): (&Pose, Option<&Motion>),
        max_memory: Option<u64>,
    ) -> Result<(), RenderError> {
        let found = pose.lights.len();
        if found > MOST_LIGHTS {
            return Err(RenderError::ShadowLights { found });
        }
        prepared.casters = None;
        let left = max_memory.map(|most| most.saturating_sub(prepared.memory_bytes()));
        let (scene, pose) = caster_scene(scene, pose);
        let made = self.prepare_moving(&scene, (&pose, motion), left)?;
        prepared.casters = Some(Arc::new(Casters::new(made.gpu_scene, &pose, motion)));
        prepared.caster_uploads = made.uploads;
        Ok(())
    }
}

impl Headless {
    /// Makes an uploaded scene ready for [`Shadows::Exact`](super::Shadows::Exact), as [`Renderer::prepare_shadows`] does, and puts
    /// what casts shadows on the device.
    ///
    /// # Errors
    /// As [`Renderer::prepare_shadows`].
    pub fn prepare_shadows(
        &mut self,
        prepared: &mut PreparedScene,
        scene: &Scene,
        pose: &Pose,
        max_memory: Option<u64>,
    ) -> Result<(), RenderError> {
        self.renderer
            .prepare_shadows(prepared, scene, pose, max_memory)?;
        self.put(prepared)
    }

    /// As [`Headless::prepare_shadows`], for a scene that moves, as [`Renderer::prepare_shadows_in_motion`] does.
    ///
    /// # Errors
    /// As [`Renderer::prepare_shadows_in_motion`].
    pub fn prepare_shadows_in_motion(
        &mut self,
        prepared: &mut PreparedScene,
        scene: &Scene,
        pose: (&Pose, &Motion),
        max_memory: Option<u64>,
    ) -> Result<(), RenderError> {
        self.renderer
            .prepare_shadows_in_motion(prepared, scene, pose, max_memory)?;
        self.put(prepared)
    }
}
