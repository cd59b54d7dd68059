//! Every shared scene loads and poses, or is refused for a known reason.

use std::path::Path;

use crate::shared::{gltf_files, shared};
use gpc::scene::{Pose, PoseRequest, PosedGeometry, Scene, SceneError, StrokePart};
use serde_json::Value;

/// Checks the properties that every geometry must have.
fn check(geometry: &PosedGeometry, what: &str) {
    let vertices = geometry.positions.len();
    let streams = &geometry.streams;
    assert_eq!(streams.normals.len(), vertices, "{what}");
    for length in [streams.tangents.len(), streams.uvs.len(), streams.colors.len()] {
        assert!(length == 0 || length == vertices, "{what}");
    }
    assert!(geometry.positions.as_flattened().iter().all(|x| x.is_finite()), "{what}");
    let unit = |v: &[f32]| (v.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 1e-4;
    assert!(streams.normals.iter().all(|n| unit(n)), "{what}: normals");
    assert!(streams.tangents.iter().all(|t| unit(&t[..3]) && t[3].abs() == 1.0), "{what}: tangents");
    assert!(streams.uvs.as_flattened().iter().all(|x| x.is_finite()), "{what}: uvs");
    assert!(streams.colors.as_flattened().iter().all(|x| x.is_finite()), "{what}: colours");
    assert!(geometry.triangles.as_flattened().iter().all(|&v| (v as usize) < vertices), "{what}");
    let mut next = 0;
    for draw in &geometry.draws {
        assert_eq!(draw.first_triangle, next, "{what}");
        assert!(draw.triangle_count > 0, "{what}");
        next += draw.triangle_count;
    }
    assert_eq!(next as usize, geometry.triangles.len(), "{what}");
    let key = |i: usize| (geometry.draws[i].class, geometry.draws[i].material);
    for i in 1..geometry.draws.len() {
        assert!(key(i - 1).0 <= key(i).0 && key(i - 1) != key(i), "{what}");
    }
}

fn pose(path: &Path) -> Result<(Scene, Pose, Vec<String>), SceneError> {
    let loaded = Scene::load(path)?;
    let pose = loaded.scene.pose(&PoseRequest::default())?;
    check(&pose.geometry, &path.display().to_string());
    for material in &loaded.scene.materials {
        for (_, used) in material.textures() {
            let texture = loaded.scene.textures[used.texture as usize];
            let image = &loaded.scene.images[texture.image as usize];
            assert_eq!(image.pixels.len(), 4 * image.width as usize * image.height as usize);
        }
    }
    Ok((loaded.scene, pose, loaded.warnings))
}

/// Numbers of triangles that the index lacks, because it does not expand instances: 2,999 further tufts of 384
/// triangles.
const INSTANCED: [(&str, u64); 1] = [("GrassFieldInstanced", 2_999 * 384)];

#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn indexed_scenes_have_their_triangles_or_are_refused_by_name() {
    let folder = shared("scenes");
    let index = std::fs::read(folder.join("index.json")).unwrap();
    let index: Value = serde_json::from_slice(&index).unwrap();
    let supported = [
        "KHR_materials_unlit",
        "KHR_mesh_quantization",
        "EXT_meshopt_compression",
        "EXT_texture_webp",
        "KHR_draco_mesh_compression",
        "KHR_texture_basisu",
    ];
    let mut checked = 0;
    for entry in index.as_array().unwrap() {
        let name = entry["name"].as_str().unwrap();
        let path = folder.join(name).join(entry["main"].as_str().unwrap());
        let required = entry["stats"]["req"].as_array().unwrap();
        let unsupported = required.iter().find(|r| !supported.contains(&r.as_str().unwrap()));
        match (pose(&path), unsupported) {
            (Ok((scene, pose, warnings)), None) => {
                let info = scene.info();
                // Points and lines consist of triangles too.
                let of_strokes =
                    (StrokePart::DISC_CORNERS as u64 - 2) * info.points + 2 * info.lines + joints(&pose.geometry);
                let triangles = pose.geometry.triangle_count() - of_strokes;
                let further = INSTANCED.iter().find(|(instanced, _)| *instanced == name);
                let expected = entry["stats"]["tri"].as_u64().unwrap() + further.map_or(0, |f| f.1);
                assert_eq!(triangles, expected, "{name}");
                assert_eq!(info.triangles, triangles, "{name}");
                assert_eq!(info.cameras.len(), pose.cameras.len(), "{name}");
                assert!(pose.warnings.is_empty(), "{name}: {:?}", pose.warnings);
                for warning in warnings {
                    eprintln!("{warning}");
                }
                check_bounds(entry, &pose, name);
            }
            (Err(SceneError::Extension { name: found, .. }), Some(expected)) => {
                assert_eq!(Some(found.as_str()), expected.as_str(), "{name}");
            }
            (result, unsupported) => {
                panic!("{name}: {:?}, required {unsupported:?}", result.map(|_| "posed"));
            }
        }
        checked += 1;
    }
    assert!(checked >= 60, "only {checked} scenes");
}

/// Number of joints of lines, each of which is filled by a triangle.
fn joints(geometry: &PosedGeometry) -> u64 {
    let centres = geometry.strokes.iter().filter(|s| s.part == StrokePart::JointCentre);
    centres.count() as u64
}

/// Checks bounds against the index, which computes them from the accessors, in the rest pose without morphing or
/// skinning.
fn check_bounds(entry: &Value, pose: &Pose, name: &str) {
    let stats = &entry["stats"];
    let plain = stats["skins"] == 0 && stats["morph"] == false && stats["anim"] == 0;
    // The index's bounds ignore sparse replacements, are zero for compressed accessors, and smaller than the points
    // and lines themselves.
    let plain = plain && !["SimpleSparseAccessor", "BoxDracoOptional", "MeshPrimitiveModes"].contains(&name);
    if !plain || entry["bounds"].is_null() || INSTANCED.iter().any(|(n, _)| *n == name) {
        return;
    }
    let (low, high) = pose.geometry.bounds().unwrap();
    let size = (high - low).max_element();
    for (corner, key) in [(low, 0), (high, 1)] {
        for axis in 0..3 {
            let expected = entry["bounds"][key][axis].as_f64().unwrap();
            let off = (corner[axis] - expected).abs();
            assert!(off < 2e-3 * size.max(1.0), "{name}: {low} {high}");
        }
    }
}

/// Generated tangents agree with those of files almost everywhere: in the sign of the bitangent, and approximately in
/// direction.
#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn generated_tangents_agree_with_those_of_files() {
    let folder = shared("scenes");
    let folder = folder.join("FlightHelmet");
    let text = std::fs::read_to_string(folder.join("FlightHelmet.gltf")).unwrap();
    let tangents = |text: &str| {
        let scene = Scene::from_slice(text.as_bytes(), "helmet", Some(&folder)).unwrap().scene;
        let geometry = scene.pose(&PoseRequest::default()).unwrap().geometry;
        let corners = geometry.triangles.as_flattened().iter();
        let tangents: Vec<[f32; 4]> = corners.map(|&v| geometry.streams.tangents[v as usize]).collect();
        tangents
    };
    let given = tangents(&text);
    let without = text.replace("\"TANGENT\"", "\"_TANGENT\"");
    assert_ne!(without, text);
    let generated = tangents(&without);
    assert_eq!(given.len(), generated.len());
    let agree = |(a, b): &(&[f32; 4], &[f32; 4])| {
        let cosine: f32 = (0..3).map(|i| a[i] * b[i]).sum();
        a[3] == b[3] && cosine > 0.95
    };
    let agreeing = given.iter().zip(&generated).filter(agree).count();
    let share = agreeing as f64 / given.len() as f64;
    eprintln!("{share} of the corners agree");
    assert!(share > 0.97, "only {share} of the corners agree");
}

#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn generated_suite_poses_but_for_two_incompatible_files() {
    let folder = shared("scenes/AssetGenerator");
    let files = gltf_files(&folder);
    assert!(files.len() >= 100, "only {} files", files.len());
    for path in files {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        match (name.as_str(), pose(&path)) {
            ("Compatibility_04", Err(SceneError::Version { found, .. })) => {
                assert!(found.starts_with("2.1"), "{found}");
            }
            ("Compatibility_05", Err(SceneError::Extension { .. })) => {}
            ("Compatibility_04" | "Compatibility_05", _) => panic!("{name} is not refused"),
            (_, Ok((scene, _, _))) => {
                for (i, animation) in scene.info().animations.iter().enumerate() {
                    for step in 0..=4 {
                        let request = PoseRequest {
                            animation: Some(i.to_string()),
                            time: animation.duration * f64::from(step) / 4.0,
                            ..PoseRequest::default()
                        };
                        check(&scene.pose(&request).unwrap().geometry, &name);
                    }
                }
            }
            (_, Err(error)) => panic!("{error}"),
        }
    }
}
