//! A renderer on Vulkan that antialiases only where an image aliases.

#![warn(missing_docs)]

pub mod scene;
