//! Buffer views compressed with `KHR_meshopt_compression` or, by its older name,
//! `EXT_meshopt_compression`.

use std::hash::Hash;

use meshopt::{
    decode_filter_color, decode_filter_exp, decode_filter_oct, decode_filter_quat, decode_index_buffer,
    decode_index_sequence, decode_vertex_buffer,
};

use gltf::json::{Buffer, Index, validation::USize64};
use serde_json::{Map, Value};

use super::model;
use crate::scene::error::Fault;

/// The extension object.
#[derive(serde::Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct MeshoptExtension {
    pub buffer: Index<Buffer>,
    #[serde(default)]
    pub byte_offset: USize64,
    pub byte_length: USize64,
    byte_stride: u32,
    count: u64,
    mode: String,
    #[serde(default)]
    filter: Option<String>,
}

impl MeshoptExtension {
    /// What decides the decoded bytes.
    pub fn key(self) -> impl Eq + Hash {
        let (offset, length) = (self.byte_offset.0, self.byte_length.0);
        (self.buffer.value(), offset, length, self.byte_stride, self.count, self.mode, self.filter)
    }
}

/// The extension object among the extensions of a buffer view at `place`, and its own place.
pub fn find(others: Option<&Map<String, Value>>, place: &str) -> Result<Option<(MeshoptExtension, String)>, Fault> {
    // The extension has two names; the KHR name is the ratified one.
    let old = model::extension(others, "EXT_meshopt_compression", place)?;
    match old {
        None => model::extension(others, "KHR_meshopt_compression", place),
        found => Ok(found),
    }
}

/// Largest number of bytes for each encoded byte. Attributes: a block of up to 256 elements has at least a control
/// byte for every 4 bytes of an element. Triangles: a byte for 3 indices of 4 bytes. Indices: a byte for each index of
/// 4 bytes.
const ATTRIBUTE_RATIO: u64 = 1024;
const TRIANGLE_RATIO: u64 = 12;
const INDEX_RATIO: u64 = 4;

/// Decodes `encoded` by the extension object `compressed` at `place`.
pub fn decode(compressed: &MeshoptExtension, encoded: &[u8], place: &str) -> Result<Vec<u8>, Fault> {
    let (stride, count) = (compressed.byte_stride as usize, compressed.count);
    let ratio = match compressed.mode.as_str() {
        "ATTRIBUTES" => ATTRIBUTE_RATIO,
        "TRIANGLES" => TRIANGLE_RATIO,
        "INDICES" => INDEX_RATIO,
        other => {
            let reason = format!("unknown compression mode \"{other}\"");
            return Err(Fault::new(format!("{place}/mode"), reason));
        }
    };
    let justified = (encoded.len() as u64).saturating_mul(ratio);
    if count == 0 || count.saturating_mul(stride as u64) > justified {
        return Err(Fault::new(
            place,
            format!("{} bytes cannot hold {count} elements of {stride} bytes", encoded.len()),
        ));
    }
    let count = count as usize;
    let bytes = match ratio {
        ATTRIBUTE_RATIO => decode_attributes(encoded, count, stride),
        TRIANGLE_RATIO if !count.is_multiple_of(3) => None,
        TRIANGLE_RATIO => match stride {
            2 => decode_index_buffer::<u16>(encoded, count).ok().map(to_bytes),
            4 => decode_index_buffer::<u32>(encoded, count).ok().map(to_bytes),
            _ => None,
        },
        _ => match stride {
            2 => decode_index_sequence::<u16>(encoded, count).ok().map(to_bytes),
            4 => decode_index_sequence::<u32>(encoded, count).ok().map(to_bytes),
            _ => None,
        },
    };
    let bytes = bytes.ok_or_else(|| Fault::new(place, "the compressed data are broken"))?;
    apply_filter(compressed.filter.as_deref().unwrap_or("NONE"), bytes, stride, place)
}

fn to_bytes<T: bytemuck::NoUninit>(values: Vec<T>) -> Vec<u8> {
    bytemuck::cast_slice(&values).to_vec()
}

fn apply_filter(filter: &str, bytes: Vec<u8>, stride: usize, place: &str) -> Result<Vec<u8>, Fault> {
    fn filtered<T: bytemuck::Pod>(bytes: &[u8], decode: impl FnOnce(&mut [T])) -> Vec<u8> {
        let mut values: Vec<T> = bytemuck::pod_collect_to_vec(bytes);
        decode(&mut values);
        to_bytes(values)
    }
    match (filter, stride) {
        ("NONE", _) => Ok(bytes),
        ("OCTAHEDRAL", 4) => Ok(filtered::<[i8; 4]>(&bytes, decode_filter_oct)),
        ("OCTAHEDRAL", 8) => Ok(filtered::<[i16; 4]>(&bytes, decode_filter_oct)),
        ("COLOR", 4) => Ok(filtered::<[u8; 4]>(&bytes, decode_filter_color)),
        ("COLOR", 8) => Ok(filtered::<[u16; 4]>(&bytes, decode_filter_color)),
        ("QUATERNION", 8) => Ok(filtered::<[i16; 4]>(&bytes, decode_filter_quat)),
        // Each component is decoded separately, so that the width of an element does not matter.
        ("EXPONENTIAL", _) if stride.is_multiple_of(4) => Ok(filtered::<[u32; 1]>(&bytes, decode_filter_exp)),
        (filter, _) => Err(Fault::new(place, format!("no filter \"{filter}\" for elements of {stride} bytes"))),
    }
}

/// An element of `N` bytes; the standard library has no `Default` for arrays longer than 32.
#[derive(Clone)]
struct ElementBytes<const N: usize>([u8; N]);

impl<const N: usize> Default for ElementBytes<N> {
    fn default() -> Self {
        Self([0; N])
    }
}

fn decode_elements<const N: usize>(encoded: &[u8], count: usize) -> Option<Vec<u8>> {
    let elements = decode_vertex_buffer::<ElementBytes<N>>(encoded, count).ok()?;
    Some(elements.iter().flat_map(|element| element.0).collect())
}

fn decode_attributes(encoded: &[u8], count: usize, stride: usize) -> Option<Vec<u8>> {
    macro_rules! by_stride {
        ($($stride:literal)*) => {
            match stride {
                $($stride => decode_elements::<$stride>(encoded, count),)*
                _ => None,
            }
        };
    }
    // The format's strides: multiples of 4 up to 256.
    by_stride!(
        4 8 12 16 20 24 28 32 36 40 44 48 52 56 60 64 68 72 76 80 84 88 92 96 100 104 108 112 116
        120 124 128 132 136 140 144 148 152 156 160 164 168 172 176 180 184 188 192 196 200 204 208
        212 216 220 224 228 232 236 240 244 248 252 256
    )
}
