//! Kinds of content of OBJ, STL and PLY files that other readers have got wrong.

use std::path::Path;

use glam::DVec3;
use gpc::scene::{AlphaMode, Loaded, Pose, PoseRequest, Scene};

#[track_caller]
fn load_in(bytes: &[u8], base: Option<&Path>) -> (Loaded, Pose) {
    let loaded = Scene::from_slice(bytes, "test", base).unwrap();
    let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
    (loaded, pose)
}

#[track_caller]
fn load(text: &str) -> (Loaded, Pose) {
    load_in(text.as_bytes(), None)
}

/// Area vectors of all triangles.
fn areas(pose: &Pose) -> Vec<DVec3> {
    let at = |v: u32| DVec3::from_array(pose.geometry.positions[v as usize].map(f64::from));
    let triangles = pose.geometry.triangles.iter();
    triangles.map(|&[a, b, c]| (at(b) - at(a)).cross(at(c) - at(a)) / 2.0).collect()
}

/// An OBJ file with one polygon in the plane through the axes `axes`.
fn polygon(corners: &[[f64; 2]], axes: [usize; 2]) -> String {
    let mut text = String::new();
    for corner in corners {
        let mut position = [0.0; 3];
        axes.iter().zip(corner).for_each(|(axis, x)| position[*axis] = *x);
        let [x, y, z] = position;
        text += &format!("v {x} {y} {z}\n");
    }
    let all: Vec<String> = (1..=corners.len()).map(|i| i.to_string()).collect();
    text + "f " + &all.join(" ") + "\n"
}

#[test]
fn polygons_keep_their_area_and_side_in_every_plane() {
    let square = [[0., 0.], [4., 0.], [4., 4.], [0., 4.]];
    let concave = [[0., 0.], [4., 0.], [4., 4.], [2., 1.], [0., 4.]];
    // A hole, which a bridge from the first corner reaches and leaves.
    let keyhole = [[0., 0.], [4., 0.], [4., 4.], [0., 4.], [0., 0.], [1., 1.], [1., 3.], [3., 3.], [3., 1.], [1., 1.]];
    // A hole that touches the outline in one corner, and one that shares a part of an edge.
    let touching = [[0., 0.], [4., 0.], [4., 4.], [0., 4.], [0., 0.], [1., 2.], [2., 1.]];
    let resting = [[0., 0.], [1., 0.], [1., 2.], [2., 2.], [2., 0.], [4., 0.], [4., 4.], [0., 4.]];
    let repeated = [[0., 0.], [0., 0.], [4., 0.], [4., 4.], [4., 4.], [2., 1.], [0., 4.], [0., 0.]];
    for (corners, expected) in [
        (&square[..], 16.0),
        (&concave, 10.0),
        (&keyhole, 12.0),
        (&touching, 14.5),
        (&resting, 14.0),
        (&repeated, 10.0),
    ] {
        for axes in [[0, 1], [1, 0], [1, 2], [2, 0], [0, 2]] {
            let (loaded, pose) = load(&polygon(corners, axes));
            assert!(loaded.warnings.is_empty(), "{corners:?} {:?}", loaded.warnings);
            let areas = areas(&pose);
            let [i, j] = axes;
            let (mut a, mut b) = (DVec3::ZERO, DVec3::ZERO);
            (a[i], b[j]) = (1.0, 1.0);
            let normal = a.cross(b);
            assert!(areas.iter().all(|area| area.dot(normal) >= 0.0), "{corners:?} {axes:?}");
            let whole: f64 = areas.iter().map(|area| area.length()).sum();
            assert!((whole - expected).abs() < 1e-5, "{corners:?} {axes:?}: {whole}");
        }
    }
}

/// Every corner is in a triangle, so that the polygon does not come apart from its neighbours.
#[test]
fn corners_on_straight_edges_of_polygons_stay() {
    let comb =
        [[0., 0.], [1., 0.], [2., 0.], [3., 0.], [4., 0.], [4., 1.], [4., 4.], [2., 1.], [0., 4.], [0., 2.], [0., 1.]];
    let (_, pose) = load(&polygon(&comb, [0, 1]));
    let [low, ..] = [pose.geometry.origin];
    let found: std::collections::BTreeSet<_> =
        pose.geometry.positions.iter().map(|p| [0, 1].map(|i| (f64::from(p[i]) + low[i]).round() as i64)).collect();
    assert_eq!(found.len(), comb.len());
    assert!(areas(&pose).iter().all(|area| area.z > 0.0));
}

#[test]
fn polygons_that_cross_themselves_are_named() {
    // Ties whose halves have different areas, and the same.
    for height in [2.0, 3.0] {
        let bow_tie = [[0., 0.], [4., 0.], [0., height], [4., 4.]];
        let (loaded, _) = load(&polygon(&bow_tie, [0, 1]));
        let is_named = loaded.warnings[0].contains("1 polygons cross themselves");
        assert!(is_named, "{:?}", loaded.warnings);
    }
    let (loaded, pose) = load("v 0 0 0\nv nan 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4 5\nf 1 2\n");
    assert_eq!(areas(&pose).len(), 2);
    assert!(loaded.warnings[0].contains("1 faces have fewer than 3 corners"), "{:?}", loaded.warnings);
    assert!(loaded.warnings[1].contains("1 corners of polygons have no position"), "{:?}", loaded.warnings);
}

/// Time does not grow with the square of what a file repeats.
#[test]
fn everything_in_one_place_takes_no_longer() {
    let mut text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n".to_owned();
    for i in 1..=100_000 {
        text += &format!("vt {i} 0\n");
    }
    for i in 1..=100_000 {
        text += &format!("f 1/{i} 2/{i} 3/{i}\n");
    }
    let (loaded, _) = load(&text);
    assert_eq!(loaded.scene.info().triangles, 100_000);
    // A polygon of very many corners that is not convex.
    let star = (0..200_000).map(|i| {
        let angle = std::f64::consts::TAU * f64::from(i) / 200_000.0;
        let radius = if i % 2 == 0 { 1.0 } else { 0.5 };
        [radius * angle.cos(), radius * angle.sin()]
    });
    let star = polygon(&star.collect::<Vec<_>>(), [0, 1]);
    let error = Scene::from_slice(star.as_bytes(), "test", None).unwrap_err().to_string();
    assert!(error.contains("has 200000 corners, and at most 16384"), "{error}");
    // A convex one has a fan of triangles, whatever rounding does to its corners.
    let disk = (0..200_000).map(|i| {
        let angle = std::f64::consts::TAU * f64::from(i) / 200_000.0;
        [1e6 * angle.cos(), 1e6 * angle.sin()]
    });
    let (loaded, _) = load(&polygon(&disk.collect::<Vec<_>>(), [0, 1]));
    assert_eq!(loaded.scene.info().triangles, 199_998, "{:?}", loaded.warnings);
}

#[test]
fn vertices_of_obj_are_points_where_nothing_connects_them() {
    let (loaded, pose) = load("# points\nv 0 0 0 1 0 0\nvn 0 0 1\nv 1 0 0 0 1 0\nvn 0 0 1\nv nan 0 0\nvn 0 0 1\n");
    let info = loaded.scene.info();
    assert_eq!((info.points, info.triangles), (2, 0));
    assert!(loaded.warnings[0].contains("1 of 3 points"), "{:?}", loaded.warnings);
    assert_eq!(pose.geometry.streams.colors[0], [1.0, 0.0, 0.0, 1.0]);
    let material = &loaded.scene.materials[pose.geometry.draws[0].material as usize];
    assert!(!material.unlit && material.base_color == [1.0; 4]);
}

#[test]
fn colours_of_obj_are_codes_of_one_or_of_a_byte() {
    let faces = "f 1 2 3\n";
    for (largest, scale, name) in [(1.0, 1.0, "one"), (255.0, 255.0, "byte"), (1.5, 1.0, "bright")] {
        let code = 0.5 * scale;
        let text = format!("v 0 0 0 {largest} 0 {code}\nv 1 0 0 0 0 0\nv 0 1 0\n{faces}");
        let (_, pose) = load(&text);
        let [r, g, b, a] = pose.geometry.streams.colors[0];
        assert_eq!((r, g, a), (1.0, 0.0, 1.0), "{name}");
        assert!((b - 0.214).abs() < 1e-3, "{name}: {b}");
        assert_eq!(pose.geometry.streams.colors[2], [1.0; 4], "{name}");
    }
}

#[test]
fn faces_of_obj_with_normals_and_without() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 1 1\nf 1//1 2//1 3//1\nf 2 4 3\n";
    let (loaded, pose) = load(text);
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    assert_eq!(pose.geometry.triangles.len(), 2);
    let normals = &pose.geometry.streams.normals;
    assert!(normals.contains(&[0.0, 0.0, 1.0]) && normals.len() == 6, "{normals:?}");
}

/// Statements between which a part has no elements, other line ends, comments behind numbers, and absolute paths.
#[test]
fn obj_with_oddities() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    std::fs::create_dir(path("maps")).unwrap();
    let image = image::RgbaImage::from_pixel(2, 2, image::Rgba([1, 2, 3, 255]));
    image.save(path("maps/a.png")).unwrap();
    let mtl = "\u{feff}newmtl\nKd 1 0 0\nnewmtl two words\nKD 0 1 0\nMAP_KD C:\\maps\\of\\me\\a.png\ntr 0.25\n";
    std::fs::write(path("maps/scene.mtl"), mtl).unwrap();
    std::fs::write(path("other.mtl"), "newmtl other\nKd 0 0 1\n").unwrap();
    let obj = "\u{feff}# of a Mac\rmtllib \"maps\\scene.mtl\" other.mtl\rv 0 0 0 # the first\rv 1 0 0\rv 0 1 0\rvt 0 0\r\
        usemtl\rg a\rg b\rf 1 2 3 # a face\rusemtl \"two words\"\rf 1/1 2/1 3/1\rusemtl other\rfo 1 2 3\r";
    let (loaded, pose) = load_in(obj.as_bytes(), Some(folder.path()));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    let colours: Vec<_> =
        pose.geometry.draws.iter().map(|draw| loaded.scene.materials[draw.material as usize].base_color).collect();
    // BLEND surfaces are drawn last.
    let mut sorted = colours.clone();
    sorted.sort_by(|a, b| b.partial_cmp(a).unwrap());
    assert_eq!(sorted, [[1., 0., 0., 1.], [0., 1., 0., 0.75], [0., 0., 1., 1.]]);
    assert_eq!(loaded.scene.images.len(), 1);
}

#[test]
fn opacities_of_mtl() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let grey = image::GrayImage::from_fn(4, 4, |x, _| image::Luma([(85 * x) as u8]));
    grey.save(path("ramp.png")).unwrap();
    let image = image::RgbaImage::from_pixel(2, 2, image::Rgba([10, 20, 30, 255]));
    image.save(path("a.tga")).unwrap();
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
    let read = |statements: &str| {
        std::fs::write(path("m.mtl"), format!("newmtl m\n{statements}")).unwrap();
        let (loaded, _) = load_in(obj.as_bytes(), Some(folder.path()));
        let material = loaded.scene.materials[0].clone();
        (loaded, material)
    };
    for (statements, alpha) in
        [("d 0.5\n", 0.5), ("Tr 0.25\n", 0.75), ("Tr 0.9\nd 0.5\n", 0.5), ("d 0.5\nTr 0.9\n", 0.5), ("d 0\n", 0.0)]
    {
        let (loaded, material) = read(statements);
        assert_eq!(material.base_color[3], alpha, "{statements}");
        assert_eq!(material.alpha_mode, AlphaMode::Blend, "{statements}");
        assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    }
    let (loaded, material) = read("Tr 1\n");
    assert_eq!((material.base_color[3], material.alpha_mode), (1.0, AlphaMode::Opaque));
    assert!(loaded.warnings[0].contains("newmtl m/Tr"), "{:?}", loaded.warnings);

    let (loaded, material) = read("Kd 1 0 0\nmap_D ramp.png\nmap_kd a.tga\n");
    assert_eq!(material.alpha_mode, AlphaMode::Blend);
    let image = &loaded.scene.images[0];
    assert_eq!([image.width, image.height], [4, 4]);
    let texels: Vec<_> = image.pixels[..16].chunks_exact(4).collect();
    assert_eq!(texels, [[10, 20, 30, 0], [10, 20, 30, 85], [10, 20, 30, 170], [10, 20, 30, 255]]);
    // Without one of the images, the other is used.
    let (loaded, material) = read("map_d ramp.png\nmap_Kd none.png\n");
    assert_eq!(material.base_color[..3], [1.0; 3]);
    assert_eq!(loaded.scene.images.len(), 1);
    assert!(loaded.warnings[0].contains("newmtl m/map_Kd: none.png"), "{:?}", loaded.warnings);
    let (loaded, material) = read("map_d none.png\nmap_Kd a.tga\n");
    assert_eq!((loaded.scene.images.len(), material.alpha_mode), (1, AlphaMode::Opaque));
    assert!(loaded.warnings[0].contains("newmtl m/map_d: none.png"), "{:?}", loaded.warnings);
}

#[test]
fn text_of_stl_in_any_case_and_order() {
    let facet = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet ";
    for (text, triangles) in [
        (format!("solid one {facet}{facet}endsolid one solid {facet}endsolid"), 3),
        (format!("\u{feff}  \r\n SOLID X\r\n{}ENDSOLID X", facet.to_uppercase()), 1),
        (format!("solid\n{facet}\nendsolid\n\nsolid\n{facet}"), 2),
        (
            "solid a\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nend loop\nend facet\n\
            end solid a\n"
                .to_owned(),
            2,
        ),
    ] {
        let (loaded, _) = load(&text);
        assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
        assert_eq!(loaded.scene.info().triangles, triangles, "{text}");
    }
    // ANSA writes the colour of a solid.
    let colours = format!("solid a\ncolor 1 0 0\n{facet}\nendsolid\nsolid b\n{facet}\nendsolid\n");
    let (_, pose) = load(&colours);
    let colours = &pose.geometry.streams.colors;
    assert_eq!((colours[0], colours[3]), ([1.0, 0.0, 0.0, 1.0], [0.8, 0.8, 0.8, 1.0]));
    let (loaded, pose) = load(&format!("solid a\n{facet}\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0"));
    assert_eq!(pose.geometry.triangles.len(), 1);
    assert!(loaded.warnings[0].contains("ends within a facet"), "{:?}", loaded.warnings);
}

/// Text in UTF-16, as shells write it, numbers of Fortran, and marks, blanks and zeros around the text.
#[test]
fn text_in_other_encodings() {
    let obj = "v 0 0 0\nv 1.0D+0 0 0\nv 0 1d0 0\nf 1 2 3\n";
    let stl = "solid a\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for text in [obj, stl, ply] {
        let units = || ['\u{feff}'].into_iter().chain(text.chars()).map(|c| c as u16);
        let little: Vec<u8> = units().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = units().flat_map(u16::to_be_bytes).collect();
        for bytes in [little, big, format!("\u{feff}{text}").into_bytes(), format!("\r\n {text}").into_bytes()] {
            let (loaded, pose) = load_in(&bytes, None);
            assert_eq!((pose.geometry.triangles.len(), loaded.warnings.len()), (1, 0), "{text}");
        }
    }
    let (loaded, _) = load(&format!("{stl}\0\0\0"));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
}

/// A binary STL file whose triangles have these attributes.
fn binary_stl(header: &[u8], attributes: &[u16]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, 0);
    bytes.extend((attributes.len() as u32).to_le_bytes());
    for attribute in attributes {
        let floats: [f32; 12] = [0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0.];
        bytes.extend(floats.iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend(attribute.to_le_bytes());
    }
    bytes
}

#[test]
fn colours_of_binary_stl() {
    let colours = |bytes: &[u8]| -> Vec<[f32; 4]> {
        let (_, pose) = load_in(bytes, None);
        pose.geometry.streams.colors.iter().step_by(3).copied().collect()
    };
    let (red, blue, grey) = ([1., 0., 0., 1.], [0., 0., 1., 1.], [0.8, 0.8, 0.8, 1.]);
    let viscam = binary_stl(b"", &[0x8000 | 31 << 10, 0x8000 | 31, 0]);
    assert_eq!(colours(&viscam), [red, blue, grey]);
    let magics = binary_stl(b"COLOR=\x00\x00\xFF\xFF", &[31, 0x8000]);
    assert_eq!(colours(&magics), [red, blue]);
    let none = binary_stl(b"", &[0, 7]);
    assert!(colours(&none).is_empty());
    let (loaded, _) = load_in(&none, None);
    assert_eq!(loaded.warnings, ["test: left out: attributes of triangles (1)"]);
}

/// A PLY file of a square, with this header for its faces and these rows of them.
fn square_ply(header: &str, rows: &str) -> String {
    format!("ply\nformat ascii 1.0\n{header}end_header\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n{rows}",)
}

const VERTICES: &str = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float s\n\
    property float t\n";

#[test]
fn textures_of_ply_by_vertex_and_by_corner() {
    let folder = tempfile::tempdir().unwrap();
    for (name, color) in [("a b.png", [255, 0, 0, 255]), ("b.bmp", [0, 255, 0, 255])] {
        let image = image::RgbaImage::from_pixel(2, 2, image::Rgba(color));
        image.save(folder.path().join(name)).unwrap();
    }
    let read = |text: &str| load_in(text.as_bytes(), Some(folder.path()));
    let faces = "element face 1\nproperty list uchar int vertex_indices\n";
    let (loaded, pose) = read(&square_ply(&format!("comment TextureFile a b.png\n{VERTICES}{faces}"), "4 0 1 2 3\n"));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    assert!(loaded.scene.materials[0].base_color_texture.is_some());
    assert_eq!(loaded.scene.materials[0].base_color, [1.0; 4]);
    for (position, uv) in pose.geometry.positions.iter().zip(&pose.geometry.streams.uvs) {
        let [x, y] = [0, 1].map(|i| position[i] + pose.geometry.origin[i] as f32);
        assert_eq!([x, 1.0 - y], uv[..2]);
    }

    let faces = "element face 3\nproperty list uchar int vertex_index\nproperty list uchar float texcoord\n\
        property int texnumber\n";
    let (loaded, pose) = read(&square_ply(
        &format!("comment TextureFile a b.png\ncomment TextureFile b.bmp\n{VERTICES}{faces}"),
        "3 0 1 2 6 0 0 1 0 1 1 1\n3 0 2 3 6 .5 .5 .5 .5 .5 .5 0\n3 0 2 3 6 0 0 0 0 0 0 -1\n",
    ));
    assert_eq!((loaded.scene.images.len(), pose.geometry.draws.len()), (2, 3));
    let textures: Vec<Option<u32>> = pose
        .geometry
        .draws
        .iter()
        .map(|draw| loaded.scene.materials[draw.material as usize].base_color_texture)
        .map(|used| used.map(|used| used.texture))
        .collect();
    assert_eq!(textures, [Some(0), Some(1), None]);
    assert!(pose.geometry.streams.uvs[..3].iter().all(|uv| uv[..2] == [0.5, 0.5]));
    let (loaded, _) = read(&square_ply(&format!("comment TextureFile none.png\n{VERTICES}"), ""));
    assert!(loaded.warnings[0].contains("comment TextureFile: none.png"), "{:?}", loaded.warnings);
}

#[test]
fn colours_of_ply_by_other_names() {
    for (names, kind, codes) in [
        (["red", "green", "blue"], "uchar", "255 0 0"),
        (["r", "g", "b"], "uchar", "255 0 0"),
        (["diffuse_red", "diffuse_green", "diffuse_blue"], "float", "1 0 0"),
        (["r", "g", "b"], "float", "255.0 0 0"),
        (["red", "green", "blue"], "ushort", "65535 0 0"),
    ] {
        let properties: String = names.iter().map(|name| format!("property {kind} {name}\n")).collect();
        let text = format!(
            "ply\nformat ascii 1.0\ncomment M\u{fc}ller\nelement vertex 3\nproperty float x\nproperty float y\n\
             property float z\n{properties}element face 1\nproperty list uchar int vertex_indices\nend_header\n\
             0 0 0 {codes}\n\n1 0 0\n{codes}\n0 1 0 {codes}\n\n3 0 1 2\n"
        );
        // Comments may not be UTF-8.
        let latin: Vec<u8> = text.chars().map(|c| c as u8).collect();
        let (loaded, pose) = load_in(&latin, None);
        assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
        assert_eq!(pose.geometry.streams.colors[0], [1.0, 0.0, 0.0, 1.0], "{names:?} {kind}");
    }
}

/// Two faces of a roof in one smoothing group share the normal at their ridge; in two groups they do not, whatever the
/// objects and materials.
#[test]
fn smoothing_groups_of_obj() {
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 1\nv 1 1 1\nv 0 2 0\nv 1 2 0\n";
    for (second, is_smooth) in [("s 1", true), ("g b", true), ("s 2", false), ("s off", false)] {
        let text = format!("{vertices}s 1\nf 1 2 4 3\n{second}\nf 3 4 6 5\n");
        let (loaded, pose) = load(&text);
        assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
        let normals = &pose.geometry.streams.normals;
        let up = normals.iter().filter(|n| n[2] > 0.999).count();
        assert_eq!(up > 0, is_smooth, "{second}: {normals:?}");
    }
    // Normals of the file come first.
    let (_, pose) = load(&format!("{vertices}vn 0 0 -1\ns 1\nf 1//1 2//1 4//1 3//1\nf 3 4 6 5\n"));
    let normals = &pose.geometry.streams.normals;
    assert!(normals.contains(&[0.0, 0.0, -1.0]) && !normals.contains(&[0.0, 0.0, 1.0]), "{normals:?}");
}

/// Files of three.js#7943, kiss3d#228 and tinyobjloader-c#71: options of maps before their file and behind it.
#[test]
fn options_of_maps_stand_before_and_behind_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let image = image::RgbaImage::from_pixel(2, 2, image::Rgba([1, 2, 3, 255]));
    image.save(folder.path().join("a -b.png")).unwrap();
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
    for map in ["-s -15.0 -15.0 -3.7 a -b.png", "a -b.png -s -15 -15 -3.7", "-o 0 0 0 -s -15 -15 a -b.png -clamp off"] {
        std::fs::write(folder.path().join("m.mtl"), format!("newmtl m\nmap_Kd {map}\n")).unwrap();
        let (loaded, _) = load_in(obj.as_bytes(), Some(folder.path()));
        let used = loaded.scene.materials[0].base_color_texture;
        let used = used.unwrap_or_else(|| panic!("{map}: {:?}", loaded.warnings));
        assert_eq!(used.transform.0, [[-15.0, 0.0, 0.0], [0.0, -15.0, 16.0]], "{map}");
    }
}

/// Files of stl_reader#16: loops without facets around them.
#[test]
fn loops_of_stl_without_facets() {
    let corners = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
    for text in [
        format!("solid a\n{}endsolid\n", format!("outer loop\n{corners}endloop\n").repeat(2)),
        format!("solid a\n{}endsolid\n", format!("outer loop\n{corners}").repeat(2)),
    ] {
        let (loaded, _) = load(&text);
        assert_eq!(loaded.scene.info().triangles, 2, "{text}");
        assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    }
}
