//! Whether light is kept from a place of a triangle: by the rays between them, triangle by triangle.

use glam::DVec3;

/// What shines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shining {
    /// From far away.
    Distant {
        /// Unit vector to it.
        to_light: DVec3,
        /// Extent of the scene along it.
        depth: f64,
    },
    /// From a point.
    Local {
        /// Where it is.
        position: DVec3,
        /// Unit vector that light goes around, and the cosine of the angle from it up to which it goes; -2 for all directions.
        cone: (DVec3, f64),
        /// How far it goes.
        range: f64,
    },
}

/// A place that light may reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver {
    /// Index of its triangle.
    pub triangle: usize,
    /// Where it is.
    pub position: DVec3,
    /// From where it is seen.
    pub eye: DVec3,
    /// Whether light from behind shines through its triangle.
    pub is_backlit: bool,
}

/// Where a pixel is asked, from its centre, besides there: it is a superpixel where a light reaches one of these places of the
/// same triangle and not the centre, or the centre alone.
pub const PROBES: [[f64; 2]; 3] = [
    [0.34375, 0.34375],
    [-0.296_875, 0.40625],
    [0.46875, -0.296_875],
];

/// What lies nearer than this part of the distance, or of the scene's depth, is the receiver itself.
const BIAS: f64 = 1.0 / 131_072.0;

/// Whether the place lies in shadow, as the passes `receivers`, `sample` and `shadow` tell it; nothing where less than `doubt`
/// decides, a part of the lengths and of the triangles' sides.
#[must_use]
pub fn is_in_shadow(
    triangles: &[[DVec3; 3]],
    receiver: &Receiver,
    light: &Shining,
    doubt: f64,
) -> Option<bool> {
    let Receiver {
        triangle,
        position,
        eye,
        is_backlit,
    } = *receiver;
    let (to_light, length, least) = match *light {
        Shining::Distant { to_light, depth } => (to_light, f64::INFINITY, BIAS * depth),
        Shining::Local {
            position: from,
            cone: (axis, cosine),
            range,
        } => {
            let way = from - position;
            let length = way.length();
            let along = -way.dot(axis) / length;
            if (length / range - 1.0).abs() < doubt || (along - cosine).abs() < doubt {
                return None;
            }
            if length > range || along < cosine {
                return Some(false);
            }
            // Depth is the reciprocal of the distance.
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
            Crossing::None => {}
            Crossing::Doubtful => return None,
            Crossing::At(distance) => {
                if (distance - least).abs() < doubt * least.max(distance.abs()) + 1e-9 {
                    return None;
                }
                hidden |= distance > least && distance < length;
            }
        }
    }
    Some(hidden)
}

enum Crossing {
    None,
    Doubtful,
    /// At this distance along the ray.
    At(f64),
}

/// Where a ray meets a triangle.
fn between(&[a, b, c]: &[DVec3; 3], from: DVec3, along: DVec3, doubt: f64) -> Crossing {
    let (ab, ac) = (b - a, c - a);
    let cross = along.cross(ac);
    let determinant = ab.dot(cross);
    let size = ab.length() * ac.length();
    if determinant.abs() < doubt * size {
        return Crossing::Doubtful;
    }
    let to = from - a;
    let u = to.dot(cross) / determinant;
    let across = to.cross(ab);
    let v = along.dot(across) / determinant;
    let edge = [u, v, 1.0 - u - v].into_iter().fold(f64::MAX, f64::min);
    // How far a place moves in these coordinates if the ray moves by a part of the sides.
    let reach = doubt * size / determinant.abs();
    if edge.abs() < reach {
        return Crossing::Doubtful;
    }
    if edge < 0.0 {
        return Crossing::None;
    }
    Crossing::At(ac.dot(across) / determinant)
}
