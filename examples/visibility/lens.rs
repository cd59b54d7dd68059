//! The scene through a magnifying glass: a shader of the host writes locations, which are sampled instead of pixels.

use crate::Failure;
use crate::device::{Device, Image};
use crate::meshes::World;
use crate::pipelines::{Pipelines, spirv};
use crate::slot::Slot;
use ash::vk;
use gpc::host::{Antialiaser, List, ListOptions, Location, LocationList, Options};

/// Largest number of locations of a recording.
const MOST_LOCATIONS: u32 = 1 << 21;

/// Push constants, as in `shaders/lens.comp`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::NoUninit)]
struct Push {
    size: [u32; 2],
    side: u32,
    first_row: u32,
}

/// Shader that writes the locations, and the scene that they show, in the pose that a slot last gave it.
pub struct Lens<'a> {
    device: &'a Device,
    antialiaser: &'a Antialiaser,
    world: &'a World<'a>,
    pipelines: &'a Pipelines<'a>,
    slot: &'a Slot<'a>,
    set_layout: vk::DescriptorSetLayout,
    pool: vk::DescriptorPool,
    set: vk::DescriptorSet,
    layout: vk::PipelineLayout,
    pipeline: vk::Pipeline,
}

impl<'a> Lens<'a> {
    /// Makes the pipeline. The slot's commands must have run.
    pub fn new(
        device: &'a Device,
        antialiaser: &'a Antialiaser,
        (world, pipelines, slot): (&'a World<'a>, &'a Pipelines<'a>, &'a Slot<'a>),
    ) -> Result<Self, Failure> {
        let raw = &device.raw;
        // SAFETY: plain creations whose structures live until after the calls. Handles that were made before a failure
        // leak, but the program ends then.
        unsafe {
            let bindings = [vk::DescriptorSetLayoutBinding::default()
                .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                .descriptor_count(1)
                .stage_flags(vk::ShaderStageFlags::COMPUTE)];
            let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
            let layouts = [raw.create_descriptor_set_layout(&info, None)?];
            let sizes = [vk::DescriptorPoolSize { ty: vk::DescriptorType::STORAGE_BUFFER, descriptor_count: 1 }];
            let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
            let pool = raw.create_descriptor_pool(&info, None)?;
            let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
            let set = raw.allocate_descriptor_sets(&info)?[0];
            let push = [vk::PushConstantRange {
                stage_flags: vk::ShaderStageFlags::COMPUTE,
                offset: 0,
                size: size_of::<Push>() as u32,
            }];
            let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts).push_constant_ranges(&push);
            let layout = raw.create_pipeline_layout(&info, None)?;
            Ok(Self {
                device,
                antialiaser,
                world,
                pipelines,
                slot,
                set_layout: layouts[0],
                pool,
                set,
                layout,
                pipeline: device.compute(spirv!("lens"), layout, 0)?,
            })
        }
    }

    /// Picture through the lens, in the size of the options; each pixel is the mean of `side` x `side` locations.
    pub fn picture(&self, options: &Options, side: u32) -> Result<Image, Failure> {
        let [width, height] = options.size;
        let row = width * side * side;
        let most_rows = (MOST_LOCATIONS / row).clamp(1, height);
        let capacity = most_rows * row;
        let bytes = size_of::<Location>() as u64 * u64::from(capacity);
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER;
        let locations = self.device.buffer(bytes, usage)?;
        let usage = vk::BufferUsageFlags::TRANSFER_DST;
        let colors = self.device.buffer(16 * u64::from(capacity), usage)?;
        let lent = LocationList { locations: locations.raw, offset: 0, capacity, colors: colors.raw, colors_offset: 0 };
        let geometry = self.slot.geometry(self.world);
        // SAFETY: the buffers have the stated contents, and outlive the list.
        let mut list = unsafe { self.antialiaser.prepare_list(&geometry, &lent, &ListOptions::from(options)) }?;
        let info = [vk::DescriptorBufferInfo::default().buffer(locations.raw).range(vk::WHOLE_SIZE)];
        let writes = [vk::WriteDescriptorSet::default()
            .dst_set(self.set)
            .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
            .buffer_info(&info)];
        // SAFETY: commands that used the set were waited for; the buffer outlives those that will use it.
        unsafe { self.device.raw.update_descriptor_sets(&writes, &[]) };

        let mut picture = Image { size: options.size, colors: Vec::new() };
        for first_row in (0..height).step_by(most_rows as usize) {
            let rows = most_rows.min(height - first_row);
            let count = rows * row;
            let push = Push { size: options.size, side, first_row };
            self.device.run(|commands| {
                // SAFETY: the commands are waited for, and everything that they use outlives them.
                unsafe { self.record(commands, &mut list, &push, count) }
            })?;
            let outcome = list.outcome()?;
            if outcome.left_over + u64::from(outcome.left_out) > 0 {
                return Err(format!("the lens left locations out: {outcome:?}").into());
            }
            let seen = &colors.colors()?[..count as usize];
            let part = Image::means(seen, [width, rows], side);
            picture.colors.extend(part.colors);
        }
        Ok(picture)
    }

    /// Records writing the locations and sampling them.
    unsafe fn record(
        &self,
        commands: vk::CommandBuffer,
        list: &mut List,
        push: &Push,
        count: u32,
    ) -> Result<(), Failure> {
        let raw = &self.device.raw;
        let compute = vk::PipelineBindPoint::COMPUTE;
        let bytes = bytemuck::bytes_of(push);
        let materials = self.slot.materials(self.pipelines);
        // SAFETY: guaranteed by the caller.
        unsafe {
            raw.cmd_bind_pipeline(commands, compute, self.pipeline);
            raw.cmd_bind_descriptor_sets(commands, compute, self.layout, 0, &[self.set], &[]);
            raw.cmd_push_constants(commands, self.layout, vk::ShaderStageFlags::COMPUTE, 0, bytes);
            raw.cmd_dispatch(commands, count.div_ceil(64), 1, 1);
            list.record(commands, &self.world.draws, count, &materials)?;
            self.device.show_to_host(commands);
        }
        Ok(())
    }
}

impl Drop for Lens<'_> {
    fn drop(&mut self) {
        let raw = &self.device.raw;
        // SAFETY: every submission was waited for.
        unsafe {
            raw.destroy_pipeline(self.pipeline, None);
            raw.destroy_pipeline_layout(self.layout, None);
            raw.destroy_descriptor_pool(self.pool, None);
            raw.destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}
