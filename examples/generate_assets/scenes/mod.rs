//! The scenes, one file each, and what they are built from.

mod checker;
mod fence;
mod foliage;
mod glass;
mod glb;
mod glyphs;
mod letters;
mod mesh;
mod picture;
mod spheres;

/// Builds the bytes of a `.glb` file.
type Build = fn() -> Vec<u8>;

/// File name and builder of every scene.
pub const ALL: [(&str, Build); 6] = [
    ("checker.glb", checker::build),
    ("fence.glb", fence::build),
    ("foliage.glb", foliage::build),
    ("glass.glb", glass::build),
    ("letters.glb", letters::build),
    ("spheres.glb", spheres::build),
];
