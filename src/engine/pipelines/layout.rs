//! Layouts of all passes, and a cache of pipelines.

use super::Kernel;
use super::cache::Pipelines;
use crate::engine::spirv::INTERFACES;
use crate::vulkan::{
    BoundDescriptor, Compiled, Constants, DescriptorSets, Gpu, Interface, PassLayout, Pipeline, SetLayout,
    SharedLayout, Specialized, VulkanError, compute_pipeline,
};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Layouts of all passes, and a cache of pipelines.
pub struct FrameLayout {
    pub(crate) gpu: Arc<Gpu>,
    /// Layouts by the name of the pass.
    passes: BTreeMap<&'static str, Arc<PassLayout>>,
    /// Layouts of the sets of a frame.
    of_frame: Vec<Arc<SetLayout>>,
    pipelines: Mutex<Pipelines>,
}

impl FrameLayout {
    /// Makes the layouts.
    ///
    /// # Errors
    /// [`VulkanError::Call`] if the driver refuses them.
    pub(crate) fn new(gpu: &Arc<Gpu>) -> Result<Arc<Self>, VulkanError> {
        let mut shaders: BTreeMap<&'static str, Vec<&Interface>> = BTreeMap::new();
        for interface in INTERFACES {
            shaders.entry(interface.pass()).or_default().push(interface);
        }
        let in_frame = INTERFACES.into_iter().filter(|shader| shader.in_frame);
        let shared = SharedLayout::new(gpu, &in_frame.collect::<Vec<_>>())?;
        let mut of_frame = vec![shared.set.clone()];
        let mut passes = BTreeMap::new();
        for (name, shaders) in shaders {
            let in_frame = shaders.iter().any(|shader| shader.in_frame);
            let pass = PassLayout::new(gpu, &shaders, in_frame.then_some(&shared))?;
            of_frame.extend(pass.sets.get(1).filter(|_| in_frame).cloned());
            passes.insert(name, Arc::new(pass));
        }
        Ok(Arc::new(Self {
            gpu: gpu.clone(),
            passes,
            of_frame,
            pipelines: Mutex::new(Pipelines::new(gpu.limits().max_unused_pipelines)),
        }))
    }

    /// Layouts of the pass to which a shader belongs.
    pub(crate) fn of(&self, shader: &Interface) -> &Arc<PassLayout> {
        &self.passes[shader.pass()]
    }

    /// Makes `count` times the sets that the passes of a frame share.
    ///
    /// # Errors
    /// If the driver refuses them.
    pub(crate) fn frame_sets(&self, count: usize) -> Result<Vec<DescriptorSets>, VulkanError> {
        DescriptorSets::new(&self.gpu, true, &self.of_frame, count)
    }

    /// Makes `count` copies of the sets that the passes of these shaders have besides those of the frame.
    ///
    /// # Errors
    /// If the driver refuses them.
    pub(crate) fn own_sets(&self, shaders: &[&Interface], count: usize) -> Result<Vec<DescriptorSets>, VulkanError> {
        let own = |shader: &&Interface| {
            let number = if shader.in_frame { 2 } else { 0 };
            self.of(shader).sets[number].clone()
        };
        let layouts: Vec<_> = shaders.iter().map(own).collect();
        DescriptorSets::new(&self.gpu, false, &layouts, count)
    }

    /// Makes the set that the pass of a shader has besides those of the frame; it shows these buffers.
    ///
    /// # Errors
    /// If the driver refuses it.
    ///
    /// # Safety
    /// The buffers outlive the use of the set.
    pub(crate) unsafe fn own_set(
        &self,
        shader: &Interface,
        shown: &[BoundDescriptor],
    ) -> Result<DescriptorSets, VulkanError> {
        let mut own = self.own_sets(&[shader], 1)?.remove(0);
        // SAFETY: the set is new; the caller guarantees the buffers.
        unsafe { own.write(shown) };
        Ok(own)
    }

    /// Kernel of a compute shader of the crate.
    ///
    /// # Errors
    /// If the driver refuses the pipeline.
    pub(crate) fn kernel<S: Compiled>(&self, shader: &S) -> Result<Kernel<S>, VulkanError> {
        self.kernel_variant(S::code(), shader)
    }

    /// Kernel of a variant of a compute shader of the crate.
    ///
    /// # Errors
    /// If the driver refuses the pipeline.
    pub(crate) fn kernel_variant<S: Specialized>(
        &self,
        code: &'static [u8],
        shader: &S,
    ) -> Result<Kernel<S>, VulkanError> {
        let constants = &shader.constants();
        let by_teams = S::INTERFACE.by_teams;
        let teams = self.gpu.limits().teams;
        let subgroup = teams.preferred_subgroup.filter(|_| by_teams);
        let made = || compute_pipeline(self.of(S::INTERFACE), code, S::INTERFACE, constants, subgroup);
        Ok(Kernel::new(self.cached(code, constants, subgroup.unwrap_or(0), made)?))
    }

    /// Pipeline for a shader, constants and variant, from the cache or made by `make`.
    pub(crate) fn cached(
        &self,
        code: &'static [u8],
        constants: &Constants,
        variant: u32,
        make: impl FnOnce() -> Result<Pipeline, VulkanError>,
    ) -> Result<Arc<Pipeline>, VulkanError> {
        let key = (code.as_ptr() as usize, constants.clone(), variant);
        let known = || self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(pipeline) = known().get(&key) {
            return Ok(pipeline);
        }
        // The lock is not held here, so that several threads can make pipelines in parallel.
        let made = make()?;
        Ok(known().add(key, made))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::spirv::gpc_visibility_set;
    use crate::vulkan::{Binding, Requirements};
    use ash::vk::DescriptorType as T;

    #[test]
    fn devices_are_asked_for_as_many_descriptors_as_a_stage_has() {
        let of_stages = INTERFACES.iter().map(|shader| {
            let bindings = shader.uses.iter().map(|used| used.binding);
            bindings.collect::<Vec<_>>()
        });
        let all: Vec<_> = of_stages.chain([gpc_visibility_set::ALL.to_vec()]).collect();
        let most = |kinds: &[T]| {
            let count = |stage: &Vec<Binding>| {
                let counted = stage.iter().filter(|binding| kinds.contains(&binding.kind));
                counted.map(|binding| binding.count).sum::<u32>()
            };
            all.iter().map(count).max().unwrap()
        };
        let images = [T::SAMPLED_IMAGE, T::COMBINED_IMAGE_SAMPLER, T::UNIFORM_TEXEL_BUFFER];
        assert_eq!(most(&[T::STORAGE_BUFFER]), Requirements::STORAGE_BUFFERS);
        assert_eq!(most(&images), Requirements::SAMPLED_IMAGES);
        // Every device supports 4 storage images, 12 uniform buffers, 16 samplers, and 128 resources of a stage.
        assert!(most(&[T::STORAGE_TEXEL_BUFFER]) <= 4);
        assert!(most(&[T::UNIFORM_BUFFER]) <= 12);
        assert!(most(&[T::COMBINED_IMAGE_SAMPLER]) <= 16);
        let resources = [T::STORAGE_BUFFER, T::UNIFORM_BUFFER, T::STORAGE_TEXEL_BUFFER];
        assert!(most(&[&resources[..], &images].concat()) < 128);
    }
}
