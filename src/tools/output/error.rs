//! What can go wrong with image files.

use std::path::PathBuf;

/// An image that can't be encoded, written, read or decoded.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// Size and number of pixels disagree.
    #[error("an image of {width} x {height} was given {found} pixels")]
    PixelCount {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Number of pixels found.
        found: usize,
    },
    /// The encoder refuses.
    #[error("the image can't be encoded: {0}")]
    Encode(String),
    /// The file can't be written.
    #[error("{}: can't be written: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A frame of another size than the film's.
    #[error(
        "a frame of {} x {} pixels for a film of {} x {}", found[0], found[1], expected[0], expected[1]
    )]
    FrameSize {
        /// Width and height of the frame.
        found: [u32; 2],
        /// Width and height of the film.
        expected: [u32; 2],
    },
    /// Frames can't be passed on.
    #[error("frames can't be written: {0}")]
    Stream(#[source] std::io::Error),
    /// The file can't be read.
    #[error("{}: can't be read: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The bytes are no image that is understood.
    #[error("{file}: {reason}; it must be {expected}")]
    Decode {
        /// The file.
        file: String,
        /// What is wrong.
        reason: String,
        /// What is understood there.
        expected: &'static str,
    },
    /// A pixel of an EXR is not a number, so that no comparison would mean anything.
    #[error("{file}: pixel ({x}, {y}) is not a number")]
    NotANumber {
        /// The file.
        file: String,
        /// Column from the left.
        x: usize,
        /// Row from the top.
        y: usize,
    },
}

/// A file name that asks for no known format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{}: the name must end in .png (8 bits a channel), .16.png (16 bits), .jpg, .jpeg or .exr",
    .0.display()
)]
pub struct UnknownFormat(pub PathBuf);

/// A name that no AOV has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no AOV \"{0}\"; there are depth, id, normal, superpixels and samples")]
pub struct UnknownAov(pub String);
