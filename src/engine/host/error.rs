//! What can be wrong with what a host lends.

use crate::engine::sampler::EngineError;
use crate::vulkan::VulkanError;
use ash::vk;

/// An error of antialiasing a host's frames.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HostError {
    /// The options are impossible, memory runs out, or the driver refuses something.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// A handle is null.
    #[error("{0} is VK_NULL_HANDLE")]
    NullHandle(&'static str),
    /// A count that has to be at least 1 is 0, or more than can be addressed.
    #[error("{what} is {found}; it can be 1 to {most}")]
    Count {
        /// The count.
        what: &'static str,
        /// What it is.
        found: u32,
        /// What it can be.
        most: u32,
    },
    /// A buffer's offset is not a multiple of the size of what it holds.
    #[error("{what} is {offset} bytes; it can be a multiple of {alignment}")]
    Alignment {
        /// The offset.
        what: &'static str,
        /// What it is.
        offset: u64,
        /// What it has to be a multiple of.
        alignment: u64,
    },
    /// Elements lie closer together than they are long, or apart by no whole number of floats.
    #[error("{what} is {found} bytes; it can be any multiple of 4 from {least} on")]
    Stride {
        /// The stride.
        what: &'static str,
        /// What it is.
        found: u32,
        /// The least that it can be.
        least: u32,
    },
    /// Something is wrong with one of several meshes.
    #[error("mesh {mesh}: {error}")]
    Mesh {
        /// The mesh, by its place in the list.
        mesh: usize,
        /// What is wrong with it.
        #[source]
        error: Box<HostError>,
    },
    /// A depth range is empty, or not finite.
    #[error(
        "the depth range goes from {} to {}; its ends have to be finite numbers that differ", .0[0], .0[1]
    )]
    DepthRange([f32; 2]),
    /// A viewport is no rectangle, or lies upside down.
    #[error(
        "the viewport is {width} x {height} pixels at ({x}, {y}); it needs finite numbers, a positive width, and a height that is {height_sign} as ClipSpace::y_up is {y_up}"
    )]
    Viewport {
        /// Its left side.
        x: f32,
        /// Its first row.
        y: f32,
        /// Its width.
        width: f32,
        /// Its height.
        height: f32,
        /// Positive or negative.
        height_sign: &'static str,
        /// Whether y points up in clip space.
        y_up: bool,
    },
    /// A viewport ends within the frame's part of the images: rasterizers draw nothing beyond it, and the library would.
    #[error(
        "the viewport holds the pixels from ({}, {}) to ({}, {}), and the frame is of those from ({}, {}) to ({}, {}): a frame's part of the images has to lie in the viewport; make Options::size smaller, or begin it elsewhere by Images::corner",
        .viewport[0], .viewport[1], .viewport[2], .viewport[3], .part[0], .part[1], .part[2], .part[3]
    )]
    ViewportPart {
        /// Left, upper, right and lower side of the viewport.
        viewport: [f64; 4],
        /// Those of the frame's part.
        part: [u64; 4],
    },
    /// Indices are of a type that is not read.
    #[error("index_type is {found:?}; it can be UINT16 or UINT32")]
    IndexType {
        /// What it is.
        found: vk::IndexType,
    },
    /// The colour image has a format that can't be drawn to or read.
    #[error(
        "a colour image of format {0:?}: it can have 8, 10, 16 or 32 bits a channel as UNORM, SRGB or SFLOAT, or be B10G11R11_UFLOAT"
    )]
    Format(vk::Format),
    /// An image with its own sRGB encoding is said to hold codes.
    #[error("a colour image of format {0:?} holds linear light; it can't be encoded as well")]
    Encoded(vk::Format),
    /// Thin triangles are found by depth.
    #[error(
        "thin triangles are found by depth: lend the depth image, or set Options::thin to false"
    )]
    NoDepth,
    /// The part of the images that the frame is of ends where no image does.
    #[error(
        "the frame's part of the images ends at {} x {} pixels; images have at most {most} on a side", .end[0], .end[1]
    )]
    Part {
        /// Columns and rows before its lower right corner.
        end: [u64; 2],
        /// Most columns or rows of an image on the device.
        most: u32,
    },
    /// Alpha maps are looked up by coordinates.
    #[error("there are alpha maps and no texture coordinates: lend Mesh::coordinates")]
    NoCoordinates,
    /// A draw has an alpha map, and its mesh has no texture coordinates.
    #[error(
        "draw {draw} has an alpha map, and its mesh {mesh} has no texture coordinates: lend Mesh::coordinates"
    )]
    DrawCoordinates {
        /// The draw, by its place in the list.
        draw: usize,
        /// Its mesh.
        mesh: u32,
    },
    /// A draw has a mesh that there is none of.
    #[error("draw {draw} has mesh {mesh}, and there are {meshes}, from 0")]
    NoMesh {
        /// The draw, by its place in the list.
        draw: usize,
        /// Its mesh.
        mesh: u32,
        /// How many there are.
        meshes: usize,
    },
    /// A draw of a mesh without indices takes vertices that it does not have.
    #[error(
        "draw {draw} takes the vertices from {first} to before {end} without indices, and has those from {from} to before {vertices}"
    )]
    Corners {
        /// The draw, by its place in the list.
        draw: usize,
        /// The first vertex that it takes.
        first: i64,
        /// One past the last.
        end: i64,
        /// The first one that it has.
        from: i64,
        /// One past the last.
        vertices: i64,
    },
    /// A coordinate beyond an alpha map leads to what is not read.
    #[error(
        "alpha map {map} has the address mode {found:?}; it can have REPEAT, MIRRORED_REPEAT or CLAMP_TO_EDGE"
    )]
    Address {
        /// The map, by its place in the list.
        map: usize,
        /// Its mode along one axis.
        found: vk::SamplerAddressMode,
    },
    /// A filter between texels or levels is one that is not known.
    #[error("alpha map {map} has the {name} {found}; it can be NEAREST (0) or LINEAR (1)")]
    Filter {
        /// The map, by its place in the list.
        map: usize,
        /// Which filter.
        name: &'static str,
        /// Its value.
        found: i32,
    },
    /// A cutoff is not finite.
    #[error("the cutoff of alpha map {map} is not finite")]
    Cutoff {
        /// The map, by its place in the list.
        map: usize,
    },
    /// Depth is of no use without IDs.
    #[error("depth is lent without IDs: lend both, or neither to have both drawn")]
    NoIds,
    /// The frame was prepared with an image that a recording does not lend.
    #[error(
        "there is no image of {what}: lend it, or prepare the frame without it in ImageKinds::{}", .what.to_lowercase()
    )]
    MissingImage {
        /// IDs or depth.
        what: &'static str,
    },
    /// A recording lends an image that the frame was prepared without.
    #[error(
        "an image of {what} is lent, and the frame was prepared without: set ImageKinds::{}", .what.to_lowercase()
    )]
    UnexpectedImage {
        /// IDs or depth.
        what: &'static str,
    },
    /// A frame has more of something than it was prepared for.
    #[error("{found} {what}; the frame was prepared for {capacity}")]
    Capacity {
        /// Draws, triangles or vertices.
        what: &'static str,
        /// How many there are.
        found: u64,
        /// How many there can be.
        capacity: u32,
    },
    /// A draw reads past the index buffer.
    #[error("draw {draw} reads indices up to {end}, and there are {indices}")]
    Indices {
        /// The draw, by its place in the list.
        draw: usize,
        /// One past its last index.
        end: u64,
        /// How many there are.
        indices: u32,
    },
    /// A draw, of positions in object space, has no vertices, or some that there are none of.
    #[error(
        "draw {draw} has the vertices from {first} to before {end}; it needs at least one, of those from 0 to before {vertices}"
    )]
    Vertices {
        /// The draw, by its place in the list.
        draw: usize,
        /// Its first vertex.
        first: i64,
        /// One past its last.
        end: i64,
        /// How many there are.
        vertices: u32,
    },
    /// A number of a draw's matrix is not finite.
    #[error("the matrix of draw {draw} has a number that is not finite")]
    Matrix {
        /// The draw, by its place in the list.
        draw: usize,
    },
    /// A draw has an alpha map that there is none of.
    #[error("draw {draw} has alpha map {map}, and there are {maps}")]
    AlphaMap {
        /// The draw, by its place in the list.
        draw: usize,
        /// Its map.
        map: u16,
        /// How many there are.
        maps: usize,
    },
    /// An opaque draw comes after one with an alpha map.
    #[error("draw {draw} has no alpha map and comes after one that has: draws without come first")]
    Order {
        /// The draw, by its place in the list.
        draw: usize,
    },
    /// A draw that is not blended comes after one that is.
    #[error("draw {draw} is not blended and comes after one that is: these are the last ones")]
    BlendedOrder {
        /// The draw, by its place in the list.
        draw: usize,
    },
    /// The frame was prepared without blended draws.
    #[error("draw {draw} is blended; prepare the frame with Geometry::blended")]
    NotBlended {
        /// The draw, by its place in the list.
        draw: usize,
    },
    /// A blended draw has an alpha map.
    #[error(
        "draw {draw} is blended and has an alpha map: let its shader store an opacity of 0 instead"
    )]
    BlendedMap {
        /// The draw, by its place in the list.
        draw: usize,
    },
    /// The library shades the centres of pixels by their nearest surface alone.
    #[error(
        "Geometry::blended with Options::shade_all: centres are shaded by the nearest surface alone; draw the colours yourself"
    )]
    BlendedCentres,
    /// The host's colours of pixels that blended draws cover have these in them.
    #[error(
        "Geometry::blended without Options::flat_background: blended draws are composited over Options::background alone; set flat_background and lend the sky as triangles, or draw what is blended after the recording"
    )]
    BlendedBackground,
    /// A draw has a shading key that there is none of.
    #[error("draw {draw} has shading key {key}, and there are {keys}")]
    Key {
        /// The draw, by its place in the list.
        draw: usize,
        /// Its key.
        key: u32,
        /// How many there are.
        keys: u32,
    },
    /// A number of the projection is not finite.
    #[error("the projection matrix has a number that is not finite")]
    Projection,
    /// The projection makes nothing of heights.
    #[error("the projection matrix has a scale of 0 along y: it is projection[1][1], in columns")]
    FlatProjection,
    /// An image is in a layout that holds nothing, or is to be left in one.
    #[error(
        "{what} is in the layout {found:?} {when} the recording; it can be any that keeps what the image holds"
    )]
    Layout {
        /// The image.
        what: &'static str,
        /// Before or after.
        when: &'static str,
        /// The layout.
        found: vk::ImageLayout,
    },
    /// An image has other aspects than are read.
    #[error("{what} has the aspects {found:?}; it can have {possible}")]
    Aspects {
        /// The image.
        what: &'static str,
        /// What was said of it.
        found: vk::ImageAspectFlags,
        /// What can be.
        possible: &'static str,
    },
}

impl From<VulkanError> for HostError {
    fn from(error: VulkanError) -> Self {
        Self::Engine(error.into())
    }
}

impl HostError {
    /// Refuses a count that is 0 or too large.
    pub(super) fn check_count(what: &'static str, found: u32, most: u32) -> Result<(), Self> {
        if (1..=most).contains(&found) {
            Ok(())
        } else {
            Err(Self::Count { what, found, most })
        }
    }
}
