//! Last word of a triangle: the same layout as in `shaders/include/frame.glsl`.

/// Fields of the last word of a triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct TriangleWord {
    /// Index of the material, 16 bits.
    pub material: u32,
    /// Material bin or shading key, 14 bits.
    pub bin: u32,
    /// Whether the triangle may need several shadings in a superpixel.
    pub high_frequency: bool,
    /// Whether back faces are visible.
    pub double_sided: bool,
}

const BIN_SHIFT: u32 = 16;

impl TriangleWord {
    /// Bit of triangles that may need several shadings.
    pub const HIGH_FREQUENCY: u32 = 1 << 30;
    /// Bit of triangles whose back faces are visible.
    pub const DOUBLE_SIDED: u32 = 1 << 31;

    /// Encodes the fields as the word.
    pub fn bits(self) -> u32 {
        let flag = |bit: u32, set: bool| if set { bit } else { 0 };
        self.material
            | self.bin << BIN_SHIFT
            | flag(Self::HIGH_FREQUENCY, self.high_frequency)
            | flag(Self::DOUBLE_SIDED, self.double_sided)
    }
}
