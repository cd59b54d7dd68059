//! Panoramas: directions in closed form, each pixel sampled once where it looks, and refused requests.

use glam::{DMat3, DQuat, DVec2, DVec3};
use gpc::camera::panorama::{Panorama, PanoramaError, PanoramaProjection};
use gpc::camera::{Camera, Projection};

use PanoramaProjection::{Cubemap, Cylindrical, Equirectangular, Fisheye};

fn panorama(projection: PanoramaProjection, fov: f64, size: [u32; 2]) -> Panorama {
    Panorama::new(projection, fov, size).unwrap()
}

fn camera() -> Camera {
    let mut camera = Camera::look_at(DVec3::new(1.0, 2.0, 3.0), DVec3::ZERO, DVec3::Y, 50.0, 0.1).unwrap();
    camera.axes = DMat3::from_quat(DQuat::from_euler(glam::EulerRot::YXZ, 0.4, -0.3, 0.1));
    camera
}

#[test]
fn directions_are_those_of_closed_form() {
    let near = |found: Option<DVec3>, expected: [f64; 3]| {
        let expected = DVec3::from(expected).normalize();
        assert!(found.unwrap().distance(expected) < 1e-12, "{found:?} {expected}");
    };
    let full = panorama(Equirectangular, 360.0, [400, 200]);
    near(full.look(DVec2::new(200.0, 100.0)), [0.0, 0.0, -1.0]);
    near(full.look(DVec2::new(300.0, 100.0)), [1.0, 0.0, 0.0]);
    near(full.look(DVec2::new(0.0, 100.0)), [0.0, 0.0, 1.0]);
    near(full.look(DVec2::new(123.0, 0.0)), [0.0, 1.0, 0.0]);
    near(full.look(DVec2::new(250.0, 50.0)), [1.0, 2.0_f64.sqrt(), -1.0]);
    let cylinder = panorama(Cylindrical, 180.0, [314, 200]);
    // The height equals the distance, so that a radian is 314 / pi pixels.
    let radian = 314.0 / std::f64::consts::PI;
    near(cylinder.look(DVec2::new(157.0, 100.0 - radian)), [0.0, 1.0, -1.0]);
    near(cylinder.look(DVec2::new(314.0, 100.0 + radian)), [1.0, -1.0, 0.0]);
    let fisheye = panorama(Fisheye, 180.0, [300, 200]);
    near(fisheye.look(DVec2::new(150.0, 100.0)), [0.0, 0.0, -1.0]);
    near(fisheye.look(DVec2::new(250.0, 100.0)), [1.0, 0.0, 0.0]);
    near(fisheye.look(DVec2::new(150.0, 50.0)), [0.0, 1.0, -1.0]);
    assert_eq!(fisheye.look(DVec2::new(251.0, 100.0)), None);
    let cube = panorama(Cubemap, 360.0, [80, 60]);
    for (cross, expected) in [
        ([30.0, 30.0], [0.0, 0.0, -1.0]),
        ([50.0, 30.0], [1.0, 0.0, 0.0]),
        ([10.0, 30.0], [-1.0, 0.0, 0.0]),
        ([70.0, 30.0], [0.0, 0.0, 1.0]),
        ([30.0, 10.0], [0.0, 1.0, 0.0]),
        ([30.0, 50.0], [0.0, -1.0, 0.0]),
        ([35.0, 25.0], [0.5, 0.5, -1.0]),
    ] {
        near(cube.look(DVec2::from(cross)), expected);
    }
    assert_eq!(cube.look(DVec2::new(5.0, 5.0)), None);
}

#[test]
fn neighbouring_faces_of_a_cross_meet() {
    let cube = panorama(Cubemap, 360.0, [80, 60]);
    let e = 1e-9;
    for (a, b) in [
        ([20.0 - e, 33.0], [20.0 + e, 33.0]),
        ([40.0 - e, 22.0], [40.0 + e, 22.0]),
        ([60.0 - e, 38.0], [60.0 + e, 38.0]),
        ([0.0, 33.0], [80.0 - e, 33.0]),
        ([27.0, 20.0 - e], [27.0, 20.0 + e]),
        ([38.0, 40.0 - e], [38.0, 40.0 + e]),
    ] {
        let [a, b] = [a, b].map(|place| cube.look(DVec2::from(place)).unwrap());
        assert!(a.distance(b) < 1e-8, "{a} {b}");
    }
}

#[test]
fn every_pixel_is_sampled_once_exactly_where_it_looks() {
    let camera = camera();
    for (projection, fov, size) in [
        (Equirectangular, 360.0, [120, 60]),
        (Equirectangular, 90.0, [60, 30]),
        (Cylindrical, 360.0, [120, 90]),
        (Fisheye, 360.0, [50, 50]),
        (Cubemap, 360.0, [80, 60]),
    ] {
        let panorama = panorama(projection, fov, size);
        let locations = panorama.locations(&camera).unwrap();
        let [columns, rows] = locations.size();
        let mut looks = vec![None; (columns * rows) as usize];
        for (pinhole, locations) in locations.rig() {
            assert_eq!(pinhole.eye(), camera.eye);
            for location in locations {
                let look = &mut looks[location.output as usize];
                assert_eq!(*look, None, "sampled twice");
                *look = Some(pinhole.ray(DVec2::from(location.uv)).direction);
            }
        }
        let looks = locations.crop(&looks, None);
        assert_eq!(looks.len(), (panorama.size()[0] * panorama.size()[1]) as usize);
        for (index, found) in looks.into_iter().enumerate() {
            let (x, y) = (index as u32 % panorama.size()[0], index as u32 / panorama.size()[0]);
            let place = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let expected = panorama.look(place).map(|direction| camera.axes * direction);
            assert_eq!(found.is_some(), expected.is_some(), "{projection:?} {place}");
            if let (Some(found), Some(expected)) = (found, expected) {
                assert!(found.distance(expected) < 1e-12, "{projection:?} {place}");
            }
        }
    }
}

#[test]
fn a_narrow_panorama_takes_fewer_pinholes() {
    let count = |fov, size| {
        let narrow = panorama(Equirectangular, fov, size);
        narrow.locations(&camera()).unwrap().rig().len()
    };
    assert_eq!(count(60.0, [60, 30]), 1);
    assert_eq!(count(200.0, [200, 30]), 3);
    assert_eq!(count(360.0, [120, 60]), 6);
}

#[test]
fn impossible_panoramas_are_refused() {
    for fov in [0.0, -5.0, 360.5, f64::NAN] {
        let refused = Panorama::new(Fisheye, fov, [9, 9]);
        assert!(matches!(refused, Err(PanoramaError::FieldOfView(_))));
    }
    let high = Panorama::new(Equirectangular, 360.0, [400, 201]);
    assert!(matches!(high, Err(PanoramaError::Latitudes { .. })));
    let narrow = Panorama::new(Cubemap, 90.0, [400, 300]);
    assert!(matches!(narrow, Err(PanoramaError::CubemapFieldOfView(_))));
    assert!(matches!(Panorama::new(Cubemap, 360.0, [3, 3]), Err(PanoramaError::Size(_))));
    assert!(matches!(Panorama::new(Fisheye, 90.0, [0, 3]), Err(PanoramaError::Size(_))));
    let orthographic =
        Camera { projection: Projection::Orthographic { half_height: 1.0, near: 0.0, far: 1.0 }, ..camera() };
    let refused = panorama(Fisheye, 90.0, [9, 9]).locations(&orthographic);
    assert_eq!(refused, Err(PanoramaError::Orthographic));
}
