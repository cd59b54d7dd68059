//! Frames of projectors, and their sum on the wall.

use super::places;
use crate::command::{asset, files, gpc};
use glam::{DMat3, DVec2};
use gpc::camera::LocationMap;
use gpc::camera::projector::{Correspondence, Homography, Projector, blend_weights};
use gpc::color::srgb;
use gpc::output::{self, DecodedImage};
use gpc::resample::Photograph;
use std::fmt::Write;

const FRAME: [u32; 2] = [150, 140];

/// Homography with keystone from a projector's pixels to the picture.
fn keystone(x: f64, tilt: f64) -> DMat3 {
    DMat3::from_translation(DVec2::new(x, -3.0))
        * DMat3::from_cols_array(&[0.6, 0.02, tilt, -0.02, 0.72, 0.0, 0.0, 0.0, 1.0])
}

fn pairs(matrix: DMat3) -> Vec<Correspondence> {
    let places = (0..36).map(|i| DVec2::new(f64::from(i % 6) * 29.0 + 2.0, f64::from(i / 6) * 27.0 + 2.0));
    let pair = |place: DVec2| {
        let p = matrix * place.extend(1.0);
        Correspondence { place: place.to_array(), location: (p.truncate() / p.z).to_array() }
    };
    places.map(pair).collect()
}

/// Location that a place on a projector with a bent lens lights.
fn bent(place: DVec2) -> DVec2 {
    let way = place - DVec2::new(75.0, 70.0);
    let p = keystone(78.0, -0.0004) * (place + way * (0.04 * way.length_squared() / 1e4)).extend(1.0);
    p.truncate() / p.z
}

/// Light of several frames on the wall, at a location of the picture.
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
    // One projector is planar, with noise and two outliers; the other is bent, with a dense map.
    let mut csv = "x,y,u,v".to_owned();
    for (i, pair) in pairs(keystone(-4.0, 0.0005)).iter().enumerate() {
        let noise = 0.05 * (f64::from(i as u32) * 2.4).sin();
        let wrong = if i % 17 == 5 { 40.0 } else { 0.0 };
        let ([x, y], [u, v]) = (pair.place, pair.location);
        write!(csv, "\n{x},{y},{},{}", u + noise, v - noise + wrong).unwrap();
    }
    std::fs::write(folder.path().join("left.csv"), csv).unwrap();
    let locations: Vec<_> = places(FRAME).map(|(_, place)| bent(place)).collect();
    let map: Vec<_> = locations.iter().map(|at| [at.x as f32, at.y as f32, 0.0, 1.0]).collect();
    let picture = output::Picture::new(FRAME, &map).unwrap();
    let exr = output::encode(output::Format::Exr, &picture, &[]).unwrap();
    std::fs::write(folder.path().join("right.exr"), exr).unwrap();

    let view = ["--background", "0.2,0.4,0.7", "--samples", "64"];
    let project = ["project", &scene, "-o", "f{projector}.16.png", "--size", "160x100"];
    let rig = ["--projector", "left.csv", "--projector", "right.exr", "--projector-size", "150x140"];
    gpc(folder.path(), &[&project[..], &rig, &view].concat()).ok().says(&["34 of 36"]);
    let render = |name: &str, size: &str, aa: &str| {
        let render = ["render", &scene, "-o", name, "--size", size, "--aa", aa];
        gpc(folder.path(), &[&render[..], &view].concat()).ok();
    };
    render("picture.16.png", "160x100", "superpixel");
    render("ideal.16.png", "480x300", "ssaa");
    let read = |name: &str| Photograph::from(&output::read(&folder.path().join(name)).unwrap());

    let truth = vec![
        Projector::planar(FRAME, Homography::fit(&pairs(keystone(-4.0, 0.0005))).unwrap()).unwrap(),
        Projector::dense(FRAME, locations.iter().map(|at| at.to_array()).collect()).unwrap(),
    ];
    let frames = vec![read("f0.16.png"), read("f1.16.png")];
    assert_eq!(frames[0].size(), FRAME);
    // The usual method, for comparison, is to warp an ordinary image.
    let ordinary = read("picture.16.png");
    let warped: Vec<_> = truth
        .iter()
        .zip(blend_weights(&truth))
        .map(|(projector, weights)| {
            let h = DVec2::X;
            let look = |place: DVec2| match projector.map() {
                gpc::camera::projector::ProjectorMap::Planar(map) => (map.location(place), map.jacobian(place)),
                gpc::camera::projector::ProjectorMap::Dense(_) => {
                    let slope = |step: DVec2| 0.5 * (bent(place + step) - bent(place - step));
                    (bent(place), glam::DMat2::from_cols(slope(h), slope(h.perp())))
                }
            };
            let colors = ordinary.resample(FRAME, look);
            let pixels = colors.iter().zip(weights).map(|(color, weight)| {
                let [r, g, b] = [color[0], color[1], color[2]].map(|v| srgb::encode(f64::from(v * weight)) as f32);
                [r, g, b, 1.0]
            });
            Photograph::from(&DecodedImage { size: FRAME, pixels: pixels.collect() })
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
    println!("rmse of frames that were sampled {sampled:.4}, of frames that were warped {warped:.4}");
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
    project("x,y,u,v\n0,0,0,0\n", &[]).exits(1).says(&["p.csv", "at least 4"]);
    project("u,v\n0,0\n", &[]).exits(1).says(&["x,y,u,v"]);
    project(line, &["--projector", "p.csv"]).exits(2).says(&["{projector}"]);
    project(line, &["--tolerance", "0"]).exits(2);
    assert_eq!(files(folder.path()), ["p.csv"]);
}
