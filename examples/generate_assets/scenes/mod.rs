//! The scenes, one file each, and what they are built from.

mod checker;
mod environment;
mod fence;
mod foliage;
mod glass;
mod glb;
mod glyphs;
mod letters;
mod lobes;
mod mesh;
mod picture;
mod pointer;
mod spheres;
mod variants;

/// Builds the bytes of a `.glb` file.
type Build = fn() -> Vec<u8>;

/// File name and builder of every scene.
pub const ALL: [(&str, Build); 18] = [
    ("anisotropy.glb", lobes::anisotropy),
    ("checker.glb", checker::build),
    ("clearcoat.glb", lobes::clearcoat),
    ("diffuse_transmission.glb", lobes::diffuse_transmission),
    ("environment.glb", environment::build),
    ("fence.glb", fence::build),
    ("foliage.glb", foliage::build),
    ("glass.glb", glass::build),
    ("ior.glb", lobes::ior),
    ("iridescence.glb", lobes::iridescence),
    ("letters.glb", letters::build),
    ("pointer.glb", pointer::build),
    ("sheen.glb", lobes::sheen),
    ("specular.glb", lobes::specular),
    ("specular_glossiness.glb", lobes::specular_glossiness),
    ("spheres.glb", spheres::build),
    ("transmission.glb", lobes::transmission),
    ("variants.glb", variants::build),
];
