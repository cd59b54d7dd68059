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
mod finder;
mod light;

pub(super) use casters::Casters;
pub(super) use finder::{ShadowFinder, Shadowed};
pub(super) use light::{LightView, Rectangle, Sight};

use super::{PreparedScene, RenderError, Renderer, SceneRequest, Shadows};
use casters::caster_scene;
use std::sync::Arc;

/// Most lights that cast shadows: bits of a word.
const MOST_LIGHTS: usize = 32;

impl Renderer {
    /// Makes what casts shadows, if shadows are asked for, in what the scene leaves of the memory that both may take.
    pub(super) fn prepare_casters(
        &self,
        prepared: &mut PreparedScene,
        request: SceneRequest<'_>,
    ) -> Result<(), RenderError> {
        let SceneRequest { pose, motion, .. } = request;
        if request.shadows == Shadows::None {
            return Ok(());
        }
        let found = pose.lights.len();
        if found > MOST_LIGHTS {
            return Err(RenderError::ShadowLights { found });
        }
        let used = prepared.memory_bytes();
        let left = request.max_memory.map(|most| most.saturating_sub(used));
        let (scene, caster_pose) = caster_scene(request.scene, pose);
        let made = self.prepare_moving(&scene, (&caster_pose, motion), left)?;
        let casters = Casters::new(made.gpu_scene, &caster_pose, motion);
        prepared.casters = Some(Arc::new(casters));
        prepared.caster_uploads = made.uploads;
        Ok(())
    }
}
