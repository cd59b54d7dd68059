//! OBJ, STL and PLY.

use std::path::Path;

use glam::DVec3;
use gpc::scene::{AlphaMode, Loaded, Pose, PoseRequest, Scene, SceneError};

fn load(bytes: &[u8], base: Option<&Path>) -> Result<Loaded, SceneError> {
    Scene::from_slice(bytes, "test", base)
}

#[track_caller]
fn pose(bytes: &[u8]) -> (Loaded, Pose) {
    let loaded = load(bytes, None).unwrap();
    let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
    (loaded, pose)
}

#[track_caller]
fn refused(bytes: &[u8], message: &str) {
    let error = load(bytes, None).unwrap_err().to_string();
    assert!(error.starts_with("test: "), "{error}");
    assert!(error.contains(message), "{error}");
}

const QUAD: &str = "# a comment\nmtllib quad.mtl\no quad\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n\
    vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl paint\nf 1/1 2/2 3/3 4/4\n";

/// The order of a file's corners means nothing if the file has normals: a front is where these point.
#[test]
fn normals_decide_which_side_of_a_face_is_its_front() {
    let obj = |corners: &str, z: i32| format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 {z}\nf {corners}\n");
    let ply = |corners: &str, z: i32| {
        let head = "ply\nformat ascii 1.0\nelement vertex 3\n";
        let axes = ["x", "y", "z", "nx", "ny", "nz"].map(|axis| format!("property float {axis}\n"));
        let faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
        let vertices = ["0 0 0", "1 0 0", "0 1 0"].map(|v| format!("{v} 0 0 {z}\n"));
        format!("{head}{}{faces}{}3 {corners}\n", axes.concat(), vertices.concat())
    };
    for z in [1, -1] {
        for file in [obj("1//1 2//1 3//1", z), obj("1//1 3//1 2//1", z), ply("0 1 2", z), ply("0 2 1", z)] {
            let geometry = pose(file.as_bytes()).1.geometry;
            let [a, b, c] = geometry.triangles[0].map(|v| glam::Vec3::from_array(geometry.positions[v as usize]));
            assert_eq!((b - a).cross(c - a), glam::Vec3::Z * z as f32, "{file}");
            let kept = geometry.streams.normals.iter().all(|n| *n == [0., 0., z as f32]);
            assert!(kept, "{:?}", geometry.streams.normals);
        }
    }
}

#[test]
fn obj_has_its_mtl_colours_and_textures() {
    let folder = tempfile::tempdir().unwrap();
    let mtl = "newmtl paint\nKd 0.5 0.25 1\nd 0.5\nmap_Kd maps\\a b.png\n";
    std::fs::write(folder.path().join("quad.mtl"), mtl).unwrap();
    std::fs::create_dir(folder.path().join("maps")).unwrap();
    let image = image::RgbaImage::from_pixel(2, 2, image::Rgba([1, 2, 3, 255]));
    image.save(folder.path().join("maps/a b.png")).unwrap();
    let loaded = load(QUAD.as_bytes(), Some(folder.path())).unwrap();
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    let scene = &loaded.scene;
    let paint = &scene.materials[0];
    assert_eq!(paint.base_color, [0.5, 0.25, 1.0, 0.5]);
    assert_eq!((paint.metallic, paint.alpha_mode), (0.0, AlphaMode::Blend));
    let texture = scene.textures[paint.base_color_texture.unwrap().texture as usize];
    assert_eq!(scene.images[texture.image as usize].pixels[..4], [1, 2, 3, 255]);

    let geometry = scene.pose(&PoseRequest::default()).unwrap().geometry;
    assert_eq!(geometry.triangles.len(), 2);
    assert_eq!(geometry.draws[0].material, 0);
    assert!(geometry.streams.normals.iter().all(|n| *n == [0.0, 0.0, 1.0]));
    // In OBJ v starts at the bottom of the image, in glTF at its top.
    for (position, uv) in geometry.positions.iter().zip(&geometry.streams.uvs) {
        let [x, y] = [0, 1].map(|i| position[i] + geometry.origin[i] as f32);
        assert_eq!([x, 1.0 - y], uv[..2]);
    }
    let info = serde_json::to_value(scene.info()).unwrap();
    assert_eq!((&info["format"], &info["triangles"]), (&"OBJ".into(), &2.into()));
}

/// A single component stands for all three. Without components, or if one is not a number, the default is used.
#[test]
fn mtl_colours_may_lack_components() {
    let folder = tempfile::tempdir().unwrap();
    for (colour, expected) in [("0.5", 0.5), ("0.5 0.5", 0.5), ("", 0.8), ("red", 0.8)] {
        let mtl = format!("newmtl paint\nKd {colour}\n");
        std::fs::write(folder.path().join("quad.mtl"), mtl).unwrap();
        let loaded = load(QUAD.as_bytes(), Some(folder.path())).unwrap();
        let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
        let material = &loaded.scene.materials[pose.geometry.draws[0].material as usize];
        assert_eq!(material.base_color[..3], [expected; 3], "{colour}");
        assert_eq!(loaded.warnings.len(), usize::from(colour == "red"));
    }
}

#[test]
fn obj_without_its_mtl_is_grey_with_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    for base in [None, Some(folder.path())] {
        let loaded = load(QUAD.as_bytes(), base).unwrap();
        let [warning] = loaded.warnings.as_slice() else {
            panic!("{:?}", loaded.warnings);
        };
        assert!(warning.starts_with("test: mtllib quad.mtl: "), "{warning}");
        let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
        let material = &loaded.scene.materials[pose.geometry.draws[0].material as usize];
        assert_eq!(material.base_color, [0.8, 0.8, 0.8, 1.0]);
    }
}

#[test]
fn obj_with_indices_beyond_its_vertices_is_refused() {
    refused(b"o nothing\n", "nor OBJ, STL or PLY");
    let corners = "v 0 0 0\r\nv 1 0 0\nv 0 1 \\\n0\n";
    for (statements, line, reason) in [
        ("v 0 0 zero", 5, "\"zero\" is not a number"),
        ("v 0 0,5 1", 5, "\"0,5\" has a decimal comma"),
        ("v 0 0", 5, "3 numbers are needed, and there are 2"),
        ("# of nothing\nvt 1 zero", 6, "\"zero\" is not a number"),
        ("f 1 2 three", 5, "\"three\" names no corner"),
        ("f 1 2 3\n\nf 1 2 5\no next\nv 0 0 1", 7, "vertex 5 is named, and there are 4"),
        ("l 1 0", 5, "vertex 0 is named, and there are 3"),
        ("f -1 -2 -3\nf -1 -2 -4", 6, "vertex -4 is named, and there are 3"),
        ("f 1 2 4\nv 0 0 1\nvn 0 0 1\nf 1//1 2//1 3//2", 8, "normal 2 is named, and there are 1"),
        // Found by fuzzing: a texture coordinate before the first one.
        ("vt 0 0\nf 1/-9 2/1 3/1", 6, "texture coordinate -9 is named, and there are 1"),
    ] {
        let expected = format!("line {line}: the OBJ file is broken: {reason}");
        refused(format!("{corners}{statements}\n").as_bytes(), &expected);
    }
    // A statement over very many lines takes no longer than others.
    let long = format!("{corners}f 1 2 {}9\nf 1 2 3\n", "\\\n".repeat(300_000));
    refused(long.as_bytes(), "line 5: the OBJ file is broken: vertex 9");
}

/// A binary STL with this text in its header.
fn binary_stl(header: &str, triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = header.as_bytes().to_vec();
    bytes.resize(80, 0);
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        let normal_and_corners = [[[0.0; 3]].as_slice(), triangle].concat();
        let floats = normal_and_corners.as_flattened().iter();
        bytes.extend(floats.flat_map(|x| x.to_le_bytes()));
        bytes.extend([0, 0]);
    }
    bytes
}

const CORNERS: [[f32; 3]; 3] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]];

#[test]
fn stl_in_binary_and_as_text() {
    let text = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
        endloop\nendfacet\nendsolid\n";
    let named = text.replacen("solid", "solid a name", 1);
    let binary = binary_stl("made by hand", &[CORNERS]);
    let misleading = binary_stl("solid, says the header", &[CORNERS]);
    for bytes in [text.as_bytes(), named.as_bytes(), &binary, &misleading] {
        let (loaded, pose) = pose(bytes);
        assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
        assert_eq!(pose.geometry.triangles.len(), 1);
        assert_eq!(pose.geometry.bounds().unwrap().1, DVec3::new(1.0, 1.0, 0.0));
        assert!(loaded.scene.materials[0].double_sided);
    }
    refused(b"solid x\nfacet normal 0 0 nought\n", "the STL file is broken");
    refused(&binary[..100], "nor OBJ, STL or PLY");
    // A file that is named as an STL says why it is none.
    let named = |bytes: &[u8]| Scene::from_slice(bytes, "a.STL", None).unwrap_err().to_string();
    let cut = named(&binary[..100]);
    assert!(cut.contains("it states 1 triangles and has 100 bytes"), "{cut}");
    assert!(named(b"solid x\nendsolid x\n").contains("the STL file is broken: it has no facets"));
    let comma = text.replace("1 0 0", "1,0 0 0");
    let comma = load(comma.as_bytes(), None).unwrap_err().to_string();
    assert!(comma.contains("line 5: the STL file is broken: \"1,0\" has a decimal comma"), "{comma}");
}

#[test]
fn positions_that_are_not_finite_are_left_out() {
    let broken = [CORNERS[0], CORNERS[1], [f32::NAN, 0.0, 0.0]];
    let (loaded, pose) = pose(&binary_stl("", &[CORNERS, broken]));
    assert_eq!(pose.geometry.triangles.len(), 1);
    assert!(loaded.warnings[0].contains("1 of 2 triangles"), "{:?}", loaded.warnings);
}

/// A PLY header for this encoding; x is a double and far from the origin.
fn ply_header(format: &str, vertices: usize) -> String {
    format!(
        "ply\nformat {format} 1.0\nelement vertex {vertices}\nproperty double x\n\
         property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n\
         property uchar blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    )
}

#[test]
fn ply_in_all_encodings() {
    let far = 6_378_137.25;
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0_f32]];
    let mut ascii = ply_header("ascii", 4);
    for [x, y] in corners {
        ascii += &format!("{} {y} 0 255 0 188\n", far + f64::from(x));
    }
    ascii += "4 0 1 2 3\n";
    let mut little = ply_header("binary_little_endian", 4).into_bytes();
    let mut big = ply_header("binary_big_endian", 4).into_bytes();
    for [x, y] in corners {
        let x = far + f64::from(x);
        little.extend([&x.to_le_bytes()[..], &y.to_le_bytes(), &[0; 4], &[255, 0, 188]].concat());
        big.extend([&x.to_be_bytes()[..], &y.to_be_bytes(), &[0; 4], &[255, 0, 188]].concat());
    }
    little.push(4);
    big.push(4);
    for i in 0..4_i32 {
        little.extend(i.to_le_bytes());
        big.extend(i.to_be_bytes());
    }
    for bytes in [ascii.as_bytes(), &little, &big] {
        let (loaded, pose) = pose(bytes);
        assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
        assert_eq!(pose.geometry.triangles.len(), 2);
        let (low, high) = pose.geometry.bounds().unwrap();
        assert_eq!((low, high), (DVec3::new(far, 0., 0.), DVec3::new(far + 1.0, 1., 0.)));
        let [r, g, b, a] = pose.geometry.streams.colors[0];
        assert_eq!((r, g, a), (1.0, 0.0, 1.0));
        assert!((b - 0.5029).abs() < 1e-3, "{b}");
    }
}

#[test]
fn ply_cannot_claim_what_is_not_there() {
    refused(ply_header("ascii", 1 << 40).as_bytes(), "element vertex: claims 1099511627776");
    refused(ply_header("binary_little_endian", 100).as_bytes(), "the PLY file is broken");
    let empty = "ply\nformat binary_little_endian 1.0\nelement nothing 1\nend_header\n";
    refused(empty.as_bytes(), "element nothing: has no properties");
    refused(b"ply\nformat ascii 1.0\n", "the PLY file is broken");
    let long = b"ply\nformat binary_little_endian 1.0\nelement face 1\n\
        property list uint int vertex_indices\nend_header\n\xFF\xFF\xFF\xFF";
    refused(long, "the PLY file is broken");
}

#[test]
fn vertices_of_ply_are_points_where_nothing_connects_them() {
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
        property float z\n";
    let cloud = format!("{header}end_header\n1 2 3\n4 5 6\n1e60 0 0\n");
    let (loaded, _) = pose(cloud.as_bytes());
    assert_eq!(loaded.scene.info().points, 2);
    assert!(loaded.warnings[0].contains("1 of 3"), "{:?}", loaded.warnings);
    let edges = "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n";
    let wires = format!("{header}{edges}0 0 0\n1 0 0\n1 1 0\n0 1\n1 2\n");
    let (loaded, pose) = pose(wires.as_bytes());
    let info = loaded.scene.info();
    assert_eq!((info.points, info.lines), (0, 2));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    assert_eq!(pose.geometry.strokes.len(), 4 + 3 + 4);
}

#[test]
fn lines_and_points_of_obj_are_no_faces() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nl 1 2 3 4\np 1 3\n  f 1 2 3\r\nl -1 -2\n";
    let (loaded, pose) = pose(text.as_bytes());
    let info = loaded.scene.info();
    assert_eq!((info.triangles, info.lines, info.points), (1, 4, 2));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    let (low, high) = pose.geometry.bounds().unwrap();
    assert_eq!((low, high), (DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0)));
    refused(b"v 0 0 0\nl 1 2\n", "line 2: the OBJ file is broken: vertex 2 is named");
}

#[test]
fn strips_of_ply_keep_their_sides() {
    let strips = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
        property uchar diffuse_red\nproperty uchar diffuse_green\nproperty uchar diffuse_blue\n\
        element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
        0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n1 1 0 255 0 0\n0 2 0 255 0 0\n9 0 1 2 3 4 -1 0 1 3\n";
    let (loaded, pose) = pose(strips.as_bytes());
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    assert_eq!(pose.geometry.triangles.len(), 4);
    for triangle in &pose.geometry.triangles {
        let [a, b, c] = triangle.map(|v| DVec3::from_array(pose.geometry.positions[v as usize].map(f64::from)));
        assert!((b - a).cross(c - a).z > 0.0);
    }
    assert_eq!(pose.geometry.streams.colors[0], [1.0, 0.0, 0.0, 1.0]);
}

/// Statements that programs write: vertex colours, names and indices of all kinds, polygons, continued lines, and
/// other line ends.
#[test]
fn obj_as_programs_write_it() {
    let folder = tempfile::tempdir().unwrap();
    let mtl = "newmtl red paint\r\nKd 1 0 0\r\nmap_Kd -clamp on -s 2 3 1 -o 0.5 0.25 a b.png\r\n";
    std::fs::write(folder.path().join("my scene.mtl"), mtl).unwrap();
    let image = image::RgbaImage::from_pixel(2, 2, image::Rgba([1, 2, 3, 255]));
    image.save(folder.path().join("a b.png")).unwrap();
    let obj = "# Munchen\r\nmtllib my scene.mtl\r\no first one\r\n\
        v\t0 0 0 1 0 0\r\nv 1 0 0 0 1 0\r\nv  1 1 0 0 0 1 \r\nv 0.5 1.5 0 1 1 1\r\nv 0 1e0 0 1 1 1\r\n\
        vt 0 0\r\nvt 1 0 0\r\nvt 1 1\r\nusemtl red paint\r\ns off\r\n\
        f -5/1 -4/2 -3/3 -2/3 \\\r\n  -1/3\r\nf 1//  2// 3//\r\n";
    // Comments of old programs may not be UTF-8.
    let mut obj = obj.as_bytes().to_vec();
    obj[3] = 0xFC;
    let loaded = load(&obj, Some(folder.path())).unwrap();
    assert_eq!(loaded.warnings, ["test: left out: MTL statements (1: -clamp of map_Kd)"]);
    let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
    assert_eq!(pose.geometry.triangles.len(), 4);
    let used = loaded.scene.materials[0].base_color_texture.unwrap();
    // With v from the top, the transform is 1 - (3 (1 - v) + 0.25).
    assert_eq!(used.transform.0, [[2.0, 0.0, 0.5], [0.0, 3.0, -2.25]]);
    assert_eq!(pose.geometry.streams.colors[0], [1.0, 0.0, 0.0, 1.0]);
}
