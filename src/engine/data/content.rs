//! Properties of a scene that the engine's passes need, whatever its source.

/// A scene's triangles, as far as passes depend on them.
pub trait Content: Sync {
    /// Number of triangle slots: every triangle's index is smaller. Some slots may be empty.
    fn triangle_slots(&self) -> u32;

    /// Whether triangles are drawn by instances.
    fn is_instanced(&self) -> bool;

    /// Whether any triangle is alpha-tested.
    fn has_mask(&self) -> bool;

    /// Whether any triangle is composited.
    fn has_blend(&self) -> bool;

    /// Whether any triangle may need several shadings in a pixel.
    fn has_high_frequency(&self) -> bool;

    /// Whether the transmittance of any triangle differs from 1 - opacity.
    fn is_tinted(&self) -> bool;

    /// Number of shading keys, at least 1.
    fn bin_count(&self) -> u32;
}
