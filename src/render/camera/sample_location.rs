//! Where a renderer samples for one cell of its output.

/// A sampling location on a pinhole's image plane that belongs to one cell of the output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleLocation {
    /// (u, v) in pixels of the plane, (0, 0) its upper left corner.
    pub uv: [f64; 2],
    /// Change of (u, v) for each output column and each output row: the columns of the Jacobian of the location map.
    pub jacobian: [[f64; 2]; 2],
    /// Index of the output cell: row * columns + column.
    pub output: u32,
}

impl SampleLocation {
    /// Another place of its cell, by how far that is from the location, in columns and rows of the output.
    pub(crate) fn at(&self, [columns, rows]: [f64; 2]) -> Self {
        let [column, row] = self.jacobian;
        let moved = |axis: usize| self.uv[axis] + column[axis] * columns + row[axis] * rows;
        Self {
            uv: [moved(0), moved(1)],
            ..*self
        }
    }
}
