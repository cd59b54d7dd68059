//! Errors of the host interface.

use super::Member;
use crate::engine::sampler::EngineError;
use crate::vulkan::VulkanError;
use ash::vk;
use std::error::Error;
use std::fmt::{self, Display, Formatter};

/// Error of antialiasing a host's frames or lists.
#[derive(Debug)]
#[non_exhaustive]
pub enum HostError {
    /// Error of the engine: impossible options, lack of memory, or a refusal by the driver.
    Engine(EngineError),
    /// Error in one element of a list.
    At {
        /// Element with the error.
        place: Place,
        /// Error in this element.
        error: Box<HostError>,
    },
    /// Null handle.
    Null(Member),
    /// Null handle of a lent image.
    NullImage {
        /// Lent image.
        image: Member,
        /// Name of the handle: `image` or `view`.
        handle: &'static str,
    },
    /// Number out of its range.
    Range {
        /// Member with the number.
        member: Member,
        /// Value of the number.
        found: u32,
        /// Smallest possible value.
        least: u32,
        /// Largest possible value.
        most: u32,
    },
    /// Index or key beyond the end of what it chooses from.
    Index {
        /// Member with the index.
        member: Member,
        /// Value of the index.
        found: u32,
        /// Number of possible values.
        count: u32,
        /// Member that determines this number.
        by: Member,
    },
    /// Image with more pixels than devices can process.
    Pixels {
        /// Number of pixels.
        found: u64,
        /// Largest possible number.
        most: u64,
    },
    /// Buffer offset that is not a multiple of the element size.
    Alignment {
        /// Member with the offset.
        member: Member,
        /// Value of the offset in bytes.
        offset: u64,
        /// Required divisor of the offset.
        alignment: u64,
    },
    /// Stride that is smaller than an element, or no multiple of its unit.
    Stride {
        /// Member with the stride.
        member: Member,
        /// Value of the stride in bytes.
        found: u32,
        /// Smallest possible stride in bytes.
        least: u32,
        /// Required divisor of the stride.
        unit: u32,
    },
    /// Buffer of which the draws may read more bytes than the device addresses in one buffer.
    Length {
        /// Member with the buffer.
        member: Member,
        /// Number of bytes that may be read.
        needed: u64,
        /// Limit of the device.
        limit: u64,
    },
    /// Format of a vertex attribute that shaders of the library can't read.
    VertexFormat {
        /// Member with the format.
        member: Member,
        /// Format that was given.
        found: vk::Format,
        /// Smallest number of components.
        least: u32,
    },
    /// Scale or bias of a vertex attribute that is not finite.
    VertexScale(Member),
    /// Format of positions in clip space that are not floats.
    ClipFormat(vk::Format),
    /// Number that is not finite.
    NotFinite(Member),
    /// Value of an enumeration of Vulkan that is not supported.
    Choice {
        /// Member with the value.
        member: Member,
        /// Value that was given.
        found: i32,
        /// Possible values, in words.
        possible: &'static str,
    },
    /// Index type that is not supported.
    IndexType(vk::IndexType),
    /// Depth range that is empty or not finite.
    DepthRange([f32; 2]),
    /// Viewport that is no rectangle, or whose height has the wrong sign.
    Viewport {
        /// Left side of the viewport.
        x: f32,
        /// Coordinate y of the viewport, as in `VkViewport`.
        y: f32,
        /// Width of the viewport.
        width: f32,
        /// Height of the viewport.
        height: f32,
        /// Whether y points up in clip space, so that the height has to be negative.
        y_up: bool,
    },
    /// Viewport that does not contain the frame's part of the images. Rasterizers draw nothing outside of the viewport,
    /// but the library would.
    ViewportPart {
        /// Left, upper, right and lower side of the viewport, in pixels.
        viewport: [f64; 4],
        /// Left, upper, right and lower side of the frame's part, in pixels.
        part: [u64; 4],
    },
    /// Frame's part of the images that ends outside of any possible image.
    Part {
        /// Column and row after the last pixel of the part.
        end: [u64; 2],
        /// Largest width and height of an image on the device.
        most: u32,
    },
    /// Format of the colour image that the library can't read or draw to.
    Format(vk::Format),
    /// sRGB format of a colour image that is declared as encoded too.
    Encoded(vk::Format),
    /// Option `thin` without a depth image.
    NoDepth,
    /// Depth image without an image of IDs.
    NoIds,
    /// Lent IDs with indirect draws, whose triangles' numbers the host does not know.
    IndirectIds,
    /// Recording without an image for which the frame was prepared.
    MissingImage {
        /// The image.
        image: Member,
        /// Member that announces the image.
        kind: Member,
    },
    /// Recording with an image for which the frame was not prepared.
    UnexpectedImage {
        /// The image.
        image: Member,
        /// Member that announces the image.
        kind: Member,
    },
    /// Image layout that keeps no contents, before or after the recording.
    Layout {
        /// The image.
        image: Member,
        /// Name of the state with this layout: `before` or `after` the recording.
        when: &'static str,
        /// Layout that was given.
        found: vk::ImageLayout,
    },
    /// Image aspects that are not supported.
    Aspects {
        /// The image.
        image: Member,
        /// Aspects that were given.
        found: vk::ImageAspectFlags,
        /// Possible aspects, in words.
        possible: &'static str,
    },
    /// Alpha maps without texture coordinates in any mesh.
    NoCoordinates,
    /// Draw with an alpha map, of a mesh without texture coordinates.
    DrawCoordinates {
        /// Index of the draw's mesh.
        mesh: u32,
    },
    /// Draw whose alpha map does not exist.
    AlphaMap {
        /// Index of the map that was given.
        map: u16,
        /// Number of alpha maps.
        maps: usize,
    },
    /// Alpha-tested indirect draws without any alpha map.
    NoAlphaMaps,
    /// Draw without an alpha map, after a draw with one.
    Order,
    /// Draw that is not blended, after a blended one.
    BlendedOrder,
    /// Blended draw in a frame that was prepared without [`Geometry::blended`](super::Geometry::blended).
    NotBlended,
    /// Blended draw with an alpha map.
    BlendedMap,
    /// Blended geometry with `shade_all`, which shades pixel centres by their nearest surface only.
    BlendedCentres,
    /// Blended geometry without `flat_background`. The host's colours already contain its blended draws, so that the
    /// library can't composite these over them.
    BlendedBackground,
    /// Recording that exceeds a capacity of its frame or list.
    Capacity {
        /// Name of the things counted, such as draws.
        counted: &'static str,
        /// Number in the recording.
        found: u64,
        /// Member with the capacity.
        member: Member,
        /// Largest number for which the frame was prepared.
        capacity: u32,
    },
    /// Draw that reads past the end of the index buffer.
    Indices {
        /// Index after the last one that the draw reads.
        end: u64,
        /// Number of indices in the buffer.
        indices: u32,
    },
    /// Draw without indices that reads vertices outside of its mesh.
    Corners {
        /// First vertex that the draw reads, and the one after the last.
        read: [i64; 2],
        /// First vertex that the draw has, and the one after the last.
        held: [i64; 2],
    },
    /// Draw in object space that has no vertices, or vertices outside of its mesh.
    Vertices {
        /// First vertex of the draw, and the one after the last.
        held: [i64; 2],
        /// Number of vertices of the mesh.
        vertices: u32,
    },
    /// Projection matrix whose scale along y is 0.
    FlatProjection,
}

/// Element of a list with an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Mesh of [`Geometry::meshes`](super::Geometry::meshes) with this index.
    Mesh(usize),
    /// Element of [`Geometry::alpha_maps`](super::Geometry::alpha_maps) with this index.
    AlphaMap(usize),
    /// Element of [`Geometry::indirect`](super::Geometry::indirect) with this index.
    Indirect(usize),
    /// Draw of a recording with this index.
    Draw(usize),
}

/// Names that a language gives to the interface, for messages.
pub(crate) trait Dialect: Copy {
    /// Index of the first alpha map in a draw.
    const FIRST_ALPHA_MAP: u32;

    /// Name of a member.
    fn member(self, member: Member) -> impl Display;
    /// Value of a flag.
    fn flag(self, is_set: bool) -> &'static str;
    /// Message of an error in a mesh.
    fn in_mesh(self, mesh: usize, error: &HostError) -> String;
    /// Message of an error that is about no member of this module.
    fn engine(self, error: &EngineError) -> String;
}

/// The names in Rust.
#[derive(Clone, Copy)]
struct Rust;

impl Dialect for Rust {
    const FIRST_ALPHA_MAP: u32 = 0;

    fn member(self, member: Member) -> impl Display {
        member
    }

    fn flag(self, is_set: bool) -> &'static str {
        if is_set { "true" } else { "false" }
    }

    fn in_mesh(self, mesh: usize, error: &HostError) -> String {
        format!("{}[{mesh}]: {error}", Member::Meshes)
    }

    fn engine(self, error: &EngineError) -> String {
        error.to_string()
    }
}

impl Display for HostError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message(Rust))
    }
}

impl Error for HostError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Engine(error) => error.source(),
            Self::At { error, .. } => Some(error),
            _ => None,
        }
    }
}

impl From<EngineError> for HostError {
    fn from(error: EngineError) -> Self {
        Self::Engine(error)
    }
}

impl From<VulkanError> for HostError {
    fn from(error: VulkanError) -> Self {
        Self::Engine(error.into())
    }
}

impl HostError {
    /// The error, in an element of a list.
    pub(super) fn at(self, place: Place) -> Self {
        Self::At { place, error: Box::new(self) }
    }

    /// Checks that a count is from 1 to `most`.
    pub(super) fn check_count(member: Member, found: u32, most: u32) -> Result<(), Self> {
        if (1..=most).contains(&found) { Ok(()) } else { Err(Self::Range { member, found, least: 1, most }) }
    }

    /// Checks that an offset is a multiple of `alignment`.
    pub(super) fn check_offset(member: Member, offset: u64, alignment: u64) -> Result<(), Self> {
        if offset.is_multiple_of(alignment) { Ok(()) } else { Err(Self::Alignment { member, offset, alignment }) }
    }

    /// Checks that a stride is a multiple of `unit` from `least` on.
    pub(super) fn check_stride(member: Member, found: u32, least: u32, unit: u32) -> Result<(), Self> {
        let fits = found.is_multiple_of(unit) && found >= least;
        if fits { Ok(()) } else { Err(Self::Stride { member, found, least, unit }) }
    }

    /// Message with the names of a language.
    pub(crate) fn message<D: Dialect>(&self, names: D) -> String {
        use Member as M;
        let name = |member| names.member(member);
        let [set, unset] = [true, false].map(|is_set| names.flag(is_set));
        match self {
            Self::Engine(EngineError::Samples { asked, possible, .. }) => {
                format!("{} is {asked}; it can be {possible}", name(M::Samples))
            }
            Self::Engine(EngineError::Background(found)) => {
                format!("{} is {found:?}: its light must be finite", name(M::Background))
            }
            Self::Engine(EngineError::Pattern(error)) => {
                format!("{} and {}: {error}", name(M::Samples), name(M::Pattern))
            }
            Self::Engine(error) => names.engine(error),
            Self::At { place: Place::Mesh(mesh), error } => names.in_mesh(*mesh, error),
            Self::At { place: Place::AlphaMap(map), error } => {
                format!("{}[{map}]: {}", name(M::AlphaMaps), error.message(names))
            }
            Self::At { place: Place::Indirect(list), error } => {
                format!("{}[{list}]: {}", name(M::Indirect), error.message(names))
            }
            Self::At { place: Place::Draw(draw), error } => format!("draw {draw}: {}", error.message(names)),
            Self::Null(M::Indices) => format!(
                "{} is VK_NULL_HANDLE: lend the index buffer, or set {} if there is none",
                name(M::Indices),
                name(M::NoIndices)
            ),
            Self::Null(member) => format!("{} is VK_NULL_HANDLE", name(*member)),
            Self::NullImage { image, handle } => format!("{}.{handle} is VK_NULL_HANDLE", name(*image)),
            Self::Range { member, found, least, most } => {
                format!("{} is {found}; it can be {least} to {most}", name(*member))
            }
            Self::Index { member, found, count, by } => {
                format!("{} is {found}; it can be 0 to {}, by {}", name(*member), count.saturating_sub(1), name(*by))
            }
            Self::Pixels { found, most } => format!("{} has {found} pixels; it can have {most}", name(M::Size)),
            Self::Alignment { member, offset, alignment } => {
                format!("{} is {offset} bytes; it can be a multiple of {alignment}", name(*member))
            }
            Self::Stride { member, found, least, unit } => {
                format!("{} is {found} bytes; it can be any multiple of {unit} from {least} on", name(*member))
            }
            Self::Length { member, needed, limit } => {
                format!("{} needs {needed} bytes and the device addresses at most {limit} in one buffer", name(*member))
            }
            Self::VertexFormat { member, found, least } => format!(
                "{} is VK_FORMAT_{found:?}; it can have 32-bit SFLOAT components, or 16-bit SFLOAT, UNORM or SNORM components, {least} or more of them",
                name(*member)
            ),
            Self::VertexScale(member) => format!("{} has a scale or a bias that is not finite", name(*member)),
            Self::ClipFormat(found) => format!(
                "{} is VK_FORMAT_{found:?} or has a scale or a bias; positions in clip space are four floats",
                name(M::PositionFormat)
            ),
            Self::NotFinite(member) => format!("{} has a number that is not finite", name(*member)),
            Self::Choice { member, found, possible } => format!("{} is {found}; it can be {possible}", name(*member)),
            Self::IndexType(found) => format!(
                "{} is {}; it can be VK_INDEX_TYPE_UINT16 (0) or VK_INDEX_TYPE_UINT32 (1); set {} if there are no indices",
                name(M::IndexType),
                found.as_raw(),
                name(M::NoIndices)
            ),
            Self::DepthRange([least, most]) => {
                format!("{}: {least} and {most} have to be finite numbers that differ", name(M::DepthRange))
            }
            Self::Viewport { x, y, width, height, y_up } => format!(
                "{} is {width} x {height} pixels at ({x}, {y}); it needs finite numbers, a positive width, and a height that is {} as {} is {}",
                name(M::Viewport),
                if *y_up { "negative" } else { "positive" },
                name(M::YUp),
                names.flag(*y_up)
            ),
            Self::ViewportPart { viewport: v, part: p } => format!(
                "{} holds the pixels from ({}, {}) to ({}, {}), and the frame is of those from ({}, {}) to ({}, {}): a frame's part of the images has to lie in the viewport; make {} smaller, or begin it elsewhere by {}",
                name(M::Viewport),
                v[0],
                v[1],
                v[2],
                v[3],
                p[0],
                p[1],
                p[2],
                p[3],
                name(M::Size),
                name(M::Corner)
            ),
            Self::Part { end, most } => format!(
                "the frame's part of the images ends at {} x {} pixels; images have at most {most} on a side",
                end[0], end[1]
            ),
            Self::Format(found) => format!(
                "{} is VK_FORMAT_{found:?}; it can have 8, 10, 16 or 32 bits a channel as UNORM, SRGB or SFLOAT, or be VK_FORMAT_B10G11R11_UFLOAT_PACK32",
                name(M::ColorFormat)
            ),
            Self::Encoded(found) => format!(
                "{} is {set} and {} is VK_FORMAT_{found:?}, which holds linear light: set {0} to {unset}",
                name(M::ColorEncoded),
                name(M::ColorFormat)
            ),
            Self::NoDepth => format!(
                "thin triangles are found by depth: set {} and lend {}, the depth image, or set {} to {unset}",
                name(M::KindDepth),
                name(M::Depth),
                name(M::Thin)
            ),
            Self::NoIds => format!(
                "{} is {set} without {}: lend both, or neither to have both drawn",
                name(M::KindDepth),
                name(M::KindIds)
            ),
            Self::IndirectIds => format!(
                "{} with {}: the library has to draw the IDs, so set {0} to {unset}",
                name(M::KindIds),
                name(M::Indirect)
            ),
            Self::MissingImage { image, kind } => {
                format!("{} is missing: lend the image, or make the frame without {}", name(*image), name(*kind))
            }
            Self::UnexpectedImage { image, kind } => {
                format!("{} is lent, and the frame was made without it: set {}", name(*image), name(*kind))
            }
            Self::Layout { image, when, found } => format!(
                "{}.{when}.layout is VK_IMAGE_LAYOUT_{found:?}; it can be any that keeps what the image holds",
                name(*image)
            ),
            Self::Aspects { image, found, possible } => {
                format!("{}.aspects is {:#x}; it can have {possible}", name(*image), found.as_raw())
            }
            Self::NoCoordinates => {
                format!("there are alpha maps and no texture coordinates: lend {}", name(M::Coordinates))
            }
            Self::DrawCoordinates { mesh } => format!(
                "it has an alpha map, and its mesh {mesh} has no texture coordinates: lend {}",
                name(M::Coordinates)
            ),
            Self::AlphaMap { map, maps } => format!(
                "{} is {}, and there are {maps}, from {}",
                name(M::DrawAlphaMap),
                u32::from(*map) + D::FIRST_ALPHA_MAP,
                D::FIRST_ALPHA_MAP
            ),
            Self::NoAlphaMaps => format!("it is alpha-tested, and there are no {}", name(M::AlphaMaps)),
            Self::Order => "it has no alpha map and comes after one that has: draws without come first".to_owned(),
            Self::BlendedOrder => "it is not blended and comes after one that is: these are the last ones".to_owned(),
            Self::NotBlended => format!("it is blended; make the frame with {}", name(M::Blended)),
            Self::BlendedMap => {
                "it is blended and has an alpha map: let its shader store an opacity of 0 instead".to_owned()
            }
            Self::BlendedCentres => format!(
                "{} with {}: centres are shaded by the nearest surface alone; draw the colours yourself",
                name(M::Blended),
                name(M::ShadeAll)
            ),
            Self::BlendedBackground => format!(
                "{} without {}: blended draws are composited over {} alone; set {1} and lend the sky as triangles, or draw what is blended after the recording",
                name(M::Blended),
                name(M::FlatBackground),
                name(M::Background)
            ),
            Self::Capacity { counted, found, member, capacity } => {
                format!("{found} {counted}; {} is {capacity}", name(*member))
            }
            Self::Indices { end, indices } => format!("it reads indices up to {end}, and there are {indices}"),
            Self::Corners { read, held } => format!(
                "it takes the vertices from {} to before {} without indices, by its topology and triangle_count, and has those from {} to before {}",
                read[0], read[1], held[0], held[1]
            ),
            Self::Vertices { held, vertices } => format!(
                "it has the vertices from {} to before {}; it needs at least one, of those from 0 to before {vertices}",
                held[0], held[1]
            ),
            Self::FlatProjection => {
                format!("{} has a scale of 0 along y: it is projection[1][1], in columns", name(M::Projection))
            }
        }
    }
}
