//! Constants of the transform from radiance to colours, the same for all shaders of an image.

/// Specialisation constants of `shaders/include/color.glsl`, and those of `shaders/include/texture.glsl` and
/// `shaders/include/tint.glsl` that are the same for all materials of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColorConstants {
    /// Whether the image's colours are tone-mapped.
    pub tonemap: bool,
    /// Whether detection compares tone-mapped colours.
    pub tonemap_codes: bool,
    /// Whether textures are filtered over the area that a shading represents, along both axes.
    pub box_filter: bool,
    /// Whether a triangle transmits another share of light than its opacity leaves, for example a tinted one.
    pub tinted: bool,
}
