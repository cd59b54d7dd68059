//! What casts shadows: the opaque and MASK triangles of a pose, from both sides.

use crate::camera::{Pinhole, Site};
use crate::render::PreparedScene;
use crate::scene::{
    AlphaMode, Draw, DrawClass, Geometry, Image, Light, Material, Pose, Scene, TextureUse,
};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Casters on the device and, to find the world positions of what sites see, on the host.
pub(in crate::render) struct Casters {
    pub(super) scene: PreparedScene,
    pub(super) lights: Vec<Light>,
    /// The box around all triangles; nothing where there are none.
    pub(super) bounds: Option<(DVec3, DVec3)>,
    geometry: Geometry,
}

/// A point of a triangle that a site sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Receiver {
    /// The site's place in the caller's list.
    pub index: usize,
    /// ID of the triangle.
    pub id: u32,
    /// Where it is in the world.
    pub position: DVec3,
}

/// The casters of a pose, as a scene of their own whose triangles have the same IDs: no BLEND triangles, nothing culled,
/// and of the materials what alpha tests need.
pub(super) fn caster_scene(scene: &Scene, pose: &Pose) -> (Scene, Pose) {
    let material = |material: &Material| {
        let opaque = Material {
            alpha_mode: material.alpha_mode,
            unlit: true,
            ..Material::default()
        };
        match material.alpha_mode {
            AlphaMode::Mask { .. } => Material {
                base_color: material.base_color,
                base_color_texture: material.base_color_texture,
                ..opaque
            },
            AlphaMode::Opaque | AlphaMode::Blend => opaque,
        }
    };
    let materials: Vec<Material> = scene.materials.iter().map(material).collect();
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
    let draws: Vec<Draw> = pose.geometry.draws.iter().filter_map(caster).collect();
    let count = draws.iter().map(|draw| draw.triangle_count as usize).sum();
    let mut geometry = pose.geometry.clone();
    geometry.triangles.truncate(count);
    geometry.draws = draws;
    let mut casting = Scene::from_materials(materials);
    casting.images = images;
    casting.textures = scene.textures.clone();
    let pose = Pose {
        geometry,
        lights: pose.lights.clone(),
        cameras: Vec::new(),
        warnings: Vec::new(),
    };
    (casting, pose)
}

/// A draw seen from both sides; BLEND, which comes last, casts no shadow.
fn caster(draw: &Draw) -> Option<Draw> {
    let class = match draw.class {
        DrawClass::Opaque | DrawClass::OpaqueDoubleSided => DrawClass::OpaqueDoubleSided,
        DrawClass::Mask | DrawClass::MaskDoubleSided => DrawClass::MaskDoubleSided,
        DrawClass::Blend | DrawClass::BlendDoubleSided => return None,
    };
    Some(Draw { class, ..*draw })
}

impl Casters {
    pub(super) fn new(scene: PreparedScene, pose: Pose) -> Self {
        Self {
            scene,
            bounds: pose.geometry.bounds(),
            lights: pose.lights,
            geometry: pose.geometry,
        }
    }

    /// Bytes of device memory that they take.
    pub(in crate::render) fn memory_bytes(&self) -> u64 {
        self.scene.memory_bytes()
    }

    /// Where sites of a pinhole see triangles of these IDs; those that see none are left out.
    pub(super) fn receivers(
        &self,
        pinhole: &Pinhole,
        sites: &[Site],
        ids: &[u32],
    ) -> Vec<Receiver> {
        let seen = sites.par_iter().zip(ids).enumerate();
        seen.filter_map(|(index, (site, id))| {
            let position = self.seen_at(pinhole, site, *id)?;
            Some(Receiver {
                index,
                id: *id,
                position,
            })
        })
        .collect()
    }

    /// The point of a triangle on a site's ray, or the nearest one that its plane has where the device, which rounds
    /// positions to 32 bits, sees the triangle beside the ray.
    fn seen_at(&self, pinhole: &Pinhole, site: &Site, id: u32) -> Option<DVec3> {
        let triangle = self.geometry.triangles.get(id.checked_sub(1)? as usize)?;
        let corner = |corner: u32| {
            let position = self.geometry.positions.get(corner as usize)?;
            Some(DVec3::from_array(position.map(f64::from)))
        };
        let [a, b, c] = *triangle;
        let [a, b, c] = [corner(a)?, corner(b)?, corner(c)?];
        let ray = pinhole.ray(DVec2::from_array(site.uv));
        let start = ray.start - self.geometry.origin;
        let (ab, ac) = (b - a, c - a);
        let normal = ab.cross(ac);
        let distance = normal.dot(a - start) / normal.dot(ray.direction);
        let ap = start + ray.direction * distance - a;
        let square = normal.length_squared();
        let of_b = ap.cross(ac).dot(normal) / square;
        let of_c = ab.cross(ap).dot(normal) / square;
        let weights = DVec3::new(1.0 - of_b - of_c, of_b, of_c).max(DVec3::ZERO);
        let sum = weights.element_sum();
        // Seen edge-on, any of its points is as near as another.
        let weights = if sum.is_finite() && sum > 0.0 {
            weights / sum
        } else {
            DVec3::splat(1.0 / 3.0)
        };
        Some(self.geometry.origin + a * weights.x + b * weights.y + c * weights.z)
    }
}
