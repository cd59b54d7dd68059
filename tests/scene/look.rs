//! Materials, textures, lights and cameras, and warnings about them.

use crate::scene_builder::{Builder, png};
use glam::{DMat3, DVec3};
use gpc::scene::{
    AlphaMode, Filter, LightKind, Lobes, Material, Pose, PoseRequest, Sampler, Scene, SceneError, SceneProjection, Wrap,
};
use serde_json::json;

#[test]
fn materials_read_all_their_fields() {
    let mut builder = Builder::new();
    let texture = builder.texture([10, 20, 30]);
    builder.push("samplers", json!({"magFilter": 9728, "minFilter": 9985, "wrapS": 33071}));
    builder.json["textures"][texture]["sampler"] = 0.into();
    builder.push(
        "materials",
        json!({
            "name": "all",
            "pbrMetallicRoughness": {
                "baseColorFactor": [0.1, 0.2, 0.3, 0.4],
                "metallicFactor": 0.5,
                "roughnessFactor": 0.6,
                "baseColorTexture": {"index": texture, "extensions": {"KHR_texture_transform": {
                    "offset": [0.25, 0.5], "scale": [2, 3], "rotation": std::f64::consts::FRAC_PI_2,
                    "texCoord": 1,
                }}},
            },
            "normalTexture": {"index": texture, "scale": 0.7},
            "occlusionTexture": {"index": texture, "strength": 0.8},
            "emissiveFactor": [0.5, 0, 1],
            "alphaMode": "MASK",
            "alphaCutoff": 0.3,
            "doubleSided": true,
            "extensions": {
                "KHR_materials_emissive_strength": {"emissiveStrength": 4},
                "KHR_materials_unlit": {},
            },
        }),
    );
    let scene = builder.load().unwrap().scene;
    assert_eq!(scene.materials.len(), 2);
    assert_eq!(scene.materials[1], Material::default());
    let material = &scene.materials[0];
    assert_eq!(material.name.as_deref(), Some("all"));
    assert_eq!(material.base_color, [0.1, 0.2, 0.3, 0.4]);
    assert_eq!((material.metallic, material.roughness), (0.5, 0.6));
    assert_eq!((material.normal_scale, material.occlusion_strength), (0.7, 0.8));
    assert_eq!(material.emissive, [2.0, 0.0, 4.0]);
    assert_eq!(material.alpha_mode, AlphaMode::Mask { cutoff: 0.3 });
    assert!(material.double_sided && material.unlit);
    assert!(material.metallic_roughness_texture.is_none());

    let used = material.base_color_texture.unwrap();
    assert_eq!(used.uv_set, 1);
    // The transform scales, then rotates by a quarter counter-clockwise (with v down), then translates.
    let [row_u, row_v] = used.transform.0;
    let transformed = |u: f32, v: f32| [row_u, row_v].map(|row| row[0] * u + row[1] * v + row[2]);
    for (uv, expected) in [([1.0, 0.0], [0.25, -1.5]), ([0.0, 1.0], [3.25, 0.5])] {
        let found = transformed(uv[0], uv[1]);
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{uv:?}: {found:?}");
        }
    }
    assert_eq!(
        scene.textures[used.texture as usize].sampler,
        Sampler {
            mag: Filter::Nearest,
            min: Filter::Linear,
            mip: Some(Filter::Nearest),
            wrap_u: Wrap::ClampToEdge,
            wrap_v: Wrap::Repeat,
        }
    );
    assert_eq!(scene.images.len(), 1);
    assert_eq!(scene.images[0].pixels, [10, 20, 30, 255]);
}

#[test]
fn broken_looks_are_warnings() {
    let mut builder = Builder::new();
    let good = builder.texture([1, 2, 3]);
    let view = builder.view(b"not an image", json!({}));
    builder.push("images", json!({"bufferView": view}));
    let bad = builder.push("textures", json!({"source": 1}));
    builder.push(
        "materials",
        json!({
            "pbrMetallicRoughness": {"baseColorTexture": {"index": bad}, "metallicFactor": 0},
            "normalTexture": {"index": 99},
            "occlusionTexture": {"index": good, "texCoord": 2},
            "emissiveTexture": {"index": good},
        }),
    );
    builder.push("materials", json!({"alphaMode": "GLASS", "doubleSided": true}));
    builder.triangle(json!({}));
    builder.json["meshes"][0]["primitives"][0]["material"] = 77.into();
    let loaded = builder.load().unwrap();
    let [first, second, default] = &loaded.scene.materials[..] else {
        panic!("{:?}", loaded.scene.materials);
    };
    assert_eq!(first.metallic, 0.0);
    assert!(first.base_color_texture.is_none() && first.normal_texture.is_none());
    assert!(first.occlusion_texture.is_none());
    assert_eq!(first.emissive_texture.unwrap().texture, 0);
    assert_eq!((second, default), (&Material::default(), &Material::default()));
    let pose = loaded.scene.pose(&Default::default()).unwrap();
    assert_eq!(pose.geometry.draws[0].material, 2);
    for place in [
        "/materials/0/normalTexture/index",
        "/materials/0/occlusionTexture",
        "/materials/1/alphaMode",
        "/images/1",
        "/textures/1",
        "/meshes/0/primitives/0/material",
    ] {
        let expected = format!("test.glb: {place}: ");
        assert!(loaded.warnings.iter().any(|w| w.starts_with(&expected)), "{place}: {:?}", loaded.warnings);
    }
}

/// Bytes of a 1 x 1 WebP image.
fn webp(rgb: [u8; 3]) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbImage::from_pixel(1, 1, image::Rgb(rgb)).write_to(&mut bytes, image::ImageFormat::WebP).unwrap();
    bytes.into_inner()
}

#[test]
fn webp_is_preferred_and_has_a_fallback() {
    for (bytes, expected) in [(webp([9, 9, 9]), 9), (b"RIFF\0\0\0\0WEBPVP8 ".to_vec(), 5)] {
        let mut builder = Builder::new();
        let fallback = builder.view(&png([5, 5, 5]), json!({}));
        let preferred = builder.view(&bytes, json!({}));
        builder.push("images", json!({"bufferView": fallback}));
        builder.push("images", json!({"bufferView": preferred}));
        builder.push("textures", json!({"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}}));
        builder.push("materials", json!({"emissiveTexture": {"index": 0}}));
        let scene = builder.load().unwrap().scene;
        let used = scene.materials[0].emissive_texture.unwrap();
        let image = scene.textures[used.texture as usize].image;
        assert_eq!(scene.images[image as usize].pixels[0], expected);
    }
}

#[test]
fn images_that_claim_too_much_are_left_out() {
    let mut builder = Builder::new();
    // A PNG's header may claim any size.
    let mut bytes = png([0; 3]);
    bytes[16..24].copy_from_slice(&[0, 0, 0x40, 0, 0, 0, 0x40, 0]);
    let checksum = crc32(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&checksum.to_be_bytes());
    let view = builder.view(&bytes, json!({}));
    builder.push("images", json!({"bufferView": view}));
    builder.push("textures", json!({"source": 0}));
    builder.push("materials", json!({"emissiveTexture": {"index": 0}}));
    let warnings = builder.load().unwrap().warnings.join("\n");
    assert!(warnings.contains("claims 16384 x 16384 texels, but has"), "{warnings}");
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |mut crc, &byte| {
        crc ^= u32::from(byte);
        for _ in 0..8 {
            crc = (crc >> 1) ^ (0xEDB8_8320 & (crc & 1).wrapping_neg());
        }
        crc
    })
}

#[test]
fn lights_are_placed_and_directed() {
    let mut builder = Builder::new();
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = json!([
        {"type": "directional", "color": [1, 0.5, 0], "intensity": 4, "range": 3},
        {"type": "spot", "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.4}, "range": 7},
        {"type": "laser"},
        {"type": "point"},
        {"type": "spot", "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.5}},
    ]);
    for (light, translation) in [(0, [0, 0, 0]), (1, [1, 2, 3]), (2, [0, 0, 0]), (3, [4, 0, 0]), (4, [0, 0, 0])] {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        builder.push(
            "nodes",
            json!({
                "translation": translation, "rotation": [half, 0, 0, half], "scale": [3, 3, 3],
                "extensions": {"KHR_lights_punctual": {"light": light}},
            }),
        );
    }
    let loaded = builder.load().unwrap();
    assert!(loaded.warnings.iter().any(|w| w.contains("\"laser\"")), "{:?}", loaded.warnings);
    let lights = loaded.scene.pose(&Default::default()).unwrap().lights;
    let [sun, spot, point, hard] = lights[..] else {
        panic!("{lights:?}");
    };
    assert_eq!((sun.kind, sun.color, sun.range), (LightKind::Directional, [4., 2., 0.], None));
    // A quarter turn around x takes -z to +y.
    assert!((sun.direction - DVec3::Y).length() < 1e-9, "{sun:?}");
    assert_eq!(spot.position, DVec3::new(1., 2., 3.));
    assert_eq!(spot.range, Some(7.0));
    assert_eq!(spot.kind, LightKind::Spot { inner_angle: 0.2, outer_angle: 0.4 });
    assert_eq!((point.kind, point.color), (LightKind::Point, [1.0; 3]));
    assert!(
        matches!(hard.kind, LightKind::Spot { inner_angle, outer_angle }
            if inner_angle < outer_angle && inner_angle > 0.49 && outer_angle == 0.5),
        "{hard:?}"
    );
    assert_eq!(loaded.scene.info().lights, 4);
}

#[test]
fn cameras_are_placed_without_scale() {
    let mut builder = Builder::new();
    builder.push("cameras", json!({"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "aspectRatio": 2}}));
    builder.push(
        "cameras",
        json!({"name": "plan", "type": "orthographic",
               "orthographic": {"xmag": 2, "ymag": 3, "znear": 0, "zfar": 9}}),
    );
    builder.push("cameras", json!({"type": "perspective", "perspective": {"yfov": 4, "znear": 1}}));
    let half = std::f64::consts::FRAC_1_SQRT_2;
    builder.push(
        "nodes",
        json!({"camera": 0, "name": "eye", "translation": [1, 2, 3],
               "rotation": [0, half, 0, half], "scale": [2, 5, -3]}),
    );
    builder.push("nodes", json!({"camera": 1}));
    builder.push("nodes", json!({"camera": 2}));
    let loaded = builder.load().unwrap();
    assert!(loaded.warnings.iter().any(|w| w.contains("/cameras/2/")), "{:?}", loaded.warnings);
    let cameras = loaded.scene.pose(&Default::default()).unwrap().cameras;
    let [eye, plan] = &cameras[..] else {
        panic!("{cameras:?}");
    };
    assert_eq!(eye.name.as_deref(), Some("eye"));
    assert_eq!(eye.eye, DVec3::new(1., 2., 3.));
    // A quarter turn around y takes z to x; the scale mirrors, and the right vector follows.
    let expected = DMat3::from_cols(DVec3::Z, DVec3::Y, DVec3::NEG_X);
    assert!(eye.axes.abs_diff_eq(expected, 1e-9), "{:?}", eye.axes);
    assert_eq!(eye.projection, SceneProjection::Perspective { yfov: 1.0, aspect: Some(2.0), near: 0.1, far: None });
    assert_eq!(plan.name.as_deref(), Some("plan"));
    let info = loaded.scene.info();
    let kinds: Vec<_> = info.cameras.iter().map(|c| c.kind).collect();
    assert_eq!(kinds, ["perspective", "orthographic"]);
}

#[test]
fn required_extensions_are_refused_by_name_and_optional_ones_mentioned() {
    let mut builder = Builder::new();
    builder.json["extensionsRequired"] = json!(["KHR_mesh_quantization", "KHR_gaussian_splatting"]);
    let error = builder.load().unwrap_err();
    assert!(matches!(&error, SceneError::Extension { name, .. } if name.contains("splatting")));
    let way_out = "export the scene without KHR_gaussian_splatting";
    assert!(error.to_string().contains(way_out), "{error}");

    let mut builder = Builder::new();
    builder.json["extensionsUsed"] = json!(["KHR_materials_subsurface", "KHR_xmp_json_ld"]);
    let warnings = builder.load().unwrap().warnings;
    assert!(warnings[0].ends_with("drawn without KHR_materials_subsurface"), "{warnings:?}");
    assert_eq!(warnings[1..], ["test.glb: left out: buffers that nothing uses (1: 0)"]);
}

#[test]
fn info_serialises() {
    let mut builder = Builder::new();
    builder.json["asset"]["generator"] = "test".into();
    builder.push("materials", json!({"alphaMode": "BLEND"}));
    builder.triangle(json!({}));
    let scene = builder.load().unwrap().scene;
    let info = serde_json::to_value(scene.info()).unwrap();
    assert_eq!(info["version"], "2.0");
    assert_eq!(info["generator"], "test");
    assert_eq!(info["triangles"], 1);
    assert_eq!(info["materials"], json!({"opaque": 0, "mask": 0, "blend": 1}));
    assert_eq!(info["scenes"], json!({"names": [], "default": null}));
}

#[test]
fn relative_files_need_a_folder() {
    let text = br#"{"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "type": "VEC3", "componentType": 5126, "count": 3}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data%20file.bin"}]}"#;
    let error = Scene::from_slice(text, "-", None).unwrap_err().to_string();
    assert!(error.starts_with("-: /buffers/0/uri: "), "{error}");
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("data file.bin"), [0; 40]).unwrap();
    let scene = Scene::from_slice(text, "-", Some(folder.path())).unwrap().scene;
    assert_eq!(scene.info().triangles, 1);
}

#[test]
fn hidden_nodes_have_neither_meshes_nor_lights() {
    let mut builder = Builder::new();
    let hidden = json!({"KHR_node_visibility": {"visible": false}});
    let light = json!({"KHR_lights_punctual": {"light": 0}, "KHR_node_visibility": {}});
    builder.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "point"}]}});
    builder.triangle(json!({"extensions": {"KHR_node_visibility": {"visible": true}}}));
    builder.triangle(json!({"camera": 0}));
    builder.push("nodes", json!({"extensions": light}));
    builder.push("nodes", json!({"children": [1, 2], "extensions": hidden}));
    builder.push("nodes", json!({"extensions": light}));
    builder.push("cameras", json!({"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}));
    let scene = builder.load().unwrap().scene;
    let pose = scene.pose(&Default::default()).unwrap();
    assert_eq!(pose.geometry.triangles.len(), 1);
    assert_eq!((pose.lights.len(), pose.cameras.len()), (1, 1));
    let info = scene.info();
    assert_eq!((info.triangles, info.lights), (1, 1));
}

#[test]
fn variants_choose_the_materials() {
    let mut builder = Builder::new();
    for name in ["plain", "red", "blue"] {
        builder.push("materials", json!({"name": name}));
    }
    builder.triangle(json!({}));
    let variants = json!([{"name": "day"}, {"name": "night"}, {"name": "never"}]);
    builder.json["extensions"] = json!({"KHR_materials_variants": {"variants": variants}});
    builder.json["meshes"][0]["primitives"][0]["material"] = 0.into();
    builder.json["meshes"][0]["primitives"][0]["extensions"] = json!({"KHR_materials_variants": {
        "mappings": [{"material": 1, "variants": [0]}, {"material": 2, "variants": [1]}],
    }});
    let bytes = builder.glb();
    let material = |loaded: gpc::scene::Loaded| {
        let pose = loaded.scene.pose(&Default::default()).unwrap();
        let index = pose.geometry.draws[0].material as usize;
        loaded.scene.materials[index].name.clone().unwrap()
    };
    let chosen = |variant| Scene::variant_from_slice(&bytes, "test.glb", None, variant);
    assert_eq!(material(builder.load().unwrap()), "plain");
    assert_eq!(material(chosen("day").unwrap()), "red");
    assert_eq!(material(chosen("night").unwrap()), "blue");
    assert_eq!(material(chosen("never").unwrap()), "plain");
    let error = chosen("dusk").unwrap_err().to_string();
    let expected = "there is no variant \"dusk\"; the file has \"day\", \"night\", \"never\"";
    assert!(error.contains(expected), "{error}");
    let info = builder.load().unwrap().scene.info();
    assert_eq!(info.variants, ["day", "night", "never"]);
}

#[test]
fn lobes_are_read() {
    let mut builder = Builder::new();
    let texture = builder.texture([1, 2, 3]);
    let all = json!({
        "KHR_materials_ior": {"ior": 2.0},
        "KHR_materials_specular": {
            "specularFactor": 0.5, "specularColorFactor": [2, 1, 0.5], "specularTexture": {"index": texture},
        },
        "KHR_materials_clearcoat": {
            "clearcoatFactor": 0.25, "clearcoatRoughnessFactor": 0.75,
            "clearcoatNormalTexture": {"index": texture, "scale": 3, "texCoord": 1},
        },
        "KHR_materials_sheen": {"sheenColorFactor": [0.5, 0.25, 1], "sheenRoughnessFactor": 0.5},
        "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": 1.5},
        "KHR_materials_iridescence": {"iridescenceFactor": 1, "iridescenceThicknessMaximum": 500},
        "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.5},
        "KHR_materials_transmission": {"transmissionFactor": 0.5},
        "KHR_materials_volume": {
            "thicknessFactor": 2, "attenuationDistance": 4, "attenuationColor": [1, 0.5, 0.25],
        },
        "KHR_materials_pbrSpecularGlossiness": {
            "diffuseFactor": [0.5, 0.25, 0.125, 0.5], "specularFactor": [0.5, 0, 0], "glossinessFactor": 0.75,
        },
    });
    let names: Vec<_> = all.as_object().unwrap().keys().cloned().collect();
    builder.json["extensionsRequired"] = json!(names);
    builder.push("materials", json!({"extensions": all}));
    // Lobes without an effect are absent.
    builder.push(
        "materials",
        json!({"extensions": {"KHR_materials_clearcoat": {}, "KHR_materials_sheen": {},
            "KHR_materials_anisotropy": {}, "KHR_materials_iridescence": {},
            "KHR_materials_diffuse_transmission": {}, "KHR_materials_transmission": {},
            "KHR_materials_volume": {}}}),
    );
    let loaded = builder.load().unwrap();
    let approximated = |name: &&str| {
        let expected = format!("{name} is approximated: ");
        loaded.warnings.iter().any(|w| w.contains(&expected))
    };
    let names = ["KHR_materials_diffuse_transmission", "KHR_materials_transmission", "KHR_materials_volume"];
    assert!(names.iter().all(approximated), "{:?}", loaded.warnings);
    // The last warning is about materials that nothing uses.
    assert_eq!(loaded.warnings.len(), names.len() + 1, "{:?}", loaded.warnings);
    assert_eq!(loaded.scene.materials[1].lobes, Lobes::default());
    let material = &loaded.scene.materials[0];
    assert_eq!(material.base_color, [0.5, 0.25, 0.125, 0.5]);
    let lobes = material.lobes;
    let specular = lobes.specular.unwrap();
    assert!((specular.reflectance - 1.0 / 9.0).abs() < 1e-6);
    assert_eq!((specular.factor, specular.color), (0.5, [2.0, 1.0, 0.5]));
    assert!(specular.texture.is_some() && specular.color_texture.is_none());
    let coat = lobes.clearcoat.unwrap();
    assert_eq!((coat.factor, coat.roughness), (0.25, 0.75));
    assert_eq!((coat.normal_scale, coat.normal_texture.unwrap().uv_set), (3.0, 1));
    assert_eq!(material.tangent_uv_set(), Some(1));
    let sheen = lobes.sheen.unwrap();
    assert_eq!((sheen.color, sheen.roughness), ([0.5, 0.25, 1.0], 0.5));
    let anisotropy = lobes.anisotropy.unwrap();
    assert_eq!((anisotropy.strength, anisotropy.rotation), (0.5, 1.5));
    let film = lobes.iridescence.unwrap();
    assert_eq!((film.ior, film.thickness), (1.3, [100.0, 500.0]));
    let leaf = lobes.diffuse_transmission.unwrap();
    assert_eq!((leaf.factor, leaf.color), (0.5, [1.0; 3]));
    let glass = lobes.transmission.unwrap();
    assert_eq!((glass.factor, glass.thickness), (0.5, 2.0));
    let absorbed = glass.absorption.map(|a| (-4.0 * a).exp());
    for (found, expected) in absorbed.iter().zip([1.0, 0.5, 0.25]) {
        assert!((found - expected).abs() < 1e-6, "{absorbed:?}");
    }
    let old = lobes.specular_glossiness.unwrap();
    assert_eq!((old.specular, old.glossiness), ([0.5, 0.0, 0.0], 0.75));
    assert_eq!(material.textures().count(), 2);
}

#[test]
fn broken_lobes_are_left_out_with_a_warning() {
    let mut builder = Builder::new();
    builder.push(
        "materials",
        json!({"doubleSided": true, "extensions": {
            "KHR_materials_ior": {"ior": 0.5},
            "KHR_materials_sheen": {"sheenColorFactor": [1, 1]},
            "KHR_materials_transmission": {"transmissionFactor": "glass"},
            "KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatTexture": {"index": 7}},
        }}),
    );
    let loaded = builder.load().unwrap();
    let material = &loaded.scene.materials[0];
    assert!(material.double_sided);
    assert!(material.lobes.sheen.is_none() && material.lobes.transmission.is_none());
    assert!((material.lobes.specular.unwrap().reflectance - 0.04).abs() < 1e-6);
    assert!(material.lobes.clearcoat.unwrap().texture.is_none());
    for place in ["ior/ior", "sheen", "transmission", "clearcoat/clearcoatTexture/index"] {
        let expected = format!("/materials/0/extensions/KHR_materials_{place}");
        assert!(loaded.warnings.iter().any(|w| w.contains(&expected)), "{place}: {:?}", loaded.warnings);
    }
}

/// A triangle in an environment whose cube has one texel a face: red, green, blue, white of 5, and two black ones.
fn lit_from_all_around(members: serde_json::Value) -> Builder {
    let mut builder = Builder::new();
    builder.triangle(json!({}));
    let faces =
        [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255, 255, 255, 51], [0, 0, 0, 255], [0, 0, 0, 0]]
            .map(|texel| builder.rgba(texel));
    let mut coefficients = [[0.0; 3]; 9];
    // A surface that faces up has more irradiance than one that faces down.
    coefficients[0] = [3.0, 3.0, 3.0];
    coefficients[1] = [1.0, 1.0, 1.0];
    let mut light = json!({
        "irradianceCoefficients": coefficients, "specularImageSize": 1, "specularImages": [faces],
    });
    for (key, value) in members.as_object().unwrap() {
        light[key] = value.clone();
    }
    builder.json["extensions"] = json!({"EXT_lights_image_based": {"lights": [light]}});
    builder.json["extensionsRequired"] = json!(["EXT_lights_image_based"]);
    let chosen = json!({"EXT_lights_image_based": {"light": 0}});
    builder.json["scenes"] = json!([{"nodes": [0]}, {"nodes": [0], "extensions": chosen}]);
    builder
}

/// Pose of a scene of the file.
fn scene(builder: &Builder, scene: usize) -> Pose {
    builder.pose_at(&PoseRequest { scene: Some(scene), ..PoseRequest::default() })
}

#[test]
fn image_based_lights_shine_from_all_around() {
    let builder = lit_from_all_around(json!({}));
    assert_eq!(builder.load().unwrap().warnings, [] as [String; 0]);
    assert!(scene(&builder, 0).environment.is_none());
    let light = scene(&builder, 1).environment.unwrap();
    let near = |found: DVec3, expected: [f64; 3]| {
        let expected = DVec3::from_array(expected);
        assert!(found.abs_diff_eq(expected, 1e-5), "{found}, not {expected}");
    };
    near(light.radiance(DVec3::X), [1.0, 0.0, 0.0]);
    near(light.radiance(DVec3::NEG_X), [0.0, 1.0, 0.0]);
    near(light.radiance(DVec3::Y), [0.0, 0.0, 1.0]);
    near(light.radiance(DVec3::NEG_Y), [5.0; 3]);
    near(light.radiance(DVec3::NEG_Z), [0.0; 3]);
    let pi = std::f64::consts::PI;
    let [up, down] = [0.488_603, -0.488_603].map(|band| (3.0 * 0.282_095 + band) / pi);
    near(light.irradiance_towards(DVec3::Y), [up; 3]);
    near(light.irradiance_towards(DVec3::NEG_Y), [down; 3]);

    // A quarter turn about the vertical axis, counter-clockwise from above, takes +x to -z.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let turned = json!({"rotation": [0.0, half, 0.0, half], "intensity": 2.0});
    let light = scene(&lit_from_all_around(turned), 1).environment.unwrap();
    near(light.radiance(DVec3::NEG_Z), [2.0, 0.0, 0.0]);
    near(light.irradiance_towards(DVec3::Y), [2.0 * up; 3]);
}

#[test]
fn image_based_lights_that_are_broken_are_left_out() {
    let place = "/extensions/EXT_lights_image_based/lights/0";
    for (members, reason) in [
        (json!({"specularImageSize": 2}), "/specularImages/0/0: is no image of 2 x 2 texels"),
        (json!({"specularImageSize": 3}), ": a cube of 3 texels a side does not have 1 levels"),
        (json!({"specularImageSize": 0x8000_0000_u32}), ": a cube of 2147483648 texels a side is larger than 4096"),
        (json!({"specularImages": []}), ": a cube of 1 texels a side does not have 0 levels"),
        (json!({"specularImages": [[0, 0, 0, 0, 0, 9]]}), "/specularImages/0/5: refers to 9"),
        (json!({"rotation": [0, 0, 0, 0]}), ": the rotation has no direction"),
        (json!({"intensity": -1}), ", or the intensity is negative"),
        (json!({"irradianceCoefficients": [[1, 1, 1]]}), "/irradianceCoefficients: invalid length"),
    ] {
        let builder = lit_from_all_around(members);
        let warnings = builder.load().unwrap().warnings;
        let said = |w: &String| w.contains(place) && w.contains(reason);
        assert!(warnings.iter().any(said), "{reason}: {warnings:?}");
        assert!(scene(&builder, 1).environment.is_none());
    }
    let mut builder = lit_from_all_around(json!({}));
    builder.json["scenes"][1]["extensions"]["EXT_lights_image_based"]["light"] = json!(4);
    let warnings = builder.load().unwrap().warnings;
    let reason = "/scenes/1/extensions/EXT_lights_image_based/light: refers to light 4";
    assert!(warnings.iter().any(|w| w.contains(reason)), "{warnings:?}");
}
