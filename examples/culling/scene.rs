//! What the host shows: a box, many objects that are this box, and the view.

use glam::{Mat4, Quat, Vec3, Vec4};

/// Number of objects.
pub const OBJECTS: u32 = 20_000;

/// An object, laid out as in `shaders/scene.glsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Object {
    pub to_world: [[f32; 4]; 4],
    pub color: [f32; 4],
}

/// Positions of a box from -1 to 1 as normalised integers of 16 bits, four for each vertex, and its indices. Each face has
/// four vertices, and its triangles are counter-clockwise seen from outside.
pub fn cube() -> (Vec<[i16; 4]>, Vec<u16>) {
    let (mut vertices, mut indices) = (Vec::new(), Vec::new());
    for face in 0..6_usize {
        let axis = face / 2;
        let sign = if face % 2 == 0 { -1 } else { 1 };
        let first = vertices.len() as u16;
        for [u, v] in [[-1, -1], [1, -1], [1, 1], [-1, 1]] {
            let mut corner = [0; 4];
            corner[axis] = sign * i16::MAX;
            corner[(axis + 1) % 3] = u * i16::MAX;
            corner[(axis + 2) % 3] = v * i16::MAX;
            vertices.push(corner);
        }
        let quad = if sign > 0 { [0, 1, 2, 0, 2, 3] } else { [0, 2, 1, 0, 3, 2] };
        indices.extend(quad.map(|corner: u16| first + corner));
    }
    (vertices, indices)
}

/// Numbers from 0 to 1 that look random.
struct Dice(u32);

impl Dice {
    fn roll(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as f32 / (1 << 24) as f32
    }
}

/// Slabs, posts and blocks on all sides of the eye; most are outside of the view.
pub fn objects() -> Vec<Object> {
    let mut dice = Dice(7);
    let mut object = |_| {
        let at = loop {
            let at = Vec3::from_array([0; 3].map(|_| 60.0 * dice.roll() - 30.0));
            if at.length() > 5.0 {
                break at;
            }
        };
        let axis = Vec3::from_array([0; 3].map(|_| dice.roll() - 0.5)).normalize_or(Vec3::Y);
        let turned = Quat::from_axis_angle(axis, 6.3 * dice.roll());
        let half = Vec3::from_array([0; 3].map(|_| 0.02 + 0.5 * dice.roll().powi(4)));
        let color = Vec3::from_array([0; 3].map(|_| 0.1 + 0.9 * dice.roll()));
        Object {
            to_world: Mat4::from_scale_rotation_translation(half, turned, at).to_cols_array_2d(),
            color: color.extend(1.0).to_array(),
        }
    };
    (0..OBJECTS).map(&mut object).collect()
}

/// Matrix from the world to clip space, y up, and the projection in it.
pub fn camera([width, height]: [u32; 2]) -> (Mat4, Mat4) {
    let projection = Mat4::perspective_infinite_reverse_rh(0.9, width as f32 / height as f32, 0.1);
    let view = Mat4::look_at_rh(Vec3::ZERO, Vec3::new(0.6, -0.2, -1.0), Vec3::Y);
    (projection * view, projection)
}

/// Number of objects of which the sphere around their box reaches into the view, as `shaders/cull.comp` counts them.
pub fn in_view(objects: &[Object], to_clip: Mat4) -> usize {
    let rows = to_clip.transpose();
    let sides = [
        rows.w_axis + rows.x_axis,
        rows.w_axis - rows.x_axis,
        rows.w_axis + rows.y_axis,
        rows.w_axis - rows.y_axis,
        rows.w_axis,
    ];
    let is_in = |object: &&Object| {
        let [x, y, z, centre] = object.to_world.map(|column| Vec4::from_array(column).truncate());
        let radius = x.length() + y.length() + z.length();
        sides.iter().all(|side| {
            let across = side.truncate();
            across.dot(centre) + side.w >= -radius * across.length()
        })
    };
    objects.iter().filter(is_in).count()
}
