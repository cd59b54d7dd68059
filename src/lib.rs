//! A renderer on Vulkan that antialiases only where an image aliases.

#![warn(missing_docs)]

pub mod reference;
pub mod sampling;
pub mod scene;
