//! Texture slots of a material: textures that are read in the same way share a slot, and are read once.

use crate::engine::spirv::shade_set;
use crate::scene::{Material, Scene, TextureRole, TextureUse};
use crate::vulkan::VulkanError;

/// Largest number of distinct textures of a material. Together with the environment map, these need 16 samplers, as
/// many as every Vulkan device supports.
pub(super) const SLOTS: usize = shade_set::TEXTURES.count as usize;

/// Slots of a material; the base colour has the first.
#[derive(Clone)]
pub(super) struct Slots {
    /// Slot of each role, by the role's number.
    pub(super) of_role: [Option<u8>; TextureRole::COUNT],
    /// Texture of each slot, and whether it is in sRGB.
    pub(super) uses: Vec<(TextureUse, bool)>,
    /// Whether all textures have the same width and height.
    pub(super) one_size: bool,
    is_animated: bool,
}

impl Slots {
    /// Slots of a material. An unlit material has a slot for its base colour only; textures that the scene lacks get
    /// none.
    pub(super) fn of(scene: &Scene, material: &Material) -> Result<Self, VulkanError> {
        let mut slots = Self {
            of_role: [None; TextureRole::COUNT],
            uses: Vec::new(),
            one_size: false,
            is_animated: material.animated,
        };
        let wanted = |role| role == TextureRole::BaseColor || !material.unlit;
        let image = |used: &TextureUse| {
            let texture = scene.textures.get(used.texture as usize)?;
            scene.images.get(texture.image as usize)
        };
        for (role, used) in material.textures() {
            if !wanted(role) || image(&used).is_none() {
                continue;
            }
            let read = (used, role.is_srgb());
            // Animated textures don't share a slot, because their transforms may change differently.
            let shared = slots.uses.iter().position(|known| *known == read);
            let slot = shared.filter(|_| !material.animated);
            slots.of_role[role as usize] = Some(slot.unwrap_or(slots.uses.len()) as u8);
            if slot.is_none() {
                slots.uses.push(read);
            }
        }
        VulkanError::check_limit("a material", slots.uses.len() as u64, "textures", SLOTS as u64)?;
        let mut sizes =
            (slots.uses.iter().filter_map(|(used, _)| image(used))).map(|image| [image.width, image.height]);
        let first = sizes.next();
        slots.one_size = sizes.all(|size| Some(size) == first);
        Ok(slots)
    }

    /// Whether all textures are read at the same coordinates.
    pub(super) fn one_uv_transform(&self) -> bool {
        let mut places = self.uses.iter().map(|(used, _)| (used.uv_set, used.transform));
        let first = places.next();
        places.all(|place| Some(place) == first && !self.is_animated)
    }
}
