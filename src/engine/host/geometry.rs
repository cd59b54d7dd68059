//! What a host lends for all of its frames' draws.

use super::alpha::{AlphaMap, MOST_MAPS};
use super::{HostError, Mesh};
use crate::vulkan::{Gpu, Limits};

/// How the host's clip space lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipSpace {
    /// Whether y points up, as with a viewport of negative height; otherwise down, as Vulkan has it.
    pub y_up: bool,
    /// Whether depth runs from 1 near to 0 far; otherwise from 0 to 1.
    pub reversed_depth: bool,
    /// What the image of depth holds where depth in clip space is 0, and where it is 1: `minDepth` and `maxDepth` of the host's
    /// viewport. They differ.
    pub depth_range: [f32; 2],
}

impl Default for ClipSpace {
    /// As Vulkan has it, with a viewport of positive height and a depth range from 0 to 1.
    fn default() -> Self {
        Self {
            y_up: false,
            reversed_depth: false,
            depth_range: [0.0, 1.0],
        }
    }
}

impl ClipSpace {
    /// Factor and constant that lead from what the image of depth holds to depth that is larger where it is nearer.
    pub(super) fn depth_of_image(&self) -> [f32; 2] {
        let [least, most] = self.depth_range;
        let (factor, constant) = (1.0 / (most - least), -least / (most - least));
        if self.reversed_depth {
            [factor, constant]
        } else {
            [-factor, 1.0 - constant]
        }
    }
}

/// What positions are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PositionSpace {
    /// Four floats in clip space: the very values that the host's vertex shader outputs.
    Clip,
    /// Three floats in a space of each draw's own, from which [`Draw::to_clip`](super::Draw::to_clip) leads to clip space.
    Object {
        /// Most vertices of all draws of a frame, those that several draws have counted for each.
        capacity: u32,
    },
}

/// Buffers of a host. They may hold something else in every frame; the engine reads them when a recording is executed.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry {
    /// What draws read: each names one of them.
    pub meshes: Vec<Mesh>,
    /// What positions are.
    pub position_space: PositionSpace,
    /// What draws are tested by that are not opaque. The library reads the images, in `SHADER_READ_ONLY_OPTIMAL`, when a
    /// frame's first recording is executed, and keeps what they hold then.
    pub alpha_maps: Vec<AlphaMap>,
    /// Whether draws may be [blended](super::Draw::blended).
    pub blended: bool,
    /// Most triangles of all draws of a frame.
    pub triangle_capacity: u32,
    /// Most draws of a frame.
    pub draw_capacity: u32,
    /// How many shading keys there are, 1 to 16,383.
    pub keys: u32,
    /// How clip space lies.
    pub clip: ClipSpace,
}

/// Most shading keys: there is one more within, and 14 bits for all.
const MOST_KEYS: u32 = (1 << 14) - 1;
/// Most triangles: the device counts corners in 32 bits.
const MOST_TRIANGLES: u32 = u32::MAX / 3;
/// Most meshes: each has descriptor sets of its own.
const MOST_MESHES: u32 = 1 << 16;

impl Geometry {
    pub(super) fn check(&self, gpu: &Gpu) -> Result<(), HostError> {
        let limits = gpu.limits();
        let meshes = u32::try_from(self.meshes.len()).unwrap_or(u32::MAX);
        HostError::check_count("the number of meshes", meshes, MOST_MESHES)?;
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
            PositionSpace::Clip => "vertices of all meshes",
            PositionSpace::Object { .. } => "the capacity of positions in object space",
        };
        for (what, found, most) in [
            (positions, self.position_capacity(), texels),
            (
                "triangle_capacity",
                self.triangle_capacity,
                texels.min(MOST_TRIANGLES),
            ),
            ("draw_capacity", self.draw_capacity, 1 << 24),
            ("keys", self.keys, MOST_KEYS),
        ] {
            HostError::check_count(what, found, most)?;
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
        HostError::check_count("the number of alpha maps", maps, MOST_MAPS)?;
        for (number, map) in self.alpha_maps.iter().enumerate() {
            map.check(number)?;
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

    /// Says which of several meshes an error is of.
    fn in_mesh(&self, mesh: usize, error: HostError) -> HostError {
        match self.meshes.len() {
            1 => error,
            _ => HostError::Mesh {
                mesh,
                error: Box::new(error),
            },
        }
    }

    /// Whether passes can read positions where they are: those of a single mesh.
    pub(super) fn is_read_in_place(&self, limits: &Limits) -> bool {
        match self.meshes.as_slice() {
            [mesh] => mesh.is_read_in_place(self.position_space, limits),
            _ => false,
        }
    }

    /// Where positions are in clip space, the first one of each mesh among those of all.
    pub(super) fn first_positions(&self) -> impl Iterator<Item = u32> {
        self.meshes.iter().scan(0_u32, |next, mesh| {
            let first = *next;
            *next = first.saturating_add(mesh.vertex_capacity);
            Some(first)
        })
    }

    /// How many positions in clip space there can be.
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

    /// Depth that is larger where it is nearer, of depth `z` in clip space, by the image of depth.
    fn by_image(clip: ClipSpace, z: f32) -> f32 {
        let [least, most] = clip.depth_range;
        let held = least + (most - least) * z;
        let [factor, constant] = clip.depth_of_image();
        factor * held + constant
    }

    #[test]
    fn depth_ranges_change_what_the_image_holds_alone() {
        for depth_range in [[0.0, 1.0], [0.25, 0.75], [1.0, 0.0], [0.5, 0.25]] {
            let clip = ClipSpace {
                depth_range,
                ..ClipSpace::default()
            };
            let reversed = ClipSpace {
                reversed_depth: true,
                ..clip
            };
            for z in [0.0, 0.125, 0.5, 1.0] {
                assert_eq!(by_image(clip, z), 1.0 - z, "{depth_range:?}");
                assert_eq!(by_image(reversed, z), z, "{depth_range:?}");
            }
        }
        assert_eq!(ClipSpace::default().depth_of_image(), [-1.0, 1.0]);
    }
}
