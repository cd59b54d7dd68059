//! Constants of the transform from radiance to colours, the same for all shaders of an image.

/// Specialisation constants of `shaders/include/color.glsl`, and those of `shaders/include/texture.glsl` and
/// `shaders/include/tint.glsl` that are the same for all materials of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColorConstants {
    /// Whether the image's colours are tone-mapped.
    pub tonemap: bool,
    /// Whether detection compares tone-mapped colours.
    pub tonemap_codes: bool,
    /// Whether textures are filtered over the whole footprint of a shaded place, along both axes.
    pub box_filter: bool,
    /// Whether the transmittance of any triangle differs from 1 - opacity, for example because the triangle tints
    /// light.
    pub tinted: bool,
}
