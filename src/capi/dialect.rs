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
        use Member as M;
        const GEOMETRY: &str = "GpcGeometry";
        const ALPHA_MAP: &str = "GpcAlphaMap";
        const INDIRECT: &str = "GpcIndirectDraws";
        const DRAW: &str = "GpcDraw";
        const KINDS: &str = "GpcImageKinds";
        const IMAGES: &str = "GpcImages";
        const OPTIONS: &str = "GpcOptions";
        const SCENERY: &str = "GpcScenery";
        const LIST: &str = "GpcLocationList";
        match member {
            M::Meshes => (GEOMETRY, "more_meshes"),
            M::MeshCount => (GEOMETRY, "more_mesh_count"),
            M::PositionCapacity => (GEOMETRY, "position_capacity"),
            M::AlphaMaps => (GEOMETRY, "alpha_maps"),
            M::AlphaMapCount => (GEOMETRY, "alpha_map_count"),
            M::Blended => (GEOMETRY, "blended"),
            M::Indirect => (GEOMETRY, "indirect_draws"),
            M::TriangleCapacity => (GEOMETRY, "triangle_capacity"),
            M::DrawCapacity => (GEOMETRY, "draw_capacity"),
            M::Keys => (GEOMETRY, "keys"),
            M::YUp => (GEOMETRY, "y_up"),
            M::DepthRange => (GEOMETRY, "min_depth and max_depth"),

            M::Positions => (self.mesh, "positions"),
            M::PositionsOffset => (self.mesh, "positions_offset"),
            M::PositionStride => (self.mesh, "position_stride"),
            M::PositionFormat => (self.mesh, "position_format"),
            M::VertexCapacity | M::AllVertices => (self.mesh, "vertex_capacity"),
            M::Indices => (self.mesh, "indices"),
            M::IndicesOffset => (self.mesh, "indices_offset"),
            M::IndexType | M::NoIndices => (self.mesh, "index_type"),
            M::IndexCapacity => (self.mesh, "index_capacity"),
            M::Coordinates => (self.mesh, "coordinates"),
            M::CoordinatesOffset => (self.mesh, "coordinates_offset"),
            M::CoordinatesStride => (self.mesh, "coordinates_stride"),
            M::CoordinatesFormat => (self.mesh, "coordinates_format"),

            M::AlphaView => (ALPHA_MAP, "view"),
            M::AlphaWidth => (ALPHA_MAP, "width"),
            M::AlphaHeight => (ALPHA_MAP, "height"),
            M::AlphaLevels => (ALPHA_MAP, "levels"),
            M::MagFilter => (ALPHA_MAP, "mag_filter"),
            M::MinFilter => (ALPHA_MAP, "min_filter"),
            M::MipmapMode => (ALPHA_MAP, "mipmap_mode"),
            M::Address => (ALPHA_MAP, "address_u or address_v"),
            M::Cutoff => (ALPHA_MAP, "cutoff"),

            M::Commands => (INDIRECT, "commands"),
            M::CommandsOffset => (INDIRECT, "commands_offset"),
            M::CommandStride => (INDIRECT, "command_stride"),
            M::CommandCapacity => (INDIRECT, "command_capacity"),
            M::Count => (INDIRECT, "count"),
            M::CountOffset => (INDIRECT, "count_offset"),
            M::Instances => (INDIRECT, "instances"),
            M::InstancesOffset => (INDIRECT, "instances_offset"),
            M::InstanceCapacity => (INDIRECT, "instance_capacity"),
            M::IndirectDrawCapacity => (INDIRECT, "draw_capacity"),
            M::IndirectTriangleCapacity => (INDIRECT, "triangle_capacity"),
            M::IndirectPositionCapacity => (INDIRECT, "position_capacity"),
            M::IndirectMesh => (INDIRECT, "mesh"),
            M::IndirectFrontFace => (INDIRECT, "front_face"),

            M::DrawMesh => (DRAW, "mesh"),
            M::DrawKey => (DRAW, "key"),
            M::DrawFrontFace => (DRAW, "front_face"),
            M::DrawAlphaMap => (DRAW, "alpha_map"),
            M::ToClip => (DRAW, "to_clip"),

            M::KindIds => (KINDS, "ids"),
            M::KindDepth => (KINDS, "depth"),
            M::ColorFormat => (KINDS, "color_format"),
            M::ColorEncoded => (KINDS, "color_encoded"),
            M::Ids => (IMAGES, "ids"),
            M::Depth => (IMAGES, "depth"),
            M::Color => (IMAGES, "color"),
            M::Corner => (IMAGES, "corner"),

            M::Size => (OPTIONS, "width x height"),
            M::Samples => (OPTIONS, "samples"),
            M::Pattern => (OPTIONS, "pattern"),
            M::Background => (OPTIONS, "background"),
            M::FlatBackground => (OPTIONS, "flat_background"),
            M::ShadeAll => (OPTIONS, "shade_all"),
            M::Thin => (OPTIONS, "thin"),

            M::Viewport => (SCENERY, "viewport"),
            M::Projection => (SCENERY, "projection"),

            M::Locations => (LIST, "locations"),
            M::LocationsOffset => (LIST, "offset"),
            M::LocationCapacity => (LIST, "capacity"),
            M::Colors => (LIST, "colors"),
            M::ColorsOffset => (LIST, "colors_offset"),
        }
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
