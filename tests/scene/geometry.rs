//! Triangles and vertices in all encodings of glTF.

use crate::scene_builder::{Builder, TRIANGLE, assert_near, corners, le};
use glam::DVec3;
use gpc::scene::{DrawClass, MeshInstance, PoseRequest, StrokePart};
use serde_json::{Value, json};

const FIRST: [[f64; 3]; 3] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]];

#[test]
fn strips_and_fans_wind_like_lists() {
    let square = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [1., 1., 0.]];
    let around = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
    for (mode, positions) in [(5, square), (6, around)] {
        let mut builder = Builder::new();
        let positions = builder.floats(&positions);
        builder.node_with(json!({"attributes": {"POSITION": positions}, "mode": mode}), json!({}));
        let geometry = builder.pose().geometry;
        assert_eq!(geometry.triangles.len(), 2);
        assert!(geometry.streams.normals.iter().all(|n| *n == [0., 0., 1.]), "mode {mode}");
    }
}

#[test]
fn every_index_type() {
    for (component, bytes) in
        [(5121, vec![2, 0, 1]), (5123, vec![2, 0, 0, 0, 1, 0]), (5125, vec![2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0])]
    {
        let mut builder = Builder::new();
        let positions = builder.floats(&TRIANGLE);
        let indices = builder.accessor("SCALAR", component, &bytes, json!({}));
        builder.node_with(json!({"attributes": {"POSITION": positions}, "indices": indices}), json!({}));
        let geometry = builder.pose().geometry;
        assert_near(corners(&geometry, 0), [FIRST[2], FIRST[0], FIRST[1]]);
    }
}

/// Numbers of corners of a segment, of a joint and of a disc.
const SEGMENT: usize = 4;
const JOINT: usize = 3;
const DISC: usize = StrokePart::DISC_CORNERS as usize;

#[test]
fn points_and_lines_are_corners_to_place() {
    let drawn = |mode: u32, primitive: Value| {
        let mut builder = Builder::new();
        let positions = builder.floats(&[TRIANGLE[0], TRIANGLE[1], TRIANGLE[2], [5.0, 5.0, 5.0]]);
        let mut item = json!({"attributes": {"POSITION": positions}, "mode": mode});
        if let Value::Array(indices) = primitive {
            let indices: Vec<u16> = indices.iter().map(|i| i.as_u64().unwrap() as u16).collect();
            item["indices"] = json!(builder.indices(&indices));
        }
        builder.node_with(item, json!({}));
        let loaded = builder.load().unwrap();
        let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
        (pose.geometry, loaded.scene.info(), loaded.warnings)
    };
    for (mode, indices, anchors, corners, counts) in [
        (0, json!([0, 1, 2]), 3, 3 * DISC, [3, 0]),
        (0, json!(null), 4, 4 * DISC, [4, 0]),
        // Two separate lines, and two that share a vertex.
        (1, json!([0, 1, 2, 3]), 4, 2 * SEGMENT, [0, 2]),
        (1, json!([0, 1, 1, 2]), 3, 2 * SEGMENT + JOINT, [0, 2]),
        (1, json!([0, 1, 1, 2, 2, 0]), 3, 3 * (SEGMENT + JOINT), [0, 3]),
        (2, json!([0, 1, 2]), 3, 3 * (SEGMENT + JOINT), [0, 3]),
        (3, json!([0, 1, 2]), 3, 2 * SEGMENT + JOINT, [0, 2]),
        // A segment without length has no direction.
        (3, json!([0, 1, 1, 2]), 3, 2 * SEGMENT + JOINT, [0, 2]),
        (2, json!([0, 1, 2, 0]), 3, 3 * (SEGMENT + JOINT), [0, 3]),
    ] {
        let (geometry, info, warnings) = drawn(mode, indices.clone());
        let what = format!("mode {mode}, {indices}");
        assert!(!warnings.iter().any(|w| w.contains("primitives")), "{what}: {warnings:?}");
        assert_eq!(geometry.positions.len(), anchors + corners, "{what}");
        assert_eq!(geometry.strokes.len(), corners, "{what}");
        assert_eq!([info.points, info.lines], counts, "{what}");
        assert_eq!(info.triangles, 0, "{what}");
        geometry.check(2).unwrap();
        for (stroke, vertex) in geometry.strokes.iter().zip(anchors as u32..) {
            assert_eq!(stroke.vertex, vertex, "{what}");
            assert!(stroke.faces_camera);
            let at = geometry.positions[stroke.at as usize];
            assert_eq!(geometry.positions[vertex as usize], at, "{what}");
            assert!((stroke.at.max(stroke.other).max(stroke.beyond) as usize) < anchors);
        }
    }
    // An index beyond the vertices interrupts a line.
    let (geometry, info, warnings) = drawn(3, json!([0, 1, 9, 2, 3, 0]));
    assert_eq!([info.points, info.lines], [0, 3]);
    assert_eq!(geometry.strokes.len(), 3 * SEGMENT + JOINT);
    let said = |warnings: &[String], what: &str| warnings.iter().any(|w| w.contains(what));
    assert!(said(&warnings, "1 of 6 vertices"), "{warnings:?}");
    let (_, info, warnings) = drawn(1, json!([0, 1, 2]));
    assert_eq!(info.lines, 1);
    assert!(said(&warnings, "1 of 3 indices makes no line"), "{warnings:?}");
}

#[test]
fn lines_without_normals_have_unlit_materials() {
    let mut builder = Builder::new();
    let positions = builder.floats(&TRIANGLE);
    let normals = builder.floats(&[[0.0, 1.0, 0.0]; 3]);
    let material = builder.push("materials", json!({"alphaMode": "BLEND"}));
    let plain = json!({"POSITION": positions});
    for (attributes, mode) in
        [(plain.clone(), 1), (plain.clone(), 0), (json!({"POSITION": positions, "NORMAL": normals}), 3), (plain, 4)]
    {
        builder.node_with(json!({"attributes": attributes, "mode": mode, "material": material}), json!({}));
    }
    let loaded = builder.load().unwrap();
    let materials = &loaded.scene.materials;
    assert_eq!(materials.len(), 3);
    assert_eq!(loaded.scene.info().materials.blend, 1);
    let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
    let used: Vec<_> = pose.geometry.draws.iter().map(|draw| draw.material).collect();
    assert_eq!(used, [2, 0]);
    assert!(materials[2].unlit && !materials[0].unlit);
    let facing = pose.geometry.strokes.iter().filter(|s| s.faces_camera);
    assert_eq!(facing.count(), SEGMENT + 3 * DISC);
}

#[test]
fn interleaved_attributes() {
    let mut builder = Builder::new();
    let rows: Vec<[f32; 6]> = TRIANGLE.iter().map(|&[x, y, z]| [x, y, z, 0., 1., 0.]).collect();
    let view = builder.view(&le(&rows), json!({"byteStride": 24}));
    let mut accessor = |offset: usize| {
        builder.push(
            "accessors",
            json!({"bufferView": view, "byteOffset": offset, "type": "VEC3",
                   "componentType": 5126, "count": 3}),
        )
    };
    let (positions, normals) = (accessor(0), accessor(12));
    builder.node_with(json!({"attributes": {"POSITION": positions, "NORMAL": normals}}), json!({}));
    let geometry = builder.pose().geometry;
    assert_near(corners(&geometry, 0), FIRST);
    assert_eq!(geometry.streams.normals, [[0., 1., 0.]; 3]);
}

#[test]
fn sparse_replaces_elements_and_zeros() {
    for dense in [true, false] {
        let mut builder = Builder::new();
        let indices = builder.view(&[1, 2], json!({}));
        let values = builder.view(&le(&[[1., 0., 0.], [0., 1., 0.]]), json!({}));
        let sparse = json!({
            "count": 2,
            "indices": {"bufferView": indices, "componentType": 5121},
            "values": {"bufferView": values},
        });
        let positions = if dense {
            let wrong = [[0., 0., 0.], [9., 9., 9.], [9., 9., 9.]];
            builder.accessor("VEC3", 5126, &le(&wrong), json!({"sparse": sparse}))
        } else {
            builder.push("accessors", json!({"type": "VEC3", "componentType": 5126, "count": 3, "sparse": sparse}))
        };
        builder.node_with(json!({"attributes": {"POSITION": positions}}), json!({}));
        assert_near(corners(&builder.pose().geometry, 0), FIRST);
    }
}

#[test]
fn quantised_positions_and_normalised_colours() {
    let mut builder = Builder::new();
    let shorts: Vec<u8> =
        [0_i16, 0, 0, 0, 32_767, 0, 0, 0, -32_768, 0, 0, 0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let view = builder.view(&shorts, json!({"byteStride": 8}));
    let mut positions = |normalized: bool| {
        builder.push(
            "accessors",
            json!({"bufferView": view, "type": "VEC3", "componentType": 5122, "count": 3,
                   "normalized": normalized}),
        )
    };
    let (plain, normalized) = (positions(false), positions(true));
    let colors =
        builder.accessor("VEC4", 5121, &[0, 51, 255, 102, 255, 255, 255, 255, 0, 0, 0, 0], json!({"normalized": true}));
    for positions in [plain, normalized] {
        builder.node_with(json!({"attributes": {"POSITION": positions, "COLOR_0": colors}}), json!({}));
    }
    let geometry = builder.pose().geometry;
    assert_near(corners(&geometry, 0), [[0.; 3], [32_767., 0., 0.], [-32_768., 0., 0.]]);
    let high: Vec<f64> = corners(&geometry, 1).iter().map(|c| c[0]).collect();
    // Relative to the centre of a scene with a size of 65,535 units, single precision resolves 1/512.
    for (found, expected) in high.iter().zip([0.0, 1.0, -1.0]) {
        assert!((found - expected).abs() < 2e-3, "{high:?}");
    }
    assert_eq!(geometry.streams.colors[0], [0., 0.2, 1., 0.4]);
}

#[test]
fn mirrored_nodes_keep_their_fronts() {
    let mut builder = Builder::new();
    builder.triangle(json!({"scale": [-1, 1, 1]}));
    let matrix = [1., 0., 0., 0., 0., -2., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.];
    builder.triangle(json!({"matrix": matrix}));
    builder.triangle(json!({"scale": [-1, -1, 1]}));
    let geometry = builder.pose().geometry;
    for t in 0..3 {
        let [a, b, c] = corners(&geometry, t).map(DVec3::from_array);
        // After mirroring along x or y, the side that faced +Z still faces it.
        assert!((b - a).cross(c - a).z > 0.0, "triangle {t}");
        let [v, _, _] = geometry.triangles[t];
        assert_eq!(geometry.streams.normals[v as usize], [0., 0., 1.]);
    }
}

#[test]
fn normals_follow_the_inverse_transpose() {
    let mut builder = Builder::new();
    let positions = builder.floats(&[[0., 0., 0.], [1., -1., 0.], [0., 0., 1.]]);
    let normals = builder.floats(&[[1., 1., 0.]; 3]);
    builder.node_with(json!({"attributes": {"POSITION": positions, "NORMAL": normals}}), json!({"scale": [4, 1, -1]}));
    let geometry = builder.pose().geometry;
    let length = (1.0_f32 / 16.0 + 1.0).sqrt();
    for normal in geometry.streams.normals {
        let expected = [0.25 / length, 1.0 / length, 0.0];
        for (found, expected) in normal.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{normal:?}");
        }
    }
}

#[test]
fn faces_without_normals_are_flat_and_share_no_vertex() {
    let mut builder = Builder::new();
    let roof = [[0., 0., 0.], [1., 0., 0.], [0., 1., 1.], [0., -1., 1.]];
    let positions = builder.floats(&roof);
    let indices = builder.indices(&[0, 1, 2, 1, 0, 3]);
    builder.node_with(json!({"attributes": {"POSITION": positions}, "indices": indices}), json!({}));
    let geometry = builder.pose().geometry;
    assert_eq!(geometry.positions.len(), 6);
    let half = 0.5_f32.sqrt();
    for (v, normal) in geometry.streams.normals.iter().enumerate() {
        let expected = [0.0, if v < 3 { -half } else { half }, half];
        for (found, expected) in normal.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{v}: {normal:?}");
        }
    }
}

#[test]
fn unusable_normals_are_replaced_with_one_warning() {
    let mut builder = Builder::new();
    let positions = builder.floats(&TRIANGLE);
    let normals = builder.floats(&[[0., 0., 5.], [0.; 3], [f32::NAN; 3]]);
    builder.node_with(json!({"attributes": {"POSITION": positions, "NORMAL": normals}}), json!({}));
    let loaded = builder.load().unwrap();
    assert_eq!(loaded.warnings.len(), 2, "{:?}", loaded.warnings);
    assert!(loaded.warnings[1].contains("2 of the normals"), "{:?}", loaded.warnings);
    let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
    assert_eq!(pose.geometry.streams.normals, [[0., 0., 1.]; 3]);
}

#[test]
fn triangles_without_a_place_are_dropped_and_counted() {
    let mut builder = Builder::new();
    let mut values = [TRIANGLE, TRIANGLE].concat();
    values[4][1] = f32::INFINITY;
    let positions = builder.floats(&values);
    let indices = builder.indices(&[0, 1, 2, 3, 4, 5, 0, 1, 6, 2, 0, 1]);
    builder.node_with(json!({"attributes": {"POSITION": positions}, "indices": indices}), json!({}));
    let loaded = builder.load().unwrap();
    let warnings = loaded.warnings.join("\n");
    assert!(warnings.contains("/meshes/0/primitives/0/indices: 1 of 4 triangles refer to"), "{warnings}");
    assert!(warnings.contains("/accessors/0: 1 of 3 triangles have infinite"), "{warnings}");
    let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
    assert_eq!(pose.geometry.triangles.len(), 2);
}

#[test]
fn only_vertices_in_use_are_kept() {
    let mut builder = Builder::new();
    let mut many = vec![[7.0_f32; 3]; 100];
    many[40..43].copy_from_slice(&TRIANGLE);
    let positions = builder.floats(&many);
    let normals = builder.floats(&[[0., 0., 1.]; 100]);
    let indices = builder.indices(&[40, 41, 42]);
    builder.node_with(json!({"attributes": {"POSITION": positions, "NORMAL": normals}, "indices": indices}), json!({}));
    let geometry = builder.pose().geometry;
    assert_eq!(geometry.positions.len(), 3);
    assert_near(corners(&geometry, 0), FIRST);
}

#[test]
fn draws_are_sorted_by_class_and_merged() {
    let mut builder = Builder::new();
    let blend = builder.push("materials", json!({"alphaMode": "BLEND"}));
    let mask = builder.push("materials", json!({"alphaMode": "MASK", "doubleSided": true}));
    let positions = builder.floats(&TRIANGLE);
    let mut primitive = json!({"attributes": {"POSITION": positions}});
    for material in [Some(blend), None, None, Some(mask), None] {
        primitive["material"] = material.into();
        if material.is_none() {
            primitive.as_object_mut().unwrap().remove("material");
        }
        builder.node_with(primitive.clone(), json!({}));
    }
    let draws = builder.pose().geometry.draws;
    let found: Vec<_> = draws.iter().map(|d| (d.class, d.material, d.first_triangle, d.triangle_count)).collect();
    assert_eq!(
        found,
        [(DrawClass::Opaque, 2, 0, 3), (DrawClass::MaskDoubleSided, 1, 3, 1), (DrawClass::Blend, 0, 4, 1),]
    );
}

#[test]
fn far_from_the_origin_nothing_is_lost() {
    let mut builder = Builder::new();
    let near = builder.triangle(json!({"translation": [0.001, 0, 0]}));
    builder.push("nodes", json!({"children": [near], "translation": [1e9, -1e9, 0]}));
    let geometry = builder.pose().geometry;
    let [a, b, _] = geometry.triangles[0].map(|v| geometry.positions[v as usize]);
    assert_eq!([b[0] - a[0], b[1] - a[1]], [1.0, 0.0]);
    let (low, high) = geometry.bounds().unwrap();
    assert!((low.x - 1_000_000_000.001).abs() < 1e-6, "{low}");
    assert!((high.y + 999_999_999.0).abs() < 1e-6, "{high}");
}

#[test]
fn optional_streams_are_there_only_when_used() {
    let mut builder = Builder::new();
    let positions = builder.floats(&TRIANGLE);
    let uvs = builder.floats(&[[0., 1.], [1., 1.], [0., 0.]]);
    let texture = builder.texture([1, 2, 3]);
    let textured = builder.push("materials", json!({"normalTexture": {"index": texture, "texCoord": 1}}));
    let attributes = json!({"POSITION": positions, "TEXCOORD_1": uvs});
    builder.node_with(json!({"attributes": attributes}), json!({}));
    let streams = builder.pose().geometry.streams;
    assert!(streams.uvs.is_empty() && streams.tangents.is_empty() && streams.colors.is_empty());

    builder.node_with(json!({"attributes": attributes, "material": textured}), json!({}));
    let geometry = builder.pose().geometry;
    let draw = geometry.draws[1];
    assert_eq!(draw.material, textured as u32);
    let v = geometry.triangles[draw.first_triangle as usize][1] as usize;
    assert_eq!(geometry.streams.uvs[v], [0., 0., 1., 1.]);
    assert_eq!(geometry.streams.tangents[v], [1., 0., 0., 1.]);
    assert_eq!(geometry.streams.uvs[0], [0.; 4]);
    assert!(geometry.streams.colors.is_empty());
}

#[test]
fn scenes_are_chosen_by_request_default_or_order() {
    let mut builder = Builder::new();
    for x in 0..3 {
        builder.triangle(json!({"translation": [x, 0, 0]}));
    }
    let first = |builder: &Builder, scene| {
        let request = PoseRequest { scene, ..PoseRequest::default() };
        let geometry = builder.pose_at(&request).geometry;
        (geometry.triangles.len(), corners(&geometry, 0)[0][0])
    };
    assert_eq!(first(&builder, None), (3, 0.0));
    assert!(builder.load().unwrap().warnings[0].contains("no scenes"));
    builder.push("scenes", json!({"nodes": [1]}));
    builder.push("scenes", json!({"nodes": [2, 2]}));
    assert_eq!(first(&builder, None), (1, 1.0));
    builder.json["scene"] = 1.into();
    assert_eq!(first(&builder, None), (1, 2.0));
    assert_eq!(first(&builder, Some(0)), (1, 1.0));
    let request = PoseRequest { scene: Some(2), ..PoseRequest::default() };
    let error = builder.load().unwrap().scene.pose(&request).unwrap_err();
    assert!(error.to_string().contains("no scene 2, the file has 2"), "{error}");
}

#[test]
fn a_large_mesh_that_is_drawn_often_is_held_once() {
    const SIDE: usize = 17;
    const COPIES: usize = 200;
    let mut builder = Builder::new();
    let grid: Vec<[f32; 3]> =
        (0..SIDE * SIDE).map(|v| [(v % SIDE) as f32, (v / SIDE) as f32, (v % 7) as f32]).collect();
    let mut indices = Vec::new();
    for row in 0..SIDE - 1 {
        for a in (row * SIDE..).take(SIDE - 1) {
            indices.extend([a, a + 1, a + SIDE, a + 1, a + 1 + SIDE, a + SIDE].map(|v| v as u16));
        }
    }
    let positions = builder.floats(&grid);
    let corners_of = builder.indices(&indices);
    let mesh =
        builder.push("meshes", json!({"primitives": [{"attributes": {"POSITION": positions}, "indices": corners_of}]}));
    let size = |copy: usize| [if copy == 3 { -2.0 } else { 2.0 }, 1.0, 0.5];
    for copy in 0..COPIES {
        let place = [copy as f64, 3.0, 0.0];
        builder.push("nodes", json!({"mesh": mesh, "translation": place, "scale": size(copy)}));
    }
    builder.triangle(json!({}));
    let geometry = builder.pose().geometry;

    let count = indices.len() / 3;
    assert_eq!(geometry.triangles.len(), count + 1);
    assert_eq!(geometry.triangle_count(), (COPIES * count + 1) as u64);
    assert_eq!(geometry.instances.len(), COPIES + 1);
    let flat = geometry.flat();
    assert!(flat.instances.is_empty());
    // Motions refer to vertices by their indices.
    assert!(flat.positions.starts_with(&geometry.positions));
    assert_eq!(flat.triangles.len() as u64, geometry.triangle_slots());
    let drawn: u32 = flat.draws.iter().map(|draw| draw.triangle_count).sum();
    assert_eq!(drawn as usize, flat.triangles.len());
    assert_near(corners(&flat, 0), FIRST);
    for (copy, instance) in geometry.instances[1..].iter().enumerate() {
        assert_eq!(instance.first_index % MeshInstance::ALIGNMENT, 0);
        assert_eq!(instance.mirrored(), copy == 3);
        for (triangle, corners_of) in indices.chunks(3).enumerate() {
            let place = |v: u16| {
                let [x, y, z] = grid[v as usize].map(f64::from);
                let [width, height, depth] = size(copy);
                [x * width + copy as f64, y * height + 3.0, z * depth]
            };
            let mut expected = [0, 1, 2].map(|corner| place(corners_of[corner]));
            if copy == 3 {
                expected.swap(1, 2);
            }
            let found = corners(&flat, instance.first_index as usize + triangle);
            let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-4;
            let pairs = found.as_flattened().iter().zip(expected.as_flattened());
            assert!(pairs.into_iter().all(near), "{found:?} {expected:?}");
        }
    }
    let (low, high) = geometry.bounds().unwrap();
    assert_eq!(flat.bounds().map(|(l, h)| (l.as_vec3(), h.as_vec3())), Some((low.as_vec3(), high.as_vec3())));
}
