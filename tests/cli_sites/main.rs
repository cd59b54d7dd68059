//! `gpc zoom`, `sample`, `panorama` and `project` of scenes: what they show, held against ordinary images, closed form
//! and each other.

#[allow(dead_code)]
mod cli_support;
mod scene_builder;

use cli_support::{asset, files, gpc};
use glam::{DMat3, DVec2, DVec3};
use gpc::camera::LocationMap;
use gpc::camera::panorama::{Panorama, PanoramaProjection};
use gpc::camera::projector::{Correspondence, Homography, Projector, blend_weights};
use gpc::output::{self, DecodedImage};
use gpc::reference::srgb;
use gpc::resample::Photograph;
use scene_builder::Builder;
use serde_json::json;
use std::fmt::Write;
use std::path::Path;

/// Columns by name, and rows, of a CSV file.
fn table(text: &str) -> (Vec<&str>, Vec<Vec<f64>>) {
    let mut lines = text.lines();
    let names = lines.next().unwrap().split(',').collect();
    let rows = lines.map(|line| line.split(',').map(|v| v.parse().unwrap()).collect());
    (names, rows.collect())
}

fn linear(path: &Path) -> ([u32; 2], Vec<[f32; 4]>) {
    output::decode_linear(&std::fs::read(path).unwrap(), "image").unwrap()
}

fn places(size: [u32; 2]) -> impl Iterator<Item = (usize, DVec2)> {
    (0..size[0] * size[1]).map(move |i| {
        let place = DVec2::new(f64::from(i % size[0]) + 0.5, f64::from(i / size[0]) + 0.5);
        (i as usize, place)
    })
}

#[test]
fn a_zoomed_region_is_the_ordinary_image_of_what_it_shows() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("spheres.glb");
    for aa in ["none", "superpixel"] {
        let zoom = [
            "zoom", &scene, "-o", "z.exr", "--size", "120x90", "--aa", aa,
        ];
        let regions = [
            "--center",
            "60,45",
            "--radius",
            "20,15",
            "--shape",
            "rectangle",
        ];
        let rest = [
            "--multiplicity",
            "0.25",
            "--steps",
            "--transition",
            "smooth",
        ];
        gpc(folder.path(), &[&zoom[..], &regions, &rest].concat()).ok();
        let read = |name: &str| Photograph::from(&output::read(&folder.path().join(name)).unwrap());
        let [zoomed, direct, original] = ["z.exr", "z.direct.png", "z.original.png"].map(read);
        assert_eq!(direct.size(), [40, 30]);
        let at =
            |image: &Photograph, x: u32, y: u32| image.pixels()[(y * image.size()[0] + x) as usize];
        let differs = |a: [f32; 4], b: [f32; 4]| {
            // An EXR holds light that is not tone-mapped, so that only what is dark can be compared with a PNG.
            let dark = |color: [f32; 4]| color.iter().take(3).all(|v| *v < 0.5);
            dark(a) && dark(b) && a.iter().zip(b).any(|(a, b)| (a - b).abs() > 0.01)
        };
        // Within the border, where detection has the same neighbours.
        let inside = (1..29).flat_map(|y| (1..39).map(move |x| (x, y)));
        let wrong = inside
            .clone()
            .filter(|(x, y)| differs(at(&zoomed, 40 + x, 30 + y), at(&direct, *x, *y)));
        // Locations agree but for rounding, which may move a sample over an edge.
        let wrong = wrong.count();
        assert!(wrong <= 3, "{aa}: {wrong}");
        let moved = inside
            .filter(|(x, y)| differs(at(&zoomed, 40 + x, 30 + y), at(&original, 40 + x, 30 + y)));
        assert!(
            moved.count() > 50,
            "the region shows something else than the original"
        );
    }
}

#[test]
fn unzooming_comes_close_to_a_direct_render() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("letters.glb");
    let zoom = [
        "zoom",
        &scene,
        "-o",
        "z.png",
        "--size",
        "240x180",
        "--background",
        "0.5,0.5,0.5",
    ];
    let regions = [
        "--center",
        "120,90",
        "--radius",
        "24",
        "--multiplicity",
        "0.4",
        "--steps",
    ];
    gpc(folder.path(), &[&zoom[..], &regions].concat()).ok();
    let rmse = |image: &str, reference: &str, whole: &[&str]| {
        let unzoom = ["unzoom", image, "-o", "u.png", "--reference", reference];
        let run = gpc(folder.path(), &[&unzoom[..], whole].concat()).ok();
        let said = String::from_utf8(run.stdout).unwrap();
        said.split_whitespace()
            .nth(1)
            .unwrap()
            .parse::<f64>()
            .unwrap()
    };
    let region = rmse("z.png", "z.direct.png", &[]);
    // The same view of the ordinary image, enlarged, is what the zoom is better than.
    let record = output::find_text(
        &std::fs::read(folder.path().join("z.png")).unwrap(),
        "gpc zoom",
    );
    let original = output::read(&folder.path().join("z.original.png")).unwrap();
    let enlarged = Photograph::from(&original).resample([48, 48], |place| {
        let step = glam::DMat2::from_diagonal(DVec2::splat(0.4));
        (DVec2::new(110.4, 80.4) + 0.4 * place, step)
    });
    let enlarged = DecodedImage::from(&output::Picture::new([48, 48], &enlarged).unwrap());
    let direct = output::read(&folder.path().join("z.direct.png")).unwrap();
    let blurred = gpc::compare::compare(&direct, &enlarged).unwrap().rmse;
    assert!(record.is_some());
    assert!(region < 0.5 * blurred, "{region} against {blurred}");
    assert!(rmse("z.png", "z.original.png", &["--whole"]) < 0.1);
}

#[test]
fn samples_at_the_centres_of_pixels_are_the_pixels() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("spheres.glb");
    let size = [64, 48];
    let options = ["--size", "64x48"];
    let mut csv = "u,v,row,col".to_owned();
    for (i, place) in places(size) {
        write!(csv, "\n{},{},{},{}", place.x, place.y, i / 64, i % 64).unwrap();
    }
    std::fs::write(folder.path().join("s.csv"), csv).unwrap();
    let render = [
        "render",
        &scene,
        "-o",
        "r.exr",
        "--aa",
        "none",
        "--tonemap",
        "none",
    ];
    gpc(folder.path(), &[&render[..], &options].concat()).ok();
    for out in ["a.csv", "a.npy"] {
        let sample = ["sample", &scene, "--samples", "s.csv", "-o", out];
        gpc(folder.path(), &[&sample[..], &options].concat()).ok();
    }
    // By row and column the samples are the image.
    let sample = [
        "sample",
        &scene,
        "--samples",
        "s.csv",
        "-o",
        "a.exr",
        "--tonemap",
        "none",
    ];
    gpc(folder.path(), &[&sample[..], &options].concat()).ok();
    let compare = ["compare", "r.exr", "a.exr", "--max-rmse", "0.02"];
    gpc(folder.path(), &compare).ok();
    let text = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    let (names, rows) = table(&text);
    assert_eq!(
        names,
        [
            "u", "v", "r", "g", "b", "a", "depth", "id", "hit", "nx", "ny", "nz"
        ]
    );
    let (_, pixels) = linear(&folder.path().join("r.exr"));
    let mut different = 0;
    for ((_, place), (row, pixel)) in places(size).zip(rows.iter().zip(&pixels)) {
        assert_eq!(row[..2], [place.x, place.y]);
        let near = row[2..6]
            .iter()
            .zip(pixel)
            .all(|(a, b)| (a - f64::from(*b)).abs() < 2e-3);
        different += usize::from(!near);
        let hit = row[8] == 1.0;
        assert_eq!(hit, row[7] > 0.0 && row[6] > 0.0);
        let normal = DVec3::new(row[9], row[10], row[11]).length();
        assert!((normal - f64::from(u8::from(hit))).abs() < 1e-3);
    }
    assert!(rows.iter().filter(|row| row[8] == 1.0).count() > 2000);
    // The rasterizer may put what is within 2^-7 pixel of an edge on the other side.
    assert!(different < 20, "{different}");

    let npy = std::fs::read(folder.path().join("a.npy")).unwrap();
    let (numbers, _) = npy[npy.len() - rows.len() * 96..].as_chunks::<8>();
    for (number, expected) in numbers.iter().zip(rows.iter().flatten()) {
        let number = f64::from_le_bytes(*number);
        assert!(
            (number - expected).abs() <= 1e-6 * expected.abs(),
            "{number} {expected}"
        );
    }
}

#[test]
fn antialiased_samples_are_means_of_their_surroundings() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("spheres.glb");
    // A line across the picture, without rows and columns.
    let mut csv = "u,v".to_owned();
    for i in 0..200 {
        write!(csv, "\n{},24.3", f64::from(i) * 0.32).unwrap();
    }
    std::fs::write(folder.path().join("s.csv"), csv).unwrap();
    let sample = [
        "sample",
        &scene,
        "--samples",
        "s.csv",
        "-o",
        "-",
        "--size",
        "64x48",
        "--azimuth",
        "20",
    ];
    let points = String::from_utf8(gpc(folder.path(), &sample).ok().stdout).unwrap();
    let aa = ["--aa", "superpixel", "--supersamples", "64"];
    let means = gpc(folder.path(), &[&sample[..], &aa].concat()).ok().stdout;
    let means = String::from_utf8(means).unwrap();
    let alphas = |text: &str| {
        table(text)
            .1
            .into_iter()
            .map(|row| row[5])
            .collect::<Vec<_>>()
    };
    assert!(alphas(&points).iter().all(|a| *a == 0.0 || *a == 1.0));
    let [points, means] = [&points, &means].map(|text| alphas(text));
    let partial = means.iter().filter(|a| **a > 1e-4 && **a < 0.9999);
    let partial = partial.count();
    assert!(partial > 2, "silhouettes are crossed");
    let equal = points
        .iter()
        .zip(&means)
        .filter(|(a, b)| (*a - *b).abs() <= 1e-4);
    let equal = equal.count();
    assert!(equal > 150 && equal + partial == 200);
}

/// A sphere of radius 5 around the origin, seen from inside, whose colour is its direction.
fn sphere() -> Vec<u8> {
    const AROUND: u32 = 96;
    const DOWN: u32 = 48;
    let mut builder = Builder::new();
    let (mut positions, mut colors, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    for j in 0..=DOWN {
        for i in 0..=AROUND {
            let turn = f64::from(i) / f64::from(AROUND) * std::f64::consts::TAU;
            let fall = f64::from(j) / f64::from(DOWN) * std::f64::consts::PI;
            let at = DVec3::new(
                turn.sin() * fall.sin(),
                fall.cos(),
                -turn.cos() * fall.sin(),
            );
            positions.push((5.0 * at).as_vec3().to_array());
            colors.push((0.5 * at + DVec3::splat(0.5)).as_vec3().to_array());
            if i < AROUND && j < DOWN {
                let corner = j * (AROUND + 1) + i;
                let below = corner + AROUND + 1;
                indices.extend(
                    [corner, below, corner + 1, corner + 1, below, below + 1].map(|i| i as u16),
                );
            }
        }
    }
    let attributes = json!({
        "POSITION": builder.floats(&positions), "COLOR_0": builder.floats(&colors),
    });
    let indices = builder.indices(&indices);
    let material = builder.push(
        "materials",
        json!({"doubleSided": true, "extensions": {"KHR_materials_unlit": {}}}),
    );
    builder.json["extensionsUsed"] = json!(["KHR_materials_unlit"]);
    let primitive = json!({"attributes": attributes, "indices": indices, "material": material});
    let node = builder.node_with(primitive, json!({}));
    builder.push("scenes", json!({"nodes": [node]}));
    builder.json["scene"] = json!(0);
    builder.glb()
}

#[test]
fn panoramas_show_every_direction_without_a_seam() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("sphere.glb"), sphere()).unwrap();
    for (name, projection, fov, size) in [
        (
            "equirectangular",
            PanoramaProjection::Equirectangular,
            360.0,
            [160, 80],
        ),
        (
            "cylindrical",
            PanoramaProjection::Cylindrical,
            360.0,
            [160, 100],
        ),
        ("fisheye", PanoramaProjection::Fisheye, 300.0, [100, 90]),
        ("cubemap", PanoramaProjection::Cubemap, 360.0, [120, 90]),
    ] {
        let (fov_text, size_text) = (fov.to_string(), format!("{}x{}", size[0], size[1]));
        let options = [
            "--projection",
            name,
            "--fov",
            &fov_text,
            "--size",
            &size_text,
        ];
        let command = ["panorama", "sphere.glb", "-o", "p.exr"];
        let view = ["--eye", "0,0,0", "--target", "0,0,-1", "--samples", "16"];
        gpc(folder.path(), &[&command[..], &options, &view].concat()).ok();
        let (found, pixels) = linear(&folder.path().join("p.exr"));
        let panorama = Panorama::new(projection, fov, size).unwrap();
        assert_eq!(found, panorama.size());
        for (index, place) in places(found) {
            let [r, g, b, a] = pixels[index].map(f64::from);
            let Some(expected) = panorama.look(place) else {
                assert_eq!(a, 0.0, "{name} {place}");
                continue;
            };
            let seen = DVec3::new(r, g, b) * 2.0 - DVec3::ONE;
            // Pixels see several facets, each shaded once; a seam would be off by a pixel, a twentieth at the least.
            assert!(
                seen.distance(expected) < 8e-3,
                "{name} {place}: {seen} {expected}"
            );
            assert!(a > 0.9999);
        }
    }
}

#[test]
fn an_orthographic_camera_sees_no_panorama() {
    let folder = tempfile::tempdir().unwrap();
    let letters = asset("letters.glb");
    let command = ["panorama", &letters, "-o", "p.png", "--projection"];
    let orthographic = ["fisheye", "--camera", "front"];
    gpc(folder.path(), &[&command[..], &orthographic].concat())
        .exits(2)
        .says(&["orthographic"]);
    let wide = ["fisheye", "--fov", "361"];
    gpc(folder.path(), &[&command[..], &wide].concat())
        .exits(2)
        .says(&["360"]);
    let high = ["equirectangular", "--size", "100x100"];
    gpc(folder.path(), &[&command[..], &high].concat())
        .exits(2)
        .says(&["180"]);
    gpc(folder.path(), &[&command[..], &["flat"]].concat())
        .exits(2)
        .says(&["cubemap"]);
    assert!(files(folder.path()).is_empty());
}

#[test]
fn files_of_samples_that_are_wrong_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("spheres.glb");
    let sample = |text: &str| {
        std::fs::write(folder.path().join("s.csv"), text).unwrap();
        gpc(
            folder.path(),
            &["sample", &scene, "--samples", "s.csv", "-o", "a.csv"],
        )
    };
    for (text, expected) in [
        ("x,y\n1,2\n", "u,v or u,v,row,col"),
        ("u,v\n", "at least one"),
        ("u,v\n1,2\nnan,2\n", "location 1"),
        ("u,v\n1,inf\n", "location 0"),
        ("u,v\n1,2\n3,4\n5e6,0\n", "location 2"),
        ("u,v\n1,2,3\n", "line 2"),
        ("u,v,row,col\n1,2,0.5,0\n", "whole"),
        ("u,v,row,col\n1,2,70000,70000\n", "cells"),
    ] {
        sample(text).exits(1).says(&["s.csv", expected]);
    }
    let out = ["sample", &scene, "--samples", "s.csv", "-o", "a.txt"];
    gpc(folder.path(), &out)
        .exits(2)
        .says(&[".csv or .npy", ".png"]);
    let image = ["sample", &scene, "--samples", "s.csv", "-o", "a.png"];
    std::fs::write(folder.path().join("s.csv"), "u,v\n1,2\n").unwrap();
    gpc(folder.path(), &image).exits(2).says(&["u,v,row,col"]);
    let many = ["--supersamples", "4"];
    gpc(folder.path(), &[&image[..], &many].concat())
        .exits(2)
        .says(&["none"]);
    assert_eq!(files(folder.path()), ["s.csv"]);
}

const FRAME: [u32; 2] = [150, 140];

/// A keystone from a projector's pixels to the picture.
fn keystone(x: f64, tilt: f64) -> DMat3 {
    DMat3::from_translation(DVec2::new(x, -3.0))
        * DMat3::from_cols_array(&[0.6, 0.02, tilt, -0.02, 0.72, 0.0, 0.0, 0.0, 1.0])
}

fn pairs(matrix: DMat3) -> Vec<Correspondence> {
    let places =
        (0..36).map(|i| DVec2::new(f64::from(i % 6) * 29.0 + 2.0, f64::from(i / 6) * 27.0 + 2.0));
    let pair = |place: DVec2| {
        let p = matrix * place.extend(1.0);
        Correspondence {
            place: place.to_array(),
            location: (p.truncate() / p.z).to_array(),
        }
    };
    places.map(pair).collect()
}

/// The location of a projector with a bent lens.
fn bent(place: DVec2) -> DVec2 {
    let way = place - DVec2::new(75.0, 70.0);
    let p =
        keystone(78.0, -0.0004) * (place + way * (0.04 * way.length_squared() / 1e4)).extend(1.0);
    p.truncate() / p.z
}

/// Light of several frames on the wall at a location of the picture.
fn landed(projectors: &[Projector], frames: &[Photograph], location: DVec2) -> Option<[f64; 3]> {
    let mut sum = [0.0; 3];
    let mut lit = false;
    for (projector, frame) in projectors.iter().zip(frames) {
        if let Some(place) = projector.place(location) {
            lit = true;
            let light = frame.sample(place, glam::DMat2::IDENTITY);
            for (sum, light) in sum.iter_mut().zip(light) {
                *sum += f64::from(light);
            }
        }
    }
    lit.then_some(sum)
}

#[test]
fn projected_frames_add_up_to_the_picture_better_than_warped_ones() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("fence.glb");
    // A planar projector with some noise and two outliers, and a bent one with a dense map.
    let mut csv = "x,y,u,v".to_owned();
    for (i, pair) in pairs(keystone(-4.0, 0.0005)).iter().enumerate() {
        let noise = 0.05 * (f64::from(i as u32) * 2.4).sin();
        let wrong = if i % 17 == 5 { 40.0 } else { 0.0 };
        let ([x, y], [u, v]) = (pair.place, pair.location);
        write!(csv, "\n{x},{y},{},{}", u + noise, v - noise + wrong).unwrap();
    }
    std::fs::write(folder.path().join("left.csv"), csv).unwrap();
    let locations: Vec<_> = places(FRAME).map(|(_, place)| bent(place)).collect();
    let map: Vec<_> = locations
        .iter()
        .map(|at| [at.x as f32, at.y as f32, 0.0, 1.0])
        .collect();
    let picture = output::Picture::new(FRAME, &map).unwrap();
    let exr = output::encode(output::Format::Exr, &picture, &[]).unwrap();
    std::fs::write(folder.path().join("right.exr"), exr).unwrap();

    let view = ["--background", "0.2,0.4,0.7", "--samples", "64"];
    let project = [
        "project",
        &scene,
        "-o",
        "f{projector}.16.png",
        "--size",
        "160x100",
    ];
    let rig = [
        "--projector",
        "left.csv",
        "--projector",
        "right.exr",
        "--projector-size",
        "150x140",
    ];
    gpc(folder.path(), &[&project[..], &rig, &view].concat())
        .ok()
        .says(&["34 of 36"]);
    let render = |name: &str, size: &str, aa: &str| {
        let render = ["render", &scene, "-o", name, "--size", size, "--aa", aa];
        gpc(folder.path(), &[&render[..], &view].concat()).ok();
    };
    render("picture.16.png", "160x100", "superpixel");
    render("ideal.16.png", "480x300", "ssaa");
    let read = |name: &str| Photograph::from(&output::read(&folder.path().join(name)).unwrap());

    let truth = vec![
        Projector::planar(
            FRAME,
            Homography::fit(&pairs(keystone(-4.0, 0.0005))).unwrap(),
        )
        .unwrap(),
        Projector::dense(FRAME, locations.iter().map(|at| at.to_array()).collect()).unwrap(),
    ];
    let frames = vec![read("f0.16.png"), read("f1.16.png")];
    assert_eq!(frames[0].size(), FRAME);
    // The usual way: an ordinary image, warped.
    let ordinary = read("picture.16.png");
    let warped: Vec<_> = truth
        .iter()
        .zip(blend_weights(&truth))
        .map(|(projector, weights)| {
            let h = DVec2::X;
            let look = |place: DVec2| match projector.map() {
                gpc::camera::projector::ProjectorMap::Planar(map) => {
                    (map.location(place), map.jacobian(place))
                }
                gpc::camera::projector::ProjectorMap::Dense(_) => {
                    let slope = |step: DVec2| 0.5 * (bent(place + step) - bent(place - step));
                    (
                        bent(place),
                        glam::DMat2::from_cols(slope(h), slope(h.perp())),
                    )
                }
            };
            let colors = ordinary.resample(FRAME, look);
            let pixels = colors.iter().zip(weights).map(|(color, weight)| {
                let [r, g, b] = [color[0], color[1], color[2]]
                    .map(|v| srgb::encode(f64::from(v * weight)) as f32);
                [r, g, b, 1.0]
            });
            Photograph::from(&DecodedImage {
                size: FRAME,
                pixels: pixels.collect(),
            })
        })
        .collect();
    let ideal = read("ideal.16.png");
    let rmse = |frames: &[Photograph]| {
        let (mut sum, mut count) = (0.0, 0);
        for y in 30..270 {
            for x in 30..450 {
                let location = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) / 3.0;
                let Some(light) = landed(&truth, frames, location) else {
                    continue;
                };
                let expected = ideal.pixels()[(y * 480 + x) as usize];
                for (light, expected) in light.iter().zip(expected) {
                    sum += (srgb::encode(*light) - srgb::encode(f64::from(expected))).powi(2);
                    count += 1;
                }
            }
        }
        assert!(count > 200_000);
        (sum / f64::from(count)).sqrt()
    };
    let (sampled, warped) = (rmse(&frames), rmse(&warped));
    println!(
        "rmse of frames that were sampled {sampled:.4}, of frames that were warped {warped:.4}"
    );
    assert!(sampled < 0.9 * warped, "{sampled} against {warped}");
}

#[test]
fn projectors_that_can_not_be_calibrated_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("spheres.glb");
    let project = |csv: &str, options: &[&str]| {
        std::fs::write(folder.path().join("p.csv"), csv).unwrap();
        let command = ["project", &scene, "-o", "f.png", "--projector", "p.csv"];
        gpc(folder.path(), &[&command[..], options].concat())
    };
    let line = "x,y,u,v\n0,0,0,0\n1,1,2,2\n2,2,4,4\n3,3,6,6\n9,9,1,1\n";
    project(line, &[]).exits(1).says(&["p.csv", "on one line"]);
    project("x,y,u,v\n0,0,0,0\n", &[])
        .exits(1)
        .says(&["p.csv", "at least 4"]);
    project("u,v\n0,0\n", &[]).exits(1).says(&["x,y,u,v"]);
    project(line, &["--projector", "p.csv"])
        .exits(2)
        .says(&["{projector}"]);
    project(line, &["--tolerance", "0"]).exits(2);
    assert_eq!(files(folder.path()), ["p.csv"]);
}
