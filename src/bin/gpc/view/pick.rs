//! Picking: the triangle that a line of sight meets first.

use glam::{DAffine3, DVec3};
use gpc::camera::Ray;
use gpc::scene::PosedGeometry;

/// First point at which a ray meets a triangle. Both sides of triangles count, and alpha is ignored.
pub fn first_hit(geometry: &PosedGeometry, ray: &Ray) -> Option<DVec3> {
    let start = ray.start - geometry.origin;
    let meet = |triangles: std::ops::Range<usize>, place: DAffine3| {
        let inverse = place.inverse();
        let start = inverse.transform_point3(start);
        let direction = inverse.transform_vector3(ray.direction);
        let triangles = geometry.triangles.get(triangles).unwrap_or(&[]);
        let corner = |vertex: u32| {
            let position = geometry.positions.get(vertex as usize);
            position.map(|position| DVec3::from_array(position.map(f64::from)))
        };
        let distances = triangles.iter().filter_map(|[a, b, c]| {
            let corners = [corner(*a)?, corner(*b)?, corner(*c)?];
            distance(start, direction, corners)
        });
        distances.min_by(f64::total_cmp)
    };
    let nearest = if geometry.instances.is_empty() {
        meet(0..geometry.triangles.len(), DAffine3::IDENTITY)
    } else {
        let each = geometry.instances.iter().filter_map(|instance| {
            let first = instance.first_triangle as usize;
            let triangles = first..first + instance.triangle_count as usize;
            meet(triangles, instance.transform)
        });
        each.min_by(f64::total_cmp)
    };
    nearest.map(|distance| ray.start + distance * ray.direction)
}

/// Distance along the ray to a triangle, in lengths of `direction` (Moeller and Trumbore, 1997).
fn distance(start: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let p = direction.cross(ac);
    let scale = 1.0 / ab.dot(p);
    let from = start - a;
    let u = scale * from.dot(p);
    let q = from.cross(ab);
    let v = scale * direction.dot(q);
    let t = scale * ac.dot(q);
    // For a triangle seen edge-on the numbers are infinite or NaN.
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t.is_finite()).then_some(t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gpc::scene::MeshInstance;

    fn geometry() -> PosedGeometry {
        PosedGeometry {
            origin: DVec3::new(10.0, 0.0, 0.0),
            positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            triangles: vec![[0, 1, 2]],
            ..PosedGeometry::default()
        }
    }

    fn ray(x: f64, y: f64) -> Ray {
        Ray { start: DVec3::new(x, y, 5.0), direction: DVec3::new(0.0, 0.0, -2.0) }
    }

    #[test]
    fn meets_triangles_around_the_origin() {
        let geometry = geometry();
        let hit = first_hit(&geometry, &ray(10.25, 0.5));
        assert_eq!(hit, Some(DVec3::new(10.25, 0.5, 0.0)));
        assert_eq!(first_hit(&geometry, &ray(10.75, 0.5)), None);
        let away = Ray { direction: DVec3::Z, ..ray(10.25, 0.5) };
        assert_eq!(first_hit(&geometry, &away), None);
    }

    #[test]
    fn the_nearest_instance_is_met() {
        let mut geometry = geometry();
        let at = |z: f64, first_index: u32| MeshInstance {
            first_triangle: 0,
            triangle_count: 1,
            first_index,
            transform: DAffine3::from_translation(DVec3::new(0.0, 0.0, z)),
        };
        geometry.instances = vec![at(-1.0, 0), at(2.0, 64), at(1.0, 128)];
        let hit = first_hit(&geometry, &ray(10.25, 0.5)).unwrap();
        assert!((hit - DVec3::new(10.25, 0.5, 2.0)).length() < 1e-12);
    }
}
