//! Radiance pictures (`.hdr`), decoded by the `image` crate, whose decoder takes only one of the heads that are in use.
//!
//! A head is lines of text: a signature, `VARIABLE=value` and comments, an empty line, and the resolution. It is parsed
//! here, and the scanlines go to the decoder under a head that it takes.

use crate::scene::{Warnings, check_texels};
use image::{DynamicImage, codecs::hdr::HdrDecoder};
use std::io::Read;

/// First bytes of every picture; the name of a program follows.
pub(super) const MAGIC: &[u8] = b"#?";

/// Most pixels that are read.
const MAX_PIXELS: u64 = 1 << 28;

/// Size and linear colours of a picture, rows from the top. What is not read is named in `left_out`.
pub(super) fn decode(bytes: &[u8], left_out: &mut Warnings) -> Result<([u32; 2], Vec<[f32; 3]>), String> {
    let head = Head::parse(bytes, left_out)?;
    let mut scanlines = &bytes[head.length..];
    let [count, length] = head.resolution.map(|axis| axis.length);
    let pixels = u64::from(count) * u64::from(length);
    if pixels > MAX_PIXELS {
        return Err(format!("it has {length} x {count} pixels, more than the {MAX_PIXELS} that are read"));
    }
    check_texels(length.into(), count.into(), bytes.len())?;
    let known = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {count} +X {length}\n");
    let text = |error: image::ImageError| error.to_string();
    let decoder = HdrDecoder::new(known.as_bytes().chain(&mut scanlines)).map_err(text)?;
    let image = DynamicImage::from_decoder(decoder).map_err(text)?;
    left_out.leave_out("bytes behind the scanlines", scanlines.len(), "");
    let numbers = image.into_rgb32f().into_raw();
    let colors = bytemuck::try_cast_vec(numbers).unwrap_or_else(|(_, numbers)| numbers.as_chunks().0.to_vec());
    Ok(head.upright(colors))
}

/// Direction in which a picture stores its scanlines, or the pixels of a scanline.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Axis {
    is_vertical: bool,
    /// Whether the first stands at the top or at the left.
    is_forward: bool,
    length: u32,
}

/// Head of a picture.
#[derive(Debug, PartialEq)]
struct Head {
    /// Number of bytes.
    length: usize,
    /// Axis of the scanlines, and axis within a scanline.
    resolution: [Axis; 2],
}

impl Head {
    fn parse(bytes: &[u8], left_out: &mut Warnings) -> Result<Self, String> {
        if !bytes.starts_with(MAGIC) {
            return Err("not of a known format".to_owned());
        }
        let mut length = 0;
        let mut line = || {
            let rest = &bytes[length..];
            let end = rest.iter().position(|byte| *byte == b'\n');
            let end = end.ok_or("the head of the picture does not end")?;
            length += end + 1;
            let line = &rest[..end];
            Ok::<_, String>(line.strip_suffix(b"\r").unwrap_or(line))
        };
        loop {
            let line = line()?;
            if line.is_empty() {
                break;
            }
            let format = line.strip_prefix(b"FORMAT=").map(<[u8]>::trim_ascii);
            if let Some(other) = format.filter(|format| *format != b"32-bit_rle_rgbe") {
                let other = String::from_utf8_lossy(other);
                return Err(format!("its FORMAT is {other}, and only 32-bit_rle_rgbe is read"));
            }
            name_unused(line, left_out);
        }
        let text = String::from_utf8_lossy(line()?).into_owned();
        let resolution = Self::resolution(&text)
            .ok_or_else(|| format!("its resolution is \"{text}\", and not like \"-Y 512 +X 1024\""))?;
        Ok(Self { length, resolution })
    }

    /// Parses a line such as `-Y 512 +X 1024`. -Y stands for rows from the top, +X for columns from the left.
    fn resolution(line: &str) -> Option<[Axis; 2]> {
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        let axis = |name: &str, length: &str| {
            let (is_vertical, is_forward) = match name {
                "-Y" => (true, true),
                "+Y" => (true, false),
                "+X" => (false, true),
                "-X" => (false, false),
                _ => return None,
            };
            let length = length.parse().ok().filter(|length| *length > 0)?;
            Some(Axis { is_vertical, is_forward, length })
        };
        let [major, length, minor, minor_length] = *words.as_slice() else {
            return None;
        };
        let axes = [axis(major, length)?, axis(minor, minor_length)?];
        (axes[0].is_vertical != axes[1].is_vertical).then_some(axes)
    }

    /// Size and colours in rows from the top.
    fn upright(&self, colors: Vec<[f32; 3]>) -> ([u32; 2], Vec<[f32; 3]>) {
        let [major, minor] = self.resolution;
        let [rows, columns] = if major.is_vertical { [major, minor] } else { [minor, major] };
        let size = [columns.length, rows.length];
        if major.is_vertical && rows.is_forward && columns.is_forward {
            return (size, colors);
        }
        let place = |axis: Axis, i: u32| if axis.is_forward { i } else { axis.length - 1 - i } as usize;
        let stored = |row: u32, column: u32| {
            let (row, column) = (place(rows, row), place(columns, column));
            match major.is_vertical {
                true => row * columns.length as usize + column,
                false => column * rows.length as usize + row,
            }
        };
        let all = (0..rows.length).flat_map(|row| (0..columns.length).map(move |column| (row, column)));
        let turned = all.filter_map(|(row, column)| colors.get(stored(row, column)).copied());
        (size, turned.collect())
    }
}

/// Names a variable that is not used and would change the picture. Other lines are comments or the commands that made it.
fn name_unused(line: &[u8], left_out: &mut Warnings) {
    let line = String::from_utf8_lossy(line);
    let Some((name, value)) = line.split_once('=').filter(|_| !line.starts_with('#')) else {
        return;
    };
    let name = name.trim();
    let is_variable = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    let numbers: Option<Vec<f32>> = value.split_ascii_whitespace().map(|word| word.parse().ok()).collect();
    let is_neutral = match name {
        "FORMAT" | "SOFTWARE" | "CAPDATE" | "GMT" | "OWNER" => true,
        "EXPOSURE" | "GAMMA" | "PIXASPECT" => numbers.is_some_and(|n| n == [1.0]),
        "COLORCORR" => numbers.is_some_and(|n| n == [1.0; 3]),
        "PRIMARIES" => numbers.is_some_and(|n| NEUTRAL.iter().any(|white| n == [&PRIMARIES, &white[..]].concat())),
        _ => false,
    };
    left_out.leave_out("variables", usize::from(is_variable && !is_neutral), name);
}

/// Primaries that pictures have unless they say otherwise: the format's, which are also those of sRGB.
const PRIMARIES: [f32; 6] = [0.64, 0.33, 0.29, 0.6, 0.15, 0.06];
/// The format's white, and that of sRGB.
const NEUTRAL: [[f32; 2]; 2] = [[0.3333, 0.3333], [0.3127, 0.329]];

#[cfg(test)]
mod tests {
    use super::*;

    fn decode(bytes: &[u8]) -> Result<([u32; 2], Vec<[f32; 3]>), String> {
        super::decode(bytes, &mut Warnings::new("test"))
    }

    /// Picture of 2 x 3 pixels, whose pixel in column x and row y is [x, y, 0], with this head and these scanlines.
    fn picture(head: &str, scanlines: [[[u8; 2]; 3]; 2]) -> Vec<u8> {
        let pixels = scanlines.as_flattened().iter();
        let pixels = pixels.flat_map(|[x, y]| [x * 128, y * 64, 0, 129]);
        head.bytes().chain(pixels).collect()
    }

    #[test]
    fn every_orientation_is_turned_upright() {
        let expected: Vec<[f32; 3]> =
            (0..3).flat_map(|y| [0.0, 1.0].map(|x| [x, f32::from(y as u8) / 2.0, 0.0])).collect();
        let mut forms = 0;
        for vertical in ["-Y", "+Y"] {
            for horizontal in ["+X", "-X"] {
                let row = |i: u8| if vertical == "-Y" { i } else { 2 - i };
                let column = |i: u8| if horizontal == "+X" { i } else { 1 - i };
                let by_columns = [0, 1].map(|c| [0, 1, 2].map(|r| [column(c), row(r)]));
                let head = format!("#?RGBE\n\n{horizontal} 2 {vertical} 3\n");
                let found = decode(&picture(&head, by_columns)).unwrap();
                assert_eq!(found, ([2, 3], expected.clone()), "{head}");
                let by_rows = [0, 1, 2].map(|r| [0, 1].map(|c| [column(c), row(r)]));
                let pixels = by_rows.as_flattened().as_chunks().0;
                let head = format!("#?RADIANCE\n\n{vertical} 3 {horizontal} 2\n");
                let found = decode(&picture(&head, [pixels[0], pixels[1]])).unwrap();
                assert_eq!(found, ([2, 3], expected.clone()), "{head}");
                forms += 2;
            }
        }
        assert_eq!(forms, 8);
    }

    #[test]
    fn heads_of_other_programs_are_read() {
        let by_columns = [0, 1].map(|x| [0, 1, 2].map(|y| [x, y]));
        for head in [
            "#?RGBE\r\n# a comment\r\nFORMAT=32-bit_rle_rgbe\r\nEXPOSURE=1\r\n\r\n+X 2 -Y 3\r\n",
            "#?AUTOPANO PRO\nVIEW=whatever\nFORMAT= 32-bit_rle_rgbe \n\n+X  2 -Y 3 \n",
        ] {
            let (size, colors) = decode(&picture(head, by_columns)).unwrap();
            assert_eq!((size, colors[3]), ([2, 3], [1.0, 0.5, 0.0]), "{head}");
        }
    }

    #[test]
    fn what_is_no_picture_is_refused_by_what_it_has() {
        let refused = |head: &str| decode(head.as_bytes()).unwrap_err();
        assert!(refused("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n").contains("32-bit_rle_xyze"));
        assert!(refused("#?RADIANCE\n\n-Y 2 +Y 2\n").contains("\"-Y 2 +Y 2\""));
        assert!(refused("#?RADIANCE\n\n-Y 0 +X 2\n").contains("-Y 0 +X 2"));
        assert!(refused("#?RADIANCE\n\n-Y 2").contains("does not end"));
        assert!(refused("#?RADIANCE\n\n-Y 60000 +X 60000\n").len() > 10);
        assert!(refused("RADIANCE\n\n-Y 2 +X 2\n").contains("known format"));
    }
}
