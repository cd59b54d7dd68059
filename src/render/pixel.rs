//! Pixels of images that are read back from the device.

use super::Encoding;

/// A pixel of an image that is read back from the device: [`f32`] or [`u8`] times four.
///
/// | type | colour |
/// |---|---|
/// | `[f32; 4]` | linear light, premultiplied |
/// | `[u8; 4]` | sRGB codes with straight alpha, as in image files: [`Encoding::StraightRgba8`] |
pub trait Pixel: bytemuck::Pod + sealed::Sealed {
    /// Encoding in which the device writes the image; `None` for what it computes with.
    const ENCODING: Option<Encoding>;
}

impl Pixel for [f32; 4] {
    const ENCODING: Option<Encoding> = None;
}

impl Pixel for [u8; 4] {
    const ENCODING: Option<Encoding> = Some(Encoding::StraightRgba8);
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for [f32; 4] {}
    impl Sealed for [u8; 4] {}
}
