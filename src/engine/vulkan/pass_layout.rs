//! Layouts of a pass, which follow from the interfaces of its shaders.

use super::{Binding, Gpu, Interface, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Layout of a descriptor set.
pub(crate) struct SetLayout {
    gpu: Arc<Gpu>,
    pub(crate) raw: vk::DescriptorSetLayout,
    pub(super) bindings: Vec<Binding>,
}

impl SetLayout {
    /// Makes the layout of a set with these bindings, each of which the named stages see.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(gpu: &Arc<Gpu>, bindings: &[SeenBinding]) -> Result<Self, VulkanError> {
        let layouts: Vec<_> = bindings
            .iter()
            .map(|(binding, stages)| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding.number)
                    .descriptor_type(binding.kind)
                    .descriptor_count(binding.count)
                    .stage_flags(*stages)
            })
            .collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&layouts);
        // SAFETY: plain creation on a live device.
        let raw = unsafe { gpu.device.create_descriptor_set_layout(&info, None) }
            .map_err(VulkanError::of("vkCreateDescriptorSetLayout"))?;
        Ok(Self { gpu: gpu.clone(), raw, bindings: bindings.iter().map(|(binding, _)| *binding).collect() })
    }
}

impl Drop for SetLayout {
    fn drop(&mut self) {
        // SAFETY: pipelines and sets that were made with the layout keep it alive.
        unsafe { self.gpu.device.destroy_descriptor_set_layout(self.raw, None) };
    }
}

/// Set 0 and push constants that several passes have in common, so that they stay bound and pushed between them.
pub(crate) struct SharedLayout {
    /// Layout of set 0.
    pub set: Arc<SetLayout>,
    push: vk::PushConstantRange,
}

impl SharedLayout {
    /// Makes the common beginning of the layouts of passes with these shaders.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(gpu: &Arc<Gpu>, shaders: &[&Interface]) -> Result<Self, VulkanError> {
        let (sets, push) = needs(shaders);
        let set = Arc::new(SetLayout::new(gpu, &sets[0])?);
        Ok(Self { set, push })
    }
}

/// Layouts of a pass: of its pipelines, and of the descriptor sets that they use. These have the bindings that the
/// pass's shaders use, and no others, apart from a set that is shared.
pub(crate) struct PassLayout {
    pub(super) gpu: Arc<Gpu>,
    pub(super) raw: vk::PipelineLayout,
    /// Layouts of the sets by number.
    pub(crate) sets: Vec<Arc<SetLayout>>,
    pub(super) push: vk::PushConstantRange,
}

impl PassLayout {
    /// Makes the layouts of a pass with these shaders: a compute shader, or a vertex and a fragment shader.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(gpu: &Arc<Gpu>, shaders: &[&Interface], shared: Option<&SharedLayout>) -> Result<Self, VulkanError> {
        let (sets, own_push) = needs(shaders);
        let push = shared.map_or(own_push, |shared| shared.push);
        let sets = sets.iter().enumerate().map(|(number, set)| match shared {
            Some(shared) if number == 0 => Ok(shared.set.clone()),
            _ => Ok(Arc::new(SetLayout::new(gpu, set)?)),
        });
        let sets = sets.collect::<Result<Vec<_>, VulkanError>>()?;
        let raw_sets: Vec<_> = sets.iter().map(|set| set.raw).collect();
        let ranges = [push];
        let info = vk::PipelineLayoutCreateInfo::default()
            .set_layouts(&raw_sets)
            .push_constant_ranges(if push.size > 0 { &ranges } else { &[] });
        // SAFETY: plain creation on a live device.
        let raw = unsafe { gpu.device.create_pipeline_layout(&info, None) }
            .map_err(VulkanError::of("vkCreatePipelineLayout"))?;
        Ok(Self { gpu: gpu.clone(), raw, sets, push })
    }
}

impl Drop for PassLayout {
    fn drop(&mut self) {
        // SAFETY: pipelines that were made with the layout keep it alive.
        unsafe { self.gpu.device.destroy_pipeline_layout(self.raw, None) };
    }
}

/// Binding of a set, with the stages that see it.
type SeenBinding = (Binding, vk::ShaderStageFlags);

/// Bindings that shaders use, by the number of the set, and the range of their push constants.
fn needs(shaders: &[&Interface]) -> (Vec<Vec<SeenBinding>>, vk::PushConstantRange) {
    let mut sets: Vec<Vec<SeenBinding>> = vec![Vec::new()];
    let mut push = vk::PushConstantRange::default();
    for shader in shaders {
        for used in shader.uses {
            let number = used.set as usize;
            sets.resize(sets.len().max(number + 1), Vec::new());
            let mut known = sets[number].iter_mut();
            match known.find(|(known, _)| *known == used.binding) {
                Some((_, stages)) => *stages |= shader.stage(),
                None => sets[number].push((used.binding, shader.stage())),
            }
        }
        if shader.push_bytes > 0 {
            push.stage_flags |= shader.stage();
            push.size = push.size.max(shader.push_bytes);
        }
    }
    (sets, push)
}
