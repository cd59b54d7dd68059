//! A renderer on Vulkan that antialiases only where an image aliases.
//!
//! The feature `cli`, on by default, has what the command needs: image files ([`output`]), comparisons ([`compare`](mod@compare)) and resampling ([`resample`]).
//! `gltf` alone has scenes, cameras and rendering in a host's device or one of its own. What is left without either is the
//! engine for a host's own scene and materials ([`host`]), which knows no files; `capi` adds its functions in C.

#![warn(missing_docs)]
// The engine has what scenes of files need, too.
#![cfg_attr(not(feature = "gltf"), allow(dead_code))]

#[cfg(feature = "capi")]
mod capi;
mod engine;
#[cfg(feature = "gltf")]
mod random;
pub mod reference;
#[cfg(feature = "gltf")]
pub mod render;
#[cfg(feature = "gltf")]
#[doc(hidden)]
pub mod testing;
#[cfg(feature = "cli")]
mod tools;

use engine::passes;
pub use engine::{color, host, sampling, vulkan};
#[cfg(feature = "gltf")]
pub use render::{camera, scene};
#[cfg(feature = "cli")]
pub use tools::{compare, names, output, resample};

/// What `gpc bench` and tests measure with: no part of the library's interface, and changes without notice.
#[cfg(feature = "cli")]
#[doc(hidden)]
pub use tools::bench;

/// Compiles the library's example in the README.
#[cfg(all(doctest, feature = "gltf"))]
#[doc = include_str!("../README.md")]
struct Readme;
