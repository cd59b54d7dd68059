//! Colours and colour transforms in the form that shaders take.

use super::footprint::TextureFilter;
use super::{Reference, SamplerSettings};
use crate::color::{srgb, tonemap};
use crate::engine::data::{ColorConstants, Content};

impl SamplerSettings {
    /// Background as linear, premultiplied RGBA.
    pub(crate) fn background_rgba(&self) -> [f32; 4] {
        self.background.map_or([0.0; 4], |[r, g, b]| [r, g, b, 1.0])
    }

    /// Whether the image's colours are tone-mapped.
    pub(crate) fn tonemaps(&self) -> bool {
        self.reference == Reference::Display
    }

    /// Whether detection compares tone-mapped colours.
    fn tonemaps_codes(&self) -> bool {
        match self.reference {
            Reference::Display => true,
            Reference::Scene { tonemapped_detection } => tonemapped_detection,
        }
    }

    /// Constants of `shaders/include/color.glsl` for the scene and these settings.
    pub(crate) fn color_constants(&self, scene: &dyn Content) -> ColorConstants {
        ColorConstants {
            tonemap: self.tonemaps(),
            tonemap_codes: self.tonemaps_codes(),
            box_filter: self.filter == TextureFilter::Boxes,
            tinted: scene.is_tinted(),
        }
    }
}

/// Code of a colour that detection compares, packed like `display_code` of `shaders/include/color.glsl`.
pub(crate) fn display_code(color: [f32; 4]) -> u32 {
    let [r, g, b, a] = color.map(f64::from);
    let rgb = [r, g, b].map(srgb::encode_u8);
    let alpha = (a.clamp(0.0, 1.0) * 255.0).round() as u8;
    u32::from_le_bytes([rgb[0], rgb[1], rgb[2], alpha])
}

impl SamplerSettings {
    /// Display code of an output colour, which detection compares; equal to `display_code` of the shaders.
    /// Scene-referred colours are tone-mapped first.
    pub(crate) fn output_code(&self, color: [f32; 4]) -> u32 {
        if self.tonemaps() || !self.tonemaps_codes() {
            return display_code(color);
        }
        let alpha = f64::from(color[3]);
        let opaque = color.map(|channel| f64::from(channel) / alpha.max(1e-6));
        let [r, g, b] = tonemap::neutral([opaque[0], opaque[1], opaque[2]]).map(|channel| (channel * alpha) as f32);
        display_code([r, g, b, color[3]])
    }
}
