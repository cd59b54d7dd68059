//! Geometry of a host: buffers and capacities for the draws of all frames.

use super::alpha::{AlphaMap, MOST_MAPS};
use super::{HostError, IndirectDraws, Member, Mesh, Place};
use crate::vulkan::{Gpu, Limits, VulkanError};

/// Conventions of the host's clip space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipSpace {
    /// Whether y points up, as with a viewport of negative height; otherwise y points down, Vulkan's default.
    pub y_up: bool,
    /// Whether depth is reversed: from 1 at the near plane to 0 at the far plane; otherwise from 0 to 1.
    pub reversed_depth: bool,
    /// Values in the depth image for the clip-space depths 0 and 1: `minDepth` and `maxDepth` of the host's viewport.
    /// The two values must differ.
    pub depth_range: [f32; 2],
}

impl Default for ClipSpace {
    /// Vulkan's default: y down with a viewport of positive height, and depth from 0 to 1.
    fn default() -> Self {
        Self { y_up: false, reversed_depth: false, depth_range: [0.0, 1.0] }
    }
}

impl ClipSpace {
    /// Factor and offset that convert values of the depth image to reversed depth, in which larger values are nearer.
    pub(super) fn depth_of_image(&self) -> [f32; 2] {
        let [least, most] = self.depth_range;
        let (factor, constant) = (1.0 / (most - least), -least / (most - least));
        if self.reversed_depth { [factor, constant] } else { [-factor, 1.0 - constant] }
    }
}

/// Space and format of vertex positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PositionSpace {
    /// Clip space, four floats: the same values that the host's vertex shader outputs.
    Clip,
    /// Object space of the draw, three numbers; [`Draw::to_clip`](super::Draw::to_clip) transforms them to clip space.
    Object {
        /// Largest total number of vertices of a recording's [draws](super::Draw). Vertices that several draws share count
        /// once for each draw.
        capacity: u32,
    },
}

/// Buffers and capacities of a host. The contents of the buffers may change in every frame: the engine reads them when
/// a recording is executed.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry {
    /// Meshes; each draw reads one of them.
    pub meshes: Vec<Mesh>,
    /// Space and format of vertex positions.
    pub position_space: PositionSpace,
    /// Alpha maps of draws that are not opaque. The library reads their images when a frame's first recording is
    /// executed, in the layout `SHADER_READ_ONLY_OPTIMAL`, and keeps a copy of their alpha.
    pub alpha_maps: Vec<AlphaMap>,
    /// Whether draws may be [blended](super::Draw::blended).
    pub blended: bool,
    /// Lists of draws that the device writes, in addition to the [draws](super::Draw) of a recording. They have
    /// capacities of their own.
    pub indirect: Vec<IndirectDraws>,
    /// Largest total number of triangles of a recording's draws. 0 is possible if there are indirect draws.
    pub triangle_capacity: u32,
    /// Largest number of a recording's draws. 0 is possible if there are indirect draws.
    pub draw_capacity: u32,
    /// Number of shading keys, 1 to 16,383.
    pub keys: u32,
    /// Conventions of clip space.
    pub clip: ClipSpace,
}

/// Largest number of shading keys: the engine adds one key, and a triangle has 14 bits for its key.
const MOST_KEYS: u32 = (1 << 14) - 1;
/// Largest number of triangles: the device counts triangle corners in 32 bits.
const MOST_TRIANGLES: u32 = u32::MAX / 3;
/// Largest number of meshes: each has its own descriptor sets.
const MOST_MESHES: u32 = 1 << 16;

impl Geometry {
    pub(super) fn check(&self, gpu: &Gpu) -> Result<(), HostError> {
        let limits = gpu.limits();
        let meshes = u32::try_from(self.meshes.len()).unwrap_or(u32::MAX);
        HostError::check_count(Member::MeshCount, meshes, MOST_MESHES)?;
        let texels = limits.max_texel_elements.min(u64::from(u32::MAX)) as u32;
        let most_vertices = match self.position_space {
            PositionSpace::Clip => texels,
            PositionSpace::Object { .. } => u32::MAX,
        };
        for (number, mesh) in self.meshes.iter().enumerate() {
            let checked = mesh.check(self.position_space, most_vertices, limits);
            checked.map_err(|error| self.in_mesh(number, error))?;
        }
        let positions = match self.position_space {
            PositionSpace::Clip => Member::AllVertices,
            PositionSpace::Object { .. } => Member::PositionCapacity,
        };
        // Without draws of the CPU there may be draws of the device.
        let may_lack = !self.indirect.is_empty();
        for (member, found, most, may_be_0) in [
            (positions, self.position_capacity(), texels, may_lack),
            (Member::TriangleCapacity, self.triangle_capacity, texels.min(MOST_TRIANGLES), may_lack),
            (Member::DrawCapacity, self.draw_capacity, 1 << 24, may_lack),
            (Member::Keys, self.keys, MOST_KEYS, false),
        ] {
            if !(may_be_0 && found == 0) {
                HostError::check_count(member, found, most)?;
            }
        }
        for (number, list) in self.indirect.iter().enumerate() {
            list.check(self, limits).map_err(|error| error.at(Place::Indirect(number)))?;
        }
        for (what, needed, limit) in [
            ("triangles of all draws", self.all_triangles(), texels.min(MOST_TRIANGLES)),
            ("positions of all draws", self.all_positions(), texels),
            ("draws and indirect draws", self.all_draws(), 1 << 25),
        ] {
            VulkanError::check_limit(what, needed, "elements", u64::from(limit))?;
        }
        let [least, most] = self.clip.depth_range;
        if !(least.is_finite() && most.is_finite() && least != most) {
            return Err(HostError::DepthRange([least, most]));
        }
        self.check_alpha(limits)
    }

    fn check_alpha(&self, limits: &Limits) -> Result<(), HostError> {
        if self.alpha_maps.is_empty() {
            return Ok(());
        }
        let maps = u32::try_from(self.alpha_maps.len()).unwrap_or(u32::MAX);
        HostError::check_count(Member::AlphaMapCount, maps, MOST_MAPS)?;
        for (number, map) in self.alpha_maps.iter().enumerate() {
            map.check().map_err(|error| error.at(Place::AlphaMap(number)))?;
        }
        if self.meshes.iter().all(|mesh| mesh.coordinates.is_none()) {
            return Err(HostError::NoCoordinates);
        }
        for (number, mesh) in self.meshes.iter().enumerate() {
            let checked = mesh.check_coordinates(limits);
            checked.map_err(|error| self.in_mesh(number, error))?;
        }
        Ok(())
    }

    /// The mesh that a member names by its index.
    pub(super) fn mesh(&self, member: Member, index: u32) -> Result<&Mesh, HostError> {
        let count = self.meshes.len() as u32;
        let found = self.meshes.get(index as usize);
        found.ok_or(HostError::Index { member, found: index, count, by: Member::Meshes })
    }

    /// Adds the index of the mesh to an error, if there are several meshes.
    fn in_mesh(&self, mesh: usize, error: HostError) -> HostError {
        match self.meshes.len() {
            1 => error,
            _ => error.at(Place::Mesh(mesh)),
        }
    }

    /// Whether passes can read positions in place, from the buffer of a single mesh.
    pub(super) fn is_read_in_place(&self, limits: &Limits) -> bool {
        match self.meshes.as_slice() {
            [mesh] => mesh.is_read_in_place(self.position_space, limits),
            _ => false,
        }
    }

    /// First position of each mesh, counted over the positions of all meshes, if positions are in clip space.
    pub(super) fn first_positions(&self) -> impl Iterator<Item = u32> {
        self.meshes.iter().scan(0_u32, |next, mesh| {
            let first = *next;
            *next = first.saturating_add(mesh.vertex_capacity);
            Some(first)
        })
    }

    /// Places for triangles of all draws.
    pub(super) fn all_triangles(&self) -> u64 {
        let lists = self.indirect.iter().map(|list| u64::from(list.triangle_capacity));
        u64::from(self.triangle_capacity) + lists.sum::<u64>()
    }

    /// Places for draws.
    pub(super) fn all_draws(&self) -> u64 {
        u64::from(self.draw_capacity) + self.indirect.iter().map(IndirectDraws::draws).sum::<u64>()
    }

    /// Places for positions in clip space.
    pub(super) fn all_positions(&self) -> u64 {
        let lists = self.indirect.iter().map(|list| list.positions(self.position_space));
        u64::from(self.position_capacity()) + lists.sum::<u64>()
    }

    /// Largest number of positions in clip space, without those of indirect draws.
    pub(super) fn position_capacity(&self) -> u32 {
        match self.position_space {
            PositionSpace::Clip => {
                let counts = self.meshes.iter().map(|mesh| mesh.vertex_capacity);
                counts.fold(0, u32::saturating_add)
            }
            PositionSpace::Object { capacity } => capacity,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reversed depth (larger is nearer) for the clip-space depth `z`, computed from the value that the depth image
    /// holds.
    fn by_image(clip: ClipSpace, z: f32) -> f32 {
        let [least, most] = clip.depth_range;
        let held = least + (most - least) * z;
        let [factor, constant] = clip.depth_of_image();
        factor * held + constant
    }

    #[test]
    fn depth_ranges_change_what_the_image_holds_alone() {
        for depth_range in [[0.0, 1.0], [0.25, 0.75], [1.0, 0.0], [0.5, 0.25]] {
            let clip = ClipSpace { depth_range, ..ClipSpace::default() };
            let reversed = ClipSpace { reversed_depth: true, ..clip };
            for z in [0.0, 0.125, 0.5, 1.0] {
                assert_eq!(by_image(clip, z), 1.0 - z, "{depth_range:?}");
                assert_eq!(by_image(reversed, z), z, "{depth_range:?}");
            }
        }
        assert_eq!(ClipSpace::default().depth_of_image(), [-1.0, 1.0]);
    }
}
