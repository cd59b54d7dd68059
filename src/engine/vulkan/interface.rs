//! What shaders say of their interface.

use super::Constants;
use ash::vk;

/// What a set shows in one place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Binding {
    /// Its number in the set.
    pub number: u32,
    /// Its name in the shaders.
    pub name: &'static str,
    /// How it is shown.
    pub kind: vk::DescriptorType,
    /// Elements of an array of descriptors.
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

/// What a shader does with what is bound, whatever its constants are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// Nothing but reading it.
    Read,
    /// Nothing but writing it.
    Write,
    /// Both.
    ReadWrite,
}

/// A binding that a shader uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Use {
    /// The number of its set.
    pub set: u32,
    /// The binding.
    pub binding: Binding,
    /// What is done with it.
    pub access: Access,
}

/// How many invocations a workgroup has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Invocations {
    /// So many.
    Fixed(u32),
    /// As many as a specialisation constant says.
    Constant,
    /// The shader is one of a graphics pipeline.
    Drawn,
}

/// What a shader uses, all its variants together.
#[derive(Debug, PartialEq, Eq)]
pub struct Interface {
    /// Its name: that of its file, and of its stage where it is drawn with.
    pub name: &'static str,
    /// The bindings that it uses, by set and number.
    pub uses: &'static [Use],
    /// Bytes that are pushed to it.
    pub push_bytes: u32,
    /// Invocations of a workgroup.
    pub invocations: Invocations,
}

/// The specialisation constants of a shader.
pub trait Specialized {
    /// The shader's interface.
    const INTERFACE: &'static Interface;

    /// The constants by their IDs.
    fn constants(&self) -> Constants;
}

/// The same of a shader that is compiled once.
pub trait Compiled: Specialized {
    /// Its SPIR-V.
    fn code() -> &'static [u8];
}
