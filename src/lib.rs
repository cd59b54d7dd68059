//! A renderer on Vulkan that antialiases only where an image aliases.

#![warn(missing_docs)]

pub mod bench;
pub mod camera;
pub mod compare;
pub mod output;
pub mod passes;
mod random;
pub mod reference;
pub mod render;
pub mod resample;
pub mod sampling;
pub mod scene;
pub mod vulkan;

/// Compiles the library's example in the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
