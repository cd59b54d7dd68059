//! Nothing is left out in silence: files with all that their format's specification allows, each thing of which is
//! either used or named.

use gpc::scene::Scene;
use serde_json::json;

use crate::scene_builder::{Builder, TRIANGLE};

/// Warnings of a file, and the last of them, which names what is left out.
#[track_caller]
fn left_out(bytes: &[u8], base: Option<&std::path::Path>) -> String {
    let loaded = Scene::from_slice(bytes, "test", base).unwrap();
    let last = loaded.warnings.last().cloned().unwrap_or_default();
    assert!(last.starts_with("test: left out: "), "{:?}", loaded.warnings);
    last
}

/// Words that a text does not have.
fn missing<'w>(text: &str, words: &[&'w str]) -> Vec<&'w str> {
    let is_missing = |word: &&&str| {
        let mut parts = text.split(|c: char| " ,:;()".contains(c));
        !parts.any(|part| part == **word)
    };
    words.iter().filter(is_missing).copied().collect()
}

#[test]
fn every_statement_of_obj() {
    // Statements of the specification, versions 3.0 and 2.11, that are not drawn.
    let unused = [
        "vp 0 0 0",
        "cstype bspline",
        "deg 3 3",
        "bmat u 1 0 0 1",
        "step 1 1",
        "curv 0 1 1 2",
        "curv2 1 2",
        "surf 0 1 0 1 1 2 3",
        "parm u 0 1",
        "trim 0 1 1",
        "hole 0 1 1",
        "scrv 0 1 1",
        "sp 1",
        "end",
        "con 1 0 1 1 1 0 1 1",
        "mg 1 0.5",
        "bevel on",
        "c_interp on",
        "d_interp on",
        "lod 5",
        "shadow_obj a.obj",
        "trace_obj a.obj",
        "ctech cparm 1",
        "stech cparma 1 1",
    ];
    let more =
        ["maplib a.map", "usemap a", "call a.obj", "csh ls", "bsp 1", "bzp 1", "cdc 1", "cdp 1", "res 1 1", "unknown"];
    for statements in [&unused[..10], &unused[10..], &more] {
        let text =
            format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\np 1\no a\ng a b\ns off\n{}\n", statements.join("\n"));
        let said = left_out(text.as_bytes(), None);
        let words: Vec<&str> = statements.iter().filter_map(|s| s.split(' ').next()).collect();
        assert_eq!(missing(&said, &words), [""; 0], "{said}");
        assert!(said.contains(&format!("OBJ statements ({}:", words.len())), "{said}");
    }
    for (text, expected) in [
        ("v 0 0 0 0.5\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "weights of vertices (1)"),
        ("v 0 0 0 1 1 1 0.5\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "seventh numbers of vertices (1)"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0 1\nf 1 2 3\n", "third texture coordinates (1)"),
        ("v 0 0 0 nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "undefined colours of vertices (1)"),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/2 3/3\n",
            "elements that corners name and the file lacks (1: texture coordinate)",
        ),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n", "materials that no MTL file has (1: a)"),
    ] {
        let said = left_out(text.as_bytes(), None);
        assert_eq!(said, format!("test: left out: {expected}"));
    }
}

#[test]
fn every_statement_of_mtl() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
    let image = image::RgbaImage::from_pixel(2, 2, image::Rgba([10, 20, 30, 255]));
    image.save(folder.path().join("a.png")).unwrap();
    // The specification's statements, and those of its extension for physically based materials.
    let statements = [
        "Ka .1 .1 .1",
        "Ks 1 1 1",
        "Ke 1 1 1",
        "Tf .5 .5 .5",
        "illum 4",
        "Ns 10",
        "sharpness 60",
        "Ni 1.5",
        "map_Ka a.png",
        "map_Ks a.png",
        "map_Ns a.png",
        "map_aat on",
        "decal a.png",
        "disp a.png",
        "bump a.png",
        "refl -type sphere a.png",
    ];
    let more = [
        "Pr .5",
        "Pm .5",
        "Ps .5",
        "Pc .5",
        "Pcr .5",
        "aniso .5",
        "anisor .5",
        "map_Pr a.png",
        "map_Pm a.png",
        "map_Ps a.png",
        "map_Ke a.png",
        "norm a.png",
        "map_bump a.png",
        "map_refl a.png",
        "unknown",
    ];
    for statements in [&statements[..], &more] {
        let mtl = format!("newmtl m\nKd 1 1 1\nd 1\nmap_Kd a.png\n{}\n", statements.join("\n"));
        std::fs::write(folder.path().join("m.mtl"), mtl).unwrap();
        let said = left_out(obj.as_bytes(), Some(folder.path()));
        let words: Vec<&str> = statements.iter().filter_map(|s| s.split(' ').next()).collect();
        assert_eq!(missing(&said, &words), [""; 0], "{said}");
    }
    let options = [
        "-blendu off",
        "-blendv off",
        "-boost 1",
        "-mm 0 1",
        "-t 1 1 1",
        "-texres 4",
        "-clamp on",
        "-bm 1",
        "-imfchan l",
        "-type cube_top",
        "-cc on",
    ];
    let map = format!("newmtl m\nmap_Kd {} -s 2 2 -o 0 0 a.png\nKd spectral a.rfl\nd -halo 0.5\n", options.join(" "));
    std::fs::write(folder.path().join("m.mtl"), map).unwrap();
    let said = left_out(obj.as_bytes(), Some(folder.path()));
    let words: Vec<&str> = options.iter().filter_map(|s| s.split(' ').next()).collect();
    assert_eq!(missing(&said, &words), [""; 0], "{said}");
    assert_eq!(missing(&said, &["spectral", "-halo"]), [""; 0], "{said}");
    // Values that change nothing are not named.
    let neutral = "newmtl m\nKa 0 0 0\nKs 0 0 0\nKe 0 0 0\nTf 1 1 1\nNi 1\nillum 2\nKd .5 .5 .5\n";
    std::fs::write(folder.path().join("m.mtl"), neutral).unwrap();
    let loaded = Scene::from_slice(obj.as_bytes(), "test", Some(folder.path())).unwrap();
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
}

#[test]
fn everything_in_stl() {
    let facet = "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet red\n";
    let said = left_out(format!("solid a\n{facet}endsolid a\nmade by hand\n").as_bytes(), None);
    let expected = "test: left out: normals that contradict the order of the corners (1); words behind endfacet (1: red); \
        words that are not of the format (3: made, by, hand)";
    assert_eq!(said, expected);
    let mut binary = b"MATERIAL=abcdefghijkl".to_vec();
    binary.resize(80, 0);
    binary.extend(1_u32.to_le_bytes());
    let floats: [f32; 12] = [0., 0., -1., 0., 0., 0., 1., 0., 0., 0., 1., 0.];
    binary.extend(floats.iter().flat_map(|x| x.to_le_bytes()));
    binary.extend([1, 0, 7, 7, 7]);
    let expected = "test: left out: attributes of triangles (1); bytes behind the triangles (3); materials of the header (1: \
        MATERIAL); normals that contradict the order of the corners (1)";
    assert_eq!(left_out(&binary, None), expected);
}

#[test]
fn everything_in_ply() {
    // Elements and properties of the format's description, and of the programs that extend it.
    let text = "ply\nformat ascii 1.0\nobj_info none\nunknown line\nelement vertex 3\nproperty float x\nproperty float y\n\
        property float z\nproperty float confidence\nproperty uchar material_index\nproperty list uchar int weights\n\
        element face 1\nproperty list uchar int vertex_indices\nproperty float nx\nproperty uchar flags\n\
        property uchar red\nproperty uchar green\nproperty uchar blue\n\
        element edge 1\nproperty int vertex1\nproperty int vertex2\nproperty uchar red\n\
        element tristrips 1\nproperty list int int vertex_indices\n\
        element material 2\nproperty uchar ambient_red\nelement user 1\nproperty float k\nend_header\n\
        0 0 0 1 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n3 0 1 2 0 0 1 2 3\n0 1 255\n3 0 1 2\n0\n0\n1\nrest\n";
    let expected = "test: left out: bytes behind the elements (4); elements (3: material, user); header lines (1: unknown); \
        properties of the element edge (1: red); properties of the element face (2: nx, flags); \
        properties of the element vertex (3: confidence, material_index, weights)";
    assert_eq!(left_out(text.as_bytes(), None), expected);
}

#[test]
fn extensions_and_attributes_of_gltf() {
    let mut builder = Builder::new();
    let positions = builder.floats(&TRIANGLE);
    let uvs = builder.floats(&[[0., 1.], [1., 1.], [0., 0.]]);
    let primitive = json!({
        "attributes": {"POSITION": positions, "TEXCOORD_0": uvs, "TEXCOORD_2": uvs, "COLOR_1": positions, "_HEAT": positions},
        "targets": [{"POSITION": positions, "TEXCOORD_0": uvs}],
        "extensions": {"KHR_materials_variants": {"mappings": []}, "EXT_mesh_features": {"featureIds": []}},
        "extras": {"extensions": {"ignored": 1}},
    });
    builder.node_with(primitive, json!({}));
    builder.json["extensions"] = json!({"KHR_xmp_json_ld": {"packets": []}, "EXT_mesh_features": {}});
    let expected = "test: left out: attributes of morph targets (1: TEXCOORD_0); \
        extensions (3: EXT_mesh_features, KHR_xmp_json_ld); vertex attributes (3: COLOR_1, TEXCOORD_2, _HEAT)";
    assert_eq!(left_out(&builder.glb(), None), expected);
}

/// Elements to which nothing refers, and parts without an effect.
#[test]
fn everything_in_gltf() {
    let mut builder = Builder::new();
    let positions = builder.floats(&TRIANGLE);
    let joints = builder.accessor("VEC4", 5121, &[0; 12], json!({}));
    let weights = builder.floats(&[[1., 0., 0., 0.]; 3]);
    let times = builder.floats(&[[0.], [1.]]);
    let moved = builder.floats(&[[0.; 3]; 2]);
    builder.texture([1, 2, 3]);
    let used = builder.texture([1, 2, 3]);
    builder.push("images", json!({"bufferView": 0, "name": "photo"}));
    builder.push("samplers", json!({"name": "sharp"}));
    let material = builder.push("materials", json!({
        "name": "paint", "alphaCutoff": 0.25, "pbrMetalicRoughness": {}, "normalTexture": {"index": used, "texCord": 1},
        "pbrMetallicRoughness": {"baseColourFactor": [1, 0, 0, 1]},
    }));
    builder.push("materials", json!({"name": "spare"}));
    let attributes = json!({
        "POSITION": positions, "JOINTS_0": joints, "WEIGHTS_0": weights, "JOINTS_2": joints, "WEIGHTS_1": weights,
    });
    let primitive = json!({"attributes": attributes, "material": material, "targets": [{"POSITION": positions}]});
    builder.node_with(
        primitive,
        json!({
            "weights": [0, 1], "children": [1],
            "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": positions, "_ID": times}}},
        }),
    );
    builder.triangle(json!({"skin": 0}));
    builder.push("nodes", json!({"name": "lost", "skin": 0, "children": [3]}));
    builder.push("nodes", json!({}));
    builder.push("meshes", json!({"name": "hull", "weights": [1, 1, 1], "primitives": [{"attributes": {}}]}));
    builder.push("accessors", json!({"name": "heat", "type": "SCALAR", "componentType": 5126, "count": 1}));
    builder.push("bufferViews", json!({"name": "rest", "buffer": 0, "byteLength": 4}));
    builder.push("skins", json!({"joints": [0]}));
    builder.push("skins", json!({"joints": [0], "name": "fur"}));
    builder.push(
        "cameras",
        json!({
            "name": "top", "type": "perspective", "perspective": {"yfov": 1, "znear": 1, "aspectRatio": -1, "fstop": 2},
        }),
    );
    builder.push("scenes", json!({"nodes": [0], "title": "first"}));
    builder.push(
        "animations",
        json!({
            "samplers": [{"input": times, "output": moved}, {"input": times, "output": moved}],
            "channels": [
                {"sampler": 0, "target": {"path": "scale"}},
                {"sampler": 0, "target": {"node": 0, "path": "colour"}},
            ],
        }),
    );
    builder.json["extensions"] = json!({
        "KHR_lights_punctual": {"lights": [{"name": "lamp", "type": "point"}]},
        "EXT_lights_image_based": {"lights": [{}]},
    });
    builder.json["extra"] = 1.into();
    let said = left_out(&builder.glb(), None);
    let kinds: Vec<&str> = said.trim_start_matches("test: left out: ").split("; ").collect();
    assert_eq!(
        kinds,
        [
            "accessors that nothing uses (1: heat)",
            "alpha cutoffs of materials that are not MASK (1)",
            "aspect ratios that are not positive (1)",
            "attributes of instances (1: _ID)",
            "buffer views that nothing uses (1: rest)",
            "cameras of no node (1: top)",
            "channels of animations of unknown properties (1: colour)",
            "channels of animations without a target (1: scale)",
            "environments of no scene (1: 0)",
            "images that nothing uses (1: photo)",
            "joints of meshes without a skin (1: 0)",
            "lights of no node (1: lamp)",
            "materials that nothing uses (1: spare)",
            "members that are not of the format (6: extra, pbrMetalicRoughness, title, baseColourFactor, texCord, fstop)",
            "meshes of no node (1: hull)",
            "nodes of no scene (2: lost, 3)",
            "samplers of animations that no channel uses (1)",
            "samplers that nothing uses (1: sharp)",
            "skins of meshes without joints (1)",
            "skins of no node (1: fur)",
            "skins of nodes without a mesh (1)",
            "textures that nothing uses (1: 0)",
            "vertex attributes (2: JOINTS_2, WEIGHTS_1)",
            "weights of no morph target (4)",
        ]
    );
    // Of a GLB: other chunks, and what follows it.
    let mut builder = Builder::new();
    builder.triangle(json!({}));
    let mut glb = builder.glb();
    glb.extend([4, 0, 0, 0, b'A', b'B', b'C', 0, 1, 2, 3, 4]);
    let length = (glb.len() as u32).to_le_bytes();
    glb[8..12].copy_from_slice(&length);
    glb.extend(b"more");
    assert_eq!(left_out(&glb, None), "test: left out: bytes behind the GLB (4); chunks (1: ABC)");
}
