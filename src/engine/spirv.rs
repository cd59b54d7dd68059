//! What the host and the shaders both know: bindings, specialisation constants, push constants and shared blocks of each
//! shader, by name. `make shaders` writes this file from the compiled shaders and from `shaders/include/interface.glsl`.

use crate::vulkan::{
    Access, Binding, Compiled, Constants, Interface, Invocations, Specialized, Use,
};
use ash::vk::DescriptorType as Kind;

include!(concat!(env!("OUT_DIR"), "/spirv.rs"));

/// The sets that the passes of a frame share.
pub mod frame_set {
    use super::{Binding, Kind};

    pub const FRAME: Binding = Binding::new(0, "frame", Kind::UNIFORM_BUFFER, 1);
    pub const POSITIONS: Binding = Binding::new(1, "positions", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const TRIANGLES: Binding = Binding::new(2, "triangles", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const NORMALS: Binding = Binding::new(3, "normals", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const TANGENTS: Binding = Binding::new(4, "tangents", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const UVS: Binding = Binding::new(5, "uvs", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const COLORS: Binding = Binding::new(6, "colors", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const MATERIALS: Binding = Binding::new(7, "materials", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const LIGHTS: Binding = Binding::new(8, "lights", Kind::STORAGE_BUFFER, 1);
    pub const ALPHA_ATLAS: Binding = Binding::new(9, "alpha_atlas", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const INSTANCE_OF: Binding = Binding::new(10, "instance_of", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const INSTANCES: Binding = Binding::new(11, "instances", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const IDS: Binding = Binding::new(12, "ids", Kind::SAMPLED_IMAGE, 1);
    pub const BLEND_IDS: Binding = Binding::new(13, "blend_ids", Kind::SAMPLED_IMAGE, 1);
    pub const IDS_MS: Binding = Binding::new(14, "ids_ms", Kind::SAMPLED_IMAGE, 1);
    pub const BLEND_IDS_MS: Binding = Binding::new(15, "blend_ids_ms", Kind::SAMPLED_IMAGE, 1);
    pub const DISPLAY: Binding = Binding::new(16, "display", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const DISPLAY_OUT: Binding = Binding::new(17, "display_out", Kind::STORAGE_BUFFER, 1);
    pub const COLOR: Binding = Binding::new(18, "color", Kind::STORAGE_BUFFER, 1);
    pub const COUNTERS: Binding = Binding::new(19, "counters", Kind::STORAGE_BUFFER, 1);
    pub const MASKS: Binding = Binding::new(20, "masks", Kind::STORAGE_BUFFER, 1);
    pub const TILES: Binding = Binding::new(21, "tiles", Kind::STORAGE_BUFFER, 1);
    pub const TILE_LISTS: Binding = Binding::new(22, "tile_lists", Kind::STORAGE_BUFFER, 1);
    pub const SURVIVORS: Binding = Binding::new(23, "survivors", Kind::STORAGE_BUFFER, 1);
    pub const CANDIDATES: Binding = Binding::new(24, "candidates", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const CANDIDATES_OUT: Binding = Binding::new(25, "candidates_out", Kind::STORAGE_BUFFER, 1);
    pub const HEADERS: Binding = Binding::new(26, "headers", Kind::STORAGE_BUFFER, 1);
    pub const FRAGMENTS: Binding = Binding::new(27, "fragments", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const FRAGMENTS_OUT: Binding = Binding::new(28, "fragments_out", Kind::STORAGE_BUFFER, 1);
    pub const SHADED: Binding = Binding::new(29, "shaded", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const SHADED_OUT: Binding = Binding::new(30, "shaded_out", Kind::STORAGE_BUFFER, 1);
    pub const SHADE_ORDER: Binding = Binding::new(31, "shade_order", Kind::STORAGE_BUFFER, 1);
    pub const PATTERN_OFFSETS: Binding = Binding::new(32, "pattern_offsets", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const BINS: Binding = Binding::new(33, "bins", Kind::STORAGE_BUFFER, 1);
    pub const ARGUMENTS: Binding = Binding::new(34, "arguments", Kind::STORAGE_BUFFER, 1);
    pub const FILTERED: Binding = Binding::new(35, "filtered", Kind::STORAGE_TEXEL_BUFFER, 1);
    pub const ATTRIBUTES_OUT: Binding = Binding::new(36, "attributes_out", Kind::STORAGE_BUFFER, 1);
    pub const ENCODED: Binding = Binding::new(37, "encoded", Kind::STORAGE_BUFFER, 1);
    pub const PAIRS: Binding = Binding::new(38, "pairs", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const PAIRS_OUT: Binding = Binding::new(39, "pairs_out", Kind::STORAGE_BUFFER, 1);
    pub const RASTER_DEPTH: Binding = Binding::new(40, "raster_depth", Kind::SAMPLED_IMAGE, 1);
    pub const MARKS: Binding = Binding::new(41, "marks", Kind::STORAGE_BUFFER, 1);
    pub const LOCATIONS: Binding = Binding::new(42, "locations", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const LOCATION_CELLS: Binding = Binding::new(43, "location_cells", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const LOCATION_GROUPS: Binding = Binding::new(44, "location_groups", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const TILE_LOADS: Binding = Binding::new(45, "tile_loads", Kind::STORAGE_BUFFER, 1);
    pub const MOMENT: Binding = Binding::new(46, "moment", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const RESTING: Binding = Binding::new(47, "resting", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const INFLUENCES: Binding = Binding::new(48, "influences", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const DISPLACEMENTS: Binding = Binding::new(49, "displacements", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const POSITIONS_OUT: Binding = Binding::new(50, "positions_out", Kind::STORAGE_TEXEL_BUFFER, 1);
    pub const NORMALS_OUT: Binding = Binding::new(51, "normals_out", Kind::STORAGE_TEXEL_BUFFER, 1);
    pub const TANGENTS_OUT: Binding = Binding::new(52, "tangents_out", Kind::STORAGE_TEXEL_BUFFER, 1);
    pub const ENVIRONMENT_MAP: Binding = Binding::new(53, "environment_map", Kind::COMBINED_IMAGE_SAMPLER, 1);
    pub const STROKES: Binding = Binding::new(55, "strokes", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const SHADOW_WORDS: Binding = Binding::new(56, "shadow_words", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const LOCATION_ORDER: Binding = Binding::new(57, "location_order", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const CORNERS_OUT: Binding = Binding::new(58, "corners_out", Kind::STORAGE_BUFFER, 1);
    pub const INDEXED_DRAWS_OUT: Binding = Binding::new(59, "indexed_draws_out", Kind::STORAGE_BUFFER, 1);
    pub const SPREADS: Binding = Binding::new(60, "spreads", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const SPREADS_OUT: Binding = Binding::new(61, "spreads_out", Kind::STORAGE_BUFFER, 1);
    pub const FILTER_WEIGHTS: Binding = Binding::new(62, "filter_weights", Kind::STORAGE_BUFFER, 1);
    pub const PIXEL_COLORS: Binding = Binding::new(63, "pixel_colors", Kind::UNIFORM_TEXEL_BUFFER, 1);
}

/// An element of the buffer `draws`, as in `shaders/adopt.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Draw {
    pub first_triangle: u32,
    pub first_index: u32,
    pub vertex_offset: u32,
    pub word: u32,
    pub first_position: u32,
    pub last_position: u32,
    pub shift: u32,
    pub material: u32,
}

/// What is pushed to `shaders/adopt.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct AdoptPush {
    pub first_triangle: u32,
    pub triangle_count: u32,
    pub first_draw: u32,
    pub draw_count: u32,
    pub first_index: u32,
    pub index_count: u32,
    pub topology: u32,
    pub clockwise: u32,
}

/// The set of its own that `shaders/adopt.comp` binds.
pub mod adopt_set {
    use super::{Binding, Kind};

    pub const DRAWS: Binding = Binding::new(0, "draws", Kind::STORAGE_BUFFER, 1);
    pub const INDICES: Binding = Binding::new(1, "indices", Kind::STORAGE_BUFFER, 1);
    pub const TRIANGLES_OUT: Binding = Binding::new(2, "triangles_out", Kind::STORAGE_BUFFER, 1);
    pub const DRAW_OF_OUT: Binding = Binding::new(3, "draw_of_out", Kind::STORAGE_BUFFER, 1);
}

/// Constants of `shaders/adopt.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Adopt {
    pub short: bool,
    pub indexed: bool,
}

impl Default for Adopt {
    fn default() -> Self {
        Self {
            short: false,
            indexed: true,
        }
    }
}

impl Specialized for Adopt {
    type Push = AdoptPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "adopt",
        in_frame: false,
        uses: &[
            Use { set: 0, binding: adopt_set::DRAWS, access: Access::Read },
            Use { set: 0, binding: adopt_set::INDICES, access: Access::Read },
            Use { set: 0, binding: adopt_set::TRIANGLES_OUT, access: Access::Write },
            Use { set: 0, binding: adopt_set::DRAW_OF_OUT, access: Access::Write },
        ],
        push_bytes: 32,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(0, self.short)
            .flag(1, self.indexed)
    }
}

impl Compiled for Adopt {
    fn code() -> &'static [u8] {
        ADOPT
    }
}

/// What is pushed to `shaders/alpha_map.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct AlphaMapPush {
    pub size: [u32; 2],
    pub level: u32,
    pub first: u32,
    pub repeats: u32,
}

/// The set of its own that `shaders/alpha_map.comp` binds.
pub mod alpha_map_set {
    use super::{Binding, Kind};

    pub const MAP: Binding = Binding::new(0, "map", Kind::SAMPLED_IMAGE, 1);
    pub const ATLAS: Binding = Binding::new(1, "atlas", Kind::STORAGE_BUFFER, 1);
}

/// `shaders/alpha_map.comp`, which has no constants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AlphaMap;

impl Specialized for AlphaMap {
    type Push = AlphaMapPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "alpha_map",
        in_frame: false,
        uses: &[
            Use { set: 0, binding: alpha_map_set::MAP, access: Access::Read },
            Use { set: 0, binding: alpha_map_set::ATLAS, access: Access::Write },
        ],
        push_bytes: 20,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
    }
}

impl Compiled for AlphaMap {
    fn code() -> &'static [u8] {
        ALPHA_MAP
    }
}

/// The uniform block `frame`, as in `shaders/arguments.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Frame {
    pub transform: [f32; 16],
    pub eye: [f32; 4],
    pub view_direction: [f32; 4],
    pub irradiance: [[f32; 4]; 9],
    pub environment: [[f32; 4]; 3],
    pub background: [f32; 4],
    pub raster_scale: [f32; 2],
    pub raster_offset: [f32; 2],
    pub origin: [f32; 2],
    pub size: [u32; 2],
    pub tiles: [u32; 2],
    pub interior_low: [u32; 2],
    pub interior_high: [u32; 2],
    pub gap: [f32; 2],
    pub triangle_count: u32,
    pub first_mask: u32,
    pub first_blend: u32,
    pub sample_count: u32,
    pub survivor_capacity: u32,
    pub pair_capacity: u32,
    pub list_capacity: u32,
    pub fragment_capacity: u32,
    pub bin_count: u32,
    pub light_count: u32,
    pub material_vectors: u32,
    pub contrast: u32,
    pub alike: u32,
    pub exposure: f32,
    pub footprint: f32,
    pub place_footprint: f32,
    pub sample_footprint: f32,
    pub side: u32,
    pub reach: f32,
    pub group_count: u32,
    pub seen_corner: [u32; 2],
    pub color_corner: [u32; 2],
}

/// What is pushed to `shaders/arguments.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ArgumentsPush {
    pub after: u32,
    pub teams_first: u32,
    pub teams_unlisted: u32,
    pub teams_left: u32,
}

/// Constants of `shaders/arguments.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arguments {
    pub teams: u32,
}

impl Default for Arguments {
    fn default() -> Self {
        Self {
            teams: 1,
        }
    }
}

impl Specialized for Arguments {
    type Push = ArgumentsPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "arguments",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::BINS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::ARGUMENTS, access: Access::Write },
        ],
        push_bytes: 16,
        invocations: Invocations::Fixed(1),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(24, self.teams)
    }
}

impl Compiled for Arguments {
    fn code() -> &'static [u8] {
        ARGUMENTS
    }
}

/// Constants of `shaders/attributes.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Attributes {
    pub superpixels: bool,
    pub grown: bool,
    pub instanced: bool,
}

impl Default for Attributes {
    fn default() -> Self {
        Self {
            superpixels: false,
            grown: false,
            instanced: false,
        }
    }
}

impl Specialized for Attributes {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "attributes",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::NORMALS, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::IDS, access: Access::Read },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Read },
            Use { set: 1, binding: frame_set::ATTRIBUTES_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::MARKS, access: Access::Read },
        ],
        push_bytes: 0,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(0, self.superpixels)
            .flag(1, self.grown)
            .flag(23, self.instanced)
    }
}

impl Compiled for Attributes {
    fn code() -> &'static [u8] {
        ATTRIBUTES
    }
}

/// Constants of `shaders/bin.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bin {
    pub step: u32,
    pub instanced: bool,
}

impl Default for Bin {
    fn default() -> Self {
        Self {
            step: 1,
            instanced: false,
        }
    }
}

impl Specialized for Bin {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "bin",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Read },
            Use { set: 1, binding: frame_set::TILES, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::SURVIVORS, access: Access::Read },
            Use { set: 1, binding: frame_set::PAIRS_OUT, access: Access::Write },
        ],
        push_bytes: 0,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.step)
            .flag(23, self.instanced)
    }
}

impl Compiled for Bin {
    fn code() -> &'static [u8] {
        BIN
    }
}

/// What is pushed to `shaders/box_filter.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct BoxFilterPush {
    pub side: u32,
}

/// `shaders/box_filter.comp`, which has no constants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BoxFilter;

impl Specialized for BoxFilter {
    type Push = BoxFilterPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "box_filter",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::COLOR, access: Access::Read },
            Use { set: 1, binding: frame_set::FILTERED, access: Access::Write },
        ],
        push_bytes: 4,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
    }
}

impl Compiled for BoxFilter {
    fn code() -> &'static [u8] {
        BOX_FILTER
    }
}

/// What is pushed to `shaders/centres.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct CentresPush {
    pub first: u32,
    pub count: u32,
}

/// Constants of `shaders/centres.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Centres {
    pub gather: bool,
    pub tonemap: bool,
    pub tonemap_codes: bool,
}

impl Default for Centres {
    fn default() -> Self {
        Self {
            gather: false,
            tonemap: true,
            tonemap_codes: true,
        }
    }
}

impl Specialized for Centres {
    type Push = CentresPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "centres",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::IDS, access: Access::Read },
            Use { set: 1, binding: frame_set::DISPLAY_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::COLOR, access: Access::Write },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::Write },
            Use { set: 1, binding: frame_set::FRAGMENTS_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::SHADED, access: Access::Read },
        ],
        push_bytes: 8,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(0, self.gather)
            .flag(30, self.tonemap)
            .flag(31, self.tonemap_codes)
    }
}

impl Compiled for Centres {
    fn code() -> &'static [u8] {
        CENTRES
    }
}

/// Constants of `shaders/composite.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Composite {
    pub local_size: u32,
    pub team: u32,
    pub tinted: bool,
    pub teams: u32,
    pub tonemap: bool,
}

impl Default for Composite {
    fn default() -> Self {
        Self {
            local_size: 1,
            team: 8,
            tinted: false,
            teams: 1,
            tonemap: true,
        }
    }
}

impl Specialized for Composite {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "composite",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::Read },
            Use { set: 1, binding: frame_set::FRAGMENTS, access: Access::Read },
            Use { set: 1, binding: frame_set::SHADED, access: Access::Read },
            Use { set: 1, binding: frame_set::SHADED_OUT, access: Access::Write },
        ],
        push_bytes: 0,
        invocations: Invocations::Constant,
        by_teams: true,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.local_size)
            .with(1, self.team)
            .flag(16, self.tinted)
            .with(24, self.teams)
            .flag(30, self.tonemap)
    }
}

impl Compiled for Composite {
    fn code() -> &'static [u8] {
        COMPOSITE
    }
}

/// What is pushed to `shaders/coordinates.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct CoordinatesPush {
    pub scale: [f32; 4],
    pub bias: [f32; 4],
    pub first_position: u32,
    pub position_count: u32,
    pub first_draw: u32,
    pub draw_count: u32,
    pub first_half: u32,
    pub stride: u32,
}

/// The set of its own that `shaders/coordinates.comp` binds.
pub mod coordinates_set {
    use super::{Binding, Kind};

    pub const DRAWS: Binding = Binding::new(0, "draws", Kind::STORAGE_BUFFER, 1);
    pub const VERTICES: Binding = Binding::new(1, "vertices", Kind::STORAGE_BUFFER, 1);
    pub const COORDINATES_OUT: Binding = Binding::new(2, "coordinates_out", Kind::STORAGE_BUFFER, 1);
}

/// Constants of `shaders/coordinates.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinates {
    pub object: bool,
    pub vertex_format: u32,
}

impl Default for Coordinates {
    fn default() -> Self {
        Self {
            object: false,
            vertex_format: 0,
        }
    }
}

impl Specialized for Coordinates {
    type Push = CoordinatesPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "coordinates",
        in_frame: false,
        uses: &[
            Use { set: 0, binding: coordinates_set::DRAWS, access: Access::Read },
            Use { set: 0, binding: coordinates_set::VERTICES, access: Access::Read },
            Use { set: 0, binding: coordinates_set::COORDINATES_OUT, access: Access::Write },
        ],
        push_bytes: 56,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(0, self.object)
            .with(60, self.vertex_format)
    }
}

impl Compiled for Coordinates {
    fn code() -> &'static [u8] {
        COORDINATES
    }
}

/// What is pushed to `shaders/crossings.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct CrossingsPush {
    pub tiles: [u32; 2],
    pub width: u32,
    pub pixel: f32,
}

/// The set beside the frame's that `shaders/crossings.comp` binds.
pub mod crossings_set {
    use super::{Binding, Kind};

    pub const LOADS: Binding = Binding::new(0, "loads", Kind::STORAGE_BUFFER, 1);
    pub const SEEN: Binding = Binding::new(1, "seen", Kind::STORAGE_BUFFER, 1);
    pub const CELL_MARKS: Binding = Binding::new(2, "cell_marks", Kind::STORAGE_BUFFER, 1);
}

/// Constants of `shaders/crossings.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crossings {
    pub blend_ids: bool,
    pub folds: bool,
    pub instanced: bool,
}

impl Default for Crossings {
    fn default() -> Self {
        Self {
            blend_ids: false,
            folds: false,
            instanced: false,
        }
    }
}

impl Specialized for Crossings {
    type Push = CrossingsPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "crossings",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::Read },
            Use { set: 1, binding: frame_set::PAIRS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATION_CELLS, access: Access::Read },
            Use { set: 2, binding: crossings_set::LOADS, access: Access::Read },
            Use { set: 2, binding: crossings_set::SEEN, access: Access::Read },
            Use { set: 2, binding: crossings_set::CELL_MARKS, access: Access::ReadWrite },
        ],
        push_bytes: 16,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(1, self.blend_ids)
            .flag(2, self.folds)
            .flag(23, self.instanced)
    }
}

impl Compiled for Crossings {
    fn code() -> &'static [u8] {
        CROSSINGS
    }
}

/// Constants of `shaders/cull.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cull {
    pub thin_alone: bool,
    pub instanced: bool,
}

impl Default for Cull {
    fn default() -> Self {
        Self {
            thin_alone: false,
            instanced: false,
        }
    }
}

impl Specialized for Cull {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "cull",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Read },
            Use { set: 1, binding: frame_set::SURVIVORS, access: Access::Write },
        ],
        push_bytes: 0,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(0, self.thin_alone)
            .flag(23, self.instanced)
    }
}

impl Compiled for Cull {
    fn code() -> &'static [u8] {
        CULL
    }
}

/// Constants of `shaders/detect.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Detect {
    pub mode: u32,
    pub blend_ids: bool,
    pub thin: bool,
    pub transparent: bool,
    pub beyond: u32,
    pub shadow_words: u32,
}

impl Default for Detect {
    fn default() -> Self {
        Self {
            mode: 0,
            blend_ids: false,
            thin: false,
            transparent: false,
            beyond: 0,
            shadow_words: 0,
        }
    }
}

impl Specialized for Detect {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "detect",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::IDS, access: Access::Read },
            Use { set: 1, binding: frame_set::BLEND_IDS, access: Access::Read },
            Use { set: 1, binding: frame_set::BLEND_IDS_MS, access: Access::Read },
            Use { set: 1, binding: frame_set::DISPLAY, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Write },
            Use { set: 1, binding: frame_set::MARKS, access: Access::Read },
            Use { set: 1, binding: frame_set::SHADOW_WORDS, access: Access::Read },
        ],
        push_bytes: 0,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.mode)
            .flag(1, self.blend_ids)
            .flag(2, self.thin)
            .flag(3, self.transparent)
            .with(4, self.beyond)
            .with(25, self.shadow_words)
    }
}

/// What is pushed to `shaders/distribute.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct DistributePush {
    pub tiles: [u32; 2],
    pub count: u32,
    pub in_cell: u32,
    pub in_group: u32,
    pub samples: u32,
}

/// The set of its own that `shaders/distribute.comp` binds.
pub mod distribute_set {
    use super::{Binding, Kind};

    pub const LOADS: Binding = Binding::new(0, "loads", Kind::STORAGE_BUFFER, 1);
    pub const RANKS: Binding = Binding::new(1, "ranks", Kind::STORAGE_BUFFER, 1);
    pub const ORDER_OUT: Binding = Binding::new(2, "order_out", Kind::STORAGE_BUFFER, 1);
    pub const CELLS_OUT: Binding = Binding::new(3, "cells_out", Kind::STORAGE_BUFFER, 1);
    pub const GROUPS_OUT: Binding = Binding::new(4, "groups_out", Kind::STORAGE_BUFFER, 1);
    pub const TILE_LOADS: Binding = Binding::new(5, "tile_loads", Kind::STORAGE_BUFFER, 1);
    pub const MASKS: Binding = Binding::new(6, "masks", Kind::STORAGE_BUFFER, 1);
    pub const COUNTERS: Binding = Binding::new(7, "counters", Kind::STORAGE_BUFFER, 1);
    pub const LOCATIONS: Binding = Binding::new(8, "locations", Kind::UNIFORM_TEXEL_BUFFER, 1);
    pub const ORDER: Binding = Binding::new(9, "order", Kind::UNIFORM_TEXEL_BUFFER, 1);
}

/// Constants of `shaders/distribute.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Distribute {
    pub step: u32,
    pub points: bool,
}

impl Default for Distribute {
    fn default() -> Self {
        Self {
            step: 0,
            points: false,
        }
    }
}

impl Specialized for Distribute {
    type Push = DistributePush;

    const INTERFACE: &'static Interface = &Interface {
        name: "distribute",
        in_frame: false,
        uses: &[
            Use { set: 0, binding: distribute_set::LOADS, access: Access::ReadWrite },
            Use { set: 0, binding: distribute_set::RANKS, access: Access::ReadWrite },
            Use { set: 0, binding: distribute_set::ORDER_OUT, access: Access::Write },
            Use { set: 0, binding: distribute_set::CELLS_OUT, access: Access::ReadWrite },
            Use { set: 0, binding: distribute_set::GROUPS_OUT, access: Access::Write },
            Use { set: 0, binding: distribute_set::TILE_LOADS, access: Access::Write },
            Use { set: 0, binding: distribute_set::MASKS, access: Access::Write },
            Use { set: 0, binding: distribute_set::COUNTERS, access: Access::ReadWrite },
            Use { set: 0, binding: distribute_set::LOCATIONS, access: Access::Read },
            Use { set: 0, binding: distribute_set::ORDER, access: Access::Read },
        ],
        push_bytes: 24,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.step)
            .flag(1, self.points)
    }
}

impl Compiled for Distribute {
    fn code() -> &'static [u8] {
        DISTRIBUTE
    }
}

/// Constants of `shaders/encode.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Encode {
    pub format: u32,
}

impl Default for Encode {
    fn default() -> Self {
        Self {
            format: 0,
        }
    }
}

impl Specialized for Encode {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "encode",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::COLOR, access: Access::Read },
            Use { set: 1, binding: frame_set::ENCODED, access: Access::ReadWrite },
        ],
        push_bytes: 0,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.format)
    }
}

impl Compiled for Encode {
    fn code() -> &'static [u8] {
        ENCODE
    }
}

/// What is pushed to `shaders/enlist.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct EnlistPush {
    pub block: u32,
    pub per_sample: u32,
    pub layers: u32,
    pub parts: u32,
    pub teams_first: u32,
    pub teams_unlisted: u32,
    pub longest_list: u32,
    pub longest_layered: u32,
    pub more_fragments: u32,
}

/// Constants of `shaders/enlist.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Enlist {
    pub local_size: u32,
    pub team: u32,
    pub locations: bool,
    pub teams: u32,
    pub cells_of_entry: u32,
}

impl Default for Enlist {
    fn default() -> Self {
        Self {
            local_size: 1,
            team: 8,
            locations: false,
            teams: 1,
            cells_of_entry: 8,
        }
    }
}

impl Specialized for Enlist {
    type Push = EnlistPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "enlist",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Read },
            Use { set: 1, binding: frame_set::TILES, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::TILE_LISTS, access: Access::Write },
            Use { set: 1, binding: frame_set::TILE_LOADS, access: Access::Read },
        ],
        push_bytes: 36,
        invocations: Invocations::Constant,
        by_teams: true,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.local_size)
            .with(1, self.team)
            .flag(20, self.locations)
            .with(24, self.teams)
            .with(26, self.cells_of_entry)
    }
}

impl Compiled for Enlist {
    fn code() -> &'static [u8] {
        ENLIST
    }
}

/// An element of the buffer `indexed_draws_out`, as in `shaders/filter.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct IndexedDraw {
    pub index_count: u32,
    pub instance_count: u32,
    pub first_index: u32,
    pub vertex_offset: u32,
    pub first_instance: u32,
}

/// What is pushed to `shaders/filter.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct FilterPush {
    pub first_triangle: u32,
    pub triangle_count: u32,
    pub first_draw: u32,
    pub snap: f32,
}

/// Constants of `shaders/filter.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Filter {
    pub local_size: u32,
    pub team: u32,
    pub instanced: bool,
    pub teams: u32,
}

impl Default for Filter {
    fn default() -> Self {
        Self {
            local_size: 1,
            team: 8,
            instanced: false,
            teams: 1,
        }
    }
}

impl Specialized for Filter {
    type Push = FilterPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "filter",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::CORNERS_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::INDEXED_DRAWS_OUT, access: Access::Write },
        ],
        push_bytes: 16,
        invocations: Invocations::Constant,
        by_teams: true,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.local_size)
            .with(1, self.team)
            .flag(23, self.instanced)
            .with(24, self.teams)
    }
}

impl Compiled for Filter {
    fn code() -> &'static [u8] {
        FILTER
    }
}

/// The uniform block `gpc_frame`, as in `shaders/include/gpc_visibility.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct GpcFrame {
    pub scale: [f32; 2],
    pub middle: [f32; 2],
    pub place_side: f32,
    pub r#box: u32,
    pub list: u32,
    pub padding_28: [u32; 1],
}

/// The set of `shaders/include/gpc_visibility.glsl`, which hosts' shaders bind.
pub mod gpc_visibility_set {
    use super::{Binding, Kind};

    pub const GPC_FRAME: Binding = Binding::new(0, "gpc_frame", Kind::UNIFORM_BUFFER, 1);
    pub const GPC_KEYS: Binding = Binding::new(1, "gpc_keys", Kind::STORAGE_BUFFER, 1);
    pub const GPC_ORDER: Binding = Binding::new(2, "gpc_order", Kind::STORAGE_BUFFER, 1);
    pub const GPC_FRAGMENTS: Binding = Binding::new(3, "gpc_fragments", Kind::STORAGE_BUFFER, 1);
    pub const GPC_TRIANGLES: Binding = Binding::new(4, "gpc_triangles", Kind::STORAGE_BUFFER, 1);
    pub const GPC_POSITIONS: Binding = Binding::new(5, "gpc_positions", Kind::STORAGE_BUFFER, 1);
    pub const GPC_SHADED: Binding = Binding::new(6, "gpc_shaded", Kind::STORAGE_BUFFER, 1);
    pub const GPC_DRAWS: Binding = Binding::new(7, "gpc_draws", Kind::STORAGE_BUFFER, 1);
    pub const GPC_DRAW_OF: Binding = Binding::new(8, "gpc_draw_of", Kind::STORAGE_BUFFER, 1);
    pub const GPC_LOCATIONS: Binding = Binding::new(9, "gpc_locations", Kind::STORAGE_BUFFER, 1);
    pub const ALL: [Binding; 10] = [
        GPC_FRAME,
        GPC_KEYS,
        GPC_ORDER,
        GPC_FRAGMENTS,
        GPC_TRIANGLES,
        GPC_POSITIONS,
        GPC_SHADED,
        GPC_DRAWS,
        GPC_DRAW_OF,
        GPC_LOCATIONS,
    ];
}

/// A constant of `shaders/include/gpc_visibility.glsl`: its ID and its value.
pub const GPC_SHADER_VERSION: (u32, u32) = (2046, 1);

/// Constants of `shaders/groups.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Groups {
    pub locations: bool,
    pub points: bool,
    pub cells_of_entry: u32,
}

impl Default for Groups {
    fn default() -> Self {
        Self {
            locations: false,
            points: false,
            cells_of_entry: 8,
        }
    }
}

impl Specialized for Groups {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "groups",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::TILES, access: Access::Read },
            Use { set: 1, binding: frame_set::TILE_LISTS, access: Access::Write },
            Use { set: 1, binding: frame_set::LOCATION_GROUPS, access: Access::Read },
        ],
        push_bytes: 0,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(20, self.locations)
            .flag(21, self.points)
            .with(26, self.cells_of_entry)
    }
}

impl Compiled for Groups {
    fn code() -> &'static [u8] {
        GROUPS
    }
}

/// Constants of `shaders/grow.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grow {
    pub beyond: u32,
}

impl Default for Grow {
    fn default() -> Self {
        Self {
            beyond: 0,
        }
    }
}

impl Specialized for Grow {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "grow",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::MASKS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::MARKS, access: Access::ReadWrite },
        ],
        push_bytes: 0,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.beyond)
    }
}

impl Compiled for Grow {
    fn code() -> &'static [u8] {
        GROW
    }
}

/// An element of the buffer `instances`, as in `shaders/indirect.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct GpcInstance {
    pub to_clip: [f32; 16],
    pub vertex_count: u32,
    pub key: u32,
    pub material: u32,
    pub alpha_map: u32,
    pub detailed: u32,
    pub reserved_0: u32,
    pub reserved_1: u32,
    pub reserved_2: u32,
}

/// What is pushed to `shaders/indirect.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct IndirectPush {
    pub first_command: u32,
    pub command_stride: u32,
    pub command_capacity: u32,
    pub count_word: u32,
    pub instance_capacity: u32,
    pub draw_capacity: u32,
    pub triangle_capacity: u32,
    pub position_capacity: u32,
    pub first_draw: u32,
    pub first_triangle: u32,
    pub first_position: u32,
    pub vertex_capacity: u32,
    pub index_capacity: u32,
    pub topology: u32,
    pub keys: u32,
    pub alpha_maps: u32,
    pub flags: u32,
}

/// The set of its own that `shaders/indirect.comp` binds.
pub mod indirect_set {
    use super::{Binding, Kind};

    pub const COMMANDS: Binding = Binding::new(0, "commands", Kind::STORAGE_BUFFER, 1);
    pub const COUNT: Binding = Binding::new(1, "count", Kind::STORAGE_BUFFER, 1);
    pub const INSTANCES: Binding = Binding::new(2, "instances", Kind::STORAGE_BUFFER, 1);
    pub const DRAWS_OUT: Binding = Binding::new(3, "draws_out", Kind::STORAGE_BUFFER, 1);
    pub const MATRICES_OUT: Binding = Binding::new(4, "matrices_out", Kind::STORAGE_BUFFER, 1);
    pub const FIRST_DRAWS: Binding = Binding::new(5, "first_draws", Kind::STORAGE_BUFFER, 1);
    pub const BLOCKS: Binding = Binding::new(6, "blocks", Kind::STORAGE_BUFFER, 1);
    pub const TOTALS: Binding = Binding::new(7, "totals", Kind::STORAGE_BUFFER, 1);
}

/// Constants of `shaders/indirect.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Indirect {
    pub step: u32,
}

impl Default for Indirect {
    fn default() -> Self {
        Self {
            step: 0,
        }
    }
}

impl Specialized for Indirect {
    type Push = IndirectPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "indirect",
        in_frame: false,
        uses: &[
            Use { set: 0, binding: indirect_set::COMMANDS, access: Access::Read },
            Use { set: 0, binding: indirect_set::COUNT, access: Access::Read },
            Use { set: 0, binding: indirect_set::INSTANCES, access: Access::Read },
            Use { set: 0, binding: indirect_set::DRAWS_OUT, access: Access::Write },
            Use { set: 0, binding: indirect_set::MATRICES_OUT, access: Access::Write },
            Use { set: 0, binding: indirect_set::FIRST_DRAWS, access: Access::ReadWrite },
            Use { set: 0, binding: indirect_set::BLOCKS, access: Access::ReadWrite },
            Use { set: 0, binding: indirect_set::TOTALS, access: Access::ReadWrite },
        ],
        push_bytes: 68,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.step)
    }
}

impl Compiled for Indirect {
    fn code() -> &'static [u8] {
        INDIRECT
    }
}

/// The set beside the frame's that `shaders/merge.comp` binds.
pub mod merge_set {
    use super::{Binding, Kind};

    pub const WORDS: Binding = Binding::new(0, "words", Kind::STORAGE_BUFFER, 1);
}

/// Constants of `shaders/merge.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Merge {
    pub local_size: u32,
    pub team: u32,
    pub rows: u32,
    pub list: u32,
    pub by_part: bool,
    pub part: u32,
    pub locations: bool,
    pub instanced: bool,
    pub teams: u32,
    pub shadow_words: u32,
    pub cells_of_entry: u32,
}

impl Default for Merge {
    fn default() -> Self {
        Self {
            local_size: 1,
            team: 8,
            rows: 8,
            list: 0,
            by_part: false,
            part: 8,
            locations: false,
            instanced: false,
            teams: 1,
            shadow_words: 0,
            cells_of_entry: 8,
        }
    }
}

impl Specialized for Merge {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "merge",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::IDS, access: Access::Read },
            Use { set: 1, binding: frame_set::DISPLAY, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::Read },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Read },
            Use { set: 1, binding: frame_set::TILES, access: Access::Read },
            Use { set: 1, binding: frame_set::TILE_LISTS, access: Access::Read },
            Use { set: 1, binding: frame_set::HEADERS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::FRAGMENTS, access: Access::Read },
            Use { set: 1, binding: frame_set::FRAGMENTS_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::LOCATION_GROUPS, access: Access::Read },
            Use { set: 1, binding: frame_set::SHADOW_WORDS, access: Access::Read },
            Use { set: 2, binding: merge_set::WORDS, access: Access::Write },
        ],
        push_bytes: 0,
        invocations: Invocations::Constant,
        by_teams: true,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.local_size)
            .with(1, self.team)
            .with(2, self.rows)
            .with(3, self.list)
            .flag(4, self.by_part)
            .with(5, self.part)
            .flag(20, self.locations)
            .flag(23, self.instanced)
            .with(24, self.teams)
            .with(25, self.shadow_words)
            .with(26, self.cells_of_entry)
    }
}

impl Compiled for Merge {
    fn code() -> &'static [u8] {
        MERGE
    }
}

/// Constants of `shaders/multisample.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Multisample {
    pub teams: u32,
    pub cells_of_entry: u32,
}

impl Default for Multisample {
    fn default() -> Self {
        Self {
            teams: 1,
            cells_of_entry: 8,
        }
    }
}

impl Specialized for Multisample {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "multisample",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::IDS_MS, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::Write },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Write },
            Use { set: 1, binding: frame_set::TILES, access: Access::Write },
            Use { set: 1, binding: frame_set::TILE_LISTS, access: Access::Write },
            Use { set: 1, binding: frame_set::HEADERS, access: Access::Write },
            Use { set: 1, binding: frame_set::FRAGMENTS_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::ARGUMENTS, access: Access::Write },
        ],
        push_bytes: 0,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(24, self.teams)
            .with(26, self.cells_of_entry)
    }
}

impl Compiled for Multisample {
    fn code() -> &'static [u8] {
        MULTISAMPLE
    }
}

/// Constants of `shaders/neighbours.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Neighbours {
    pub tonemap: bool,
    pub tonemap_codes: bool,
}

impl Default for Neighbours {
    fn default() -> Self {
        Self {
            tonemap: true,
            tonemap_codes: true,
        }
    }
}

impl Specialized for Neighbours {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "neighbours",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::DISPLAY, access: Access::Read },
            Use { set: 1, binding: frame_set::COLOR, access: Access::Read },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Read },
            Use { set: 1, binding: frame_set::MARKS, access: Access::ReadWrite },
        ],
        push_bytes: 0,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(30, self.tonemap)
            .flag(31, self.tonemap_codes)
    }
}

impl Compiled for Neighbours {
    fn code() -> &'static [u8] {
        NEIGHBOURS
    }
}

/// What is pushed to `shaders/occlude.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct OccludePush {
    pub to_plane: [f32; 16],
    pub light: [f32; 4],
    pub cone: [f32; 4],
    pub range: f32,
    pub number: u32,
    pub face: u32,
    pub first_place: u32,
    pub region: [u32; 2],
    pub points: u32,
    pub begins: u32,
}

/// The set beside the frame's that `shaders/occlude.comp` binds.
pub mod occlude_set {
    use super::{Binding, Kind};

    pub const WORDS: Binding = Binding::new(0, "words", Kind::STORAGE_BUFFER, 1);
    pub const LEFT: Binding = Binding::new(1, "left", Kind::STORAGE_BUFFER, 1);
    pub const MARKS_OF_PIXELS: Binding = Binding::new(2, "marks_of_pixels", Kind::STORAGE_BUFFER, 1);
}

/// Constants of `shaders/occlude.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Occlude {
    pub local_size: u32,
    pub team: u32,
    pub translucent: bool,
    pub rows: u32,
    pub instanced: bool,
    pub teams: u32,
    pub shadow_words: u32,
}

impl Default for Occlude {
    fn default() -> Self {
        Self {
            local_size: 1,
            team: 8,
            translucent: false,
            rows: 8,
            instanced: false,
            teams: 1,
            shadow_words: 0,
        }
    }
}

impl Specialized for Occlude {
    type Push = OccludePush;

    const INTERFACE: &'static Interface = &Interface {
        name: "occlude",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::UVS, access: Access::Read },
            Use { set: 1, binding: frame_set::COLORS, access: Access::Read },
            Use { set: 1, binding: frame_set::MATERIALS, access: Access::Read },
            Use { set: 1, binding: frame_set::ALPHA_ATLAS, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::Read },
            Use { set: 1, binding: frame_set::TILES, access: Access::Read },
            Use { set: 1, binding: frame_set::CANDIDATES, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATIONS, access: Access::Read },
            Use { set: 2, binding: occlude_set::WORDS, access: Access::ReadWrite },
            Use { set: 2, binding: occlude_set::LEFT, access: Access::ReadWrite },
            Use { set: 2, binding: occlude_set::MARKS_OF_PIXELS, access: Access::ReadWrite },
        ],
        push_bytes: 128,
        invocations: Invocations::Constant,
        by_teams: true,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.local_size)
            .with(1, self.team)
            .flag(2, self.translucent)
            .with(3, self.rows)
            .flag(23, self.instanced)
            .with(24, self.teams)
            .with(25, self.shadow_words)
    }
}

impl Compiled for Occlude {
    fn code() -> &'static [u8] {
        OCCLUDE
    }
}

/// Constants of `shaders/patch.frag`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PatchFragment {
    pub encoded: bool,
    pub grown: bool,
    pub all: bool,
}

impl Default for PatchFragment {
    fn default() -> Self {
        Self {
            encoded: false,
            grown: false,
            all: false,
        }
    }
}

impl Specialized for PatchFragment {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "patch_fragment",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::COLOR, access: Access::Read },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Read },
            Use { set: 1, binding: frame_set::MARKS, access: Access::Read },
        ],
        push_bytes: 0,
        invocations: Invocations::Drawn,
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(0, self.encoded)
            .flag(1, self.grown)
            .flag(2, self.all)
    }
}

impl Compiled for PatchFragment {
    fn code() -> &'static [u8] {
        PATCH_FRAGMENT
    }
}

/// `shaders/patch.vert`, which has no constants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PatchVertex;

impl Specialized for PatchVertex {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "patch_vertex",
        in_frame: false,
        uses: &[
        ],
        push_bytes: 0,
        invocations: Invocations::Drawn,
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
    }
}

impl Compiled for PatchVertex {
    fn code() -> &'static [u8] {
        PATCH_VERTEX
    }
}

/// Constants of `shaders/pixel_filter.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelFilter {
    pub reach: u32,
    pub supersampled: bool,
    pub superpixels: bool,
    pub grown: bool,
    pub weight_0: u32,
    pub weight_1: u32,
    pub weight_2: u32,
    pub slope_1: u32,
    pub slope_2: u32,
    pub bend_0: u32,
    pub bend_1: u32,
    pub bend_2: u32,
    pub premultiplied: bool,
}

impl Default for PixelFilter {
    fn default() -> Self {
        Self {
            reach: 1,
            supersampled: false,
            superpixels: false,
            grown: false,
            weight_0: 0,
            weight_1: 0,
            weight_2: 0,
            slope_1: 0,
            slope_2: 0,
            bend_0: 0,
            bend_1: 0,
            bend_2: 0,
            premultiplied: false,
        }
    }
}

impl Specialized for PixelFilter {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "pixel_filter",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Read },
            Use { set: 1, binding: frame_set::FILTERED, access: Access::Write },
            Use { set: 1, binding: frame_set::MARKS, access: Access::Read },
            Use { set: 1, binding: frame_set::SPREADS, access: Access::Read },
            Use { set: 1, binding: frame_set::FILTER_WEIGHTS, access: Access::Read },
            Use { set: 1, binding: frame_set::PIXEL_COLORS, access: Access::Read },
        ],
        push_bytes: 0,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.reach)
            .flag(1, self.supersampled)
            .flag(2, self.superpixels)
            .flag(3, self.grown)
            .with(4, self.weight_0)
            .with(5, self.weight_1)
            .with(6, self.weight_2)
            .with(7, self.slope_1)
            .with(8, self.slope_2)
            .with(9, self.bend_0)
            .with(10, self.bend_1)
            .with(11, self.bend_2)
            .flag(12, self.premultiplied)
    }
}

impl Compiled for PixelFilter {
    fn code() -> &'static [u8] {
        PIXEL_FILTER
    }
}

/// Constants of `shaders/points.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Points {
    pub attributes: bool,
    pub tinted: bool,
    pub locations: bool,
    pub instanced: bool,
    pub shadow_words: u32,
    pub tonemap: bool,
    pub tonemap_codes: bool,
}

impl Default for Points {
    fn default() -> Self {
        Self {
            attributes: false,
            tinted: false,
            locations: false,
            instanced: false,
            shadow_words: 0,
            tonemap: true,
            tonemap_codes: true,
        }
    }
}

impl Specialized for Points {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "points",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::NORMALS, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::COLOR, access: Access::Write },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::Read },
            Use { set: 1, binding: frame_set::FRAGMENTS, access: Access::Read },
            Use { set: 1, binding: frame_set::SHADED, access: Access::Read },
            Use { set: 1, binding: frame_set::ATTRIBUTES_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::LOCATIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::SHADOW_WORDS, access: Access::Read },
        ],
        push_bytes: 0,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(2, self.attributes)
            .flag(16, self.tinted)
            .flag(20, self.locations)
            .flag(23, self.instanced)
            .with(25, self.shadow_words)
            .flag(30, self.tonemap)
            .flag(31, self.tonemap_codes)
    }
}

impl Compiled for Points {
    fn code() -> &'static [u8] {
        POINTS
    }
}

/// What is pushed to `shaders/pose.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct PosePush {
    pub count: u32,
    pub first_vertex: u32,
    pub first_resting: u32,
    pub first_influence: u32,
    pub sets: u32,
    pub first_displacement: u32,
    pub displacement_vectors: u32,
    pub first_matrix: u32,
    pub first_weight: u32,
    pub weight_count: u32,
    pub flags: u32,
}

/// `shaders/pose.comp`, which has no constants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pose;

impl Specialized for Pose {
    type Push = PosePush;

    const INTERFACE: &'static Interface = &Interface {
        name: "pose",
        in_frame: true,
        uses: &[
            Use { set: 1, binding: frame_set::MOMENT, access: Access::Read },
            Use { set: 1, binding: frame_set::RESTING, access: Access::Read },
            Use { set: 1, binding: frame_set::INFLUENCES, access: Access::Read },
            Use { set: 1, binding: frame_set::DISPLACEMENTS, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::NORMALS_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::TANGENTS_OUT, access: Access::Write },
        ],
        push_bytes: 44,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
    }
}

impl Compiled for Pose {
    fn code() -> &'static [u8] {
        POSE
    }
}

/// What is pushed to `shaders/prefilter.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct PrefilterPush {
    pub finest: u32,
    pub side: u32,
    pub first: u32,
    pub first_ray: u32,
    pub ray_count: u32,
}

/// The set of its own that `shaders/prefilter.comp` binds.
pub mod prefilter_set {
    use super::{Binding, Kind};

    pub const TEXELS: Binding = Binding::new(0, "texels", Kind::STORAGE_BUFFER, 1);
    pub const RAYS: Binding = Binding::new(1, "rays", Kind::STORAGE_BUFFER, 1);
}

/// `shaders/prefilter.comp`, which has no constants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Prefilter;

impl Specialized for Prefilter {
    type Push = PrefilterPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "prefilter",
        in_frame: false,
        uses: &[
            Use { set: 0, binding: prefilter_set::TEXELS, access: Access::ReadWrite },
            Use { set: 0, binding: prefilter_set::RAYS, access: Access::Read },
        ],
        push_bytes: 20,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
    }
}

impl Compiled for Prefilter {
    fn code() -> &'static [u8] {
        PREFILTER
    }
}

/// Constants of `shaders/raster.frag`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RasterFragment {
    pub instanced: bool,
}

impl Default for RasterFragment {
    fn default() -> Self {
        Self {
            instanced: false,
        }
    }
}

impl Specialized for RasterFragment {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "raster_fragment",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::UVS, access: Access::Read },
            Use { set: 1, binding: frame_set::COLORS, access: Access::Read },
            Use { set: 1, binding: frame_set::MATERIALS, access: Access::Read },
            Use { set: 1, binding: frame_set::ALPHA_ATLAS, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
        ],
        push_bytes: 0,
        invocations: Invocations::Drawn,
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(23, self.instanced)
    }
}

/// What is pushed to `shaders/raster.vert`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct RasterVertexPush {
    pub matrix: [f32; 16],
    pub instance: [u32; 4],
}

/// `shaders/raster.vert`, which has no constants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RasterVertex;

impl Specialized for RasterVertex {
    type Push = RasterVertexPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "raster_vertex",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
        ],
        push_bytes: 80,
        invocations: Invocations::Drawn,
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
    }
}

impl Compiled for RasterVertex {
    fn code() -> &'static [u8] {
        RASTER_VERTEX
    }
}

/// What is pushed to `shaders/receivers.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ReceiversPush {
    pub points: u32,
}

/// The set beside the frame's that `shaders/receivers.comp` binds.
pub mod receivers_set {
    use super::{Binding, Kind};

    pub const LOCATIONS_OUT: Binding = Binding::new(0, "locations_out", Kind::STORAGE_BUFFER, 1);
}

/// Constants of `shaders/receivers.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Receivers {
    pub pixels: bool,
    pub locations: bool,
    pub instanced: bool,
    pub diffuse_transmission: bool,
}

impl Default for Receivers {
    fn default() -> Self {
        Self {
            pixels: false,
            locations: false,
            instanced: false,
            diffuse_transmission: false,
        }
    }
}

impl Specialized for Receivers {
    type Push = ReceiversPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "receivers",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::MATERIALS, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::IDS, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::Read },
            Use { set: 1, binding: frame_set::FRAGMENTS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATIONS, access: Access::Read },
            Use { set: 2, binding: receivers_set::LOCATIONS_OUT, access: Access::Write },
        ],
        push_bytes: 4,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(0, self.pixels)
            .flag(20, self.locations)
            .flag(23, self.instanced)
            .flag(37, self.diffuse_transmission)
    }
}

impl Compiled for Receivers {
    fn code() -> &'static [u8] {
        RECEIVERS
    }
}

/// Constants of `shaders/refine.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refine {
    pub local_size: u32,
    pub team: u32,
    pub teams: u32,
}

impl Default for Refine {
    fn default() -> Self {
        Self {
            local_size: 1,
            team: 8,
            teams: 1,
        }
    }
}

impl Specialized for Refine {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "refine",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::TILES, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::CANDIDATES, access: Access::Read },
            Use { set: 1, binding: frame_set::CANDIDATES_OUT, access: Access::Write },
        ],
        push_bytes: 0,
        invocations: Invocations::Constant,
        by_teams: true,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.local_size)
            .with(1, self.team)
            .with(24, self.teams)
    }
}

impl Compiled for Refine {
    fn code() -> &'static [u8] {
        REFINE
    }
}

/// The set beside the frame's that `shaders/resolve.comp` binds.
pub mod resolve_set {
    use super::{Binding, Kind};

    pub const HOST_IMAGE: Binding = Binding::new(0, "host_image", Kind::SAMPLED_IMAGE, 1);
}

/// Constants of `shaders/resolve.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resolve {
    pub local_size: u32,
    pub team: u32,
    pub block: u32,
    pub layered: bool,
    pub list: u32,
    pub display_codes: bool,
    pub by_lines: bool,
    pub grows: bool,
    pub encoded: bool,
    pub locations: bool,
    pub teams: u32,
    pub cells_of_entry: u32,
    pub tonemap: bool,
    pub tonemap_codes: bool,
}

impl Default for Resolve {
    fn default() -> Self {
        Self {
            local_size: 1,
            team: 8,
            block: 256,
            layered: false,
            list: 0,
            display_codes: false,
            by_lines: false,
            grows: false,
            encoded: false,
            locations: false,
            teams: 1,
            cells_of_entry: 8,
            tonemap: true,
            tonemap_codes: true,
        }
    }
}

impl Specialized for Resolve {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "resolve",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::IDS, access: Access::Read },
            Use { set: 1, binding: frame_set::DISPLAY, access: Access::Read },
            Use { set: 1, binding: frame_set::DISPLAY_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::COLOR, access: Access::Write },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::Read },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Read },
            Use { set: 1, binding: frame_set::TILES, access: Access::Read },
            Use { set: 1, binding: frame_set::TILE_LISTS, access: Access::Read },
            Use { set: 1, binding: frame_set::HEADERS, access: Access::Read },
            Use { set: 1, binding: frame_set::FRAGMENTS, access: Access::Read },
            Use { set: 1, binding: frame_set::SHADED, access: Access::Read },
            Use { set: 1, binding: frame_set::MARKS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::LOCATION_CELLS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATION_GROUPS, access: Access::Read },
            Use { set: 1, binding: frame_set::SPREADS_OUT, access: Access::Write },
            Use { set: 2, binding: resolve_set::HOST_IMAGE, access: Access::Read },
        ],
        push_bytes: 0,
        invocations: Invocations::Constant,
        by_teams: true,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.local_size)
            .with(1, self.team)
            .with(2, self.block)
            .flag(3, self.layered)
            .with(4, self.list)
            .flag(5, self.display_codes)
            .flag(6, self.by_lines)
            .flag(7, self.grows)
            .flag(18, self.encoded)
            .flag(20, self.locations)
            .with(24, self.teams)
            .with(26, self.cells_of_entry)
            .flag(30, self.tonemap)
            .flag(31, self.tonemap_codes)
    }
}

/// Constants of `shaders/sample.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample {
    pub local_size: u32,
    pub team: u32,
    pub per_sample: bool,
    pub has_mask: bool,
    pub list: u32,
    pub left_cells: bool,
    pub by_part: bool,
    pub rows: u32,
    pub part: u32,
    pub apart: bool,
    pub long: bool,
    pub spread: u32,
    pub locations: bool,
    pub points: bool,
    pub instanced: bool,
    pub teams: u32,
    pub cells_of_entry: u32,
}

impl Default for Sample {
    fn default() -> Self {
        Self {
            local_size: 1,
            team: 8,
            per_sample: false,
            has_mask: false,
            list: 0,
            left_cells: false,
            by_part: false,
            rows: 8,
            part: 8,
            apart: false,
            long: false,
            spread: 0,
            locations: false,
            points: false,
            instanced: false,
            teams: 1,
            cells_of_entry: 8,
        }
    }
}

impl Specialized for Sample {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "sample",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::UVS, access: Access::Read },
            Use { set: 1, binding: frame_set::COLORS, access: Access::Read },
            Use { set: 1, binding: frame_set::MATERIALS, access: Access::Read },
            Use { set: 1, binding: frame_set::ALPHA_ATLAS, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::IDS, access: Access::Read },
            Use { set: 1, binding: frame_set::DISPLAY, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Read },
            Use { set: 1, binding: frame_set::TILES, access: Access::Read },
            Use { set: 1, binding: frame_set::TILE_LISTS, access: Access::Read },
            Use { set: 1, binding: frame_set::CANDIDATES, access: Access::Read },
            Use { set: 1, binding: frame_set::HEADERS, access: Access::Write },
            Use { set: 1, binding: frame_set::FRAGMENTS_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::PATTERN_OFFSETS, access: Access::Read },
            Use { set: 1, binding: frame_set::MARKS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATION_CELLS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATION_GROUPS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATION_ORDER, access: Access::Read },
        ],
        push_bytes: 0,
        invocations: Invocations::Constant,
        by_teams: true,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.local_size)
            .with(1, self.team)
            .flag(2, self.per_sample)
            .flag(3, self.has_mask)
            .with(4, self.list)
            .flag(5, self.left_cells)
            .flag(6, self.by_part)
            .with(7, self.rows)
            .with(8, self.part)
            .flag(9, self.apart)
            .flag(12, self.long)
            .with(13, self.spread)
            .flag(20, self.locations)
            .flag(21, self.points)
            .flag(23, self.instanced)
            .with(24, self.teams)
            .with(26, self.cells_of_entry)
    }
}

/// Constants of `shaders/sample_lines.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleLines {
    pub local_size: u32,
    pub team: u32,
    pub has_mask: bool,
    pub list: u32,
    pub by_part: bool,
    pub part: u32,
    pub apart: bool,
    pub header: u32,
    pub lines: u32,
    pub spread: u32,
    pub locations: bool,
    pub instanced: bool,
    pub teams: u32,
    pub cells_of_entry: u32,
}

impl Default for SampleLines {
    fn default() -> Self {
        Self {
            local_size: 1,
            team: 8,
            has_mask: false,
            list: 0,
            by_part: false,
            part: 4,
            apart: false,
            header: 64,
            lines: 16,
            spread: 0,
            locations: false,
            instanced: false,
            teams: 1,
            cells_of_entry: 8,
        }
    }
}

impl Specialized for SampleLines {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "sample_lines",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::UVS, access: Access::Read },
            Use { set: 1, binding: frame_set::COLORS, access: Access::Read },
            Use { set: 1, binding: frame_set::MATERIALS, access: Access::Read },
            Use { set: 1, binding: frame_set::ALPHA_ATLAS, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::IDS, access: Access::Read },
            Use { set: 1, binding: frame_set::DISPLAY, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Read },
            Use { set: 1, binding: frame_set::TILES, access: Access::Read },
            Use { set: 1, binding: frame_set::TILE_LISTS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::CANDIDATES, access: Access::Read },
            Use { set: 1, binding: frame_set::HEADERS, access: Access::Write },
            Use { set: 1, binding: frame_set::FRAGMENTS_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::MARKS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::LOCATIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATION_CELLS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATION_GROUPS, access: Access::Read },
        ],
        push_bytes: 0,
        invocations: Invocations::Constant,
        by_teams: true,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.local_size)
            .with(1, self.team)
            .flag(3, self.has_mask)
            .with(4, self.list)
            .flag(6, self.by_part)
            .with(8, self.part)
            .flag(9, self.apart)
            .with(10, self.header)
            .with(11, self.lines)
            .with(13, self.spread)
            .flag(20, self.locations)
            .flag(23, self.instanced)
            .with(24, self.teams)
            .with(26, self.cells_of_entry)
    }
}

impl Compiled for SampleLines {
    fn code() -> &'static [u8] {
        SAMPLE_LINES
    }
}

/// What is pushed to `shaders/scatter.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ScatterPush {
    pub step: u32,
    pub every: u32,
}

/// Constants of `shaders/scatter.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scatter {
    pub team: u32,
    pub has_mask: bool,
    pub has_blend: bool,
    pub rows: u32,
    pub locations: bool,
    pub points: bool,
    pub instanced: bool,
    pub teams: u32,
    pub cells_of_entry: u32,
}

impl Default for Scatter {
    fn default() -> Self {
        Self {
            team: 8,
            has_mask: false,
            has_blend: false,
            rows: 8,
            locations: false,
            points: false,
            instanced: false,
            teams: 1,
            cells_of_entry: 8,
        }
    }
}

impl Specialized for Scatter {
    type Push = ScatterPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "scatter",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::UVS, access: Access::Read },
            Use { set: 1, binding: frame_set::COLORS, access: Access::Read },
            Use { set: 1, binding: frame_set::MATERIALS, access: Access::Read },
            Use { set: 1, binding: frame_set::ALPHA_ATLAS, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Read },
            Use { set: 1, binding: frame_set::TILES, access: Access::Read },
            Use { set: 1, binding: frame_set::TILE_LISTS, access: Access::Read },
            Use { set: 1, binding: frame_set::CANDIDATES_OUT, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::PATTERN_OFFSETS, access: Access::Read },
            Use { set: 1, binding: frame_set::PAIRS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATION_CELLS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATION_GROUPS, access: Access::Read },
            Use { set: 1, binding: frame_set::TILE_LOADS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATION_ORDER, access: Access::Read },
        ],
        push_bytes: 8,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(1, self.team)
            .flag(2, self.has_mask)
            .flag(3, self.has_blend)
            .with(5, self.rows)
            .flag(20, self.locations)
            .flag(21, self.points)
            .flag(23, self.instanced)
            .with(24, self.teams)
            .with(26, self.cells_of_entry)
    }
}

impl Compiled for Scatter {
    fn code() -> &'static [u8] {
        SCATTER
    }
}

/// What is pushed to `shaders/schedule.comp`.
pub type SchedulePush = EnlistPush;

/// Constants of `shaders/schedule.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Schedule {
    pub local_size: u32,
    pub team: u32,
    pub locations: bool,
    pub points: bool,
    pub teams: u32,
    pub cells_of_entry: u32,
}

impl Default for Schedule {
    fn default() -> Self {
        Self {
            local_size: 1,
            team: 8,
            locations: false,
            points: false,
            teams: 1,
            cells_of_entry: 8,
        }
    }
}

impl Specialized for Schedule {
    type Push = SchedulePush;

    const INTERFACE: &'static Interface = &Interface {
        name: "schedule",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Read },
            Use { set: 1, binding: frame_set::TILES, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::ARGUMENTS, access: Access::Write },
            Use { set: 1, binding: frame_set::TILE_LOADS, access: Access::Read },
        ],
        push_bytes: 36,
        invocations: Invocations::Constant,
        by_teams: true,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.local_size)
            .with(1, self.team)
            .flag(20, self.locations)
            .flag(21, self.points)
            .with(24, self.teams)
            .with(26, self.cells_of_entry)
    }
}

impl Compiled for Schedule {
    fn code() -> &'static [u8] {
        SCHEDULE
    }
}

/// Constants of `shaders/setup.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setup {
    pub scanned: bool,
    pub instanced: bool,
}

impl Default for Setup {
    fn default() -> Self {
        Self {
            scanned: false,
            instanced: false,
        }
    }
}

impl Specialized for Setup {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "setup",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::Read },
            Use { set: 1, binding: frame_set::TILES, access: Access::Read },
            Use { set: 1, binding: frame_set::CANDIDATES_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::PAIRS, access: Access::Read },
        ],
        push_bytes: 0,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(0, self.scanned)
            .flag(23, self.instanced)
    }
}

impl Compiled for Setup {
    fn code() -> &'static [u8] {
        SETUP
    }
}

/// An element of the buffer `lights`, as in `shaders/shade.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Light {
    pub position_range: [f32; 4],
    pub direction_kind: [f32; 4],
    pub color_scale: [f32; 4],
    pub offset: [f32; 4],
}

/// What is pushed to `shaders/shade.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ShadePush {
    pub bin: u32,
}

/// The set beside the frame's that `shaders/shade.comp` binds.
pub mod shade_set {
    use super::{Binding, Kind};

    pub const TEXTURES: Binding = Binding::new(0, "textures", Kind::COMBINED_IMAGE_SAMPLER, 15);
}

/// Constants of `shaders/shade.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shade {
    pub pixels: bool,
    pub one_bin: bool,
    pub display_codes: bool,
    pub textured: bool,
    pub vertex_colors: bool,
    pub unlit: bool,
    pub punctual: bool,
    pub local_lights: bool,
    pub blended: bool,
    pub one_uv_transform: bool,
    pub box_filter: bool,
    pub tinted: bool,
    pub environment: bool,
    pub one_texture_size: bool,
    pub locations: bool,
    pub instanced: bool,
    pub shadow_words: u32,
    pub tonemap: bool,
    pub tonemap_codes: bool,
    pub specular: bool,
    pub clearcoat: bool,
    pub sheen: bool,
    pub anisotropy: bool,
    pub iridescence: bool,
    pub diffuse_transmission: bool,
    pub transmission: bool,
    pub specular_glossiness: bool,
    pub base_color_texture: u32,
    pub metallic_roughness_texture: u32,
    pub normal_texture: u32,
    pub occlusion_texture: u32,
    pub emissive_texture: u32,
    pub specular_texture: u32,
    pub specular_color_texture: u32,
    pub clearcoat_texture: u32,
    pub clearcoat_roughness_texture: u32,
    pub clearcoat_normal_texture: u32,
    pub sheen_color_texture: u32,
    pub sheen_roughness_texture: u32,
    pub anisotropy_texture: u32,
    pub iridescence_texture: u32,
    pub iridescence_thickness_texture: u32,
    pub diffuse_transmission_texture: u32,
    pub diffuse_transmission_color_texture: u32,
    pub transmission_texture: u32,
    pub thickness_texture: u32,
    pub specular_glossiness_texture: u32,
}

impl Default for Shade {
    fn default() -> Self {
        Self {
            pixels: false,
            one_bin: false,
            display_codes: false,
            textured: false,
            vertex_colors: false,
            unlit: false,
            punctual: false,
            local_lights: false,
            blended: false,
            one_uv_transform: false,
            box_filter: false,
            tinted: false,
            environment: false,
            one_texture_size: false,
            locations: false,
            instanced: false,
            shadow_words: 0,
            tonemap: true,
            tonemap_codes: true,
            specular: false,
            clearcoat: false,
            sheen: false,
            anisotropy: false,
            iridescence: false,
            diffuse_transmission: false,
            transmission: false,
            specular_glossiness: false,
            base_color_texture: 0,
            metallic_roughness_texture: 0,
            normal_texture: 0,
            occlusion_texture: 0,
            emissive_texture: 0,
            specular_texture: 0,
            specular_color_texture: 0,
            clearcoat_texture: 0,
            clearcoat_roughness_texture: 0,
            clearcoat_normal_texture: 0,
            sheen_color_texture: 0,
            sheen_roughness_texture: 0,
            anisotropy_texture: 0,
            iridescence_texture: 0,
            iridescence_thickness_texture: 0,
            diffuse_transmission_texture: 0,
            diffuse_transmission_color_texture: 0,
            transmission_texture: 0,
            thickness_texture: 0,
            specular_glossiness_texture: 0,
        }
    }
}

impl Specialized for Shade {
    type Push = ShadePush;

    const INTERFACE: &'static Interface = &Interface {
        name: "shade",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::NORMALS, access: Access::Read },
            Use { set: 1, binding: frame_set::TANGENTS, access: Access::Read },
            Use { set: 1, binding: frame_set::UVS, access: Access::Read },
            Use { set: 1, binding: frame_set::COLORS, access: Access::Read },
            Use { set: 1, binding: frame_set::MATERIALS, access: Access::Read },
            Use { set: 1, binding: frame_set::LIGHTS, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::IDS, access: Access::Read },
            Use { set: 1, binding: frame_set::DISPLAY_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::COLOR, access: Access::Write },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::Read },
            Use { set: 1, binding: frame_set::FRAGMENTS, access: Access::Read },
            Use { set: 1, binding: frame_set::SHADED_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::SHADE_ORDER, access: Access::Read },
            Use { set: 1, binding: frame_set::BINS, access: Access::Read },
            Use { set: 1, binding: frame_set::LOCATIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::ENVIRONMENT_MAP, access: Access::Read },
            Use { set: 1, binding: frame_set::SHADOW_WORDS, access: Access::Read },
            Use { set: 2, binding: shade_set::TEXTURES, access: Access::Read },
        ],
        push_bytes: 4,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(0, self.pixels)
            .flag(1, self.one_bin)
            .flag(2, self.display_codes)
            .flag(3, self.textured)
            .flag(8, self.vertex_colors)
            .flag(9, self.unlit)
            .flag(10, self.punctual)
            .flag(11, self.local_lights)
            .flag(12, self.blended)
            .flag(14, self.one_uv_transform)
            .flag(15, self.box_filter)
            .flag(16, self.tinted)
            .flag(17, self.environment)
            .flag(19, self.one_texture_size)
            .flag(20, self.locations)
            .flag(23, self.instanced)
            .with(25, self.shadow_words)
            .flag(30, self.tonemap)
            .flag(31, self.tonemap_codes)
            .flag(32, self.specular)
            .flag(33, self.clearcoat)
            .flag(34, self.sheen)
            .flag(35, self.anisotropy)
            .flag(36, self.iridescence)
            .flag(37, self.diffuse_transmission)
            .flag(38, self.transmission)
            .flag(39, self.specular_glossiness)
            .with(40, self.base_color_texture)
            .with(41, self.metallic_roughness_texture)
            .with(42, self.normal_texture)
            .with(43, self.occlusion_texture)
            .with(44, self.emissive_texture)
            .with(45, self.specular_texture)
            .with(46, self.specular_color_texture)
            .with(47, self.clearcoat_texture)
            .with(48, self.clearcoat_roughness_texture)
            .with(49, self.clearcoat_normal_texture)
            .with(50, self.sheen_color_texture)
            .with(51, self.sheen_roughness_texture)
            .with(52, self.anisotropy_texture)
            .with(53, self.iridescence_texture)
            .with(54, self.iridescence_thickness_texture)
            .with(55, self.diffuse_transmission_texture)
            .with(56, self.diffuse_transmission_color_texture)
            .with(57, self.transmission_texture)
            .with(58, self.thickness_texture)
            .with(59, self.specular_glossiness_texture)
    }
}

impl Compiled for Shade {
    fn code() -> &'static [u8] {
        SHADE
    }
}

/// What is pushed to `shaders/sort.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct SortPush {
    pub scatter: u32,
}

/// Constants of `shaders/sort.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sort {
    pub local_size: u32,
    pub team: u32,
    pub instanced: bool,
    pub teams: u32,
}

impl Default for Sort {
    fn default() -> Self {
        Self {
            local_size: 1,
            team: 8,
            instanced: false,
            teams: 1,
        }
    }
}

impl Specialized for Sort {
    type Push = SortPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "sort",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::Read },
            Use { set: 1, binding: frame_set::FRAGMENTS, access: Access::Read },
            Use { set: 1, binding: frame_set::SHADE_ORDER, access: Access::Write },
            Use { set: 1, binding: frame_set::BINS, access: Access::ReadWrite },
        ],
        push_bytes: 4,
        invocations: Invocations::Constant,
        by_teams: true,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.local_size)
            .with(1, self.team)
            .flag(23, self.instanced)
            .with(24, self.teams)
    }
}

impl Compiled for Sort {
    fn code() -> &'static [u8] {
        SORT
    }
}

/// What is pushed to `shaders/spans.comp`.
pub type SpansPush = SortPush;

/// Constants of `shaders/spans.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spans {
    pub local_size: u32,
    pub team: u32,
    pub one_bin: bool,
    pub instanced: bool,
    pub teams: u32,
}

impl Default for Spans {
    fn default() -> Self {
        Self {
            local_size: 1,
            team: 8,
            one_bin: false,
            instanced: false,
            teams: 1,
        }
    }
}

impl Specialized for Spans {
    type Push = SpansPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "spans",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::IDS, access: Access::Read },
            Use { set: 1, binding: frame_set::SHADE_ORDER, access: Access::Write },
            Use { set: 1, binding: frame_set::BINS, access: Access::ReadWrite },
        ],
        push_bytes: 4,
        invocations: Invocations::Constant,
        by_teams: true,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.local_size)
            .with(1, self.team)
            .flag(2, self.one_bin)
            .flag(23, self.instanced)
            .with(24, self.teams)
    }
}

impl Compiled for Spans {
    fn code() -> &'static [u8] {
        SPANS
    }
}

/// What is pushed to `shaders/stroke.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct StrokePush {
    pub right: [f32; 4],
    pub down: [f32; 4],
    pub corners: u32,
    pub half_edge: f32,
    pub apart: f32,
    pub edges: u32,
}

/// `shaders/stroke.comp`, which has no constants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stroke;

impl Specialized for Stroke {
    type Push = StrokePush;

    const INTERFACE: &'static Interface = &Interface {
        name: "stroke",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::NORMALS_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::STROKES, access: Access::Read },
        ],
        push_bytes: 48,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
    }
}

impl Compiled for Stroke {
    fn code() -> &'static [u8] {
        STROKE
    }
}

/// The set beside the frame's that `shaders/take.comp` binds.
pub mod take_set {
    use super::{Binding, Kind};

    pub const HOST_IMAGE: Binding = Binding::new(0, "host_image", Kind::SAMPLED_IMAGE, 1);
}

/// Constants of `shaders/take.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Take {
    pub encoded: bool,
    pub tonemap: bool,
    pub tonemap_codes: bool,
}

impl Default for Take {
    fn default() -> Self {
        Self {
            encoded: false,
            tonemap: true,
            tonemap_codes: true,
        }
    }
}

impl Specialized for Take {
    type Push = ();

    const INTERFACE: &'static Interface = &Interface {
        name: "take",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::DISPLAY_OUT, access: Access::Write },
            Use { set: 1, binding: frame_set::COLOR, access: Access::Write },
            Use { set: 2, binding: take_set::HOST_IMAGE, access: Access::Read },
        ],
        push_bytes: 0,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(18, self.encoded)
            .flag(30, self.tonemap)
            .flag(31, self.tonemap_codes)
    }
}

impl Compiled for Take {
    fn code() -> &'static [u8] {
        TAKE
    }
}

/// What is pushed to `shaders/tally.comp`.
pub type TallyPush = EnlistPush;

/// Constants of `shaders/tally.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tally {
    pub local_size: u32,
    pub team: u32,
    pub locations: bool,
    pub points: bool,
    pub teams: u32,
    pub cells_of_entry: u32,
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            local_size: 1,
            team: 8,
            locations: false,
            points: false,
            teams: 1,
            cells_of_entry: 8,
        }
    }
}

impl Specialized for Tally {
    type Push = TallyPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "tally",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::MASKS, access: Access::Read },
            Use { set: 1, binding: frame_set::TILES, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::TILE_LOADS, access: Access::Read },
        ],
        push_bytes: 36,
        invocations: Invocations::Constant,
        by_teams: true,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .with(0, self.local_size)
            .with(1, self.team)
            .flag(20, self.locations)
            .flag(21, self.points)
            .with(24, self.teams)
            .with(26, self.cells_of_entry)
    }
}

impl Compiled for Tally {
    fn code() -> &'static [u8] {
        TALLY
    }
}

/// What is pushed to `shaders/thin.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ThinPush {
    pub long: u32,
    pub depth_factor: f32,
    pub depth_constant: f32,
}

/// Constants of `shaders/thin.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Thin {
    pub select: bool,
    pub blend_ids: bool,
    pub folds: bool,
    pub instanced: bool,
}

impl Default for Thin {
    fn default() -> Self {
        Self {
            select: false,
            blend_ids: false,
            folds: false,
            instanced: false,
        }
    }
}

impl Specialized for Thin {
    type Push = ThinPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "thin",
        in_frame: true,
        uses: &[
            Use { set: 0, binding: frame_set::FRAME, access: Access::Read },
            Use { set: 1, binding: frame_set::POSITIONS, access: Access::Read },
            Use { set: 1, binding: frame_set::TRIANGLES, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCE_OF, access: Access::Read },
            Use { set: 1, binding: frame_set::INSTANCES, access: Access::Read },
            Use { set: 1, binding: frame_set::IDS, access: Access::Read },
            Use { set: 1, binding: frame_set::BLEND_IDS, access: Access::Read },
            Use { set: 1, binding: frame_set::COUNTERS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::SURVIVORS, access: Access::ReadWrite },
            Use { set: 1, binding: frame_set::RASTER_DEPTH, access: Access::Read },
            Use { set: 1, binding: frame_set::MARKS, access: Access::ReadWrite },
        ],
        push_bytes: 12,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(0, self.select)
            .flag(1, self.blend_ids)
            .flag(2, self.folds)
            .flag(23, self.instanced)
    }
}

impl Compiled for Thin {
    fn code() -> &'static [u8] {
        THIN
    }
}

/// What is pushed to `shaders/transform.comp`.
pub type TransformPush = CoordinatesPush;

/// The set of its own that `shaders/transform.comp` binds.
pub mod transform_set {
    use super::{Binding, Kind};

    pub const DRAWS: Binding = Binding::new(0, "draws", Kind::STORAGE_BUFFER, 1);
    pub const VERTICES: Binding = Binding::new(1, "vertices", Kind::STORAGE_BUFFER, 1);
    pub const MATRICES: Binding = Binding::new(2, "matrices", Kind::STORAGE_BUFFER, 1);
    pub const POSITIONS_OUT: Binding = Binding::new(3, "positions_out", Kind::STORAGE_BUFFER, 1);
}

/// Constants of `shaders/transform.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transform {
    pub object: bool,
    pub vertex_format: u32,
}

impl Default for Transform {
    fn default() -> Self {
        Self {
            object: false,
            vertex_format: 0,
        }
    }
}

impl Specialized for Transform {
    type Push = TransformPush;

    const INTERFACE: &'static Interface = &Interface {
        name: "transform",
        in_frame: false,
        uses: &[
            Use { set: 0, binding: transform_set::DRAWS, access: Access::Read },
            Use { set: 0, binding: transform_set::VERTICES, access: Access::Read },
            Use { set: 0, binding: transform_set::MATRICES, access: Access::Read },
            Use { set: 0, binding: transform_set::POSITIONS_OUT, access: Access::Write },
        ],
        push_bytes: 56,
        invocations: Invocations::Fixed(64),
        by_teams: false,
    };

    fn constants(&self) -> Constants {
        Constants::new()
            .flag(0, self.object)
            .with(60, self.vertex_format)
    }
}

impl Compiled for Transform {
    fn code() -> &'static [u8] {
        TRANSFORM
    }
}

/// Interfaces of all shaders.
pub const INTERFACES: [&Interface; 47] = [
    Adopt::INTERFACE,
    AlphaMap::INTERFACE,
    Arguments::INTERFACE,
    Attributes::INTERFACE,
    Bin::INTERFACE,
    BoxFilter::INTERFACE,
    Centres::INTERFACE,
    Composite::INTERFACE,
    Coordinates::INTERFACE,
    Crossings::INTERFACE,
    Cull::INTERFACE,
    Detect::INTERFACE,
    Distribute::INTERFACE,
    Encode::INTERFACE,
    Enlist::INTERFACE,
    Filter::INTERFACE,
    Groups::INTERFACE,
    Grow::INTERFACE,
    Indirect::INTERFACE,
    Merge::INTERFACE,
    Multisample::INTERFACE,
    Neighbours::INTERFACE,
    Occlude::INTERFACE,
    PatchFragment::INTERFACE,
    PatchVertex::INTERFACE,
    PixelFilter::INTERFACE,
    Points::INTERFACE,
    Pose::INTERFACE,
    Prefilter::INTERFACE,
    RasterFragment::INTERFACE,
    RasterVertex::INTERFACE,
    Receivers::INTERFACE,
    Refine::INTERFACE,
    Resolve::INTERFACE,
    Sample::INTERFACE,
    SampleLines::INTERFACE,
    Scatter::INTERFACE,
    Schedule::INTERFACE,
    Setup::INTERFACE,
    Shade::INTERFACE,
    Sort::INTERFACE,
    Spans::INTERFACE,
    Stroke::INTERFACE,
    Take::INTERFACE,
    Tally::INTERFACE,
    Thin::INTERFACE,
    Transform::INTERFACE,
];

/// What passes count, a word each, as `shaders/include/interface.glsl` describes it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Counters {
    pub superpixels: u32,
    pub tiles: u32,
    pub survivors: u32,
    pub large: u32,
    pub outside: u32,
    pub backfacing: u32,
    pub degenerate: u32,
    pub untouching: u32,
    pub round_first: u32,
    pub next_tile: u32,
    pub unfinished: u32,
    pub fragments: u32,
    pub plain_tiles: u32,
    pub masked_tiles: u32,
    pub blended_tiles: u32,
    pub unlisted_tiles: u32,
    pub rounds: u32,
    pub candidates_total: u32,
    pub fragments_total: u32,
    pub shaded_total: u32,
    pub unlisted_total: u32,
    pub pairs: u32,
    pub thin: u32,
    pub resampled: u32,
    pub plain_left: u32,
    pub masked_left: u32,
    pub blended_left: u32,
    pub stalled: u32,
    pub placed: u32,
    pub left_out: u32,
    pub cells: u32,
    pub groups: u32,
    pub reach: u32,
    pub widest: u32,
    pub thin_long: u32,
    pub waiting: u32,
    pub owners: u32,
    pub layers: u32,
    pub most_cells: u32,
    pub refined: u32,
}

/// Their places among the words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum Counter {
    Superpixels,
    Tiles,
    Survivors,
    Large,
    Outside,
    Backfacing,
    Degenerate,
    Untouching,
    RoundFirst,
    NextTile,
    Unfinished,
    Fragments,
    PlainTiles,
    MaskedTiles,
    BlendedTiles,
    UnlistedTiles,
    Rounds,
    CandidatesTotal,
    FragmentsTotal,
    ShadedTotal,
    UnlistedTotal,
    Pairs,
    Thin,
    Resampled,
    PlainLeft,
    MaskedLeft,
    BlendedLeft,
    Stalled,
    Placed,
    LeftOut,
    Cells,
    Groups,
    Reach,
    Widest,
    ThinLong,
    Waiting,
    Owners,
    Layers,
    MostCells,
    Refined,
}

/// Indices of indirect dispatches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Argument {
    Cull = 0,
    BinSmall = 1,
    BinLarge = 2,
    Setup = 3,
    SamplePlain = 4,
    SampleMasked = 5,
    SampleBlended = 6,
    SampleUnlisted = 7,
    Sort = 8,
    Thin = 9,
    Groups = 10,
    PlainLeft = 11,
    MaskedLeft = 12,
    BlendedLeft = 13,
    Tally = 14,
    Enlist = 15,
    ThinLong = 16,
    Owners = 17,
    Scatter = 18,
    ScatterEvery = 19,
    Layers = 20,
    Fragments = 21,
    ResolvePlain = 22,
    ResolveMasked = 23,
    ResolveBlended = 24,
    ResolveUnlisted = 25,
    BinBusy = 26,
    Shade = 27,
}

impl Argument {
    /// Their names, in their order.
    pub const NAMES: &[&str] = &[
        "cull",
        "bin small",
        "bin large",
        "setup",
        "sample plain",
        "sample masked",
        "sample blended",
        "sample unlisted",
        "sort",
        "thin",
        "groups",
        "plain left",
        "masked left",
        "blended left",
        "tally",
        "enlist",
        "thin long",
        "owners",
        "scatter",
        "scatter every",
        "layers",
        "fragments",
        "resolve plain",
        "resolve masked",
        "resolve blended",
        "resolve unlisted",
        "bin busy",
        "shade",
    ];
}

pub const AFTER_DETECT: u32 = 0;
pub const AFTER_CULL: u32 = 1;
pub const AFTER_SAMPLE: u32 = 2;
pub const AFTER_FRAGMENTS: u32 = 3;
pub const AFTER_SPANS: u32 = 4;
pub const AFTER_THIN: u32 = 5;
pub const AFTER_GROUPS: u32 = 6;
pub const AFTER_LINES: u32 = 7;
pub const AFTER_PAIRS: u32 = 8;
pub const AFTER_SCATTER: u32 = 9;
pub const DETECT_CONTRAST: u32 = 0;
pub const DETECT_EDGES: u32 = 1;
pub const DETECT_EXACT: u32 = 2;
pub const DETECT_BLENDED: u32 = 3;
pub const DETECT_EVERY: u32 = 4;
pub const DETECT_SECOND_DIFFERENCES: u32 = 5;
pub const BIN_BUSY: u32 = 0;
pub const BIN_SMALL: u32 = 1;
pub const BIN_LARGE: u32 = 2;
pub const DISTRIBUTE_NUMBER: u32 = 0;
pub const DISTRIBUTE_LAY_OUT: u32 = 1;
pub const DISTRIBUTE_ARRANGE: u32 = 2;
pub const DISTRIBUTE_ENCLOSE: u32 = 3;
pub const INDIRECT_COMMANDS: u32 = 0;
pub const INDIRECT_BLOCKS: u32 = 1;
pub const INDIRECT_SUMS: u32 = 2;
pub const INDIRECT_PLACE: u32 = 3;
pub const INDIRECT_BLOCK: u32 = 64;
pub const INDIRECT_COUNTED: u32 = 1;
pub const INDIRECT_INDEXED: u32 = 2;
pub const INDIRECT_OBJECT: u32 = 4;
pub const INDIRECT_ALPHA_TESTED: u32 = 8;
pub const INDIRECT_DOUBLE_SIDED: u32 = 16;
pub const TOTAL_FOUND: u32 = 0;
pub const TOTAL_PLACED: u32 = 1;
pub const TOTAL_IMPOSSIBLE: u32 = 2;
pub const TOTAL_TRIANGLES: u32 = 3;
pub const TOTAL_POSITIONS: u32 = 4;
pub const SCATTER_CLEAR: u32 = 0;
pub const SCATTER_DEPTHS: u32 = 1;
pub const SCATTER_IDS: u32 = 2;
pub const SCATTER_COUNT: u32 = 3;
pub const SCATTER_PLACE: u32 = 4;
pub const SCATTER_LAYERS: u32 = 5;
pub const SCATTER_ORDER: u32 = 6;
pub const SPREAD_NONE: u32 = 0;
pub const SPREAD_SQUARE: u32 = 1;
pub const SPREAD_ABSOLUTE: u32 = 2;
pub const SPREAD_VECTORS: u32 = 4;
pub const ENCODE_RGBA8_SRGB: u32 = 0;
pub const ENCODE_RGBA16F: u32 = 1;
pub const ENCODE_STRAIGHT_RGBA8: u32 = 2;
pub const ENCODE_THRESHOLD_WORDS: u32 = 1024;
pub const ENCODE_THRESHOLDS: u32 = 255;
pub const TILE_LIST_PLAIN: u32 = 0;
pub const TILE_LIST_MASKED: u32 = 1;
pub const TILE_LIST_BLENDED: u32 = 2;
pub const TILE_LIST_UNLISTED: u32 = 3;
pub const TILE_LISTS: u32 = 4;
pub const VERTEX_FLOAT: u32 = 0;
pub const VERTEX_HALF: u32 = 1;
pub const VERTEX_UNORM: u32 = 2;
pub const VERTEX_SNORM: u32 = 3;
pub const TOPOLOGY_LIST: u32 = 0;
pub const TOPOLOGY_STRIP: u32 = 1;
pub const TOPOLOGY_FAN: u32 = 2;
pub const POSE_FLAT: u32 = 1;
pub const POSE_INSIDE_OUT: u32 = 2;
pub const POSE_TANGENTS: u32 = 4;
pub const CORNER_LEFT: u32 = 0;
pub const CORNER_RIGHT: u32 = 1;
pub const CORNER_JOINT_CENTRE: u32 = 2;
pub const CORNER_JOINT_FIRST: u32 = 3;
pub const CORNER_JOINT_SECOND: u32 = 4;
pub const CORNER_DISC: u32 = 5;
pub const CORNER_FACES_CAMERA: u32 = 2147483648;
pub const EDGE_SMOOTH: u32 = 1;
pub const EDGE_DOUBLE_SIDED: u32 = 2;
pub const INSTANCE_MIRRORED: u32 = 1;
pub const ALPHA_TEXTURED: u32 = 1;
pub const ALPHA_NEAREST_MAG: u32 = 2;
pub const ALPHA_NEAREST_MIN: u32 = 4;
pub const ALPHA_NO_MIP: u32 = 8;
pub const ALPHA_NEAREST_MIP: u32 = 16;
pub const WRAP_REPEAT: u32 = 0;
pub const WRAP_MIRRORED_REPEAT: u32 = 1;
pub const WRAP_CLAMP_TO_EDGE: u32 = 2;
pub const SINGLE_PLANE: u32 = 6;
pub const MANY_SAMPLES: u32 = 128;
pub const SHADOW_POINTS: u32 = 4;
pub const LOAD_WORDS: u32 = 35;
pub const THIN_PER_INVOCATION: u32 = 8;
pub const FILTER_TRIANGLES: u32 = 2048;
pub const MATERIAL_BASE_COLOR: u32 = 0;
pub const MATERIAL_EMISSIVE_METALLIC: u32 = 1;
pub const MATERIAL_FACTORS: u32 = 2;
pub const MATERIAL_ALPHA: u32 = 3;
pub const MATERIAL_SPECULAR: u32 = 4;
pub const MATERIAL_CLEARCOAT: u32 = 5;
pub const MATERIAL_SHEEN: u32 = 6;
pub const MATERIAL_ANISOTROPY: u32 = 7;
pub const MATERIAL_IRIDESCENCE: u32 = 8;
pub const MATERIAL_DIFFUSE_TRANSMISSION: u32 = 9;
pub const MATERIAL_TRANSMISSION: u32 = 10;
pub const MATERIAL_VOLUME: u32 = 11;
pub const MATERIAL_SPECULAR_GLOSSINESS: u32 = 12;
pub const MATERIAL_UV_ROWS: u32 = 13;
pub const STRETCH: u32 = 256;
pub const MOST_TRIALS: u32 = 268435456;
pub const FEWEST_TRIED: u32 = 4096;
pub const LONGEST_LIST: u32 = 40000;
pub const SHORT_LIST: u32 = 2500;
pub const SHORT_LAYERED: u32 = 160;
pub const MORE_FRAGMENTS: u32 = 16;
