//! `--shadows exact`, from a file with a light to images.

use crate::command::{asset, gpc};
use crate::shadowed_floor::shadowed_floor;
use gpc::output::decode_linear;
use std::path::Path;

const SIZE: [usize; 2] = [96, 64];
const VIEW: [&str; 8] = ["--size", "96x64", "--eye", "0,3,5", "--target", "0,0,0", "--fov", "45"];

/// A file of the scene.
fn scene(folder: &Path) -> String {
    let path = folder.join("sun.glb");
    std::fs::write(&path, shadowed_floor()).unwrap();
    path.to_str().unwrap().to_owned()
}

/// Green light of the pixel that shows a place `[x, z]` of the plane y = 0, in the view [`VIEW`].
fn at(image: &[[f32; 4]], [x, z]: [f64; 2]) -> f32 {
    // The camera looks along (0, -3, -5) / sqrt(34).
    let norm = 34.0_f64.sqrt();
    let (down, back) = (3.0, 5.0 - z);
    let depth = (3.0 * down + 5.0 * back) / norm;
    let up = (3.0 * back - 5.0 * down) / norm;
    let pixels = SIZE[1] as f64 / 2.0 / 22.5_f64.to_radians().tan();
    let column = SIZE[0] as f64 / 2.0 + x / depth * pixels;
    let row = SIZE[1] as f64 / 2.0 - up / depth * pixels;
    image[row as usize * SIZE[0] + column as usize][1]
}

#[test]
fn a_triangle_casts_its_shadow() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let render = |name: &str, options: &[&str]| {
        let command = [&["render", &scene, "-o", name], &VIEW[..], options].concat();
        gpc(folder.path(), &command).ok();
        let bytes = std::fs::read(folder.path().join(name)).unwrap();
        decode_linear(&bytes, name).unwrap().1
    };
    let open = render("open.exr", &[]);
    for method in ["superpixel", "none", "msaa", "ssaa"] {
        let shadowed = render("shadowed.exr", &["--shadows", "exact", "--aa", method]);
        // These places are beside the triangle's shadow, or under its nearer side, where the triangle does not hide
        // the floor.
        for beside in [[2.0, 0.0], [-2.0, 0.5], [0.0, 2.0], [1.2, 0.3]] {
            assert!((at(&open, beside) - at(&shadowed, beside)).abs() < 0.01);
            assert!(at(&shadowed, beside) > 0.1);
        }
        for under in [[0.0, 0.35], [-0.5, 0.35], [0.5, 0.3]] {
            assert!(at(&shadowed, under) < 0.3 * at(&open, under), "{under:?} {method}");
        }
    }
}

#[test]
fn a_region_has_the_shadows_of_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let render = |name: &str, options: &[&str]| {
        let shadows = ["--shadows", "exact"];
        let command = [&["render", &scene, "-o", name], &VIEW[..], &shadows, options].concat();
        gpc(folder.path(), &command).ok();
        let bytes = std::fs::read(folder.path().join(name)).unwrap();
        decode_linear(&bytes, name).unwrap().1
    };
    let whole = render("whole.exr", &[]);
    let part = render("part.exr", &["--region", "30,25,40x20"]);
    for (row, colors) in part.chunks_exact(40).enumerate() {
        let first = (25 + row) * SIZE[0] + 30;
        assert_eq!(colors, &whole[first..first + 40], "row {row}");
    }
}

#[test]
fn other_commands_cast_shadows_and_what_can_not_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(folder.path());
    let options = ["--shadows", "exact", "--eye", "0,0.5,3", "--target", "0,0,0"];
    let panorama = |name: &str, options: &[&str]| {
        let command = ["panorama", &scene, "-o", name, "--projection", "fisheye", "--size", "32x32"];
        gpc(folder.path(), &[&command, options].concat()).ok();
        let bytes = std::fs::read(folder.path().join(name)).unwrap();
        let (_, colors) = decode_linear(&bytes, name).unwrap();
        colors.iter().map(|color| f64::from(color[1])).sum::<f64>()
    };
    let [open, shadowed] = [panorama("a.exr", &options[2..]), panorama("b.exr", &options)];
    assert!(shadowed < open - 0.25, "{shadowed} of {open}");

    let msaa = ["panorama", &scene, "-o", "c.png", "--projection", "fisheye", "--shadows", "exact", "--aa", "msaa"];
    let run = gpc(folder.path(), &msaa);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("msaa"), "{}", run.stderr);

    let spheres = asset("spheres.glb");
    let unlit = ["render", &spheres, "-o", "d.png", "--shadows", "exact", "--size", "32x32"];
    let run = gpc(folder.path(), &unlit);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stderr.contains("no lights"), "{}", run.stderr);
}
