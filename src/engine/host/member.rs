//! Members of this interface that errors are about.

use std::fmt::{self, Display, Formatter};

/// Declares the members, each with its name in Rust, and with its struct and name in C.
macro_rules! members {
    ($($member:ident = $name:literal | $c_struct:ident $c_name:literal,)*) => {
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

            /// Struct and name of the member in C. Members of a mesh are those of a `GpcMesh`.
            #[cfg(feature = "capi")]
            pub(crate) fn in_c(self) -> (&'static str, &'static str) {
                match self {
                    $(Self::$member => (stringify!($c_struct), $c_name),)*
                }
            }
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
    Meshes = "Geometry::meshes" | GpcGeometry "more_meshes",
    MeshCount = "the length of Geometry::meshes" | GpcGeometry "more_mesh_count",
    PositionCapacity = "the capacity of PositionSpace::Object" | GpcGeometry "position_capacity",
    AlphaMaps = "Geometry::alpha_maps" | GpcGeometry "alpha_maps",
    AlphaMapCount = "the length of Geometry::alpha_maps" | GpcGeometry "alpha_map_count",
    Blended = "Geometry::blended" | GpcGeometry "blended",
    Indirect = "Geometry::indirect" | GpcGeometry "indirect_draws",
    TriangleCapacity = "Geometry::triangle_capacity" | GpcGeometry "triangle_capacity",
    DrawCapacity = "Geometry::draw_capacity" | GpcGeometry "draw_capacity",
    Keys = "Geometry::keys" | GpcGeometry "keys",
    YUp = "ClipSpace::y_up" | GpcGeometry "y_up",
    DepthRange = "ClipSpace::depth_range" | GpcGeometry "min_depth and max_depth",

    Positions = "Mesh::positions" | GpcMesh "positions",
    PositionsOffset = "Mesh::positions_offset" | GpcMesh "positions_offset",
    PositionStride = "Mesh::position_stride" | GpcMesh "position_stride",
    PositionFormat = "Mesh::position_format" | GpcMesh "position_format",
    VertexCapacity = "Mesh::vertex_capacity" | GpcMesh "vertex_capacity",
    AllVertices = "the sum of all Mesh::vertex_capacity" | GpcMesh "vertex_capacity",
    Indices = "Indices::buffer" | GpcMesh "indices",
    NoIndices = "Mesh::indices to None" | GpcMesh "index_type",
    IndicesOffset = "Indices::offset" | GpcMesh "indices_offset",
    IndexType = "Indices::index_type" | GpcMesh "index_type",
    IndexCapacity = "Indices::capacity" | GpcMesh "index_capacity",
    Coordinates = "Mesh::coordinates" | GpcMesh "coordinates",
    CoordinatesOffset = "Coordinates::offset" | GpcMesh "coordinates_offset",
    CoordinatesStride = "Coordinates::stride" | GpcMesh "coordinates_stride",
    CoordinatesFormat = "Coordinates::format" | GpcMesh "coordinates_format",

    AlphaView = "AlphaMap::view" | GpcAlphaMap "view",
    AlphaWidth = "AlphaMap::size[0]" | GpcAlphaMap "width",
    AlphaHeight = "AlphaMap::size[1]" | GpcAlphaMap "height",
    AlphaLevels = "AlphaMap::levels" | GpcAlphaMap "levels",
    MagFilter = "AlphaMap::mag_filter" | GpcAlphaMap "mag_filter",
    MinFilter = "AlphaMap::min_filter" | GpcAlphaMap "min_filter",
    MipmapMode = "AlphaMap::mipmap_mode" | GpcAlphaMap "mipmap_mode",
    Address = "AlphaMap::address" | GpcAlphaMap "address_u or address_v",
    Cutoff = "AlphaMap::cutoff" | GpcAlphaMap "cutoff",

    Commands = "IndirectDraws::commands" | GpcIndirectDraws "commands",
    CommandsOffset = "IndirectDraws::commands_offset" | GpcIndirectDraws "commands_offset",
    CommandStride = "IndirectDraws::command_stride" | GpcIndirectDraws "command_stride",
    CommandCapacity = "IndirectDraws::command_capacity" | GpcIndirectDraws "command_capacity",
    Count = "the buffer of IndirectDraws::count" | GpcIndirectDraws "count",
    CountOffset = "the offset of IndirectDraws::count" | GpcIndirectDraws "count_offset",
    Instances = "IndirectDraws::instances" | GpcIndirectDraws "instances",
    InstancesOffset = "IndirectDraws::instances_offset" | GpcIndirectDraws "instances_offset",
    InstanceCapacity = "IndirectDraws::instance_capacity" | GpcIndirectDraws "instance_capacity",
    IndirectDrawCapacity = "IndirectDraws::draw_capacity" | GpcIndirectDraws "draw_capacity",
    IndirectTriangleCapacity = "IndirectDraws::triangle_capacity" | GpcIndirectDraws "triangle_capacity",
    IndirectPositionCapacity = "IndirectDraws::position_capacity" | GpcIndirectDraws "position_capacity",
    IndirectMesh = "IndirectDraws::mesh" | GpcIndirectDraws "mesh",
    IndirectFrontFace = "IndirectDraws::front_face" | GpcIndirectDraws "front_face",

    DrawMesh = "Draw::mesh" | GpcDraw "mesh",
    DrawKey = "Draw::key" | GpcDraw "key",
    DrawFrontFace = "Draw::front_face" | GpcDraw "front_face",
    DrawAlphaMap = "Draw::alpha_map" | GpcDraw "alpha_map",
    ToClip = "Draw::to_clip" | GpcDraw "to_clip",

    KindIds = "ImageKinds::ids" | GpcImageKinds "ids",
    KindDepth = "ImageKinds::depth" | GpcImageKinds "depth",
    ColorFormat = "ImageKinds::color_format" | GpcImageKinds "color_format",
    ColorEncoded = "ImageKinds::color_encoded" | GpcImageKinds "color_encoded",
    Ids = "Images::ids" | GpcImages "ids",
    Depth = "Images::depth" | GpcImages "depth",
    Color = "Images::color" | GpcImages "color",
    Corner = "Images::corner" | GpcImages "corner",

    Size = "Options::size" | GpcOptions "width x height",
    Samples = "Options::samples" | GpcOptions "samples",
    Pattern = "Options::pattern" | GpcOptions "pattern",
    Background = "Options::background" | GpcOptions "background",
    FlatBackground = "Options::flat_background" | GpcOptions "flat_background",
    ShadeAll = "Options::shade_all" | GpcOptions "shade_all",
    Thin = "Options::thin" | GpcOptions "thin",

    Viewport = "Scenery::viewport" | GpcScenery "viewport",
    Projection = "Scenery::projection" | GpcScenery "projection",

    Locations = "LocationList::locations" | GpcLocationList "locations",
    LocationsOffset = "LocationList::offset" | GpcLocationList "offset",
    LocationCapacity = "LocationList::capacity" | GpcLocationList "capacity",
    Colors = "LocationList::colors" | GpcLocationList "colors",
    ColorsOffset = "LocationList::colors_offset" | GpcLocationList "colors_offset",
}
