//! Names in C for members that the engine's error messages mention.

use super::error::Error;
use crate::host::{EngineError, HostError};
use crate::vulkan::VulkanError;

/// Message of an error, with the names that the members have in C.
pub(super) fn in_c(error: &HostError) -> String {
    match error {
        HostError::Engine(EngineError::Vulkan(VulkanError::NoFunction(name))) => {
            Error::Function(name).to_string()
        }
        HostError::Engine(EngineError::Vulkan(VulkanError::NotEnabled {
            member,
            function,
            remedy,
        })) => format!("GpcDevice.{member} is VK_TRUE and there is no {function}: {remedy}"),
        HostError::Engine(EngineError::Vulkan(VulkanError::Pipeline { call, result })) => {
            format!("{call} failed: {result}; was the device created with the features of gpc_require_features?")
        }
        HostError::NoDepth => {
            "thin triangles are found by depth: set GpcImageKinds.depth and lend GpcImages.depth, the depth image, or set GpcOptions.thin to VK_FALSE".to_owned()
        }
        HostError::MissingImage { what } => format!(
            "there is no image of {what}: set GpcImages.{0}, or create the frame without GpcImageKinds.{0}",
            what.to_lowercase()
        ),
        HostError::UnexpectedImage { what } => format!(
            "an image of {what} is lent, and the frame was created without: set GpcImageKinds.{}",
            what.to_lowercase()
        ),
        HostError::NoCoordinates => {
            "GpcGeometry.coordinates is VK_NULL_HANDLE: alpha maps are looked up by texture coordinates".to_owned()
        }
        HostError::DrawCoordinates { draw, mesh } => format!(
            "draw {draw} has an alpha map, and its mesh {mesh} has no texture coordinates: lend {}.coordinates",
            if *mesh == 0 { "GpcGeometry" } else { "GpcMesh" }
        ),
        HostError::NoMesh { draw, mesh, meshes } => format!(
            "GpcDraw.mesh of draw {draw} is {mesh}; it can be 0 to {}, as GpcGeometry.more_mesh_count is {0}",
            meshes.saturating_sub(1)
        ),
        HostError::Mesh { mesh: 0, error } => in_c(error),
        HostError::Mesh { mesh, error } => format!(
            "GpcGeometry.more_meshes[{}]: {}",
            mesh - 1,
            in_c(error).replace("GpcGeometry.", "GpcMesh.")
        ),
        HostError::VertexFormat { what, found, least } => format!(
            "{} is VK_FORMAT_{found:?}; it can have 32-bit SFLOAT components, or 16-bit SFLOAT, UNORM or SNORM components, {least} or more of them",
            c_name(what)
        ),
        HostError::VertexScale { .. } => {
            "GpcGeometry.position_scale or GpcGeometry.position_bias has a number that is not finite".to_owned()
        }
        HostError::ClipFormat { .. } => {
            "GpcGeometry.position_format, position_scale or position_bias is set; positions in clip space are four floats".to_owned()
        }
        HostError::IndirectList { list, error } => {
            let message = match &**error {
                HostError::IndirectMesh { mesh, meshes } => {
                    format!("mesh is {mesh}; it can be 0 to {}, as GpcGeometry.more_mesh_count is {0}", meshes.saturating_sub(1))
                }
                error => error.to_string(),
            };
            format!("GpcGeometry.indirect_draws[{list}]: {message}")
        }
        HostError::IndirectIds => {
            "GpcImageKinds.ids with GpcGeometry.indirect_draws: the library has to draw the IDs, so set ids to VK_FALSE".to_owned()
        }
        HostError::DepthRange([least, most]) => format!(
            "GpcGeometry.min_depth is {least} and GpcGeometry.max_depth is {most}; they have to be finite numbers that differ"
        ),
        HostError::Viewport {
            x,
            y,
            width,
            height,
            height_sign,
            y_up,
        } => format!(
            "GpcScenery.viewport is {width} x {height} pixels at ({x}, {y}); it needs finite numbers, a positive width, and a height that is {height_sign} as GpcGeometry.y_up is {}",
            if *y_up { "VK_TRUE" } else { "VK_FALSE" }
        ),
        HostError::ViewportPart { viewport, part } => format!(
            "GpcScenery.viewport holds the pixels from ({}, {}) to ({}, {}), and the frame is of those from ({}, {}) to ({}, {}): a frame's part of the images has to lie in the viewport; make the size in GpcOptions smaller, or begin it elsewhere by GpcImages.corner",
            viewport[0], viewport[1], viewport[2], viewport[3], part[0], part[1], part[2], part[3]
        ),
        HostError::BlendedCentres => {
            "GpcGeometry.blended with GpcOptions.shade_all: centres are shaded by the nearest surface alone; draw the colours yourself".to_owned()
        }
        HostError::BlendedBackground => {
            "GpcGeometry.blended without GpcOptions.flat_background: blended draws are composited over GpcOptions.background alone; set flat_background and lend the sky as triangles, or draw what is blended after the recording".to_owned()
        }
        HostError::NotBlended { draw } => {
            format!("draw {draw} is blended; create the frame with GpcGeometry.blended")
        }
        HostError::AlphaMap { draw, map, maps } => {
            let asked = u32::from(*map) + 1;
            format!("GpcDraw.alpha_map of draw {draw} is {asked}; it can be 0 to {maps}")
        }
        HostError::FrontFace { draw, found } => format!(
            "GpcDraw.front_face of draw {draw} is {}; it can be VK_FRONT_FACE_COUNTER_CLOCKWISE (0) or VK_FRONT_FACE_CLOCKWISE (1)",
            found.as_raw()
        ),
        HostError::FlatProjection => {
            "GpcScenery.projection has a scale of 0 along y: it is projection[1][1], in columns".to_owned()
        }
        HostError::IndexType { found } => format!(
            "GpcGeometry.index_type is {}; it can be VK_INDEX_TYPE_UINT16 (0), VK_INDEX_TYPE_UINT32 (1) or VK_INDEX_TYPE_NONE_KHR (1000165000)",
            found.as_raw()
        ),
        HostError::NullHandle("the buffer of indices") => {
            "GpcGeometry.indices is VK_NULL_HANDLE: lend the index buffer, or set GpcGeometry.index_type to VK_INDEX_TYPE_NONE_KHR if there is none".to_owned()
        }
        HostError::NullHandle(what) => HostError::NullHandle(c_name(what)).to_string(),
        HostError::Count { what, found, most } => HostError::Count {
            what: c_name(what),
            found: *found,
            most: *most,
        }
        .to_string(),
        HostError::Alignment {
            what,
            offset,
            alignment,
        } => HostError::Alignment {
            what: c_name(what),
            offset: *offset,
            alignment: *alignment,
        }
        .to_string(),
        HostError::Stride { what, found, least, unit } => HostError::Stride {
            what: c_name(what),
            found: *found,
            least: *least,
            unit: *unit,
        }
        .to_string(),
        HostError::Capacity {
            what,
            found,
            capacity,
        } => format!("{found} {what}; {} is {capacity}", capacity_name(what)),
        HostError::Format(found) => format!(
            "GpcImageKinds.color_format is VK_FORMAT_{found:?}; it can have 8, 10, 16 or 32 bits a channel as UNORM, SRGB or SFLOAT, or be VK_FORMAT_B10G11R11_UFLOAT_PACK32"
        ),
        HostError::Encoded(found) => format!(
            "GpcImageKinds.color_encoded is VK_TRUE and GpcImageKinds.color_format is VK_FORMAT_{found:?}, which holds linear light: set color_encoded to VK_FALSE"
        ),
        HostError::Layout { what, when, found } => format!(
            "{}.{when}.layout is VK_IMAGE_LAYOUT_{found:?}; it can be any that keeps what the image holds",
            image_name(what)
        ),
        HostError::Aspects {
            what,
            found,
            possible,
        } => format!(
            "{}.aspects is {:#x}; it can have {possible}",
            image_name(what),
            found.as_raw()
        ),
        HostError::Address { map, found } => format!(
            "an address mode of GpcGeometry.alpha_maps[{map}] is VK_SAMPLER_ADDRESS_MODE_{found:?}; it can be REPEAT, MIRRORED_REPEAT or CLAMP_TO_EDGE"
        ),
        HostError::Filter { map, name, found } => format!(
            "GpcGeometry.alpha_maps[{map}].{name} is {found}; it can be NEAREST (0) or LINEAR (1)"
        ),
        HostError::Cutoff { map } => {
            format!("GpcGeometry.alpha_maps[{map}].cutoff is not finite")
        }
        HostError::NoIds => {
            "GpcImageKinds.depth is VK_TRUE without GpcImageKinds.ids: lend both, or neither to have both drawn".to_owned()
        }
        HostError::Key { draw, key, keys } => {
            let last = keys.saturating_sub(1);
            format!("GpcDraw.key of draw {draw} is {key}; it can be 0 to {last}, as GpcGeometry.keys is {keys}")
        }
        HostError::Matrix { draw } => {
            format!("GpcDraw.to_clip of draw {draw} has a number that is not finite")
        }
        HostError::Projection => {
            "GpcScenery.projection has a number that is not finite".to_owned()
        }
        HostError::Engine(EngineError::Vulkan(VulkanError::TooLarge {
            what,
            needed,
            unit,
            limit,
        })) => VulkanError::TooLarge {
            what: c_name(what).to_owned(),
            needed: *needed,
            unit,
            limit: *limit,
        }
        .to_string(),
        HostError::Engine(EngineError::Samples {
            asked, possible, ..
        }) => {
            format!("GpcOptions.samples is {asked}; it can be {possible}")
        }
        HostError::Engine(EngineError::Background(found)) => {
            format!("GpcOptions.background is {found:?}: its light must be finite")
        }
        HostError::Engine(EngineError::Pattern(error)) => {
            format!("GpcOptions.samples and GpcOptions.pattern: {error}")
        }
        other => other.to_string(),
    }
}

/// Name in C of the member that the engine calls `what`.
fn c_name(what: &str) -> &str {
    let known = NAMES.iter().find(|(name, _)| *name == what);
    known.map_or(what, |(_, member)| member)
}

/// Name of the member that limits the number of `what` in a recording.
fn capacity_name(what: &str) -> &'static str {
    match what {
        "draws" => "GpcGeometry.draw_capacity",
        "triangles" => "GpcGeometry.triangle_capacity",
        "locations" => "GpcLocationList.capacity",
        _ => "GpcGeometry.position_capacity",
    }
}

/// Name in C of the image that the engine calls `what`, without its member `image`.
fn image_name(what: &str) -> &str {
    let name = c_name(what);
    name.strip_suffix(".image").unwrap_or(name)
}

/// Names of members in the engine's errors, each with its name in C.
const NAMES: [(&str, &str); 34] = [
    ("the buffer of positions", "GpcGeometry.positions"),
    ("the buffer of indices", "GpcGeometry.indices"),
    ("the buffer of coordinates", "GpcGeometry.coordinates"),
    ("positions_offset", "GpcGeometry.positions_offset"),
    ("position_stride", "GpcGeometry.position_stride"),
    ("Mesh::position_format", "GpcGeometry.position_format"),
    ("Coordinates::format", "GpcGeometry.coordinates_format"),
    ("indices_offset", "GpcGeometry.indices_offset"),
    ("coordinates_offset", "GpcGeometry.coordinates_offset"),
    ("coordinates_stride", "GpcGeometry.coordinates_stride"),
    ("vertex_capacity", "GpcGeometry.vertex_capacity"),
    ("the capacity of positions in object space", "GpcGeometry.position_capacity"),
    ("vertices of all meshes", "the sum of all vertex_capacity"),
    ("the number of meshes", "1 + GpcGeometry.more_mesh_count"),
    ("index_capacity", "GpcGeometry.index_capacity"),
    ("triangle_capacity", "GpcGeometry.triangle_capacity"),
    ("draw_capacity", "GpcGeometry.draw_capacity"),
    ("keys", "GpcGeometry.keys"),
    ("the number of alpha maps", "GpcGeometry.alpha_map_count"),
    ("the view of an alpha map", "GpcAlphaMap.view"),
    ("the width of an alpha map", "GpcAlphaMap.width"),
    ("the height of an alpha map", "GpcAlphaMap.height"),
    ("levels of an alpha map", "GpcAlphaMap.levels"),
    ("the image of IDs", "GpcImages.ids.image"),
    ("the view of IDs", "GpcImages.ids.view"),
    ("the image of depth", "GpcImages.depth.image"),
    ("the view of depth", "GpcImages.depth.view"),
    ("the image of colours", "GpcImages.color.image"),
    ("the view of colours", "GpcImages.color.view"),
    ("the buffer of locations", "GpcLocationList.locations"),
    ("the buffer of colours", "GpcLocationList.colors"),
    ("the offset of locations", "GpcLocationList.offset"),
    ("the offset of colours", "GpcLocationList.colors_offset"),
    ("the capacity of locations", "GpcLocationList.capacity"),
];
