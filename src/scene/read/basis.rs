//! KTX2 images of Basis Universal (`KHR_texture_basisu`): ETC1S and UASTC.

use basisu::{
    DecodeFlags, Error, TargetFormat, Transcoder,
    ktx2::{BasisFormat, Ktx2Header},
};

/// Width and height that the header states; an error where it is not what the extension allows.
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
    // The transcoder allocates what a level says that it is inflated to.
    let blocks = u64::from(header.width.div_ceil(4)) * u64::from(header.height.div_ceil(4));
    if let Some(level) = header.levels.first()
        && level.uncompressed_byte_length > BYTES_A_BLOCK * blocks
    {
        let claimed = level.uncompressed_byte_length;
        return Err(format!(
            "claims {claimed} bytes for {blocks} blocks of 4 x 4 texels"
        ));
    }
    Ok((header.width, header.height))
}

/// Bytes of a block of UASTC.
const BYTES_A_BLOCK: u64 = 16;

/// The texels of the full image, RGBA, of a file whose [`dimensions`] were found acceptable.
pub fn decode(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let failed = |error: Error| format!("the KTX2 image cannot be decoded: {error:?}");
    let transcoder = Transcoder::new(bytes).map_err(failed)?;
    transcoder
        .transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE)
        .map_err(failed)
}
