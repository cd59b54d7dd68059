//! Primitive topologies of draws.

use crate::engine::spirv;

/// Primitive topology of a draw: how consecutive corners (indices, or vertices without indices) form triangles.
/// Primitive restart is not supported: a draw is a single strip or fan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum Topology {
    /// `VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST`: every three corners form a triangle.
    #[default]
    List = spirv::TOPOLOGY_LIST,
    /// `VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP`: each corner from the third on forms a triangle with the two before it.
    Strip = spirv::TOPOLOGY_STRIP,
    /// `VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN`: each corner from the third on forms a triangle with the one before it and
    /// the first.
    Fan = spirv::TOPOLOGY_FAN,
}

impl Topology {
    /// Number of corners of `triangles` triangles.
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
