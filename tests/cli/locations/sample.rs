//! Sampling at locations that the user gives.

use super::{linear, places};
use crate::command::{asset, files, gpc};
use glam::DVec3;
use std::fmt::Write;

/// Names of the columns, and rows, of a CSV file.
fn table(text: &str) -> (Vec<&str>, Vec<Vec<f64>>) {
    let mut lines = text.lines();
    let names = lines.next().unwrap().split(',').collect();
    let rows = lines.map(|line| line.split(',').map(|v| v.parse().unwrap()).collect());
    (names, rows.collect())
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
    let render = ["render", &scene, "-o", "r.exr", "--aa", "none", "--tonemap", "none"];
    gpc(folder.path(), &[&render[..], &options].concat()).ok();
    for out in ["a.csv", "a.npy"] {
        let sample = ["sample", &scene, "--samples", "s.csv", "-o", out];
        gpc(folder.path(), &[&sample[..], &options].concat()).ok();
    }
    // Arranged by row and column, the samples form the image.
    let sample = ["sample", &scene, "--samples", "s.csv", "-o", "a.exr", "--tonemap", "none"];
    gpc(folder.path(), &[&sample[..], &options].concat()).ok();
    let compare = ["compare", "r.exr", "a.exr", "--max-rmse", "0.02"];
    gpc(folder.path(), &compare).ok();
    let text = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    let (names, rows) = table(&text);
    assert_eq!(names, ["u", "v", "r", "g", "b", "a", "depth", "id", "hit", "nx", "ny", "nz"]);
    let (_, pixels) = linear(&folder.path().join("r.exr"));
    let mut different = 0;
    for ((_, place), (row, pixel)) in places(size).zip(rows.iter().zip(&pixels)) {
        assert_eq!(row[..2], [place.x, place.y]);
        let near = row[2..6].iter().zip(pixel).all(|(a, b)| (a - f64::from(*b)).abs() < 2e-3);
        different += usize::from(!near);
        let hit = row[8] == 1.0;
        assert_eq!(hit, row[7] > 0.0 && row[6] > 0.0);
        let normal = DVec3::new(row[9], row[10], row[11]).length();
        assert!((normal - f64::from(u8::from(hit))).abs() < 1e-3);
    }
    assert!(rows.iter().filter(|row| row[8] == 1.0).count() > 2000);
    // The rasterizer may put places within 2^-7 pixel of an edge on the other side.
    assert!(different < 20, "{different}");

    let npy = std::fs::read(folder.path().join("a.npy")).unwrap();
    let (numbers, _) = npy[npy.len() - rows.len() * 96..].as_chunks::<8>();
    for (number, expected) in numbers.iter().zip(rows.iter().flatten()) {
        let number = f64::from_le_bytes(*number);
        assert!((number - expected).abs() <= 1e-6 * expected.abs(), "{number} {expected}");
    }
}

#[test]
fn antialiased_samples_are_means_of_their_surroundings() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("spheres.glb");
    // Locations on a line across the picture, without rows and columns.
    let mut csv = "u,v".to_owned();
    for i in 0..200 {
        write!(csv, "\n{},24.3", f64::from(i) * 0.32).unwrap();
    }
    std::fs::write(folder.path().join("s.csv"), csv).unwrap();
    let sample = ["sample", &scene, "--samples", "s.csv", "-o", "-", "--size", "64x48", "--azimuth", "20"];
    let points = String::from_utf8(gpc(folder.path(), &sample).ok().stdout).unwrap();
    let aa = ["--aa", "superpixel", "--supersamples", "64"];
    let means = gpc(folder.path(), &[&sample[..], &aa].concat()).ok().stdout;
    let means = String::from_utf8(means).unwrap();
    let alphas = |text: &str| table(text).1.into_iter().map(|row| row[5]).collect::<Vec<_>>();
    assert!(alphas(&points).iter().all(|a| *a == 0.0 || *a == 1.0));
    let [points, means] = [&points, &means].map(|text| alphas(text));
    let partial = means.iter().filter(|a| **a > 1e-4 && **a < 0.9999);
    let partial = partial.count();
    assert!(partial > 2, "silhouettes are crossed");
    let equal = points.iter().zip(&means).filter(|(a, b)| (*a - *b).abs() <= 1e-4);
    let equal = equal.count();
    assert!(equal > 150 && equal + partial == 200);
}

#[test]
fn files_of_samples_that_are_wrong_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("spheres.glb");
    let sample = |text: &str| {
        std::fs::write(folder.path().join("s.csv"), text).unwrap();
        gpc(folder.path(), &["sample", &scene, "--samples", "s.csv", "-o", "a.csv"])
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
    gpc(folder.path(), &out).exits(2).says(&[".csv or .npy", ".png"]);
    let image = ["sample", &scene, "--samples", "s.csv", "-o", "a.png"];
    std::fs::write(folder.path().join("s.csv"), "u,v\n1,2\n").unwrap();
    gpc(folder.path(), &image).exits(2).says(&["u,v,row,col"]);
    let many = ["--supersamples", "4"];
    gpc(folder.path(), &[&image[..], &many].concat()).exits(2).says(&["none"]);
    assert_eq!(files(folder.path()), ["s.csv"]);
}
