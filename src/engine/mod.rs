//! The engine, which is all that hosts need: Vulkan, the passes that antialias triangles, and the interface for an
//! application's own frames.
//!
//! Nothing in this folder depends on a file format, a material, a light or a feature.

/// Methods of an option struct that set one field each, named with what it says, and take and return the struct. With `in`,
/// the struct that has it in a field gets the same methods.
macro_rules! setters {
    ($options:ident in $outer:ident.$within:ident { $($field:ident: $type:ty = $what:literal,)* }) => {
        setters! { $options { $($field: $type = $what,)* } }

        impl $outer {
            $(
                #[doc = concat!("Sets ", $what, ".")]
                #[must_use]
                pub fn $field(mut self, $field: $type) -> Self {
                    self.$within.$field = $field;
                    self
                }
            )*
        }
    };
    ($options:ident { $($field:ident: $type:ty = $what:literal,)* }) => {
        impl $options {
            $(
                #[doc = concat!("Sets ", $what, ".")]
                #[must_use]
                pub fn $field(mut self, $field: $type) -> Self {
                    self.$field = $field;
                    self
                }
            )*
        }
    };
}

pub mod color;
pub(crate) mod data;
pub mod host;
pub(crate) mod passes;
pub(crate) mod pipelines;
pub(crate) mod sampler;
pub mod sampling;
pub mod vulkan;
