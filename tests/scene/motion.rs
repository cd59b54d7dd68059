//! Animation, morph targets, skins and instances.

use crate::scene_builder::{Builder, TRIANGLE, assert_near, corners};
use gpc::scene::{LightKind, Pose, PoseRequest, SceneError, SceneProjection};
use serde_json::{Value, json};

/// Pose of the triangle at time `time` of the animation `name`, or of the first one.
fn at(builder: &Builder, name: Option<&str>, time: f64) -> Pose {
    builder.pose_at(&PoseRequest { animation: name.map(str::to_owned), time, ..PoseRequest::default() })
}

/// A triangle of one node with one animated property.
fn animated<const N: usize>(
    node: Value,
    path: &str,
    interpolation: &str,
    times: &[f32],
    values: &[[f32; N]],
) -> Builder {
    let mut builder = Builder::new();
    builder.triangle(node);
    let times: Vec<[f32; 1]> = times.iter().map(|&t| [t]).collect();
    let (input, output) = (builder.floats(&times), builder.floats(values));
    builder.push(
        "animations",
        json!({
            "name": "move",
            "channels": [{"sampler": 0, "target": {"node": 0, "path": path}}],
            "samplers": [{"input": input, "output": output, "interpolation": interpolation}],
        }),
    );
    builder
}

fn x_of_first_corner(builder: &Builder, time: f64) -> f64 {
    corners(&at(builder, Some("move"), time).geometry, 0)[0][0]
}

/// A pointer to a node's transform moves the node; other pointers are left out with a warning.
#[test]
fn pointers_move_nodes() {
    let values = [[1., 0., 0.], [3., 0., 0.]];
    let mut builder = animated(json!({}), "pointer", "LINEAR", &[0., 2.], &values);
    builder.json["extensionsRequired"] = json!(["KHR_animation_pointer"]);
    let target =
        |pointer: &str| json!({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": pointer}}});
    let channel = |builder: &mut Builder, pointer| {
        builder.json["animations"][0]["channels"][0]["target"] = target(pointer);
    };
    channel(&mut builder, "/nodes/0/translation");
    let warnings = builder.load().unwrap().warnings;
    let animation = |w: &String| w.contains("/animations");
    assert!(!warnings.iter().any(animation), "{warnings:?}");
    assert!((x_of_first_corner(&builder, 1.5) - 2.5).abs() < 1e-6);
    for (pointer, reason) in [
        ("/images/0/uri", "/images/0/uri keeps its value"),
        ("/nodes/0/camera", "/nodes/0/camera keeps its value"),
        ("/materials/0/emissiveFactor", "which the document does not have"),
        ("/nodes/7/translation", "which the document does not have"),
    ] {
        channel(&mut builder, pointer);
        let warnings = builder.load().unwrap().warnings;
        let place = "/animations/0/channels/0/target/extensions/KHR_animation_pointer/pointer: ";
        let said = |w: &String| w.contains(place) && w.contains(reason);
        assert!(warnings.iter().any(said), "{pointer}: {warnings:?}");
        assert!(x_of_first_corner(&builder, 1.5).abs() < 1e-6);
    }
}

/// A triangle with a textured material, a spot light and a camera, and a channel from time 0 to 1 for each pointer.
fn pointed(pointers: &[(&str, Vec<f32>)]) -> Builder {
    let mut builder = Builder::new();
    let texture = builder.texture([255, 0, 0]);
    let positions = builder.floats(&TRIANGLE);
    builder.push(
        "materials",
        json!({
            "pbrMetallicRoughness": {"baseColorTexture": {
                "index": texture,
                "extensions": {"KHR_texture_transform": {"offset": [0.5, 0.0]}},
            }},
            "extensions": {
                "KHR_materials_clearcoat": {"clearcoatTexture": {"index": texture}},
                "KHR_materials_emissive_strength": {"emissiveStrength": 2.0},
            },
        }),
    );
    builder.node_with(
        json!({"attributes": {"POSITION": positions}, "material": 0}),
        json!({"camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}),
    );
    builder.json["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.1}}]);
    builder.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "spot", "intensity": 3.0, "color": [1.0, 0.5, 0.0], "spot": {}},
    ]}});
    builder.pointers(pointers);
    builder
}

fn quarter(builder: &Builder) -> Pose {
    let warnings = builder.load().unwrap().warnings;
    assert!(!warnings.iter().any(|w| w.contains("/animations")), "{warnings:?}");
    at(builder, None, 0.25)
}

#[test]
fn pointers_change_materials() {
    let pose = quarter(&pointed(&[
        ("/materials/0/pbrMetallicRoughness/metallicFactor", vec![0.0, 1.0]),
        ("/materials/0/extensions/KHR_materials_clearcoat/clearcoatFactor", vec![0.0, 0.8]),
        (
            "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/rotation",
            vec![0.0, 4.0 * std::f32::consts::FRAC_PI_2],
        ),
    ]));
    let [(0, material)] = &pose.materials[..] else {
        panic!("{:?}", pose.materials);
    };
    assert_eq!(material.metallic, 0.25);
    let coat = material.lobes.clearcoat.unwrap();
    assert!((coat.factor - 0.2).abs() < 1e-6 && coat.texture.is_some());
    let [u, v] = material.base_color_texture.unwrap().transform.0;
    let expected = [[0.0, 1.0, 0.5], [-1.0, 0.0, 0.0]];
    let pairs = [u, v].into_iter().flatten().zip(expected.into_iter().flatten());
    assert!(pairs.clone().all(|(a, b)| (a - b).abs() < 1e-6), "{u:?} {v:?}");

    let pose = quarter(&pointed(&[
        ("/materials/0/emissiveFactor", vec![0., 0.4, 4., 0., 0., 0.]),
        ("/extensions/KHR_lights_punctual/lights/0/color", vec![1., 0.5, 0., 0., 0.5, 1.]),
    ]));
    // Factors are clamped to 1 before strengths multiply them.
    let emissive = pose.materials[0].1.emissive;
    assert!((emissive[1] - 0.6).abs() < 1e-6 && emissive[2] == 2.0, "{emissive:?}");
    assert_eq!(pose.lights[0].color, [2.25, 1.5, 0.75]);
}

#[test]
fn pointers_change_lights_and_cameras() {
    let pose = quarter(&pointed(&[
        ("/extensions/KHR_lights_punctual/lights/0/intensity", vec![3.0, 7.0]),
        ("/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", vec![0.5, 0.9]),
        ("/cameras/0/perspective/yfov", vec![1.0, 2.0]),
    ]));
    assert_eq!(pose.lights[0].color, [4.0, 2.0, 0.0]);
    let LightKind::Spot { outer_angle, .. } = pose.lights[0].kind else {
        panic!("{:?}", pose.lights);
    };
    assert!((outer_angle - 0.6).abs() < 1e-6);
    let SceneProjection::Perspective { yfov, .. } = pose.cameras[0].projection else {
        panic!("{:?}", pose.cameras);
    };
    assert_eq!(yfov, 1.25);
}

#[test]
fn pointers_hide_nodes_and_weigh_meshes() {
    let mut builder = Builder::new();
    builder.triangle(json!({"children": [1]}));
    builder.triangle(json!({}));
    let displaced = builder.floats(&[[0., 0., 2.]; 3]);
    builder.json["meshes"][1]["primitives"][0]["targets"] = json!([{"POSITION": displaced}]);
    builder.pointers(&[("/meshes/1/weights", vec![0.0, 1.0])]);
    assert!((corners(&quarter(&builder).geometry, 1)[0][2] - 0.5).abs() < 1e-6);
    builder.json["animations"] = json!([]);
    builder.pointers(&[("/nodes/1/weights/0", vec![0.0, 2.0])]);
    assert!((corners(&quarter(&builder).geometry, 1)[0][2] - 1.0).abs() < 1e-6);
    builder.json["animations"] = json!([]);
    builder.pointers(&[("/meshes/1/weights/1", vec![0.0, 1.0])]);
    let fault = "there is no weight 1: the mesh has 1 morph targets";
    let warnings = builder.load().unwrap().warnings;
    assert!(warnings.iter().any(|w| w.contains(fault)), "{warnings:?}");
    builder.json["animations"] = json!([]);
    builder.pointers(&[("/meshes/1/weights", vec![0.0, 1.0])]);
    builder.pointers(&[("/nodes/0/extensions/KHR_node_visibility/visible", vec![1.0, 0.0])]);
    let fault = "there is nothing between visible and not";
    let warnings = builder.load().unwrap().warnings;
    assert!(warnings.iter().any(|w| w.contains(fault)), "{warnings:?}");
    builder.json["animations"][1]["samplers"][0]["interpolation"] = json!("STEP");
    let drawn = |time| at(&builder, Some("1"), time).geometry.triangles.len();
    assert_eq!([drawn(0.5), drawn(1.0)], [2, 0]);
}

/// Values that a description can't have are left out, and channels without an effect cause a warning.
#[test]
fn pointers_to_what_cannot_change_are_named() {
    for (pointer, reason) in [
        ("/materials/0/doubleSided", "/materials/0/doubleSided: invalid type"),
        ("/materials/0/alphaMode", "invalid type"),
        ("/materials/0/extensions/KHR_materials_sheen/sheenRoughnessFactor", "has no extensions/KHR_materials_sheen"),
        ("/materials/0/emissiveFactor", "emissiveFactor: invalid type"),
        ("/materials/0/extensions/KHR_materials_dispersion", "by itself changes nothing that is drawn"),
        ("/cameras/7/perspective/yfov", "which the document does not have"),
    ] {
        let builder = pointed(&[(pointer, vec![0.25, 0.75])]);
        let warnings = builder.load().unwrap().warnings;
        assert!(warnings.iter().any(|w| w.contains(reason)), "{pointer}: {warnings:?}");
        assert!(at(&builder, None, 0.5).warnings.is_empty());
    }
}

/// Descriptions are read again for each channel and moment, so that none may take long.
#[test]
fn many_pointers_into_long_descriptions_take_no_time() {
    let pointer = "/materials/0/emissiveFactor";
    let mut builder = pointed(&vec![(pointer, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]); 3000]);
    builder.json["materials"][0]["extras"] = json!(vec![0.5; 1000]);
    assert!(!at(&builder, None, 0.5).materials.is_empty());
    builder.json["materials"][0]["extras"] = json!(vec![0.5; 100_000]);
    let warnings = builder.load().unwrap().warnings;
    let fault = "/materials/0: has a description that is too long";
    assert!(warnings.iter().any(|w| w.contains(fault)), "{warnings:?}");
}

#[test]
fn linear_step_and_clamping() {
    let values = [[1., 0., 0.], [3., 0., 0.], [5., 0., 0.]];
    for (mode, samples) in [
        ("LINEAR", [(0.0, 1.0), (1.0, 1.0), (1.5, 2.0), (2.0, 3.0), (3.0, 4.0), (9.0, 5.0)]),
        ("STEP", [(0.0, 1.0), (1.0, 1.0), (1.9, 1.0), (2.0, 3.0), (3.9, 3.0), (4.0, 5.0)]),
    ] {
        let builder = animated(json!({}), "translation", mode, &[1., 2., 4.], &values);
        for (time, expected) in samples {
            let found = x_of_first_corner(&builder, time);
            assert!((found - expected).abs() < 1e-6, "{mode} at {time}: {found}");
        }
    }
}

#[test]
fn cubic_spline_scales_tangents_by_the_interval() {
    // Each keyframe has an in-tangent, a value and an out-tangent. The value goes from 0 to 4 within 2 s, starting at
    // 3 per second and ending at rest.
    let values = [[9., 0., 0.], [0., 0., 0.], [3., 0., 0.], [0., 0., 0.], [4., 0., 0.], [9., 0., 0.]];
    let builder = animated(json!({}), "translation", "CUBICSPLINE", &[1., 3.], &values);
    // In the middle it is 4 * 1/2 + 2 s * 3/s * (1/8 - 1/2 + 1/2) = 2.75.
    for (time, expected) in [(0.0, 0.0), (2.0, 2.75), (3.0, 4.0), (7.0, 4.0)] {
        let found = x_of_first_corner(&builder, time);
        assert!((found - expected).abs() < 1e-6, "at {time}: {found}");
    }
}

#[test]
fn rotations_take_the_short_way_at_constant_speed() {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    // The rotation is a quarter turn around z; the second quaternion has the opposite sign.
    let values = [[0., 0., 0., 1.], [0., 0., -half, -half]];
    let builder = animated(json!({}), "rotation", "LINEAR", &[0., 3.], &values);
    let geometry = at(&builder, None, 1.0).geometry;
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    assert_near(corners(&geometry, 0), [[0.; 3], [cos, sin, 0.], [-sin, cos, 0.]]);
}

#[test]
fn rotations_may_be_normalised_integers() {
    let mut builder = animated(json!({}), "rotation", "LINEAR", &[0., 1.], &[[0.; 4]; 2]);
    let output = builder.accessor("VEC4", 5120, &[0, 0, 0, 127, 0, 0, 127, 0], json!({"normalized": true}));
    builder.json["animations"][0]["samplers"][0]["output"] = output.into();
    let geometry = at(&builder, None, 1.0).geometry;
    assert_near(corners(&geometry, 0), [[0.; 3], [-1., 0., 0.], [0., -1., 0.]]);
}

#[test]
fn animations_are_chosen_by_name_or_index() {
    let values = [[1., 0., 0.], [3., 0., 0.]];
    let builder = animated(json!({}), "translation", "LINEAR", &[0., 1.], &values);
    let x = |name, time| corners(&at(&builder, name, time).geometry, 0)[0][0];
    assert_eq!(x(None, 0.0), 0.0);
    assert_eq!(x(None, 0.5), 2.0);
    assert_eq!(x(Some("move"), 0.0), 1.0);
    assert_eq!(x(Some("0"), 1.0), 3.0);
    let request = PoseRequest { animation: Some("stand".into()), ..PoseRequest::default() };
    let error = builder.load().unwrap().scene.pose(&request).unwrap_err();
    assert!(matches!(error, SceneError::NoSuchAnimation { .. }));
    assert!(error.to_string().ends_with("the file has 0 \"move\""), "{error}");
}

#[test]
fn broken_channels_leave_the_rest_in_motion() {
    let values = [[1., 0., 0.], [3., 0., 0.]];
    let mut builder = animated(json!({}), "translation", "LINEAR", &[0., 1.], &values);
    let channels = builder.json["animations"][0]["channels"].as_array_mut().unwrap();
    channels.push(json!({"sampler": 7, "target": {"node": 0, "path": "scale"}}));
    channels.push(json!({"sampler": 0, "target": {"node": 0, "path": "rotation"}}));
    channels.push(json!({"sampler": 0, "target": {"path": "scale"}}));
    let warnings = builder.load().unwrap().warnings;
    assert_eq!(warnings.len(), 4, "{warnings:?}");
    assert!(warnings[3].ends_with("left out: channels of animations without a target (1: scale)"), "{warnings:?}");
    assert!(warnings[1].contains("/animations/0/channels/1/sampler"), "{warnings:?}");
    assert_eq!(x_of_first_corner(&builder, 1.0), 3.0);
}

#[test]
fn keyframes_that_repeat_a_time_are_left_out() {
    let times = [0., 1., 1., 1., 2.];
    let values = [1., 3., 90., 91., 5.].map(|x| [x, 0., 0.]);
    let mut builder = animated(json!({}), "translation", "LINEAR", &times, &values);
    // Another channel with the same times: in-tangents, values and out-tangents.
    let cubic = [0., 1., 0., 0., 2., 0., 9., 9., 9., 9., 9., 9., 0., 4., 0.].map(|x| [x; 3]);
    let output = builder.floats(&cubic);
    let animation = &mut builder.json["animations"][0];
    let channels = animation["channels"].as_array_mut().unwrap();
    channels.push(json!({"sampler": 1, "target": {"node": 0, "path": "scale"}}));
    let samplers = animation["samplers"].as_array_mut().unwrap();
    samplers.push(json!({"input": 1, "output": output, "interpolation": "CUBICSPLINE"}));
    let warnings = builder.load().unwrap().warnings;
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    let told = "/accessors/1: 2 of 5 keyframes repeat the time of the one before and are left out";
    assert!(warnings.iter().any(|text| text.contains(told)), "{warnings:?}");
    let corners_at = |time| corners(&at(&builder, Some("move"), time).geometry, 0);
    for (time, place, scale) in [(0.5, 2., 1.5), (1., 3., 2.), (1.5, 4., 3.), (2., 5., 4.)] {
        let [a, b, _] = corners_at(time);
        assert_near([a, b], [[place, 0., 0.], [place + scale, 0., 0.]]);
    }

    let times = [0., 2., 1.];
    let builder = animated(json!({}), "translation", "LINEAR", &times, &values[..3]);
    let warnings = builder.load().unwrap().warnings;
    assert!(warnings.iter().any(|text| text.contains("do not ascend")), "{warnings:?}");
}

/// A triangle with normals and two targets: one moves it along z, the other rotates the normals.
fn morphed(mesh_weights: Value, node: Value) -> Builder {
    let mut builder = Builder::new();
    let positions = builder.floats(&TRIANGLE);
    let normals = builder.floats(&[[0., 0., 1.]; 3]);
    let lift = builder.floats(&[[0., 0., 2.]; 3]);
    let turn = builder.floats(&[[1., 0., -1.]; 3]);
    builder.node_with(
        json!({
            "attributes": {"POSITION": positions, "NORMAL": normals},
            "targets": [{"POSITION": lift}, {"NORMAL": turn}],
        }),
        node,
    );
    builder.json["meshes"][0]["weights"] = mesh_weights;
    builder
}

#[test]
fn morph_weights_of_mesh_node_and_animation() {
    let state = |pose: Pose| {
        let normal = pose.geometry.streams.normals[0];
        (corners(&pose.geometry, 0)[0][2], normal)
    };
    let mesh = morphed(json!([0.5, 0]), json!({}));
    assert_eq!(state(mesh.pose()), (1.0, [0., 0., 1.]));
    let node = morphed(json!([0.5, 0]), json!({"weights": [0.25, 1]}));
    assert_eq!(state(node.pose()), (0.5, [1., 0., 0.]));

    let mut moving = node;
    let input = moving.floats(&[[0.], [1.]]);
    let output = moving.floats(&[[0.], [0.], [1.], [1.]]);
    moving.push(
        "animations",
        json!({
            "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}],
            "samplers": [{"input": input, "output": output}],
        }),
    );
    assert_eq!(state(at(&moving, None, 1.0)), (2.0, [1., 0., 0.]));
    let (z, [x, _, _]) = state(at(&moving, Some("0"), 0.5));
    assert_eq!(z, 1.0);
    assert!((x - std::f32::consts::FRAC_1_SQRT_2).abs() < 1e-6);
}

#[test]
fn flat_normals_follow_the_morphed_shape() {
    let mut builder = Builder::new();
    let positions = builder.floats(&TRIANGLE);
    let fold = builder.floats(&[[0.; 3], [0.; 3], [0., -1., 1.]]);
    builder.node_with(
        json!({"attributes": {"POSITION": positions}, "targets": [{"POSITION": fold}]}),
        json!({"weights": [1]}),
    );
    assert_eq!(builder.pose().geometry.streams.normals, [[0., -1., 0.]; 3]);
}

/// A triangle whose third vertex follows a joint one unit up, or half of it for `weight` 0.5.
fn skinned(weight: f32, mesh_node: Value) -> Builder {
    let mut builder = Builder::new();
    let positions = builder.floats(&TRIANGLE);
    let normals = builder.floats(&[[0., 0., 1.]; 3]);
    let joints = builder.accessor("VEC4", 5121, &[0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0], json!({}));
    // The weights add up to 2, and are scaled to 1.
    let weights = builder.floats(&[[2., 0., 0., 0.], [2., 0., 0., 0.], [2. - 2. * weight, 2. * weight, 0., 0.]]);
    builder.node_with(
        json!({"attributes": {
            "POSITION": positions, "NORMAL": normals, "JOINTS_0": joints, "WEIGHTS_0": weights,
        }}),
        mesh_node,
    );
    let identity = glam::Mat4::IDENTITY.to_cols_array();
    let down = glam::Mat4::from_translation(-glam::Vec3::Y).to_cols_array();
    let bind = builder.floats(&[identity, down]);
    builder.push("nodes", json!({"children": [2]}));
    builder.push("nodes", json!({"translation": [0, 1, 0]}));
    builder.push("skins", json!({"joints": [1, 2], "inverseBindMatrices": bind}));
    builder.json["nodes"][0]["skin"] = 0.into();
    builder
}

#[test]
fn skins_bend_and_ignore_the_node() {
    let mut builder = skinned(1.0, json!({"translation": [50, 60, 70], "scale": [-1, 1, 1]}));
    assert_near(corners(&builder.pose().geometry, 0), [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]]);
    builder.json["nodes"][2]["translation"] = json!([0, 1, 3]);
    builder.json["nodes"][1]["translation"] = json!([10, 0, 0]);
    assert_near(corners(&builder.pose().geometry, 0), [[10., 0., 0.], [11., 0., 0.], [10., 1., 3.]]);
    assert_eq!(builder.pose().geometry.streams.normals, [[0., 0., 1.]; 3]);
}

#[test]
fn skin_weights_blend_matrices() {
    let mut builder = skinned(0.5, json!({}));
    builder.json["nodes"][2]["translation"] = json!([0, 1, 3]);
    assert_near(corners(&builder.pose().geometry, 0), [[0., 0., 0.], [1., 0., 0.], [0., 1., 1.5]]);
}

#[test]
fn mirrored_skeletons_keep_their_fronts() {
    let mut builder = skinned(1.0, json!({}));
    builder.json["nodes"][1]["scale"] = json!([-1, 1, 1]);
    let geometry = builder.pose().geometry;
    assert_near(corners(&geometry, 0), [[0., 0., 0.], [0., 1., 0.], [-1., 0., 0.]]);
    assert_eq!(geometry.streams.normals, [[0., 0., 1.]; 3]);
}

#[test]
fn joints_that_a_skin_lacks_are_an_error() {
    let mut builder = skinned(1.0, json!({}));
    builder.json["skins"][0] = json!({"joints": [1]});
    let error = builder.load().unwrap_err().to_string();
    assert!(error.contains("/nodes/0/skin: the mesh's vertices refer to joint 1, but the skin has 1"), "{error}");
}

#[test]
fn instances_multiply_a_mesh() {
    let mut builder = Builder::new();
    let node = builder.triangle(json!({"translation": [0, 0, 5], "scale": [2, 2, 2]}));
    let translations = builder.floats(&[[0., 0., 0.], [10., 0., 0.]]);
    let rotations = builder.accessor(
        "VEC4",
        5122,
        &[[0_i16, 0, 0, 32_767], [0, 0, 32_767, 0]]
            .as_flattened()
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect::<Vec<u8>>(),
        json!({"normalized": true}),
    );
    let scales = builder.floats(&[[1., 1., 1.], [1., -1., 1.]]);
    builder.json["nodes"][node]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] =
        json!({"TRANSLATION": translations, "ROTATION": rotations, "SCALE": scales, "_ID": 99});
    let geometry = builder.pose().geometry;
    assert_eq!(builder.load().unwrap().scene.info().triangles, 2);
    assert_near(corners(&geometry, 0), [[0., 0., 5.], [2., 0., 5.], [0., 2., 5.]]);
    // The instance is mirrored and then turned by half; its winding is corrected.
    assert_near(corners(&geometry, 1), [[20., 0., 5.], [20., 2., 5.], [18., 0., 5.]]);
    assert!(geometry.streams.normals.iter().all(|n| *n == [0., 0., 1.]));
}
