//! How the corners of a draw make triangles.

use crate::engine::passes::spirv;

/// How the corners of a draw make triangles: which of its indices, or of its vertices where there are none, belong to which.
/// Primitive restart is not known: a draw is one strip or fan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum Topology {
    /// `VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST`: each three make one.
    #[default]
    List = spirv::TOPOLOGY_LIST,
    /// `VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP`: each one from the third on makes one with the two before it.
    Strip = spirv::TOPOLOGY_STRIP,
    /// `VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN`: each one from the third on makes one with the one before it and the first.
    Fan = spirv::TOPOLOGY_FAN,
}

impl Topology {
    /// How many corners so many triangles have.
    #[must_use]
    pub fn corners(self, triangles: u32) -> u64 {
        let triangles = u64::from(triangles);
        match self {
            Self::List => 3 * triangles,
            Self::Strip | Self::Fan if triangles == 0 => 0,
            Self::Strip | Self::Fan => triangles + 2,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_share_corners() {
        assert_eq!(Topology::List.corners(4), 12);
        assert_eq!(Topology::Strip.corners(4), 6);
        assert_eq!(Topology::Fan.corners(1), 3);
        assert_eq!(Topology::Fan.corners(0), 0);
    }
}
