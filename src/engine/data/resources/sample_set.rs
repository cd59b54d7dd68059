//! Sample offsets on the device, and the descriptor sets of the passes that read them.

use crate::engine::data::FrameUniform;
use crate::engine::data::upload::Upload;
use crate::vulkan::{
    Buffer, DescriptorSets, Memory, MemoryUse, Recorder, TexelBuffer, VulkanError,
};
use ash::vk;

/// Sample offsets from the pixel's centre, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offsets<'a> {
    /// Offsets of a cell's samples, followed by the offsets of the first run with few samples, if there is one.
    pub all: &'a [[f32; 2]],
    /// Number of samples of a cell.
    pub count: u32,
}

/// Sample offsets, and the descriptor sets that contain them.
pub struct SampleSet {
    pub(crate) uniform: Buffer,
    pub(crate) offsets: TexelBuffer,
    pub(crate) upload: Upload,
    count: u32,
    /// Descriptor sets of the passes.
    pub(crate) sets: DescriptorSets,
}

impl SampleSet {
    /// Allocates a list of offsets and its uniform block, for sets that show nothing yet.
    pub(crate) fn new(
        memory: &Memory,
        sets: DescriptorSets,
        Offsets { all, count }: &Offsets<'_>,
    ) -> Result<Self, VulkanError> {
        let mut content = all.to_vec();
        content.extend(sums_of_runs(all, *count));
        let offsets = memory.texel_buffer(
            "offsets of sub-samples",
            content.len() as u64,
            vk::Format::R32G32_SFLOAT,
            vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER
                | vk::BufferUsageFlags::UNIFORM_BUFFER
                | vk::BufferUsageFlags::TRANSFER_DST,
            MemoryUse::Device,
        )?;
        let upload = Upload::new(
            memory,
            "location upload",
            &offsets.buffer,
            bytemuck::cast_slice(&content),
        )?;
        Ok(Self {
            uniform: memory.buffer(
                "frame uniform",
                size_of::<FrameUniform>().next_multiple_of(16) as u64,
                vk::BufferUsageFlags::UNIFORM_BUFFER | vk::BufferUsageFlags::TRANSFER_DST,
                MemoryUse::Device,
            )?,
            offsets,
            upload,
            count: *count,
            sets,
        })
    }

    /// Has passes that `recorder` records from now on use these offsets, and the memory that the sets show.
    pub fn show(&self, recorder: &Recorder<'_>) {
        recorder.show(&self.sets);
    }

    /// Number of sample offsets of a cell.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.count
    }
}

/// Number of samples that fit into a mask of `shaders/include/mask.glsl`.
const MASK: usize = 64;
/// Number of consecutive samples whose sums are tabulated.
const RUN: usize = 4;

/// Table of sums of sample offsets, with 16 entries for each run of four consecutive samples. Entry n of a run is the
/// sum of the offsets whose bits are set in n. The table has 16 runs for the first 64 samples, and one run of zeros
/// after them.
fn sums_of_runs(all: &[[f32; 2]], count: u32) -> Vec<[f32; 2]> {
    let known = &all[..all.len().min(count as usize).min(MASK)];
    let numbers =
        (0..(MASK + RUN) / RUN).flat_map(|run| (0..1_usize << RUN).map(move |bits| (run, bits)));
    numbers
        .map(|(run, bits)| {
            let named = known.iter().skip(run * RUN).take(RUN).enumerate();
            named
                .filter(|(place, _)| bits >> place & 1 == 1)
                .fold([0.0; 2], |[x, y], (_, at)| [x + at[0], y + at[1]])
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_runs_are_those_of_the_samples_that_bits_name() {
        let offsets: Vec<[f32; 2]> = (0..100).map(|n| [1.0, (n * n) as f32]).collect();
        for count in [1, 5, 64, 100] {
            let sums = sums_of_runs(&offsets, count);
            assert_eq!(sums.len(), 17 * 16);
            let number = |sample: usize| sample / 4 * 16 + (1 << (sample % 4));
            for sample in 0..64 {
                let known = sample < count as usize;
                let expected = if known { offsets[sample] } else { [0.0; 2] };
                assert_eq!(sums[number(sample)], expected);
            }
            let first: [f32; 2] =
                [0, 1].map(|axis| (0..4.min(count as usize)).map(|n| offsets[n][axis]).sum());
            assert_eq!(sums[15], first);
            assert_eq!(sums[16 * 16 + 15], [0.0; 2]);
        }
    }
}
