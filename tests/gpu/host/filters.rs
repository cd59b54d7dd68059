//! The helpers for hosts' materials: filters of textures that no sampler has, and parts of samples.

use crate::stage::on_gpu;
use crate::submit::submit;
use ash::vk;
use gpc::testing::{Buffer, Image, Memory, MemoryUse, Recorder, memory};
use gpc::vulkan::Gpu;
use std::sync::Arc;

const SIDE: u32 = 16;
const PLACES: usize = 256;
/// Number of places along a side of a parallelogram at which the CPU computes means.
const DENSE: u32 = 96;

type Vec2 = [f64; 2];

/// The middle of a parallelogram in texture coordinates, and its sides.
struct Place([Vec2; 3]);

/// Numbers from 0 to 1 that look random.
fn noise(seed: u32) -> f64 {
    let mut hash = seed.wrapping_mul(0x9e37_79b9) ^ 0x85eb_ca6b;
    for _ in 0..3 {
        hash = (hash ^ hash >> 15).wrapping_mul(0x2c1b_3c6d);
    }
    f64::from(hash >> 8) / f64::from(1 << 24)
}

/// Parallelograms from a fifth of a texel to 6 texels on a side.
fn places() -> Vec<Place> {
    let place = |number: u32| {
        let random = |n| noise(8 * number + n);
        let (turn, skew) = (6.3 * random(0), 0.6 * random(1) + 1.2);
        let [a, b] = [2, 3].map(|n| 0.2 * 30_f64.powf(random(n)) / f64::from(SIDE));
        let middle = [random(4) * 2.0 - 0.5, random(5) * 2.0 - 0.5];
        let side = |length: f64, angle: f64| [length * angle.cos(), length * angle.sin()];
        Place([middle, side(a, turn), side(b, turn + skew)])
    };
    (0..PLACES as u32).map(place).collect()
}

impl Place {
    /// Mean of a function over the parallelogram.
    fn mean(&self, side: u32, of: impl Fn(Vec2) -> [f64; 4]) -> [f64; 4] {
        let Self([middle, dx, dy]) = self;
        let mut sum = [0.0; 4];
        for i in 0..side * side {
            let [u, v] = [i % side, i / side].map(|at| (f64::from(at) + 0.5) / f64::from(side) - 0.5);
            let found = of([0, 1].map(|axis| middle[axis] + u * dx[axis] + v * dy[axis]));
            for channel in 0..4 {
                sum[channel] += found[channel] / f64::from(side * side);
            }
        }
        sum
    }
}

fn texel(x: i64, y: i64) -> [f64; 4] {
    let side = i64::from(SIDE);
    let number = (y.rem_euclid(side) * side + x.rem_euclid(side)) as u32;
    [0, 1, 2, 3].map(|channel| (255.0 * noise(4000 + 4 * number + channel)).round() / 255.0)
}

fn nearest(at: Vec2) -> [f64; 4] {
    let [x, y] = at.map(|at| (at * f64::from(SIDE)).floor() as i64);
    texel(x, y)
}

fn linear(at: Vec2) -> [f64; 4] {
    let at = at.map(|at| at * f64::from(SIDE) - 0.5);
    let [x, y] = at.map(|at| at.floor() as i64);
    let [u, v] = at.map(|at| at - at.floor());
    let corners = [(0, 0, (1.0 - u) * (1.0 - v)), (1, 0, u * (1.0 - v)), (0, 1, (1.0 - u) * v), (1, 1, u * v)];
    let mut sum = [0.0; 4];
    for (right, down, weight) in corners {
        let found = texel(x + right, y + down);
        for channel in 0..4 {
            sum[channel] += weight * found[channel];
        }
    }
    sum
}

fn stripes([u, v]: Vec2) -> [f64; 4] {
    let step = |at: f64| f64::from(u8::from((4.0 * at).rem_euclid(1.0) >= 0.5));
    [step(u), step(v), u * u, v * v]
}

/// Root of the mean square difference.
fn error(found: impl Iterator<Item = [f64; 4]>, expected: impl Iterator<Item = [f64; 4]>) -> f64 {
    let mut sum = 0.0;
    for (found, expected) in found.zip(expected) {
        for channel in 0..4 {
            sum += (found[channel] - expected[channel]).powi(2);
        }
    }
    (sum / (4 * PLACES) as f64).sqrt()
}

#[test]
fn textures_are_averaged_over_what_a_sample_stands_for() {
    on_gpu(|gpu| {
        let places = places();
        let means = means(gpu.gpu(), &places);
        let found = |filter: usize| means.iter().skip(filter).step_by(4).copied();
        let dense = |of: fn(Vec2) -> [f64; 4]| places.iter().map(move |place| place.mean(DENSE, of));
        let at_point = |of: fn(Vec2) -> [f64; 4]| places.iter().map(move |place| place.mean(1, of));
        for (filter, of, most) in [
            (0, linear as fn(Vec2) -> [f64; 4], 0.1),
            (1, nearest as fn(Vec2) -> [f64; 4], 0.13),
            (2, stripes as fn(Vec2) -> [f64; 4], 0.13),
        ] {
            let helped = error(found(filter), dense(of));
            let point = error(at_point(of), dense(of));
            println!("filter {filter}: {helped:.4}, a point {point:.4}");
            assert!(helped < most * point, "{filter}: {helped} of {point}");
        }
    });
}

/// The parts' results have the mean of the whole parallelogram, because together the parts cover it.
#[test]
fn parts_of_a_sample_make_it_up() {
    on_gpu(|gpu| {
        let places = places();
        let means = means(gpu.gpu(), &places);
        for (place, found) in places.iter().zip(means.iter().skip(3).step_by(4)) {
            let Place([_, dx, dy]) = place;
            let area = dx[0] * dy[1] - dx[1] * dy[0];
            let [products, of_position, ..] = place.mean(3, |[u, v]| [u * (1.0 - u - v), u * v, 0.0, 0.0]);
            let expected = [products, of_position, area / 9.0, area];
            for channel in 0..4 {
                let apart = (found[channel] - expected[channel]).abs();
                assert!(apart < 1e-5, "{found:?}, not {expected:?}");
            }
        }
    });
}

/// Output of the shader: four vectors for each place.
fn means(gpu: &Arc<Gpu>, places: &[Place]) -> Vec<[f64; 4]> {
    // SAFETY: the commands that use objects in this memory are waited for.
    let memory = unsafe { memory(gpu, None) };
    let storage = vk::BufferUsageFlags::STORAGE_BUFFER;
    let filled = |bytes: &[u8]| {
        let usage = storage | vk::BufferUsageFlags::TRANSFER_SRC;
        let buffer = memory.buffer("given", bytes.len() as u64, usage, MemoryUse::Upload);
        let mut buffer = buffer.unwrap();
        buffer.bytes_mut()[..bytes.len()].copy_from_slice(bytes);
        buffer
    };
    let numbers: Vec<f32> = (places.iter()).flat_map(|place| place.0.concat()).map(|number| number as f32).collect();
    let given = filled(bytemuck::cast_slice(&numbers));
    let bytes = 64 * places.len() as u64;
    let made = memory.buffer("means", bytes, storage, MemoryUse::Readback);
    let made = made.unwrap();
    let image = image(gpu, &memory, &filled(&texels()));
    let device = gpu.device();
    // SAFETY: the handles are of one device, and are destroyed after the commands have run.
    unsafe {
        let sampler = |filter| {
            let info =
                vk::SamplerCreateInfo::default().mag_filter(filter).min_filter(filter).max_lod(vk::LOD_CLAMP_NONE);
            device.create_sampler(&info, None).unwrap()
        };
        let samplers = [vk::Filter::LINEAR, vk::Filter::NEAREST].map(sampler);
        let kinds = [
            vk::DescriptorType::STORAGE_BUFFER,
            vk::DescriptorType::COMBINED_IMAGE_SAMPLER,
            vk::DescriptorType::COMBINED_IMAGE_SAMPLER,
            vk::DescriptorType::STORAGE_BUFFER,
        ];
        let bindings: Vec<_> = (0..)
            .zip(kinds)
            .map(|(binding, kind)| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding)
                    .descriptor_type(kind)
                    .descriptor_count(1)
                    .stage_flags(vk::ShaderStageFlags::COMPUTE)
            })
            .collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        let set_layouts = [device.create_descriptor_set_layout(&info, None).unwrap()];
        let sizes = kinds.map(|ty| vk::DescriptorPoolSize { ty, descriptor_count: 1 });
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        let pool = device.create_descriptor_pool(&info, None).unwrap();
        let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&set_layouts);
        let sets = device.allocate_descriptor_sets(&info).unwrap();
        let buffers = [&given, &made]
            .map(|buffer| [vk::DescriptorBufferInfo::default().buffer(buffer.handle()).range(vk::WHOLE_SIZE)]);
        let images = samplers.map(|sampler| {
            [vk::DescriptorImageInfo::default()
                .sampler(sampler)
                .image_view(image.view())
                .image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)]
        });
        let write = |binding: usize| {
            vk::WriteDescriptorSet::default()
                .dst_set(sets[0])
                .dst_binding(binding as u32)
                .descriptor_type(kinds[binding])
        };
        let writes = [
            write(0).buffer_info(&buffers[0]),
            write(1).image_info(&images[0]),
            write(2).image_info(&images[1]),
            write(3).buffer_info(&buffers[1]),
        ];
        device.update_descriptor_sets(&writes, &[]);
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&set_layouts);
        let layout = device.create_pipeline_layout(&info, None).unwrap();
        let code = include_bytes!("shaders/spirv/filters.spv");
        let words = ash::util::read_spv(&mut std::io::Cursor::new(code)).unwrap();
        let info = vk::ShaderModuleCreateInfo::default().code(&words);
        let module = device.create_shader_module(&info, None).unwrap();
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module)
            .name(c"main");
        let info = [vk::ComputePipelineCreateInfo::default().stage(stage).layout(layout)];
        let cache = vk::PipelineCache::null();
        let pipeline = device.create_compute_pipelines(cache, &info, None);
        let pipeline = pipeline.unwrap()[0];
        submit(gpu, |commands| {
            let point = vk::PipelineBindPoint::COMPUTE;
            device.cmd_bind_pipeline(commands, point, pipeline);
            device.cmd_bind_descriptor_sets(commands, point, layout, 0, &sets, &[]);
            device.cmd_dispatch(commands, (places.len() as u32).div_ceil(64), 1, 1);
        });
        device.destroy_pipeline(pipeline, None);
        device.destroy_shader_module(module, None);
        device.destroy_pipeline_layout(layout, None);
        device.destroy_descriptor_pool(pool, None);
        device.destroy_descriptor_set_layout(set_layouts[0], None);
        for sampler in samplers {
            device.destroy_sampler(sampler, None);
        }
    }
    let vectors: &[[f32; 4]] = made.read(4 * places.len()).unwrap();
    vectors.iter().map(|vector| vector.map(f64::from)).collect()
}

fn texels() -> Vec<u8> {
    let side = i64::from(SIDE);
    (0..side * side)
        .flat_map(|number| texel(number % side, number / side))
        .map(|value| (255.0 * value).round() as u8)
        .collect()
}

/// An image without mipmaps, ready to be read.
fn image(gpu: &Arc<Gpu>, memory: &Memory, bytes: &Buffer) -> Image {
    let extent = vk::Extent3D { width: SIDE, height: SIDE, depth: 1 };
    let info = vk::ImageCreateInfo::default()
        .image_type(vk::ImageType::TYPE_2D)
        .format(vk::Format::R8G8B8A8_UNORM)
        .extent(extent)
        .mip_levels(1)
        .array_layers(1)
        .samples(vk::SampleCountFlags::TYPE_1)
        .usage(vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST);
    let aspect = vk::ImageAspectFlags::COLOR;
    let image = memory.image("texture", &info, aspect).unwrap();
    submit(gpu, |commands| {
        let written = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        let region = [vk::BufferImageCopy::default()
            .image_subresource(vk::ImageSubresourceLayers {
                aspect_mask: aspect,
                mip_level: 0,
                base_array_layer: 0,
                layer_count: 1,
            })
            .image_extent(extent)];
        // SAFETY: the commands are waited for; image and buffer outlive them.
        unsafe {
            let recorder = Recorder::new(gpu, commands, None);
            recorder.transition(&image, vk::ImageLayout::UNDEFINED, written);
            let (from, to) = (bytes.handle(), image.handle());
            gpu.device().cmd_copy_buffer_to_image(commands, from, to, written, &region);
            recorder.transition(&image, written, vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL);
        }
    });
    image
}
