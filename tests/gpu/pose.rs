//! Moments that the device computes, compared with poses that the CPU computes.

use std::sync::Arc;

use glam::{DAffine3, DVec3};
use gpc::camera::{Camera, Orbit};
use gpc::render::{Headless, RenderError, Rendered, SceneFrame, SceneRequest, Settings, Shadows, SuperpixelOptions};
use gpc::scene::{Loaded, MeshInstance, Motion, Pose, PoseRequest};
use serde_json::json;

use crate::scene_builder::Builder;
use crate::stage::{ids, on_gpu, once};

const SIZE: [u32; 2] = [96, 80];
/// Number of the tube's segments along its length and around it.
const TUBE: [usize; 2] = [12, 10];
/// Times of the animation in seconds.
const TIMES: [f64; 3] = [0.25, 0.6, 1.0];

/// A tube that two joints bend and a target thickens, a flat pyramid that a target squeezes, one that its parent
/// rotates and stretches, and a static one behind them.
fn film() -> Loaded {
    film_builder().load().unwrap()
}

fn film_builder() -> Builder {
    let mut builder = Builder::new();
    let [length, around] = TUBE;
    let mut tube = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for ring in 0..=length {
        let along = ring as f32 / length as f32;
        for side in 0..around {
            let (sin, cos) = (side as f32 / around as f32 * std::f32::consts::TAU).sin_cos();
            tube.0.push([0.3 * cos, 2.0 * along - 1.0, 0.3 * sin]);
            tube.1.push([cos, 0.0, sin]);
            tube.2.push([1.0 - along, along, 0.0, 0.0]);
            tube.3.push([0.4 * cos * along, 0.0, 0.4 * sin * along]);
        }
    }
    let mut indices = Vec::new();
    for ring in 0..length {
        for side in 0..around {
            let [a, b] = [side, (side + 1) % around].map(|side| (ring * around + side) as u16);
            let [c, d] = [a + around as u16, b + around as u16];
            indices.extend([a, c, b, b, c, d]);
        }
    }
    let joints = [0_u8, 1, 0, 0].repeat(tube.0.len());
    let primitive = json!({
        "attributes": {
            "POSITION": builder.floats(&tube.0), "NORMAL": builder.floats(&tube.1),
            "WEIGHTS_0": builder.floats(&tube.2), "JOINTS_0": builder.accessor("VEC4", 5121, &joints, json!({})),
        },
        "indices": builder.indices(&indices),
        "targets": [{"POSITION": builder.floats(&tube.3), "NORMAL": builder.floats(&tube.3)}],
    });
    let bind = [1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.];
    let inverse = builder.floats(&[bind, bind]);
    let upper = builder.push("nodes", json!({}));
    let lower = builder.push("nodes", json!({"children": [upper]}));
    builder.push("skins", json!({"joints": [lower, upper], "inverseBindMatrices": inverse}));
    let bent = builder.node_with(primitive, json!({"skin": 0}));

    // Without normals, shading is flat.
    let [base, top] = [[[-0.5, 0., -0.4], [0.5, 0., -0.4], [0., 0., 0.6]], [[0., 0.9, 0.]; 3]];
    let sides = [[0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let corner = |v: usize| *base.get(v).unwrap_or(&top[0]);
    let pyramid: Vec<[f32; 3]> = sides.iter().flatten().map(|v| corner(*v)).collect();
    let squeezed: Vec<[f32; 3]> = pyramid.iter().map(|[x, y, z]| [-0.6 * x, 0.3 * y, 0.5 * z * y]).collect();
    let positions = builder.floats(&pyramid);
    let displaced = builder.floats(&squeezed);
    let material = builder.push("materials", json!({"doubleSided": true}));
    let plain = json!({"attributes": {"POSITION": positions}, "material": material});
    let mut morphed = plain.clone();
    morphed["targets"] = json!([{"POSITION": displaced}]);
    let squeezing = builder.node_with(morphed, json!({"translation": [1.2, -0.5, 0.3]}));
    let turned = builder.node_with(plain.clone(), json!({"scale": [-0.8, 1.2, 1.0]}));
    let turning = builder.push("nodes", json!({"children": [turned], "translation": [-1.3, 0.2, 0.4]}));
    builder.node_with(plain, json!({"translation": [0.3, -1.2, -1.0], "scale": [3.0, 1.0, 1.0]}));

    let input = |builder: &mut Builder| builder.floats(&[[0.0], [1.0]]);
    let mut channels = Vec::new();
    let mut samplers = Vec::new();
    let half = std::f32::consts::FRAC_1_SQRT_2;
    for (node, path, output) in [
        (upper, "rotation", builder.floats(&[[0., 0., 0., 1.], [0., 0., half, half]])),
        (lower, "translation", builder.floats(&[[0., 0., 0.], [0.2, -0.3, 0.5]])),
        (bent, "weights", builder.floats(&[[0.0], [0.9]])),
        (squeezing, "weights", builder.floats(&[[0.0], [1.2]])),
        (turning, "rotation", builder.floats(&[[0., 0., 0., 1.], [0., half, 0., half]])),
        (turning, "scale", builder.floats(&[[1., 1., 1.], [1.4, 0.7, 1.]])),
    ] {
        let input = input(&mut builder);
        channels.push(json!({"sampler": samplers.len(), "target": {"node": node, "path": path}}));
        samplers.push(json!({"input": input, "output": output}));
    }
    builder.push("animations", json!({"channels": channels, "samplers": samplers}));
    builder
}

/// Two textured panels under a spot light. Colours, texture coordinates, coats and the light change, but nothing
/// moves.
fn glow() -> Loaded {
    let mut builder = Builder::new();
    let texture = builder.checker([16, 16]);
    let corners = [[-1., -1., 0.], [1., -1., 0.], [1., 1., 0.], [-1., 1., 0.]];
    let positions = builder.floats(&corners);
    let normals = builder.floats(&[[0., 0., 1.]; 4]);
    let uvs = builder.floats(&[[0., 1.], [1., 1.], [1., 0.], [0., 0.]]);
    let indices = builder.indices(&[0, 1, 2, 0, 2, 3]);
    for (x, mode) in [(-1.1, "OPAQUE"), (1.1, "BLEND")] {
        let material = builder.push(
            "materials",
            json!({
                "alphaMode": mode,
                "pbrMetallicRoughness": {
                    "baseColorFactor": [1., 1., 1., 0.7], "metallicFactor": 0.0, "baseColorTexture": {"index": texture},
                },
                "emissiveTexture": {"index": texture},
                "extensions": {"KHR_materials_clearcoat": {}},
            }),
        );
        builder.node_with(
            json!({
                "attributes": {"POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs},
                "indices": indices, "material": material,
            }),
            json!({"translation": [x, 0., 0.]}),
        );
    }
    builder.json["extensions"] =
        json!({"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 20.0, "spot": {}}]}});
    builder.push("nodes", json!({"translation": [0., 0., 2.], "extensions": {"KHR_lights_punctual": {"light": 0}}}));
    let transform = "emissiveTexture/extensions/KHR_texture_transform";
    builder.pointers(&[
        ("/materials/0/pbrMetallicRoughness/baseColorFactor", vec![1., 1., 1., 1., 0.2, 1., 0.1, 1.]),
        ("/materials/1/pbrMetallicRoughness/baseColorFactor", vec![1., 1., 1., 0.7, 1., 0.3, 0., 0.2]),
        ("/materials/0/emissiveFactor", vec![0., 0., 0., 0.5, 0., 0.5]),
        (&format!("/materials/0/{transform}/offset"), vec![0., 0., 0.4, 0.2]),
        (&format!("/materials/0/{transform}/scale"), vec![1., 1., 3., 2.]),
        ("/materials/1/extensions/KHR_materials_clearcoat/clearcoatFactor", vec![0., 1.]),
        ("/materials/1/pbrMetallicRoughness/roughnessFactor", vec![1., 0.1]),
        ("/extensions/KHR_lights_punctual/lights/0/color", vec![1., 1., 1., 0.3, 0.6, 1.]),
        ("/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", vec![0.6, 1.2]),
        ("/nodes/2/translation", vec![0., 0., 2., 1., 0.5, 1.5]),
    ]);
    let loaded = builder.load().unwrap();
    let warnings = &loaded.warnings;
    assert!(!warnings.iter().any(|w| w.contains("/animations")), "{warnings:?}");
    loaded
}

fn at(time: f64) -> PoseRequest {
    PoseRequest { time, ..PoseRequest::default() }
}

struct Shown {
    loaded: Loaded,
    pose: Pose,
    motion: Motion,
    camera: Camera,
    frame: SceneFrame,
}

fn shown(gpu: &mut Headless, settings: &Settings) -> Shown {
    shown_of(gpu, film(), settings)
}

fn shown_of(gpu: &mut Headless, loaded: Loaded, settings: &Settings) -> Shown {
    let (pose, motion) = loaded.scene.pose_in_motion(&at(0.0)).unwrap();
    let prepared = gpu.upload(SceneRequest::new(&loaded.scene, &pose).moving(&motion)).unwrap();
    let frame = gpu.prepare(&prepared, settings).unwrap();
    Shown { camera: camera(&pose), loaded, pose, motion, frame }
}

fn camera(pose: &Pose) -> Camera {
    let (low, high) = pose.geometry.bounds().unwrap();
    let aspect = f64::from(SIZE[0]) / f64::from(SIZE[1]);
    Orbit::default().frame(low, high, aspect).unwrap()
}

impl Shown {
    fn moved(&mut self, gpu: &mut Headless, time: f64) -> Rendered {
        let moment = self.motion.at(&self.loaded.scene, time).unwrap().unwrap();
        self.frame.show(Arc::new(moment)).unwrap();
        gpu.render(&mut self.frame, &self.camera).unwrap()
    }

    fn posed(&self, gpu: &mut Headless, time: f64) -> Rendered {
        let pose = self.loaded.scene.pose(&at(time)).unwrap();
        let prepared = gpu.upload(SceneRequest::new(&self.loaded.scene, &pose)).unwrap();
        let mut frame = gpu.prepare(&prepared, self.frame.settings()).unwrap();
        gpu.render(&mut frame, &self.camera).unwrap()
    }
}

#[test]
fn moments_are_poses() {
    on_gpu(|gpu| {
        let mut shown = shown(gpu, &once(SIZE));
        let still = shown.posed(gpu, 0.0);
        for time in TIMES {
            let found = shown.moved(gpu, time);
            let expected = shown.posed(gpu, time);
            let changed = ids(&still).iter().zip(ids(&found)).filter(|(a, b)| **a != *b).count();
            assert!(changed > 300, "only {changed} pixels show that anything moved");
            let pairs = found.attributes.iter().zip(&expected.attributes);
            let other = pairs.clone().filter(|(a, b)| a.id != b.id).count();
            assert!(other <= 3, "{other} pixels show another triangle at {time}");
            for (a, b) in pairs.filter(|(a, b)| a.id == b.id) {
                assert!((a.depth - b.depth).abs() < 1e-4, "{a:?} {b:?}");
                let apart = [0, 1, 2].map(|axis| (a.normal[axis] - b.normal[axis]).abs());
                assert!(apart.iter().all(|apart| *apart < 2e-4), "{a:?} {b:?}");
            }
        }
    });
}

#[test]
fn a_moment_depends_on_no_other() {
    on_gpu(|gpu| {
        let settings = Settings::new(SIZE[0], SIZE[1]).method(SuperpixelOptions::new(16));
        let mut shown = shown(gpu, &settings);
        let first = shown.moved(gpu, TIMES[1]).colors;
        assert_ne!(first, shown.moved(gpu, TIMES[2]).colors);
        assert_eq!(first, shown.moved(gpu, TIMES[1]).colors);
        let expected = shown.posed(gpu, TIMES[1]).colors;
        let pairs = first.as_flattened().iter().zip(expected.as_flattened());
        let squares: f64 = pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum();
        let apart = (squares / (4 * first.len()) as f64).sqrt();
        assert!(apart < 1e-3, "{apart}");
    });
}

/// Materials and lights that were changed on the device give the same bytes as uploading them anew.
#[test]
fn looks_are_those_of_poses() {
    on_gpu(|gpu| {
        let settings = Settings::new(SIZE[0], SIZE[1]).method(SuperpixelOptions::new(16));
        let mut shown = shown_of(gpu, glow(), &settings);
        let still = gpu.render(&mut shown.frame, &shown.camera).unwrap().colors;
        for time in [1.0, 0.3, 0.0] {
            let found = shown.moved(gpu, time).colors;
            assert_eq!(found == still, time == 0.0, "at {time}");
            assert_eq!(found, shown.posed(gpu, time).colors, "at {time}");
        }
    });
}

/// A pane of green glass: half of its side, its thickness, and the node's scale.
fn pane(half: f32, thickness: f32, scale: f32) -> Builder {
    let mut builder = Builder::new();
    let corners = [[-half, -half, 0.], [half, -half, 0.], [half, half, 0.], [-half, half, 0.]];
    let positions = builder.floats(&corners);
    let indices = builder.indices(&[0, 1, 2, 0, 2, 3]);
    let material = json!({"doubleSided": true, "pbrMetallicRoughness": {"metallicFactor": 0.0}, "extensions": {
        "KHR_materials_transmission": {"transmissionFactor": 1.0},
        "KHR_materials_volume": {
            "thicknessFactor": thickness, "attenuationDistance": 1.0, "attenuationColor": [0.1, 0.8, 0.3],
        },
    }});
    let material = builder.push("materials", material);
    let primitive = json!({"attributes": {"POSITION": positions}, "indices": indices, "material": material});
    builder.node_with(primitive, json!({"scale": [scale, scale, scale]}));
    builder
}

/// The thickness of glass scales with its mesh: posed on the CPU, moved on the device, or drawn as an instance.
#[test]
fn thickness_grows_with_the_mesh() {
    on_gpu(|gpu| {
        let settings = Settings::new(SIZE[0], SIZE[1]).background(Some([1.0; 3]));
        let mut small = pane(1.0, 0.4, 1.0);
        small.pointers(&[("/nodes/0/scale", vec![1., 1., 1., 2.5, 2.5, 2.5])]);
        let mut small = shown_of(gpu, small.load().unwrap(), &settings);
        let camera = small.camera;
        let mut drawn = |builder: &Builder, place: Option<DAffine3>| {
            let scene = builder.load().unwrap().scene;
            let mut pose = scene.pose(&at(0.0)).unwrap();
            pose.geometry.instances.extend(place.map(|transform| MeshInstance {
                first_triangle: 0,
                triangle_count: 2,
                first_index: 0,
                transform,
            }));
            let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
            let mut frame = gpu.prepare(&prepared, &settings).unwrap();
            gpu.render(&mut frame, &camera).unwrap().colors
        };
        let expected = drawn(&pane(2.5, 1.0, 1.0), None);
        let thinner = drawn(&pane(2.5, 0.4, 1.0), None);
        let place = DAffine3::from_scale(DVec3::splat(2.5));
        let placed = drawn(&pane(1.0, 0.4, 1.0), Some(place));
        let scaled = drawn(&pane(1.0, 0.4, 2.5), None);
        let middle = |colors: &[[f32; 4]]| colors[colors.len() / 2 + SIZE[0] as usize / 2];
        let apart = |a: &[[f32; 4]], b: &[[f32; 4]]| {
            let pairs = middle(a).into_iter().zip(middle(b));
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
        };
        assert!(apart(&thinner, &expected) > 0.05);
        assert!(apart(&scaled, &expected) < 1e-3);
        assert!(apart(&placed, &expected) < 1e-3);
        let moved = small.moved(gpu, 1.0).colors;
        assert!(apart(&moved, &expected) < 1e-3);
    });
}

#[test]
fn what_does_not_belong_together_is_refused() {
    on_gpu(|gpu| {
        let mut first = shown(gpu, &once(SIZE));
        let second = shown(gpu, &once(SIZE));
        let moment = second.motion.at(&second.loaded.scene, 0.5).unwrap().unwrap();
        let refused = first.frame.show(Arc::new(moment));
        assert!(matches!(refused, Err(RenderError::OtherMotion)), "{refused:?}");
        let other = crate::blend::panes().build();
        for shadows in [Shadows::None, Shadows::Exact] {
            let request = SceneRequest::new(&other.0, &other.1).moving(&first.motion);
            let refused = gpu.upload(request.shadowed(shadows));
            assert!(matches!(refused, Err(RenderError::OtherMotion)));
            // As many vertices, in other places.
            let mut moved = first.pose.clone();
            moved.geometry.positions[0][0] += 1.0;
            let request = SceneRequest::new(&first.loaded.scene, &moved).moving(&first.motion);
            let refused = gpu.upload(request.shadowed(shadows));
            assert!(matches!(refused, Err(RenderError::OtherMotion)));
        }
    });
}

/// The film under a lamp, which is animated too, and sunlight through a pane that the animation makes opaque, in front
/// of a wall.
fn lit_film() -> Builder {
    let mut builder = film_builder();
    let corners = [[-3., -3., -2.], [3., -3., -2.], [3., 3., -2.], [-3., 3., -2.]];
    let wall = builder.floats(&corners);
    let pane = builder.floats(&corners.map(|[x, y, _]| [0.2 * x, 0.2 * y, 1.5]));
    let indices = builder.indices(&[0, 1, 2, 0, 2, 3]);
    builder.node_with(json!({"attributes": {"POSITION": wall}, "indices": indices}), json!({}));
    let glass = builder.push(
        "materials",
        json!({"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1., 1., 1., 0.2]}}),
    );
    let primitive = json!({"attributes": {"POSITION": pane}, "indices": indices, "material": glass});
    builder.node_with(primitive, json!({"translation": [0.8, 0.9, 0.]}));
    builder.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "spot", "intensity": 60.0, "spot": {"outerConeAngle": 1.0}},
        {"type": "directional", "intensity": 2.0},
    ]}});
    let light = |light: u32| json!({"KHR_lights_punctual": {"light": light}});
    let lamp = builder.push("nodes", json!({"translation": [0.5, 0.5, 4.], "extensions": light(0)}));
    builder.push("nodes", json!({"rotation": [-0.2, 0.2, 0., 0.96], "extensions": light(1)}));
    builder.pointers(&[
        (&format!("/nodes/{lamp}/translation"), vec![0.5, 0.5, 4., -1.5, 1., 3.]),
        (&format!("/materials/{glass}/pbrMetallicRoughness/baseColorFactor"), vec![1., 1., 1., 0.2, 1., 1., 1., 1.]),
    ]);
    join_animations(&mut builder);
    builder
}

/// Joins all animations into one.
fn join_animations(builder: &mut Builder) {
    let animations = builder.json["animations"].take();
    let (mut channels, mut samplers) = (Vec::new(), Vec::new());
    for animation in animations.as_array().unwrap() {
        for channel in animation["channels"].as_array().unwrap() {
            let mut channel = channel.clone();
            channel["sampler"] = json!(channel["sampler"].as_u64().unwrap() as usize + samplers.len());
            channels.push(channel);
        }
        samplers.extend(animation["samplers"].as_array().unwrap().iter().cloned());
    }
    builder.json["animations"] = json!([{"channels": channels, "samplers": samplers}]);
}

/// Casters, lights and opacities are those of the moment.
#[test]
fn shadows_follow_the_moment() {
    on_gpu(|gpu| {
        let scene = lit_film().load().unwrap().scene;
        let settings = Settings::new(SIZE[0], SIZE[1]).shadows(Shadows::Exact).method(SuperpixelOptions::new(16));
        let (pose, motion) = scene.pose_in_motion(&at(0.0)).unwrap();
        let camera = camera(&pose);
        let request = SceneRequest::new(&scene, &pose).moving(&motion).shadowed(Shadows::Exact);
        let prepared = gpu.upload(request).unwrap();
        let mut frame = gpu.prepare(&prepared, &settings).unwrap();
        for time in TIMES {
            frame.show(Arc::new(motion.at(&scene, time).unwrap().unwrap())).unwrap();
            let found = gpu.render(&mut frame, &camera).unwrap().colors;
            let posed = |shadows, gpu: &mut Headless| {
                let pose = scene.pose(&at(time)).unwrap();
                let request = SceneRequest::new(&scene, &pose).shadowed(Shadows::Exact);
                let prepared = gpu.upload(request).unwrap();
                let mut frame = gpu.prepare(&prepared, &settings.clone().shadows(shadows)).unwrap();
                gpu.render(&mut frame, &camera).unwrap().colors
            };
            let apart = |a: &[[f32; 4]], b: &[[f32; 4]]| {
                let pairs = a.as_flattened().iter().zip(b.as_flattened());
                let squares: f64 = pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum();
                (squares / (4 * a.len()) as f64).sqrt()
            };
            let expected = posed(Shadows::Exact, gpu);
            let (error, shade) = (apart(&found, &expected), apart(&posed(Shadows::None, gpu), &expected));
            println!("{time}: {error} {shade}");
            assert!(shade > 0.015, "{shade}: hardly a shadow at {time}");
            assert!(error < 1e-4, "{error} at {time}");
        }
    });
}
