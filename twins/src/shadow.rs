//! Shadows: whether a triangle blocks the ray between a place and a light, tested triangle by triangle.

use glam::DVec3;

/// Kind and place of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shining {
    /// Distant light.
    Distant {
        /// Unit vector to the light.
        to_light: DVec3,
        /// Extent of the scene along the light.
        depth: f64,
    },
    /// Point or spot light.
    Local {
        /// Position of the light.
        position: DVec3,
        /// Unit vector of the cone's axis, and the cosine of its half angle; -2 for light in all directions.
        cone: (DVec3, f64),
        /// Distance past which the light has no effect.
        range: f64,
    },
}

/// A place that a light may reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver {
    /// Index of its triangle.
    pub triangle: usize,
    /// Position of the place.
    pub position: DVec3,
    /// Position from which the place is seen.
    pub eye: DVec3,
    /// Whether light from behind shines through its triangle.
    pub is_backlit: bool,
}

/// Offsets from a pixel's centre of further places that are tested. The pixel becomes a superpixel if a light reaches
/// either its centre or a place on the same triangle, but not both.
pub const PROBES: [[f64; 2]; 3] = [[0.34375, 0.34375], [-0.296_875, 0.40625], [0.46875, -0.296_875]];

/// Fraction of the distance, or of the scene's depth, within which a triangle does not block light, because it may be
/// the receiver itself.
const BIAS: f64 = 1.0 / 131_072.0;

/// Whether the place lies in shadow, as the passes `receivers` and `occlude` decide it.
/// `None` if the decision is closer than `doubt`, a fraction of the lengths and of the triangles' sides.
#[must_use]
pub fn is_in_shadow(triangles: &[[DVec3; 3]], receiver: &Receiver, light: &Shining, doubt: f64) -> Option<bool> {
    let Receiver { triangle, position, eye, is_backlit } = *receiver;
    let (to_light, length, least) = match *light {
        Shining::Distant { to_light, depth } => (to_light, f64::INFINITY, BIAS * depth),
        Shining::Local { position: from, cone: (axis, cosine), range } => {
            let way = from - position;
            let length = way.length();
            let along = -way.dot(axis) / length;
            if (length / range - 1.0).abs() < doubt || (along - cosine).abs() < doubt {
                return None;
            }
            if length > range || along < cosine {
                return Some(false);
            }
            // Depth is the reciprocal of the distance, so that the bias is relative to the distance.
            (way / length, length, BIAS * length)
        }
    };
    let [a, b, c] = *triangles.get(triangle)?;
    let normal = (b - a).cross(c - a).normalize();
    let seen = normal.dot(eye - position);
    let lit = normal.dot(to_light);
    if lit.abs() < doubt || seen.abs() < doubt {
        return None;
    }
    if !is_backlit && (lit > 0.0) != (seen > 0.0) {
        return Some(true);
    }
    let mut hidden = false;
    let others = triangles.iter().enumerate().filter(|(i, _)| *i != triangle);
    for (_, corners) in others {
        match between(corners, position, to_light, doubt) {
            RayHit::None => {}
            RayHit::Doubtful => return None,
            RayHit::At(distance) => {
                if (distance - least).abs() < doubt * least.max(distance.abs()) + 1e-9 {
                    return None;
                }
                hidden |= distance > least && distance < length;
            }
        }
    }
    Some(hidden)
}

enum RayHit {
    None,
    Doubtful,
    /// The ray meets the triangle at this distance.
    At(f64),
}

/// Intersection of a ray and a triangle.
fn between(&[a, b, c]: &[DVec3; 3], from: DVec3, along: DVec3, doubt: f64) -> RayHit {
    let (ab, ac) = (b - a, c - a);
    let cross = along.cross(ac);
    let determinant = ab.dot(cross);
    let size = ab.length() * ac.length();
    if determinant.abs() < doubt * size {
        return RayHit::Doubtful;
    }
    let to = from - a;
    let u = to.dot(cross) / determinant;
    let across = to.cross(ab);
    let v = along.dot(across) / determinant;
    let edge = [u, v, 1.0 - u - v].into_iter().fold(f64::MAX, f64::min);
    // Movement of the intersection, in these coordinates, if the ray moves by a fraction of the sides.
    let reach = doubt * size / determinant.abs();
    if edge.abs() < reach {
        return RayHit::Doubtful;
    }
    if edge < 0.0 {
        return RayHit::None;
    }
    RayHit::At(ac.dot(across) / determinant)
}
