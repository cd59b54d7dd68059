//! Files to mutate: one of each format and extension.

use std::{io::Cursor, path::Path};

use image::{ImageFormat, Rgb, Rgb32FImage};
use serde_json::json;

use super::{
    Seed,
    mutate::glb,
    scene_builder::{Builder, TRIANGLE},
    shared::shared,
};

const OBJ: &str = "mtllib none.mtl\no quad\nv 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\n\
    vt 1 0\nvn 0 0 1\nusemtl paint\nf 1/1/1 2/2/1 3/1/1 4/2/1\nf -1 -2 -3\nl 1 2/1 3\np -1 2\n";
const STL: &str = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n\
    vertex 0 1 0\nendloop\nendfacet\nendsolid\n";
const PLY: &str = "element vertex 3\nproperty float x\nproperty double y\nproperty short z\n\
    property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n\
    property list uchar int vertex_indices\nend_header\n";

const EDGES: &str = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n\
    property float z\nelement edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n\
    0 0 0\n1 0 0\n0 1\n";

const MTL: &str = "newmtl paint\nKa 0 0 0\nKd 0.5 0.25 1\nd 0.5\nNs 10\nillum 2\n\
    map_Kd -s 1 1 1 none.png\n";

/// Materials with maps, in the spellings that programs write.
const MAPS: &str = "newmtl paint\nKD .5\nmap_kd -s 2 2 -o 0 0 a.bmp\nMAP_D -imfchan l a.tga\nTr 0.5\nnewmtl\n\
    map_Kd \"C:\\maps\\a.png\"\nd -halo 0.5\nKs 1 1 1\n";

/// Concave polygons, holes with bridges, numbers that are none, and faces before their vertices.
const POLYGONS: &str = "mtllib \"a b.mtl\" c.mtl\rusemtl\rf 1 2 3 4 5\rf -1 -2 -3\rs 1\rv 0 0 0 255 0 0\rv 4 0 0\rv 4 4 0\r\
    v 2 1 0\rv 0 4 -nan(ind)\rg holes\rv 0 0 461234.5\rv 4 0 461234.5\rv 4 4 461234.5\rv 0 4 461234.5\rv 1 1 461234.5\r\
    v 1 3 461234.5\rv 3 3 461234.5\rv 3 1 461234.5\rf 6 7 8 9 6 10 11 12 13 10\rvt 1.#QNAN 0 1\rcurv 0 1 1 2\r";
const POINTS: &str = "v 0 0 0 1 0 0\nvn 0 0 1\nv 1 0 0 0 1 0\nvn 0 0 1\nv nan 0 0\nvn 0 0 1\n";

const SOLIDS: &str = "\n SOLID a name\r\nFACET NORMAL nan 0 1\r\nOUTER LOOP\r\nVERTEX 461234.5 5428765.25 0\r\n\
    VERTEX 461235.5 5428765.25 0\r\nVERTEX 461234.5 5428766.25 0\r\nEND LOOP\r\nENDFACET color 1023\r\nEND SOLID\r\n\
    solid\rcolor 1 0 0\rfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 4 0 0 vertex 4 4 0 vertex 2 1 0 vertex 0 4 0 endloop\r";

const FACES: &str = "ply\nformat ascii 1.0\ncomment TextureFile a.bmp\ncomment TextureFile a.tga\nelement vertex 5\n\
    property double x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n\
    property float s\nproperty float t\nproperty uchar alpha\nelement face 2\nproperty uchar r\nproperty uchar g\n\
    property uchar b\nproperty list uchar int vertex_index\nproperty list uchar float texcoord\nproperty int texnumber\n\
    element tristrips 1\nproperty list int int vertex_indices\nelement material 1\nproperty float k\nend_header\n\
    0 0 0 0 0 1 0 0 255\n4 0 0 -nan(ind) 0 1 1 0 0\n4 4 0 0 0 1 1 1 255\n2 1 0 0 0 1 1 0 9\n0 4 0 0 0 1 0 0 5\n\
    255 0 0 5 0 1 2 3 4 10 0 0 1 0 1 1 0 1 0 0 0\n0 9 1 3 0 1 2 6 0 0 0 0 0 0 1\n6 0 1 2 -1 0 1\n1\n";

/// All seeds: those made here, whose OBJ file is in `folder`, and small scenes of `../shared` if that exists.
pub fn all(folder: &Path) -> Vec<Seed> {
    let mut seeds = vec![
        made("rich.glb", rich().glb()),
        made("rich.gltf", rich().json.to_string().into_bytes()),
        Seed {
            base: Some(folder.to_owned()),
            beside: Some((folder.join("none.mtl"), MTL.into())),
            ..made("quad.obj", OBJ.into())
        },
        made("polygons.obj", POLYGONS.into()),
        made("points.obj", POINTS.into()),
        material("plain.mtl", folder, MTL),
        material("maps.mtl", folder, MAPS),
        made("text.stl", STL.into()),
        made("solids.stl", SOLIDS.into()),
        made("colored.stl", colored_stl()),
        made("binary.stl", binary_stl()),
        made("text.ply", ascii_ply()),
        made("binary.ply", binary_ply(false)),
        made("swapped.ply", binary_ply(true)),
        made("sky.hdr", hdr()),
        made("sky.exr", exr(folder)),
        made("edges.ply", EDGES.into()),
        Seed { base: Some(folder.to_owned()), ..made("faces.ply", FACES.into()) },
    ];
    let image = image::RgbaImage::from_fn(4, 4, |x, y| image::Rgba([9, 8, 7, (50 * x + y) as u8]));
    for name in ["a.bmp", "a.tga", "a.png"] {
        image.save(folder.join(name)).unwrap();
    }
    let scenes = [
        "Box-Draco/Box.gltf",
        "BoxMeshopt/BoxMeshopt.glb",
        "CesiumBalloonKTX2/CesiumBalloonKTX2.glb",
        "CesiumMilkTruck-Draco/CesiumMilkTruck.gltf",
        "MorphPrimitivesTest/MorphPrimitivesTest.glb",
        "SimpleSparseAccessor/SimpleSparseAccessor.gltf",
        "WebpRequired/box-textured-separate.gltf",
    ];
    if cfg!(shared_files) {
        seeds.extend(scenes.map(from_scene));
    }
    seeds
}

fn made(name: &str, bytes: Vec<u8>) -> Seed {
    Seed { name: name.to_owned(), bytes, base: None, beside: None }
}

/// A scene whose MTL file is mutated, but not the scene itself.
fn material(name: &str, folder: &Path, mtl: &str) -> Seed {
    let path = folder.join(name);
    std::fs::write(&path, mtl).unwrap();
    Seed {
        base: Some(folder.to_owned()),
        beside: Some((path, mtl.into())),
        ..made(name, OBJ.replace("none.mtl", name).into())
    }
}

/// A scene of `../shared`. A buffer beside it is included in the file, so that mutations reach compressed data.
fn from_scene(name: &str) -> Seed {
    let path = shared("scenes").join(name);
    let mut bytes = std::fs::read(&path).unwrap();
    let base = path.parent().unwrap().to_owned();
    if name.ends_with(".gltf") {
        let mut json: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
        let uri = json["buffers"][0]["uri"].as_str().unwrap().to_owned();
        if let Ok(binary) = std::fs::read(base.join(&uri)) {
            json["buffers"][0].as_object_mut().unwrap().remove("uri");
            bytes = glb(json.to_string().as_bytes(), &binary);
        }
    }
    Seed { name: name.replace('/', "-"), bytes, base: Some(base), beside: None }
}

/// A scene with all parts that need no compression.
fn rich() -> Builder {
    let mut builder = Builder::new();
    let positions = builder.floats(&TRIANGLE);
    let uvs = builder.floats(&[[0., 1.], [1., 1.], [0., 0.]]);
    let joints = builder.accessor("VEC4", 5121, &[0; 12], json!({}));
    let weights = builder.floats(&[[1., 0., 0., 0.]; 3]);
    let indices = builder.indices(&[0, 1, 2]);
    let texture = builder.texture([1, 2, 3]);
    let material = builder.push(
        "materials",
        json!({
            "normalTexture": {"index": texture}, "alphaMode": "MASK",
            "extensions": {
                "KHR_materials_pbrSpecularGlossiness": {"glossinessFactor": 0.5},
                "KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatTexture": {"index": texture}},
                "KHR_materials_ior": {"ior": 1.2},
                "KHR_materials_transmission": {"transmissionFactor": 1},
                "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 2},
            },
        }),
    );
    let node = builder.node_with(
        json!({
            "attributes": {"POSITION": positions, "TEXCOORD_0": uvs, "JOINTS_0": joints,
                           "WEIGHTS_0": weights},
            "indices": indices, "material": material, "targets": [{"POSITION": positions}],
            "extensions": {"KHR_materials_variants": {"mappings": [
                {"material": 0, "variants": [0]},
            ]}},
        }),
        json!({"weights": [0.5], "camera": 0}),
    );
    for mode in [0, 1, 2, 3] {
        builder.json["meshes"][0]["primitives"].as_array_mut().into_iter().for_each(|primitives| {
            primitives.push(json!({
                "attributes": {"POSITION": positions, "NORMAL": positions}, "indices": indices,
                "mode": mode, "targets": [{"POSITION": positions}],
            }));
        });
    }
    builder.json["extensions"] = json!({
        "KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {"innerConeAngle": 0.1}}]},
        "KHR_materials_variants": {"variants": [{"name": "day"}]},
    });
    builder.push("cameras", json!({"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}));
    builder.push("skins", json!({"joints": [1]}));
    builder.json["nodes"][node]["skin"] = 0.into();
    builder.push(
        "nodes",
        json!({
            "translation": [1, 2, 3],
            "extensions": {"KHR_lights_punctual": {"light": 0},
                           "KHR_node_visibility": {"visible": true}},
        }),
    );
    let faces = [(); 6].map(|()| builder.rgba([9, 8, 7, 6]));
    builder.json["extensions"]["EXT_lights_image_based"] = json!({"lights": [{
        "irradianceCoefficients": vec![[1, 1, 1]; 9], "specularImageSize": 1, "specularImages": [faces],
    }]});
    builder.push("scenes", json!({"nodes": [0, 1], "extensions": {"EXT_lights_image_based": {"light": 0}}}));
    builder.pointers(&[
        ("/materials/0/normalTexture/scale", vec![1.0, 2.0]),
        ("/materials/0/extensions/KHR_materials_volume/attenuationDistance", vec![1.0, 0.0]),
        ("/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", vec![0.2, 1.0]),
        ("/cameras/0/perspective/yfov", vec![0.5, 1.0]),
        ("/meshes/0/weights", vec![0.0, 1.0]),
    ]);
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

fn binary_stl() -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend(2_u32.to_le_bytes());
    for _ in 0..2 {
        bytes.extend([0; 12]);
        let floats = TRIANGLE.as_flattened().iter();
        bytes.extend(floats.flat_map(|x: &f32| x.to_le_bytes()));
        bytes.extend([0, 0]);
    }
    bytes
}

/// Colours of both conventions, and bytes behind the triangles.
fn colored_stl() -> Vec<u8> {
    let mut bytes = binary_stl();
    bytes[..10].copy_from_slice(b"COLOR=\x01\x02\x03\xFF");
    bytes[132..134].copy_from_slice(&0x8000_u16.to_le_bytes());
    bytes[182..184].copy_from_slice(&0x001F_u16.to_le_bytes());
    bytes.extend(*b"more");
    bytes
}

fn ascii_ply() -> Vec<u8> {
    let rows = "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n";
    format!("ply\nformat ascii 1.0\n{PLY}{rows}").into_bytes()
}

fn binary_ply(swapped: bool) -> Vec<u8> {
    let order = if swapped { "big" } else { "little" };
    let mut bytes = format!("ply\nformat binary_{order}_endian 1.0\n{PLY}").into_bytes();
    let mut push = |number: &[u8]| match swapped {
        true => bytes.extend(number.iter().rev()),
        false => bytes.extend(number),
    };
    for [x, y, z] in TRIANGLE {
        push(&x.to_le_bytes());
        push(&f64::from(y).to_le_bytes());
        push(&(z as i16).to_le_bytes());
        [255, 0, 188].iter().for_each(|color| push(&[*color]));
    }
    push(&[3]);
    [0_i32, 1, 2].iter().for_each(|i| push(&i.to_le_bytes()));
    bytes
}

/// An equirectangular image of 8 x 4 texels in Radiance format.
fn hdr() -> Vec<u8> {
    let sky = Rgb32FImage::from_fn(8, 4, |x, y| Rgb([x as f32, 0.5, 2.0 * y as f32]));
    let mut bytes = Cursor::new(Vec::new());
    sky.write_to(&mut bytes, ImageFormat::Hdr).unwrap();
    bytes.into_inner()
}

/// The same image in EXR format.
fn exr(folder: &Path) -> Vec<u8> {
    let path = folder.join("sky.exr");
    let texel = |x: usize, y: usize| (x as f32, 0.5_f32, 2.0 * y as f32);
    exr::prelude::write_rgb_file(&path, 8, 4, texel).unwrap();
    std::fs::read(path).unwrap()
}
