//! Vertices in clip space, from object space.

/// A position times a matrix, given in columns, in 32 bits: column by column from the last, each product and each sum
/// rounded. A host that computes this gets the bits that the device has.
pub fn clip_position(to_clip: [[f32; 4]; 4], [x, y, z]: [f32; 3]) -> [f32; 4] {
    [0, 1, 2, 3].map(|row| {
        let [of_x, of_y, of_z, constant] = to_clip.map(|column| column[row]);
        ((constant + of_z * z) + of_y * y) + of_x * x
    })
}
