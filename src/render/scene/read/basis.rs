//! KTX2 images of Basis Universal (`KHR_texture_basisu`): ETC1S and UASTC.

use std::panic::catch_unwind;

use basisu::{
    DecodeFlags, Error, TargetFormat, Transcoder,
    ktx2::{BasisFormat, Ktx2Header},
};

/// Whether the extension is supported.
pub const AVAILABLE: bool = true;

/// Width and height from the header; an error if the extension does not allow them.
pub fn dimensions(bytes: &[u8]) -> Result<(u32, u32), String> {
    let header = Ktx2Header::parse(bytes).ok_or(
        "the KTX2 header is broken, or is not that of a 2D image of Basis Universal; encode it \
         with `toktx --encode uastc`",
    )?;
    if !matches!(header.format, BasisFormat::Etc1s | BasisFormat::Uastc) {
        return Err("is a KTX2 image of neither ETC1S nor UASTC".to_owned());
    }
    if header.face_count != 1 || header.layer_count > 1 {
        return Err("is a KTX2 image of several layers or faces".to_owned());
    }
    // The transcoder adds offsets and lengths without checking for overflow.
    let global = (header.sgd_byte_offset, header.sgd_byte_length);
    let levels = header.levels.iter();
    let levels = levels.map(|level| (level.byte_offset, level.byte_length));
    let within = |(offset, length): (u64, u64)| {
        let end = offset.checked_add(length);
        end.is_some_and(|end| end <= bytes.len() as u64)
    };
    if !levels.chain([global]).all(within) {
        let all = bytes.len();
        return Err(format!("the KTX2 header refers beyond the {all} bytes of the file"));
    }
    // The transcoder allocates as much as a level claims to decompress to.
    for (index, level) in header.levels.iter().enumerate() {
        let blocks = |side: u32| {
            let side = side.checked_shr(index as u32).unwrap_or(0).max(1);
            u64::from(side.div_ceil(4))
        };
        let blocks = blocks(header.width) * blocks(header.height);
        let claimed = level.uncompressed_byte_length;
        if claimed > BYTES_A_BLOCK * blocks {
            return Err(format!("claims {claimed} bytes for {blocks} blocks of 4 x 4 texels"));
        }
    }
    Ok((header.width, header.height))
}

/// Number of bytes of a UASTC block.
const BYTES_A_BLOCK: u64 = 16;

/// RGBA texels of the full image, followed by all smaller levels if the file has them down to a single texel. `bytes`
/// is a file that [`dimensions`] has accepted.
pub fn decode(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let failed = |error: Error| format!("the KTX2 image cannot be decoded: {error:?}");
    let header = Ktx2Header::parse(bytes).ok_or("the KTX2 header is broken")?;
    let (width, height, levels) = (header.width, header.height, header.levels.len() as u32);
    let transcode = || {
        let transcoder = Transcoder::new(bytes).map_err(failed)?;
        let level = |level| transcoder.transcode(level, TargetFormat::Rgba32, DecodeFlags::NONE).map_err(failed);
        let mut texels = level(0)?;
        let all = width.max(height).max(1).ilog2() + 1;
        if levels == all {
            for smaller in 1..all {
                texels.extend(level(smaller)?);
            }
        }
        Ok(texels)
    };
    // The transcoder is young: a panic in it should cost one image, not the process.
    catch_unwind(transcode).unwrap_or_else(|_| Err("the KTX2 image is broken: its transcoder gave up".to_owned()))
}
