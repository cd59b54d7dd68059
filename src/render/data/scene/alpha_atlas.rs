//! Alpha channels for the alpha test, in one buffer.

use super::mipmaps::halve;
use crate::engine::data::alpha_flags::{
    CLAMP_TO_EDGE, MIRRORED_REPEAT, NEAREST_MAG, NEAREST_MIN, NEAREST_MIP, NO_MIP, REPEAT, TEXTURED, beyond,
};
use crate::scene::{AlphaMode, Filter, Material, Sampler, Scene, Wrap};

/// Materials whose alpha passes read from the atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AlphaUse {
    /// MASK materials: their alpha is tested. Textures have the opacities of others.
    Tests,
    /// MASK and BLEND materials, for casters of shadows, which no pass shades.
    Opacities,
}

impl AlphaUse {
    /// Whether passes read the alpha of materials with this mode.
    pub fn reads(self, mode: AlphaMode) -> bool {
        match mode {
            AlphaMode::Opaque => false,
            AlphaMode::Mask { .. } => true,
            AlphaMode::Blend => self == Self::Opacities,
        }
    }
}

/// Alpha channels of the base colour textures of materials that are not opaque, with their mipmaps.
#[derive(Debug)]
pub(super) struct AlphaAtlas {
    pub(super) words: Vec<u32>,
    placed: Vec<(u32, u32, [u32; 4])>,
    of: AlphaUse,
}

impl AlphaAtlas {
    /// Atlas with one untextured entry, for materials without a texture.
    pub(super) fn new(of: AlphaUse) -> Self {
        Self { words: vec![0; 8], placed: Vec::new(), of }
    }

    /// Adds a material's alpha texture, unless the atlas has it already; returns the material's vector `MATERIAL_ALPHA`.
    pub(super) fn place(&mut self, scene: &Scene, material: &Material) -> [u32; 4] {
        let none = [0, 0x1_0001, 1, NO_MIP];
        let Some(used) = material.base_color_texture.filter(|_| self.of.reads(material.alpha_mode)) else {
            return none;
        };
        let Some(texture) = scene.textures.get(used.texture as usize) else {
            return none;
        };
        let Some(image) = scene.images.get(texture.image as usize) else {
            return none;
        };
        let flags = flags(&texture.sampler);
        if let Some((_, _, alpha)) =
            self.placed.iter().find(|(index, known, _)| *index == texture.image && *known == flags)
        {
            return *alpha;
        }
        let table = self.words.len();
        let levels = if flags & NO_MIP == 0 { image.full_levels() } else { 1 };
        self.words.resize(table + levels as usize, 0);
        let mut level = Vec::new();
        for i in 0..levels as usize {
            let size = image.level_size(i as u32);
            level = match image.levels().nth(i) {
                Some(given) => alpha_channel(given),
                None => halve::<1>(&level, image.level_size((i as u32).saturating_sub(1)), false),
            };
            self.words[table + i] = self.words.len() as u32;
            self.push(&level, size, &texture.sampler);
        }
        let alpha = [table as u32, image.width | image.height << 16, levels, flags];
        self.placed.push((texture.image, flags, alpha));
        alpha
    }

    /// Appends a level in words of 2 x 2 texels. The words of the first and last row and column extend one texel beyond
    /// the image.
    fn push(&mut self, level: &[u8], [width, height]: [u32; 2], sampler: &Sampler) {
        let texel = |x: i64, y: i64| {
            let (x, y) = (wrap(x, width, sampler.wrap_u), wrap(y, height, sampler.wrap_v));
            u32::from(level[y * width as usize + x])
        };
        for y in -1..i64::from(height) {
            for x in -1..i64::from(width) {
                self.words.push(texel(x, y) | texel(x + 1, y) << 8 | texel(x, y + 1) << 16 | texel(x + 1, y + 1) << 24);
            }
        }
    }
}

fn flags(sampler: &Sampler) -> u32 {
    let mode = |wrap| match wrap {
        Wrap::Repeat => REPEAT,
        Wrap::MirroredRepeat => MIRRORED_REPEAT,
        Wrap::ClampToEdge => CLAMP_TO_EDGE,
    };
    TEXTURED
        | if sampler.mag == Filter::Nearest { NEAREST_MAG } else { 0 }
        | if sampler.min == Filter::Nearest { NEAREST_MIN } else { 0 }
        | match sampler.mip {
            None => NO_MIP,
            Some(Filter::Nearest) => NEAREST_MIP,
            Some(Filter::Linear) => 0,
        }
        | beyond([mode(sampler.wrap_u), mode(sampler.wrap_v)])
}

/// Index of the texel for a coordinate up to one texel outside of the image.
fn wrap(i: i64, size: u32, mode: Wrap) -> usize {
    let size = i64::from(size);
    let inside = match mode {
        Wrap::Repeat => i.rem_euclid(size),
        Wrap::MirroredRepeat | Wrap::ClampToEdge => i.clamp(0, size - 1),
    };
    inside as usize
}

fn alpha_channel(texels: &[u8]) -> Vec<u8> {
    texels.chunks_exact(4).map(|texel| texel[3]).collect()
}
