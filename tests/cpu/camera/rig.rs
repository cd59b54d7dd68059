//! Rigs: every direction belongs to exactly one pinhole; refused requests.

use glam::{DMat3, DQuat, DVec2, DVec3};
use gpc::camera::{Pinhole, Rig, RigError};

fn cube(side: u32) -> Rig {
    let axes = DMat3::from_quat(DQuat::from_rotation_y(0.3));
    Rig::cube(DVec3::new(4.0, 5.0, 6.0), axes, side, 0.01).unwrap()
}

#[test]
fn every_direction_is_in_one_face_of_a_cube_and_inside_of_it() {
    let rig = cube(64);
    let mut counts = [0; 6];
    for i in 0..20_000 {
        // The directions form a spiral over the sphere.
        let z = 1.0 - (2.0 * f64::from(i) + 1.0) / 20_000.0;
        let around = DVec2::from_angle(2.399963 * f64::from(i)) * (1.0 - z * z).sqrt();
        let direction = DVec3::new(around.x, z, around.y);
        let (face, uv) = rig.locate(direction).unwrap();
        assert!(uv.cmpge(DVec2::splat(-1e-9)).all() && uv.cmple(DVec2::splat(64.0 + 1e-9)).all());
        let ray = rig.pinholes()[face].ray(uv);
        assert!((ray.direction - direction).length() < 1e-12);
        counts[face] += 1;
    }
    assert!(counts.iter().all(|count| (3000..3700).contains(count)), "{counts:?}");
}

#[test]
fn the_corner_of_three_faces_belongs_to_the_first() {
    let rig = Rig::cube(DVec3::ZERO, DMat3::IDENTITY, 16, 0.1).unwrap();
    assert_eq!(rig.locate(DVec3::ONE).unwrap().0, 0);
    assert_eq!(rig.locate(DVec3::new(-1.0, 1.0, 1.0)).unwrap().0, 1);
    // A direction a little to the right of and above the front is to the right of and above the middle.
    let (face, uv) = rig.locate(DVec3::new(0.5, 0.25, -1.0)).unwrap();
    assert_eq!((face, uv), (5, DVec2::new(12.0, 6.0)));
}

#[test]
fn each_pixel_is_sampled_once_and_jacobians_do_not_see_seams() {
    let rig = cube(64);
    let size = [90, 45];
    let look = |place: DVec2| {
        let (longitude, latitude) = (place.x * 4.0, 90.0 - place.y * 4.0);
        let around = DVec2::from_angle(longitude.to_radians()) * latitude.to_radians().cos();
        Some(DVec3::new(around.x, latitude.to_radians().sin(), around.y))
    };
    let sets = rig.sets(size, look).unwrap();
    let mut seen = vec![0; 90 * 45];
    for set in sets.iter().flatten() {
        for location in set.locations() {
            seen[location.output as usize] += 1;
            // A pixel is 4 degrees, about 2.2 to 5 pixels of a face; near the poles it is narrow.
            let [x, y] = location.jacobian.map(|column| DVec2::from(column).length());
            assert!(x < 9.0 && (1.5..9.0).contains(&y), "{location:?}");
        }
    }
    assert!(seen.iter().all(|count| *count == 1));
}

#[test]
fn what_is_no_rig_is_refused() {
    let parts = [DVec3::NEG_Z, DVec3::X, DVec3::Y];
    let at = |centre: DVec3, w: f64, far| {
        let [o, a, b] = parts;
        Pinhole::new(centre.extend(w), o, a, b, 0.1, far).unwrap()
    };
    let first = at(DVec3::ZERO, 1.0, None);
    assert_eq!(Rig::new(vec![]), Err(RigError::Empty));
    assert_eq!(Rig::new(vec![first, at(DVec3::Z, 1.0, None)]), Err(RigError::Centre(1)));
    assert_eq!(Rig::new(vec![first, at(DVec3::Z, 0.0, Some(9.0))]), Err(RigError::Parallel(1)));
    assert!(Rig::cube(DVec3::ZERO, DMat3::IDENTITY, 0, 0.1).is_err());
    assert!(Rig::cube(DVec3::NAN, DMat3::IDENTITY, 4, 0.1).is_err());
    // A single plane sees neither the sides nor the back.
    let alone = Rig::new(vec![first]).unwrap();
    assert!(alone.locate(DVec3::NEG_Z).is_some());
    assert!(alone.locate(DVec3::X).is_none() && alone.locate(DVec3::Z).is_none());
}
