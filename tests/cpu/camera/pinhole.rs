//! The pinhole: compared with the renderer's camera and with itself, and refused requests.

use glam::{DMat3, DMat4, DQuat, DVec2, DVec3, DVec4};
use gpc::camera::{Camera, Pinhole, PinholeError, Projection};

const SIZE: [u32; 2] = [320, 200];

/// Perspective cameras with and without a far plane, and an orthographic one; moved, turned and shifted.
fn cameras() -> Vec<Camera> {
    let turn = DQuat::from_euler(glam::EulerRot::YXZ, 0.7, -0.3, 0.2);
    let perspective = |far| Projection::Perspective { fov: 0.9, near: 0.25, far };
    let orthographic = Projection::Orthographic { half_height: 3.0, near: -1.0, far: 40.0 };
    [perspective(None), perspective(Some(90.0)), orthographic]
        .map(|projection| Camera {
            eye: DVec3::new(100.0, -20.0, 7.0),
            axes: DMat3::from_quat(turn),
            projection,
            shift: DVec2::new(0.1, -0.03),
        })
        .to_vec()
}

fn assert_near(found: DMat4, expected: DMat4) {
    for (found, expected) in found.to_cols_array().iter().zip(expected.to_cols_array()) {
        let bound = 1e-11 * (1.0 + expected.abs());
        assert!((found - expected).abs() < bound, "{found} {expected}");
    }
}

#[test]
fn a_cameras_pinhole_has_the_cameras_matrix() {
    let [width, height] = SIZE.map(f64::from);
    let origin = DVec3::new(99.0, -18.0, 3.0);
    for camera in cameras() {
        let pinhole = Pinhole::from_camera(&camera, SIZE).unwrap();
        assert_eq!(pinhole.is_parallel(), camera.is_orthographic());
        assert!((pinhole.direction() - camera.direction()).length() < 1e-14);
        let found = pinhole.pixel_matrix(origin, 0.5 * DVec2::new(width, height));
        assert_near(found, camera.pixel_matrix(origin, width, height));
    }
}

#[test]
fn a_projection_matrix_gives_its_pinhole_back() {
    let aspect = f64::from(SIZE[0]) / f64::from(SIZE[1]);
    for camera in cameras() {
        let matrix = camera.projection_matrix(aspect) * camera.view();
        let from_matrix = Pinhole::from_projection_matrix(matrix * 3.0, SIZE).unwrap();
        let expected = Pinhole::from_camera(&camera, SIZE).unwrap();
        let near = |found: DVec3, expected: DVec3| (found - expected).length() < 1e-10;
        assert_eq!(from_matrix.is_parallel(), expected.is_parallel());
        let window = DVec2::new(160.0, 100.0);
        assert_near(from_matrix.pixel_matrix(camera.eye, window), expected.pixel_matrix(camera.eye, window));
        if !expected.is_parallel() {
            assert!(near(from_matrix.eye(), expected.eye()));
        }
    }
}

#[test]
fn a_point_on_a_ray_projects_to_its_location() {
    for camera in cameras() {
        let pinhole = Pinhole::from_camera(&camera, SIZE).unwrap();
        for uv in [(0.0, 0.0), (0.5, 0.5), (320.0, 200.0), (-900.0, 41.25)] {
            let uv = DVec2::from(uv);
            let ray = pinhole.ray(uv);
            assert!((ray.direction.length() - 1.0).abs() < 1e-14);
            for distance in [0.3, 1.0, 50.0] {
                let found = pinhole.project(ray.start + distance * ray.direction);
                assert!((found.unwrap() - uv).length() < 1e-8, "{found:?} {uv}");
            }
            if !pinhole.is_parallel() {
                assert_eq!(pinhole.project(ray.start - ray.direction), None);
                let found = pinhole.project_direction(ray.direction).unwrap();
                assert!((found - uv).length() < 1e-8);
            }
        }
    }
}

#[test]
fn the_corners_of_the_image_are_those_of_the_field_of_view() {
    let pinhole = Pinhole::from_field_of_view(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 90.0, 0.1, [200, 100]).unwrap();
    let corner = pinhole.ray(DVec2::ZERO).direction;
    assert!((corner - DVec3::new(-2.0, 1.0, -1.0).normalize()).length() < 1e-14);
    let centre = pinhole.ray(DVec2::new(100.0, 50.0)).direction;
    assert!((centre - DVec3::NEG_Z).length() < 1e-14);
}

#[test]
fn an_oblique_parallel_pinhole_keeps_depths_along_the_normal() {
    let light = DVec4::new(1.0, 0.0, 1.0, 0.0);
    let pinhole = Pinhole::new(light, DVec3::ZERO, DVec3::X, DVec3::NEG_Y, 0.0, Some(10.0)).unwrap();
    assert_eq!(pinhole.direction(), DVec3::NEG_Z);
    let found = pinhole.pixel_matrix(DVec3::ZERO, DVec2::ZERO) * DVec4::new(0.0, 0.0, -5.0, 1.0);
    assert!((found - DVec4::new(5.0, 0.0, 0.5, 1.0)).length() < 1e-14, "{found}");
}

#[test]
fn what_is_no_pinhole_is_refused() {
    let new = |centre: [f64; 4], a, b, near, far| Pinhole::new(DVec4::from(centre), DVec3::NEG_Z, a, b, near, far);
    let (x, y) = (DVec3::X, DVec3::Y);
    let eye = [0.0, 0.0, 0.0, 1.0];
    assert!(new(eye, x, y, 0.1, None).is_ok());
    type Case = (Result<Pinhole, PinholeError>, &'static str);
    let cases: [Case; 9] = [
        (new(eye, x, x * 2.0, 0.1, None), "span no image plane"),
        (new(eye, x, DVec3::ZERO, 0.1, None), "span no image plane"),
        (new([3.0, 1.0, -1.0, 1.0], x, y, 0.1, None), "lies in the image plane"),
        (new([1.0, 0.0, 0.0, 0.0], x, y, 0.1, Some(1.0)), "lies in the image plane"),
        (new([0.0; 4], x, y, 0.1, Some(1.0)), "direction"),
        (new([0.0, 0.0, 0.0, 2.0], x, y, 0.1, None), "(x, y, z, 1)"),
        (new(eye, DVec3::NAN, y, 0.1, None), "the step a"),
        (new(eye, x, y, 0.0, None), "near above 0"),
        (new([0.0, 0.0, 1.0, 0.0], x, y, 0.0, None), "far finite"),
    ];
    for (made, expected) in cases {
        let message = made.unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    }
    for matrix in [DMat4::ZERO, DMat4::NAN] {
        assert!(Pinhole::from_projection_matrix(matrix, SIZE).is_err());
    }
    assert!(Pinhole::from_camera(&cameras()[0], [0, 5]).is_err());
}
