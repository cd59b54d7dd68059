//! Transform of vertices from object space to clip space.

/// Product of a matrix, given by columns, and a position, in 32 bits. Columns are added from the last to the first,
/// and each product and each sum is rounded. A host that computes the same gets the bits of the device.
pub fn clip_position(to_clip: [[f32; 4]; 4], [x, y, z]: [f32; 3]) -> [f32; 4] {
    [0, 1, 2, 3].map(|row| {
        let [of_x, of_y, of_z, constant] = to_clip.map(|column| column[row]);
        ((constant + of_z * z) + of_y * y) + of_x * x
    })
}
