//! Formats of a host's vertex attributes.

use super::{HostError, Member};
use crate::engine::spirv;
use ash::vk;

/// Format of a vertex attribute: that of `VkVertexInputAttributeDescription`, with a scale and a bias. A component is
/// `bias + scale * number`, where `number` is the number in the buffer, which normalised formats have divided by the
/// largest integer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexFormat {
    /// Type of the components: 32-bit floats (`SFLOAT`), or 16-bit `SFLOAT`, `UNORM` or `SNORM`. The format may have more
    /// components than are read.
    pub format: vk::Format,
    /// Factor on each component.
    pub scale: [f32; 3],
    /// Summand of each component.
    pub bias: [f32; 3],
}

impl VertexFormat {
    /// 32-bit floats, taken as they are.
    pub const FLOAT: Self = Self::of(vk::Format::R32G32B32_SFLOAT);

    /// A format whose numbers are taken as they are.
    #[must_use]
    pub const fn of(format: vk::Format) -> Self {
        Self { format, scale: [1.0; 3], bias: [0.0; 3] }
    }

    /// Number of components of the format, and the constant of the shaders for their type; `None` for a format that they
    /// can't read.
    fn components(self) -> Option<(u32, u32)> {
        let found = match self.format {
            vk::Format::R32G32_SFLOAT => (2, spirv::VERTEX_FLOAT),
            vk::Format::R32G32B32_SFLOAT => (3, spirv::VERTEX_FLOAT),
            vk::Format::R32G32B32A32_SFLOAT => (4, spirv::VERTEX_FLOAT),
            vk::Format::R16G16_SFLOAT => (2, spirv::VERTEX_HALF),
            vk::Format::R16G16B16_SFLOAT => (3, spirv::VERTEX_HALF),
            vk::Format::R16G16B16A16_SFLOAT => (4, spirv::VERTEX_HALF),
            vk::Format::R16G16_UNORM => (2, spirv::VERTEX_UNORM),
            vk::Format::R16G16B16_UNORM => (3, spirv::VERTEX_UNORM),
            vk::Format::R16G16B16A16_UNORM => (4, spirv::VERTEX_UNORM),
            vk::Format::R16G16_SNORM => (2, spirv::VERTEX_SNORM),
            vk::Format::R16G16B16_SNORM => (3, spirv::VERTEX_SNORM),
            vk::Format::R16G16B16A16_SNORM => (4, spirv::VERTEX_SNORM),
            _ => return None,
        };
        Some(found)
    }

    /// Constant of the shaders for the type of the components.
    pub(super) fn kind(self) -> u32 {
        self.components().map_or(spirv::VERTEX_FLOAT, |(_, kind)| kind)
    }

    /// Bytes of a component.
    pub(super) fn component_bytes(self) -> u32 {
        if self.kind() == spirv::VERTEX_FLOAT { 4 } else { 2 }
    }

    /// Factor with which shaders multiply the numbers in the buffer, which are not normalised.
    pub(super) fn factor(self) -> [f32; 4] {
        let largest = match self.kind() {
            spirv::VERTEX_UNORM => f32::from(u16::MAX),
            spirv::VERTEX_SNORM => f32::from(i16::MAX),
            _ => 1.0,
        };
        let [x, y, z] = self.scale.map(|scale| scale / largest);
        [x, y, z, 0.0]
    }

    /// Checks that the format has `least` components, of a type that shaders can read.
    pub(super) fn check(self, member: Member, least: u32) -> Result<(), HostError> {
        if self.components().is_none_or(|(components, _)| components < least) {
            return Err(HostError::VertexFormat { member, found: self.format, least });
        }
        if !self.scale.iter().chain(&self.bias).all(|n| n.is_finite()) {
            return Err(HostError::VertexScale(member));
        }
        Ok(())
    }
}

impl Default for VertexFormat {
    fn default() -> Self {
        Self::FLOAT
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_that_can_not_be_read_are_named() {
        let check = |format, least| VertexFormat::of(format).check(Member::PositionFormat, least);
        assert!(check(vk::Format::R16G16B16A16_SNORM, 3).is_ok());
        for (format, least) in
            [(vk::Format::R16G16_UNORM, 3), (vk::Format::R8G8B8A8_SNORM, 3), (vk::Format::UNDEFINED, 2)]
        {
            let message = check(format, least).unwrap_err().to_string();
            let start = format!("Mesh::position_format is VK_FORMAT_{format:?}; it can have 32-bit SFLOAT");
            assert!(message.starts_with(&start), "{message}");
        }
        let broken = VertexFormat { scale: [1.0, f32::NAN, 1.0], ..VertexFormat::FLOAT };
        let message = broken.check(Member::PositionFormat, 3).unwrap_err().to_string();
        assert_eq!(message, "Mesh::position_format has a scale or a bias that is not finite");
    }

    #[test]
    fn normalised_numbers_are_parts_of_the_largest_integer() {
        let scaled = VertexFormat { scale: [2.0, 4.0, 1.0], ..VertexFormat::of(vk::Format::R16G16B16_SNORM) };
        assert_eq!(scaled.factor(), [2.0 / 32_767.0, 4.0 / 32_767.0, 1.0 / 32_767.0, 0.0]);
        assert_eq!(VertexFormat::FLOAT.factor(), [1.0, 1.0, 1.0, 0.0]);
    }
}
