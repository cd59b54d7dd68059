//! Panoramas, compared with the directions in which their pixels look.

use super::{linear, places};
use crate::command::{asset, files, gpc};
use crate::scene_builder::Builder;
use glam::DVec3;
use gpc::camera::panorama::{Panorama, PanoramaProjection};
use serde_json::json;

/// A sphere of radius 5 around the origin, seen from inside, whose colour at each point is the direction of the point.
fn sphere() -> Vec<u8> {
    const AROUND: u32 = 96;
    const DOWN: u32 = 48;
    let mut builder = Builder::new();
    let (mut positions, mut colors, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    for j in 0..=DOWN {
        for i in 0..=AROUND {
            let turn = f64::from(i) / f64::from(AROUND) * std::f64::consts::TAU;
            let fall = f64::from(j) / f64::from(DOWN) * std::f64::consts::PI;
            let at = DVec3::new(turn.sin() * fall.sin(), fall.cos(), -turn.cos() * fall.sin());
            positions.push((5.0 * at).as_vec3().to_array());
            colors.push((0.5 * at + DVec3::splat(0.5)).as_vec3().to_array());
            if i < AROUND && j < DOWN {
                let corner = j * (AROUND + 1) + i;
                let below = corner + AROUND + 1;
                indices.extend([corner, below, corner + 1, corner + 1, below, below + 1].map(|i| i as u16));
            }
        }
    }
    let attributes = json!({
        "POSITION": builder.floats(&positions), "COLOR_0": builder.floats(&colors),
    });
    let indices = builder.indices(&indices);
    let material = builder.push("materials", json!({"doubleSided": true, "extensions": {"KHR_materials_unlit": {}}}));
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
        ("equirectangular", PanoramaProjection::Equirectangular, 360.0, [160, 80]),
        ("cylindrical", PanoramaProjection::Cylindrical, 360.0, [160, 100]),
        ("fisheye", PanoramaProjection::Fisheye, 300.0, [100, 90]),
        ("cubemap", PanoramaProjection::Cubemap, 360.0, [120, 90]),
    ] {
        let (fov_text, size_text) = (fov.to_string(), format!("{}x{}", size[0], size[1]));
        let options = ["--projection", name, "--fov", &fov_text, "--size", &size_text];
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
            // A pixel sees several facets, each shaded once. A seam would be wrong by a pixel, at least a twentieth.
            assert!(seen.distance(expected) < 8e-3, "{name} {place}: {seen} {expected}");
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
    gpc(folder.path(), &[&command[..], &orthographic].concat()).exits(2).says(&["orthographic"]);
    let wide = ["fisheye", "--fov", "361"];
    gpc(folder.path(), &[&command[..], &wide].concat()).exits(2).says(&["360"]);
    let high = ["equirectangular", "--size", "100x100"];
    gpc(folder.path(), &[&command[..], &high].concat()).exits(2).says(&["180"]);
    gpc(folder.path(), &[&command[..], &["flat"]].concat()).exits(2).says(&["cubemap"]);
    assert!(files(folder.path()).is_empty());
}
