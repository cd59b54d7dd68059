//! Films: frames of one size, written one after the other, for example to the standard input of an encoder.

use super::encode::codes;
use super::{OutputError, Picture};
use crate::color::srgb;
use rayon::prelude::*;
use std::io::{self, Write};
use y4m::{Colorspace, Ratio, VendorExtensionString};

/// Format of a film's frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum VideoFormat {
    /// YUV4MPEG2: a header line with size and rate, then for each frame the planes Y', Cb and Cr, 8 bits each, 4:4:4.
    /// The codes are those of BT.709 in limited range (Y' from 16 to 235, Cb and Cr from 16 to 240), of sRGB-encoded
    /// colours over black.
    Y4m,
    /// RGBA frames without a header: 8 bits a channel, sRGB-encoded, straight alpha.
    Raw,
}

/// Writer of a film's frames.
pub struct VideoWriter<W: Write> {
    stream: VideoOutput<W>,
    size: [u32; 2],
}

/// Destination of the frames: an encoder or a plain writer, depending on the format.
enum VideoOutput<W: Write> {
    Y4m(y4m::Encoder<Unbuffered<W>>),
    Raw(Unbuffered<W>),
}

/// Writer that flushes after each write, so that a frame is not held back until the next one.
struct Unbuffered<W>(W);

impl<W: Write> Write for Unbuffered<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.0.write(bytes)?;
        self.0.flush()?;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

impl<W: Write> VideoWriter<W> {
    /// Begins a film of `size` = [width, height] in pixels and `rate` frames a second. YUV4MPEG2 stores the rate as a
    /// fraction: n:1 for whole numbers, n:1001 for those of NTSC, such as 23.976 and 29.97, otherwise millionths in
    /// lowest terms. Raw films do not store the rate.
    ///
    /// # Errors
    /// [`OutputError::Stream`] if writing to `out` fails.
    pub fn new(out: W, format: VideoFormat, size: [u32; 2], rate: f64) -> Result<Self, OutputError> {
        let out = Unbuffered(out);
        let stream = match format {
            VideoFormat::Y4m => {
                let [width, height] = size.map(|side| side as usize);
                let range = VendorExtensionString::new(b"COLORRANGE=LIMITED".to_vec());
                let header = y4m::encode(width, height, ratio(rate))
                    .with_colorspace(Colorspace::C444)
                    .append_vendor_extension(range.map_err(refused)?);
                VideoOutput::Y4m(header.write_header(out).map_err(refused)?)
            }
            VideoFormat::Raw => VideoOutput::Raw(out),
        };
        Ok(Self { stream, size })
    }

    /// Writes a frame and flushes it.
    ///
    /// # Errors
    /// [`OutputError::FrameSize`] if the picture has another size, [`OutputError::Stream`] if writing fails.
    pub fn write(&mut self, picture: &Picture<'_>) -> Result<(), OutputError> {
        if picture.size() != self.size {
            return Err(OutputError::FrameSize { found: picture.size(), expected: self.size });
        }
        match &mut self.stream {
            VideoOutput::Y4m(encoder) => {
                let planes = planes(picture);
                let frame = y4m::Frame::new(planes.each_ref().map(Vec::as_slice), None);
                encoder.write_frame(&frame).map_err(refused)
            }
            VideoOutput::Raw(out) => out.write_all(codes(picture).as_flattened()).map_err(OutputError::Stream),
        }
    }
}

fn refused(error: y4m::Error) -> OutputError {
    OutputError::Stream(match error {
        y4m::Error::IoError(error) => error,
        other => io::Error::other(other),
    })
}

/// Planes Y', Cb and Cr of a picture over black.
fn planes(picture: &Picture<'_>) -> [Vec<u8>; 3] {
    // A premultiplied colour equals the colour over black.
    let code = |[r, g, b, _]: &[f32; 4]| bt709([*r, *g, *b].map(|v| srgb::encode(f64::from(v))));
    let codes: Vec<_> = picture.pixels().par_iter().map(code).collect();
    [0, 1, 2].map(|plane| codes.iter().map(|code| code[plane]).collect())
}

/// 8-bit codes Y', Cb and Cr, in limited range, of a gamma-encoded colour R', G', B' of 0 to 1, by ITU-R BT.709-6.
fn bt709([r, g, b]: [f64; 3]) -> [u8; 3] {
    let luma = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    let chroma = |difference: f64, range: f64| 128.0 + 224.0 * difference / range;
    [16.0 + 219.0 * luma, chroma(b - luma, 1.8556), chroma(r - luma, 1.5748)].map(|code| code.round() as u8)
}

/// Frame rate as a fraction of whole numbers, as [`VideoWriter::new`] describes.
fn ratio(rate: f64) -> Ratio {
    const MILLION: usize = 1_000_000;
    let whole = (rate * 1.001).round();
    if rate.fract() != 0.0 && (rate - whole / 1.001).abs() < 5e-4 {
        return Ratio::new(whole as usize * 1000, 1001);
    }
    let number = (rate * MILLION as f64).round() as usize;
    let divisor = greatest_common_divisor(number, MILLION).max(1);
    Ratio::new(number / divisor, MILLION / divisor)
}

fn greatest_common_divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The codes of colour bars agree with those that ITU-R BT.709 gives and that measuring devices expect.
    #[test]
    fn colour_bars_have_their_codes() {
        let bars = [
            ([1.0, 1.0, 1.0], [235, 128, 128]),
            ([1.0, 1.0, 0.0], [219, 16, 138]),
            ([0.0, 1.0, 1.0], [188, 154, 16]),
            ([0.0, 1.0, 0.0], [173, 42, 26]),
            ([1.0, 0.0, 1.0], [78, 214, 230]),
            ([1.0, 0.0, 0.0], [63, 102, 240]),
            ([0.0, 0.0, 1.0], [32, 240, 118]),
            ([0.0, 0.0, 0.0], [16, 128, 128]),
        ];
        for (color, codes) in bars {
            assert_eq!(bt709(color), codes, "{color:?}");
        }
    }

    /// Decoding by the inverse matrix gives each colour back, within half a code in each channel.
    #[test]
    fn codes_are_the_nearest() {
        let steps = || (0..=20).map(|step| f64::from(step) / 20.0);
        for (r, g, b) in steps().flat_map(|r| steps().flat_map(move |g| steps().map(move |b| (r, g, b)))) {
            let [y, cb, cr] = bt709([r, g, b]).map(f64::from);
            let luma = (y - 16.0) / 219.0;
            let red = luma + 1.5748 * (cr - 128.0) / 224.0;
            let blue = luma + 1.8556 * (cb - 128.0) / 224.0;
            let green = (luma - 0.2126 * red - 0.0722 * blue) / 0.7152;
            let half = 0.5 / 219.0;
            assert!((red - r).abs() <= half + 1.5748 * 0.5 / 224.0 + 1e-12);
            assert!((blue - b).abs() <= half + 1.8556 * 0.5 / 224.0 + 1e-12);
            let both = 0.2126 * 1.5748 + 0.0722 * 1.8556;
            assert!((green - g).abs() <= half + both / 0.7152 * 0.5 / 224.0 + 1e-12);
        }
    }

    #[test]
    fn rates_are_fractions() {
        for (rate, expected) in [
            (24.0, (24, 1)),
            (12.5, (25, 2)),
            (23.976, (24_000, 1001)),
            (29.97, (30_000, 1001)),
            (59.94, (60_000, 1001)),
            (0.1, (1, 10)),
            (29.9, (299, 10)),
        ] {
            let found = ratio(rate);
            assert_eq!((found.num, found.den), expected, "{rate}");
        }
    }

    #[test]
    fn frames_have_the_films_size() {
        let mut out = Vec::new();
        let mut writer = VideoWriter::new(&mut out, VideoFormat::Raw, [2, 1], 24.0).unwrap();
        let pixels = [[1.0, 0.25, 0.0, 1.0], [0.25, 0.0, 0.0, 0.5]];
        writer.write(&Picture::new([2, 1], &pixels).unwrap()).unwrap();
        let refused = writer.write(&Picture::new([1, 2], &pixels).unwrap());
        assert!(matches!(refused, Err(OutputError::FrameSize { .. })));
        let half = srgb::encode_u8(0.5);
        let quarter = srgb::encode_u8(0.25);
        assert_eq!(out, [255, quarter, 0, 255, half, 0, 0, 128]);
    }
}
