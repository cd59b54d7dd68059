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
    pub(crate) const fn new(number: u32, name: &'static str, kind: vk::DescriptorType, count: u32) -> Self {
        Self { number, name, kind, count }
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
    /// Whether sets 0 and 1 show data of a frame.
    pub in_frame: bool,
    /// Bindings that the shader uses, by set and number.
    pub uses: &'static [Use],
    /// Number of bytes of its push constants.
    pub push_bytes: u32,
    /// Number of invocations of a workgroup.
    pub invocations: Invocations,
    /// Whether the shader works by teams, in workgroups of `TEAMS` teams.
    pub by_teams: bool,
}

impl Interface {
    /// Name of the pass to which the shader belongs.
    pub(crate) fn pass(&self) -> &'static str {
        self.parts().0
    }

    /// Stage of the shader.
    pub(crate) fn stage(&self) -> vk::ShaderStageFlags {
        self.parts().1
    }

    fn parts(&self) -> (&'static str, vk::ShaderStageFlags) {
        let drawing = [("_vertex", vk::ShaderStageFlags::VERTEX), ("_fragment", vk::ShaderStageFlags::FRAGMENT)];
        drawing
            .into_iter()
            .find_map(|(suffix, stage)| Some((self.name.strip_suffix(suffix)?, stage)))
            .unwrap_or((self.name, vk::ShaderStageFlags::COMPUTE))
    }
}

/// Specialisation constants of a shader.
pub trait Specialized {
    /// Push constants of the shader; `()` if it has none.
    type Push: bytemuck::NoUninit;

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
