//! Sampling locations, as the renderer takes them.

/// A sampling location on a pinhole's image plane that belongs to one cell of the output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleLocation {
    /// Location (u, v) in pixels of the plane; the upper left corner is (0, 0).
    pub uv: [f64; 2],
    /// Columns of the Jacobian of the location map: changes of (u, v) per output column and per output row.
    pub jacobian: [[f64; 2]; 2],
    /// Index of the cell of the output: row * columns + column.
    pub output: u32,
}

impl SampleLocation {
    /// Location for another place of the same cell, `columns` and `rows` of the output away.
    pub(crate) fn at(&self, [columns, rows]: [f64; 2]) -> Self {
        let [column, row] = self.jacobian;
        let moved = |axis: usize| self.uv[axis] + column[axis] * columns + row[axis] * rows;
        Self { uv: [moved(0), moved(1)], ..*self }
    }
}
