//! Names in C of the members that errors of the host interface are about.

use super::error::Error;
use crate::host::{Dialect, EngineError, HostError, Member};
use crate::vulkan::VulkanError;
use std::fmt::Display;

/// The names in C, of members of a `GpcGeometry` or, in one of several meshes, of a `GpcMesh`.
#[derive(Clone, Copy)]
pub(super) struct C {
    mesh: &'static str,
}

impl C {
    pub(super) const GEOMETRY: Self = Self { mesh: "GpcGeometry" };
    const MESH: Self = Self { mesh: "GpcMesh" };

    /// Struct and name of a member.
    pub(super) fn parts(self, member: Member) -> (&'static str, &'static str) {
        let (of, name) = member.in_c();
        (if of == Self::MESH.mesh { self.mesh } else { of }, name)
    }
}

impl Dialect for C {
    // A draw without an alpha map has 0.
    const FIRST_ALPHA_MAP: u32 = 1;

    fn member(self, member: Member) -> impl Display {
        let (of, name) = self.parts(member);
        match member {
            Member::MeshCount => format!("1 + {of}.{name}"),
            Member::AllVertices => format!("the sum of all {name}"),
            Member::NoIndices => format!("{of}.{name} to VK_INDEX_TYPE_NONE_KHR (1000165000)"),
            _ => format!("{of}.{name}"),
        }
    }

    fn flag(self, is_set: bool) -> &'static str {
        if is_set { "VK_TRUE" } else { "VK_FALSE" }
    }

    fn in_mesh(self, mesh: usize, error: &HostError) -> String {
        match mesh {
            0 => error.message(self),
            _ => format!("{}[{}]: {}", self.member(Member::Meshes), mesh - 1, error.message(Self::MESH)),
        }
    }

    fn engine(self, error: &EngineError) -> String {
        match error {
            EngineError::Vulkan(VulkanError::NoFunction(name)) => Error::Function(name).to_string(),
            EngineError::Vulkan(VulkanError::NotEnabled { member, function, remedy }) => {
                format!("GpcDevice.{member} is {} and there is no {function}: {remedy}", self.flag(true))
            }
            EngineError::Vulkan(VulkanError::Pipeline { call, result }) => {
                format!("{call} failed: {result}; was the device created with the features of gpc_require_features?")
            }
            _ => error.to_string(),
        }
    }
}
