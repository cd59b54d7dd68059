//! Compressed meshes and textures: their contents, and claims that are refused.

use crate::scene_builder::{Builder, TRIANGLE};
use crate::shared::shared;
use gpc::scene::{PoseRequest, Scene};
use serde_json::json;

/// A triangle whose primitive claims to be compressed in these bytes.
fn draco(bytes: &[u8], vertices: u64, indices: u64) -> Builder {
    let mut builder = Builder::new();
    let view = builder.view(bytes, json!({}));
    let accessor = |kind, component, count| json!({"type": kind, "componentType": component, "count": count});
    let positions = builder.push("accessors", accessor("VEC3", 5126, vertices));
    let indices = builder.push("accessors", accessor("SCALAR", 5125, indices));
    let extension = json!({"bufferView": view, "attributes": {"POSITION": 0}});
    builder.node_with(
        json!({
            "attributes": {"POSITION": positions}, "indices": indices,
            "extensions": {"KHR_draco_mesh_compression": extension},
        }),
        json!({}),
    );
    builder.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    builder
}

#[test]
fn draco_cannot_claim_what_its_bytes_cannot_hold() {
    let place = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: ";
    for (bytes, vertices, indices, message) in [
        (&b"DRACO"[..], 1 << 40, 3, "5 bytes cannot hold 1 triangles of 1099511627776 vertices"),
        (b"DRACO\x02\x02\x01\x01", 3, 3, "the compressed data are broken"),
        (b"nothing of Draco", 3, 3, "the compressed data are broken"),
    ] {
        let error = draco(bytes, vertices, indices).load().unwrap_err().to_string();
        assert!(error.contains(place) && error.contains(message), "{error}");
    }
    let error = draco(b"DRACO", 3, 3 << 40).load().unwrap_err().to_string();
    assert!(error.contains("triangles exceed the limit"), "{error}");
}

#[test]
fn draco_that_cannot_be_decoded_gives_way_to_uncompressed_data() {
    let mut builder = draco(b"nothing of Draco", 3, 3);
    let positions = builder.floats(&TRIANGLE);
    let primitive = &mut builder.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["POSITION"] = positions.into();
    primitive.as_object_mut().unwrap().remove("indices");
    let loaded = builder.load().unwrap();
    let warned = |w: &String| w.contains("broken") && w.contains("the uncompressed data are used");
    assert!(loaded.warnings.iter().any(warned), "{:?}", loaded.warnings);
    assert_eq!(builder.pose().geometry.triangles.len(), 1);
}

/// A KTX2 file of one block in the UASTC format, which claims to be compressed by Zstandard.
fn ktx2(width: u32, height: u32, faces: u32, claimed: u64) -> Vec<u8> {
    let mut bytes = b"\xABKTX 20\xBB\r\n\x1A\n".to_vec();
    // The words are: no Vulkan format, size of a byte, width, height, no depth, no layers, faces, one level,
    // Zstandard.
    let words = [0, 1, width, height, 0, 0, faces, 1, 2];
    bytes.extend(words.iter().flat_map(|word: &u32| word.to_le_bytes()));
    // The data format descriptor follows the only level; there is neither key-value data nor global data.
    let words = [104_u32, 44, 0, 0, 0, 0, 0, 0];
    bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
    let level = [148_u64, 16, claimed];
    bytes.extend(level.iter().flat_map(|word| word.to_le_bytes()));
    // The descriptor says: colour model UASTC, primaries of BT.709, transfer function of sRGB, blocks of 4 x 4 texels.
    let words = [44_u32, 0, 2 | 40 << 16, 166 | 1 << 8 | 2 << 16, 3 | 3 << 8, 16, 0, 0, 0, 0, 0];
    bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
    bytes.extend([0; 16]);
    bytes
}

#[test]
fn ktx2_cannot_claim_what_its_blocks_cannot_hold() {
    // Found by fuzzing: ETC1S whose global data lie at the end of the 64-bit address space.
    let mut far = ktx2(4, 4, 1, 0);
    far[44] = 1;
    far[64..72].copy_from_slice(&(u64::MAX - 9).to_le_bytes());
    far[104 + 12] = 163;
    let mut long = ktx2(4, 4, 1, 16);
    long[88..96].copy_from_slice(&u64::MAX.to_le_bytes());
    for (image, message) in [
        (far, "the KTX2 header refers beyond the 164 bytes"),
        (long, "the KTX2 header refers beyond the 164 bytes"),
        (ktx2(4, 4, 1, 1 << 50), "claims 1125899906842624 bytes for 1 blocks"),
        (ktx2(16_384, 16_384, 1, 16), "claims 16384 x 16384 texels, but has"),
        (ktx2(1 << 20, 4, 1, 16), "are not within 1 to 16384 a side"),
        (ktx2(4, 4, 6, 16), "several layers or faces"),
        (ktx2(4, 4, 1, 16), "the KTX2 image cannot be decoded"),
        (ktx2(4, 4, 1, 16)[..90].to_vec(), "the KTX2 header is broken"),
    ] {
        let mut builder = Builder::new();
        let view = builder.view(&image, json!({}));
        builder.push("images", json!({"bufferView": view}));
        let extensions = json!({"KHR_texture_basisu": {"source": 0}});
        builder.push("textures", json!({"extensions": extensions}));
        let texture = json!({"baseColorTexture": {"index": 0}});
        builder.push("materials", json!({"pbrMetallicRoughness": texture}));
        builder.triangle(json!({}));
        let warnings = builder.load().unwrap().warnings.join("\n");
        let expected = "test.glb: /images/0: ";
        assert!(warnings.contains(expected) && warnings.contains(message), "{warnings}");
    }
}

/// The extension has an older and a ratified name.
#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn meshopt_has_two_names() {
    let folder = shared("scenes/BoxMeshopt");
    let old = std::fs::read(folder.join("BoxMeshopt.glb")).unwrap();
    let text = b"EXT_meshopt_compression";
    let mut new = old.clone();
    let mut renamed = 0;
    for at in 0..new.len() - text.len() {
        if new[at..].starts_with(text) {
            new[at..at + 3].copy_from_slice(b"KHR");
            renamed += 1;
        }
    }
    assert!(renamed > 2);
    let geometry = |bytes: &[u8]| {
        let scene = Scene::from_slice(bytes, "box", None).unwrap().scene;
        scene.pose(&PoseRequest::default()).unwrap().geometry
    };
    assert_eq!(geometry(&old), geometry(&new));
}

/// Number of texels in the scene's images for which `wanted` is true.
fn texels(name: &str, wanted: fn([u8; 4]) -> bool) -> usize {
    let scene = Scene::load(&shared("scenes").join(name)).unwrap().scene;
    let images = scene.images.iter();
    let texels = images.flat_map(|image| image.pixels.as_chunks::<4>().0);
    texels.filter(|&&texel| wanted(texel)).count()
}

/// A balloon is blue above and green below (ETC1S); a lamp is made of copper (UASTC with Zstandard).
#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn etc1s_and_uastc_have_their_colours() {
    let balloon = "CesiumBalloonKTX2/CesiumBalloonKTX2.glb";
    let lamp = "AnisotropyBarnLamp-KTX-BasisU/AnisotropyBarnLamp.gltf";
    for found in [
        texels(balloon, |[r, _, b, _]| b > 200 && r < 150),
        texels(balloon, |[_, g, b, _]| g > 90 && b < 60),
        texels(lamp, |[r, g, b, a]| r > 150 && g > b && r > g + 50 && a == 255),
    ] {
        assert!(found > 1000, "{found}");
    }
}

/// Mipmaps are kept if the file has all of them down to a single texel, and ignored otherwise.
#[test]
fn ktx2_keeps_its_levels() {
    // A UASTC block of mode 8 holds a single colour: five bits of the mode, then eight bits for each channel.
    let block = |[r, g, b]: [u8; 3]| {
        let channels = [r, g, b, 255].map(u128::from);
        let shifted = channels.iter().zip([5, 13, 21, 29]);
        shifted.fold(0x17_u128, |bits, (channel, shift)| bits | channel << shift)
    };
    let colors = [[200, 0, 0], [0, 150, 0], [0, 0, 100], [50, 60, 70]];
    let file = |levels: usize| {
        let mut bytes = b"\xABKTX 20\xBB\r\n\x1A\n".to_vec();
        let words = [0, 1, 8, 8, 0, 0, 1, levels as u32, 0];
        bytes.extend(words.iter().flat_map(|word: &u32| word.to_le_bytes()));
        let descriptor = 80 + 24 * levels as u32;
        let words = [descriptor, 44, 0, 0, 0, 0, 0, 0];
        bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        let mut offset = u64::from(descriptor) + 44;
        for level in 0..levels {
            let size = if level == 0 { 64 } else { 16 };
            bytes.extend([offset, size, size].iter().flat_map(|word| word.to_le_bytes()));
            offset += size;
        }
        let words = [44_u32, 0, 2 | 40 << 16, 166 | 1 << 8 | 2 << 16, 3 | 3 << 8, 16];
        bytes.extend(words.iter().chain(&[0; 5]).flat_map(|word| word.to_le_bytes()));
        for (level, &color) in colors.iter().take(levels).enumerate() {
            for _ in 0..if level == 0 { 4 } else { 1 } {
                bytes.extend(block(color).to_le_bytes());
            }
        }
        bytes
    };
    for (levels, kept) in [(1, 1), (2, 1), (4, 4)] {
        let mut builder = Builder::new();
        let view = builder.view(&file(levels), json!({}));
        builder.push("images", json!({"bufferView": view, "mimeType": "image/ktx2"}));
        builder.push("textures", json!({"extensions": {"KHR_texture_basisu": {"source": 0}}}));
        builder.push("materials", json!({"emissiveTexture": {"index": 0}}));
        let loaded = builder.load().unwrap();
        assert_eq!(loaded.warnings, ["test.glb: left out: materials that nothing uses (1: 0)"]);
        let image = &loaded.scene.images[0];
        assert_eq!((image.width, image.height, image.full_levels()), (8, 8, 4));
        let found: Vec<_> = image.levels().collect();
        assert_eq!(found.len(), kept);
        for (level, (texels, [r, g, b])) in found.iter().zip(colors).enumerate() {
            let [width, height] = image.level_size(level as u32);
            assert_eq!(texels.len(), 4 * (width * height) as usize);
            assert_eq!(texels[..4], [r, g, b, 255], "level {level}");
        }
    }
}
