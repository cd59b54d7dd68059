//! Members of this interface that errors are about.

use std::fmt::{self, Display, Formatter};

/// Declares the members, each with its name in Rust.
macro_rules! members {
    ($($member:ident = $name:literal,)*) => {
        /// Member of a struct of this interface that an error is about. It is displayed as its name in Rust.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[non_exhaustive]
        pub enum Member {
            $(#[doc = concat!("`", $name, "`.")] $member,)*
        }

        impl Member {
            /// All members.
            #[cfg(all(test, feature = "capi"))]
            pub(crate) const ALL: &[Self] = &[$(Self::$member,)*];
        }

        impl Display for Member {
            fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
                f.write_str(match self {
                    $(Self::$member => $name,)*
                })
            }
        }
    };
}

members! {
    Meshes = "Geometry::meshes",
    MeshCount = "the length of Geometry::meshes",
    PositionCapacity = "the capacity of PositionSpace::Object",
    AlphaMaps = "Geometry::alpha_maps",
    AlphaMapCount = "the length of Geometry::alpha_maps",
    Blended = "Geometry::blended",
    Indirect = "Geometry::indirect",
    TriangleCapacity = "Geometry::triangle_capacity",
    DrawCapacity = "Geometry::draw_capacity",
    Keys = "Geometry::keys",
    YUp = "ClipSpace::y_up",
    DepthRange = "ClipSpace::depth_range",

    Positions = "Mesh::positions",
    PositionsOffset = "Mesh::positions_offset",
    PositionStride = "Mesh::position_stride",
    PositionFormat = "Mesh::position_format",
    VertexCapacity = "Mesh::vertex_capacity",
    AllVertices = "the sum of all Mesh::vertex_capacity",
    Indices = "Indices::buffer",
    NoIndices = "Mesh::indices to None",
    IndicesOffset = "Indices::offset",
    IndexType = "Indices::index_type",
    IndexCapacity = "Indices::capacity",
    Coordinates = "Mesh::coordinates",
    CoordinatesOffset = "Coordinates::offset",
    CoordinatesStride = "Coordinates::stride",
    CoordinatesFormat = "Coordinates::format",

    AlphaView = "AlphaMap::view",
    AlphaWidth = "AlphaMap::size[0]",
    AlphaHeight = "AlphaMap::size[1]",
    AlphaLevels = "AlphaMap::levels",
    MagFilter = "AlphaMap::mag_filter",
    MinFilter = "AlphaMap::min_filter",
    MipmapMode = "AlphaMap::mipmap_mode",
    Address = "AlphaMap::address",
    Cutoff = "AlphaMap::cutoff",

    Commands = "IndirectDraws::commands",
    CommandsOffset = "IndirectDraws::commands_offset",
    CommandStride = "IndirectDraws::command_stride",
    CommandCapacity = "IndirectDraws::command_capacity",
    Count = "the buffer of IndirectDraws::count",
    CountOffset = "the offset of IndirectDraws::count",
    Instances = "IndirectDraws::instances",
    InstancesOffset = "IndirectDraws::instances_offset",
    InstanceCapacity = "IndirectDraws::instance_capacity",
    IndirectDrawCapacity = "IndirectDraws::draw_capacity",
    IndirectTriangleCapacity = "IndirectDraws::triangle_capacity",
    IndirectPositionCapacity = "IndirectDraws::position_capacity",
    IndirectMesh = "IndirectDraws::mesh",
    IndirectFrontFace = "IndirectDraws::front_face",

    DrawMesh = "Draw::mesh",
    DrawKey = "Draw::key",
    DrawFrontFace = "Draw::front_face",
    DrawAlphaMap = "Draw::alpha_map",
    ToClip = "Draw::to_clip",

    KindIds = "ImageKinds::ids",
    KindDepth = "ImageKinds::depth",
    ColorFormat = "ImageKinds::color_format",
    ColorEncoded = "ImageKinds::color_encoded",
    Ids = "Images::ids",
    Depth = "Images::depth",
    Color = "Images::color",
    Corner = "Images::corner",

    Size = "Options::size",
    Samples = "Options::samples",
    Pattern = "Options::pattern",
    Background = "Options::background",
    FlatBackground = "Options::flat_background",
    ShadeAll = "Options::shade_all",
    Thin = "Options::thin",

    Viewport = "Scenery::viewport",
    Projection = "Scenery::projection",

    Locations = "LocationList::locations",
    LocationsOffset = "LocationList::offset",
    LocationCapacity = "LocationList::capacity",
    Colors = "LocationList::colors",
    ColorsOffset = "LocationList::colors_offset",
}
