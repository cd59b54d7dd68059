//! Exact shadows.
//!
//! The places at which surfaces are shaded, including those of every sample of a superpixel, are projected onto the
//! image plane of each light. There they are looked up in lists of the casters of each tile, which finds the triangles that
//! occlude a place. There is no depth map, which could alias.
//!
//! A place is in shadow in two cases. First, if another triangle, opaque or passing its alpha test, is nearer to the
//! light by more than 2^-17 of the distance (of the scene's depth for a distant light). Second, if the visible side of
//! its own triangle is turned away from the light, whatever the interpolated normals say; so the border of light on a
//! smooth ball of few triangles follows their edges. The second case does not apply where light from behind shines
//! through (`KHR_materials_diffuse_transmission`). BLEND triangles absorb light by their opacity, and each of their
//! layers receives shadows as other surfaces do.
//!
//! Three more points of each pixel are tested together with its centre. If a light reaches them differently from the
//! centre, the pixel becomes a superpixel, so that shadows narrower than a pixel are found.
//!
//! ```text
//! casters ─▶ cull ─▶ bin ─▶ tally ─▶ schedule ─▶ setup ─▶ refine ─▶ lists of a plane ─┐
//! shaded next: pixels or fragments ─▶ receivers ─▶ positions ─▶ occlude, for each plane ◀┘ ─▶ words for each ─▶ shade
//! ```

mod casters;
mod finder;
mod light;

pub(super) use casters::Casters;
pub(super) use finder::{ShadowFinder, ShadowRequest, Shadowed};
pub(super) use light::{LightView, Rectangle, Sight};

use crate::render::data::AlphaUse;

use super::{PreparedScene, RenderError, Renderer, SceneRequest, Shadows};
use casters::caster_scene;
use std::sync::Arc;

/// Largest number of lights that cast shadows: the bits of a word.
const MOST_LIGHTS: usize = 32;

impl Renderer {
    /// Prepares the casters, if the request asks for shadows. The memory limit is the request's, less the memory of the
    /// scene.
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
        let made = self.prepare_moving(&scene, &caster_pose, motion, AlphaUse::Opacities, left)?;
        let casters = Casters::new(made.gpu_scene, &caster_pose, motion);
        prepared.casters = Some(Arc::new(casters));
        prepared.caster_uploads = made.uploads;
        Ok(())
    }
}
