//! Files that claim more than they contain, or repeat their contents excessively.

use crate::scene_builder::{Builder, TRIANGLE};
use gpc::scene::{PoseRequest, Scene, SceneError};
use serde_json::{Value, json};

#[track_caller]
fn refused(builder: &Builder, message: &str) {
    let error = builder.load().unwrap_err().to_string();
    assert!(error.contains(message), "{error}");
}

#[test]
fn accessors_cannot_claim_what_is_not_there() {
    for (change, message) in [
        (json!({"count": 4}), "4 elements of 12 bytes, 12 apart, at 0 reach beyond the 36 bytes"),
        (json!({"count": 0}), "/accessors/0/count: 0 elements"),
        (json!({"count": u64::MAX}), "/accessors/0/count: 18446744073709551615 elements"),
        (
            json!({"count": 4_000_000_000_u32, "bufferView": null}),
            "/accessors/0: claims 4000000000 elements, but has no buffer view",
        ),
        (json!({"byteOffset": u64::MAX}), "reach beyond"),
        (json!({"type": "VEC2"}), "expected elements of [3] components, found 2"),
        (json!({"type": "VEC9"}), "/accessors/0/type: \"VEC9\" is no valid type"),
        (json!({"componentType": 5124}), "/accessors/0/componentType: 5124"),
    ] {
        let mut builder = Builder::new();
        builder.triangle(json!({}));
        for (key, value) in change.as_object().unwrap() {
            builder.json["accessors"][0][key] = value.clone();
        }
        refused(&builder, message);
    }
}

#[test]
fn zeros_are_not_allocated_by_claim() {
    let void = json!({"type": "VEC3", "componentType": 5126, "count": 4_000_000_000_u32});
    let mut builder = Builder::new();
    let positions = builder.push("accessors", void.clone());
    builder.node_with(json!({"attributes": {"POSITION": positions}}), json!({}));
    refused(&builder, "/accessors/0: claims 4000000000 elements, but has no buffer view");

    let mut builder = Builder::new();
    let positions = builder.push("accessors", void.clone());
    let indices =
        builder.push("accessors", json!({"type": "SCALAR", "componentType": 5125, "count": 4_000_000_000_u32}));
    builder.node_with(json!({"attributes": {"POSITION": positions}, "indices": indices}), json!({}));
    refused(&builder, "/accessors/1: claims");

    let mut builder = Builder::new();
    let node = builder.triangle(json!({}));
    let translation = builder.push("accessors", void);
    builder.json["nodes"][node]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] =
        json!({"TRANSLATION": translation});
    refused(&builder, "claims 4000000000 instances without any data");
}

#[test]
fn compressed_views_cannot_claim_what_is_not_there() {
    let mut builder = Builder::new();
    builder.triangle(json!({}));
    let compressed = |count: u64, stride: u32, mode: &str| {
        json!({"EXT_meshopt_compression": {
            "buffer": 0, "byteLength": 36, "byteStride": stride, "count": count, "mode": mode,
        }})
    };
    for (count, stride, mode, message) in [
        (1_u64 << 40, 12, "ATTRIBUTES", "36 bytes cannot hold 1099511627776 elements of 12"),
        (3, 12, "ATTRIBUTES", "the compressed data are broken"),
        (3, 13, "ATTRIBUTES", "the compressed data are broken"),
        (3, 0, "ATTRIBUTES", "the compressed data are broken"),
        (4, 4, "TRIANGLES", "the compressed data are broken"),
        (3, 12, "TRIANGLES", "the compressed data are broken"),
        (3, 4, "INDICES", "the compressed data are broken"),
        (3, 4, "ZIP", "unknown compression mode \"ZIP\""),
    ] {
        builder.json["bufferViews"][0]["extensions"] = compressed(count, stride, mode);
        refused(&builder, message);
    }
}

#[test]
fn repetition_is_bounded() {
    // 20,000 primitives share a list of 60,000 indices: 400 million triangles.
    let mut builder = Builder::new();
    let positions = builder.floats(&TRIANGLE);
    let indices = builder.indices(&[0; 60_000]);
    let primitive = json!({"attributes": {"POSITION": positions}, "indices": indices});
    builder.push("meshes", json!({"primitives": vec![primitive; 20_000]}));
    builder.push("nodes", json!({"mesh": 0}));
    refused(&builder, "exceed the limit");

    // 40,000 nodes share a mesh of 20,000 triangles.
    let mut builder = Builder::new();
    let positions = builder.floats(&TRIANGLE);
    let indices = builder.indices(&[0; 60_000]);
    builder.node_with(json!({"attributes": {"POSITION": positions}, "indices": indices}), json!({}));
    for _ in 0..40_000 {
        builder.push("nodes", json!({"mesh": 0}));
    }
    let error = builder.load().unwrap().scene.pose(&PoseRequest::default());
    assert!(matches!(error, Err(SceneError::TooLarge { .. })));
}

/// Copies, morph targets and vertices multiply.
#[test]
fn displacements_are_bounded() {
    let mut builder = Builder::new();
    let positions = builder.floats(&vec![TRIANGLE; 2_000].concat());
    let target = json!({"POSITION": positions});
    let primitive = json!({"attributes": {"POSITION": positions}, "targets": vec![target; 400]});
    let translations = builder.floats(&[[0., 0., 0.]; 1_000]);
    let instances = json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": translations}}});
    builder.node_with(primitive, json!({"weights": vec![1.0; 400], "extensions": instances}));
    let loaded = builder.load().unwrap();
    let error = loaded.scene.pose(&PoseRequest::default()).unwrap_err();
    let expected = "2400000000 displacements of vertices by morph targets exceed the limit";
    assert!(error.to_string().contains(expected), "{error}");
    // Targets without an effect do not count.
    builder.json["nodes"][0]["weights"] = json!(vec![0.0; 400]);
    assert!(builder.load().unwrap().scene.pose(&PoseRequest::default()).is_ok());
}

/// Buffers and images of one file share its content, however they name it, and equal views are decoded once.
#[test]
fn one_file_is_read_once() {
    let folder = tempfile::tempdir().unwrap();
    let bytes: Vec<u8> = TRIANGLE.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    std::fs::write(folder.path().join("a.bin"), &bytes).unwrap();
    image::RgbaImage::from_pixel(2, 2, image::Rgba([1, 2, 3, 4])).save(folder.path().join("a.png")).unwrap();
    let names = |kind: &str| -> Vec<Value> {
        let spellings = [format!("a.{kind}"), format!("./a.{kind}"), format!("%61.{kind}"), format!("././a.{kind}")];
        spellings.map(|uri| json!({"uri": uri, "byteLength": 36})).to_vec()
    };
    let each = |value: &dyn Fn(usize) -> Value| (0..4).map(value).collect::<Vec<_>>();
    let document = json!({
        "asset": {"version": "2.0"}, "buffers": names("bin"), "images": names("png"),
        "bufferViews": each(&|i| json!({"buffer": i, "byteLength": 36})),
        "accessors": each(&|i| json!({"bufferView": i, "type": "VEC3", "componentType": 5126, "count": 3})),
        "textures": each(&|i| json!({"source": i})),
        "materials": each(&|i| json!({"emissiveTexture": {"index": i}})),
        "meshes": [{"primitives": each(&|i| json!({"attributes": {"POSITION": i}, "material": i}))}],
        "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}],
    });
    let loaded = Scene::from_slice(document.to_string().as_bytes(), "test", Some(folder.path())).unwrap();
    assert_eq!(loaded.scene.info().triangles, 4);
    assert_eq!((loaded.scene.images.len(), loaded.scene.textures.len()), (1, 4));
}

/// A material that needs tangents does without those that a file has wrong, whether it has textures or not.
#[test]
fn unusable_tangents_are_generated() {
    let good = [[1., 0., 0., 1.]; 3];
    for (tangents, is_usable) in [
        (vec![[0., 0., 0., 1.]; 3], false),
        (vec![[1., 0., 0., 1.], [0.; 4], [1., 0., 0., 1.]], false),
        (vec![[f32::NAN, 0., 0., 1.]; 3], false),
        (vec![[1., 0., 0., 1.]; 2], false),
        (good.to_vec(), true),
    ] {
        for (has_normals, has_uvs) in [(true, true), (true, false), (false, true)] {
            let mut builder = Builder::new();
            let mut attributes = json!({
                "POSITION": builder.floats(&TRIANGLE), "TANGENT": builder.floats(&tangents),
            });
            if has_normals {
                attributes["NORMAL"] = builder.floats(&[[0., 0., 1.]; 3]).into();
            }
            if has_uvs {
                // u grows along y.
                attributes["TEXCOORD_0"] = builder.floats(&[[0., 0.], [0., 1.], [1., 0.]]).into();
            }
            let anisotropy = json!({"KHR_materials_anisotropy": {"anisotropyStrength": 0.8}});
            let material = builder.push("materials", json!({"extensions": anisotropy}));
            builder.json["extensionsUsed"] = json!(["KHR_materials_anisotropy"]);
            let primitive = json!({"attributes": attributes, "material": material});
            builder.node_with(primitive, json!({}));
            let loaded = builder.load().unwrap();
            let told = loaded.warnings.iter().any(|text| text.to_lowercase().contains("tangent"));
            assert_eq!(told, has_normals && !is_usable, "{:?}", loaded.warnings);
            for [x, y, z, _] in builder.pose().geometry.streams.tangents {
                let expected = match (has_normals && is_usable, has_uvs) {
                    (true, _) => [1., 0., 0.],
                    (false, true) => [0., 1., 0.],
                    // Any direction across the normal.
                    (false, false) => [x, (1.0 - x * x).sqrt().copysign(y), 0.],
                };
                let off = [x - expected[0], y - expected[1], z - expected[2]];
                assert!(off.iter().all(|d| d.abs() < 1e-6), "{tangents:?}: {x} {y} {z}");
            }
        }
    }
}

/// The tip of a fan takes neither the square of its triangles' number in time, nor their number in calls.
#[test]
fn crowded_vertices_have_tangents() {
    const TRIANGLES: u32 = 300_000;
    let mut builder = Builder::new();
    let turn = |i: u32| f64::from(i) / f64::from(TRIANGLES) * std::f64::consts::TAU;
    let rim = |i: u32| [turn(i).cos() as f32, turn(i).sin() as f32];
    let places: Vec<[f32; 2]> = std::iter::once([0., 0.]).chain((0..TRIANGLES).map(rim)).collect();
    let positions: Vec<[f32; 3]> = places.iter().map(|[x, y]| [*x, *y, 0.]).collect();
    let triangles = (0..TRIANGLES).flat_map(|i| [0, 1 + i, 1 + (i + 1) % TRIANGLES]);
    let indices: Vec<u8> = triangles.flat_map(u32::to_le_bytes).collect();
    let attributes = json!({
        "POSITION": builder.floats(&positions),
        "NORMAL": builder.floats(&vec![[0., 0., 1.]; positions.len()]),
        // Texture coordinates turned by a quarter: u grows along y.
        "TEXCOORD_0": builder.floats(&places.iter().map(|[x, y]| [*y, *x]).collect::<Vec<_>>()),
    });
    let indices = builder.accessor("SCALAR", 5125, &indices, json!({}));
    let texture = builder.texture([128, 128, 255]);
    let material = builder.push("materials", json!({"normalTexture": {"index": texture}}));
    builder.node_with(json!({"attributes": attributes, "indices": indices, "material": material}), json!({}));
    let tangents = builder.pose().geometry.streams.tangents;
    assert_eq!(tangents.len(), positions.len());
    for [x, y, z, sign] in tangents {
        let off = [x, y - 1.0, z, sign - 1.0].map(f32::abs);
        assert!(off.iter().all(|d| *d < 1e-2), "{x} {y} {z} {sign}");
    }
}

#[test]
fn deep_hierarchies_do_not_overflow_the_stack() {
    const DEPTH: usize = 200_000;
    let mut builder = Builder::new();
    builder.triangle(json!({"translation": [1, 0, 0]}));
    for child in 0..DEPTH {
        builder.push("nodes", json!({"children": [child], "translation": [1, 0, 0]}));
    }
    let (low, _) = builder.pose().geometry.bounds().unwrap();
    assert_eq!(low.x, (DEPTH + 1) as f64);
}

#[test]
fn cycles_and_second_parents_are_found() {
    for (nodes, message) in [
        (json!([{"children": [0]}]), "/nodes/0: is its own ancestor"),
        (json!([{}, {"children": [2]}, {"children": [1]}]), "/nodes/1: is its own ancestor"),
        (json!([{"children": [2]}, {"children": [2]}, {}]), "/nodes/1/children: node 2 is already a child of node 0"),
        (json!([{"children": [1, 1]}, {}]), "node 1 is already a child of node 0"),
    ] {
        let mut builder = Builder::new();
        builder.json["nodes"] = nodes;
        refused(&builder, message);
    }
}

#[test]
fn transforms_beyond_floating_point_leave_their_meshes_out() {
    for node in [
        json!({"scale": [1e300, 1, 1], "translation": [1e308, 0, 0]}),
        json!({"translation": [1e35, 0, 0]}),
        json!({"matrix": [1e308, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1e308, 0, 0, 1]}),
    ] {
        let mut builder = Builder::new();
        builder.triangle(node);
        builder.triangle(json!({}));
        let pose = builder.pose();
        assert_eq!(pose.geometry.triangles.len(), 1);
        assert_eq!(pose.warnings.len(), 1, "{:?}", pose.warnings);
        assert!(pose.warnings[0].starts_with("test.glb: /nodes/0: "), "{:?}", pose.warnings);
    }
}

#[test]
fn what_is_not_gltf_is_named() {
    let message = |bytes: &[u8]| Scene::from_slice(bytes, "x", None).unwrap_err().to_string();
    assert_eq!(message(b""), "x: the file is empty");
    assert!(message(b"\x88PNG").contains("neither a GLB nor a glTF JSON document"));
    assert!(message(b"\x89PNG").contains("gpc zoom"));
    assert!(message(b" \n").contains("the JSON document is empty"));
    assert!(message(b"version https://git-lfs.github.com/spec/v1\n").contains("git lfs pull"));
    assert!(message(br#"{"asset": {"version": "1.0"}}"#).contains("glTF 1.0 is not supported"));
    assert!(message(br#"{"asset": {"version": "two"}}"#).contains("/asset/version"));
    let nested = [vec![b'['; 100_000], vec![b']'; 100_000]].concat();
    let nested = [br#"{"a":"#.as_slice(), &nested, b"}"].concat();
    assert!(message(&nested).contains("recursion limit"));
}

/// A scene with all kinds of parts, small enough to be damaged at every byte.
fn rich() -> Builder {
    let mut builder = Builder::new();
    let positions = builder.floats(&TRIANGLE);
    let uvs = builder.floats(&[[0., 1.], [1., 1.], [0., 0.]]);
    let joints = builder.accessor("VEC4", 5121, &[0; 12], json!({}));
    let weights = builder.floats(&[[1., 0., 0., 0.]; 3]);
    let indices = builder.indices(&[0, 1, 2]);
    let texture = builder.texture([1, 2, 3]);
    let material = builder.push("materials", json!({"normalTexture": {"index": texture}}));
    let node = builder.node_with(
        json!({
            "attributes": {"POSITION": positions, "TEXCOORD_0": uvs, "JOINTS_0": joints,
                           "WEIGHTS_0": weights},
            "indices": indices, "material": material, "targets": [{"POSITION": positions}],
        }),
        json!({"weights": [0.5], "camera": 0}),
    );
    builder.push("cameras", json!({"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}));
    builder.push("skins", json!({"joints": [1]}));
    builder.json["nodes"][node]["skin"] = 0.into();
    builder.push("nodes", json!({"translation": [1, 2, 3]}));
    builder.push("scenes", json!({"nodes": [0, 1]}));
    let (input, output) = (builder.floats(&[[0.], [1.]]), builder.floats(&[[0.; 3]; 2]));
    builder.push(
        "animations",
        json!({
            "channels": [{"sampler": 0, "target": {"node": 1, "path": "scale"}}],
            "samplers": [{"input": input, "output": output}],
        }),
    );
    builder
}

fn exercise(bytes: &[u8]) -> bool {
    let Ok(loaded) = Scene::from_slice(bytes, "broken.glb", None) else {
        return false;
    };
    let request = PoseRequest { time: 0.5, ..PoseRequest::default() };
    loaded.scene.pose(&request).is_ok()
}

#[test]
fn truncation_at_every_byte_is_an_error() {
    let bytes = rich().glb();
    assert!(exercise(&bytes));
    for length in 0..bytes.len() {
        assert!(!exercise(&bytes[..length]), "{length} bytes");
    }
}

#[test]
fn no_changed_byte_panics() {
    let bytes = rich().glb();
    for at in 0..bytes.len() {
        for change in [0x01, 0x80, 0xFF, 0x10] {
            let mut bytes = bytes.clone();
            bytes[at] ^= change;
            exercise(&bytes);
        }
    }
}

/// Replaces every value of the document, one at a time.
#[test]
fn no_changed_value_panics() {
    fn pointers(value: &Value, place: &str, found: &mut Vec<String>) {
        found.push(place.to_owned());
        if let Some(object) = value.as_object() {
            for (key, value) in object {
                pointers(value, &format!("{place}/{key}"), found);
            }
        } else if let Some(array) = value.as_array() {
            for (i, value) in array.iter().enumerate() {
                pointers(value, &format!("{place}/{i}"), found);
            }
        }
    }
    let original = rich();
    let mut places = Vec::new();
    pointers(&original.json, "", &mut places);
    assert!(places.len() > 100);
    for place in places {
        for value in [
            json!(null),
            json!(-1),
            json!(0),
            json!(1),
            json!(1e300),
            json!(u64::MAX),
            json!("x"),
            json!([]),
            json!({}),
            json!([0, 0]),
            json!(0.5),
            json!(true),
        ] {
            let mut builder = rich();
            *builder.json.pointer_mut(&place).unwrap() = value.clone();
            // The builder needs an object at the root.
            if builder.json.is_object() {
                exercise(&builder.glb());
            }
        }
    }
}
