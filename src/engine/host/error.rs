//! Errors of the host interface.

use crate::engine::sampler::EngineError;
use crate::vulkan::VulkanError;
use ash::vk;

/// Error of antialiasing a host's frames or lists.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HostError {
    /// Error of the engine: impossible options, lack of memory, or a refusal by the driver.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// Null handle.
    #[error("{0} is VK_NULL_HANDLE")]
    NullHandle(&'static str),
    /// Count that is 0 or above its limit.
    #[error("{what} is {found}; it can be 1 to {most}")]
    Count {
        /// Name of the count.
        what: &'static str,
        /// Value of the count.
        found: u32,
        /// Largest possible value.
        most: u32,
    },
    /// Buffer offset that is not a multiple of the element size.
    #[error("{what} is {offset} bytes; it can be a multiple of {alignment}")]
    Alignment {
        /// Name of the offset.
        what: &'static str,
        /// Value of the offset in bytes.
        offset: u64,
        /// Required divisor of the offset.
        alignment: u64,
    },
    /// Stride that is smaller than an element, or no multiple of its unit.
    #[error("{what} is {found} bytes; it can be any multiple of {unit} from {least} on")]
    Stride {
        /// Name of the stride.
        what: &'static str,
        /// Value of the stride in bytes.
        found: u32,
        /// Smallest possible stride in bytes.
        least: u32,
        /// Required divisor of the stride.
        unit: u32,
    },
    /// Format of a vertex attribute that shaders of the library can't read.
    #[error(
        "{what} is {found:?}; it can have 32-bit SFLOAT components, or 16-bit SFLOAT, UNORM or SNORM components, {least} or more of them"
    )]
    VertexFormat {
        /// Name of the format.
        what: &'static str,
        /// Format that was given.
        found: vk::Format,
        /// Smallest number of components.
        least: u32,
    },
    /// Scale or bias of a vertex attribute that is not finite.
    #[error("{what} has a scale or a bias that is not finite")]
    VertexScale {
        /// Name of the format.
        what: &'static str,
    },
    /// Format of positions in clip space that are not floats.
    #[error(
        "Mesh::position_format is {found:?} with a scale and a bias; positions in clip space are four floats, as VertexFormat::FLOAT says"
    )]
    ClipFormat {
        /// Format that was given.
        found: vk::Format,
    },
    /// Error in a list of indirect draws.
    #[error("list {list} of indirect draws: {error}")]
    IndirectList {
        /// Index of the list.
        list: usize,
        /// Error in this list.
        #[source]
        error: Box<HostError>,
    },
    /// List of indirect draws whose mesh does not exist.
    #[error("mesh is {mesh}, and there are {meshes}, from 0")]
    IndirectMesh {
        /// Index of the mesh that was given.
        mesh: u32,
        /// Number of meshes.
        meshes: usize,
    },
    /// Orientation of front faces of indirect draws that Vulkan 1.3 does not have.
    #[error("front_face is {found:?}; it can be COUNTER_CLOCKWISE or CLOCKWISE")]
    IndirectFrontFace {
        /// Orientation that was given.
        found: vk::FrontFace,
    },
    /// State of indirect draws for which the rest of the geometry lacks something.
    #[error("the draws are {what}: {remedy}")]
    IndirectState {
        /// State that the draws have.
        what: &'static str,
        /// Advice.
        remedy: &'static str,
    },
    /// Lent IDs with indirect draws, whose triangles' numbers the host does not know.
    #[error(
        "the host lends IDs and there are indirect draws: the library has to draw the IDs, so set ImageKinds::ids to false"
    )]
    IndirectIds,
    /// Error in one of several meshes.
    #[error("mesh {mesh}: {error}")]
    Mesh {
        /// Index of the mesh.
        mesh: usize,
        /// Error in this mesh.
        #[source]
        error: Box<HostError>,
    },
    /// Depth range that is empty or not finite.
    #[error(
        "the depth range goes from {} to {}; its ends have to be finite numbers that differ", .0[0], .0[1]
    )]
    DepthRange([f32; 2]),
    /// Viewport that is no rectangle, or whose height has the wrong sign.
    #[error(
        "the viewport is {width} x {height} pixels at ({x}, {y}); it needs finite numbers, a positive width, and a height that is {height_sign} as ClipSpace::y_up is {y_up}"
    )]
    Viewport {
        /// Left side of the viewport.
        x: f32,
        /// Coordinate y of the viewport, as in `VkViewport`.
        y: f32,
        /// Width of the viewport.
        width: f32,
        /// Height of the viewport.
        height: f32,
        /// Required sign of the height: "positive" or "negative".
        height_sign: &'static str,
        /// Whether y points up in clip space.
        y_up: bool,
    },
    /// Viewport that does not contain the frame's part of the images. Rasterizers draw nothing outside of the viewport,
    /// but the library would.
    #[error(
        "the viewport holds the pixels from ({}, {}) to ({}, {}), and the frame is of those from ({}, {}) to ({}, {}): a frame's part of the images has to lie in the viewport; make Options::size smaller, or begin it elsewhere by Images::corner",
        .viewport[0], .viewport[1], .viewport[2], .viewport[3], .part[0], .part[1], .part[2], .part[3]
    )]
    ViewportPart {
        /// Left, upper, right and lower side of the viewport, in pixels.
        viewport: [f64; 4],
        /// Left, upper, right and lower side of the frame's part, in pixels.
        part: [u64; 4],
    },
    /// Index type that is not supported.
    #[error("index_type is {found:?}; it can be UINT16 or UINT32")]
    IndexType {
        /// Index type that was given.
        found: vk::IndexType,
    },
    /// Format of the colour image that the library can't read or draw to.
    #[error(
        "a colour image of format {0:?}: it can have 8, 10, 16 or 32 bits a channel as UNORM, SRGB or SFLOAT, or be B10G11R11_UFLOAT"
    )]
    Format(vk::Format),
    /// sRGB format of a colour image that is declared as encoded too.
    #[error("a colour image of format {0:?} holds linear light; it can't be encoded as well")]
    Encoded(vk::Format),
    /// Option `thin` without a depth image.
    #[error("thin triangles are found by depth: lend the depth image, or set Options::thin to false")]
    NoDepth,
    /// Frame's part of the images that ends outside of any possible image.
    #[error(
        "the frame's part of the images ends at {} x {} pixels; images have at most {most} on a side", .end[0], .end[1]
    )]
    Part {
        /// Column and row after the last pixel of the part.
        end: [u64; 2],
        /// Largest width and height of an image on the device.
        most: u32,
    },
    /// Alpha maps without texture coordinates in any mesh.
    #[error("there are alpha maps and no texture coordinates: lend Mesh::coordinates")]
    NoCoordinates,
    /// Draw with an alpha map, of a mesh without texture coordinates.
    #[error("draw {draw} has an alpha map, and its mesh {mesh} has no texture coordinates: lend Mesh::coordinates")]
    DrawCoordinates {
        /// Index of the draw.
        draw: usize,
        /// Index of the draw's mesh.
        mesh: u32,
    },
    /// Orientation of front faces that Vulkan 1.3 does not have.
    #[error("front_face of draw {draw} is {found:?}; it can be COUNTER_CLOCKWISE or CLOCKWISE")]
    FrontFace {
        /// Index of the draw.
        draw: usize,
        /// Orientation that was given.
        found: vk::FrontFace,
    },
    /// Draw whose mesh does not exist.
    #[error("draw {draw} has mesh {mesh}, and there are {meshes}, from 0")]
    NoMesh {
        /// Index of the draw.
        draw: usize,
        /// Index of the mesh that was given.
        mesh: u32,
        /// Number of meshes.
        meshes: usize,
    },
    /// Draw without indices that reads vertices outside of its mesh.
    #[error(
        "draw {draw} takes the vertices from {first} to before {end} without indices, by its topology and triangle_count, and has those from {from} to before {vertices}"
    )]
    Corners {
        /// Index of the draw.
        draw: usize,
        /// First vertex that the draw reads.
        first: i64,
        /// Vertex after the last one that the draw reads.
        end: i64,
        /// First vertex of the mesh.
        from: i64,
        /// Vertex after the last one of the mesh.
        vertices: i64,
    },
    /// Address mode of an alpha map that is not supported.
    #[error("alpha map {map} has the address mode {found:?}; it can have REPEAT, MIRRORED_REPEAT or CLAMP_TO_EDGE")]
    Address {
        /// Index of the map.
        map: usize,
        /// Address mode that was given for one of the axes.
        found: vk::SamplerAddressMode,
    },
    /// Filter of an alpha map that is not supported.
    #[error("alpha map {map} has the {name} {found}; it can be NEAREST (0) or LINEAR (1)")]
    Filter {
        /// Index of the map.
        map: usize,
        /// Name of the filter's member.
        name: &'static str,
        /// Value of the filter.
        found: i32,
    },
    /// Cutoff of an alpha map that is not finite.
    #[error("the cutoff of alpha map {map} is not finite")]
    Cutoff {
        /// Index of the map.
        map: usize,
    },
    /// Depth image without an image of IDs.
    #[error("depth is lent without IDs: lend both, or neither to have both drawn")]
    NoIds,
    /// Recording without an image for which the frame was prepared.
    #[error(
        "there is no image of {what}: lend it, or prepare the frame without it in ImageKinds::{}", .what.to_lowercase()
    )]
    MissingImage {
        /// Kind of the image: IDs or depth.
        what: &'static str,
    },
    /// Recording with an image for which the frame was not prepared.
    #[error(
        "an image of {what} is lent, and the frame was prepared without: set ImageKinds::{}", .what.to_lowercase()
    )]
    UnexpectedImage {
        /// Kind of the image: IDs or depth.
        what: &'static str,
    },
    /// Recording that exceeds a capacity of its frame.
    #[error("{found} {what}; the frame was prepared for {capacity}")]
    Capacity {
        /// Name of the things counted: draws, triangles or vertices.
        what: &'static str,
        /// Number in the recording.
        found: u64,
        /// Largest number for which the frame was prepared.
        capacity: u32,
    },
    /// Draw that reads past the end of the index buffer.
    #[error("draw {draw} reads indices up to {end}, and there are {indices}")]
    Indices {
        /// Index of the draw.
        draw: usize,
        /// Index after the last one that the draw reads.
        end: u64,
        /// Number of indices in the buffer.
        indices: u32,
    },
    /// Draw in object space that has no vertices, or vertices outside of its mesh.
    #[error(
        "draw {draw} has the vertices from {first} to before {end}; it needs at least one, of those from 0 to before {vertices}"
    )]
    Vertices {
        /// Index of the draw.
        draw: usize,
        /// First vertex of the draw.
        first: i64,
        /// Vertex after the last one of the draw.
        end: i64,
        /// Number of vertices of the mesh.
        vertices: u32,
    },
    /// Matrix of a draw with a component that is not finite.
    #[error("the matrix of draw {draw} has a number that is not finite")]
    Matrix {
        /// Index of the draw.
        draw: usize,
    },
    /// Draw whose alpha map does not exist.
    #[error("draw {draw} has alpha map {map}, and there are {maps}")]
    AlphaMap {
        /// Index of the draw.
        draw: usize,
        /// Index of the map that was given.
        map: u16,
        /// Number of alpha maps.
        maps: usize,
    },
    /// Draw without an alpha map, after a draw with one.
    #[error("draw {draw} has no alpha map and comes after one that has: draws without come first")]
    Order {
        /// Index of the draw.
        draw: usize,
    },
    /// Draw that is not blended, after a blended one.
    #[error("draw {draw} is not blended and comes after one that is: these are the last ones")]
    BlendedOrder {
        /// Index of the draw.
        draw: usize,
    },
    /// Blended draw in a frame that was prepared without [`Geometry::blended`](super::Geometry::blended).
    #[error("draw {draw} is blended; prepare the frame with Geometry::blended")]
    NotBlended {
        /// Index of the draw.
        draw: usize,
    },
    /// Blended draw with an alpha map.
    #[error("draw {draw} is blended and has an alpha map: let its shader store an opacity of 0 instead")]
    BlendedMap {
        /// Index of the draw.
        draw: usize,
    },
    /// Blended geometry with `shade_all`, which shades pixel centres by their nearest surface only.
    #[error(
        "Geometry::blended with Options::shade_all: centres are shaded by the nearest surface alone; draw the colours yourself"
    )]
    BlendedCentres,
    /// Blended geometry without `flat_background`. The host's colours already contain its blended draws, so that the
    /// library can't composite these over them.
    #[error(
        "Geometry::blended without Options::flat_background: blended draws are composited over Options::background alone; set flat_background and lend the sky as triangles, or draw what is blended after the recording"
    )]
    BlendedBackground,
    /// Draw whose shading key does not exist.
    #[error("draw {draw} has shading key {key}, and there are {keys}")]
    Key {
        /// Index of the draw.
        draw: usize,
        /// Shading key that was given.
        key: u32,
        /// Number of shading keys.
        keys: u32,
    },
    /// Projection matrix with a component that is not finite.
    #[error("the projection matrix has a number that is not finite")]
    Projection,
    /// Projection matrix whose scale along y is 0.
    #[error("the projection matrix has a scale of 0 along y: it is projection[1][1], in columns")]
    FlatProjection,
    /// Image layout that keeps no contents, before or after the recording.
    #[error("{what} is in the layout {found:?} {when} the recording; it can be any that keeps what the image holds")]
    Layout {
        /// Name of the image.
        what: &'static str,
        /// Time of the layout: "before" or "after" the recording.
        when: &'static str,
        /// Layout that was given.
        found: vk::ImageLayout,
    },
    /// Image aspects that are not supported.
    #[error("{what} has the aspects {found:?}; it can have {possible}")]
    Aspects {
        /// Name of the image.
        what: &'static str,
        /// Aspects that were given.
        found: vk::ImageAspectFlags,
        /// Possible aspects, in words.
        possible: &'static str,
    },
}

impl From<VulkanError> for HostError {
    fn from(error: VulkanError) -> Self {
        Self::Engine(error.into())
    }
}

impl HostError {
    /// Checks that a count is from 1 to `most`.
    pub(super) fn check_count(what: &'static str, found: u32, most: u32) -> Result<(), Self> {
        if (1..=most).contains(&found) { Ok(()) } else { Err(Self::Count { what, found, most }) }
    }
}
