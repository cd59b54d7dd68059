//! How colours are made, which the shaders of an image agree on.

/// The specialisation constants of `shaders/include/color.glsl`, and of `shaders/include/texture.glsl` and
/// `shaders/include/tint.glsl` what is the same for all materials of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColorConstants {
    /// Whether colours of the image are tone-mapped.
    pub tonemap: bool,
    /// Whether detection compares tone-mapped colours.
    pub tonemap_codes: bool,
    /// Whether textures are filtered over all of what a place stands for, along both axes.
    pub box_filter: bool,
    /// Whether a triangle lets light through by other shares than its opacity.
    pub tinted: bool,
}
