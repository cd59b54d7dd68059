//! The last word of a triangle, as in `shaders/include/frame.glsl`.

/// What it says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct TriangleWord {
    /// 16 bits.
    pub material: u32,
    /// Or shading key, 14 bits.
    pub bin: u32,
    /// Whether it may be shaded in several parts of a superpixel.
    pub high_frequency: bool,
    /// Whether back faces show.
    pub double_sided: bool,
}

const BIN_SHIFT: u32 = 16;

impl TriangleWord {
    /// The bit of those that may be shaded in several parts.
    pub const HIGH_FREQUENCY: u32 = 1 << 30;
    /// The bit of those whose back faces show.
    pub const DOUBLE_SIDED: u32 = 1 << 31;

    /// Its bits.
    pub fn bits(self) -> u32 {
        let flag = |bit: u32, set: bool| if set { bit } else { 0 };
        self.material
            | self.bin << BIN_SHIFT
            | flag(Self::HIGH_FREQUENCY, self.high_frequency)
            | flag(Self::DOUBLE_SIDED, self.double_sided)
    }
}
