//! What the engine's passes know of a scene, whoever made it.

use ash::vk;

/// Triangles, and what passes read them from.
pub trait Content: Sync {
    /// Number of indices of triangles, or the most there can be; some may stand for none.
    fn index_count(&self) -> u32;

    /// Whether some triangles are drawn several times.
    fn is_instanced(&self) -> bool;

    /// Whether any triangle is alpha-tested.
    fn has_mask(&self) -> bool;

    /// Whether any triangle is composited.
    fn has_blend(&self) -> bool;

    /// Whether a triangle may ask for several shading places in a pixel.
    fn has_high_frequency(&self) -> bool;

    /// Whether most triangles do.
    fn is_mostly_high_frequency(&self) -> bool;

    /// Whether a triangle lets light through by other shares than its opacity.
    fn is_tinted(&self) -> bool;

    /// Number of shading keys, at least 1.
    fn bin_count(&self) -> u32;

    /// The environment map; nothing where surfaces are not shaded by the engine.
    fn environment_map(&self) -> Option<vk::DescriptorImageInfo>;
}
