//! Casters of shadows: the triangles of a pose, visible from both sides.

use crate::engine::data::Content;
use crate::render::data::GpuScene;
use crate::scene::{
    AlphaMode, DrawClass, Image, Light, Material, Moment, Motion, MovingBounds, Pose, Scene, TextureUse,
};
use glam::DVec3;
use std::sync::Arc;

/// Casters of shadows in device memory, and the lights.
pub(in crate::render) struct Casters {
    pub(super) scene: Arc<GpuScene>,
    /// Lights and bounds of the first pose.
    pub(super) lit: Lit,
    moving: Option<MovingBounds>,
}

/// Lights, and the box that they light, at a moment.
#[derive(Clone)]
pub(super) struct Lit {
    pub lights: Vec<Light>,
    /// Lowest and highest corner of the box around all triangles; `None` without triangles.
    pub bounds: Option<(DVec3, DVec3)>,
}

/// The casters of a pose as a separate scene, whose triangles have the same IDs. Nothing is culled, and materials keep
/// only what alpha tests and opacities need.
pub(super) fn caster_scene(scene: &Scene, pose: &Pose) -> (Scene, Pose) {
    let materials: Vec<Material> = pose.materials(scene).iter().map(casting).collect();
    let used = |index: u32| {
        let images = materials.iter().filter_map(|m| m.base_color_texture);
        let texture = |used: TextureUse| scene.textures.get(used.texture as usize);
        images.filter_map(texture).any(|t| t.image == index)
    };
    let image = |(index, image): (usize, &Image)| match used(index as u32) {
        true => image.clone(),
        false => Image { width: 1, height: 1, pixels: vec![255; 4] },
    };
    let images = scene.images.iter().enumerate().map(image).collect();
    let mut geometry = pose.geometry.flat().into_owned();
    for draw in &mut geometry.draws {
        draw.class = seen_from_both_sides(draw.class);
    }
    // Points and lines have a size in pixels, which is undefined for a light.
    geometry.strokes.clear();
    geometry.edges.clear();
    let mut casting = Scene::from_materials(materials);
    casting.images = images;
    casting.textures = scene.textures.clone();
    let pose = Pose { geometry, lights: pose.lights.clone(), ..Pose::default() };
    (casting, pose)
}

/// The part of a material that its shadow needs.
fn casting(material: &Material) -> Material {
    let opaque = Material { alpha_mode: material.alpha_mode, unlit: true, ..Material::default() };
    match material.alpha_mode {
        AlphaMode::Mask { .. } | AlphaMode::Blend => {
            Material { base_color: material.base_color, base_color_texture: material.base_color_texture, ..opaque }
        }
        AlphaMode::Opaque => opaque,
    }
}

/// A moment with the part of its materials that shadows need.
pub(super) fn caster_moment(moment: &Moment) -> Moment {
    let changed = moment.materials.iter();
    Moment { materials: changed.map(|(index, material)| (*index, casting(material))).collect(), ..moment.clone() }
}

fn seen_from_both_sides(class: DrawClass) -> DrawClass {
    match class {
        DrawClass::Opaque | DrawClass::OpaqueDoubleSided => DrawClass::OpaqueDoubleSided,
        DrawClass::Mask | DrawClass::MaskDoubleSided => DrawClass::MaskDoubleSided,
        DrawClass::Blend | DrawClass::BlendDoubleSided => DrawClass::BlendDoubleSided,
    }
}

impl Casters {
    pub(super) fn new(scene: Arc<GpuScene>, pose: &Pose, motion: Option<&Motion>) -> Self {
        Self {
            scene,
            lit: Lit { lights: pose.lights.clone(), bounds: pose.geometry.bounds() },
            moving: motion.map(|motion| MovingBounds::new(&pose.geometry, motion)),
        }
    }

    /// Lights and bounds at a moment.
    pub(super) fn at(&self, moment: &Moment) -> Lit {
        Lit {
            lights: moment.lights.clone(),
            bounds: match &self.moving {
                Some(moving) => moving.at(moment),
                None => self.lit.bounds,
            },
        }
    }

    /// Casters in device memory.
    pub(in crate::render) fn scene(&self) -> &GpuScene {
        &self.scene
    }

    /// Number of words for each place that say which lights reach it: see `shaders/include/shadows.glsl`.
    pub(in crate::render) fn shadow_words(&self) -> u32 {
        match self.scene.has_blend() {
            true => 1 + self.lit.lights.len() as u32,
            false => 1,
        }
    }

    /// Bytes of device memory of the casters.
    pub(in crate::render) fn memory_bytes(&self) -> u64 {
        self.scene.memory_bytes()
    }
}
