//! Files as in public bug reports of other programs, from `../shared/reports`: each has a note of what is right.

use std::path::PathBuf;

use gpc::scene::{AlphaMode, Loaded, Pose, PoseRequest, Scene};

use crate::shared::shared;

fn path(name: &str) -> PathBuf {
    shared("reports").join(name)
}

#[track_caller]
fn load(name: &str) -> (Loaded, Pose) {
    let loaded = Scene::load(&path(name)).unwrap_or_else(|error| panic!("{error}"));
    let pose = loaded.scene.pose(&PoseRequest::default()).unwrap();
    (loaded, pose)
}

/// Colours of the materials of all triangles' first corners, in order, without repetitions.
fn colours(loaded: &Loaded, pose: &Pose) -> Vec<[f32; 3]> {
    let draws = pose.geometry.draws.iter();
    let of_draw = |draw: &gpc::scene::DrawRange| {
        let [r, g, b, _] = loaded.scene.materials[draw.material as usize].base_color;
        [r, g, b]
    };
    let mut colours: Vec<[f32; 3]> = draws.map(of_draw).collect();
    colours.dedup();
    colours
}

/// Area of all triangles.
fn area(pose: &Pose) -> f64 {
    let at = |v: u32| glam::DVec3::from_array(pose.geometry.positions[v as usize].map(f64::from));
    let triangles = pose.geometry.triangles.iter();
    let areas = triangles.map(|&[a, b, c]| (at(b) - at(a)).cross(at(c) - at(a)).length() / 2.0);
    areas.sum()
}

#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn polygons_are_what_they_are() {
    for (name, expected) in [
        ("01-obj-concave-ngon/c.obj", 7.0),
        ("01-obj-concave-ngon/c.ply", 7.0),
        ("01-obj-concave-ngon/x-open.obj", 0.666_7),
    ] {
        let (loaded, pose) = load(name);
        assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
        assert!((area(&pose) - expected).abs() < 1e-3, "{name}: {}", area(&pose));
    }
}

#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn places_of_surveys_lose_nothing() {
    for format in ["obj", "stl", "ply"] {
        let (_, local) = load(&format!("02-obj-utm/local.{format}"));
        let (_, utm) = load(&format!("02-obj-utm/utm.{format}"));
        let extents = |pose: &Pose| {
            let (low, high) = pose.geometry.bounds().unwrap();
            high - low
        };
        assert!((extents(&local) - extents(&utm)).abs().max_element() < 1e-5, "{format}");
        assert!((area(&local) - area(&utm)).abs() < 1e-4, "{format}");
    }
}

#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn numbers_that_are_none_leave_out_no_file() {
    for name in ["ind-uv", "minus-nan-normals", "msvc-new-normals", "nan-normals", "nan-uv", "qnan-normals"] {
        let (loaded, pose) = load(&format!("03-obj-nan/{name}.obj"));
        assert_eq!(pose.geometry.triangles.len(), 2, "{name}");
        assert_eq!(loaded.warnings.len(), usize::from(name.contains("normals")), "{name}");
        let normals = pose.geometry.streams.normals.iter();
        assert!(normals.into_iter().all(|n| *n == [0.0, 0.0, 1.0]), "{name}");
    }
}

#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn mtl_files_as_programs_write_them() {
    for name in ["m", "nokd"] {
        let (loaded, pose) = load(&format!("05-mtl-kd-black-map/{name}.obj"));
        assert_eq!(colours(&loaded, &pose), [[1.0; 3]], "{name}");
        assert_eq!(loaded.scene.images.len(), 1, "{name}");
    }
    let (loaded, _) = load("06-mtl-tr/m.obj");
    let alphas: Vec<f32> = loaded.scene.materials[..3].iter().map(|m| m.base_color[3]).collect();
    assert_eq!(alphas, [1.0, 0.5, 1.0]);

    let (red, green, blue, grey) = ([0.9, 0.1, 0.1], [0.1, 0.8, 0.1], [0.1, 0.2, 0.9], [0.8; 3]);
    for (name, expected) in [
        ("list", vec![red, green]),
        ("late", vec![red, green]),
        ("quoted", vec![blue]),
        ("unnamed", vec![grey, red]),
        ("backslash", vec![red]),
    ] {
        let (loaded, pose) = load(&format!("07-mtllib-list/{name}.obj"));
        assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
        assert_eq!(colours(&loaded, &pose), expected, "{name}");
    }
    let (loaded, _) = load("07-mtllib-list/sub/subfolder.obj");
    assert_eq!((loaded.scene.images.len(), loaded.warnings.len()), (1, 0));
}

#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn textures_of_other_formats_are_read_or_named() {
    let (png, _) = load("08-mtl-tga-bmp/map_d.obj");
    for name in ["bmp", "tga"] {
        let (loaded, _) = load(&format!("08-mtl-tga-bmp/{name}.obj"));
        assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
        let texels = |loaded: &Loaded| {
            let image = &loaded.scene.images[0];
            let texels = image.pixels.chunks_exact(4).map(|t| [t[0], t[1], t[2]]);
            texels.collect::<Vec<_>>()
        };
        assert_eq!(texels(&loaded), texels(&png), "{name}");
    }
    for (name, expected) in [("gif", "paint.gif: GIF"), ("tif", "paint.tif: TIFF")] {
        let (loaded, _) = load(&format!("08-mtl-tga-bmp/{name}.obj"));
        let [warning] = loaded.warnings.as_slice() else {
            panic!("{:?}", loaded.warnings);
        };
        let expected = format!("left out: textures (1: {expected} is not supported");
        assert!(warning.contains(&expected), "{warning}");
    }
    let material = &png.scene.materials[0];
    assert_eq!(material.alpha_mode, AlphaMode::Mask { cutoff: 0.5 });
    let image = &png.scene.images[0];
    let alpha = |x: usize, y: usize| image.pixels[4 * (64 * y + x) + 3];
    assert_eq!((alpha(0, 0), alpha(32, 32), alpha(63, 63)), (0, 255, 0));
}

#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn stl_files_as_programs_write_them() {
    for (name, expected) in [
        ("09-stl-trailing/one-byte", 24),
        ("09-stl-trailing/trailing", 24),
        ("09-stl-trailing/truncated", 22),
        ("09-stl-trailing/zero-count", 24),
        ("10-stl-multi-solid/three", 36),
        ("11-stl-text-variants/crlf-tabs", 12),
        ("11-stl-text-variants/end-solid", 12),
        ("11-stl-text-variants/facet-colour", 12),
        ("11-stl-text-variants/latin1", 12),
        ("11-stl-text-variants/leading", 12),
        ("11-stl-text-variants/long-name", 12),
        ("11-stl-text-variants/mac-eol", 12),
        ("11-stl-text-variants/no-endsolid", 12),
        ("11-stl-text-variants/normal-nan", 12),
        ("11-stl-text-variants/upper", 12),
    ] {
        let (loaded, _) = load(&format!("{name}.stl"));
        assert_eq!(loaded.scene.info().triangles, expected, "{name}");
    }
    let error = Scene::load(&path("11-stl-text-variants/comma.stl")).unwrap_err();
    assert!(error.to_string().contains("has a decimal comma"), "{error}");
    let (_, pose) = load("12-stl-colours/magics.stl");
    let mut colours: Vec<String> =
        pose.geometry.streams.colors.iter().map(|[r, g, b, _]| format!("{r:.2} {g:.2} {b:.2}")).collect();
    colours.sort();
    colours.dedup();
    assert_eq!(colours, ["0.00 1.00 0.00", "1.00 0.00 0.00", "1.00 0.22 0.01"]);
}

#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn ply_files_as_programs_write_them() {
    for (name, expected) in [
        ("13-ply-face-colours/scalar-first", 1),
        ("15-ply-header/crlf", 2),
        ("15-ply-header/face-before-vertex", 2),
        ("15-ply-header/float-list", 2),
        ("15-ply-header/int8-list", 2),
        ("15-ply-header/longer", 2),
        ("15-ply-header/nan-text", 2),
        ("15-ply-header/obj-info", 2),
        ("15-ply-header/starts-with-lf", 2),
        ("15-ply-header/trailing-blank", 2),
        ("15-ply-header/ushort-list", 2),
    ] {
        let (loaded, _) = load(&format!("{name}.ply"));
        assert_eq!(loaded.scene.info().triangles, expected, "{name}");
    }
    let (loaded, _) = load("15-ply-header/nan-lower.ply");
    assert_eq!(loaded.scene.info().points, 3);

    let (loaded, pose) = load("13-ply-face-colours/face.ply");
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    let (red, blue) = ([1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]);
    for triangle in &pose.geometry.triangles {
        let corners = triangle.map(|v| v as usize);
        let is_right =
            corners.iter().any(|&v| f64::from(pose.geometry.positions[v][0]) + pose.geometry.origin[0] > 1.5);
        let expected = if is_right { blue } else { red };
        assert!(corners.iter().all(|&v| pose.geometry.streams.colors[v] == expected));
    }
    let (loaded, pose) = load("13-ply-face-colours/alpha.ply");
    let material = &loaded.scene.materials[pose.geometry.draws[0].material as usize];
    assert_eq!(material.alpha_mode, AlphaMode::Blend);
    let alphas: Vec<f32> = pose.geometry.streams.colors.iter().map(|color| color[3]).collect();
    assert!(alphas.contains(&0.0) && alphas.contains(&1.0), "{alphas:?}");
}
