//! What casts shadows: the triangles of a pose, from both sides.

use crate::passes::Content;
use crate::render::passes::GpuScene;
use crate::scene::{
    AlphaMode, DrawClass, Image, Light, Material, Moment, Motion, MovingBounds, Pose, Scene,
    TextureUse,
};
use glam::DVec3;
use std::sync::Arc;

/// Casters on the device, and the lights.
pub(in crate::render) struct Casters {
    pub(super) scene: Arc<GpuScene>,
    /// Those of the first pose.
    pub(super) lit: Lit,
    moving: Option<MovingBounds>,
}

/// What lights fall on at a moment.
#[derive(Clone)]
pub(super) struct Lit {
    pub lights: Vec<Light>,
    /// The box around all triangles; nothing where there are none.
    pub bounds: Option<(DVec3, DVec3)>,
}

/// The casters of a pose, as a scene of their own whose triangles have the same IDs: nothing culled, and of the materials
/// what alpha tests and opacities need.
pub(super) fn caster_scene(scene: &Scene, pose: &Pose) -> (Scene, Pose) {
    let materials: Vec<Material> = pose.materials(scene).iter().map(casting).collect();
    let used = |index: u32| {
        let images = materials.iter().filter_map(|m| m.base_color_texture);
        let texture = |used: TextureUse| scene.textures.get(used.texture as usize);
        images.filter_map(texture).any(|t| t.image == index)
    };
    let image = |(index, image): (usize, &Image)| match used(index as u32) {
        true => image.clone(),
        false => Image {
            width: 1,
            height: 1,
            pixels: vec![255; 4],
        },
    };
    let images = scene.images.iter().enumerate().map(image).collect();
    let mut geometry = pose.geometry.flat().into_owned();
    for draw in &mut geometry.draws {
        draw.class = seen_from_both_sides(draw.class);
    }
    // A size in pixels is none that a light could see.
    geometry.strokes.clear();
    geometry.edges.clear();
    let mut casting = Scene::from_materials(materials);
    casting.images = images;
    casting.textures = scene.textures.clone();
    let pose = Pose {
        geometry,
        materials: Vec::new(),
        lights: pose.lights.clone(),
        environment: None,
        cameras: Vec::new(),
        warnings: Vec::new(),
    };
    (casting, pose)
}

/// Of a material what its shadow needs.
fn casting(material: &Material) -> Material {
    let opaque = Material {
        alpha_mode: material.alpha_mode,
        unlit: true,
        ..Material::default()
    };
    match material.alpha_mode {
        AlphaMode::Mask { .. } | AlphaMode::Blend => Material {
            base_color: material.base_color,
            base_color_texture: material.base_color_texture,
            ..opaque
        },
        AlphaMode::Opaque => opaque,
    }
}

/// A moment, with what shadows need of materials.
pub(super) fn caster_moment(moment: &Moment) -> Moment {
    let changed = moment.materials.iter();
    Moment {
        materials: changed
            .map(|(index, material)| (*index, casting(material)))
            .collect(),
        ..moment.clone()
    }
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
            lit: Lit {
                lights: pose.lights.clone(),
                bounds: pose.geometry.bounds(),
            },
            moving: motion.map(|motion| MovingBounds::new(&pose.geometry, motion)),
        }
    }

    /// What lights fall on at a moment.
    pub(super) fn at(&self, moment: &Moment) -> Lit {
        Lit {
            lights: moment.lights.clone(),
            bounds: match &self.moving {
                Some(moving) => moving.at(moment),
                None => self.lit.bounds,
            },
        }
    }

    /// What casts, on the device.
    pub(in crate::render) fn scene(&self) -> &GpuScene {
        &self.scene
    }

    /// Words of each place that say which lights reach it: see `shaders/include/shadows.glsl`.
    pub(in crate::render) fn shadow_words(&self) -> u32 {
        match self.scene.has_blend() {
            true => 1 + self.lit.lights.len() as u32,
            false => 1,
        }
    }

    /// Bytes of device memory that they take.
    pub(in crate::render) fn memory_bytes(&self) -> u64 {
        self.scene.memory_bytes()
    }
}
