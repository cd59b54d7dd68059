//! Interfaces of shaders.

use super::Constants;
use ash::vk;

/// Binding of a descriptor set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Binding {
    /// Number of the binding in its set.
    pub number: u32,
    /// Name of the binding in the shaders.
    pub name: &'static str,
    /// Type of the descriptors.
    pub kind: vk::DescriptorType,
    /// Number of descriptors; more than 1 for an array.
    pub count: u32,
}

impl Binding {
    pub(crate) const fn new(
        number: u32,
        name: &'static str,
        kind: vk::DescriptorType,
        count: u32,
    ) -> Self {
        Self {
            number,
            name,
            kind,
            count,
        }
    }
}

/// Access of a shader to a binding, for any values of its constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// Reads only.
    Read,
    /// Writes only.
    Write,
    /// Reads and writes.
    ReadWrite,
}

/// Use of a binding by a shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Use {
    /// Number of the set.
    pub set: u32,
    /// The binding.
    pub binding: Binding,
    /// Access to the binding.
    pub access: Access,
}

/// Number of invocations of a workgroup.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Invocations {
    /// A fixed number.
    Fixed(u32),
    /// Value of a specialisation constant.
    Constant,
    /// None: the shader belongs to a graphics pipeline.
    Drawn,
}

/// Interface of a shader over all of its variants.
#[derive(Debug, PartialEq, Eq)]
pub struct Interface {
    /// Name of the shader's file, with its stage for shaders that draw.
    pub name: &'static str,
    /// Bindings that the shader uses, by set and number.
    pub uses: &'static [Use],
    /// Number of bytes of its push constants.
    pub push_bytes: u32,
    /// Number of invocations of a workgroup.
    pub invocations: Invocations,
}

/// Specialisation constants of a shader.
pub trait Specialized {
    /// Interface of the shader.
    const INTERFACE: &'static Interface;

    /// Values of the constants by ID.
    fn constants(&self) -> Constants;
}

/// Specialisation constants of a shader with a single compiled variant.
pub trait Compiled: Specialized {
    /// SPIR-V of the shader.
    fn code() -> &'static [u8];
}
