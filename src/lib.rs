//! A renderer on Vulkan that antialiases only where an image aliases.
//!
//! The feature `cli`, on by default, has what the command needs: image files ([`output`]), comparisons and benchmarks.
//! `gltf` alone has scenes, cameras and rendering in a host's device or one of its own. Without either there are the
//! [`vulkan`] layer and [`sampling`] patterns.

#![warn(missing_docs)]

#[cfg(feature = "cli")]
pub mod bench;
#[cfg(feature = "gltf")]
pub mod camera;
#[cfg(feature = "cli")]
pub mod compare;
#[cfg(feature = "cli")]
pub mod output;
#[cfg(feature = "gltf")]
pub mod passes;
#[cfg(feature = "gltf")]
mod random;
#[cfg(feature = "gltf")]
pub mod reference;
#[cfg(feature = "gltf")]
pub mod render;
#[cfg(feature = "cli")]
pub mod resample;
pub mod sampling;
#[cfg(feature = "gltf")]
pub mod scene;
pub mod vulkan;

/// Compiles the library's example in the README.
#[cfg(all(doctest, feature = "gltf"))]
#[doc = include_str!("../README.md")]
struct Readme;
