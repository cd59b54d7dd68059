//! Errors of image files.

use std::path::PathBuf;

/// Error of encoding, writing, reading or decoding an image file or film.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// Number of pixels that contradicts the size.
    #[error("an image of {width} x {height} was given {found} pixels")]
    PixelCount {
        /// Expected width in pixels.
        width: u32,
        /// Expected height in pixels.
        height: u32,
        /// Number of pixels given.
        found: usize,
    },
    /// Image that the encoder refuses; holds the encoder's reason.
    #[error("the image can't be encoded: {0}")]
    Encode(String),
    /// File that can't be written.
    #[error("{}: can't be written: {source}", path.display())]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: std::io::Error,
    },
    /// Frame whose size is not the film's.
    #[error(
        "a frame of {} x {} pixels for a film of {} x {}", found[0], found[1], expected[0], expected[1]
    )]
    FrameSize {
        /// Width and height of the frame.
        found: [u32; 2],
        /// Width and height of the film.
        expected: [u32; 2],
    },
    /// Film that can't be written; holds the system's error.
    #[error("frames can't be written: {0}")]
    Stream(#[source] std::io::Error),
    /// File that can't be read.
    #[error("{}: can't be read: {source}", path.display())]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: std::io::Error,
    },
    /// File that is not an image in an expected format.
    #[error("{file}: {reason}; it must be {expected}")]
    Decode {
        /// Name of the file.
        file: String,
        /// Reason of the decoder.
        reason: String,
        /// Formats that can be read in this place.
        expected: &'static str,
    },
    /// EXR with a NaN, which can't be compared.
    #[error("{file}: pixel ({x}, {y}) is not a number")]
    NotANumber {
        /// Name of the file.
        file: String,
        /// Column of the pixel, 0 at the left.
        x: usize,
        /// Row of the pixel, 0 at the top.
        y: usize,
    },
}

/// Error: a file name whose ending belongs to no image format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{}: the name must end in .png (8 bits a channel), .16.png (16 bits), .jpg, .jpeg or .exr",
    .0.display()
)]
pub struct UnknownFormat(pub PathBuf);
