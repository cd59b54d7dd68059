//! Operations of teams (`shaders/include/team.glsl`) and of subgroups (`append.glsl`), compared with scalar twins.

use std::process::Command;
use std::sync::Arc;

use ash::vk;
use gpc::testing::{MemoryUse, memory};
use gpc::vulkan::Gpu;

use crate::meshes::Random;
use crate::stage::on_gpu;
use crate::submit::submit;

/// Number of results of an invocation, as in `teams/shaders/teams.comp`.
const RESULTS: usize = 16;
const INVOCATIONS: usize = 1024;

/// What the shader writes, in the same order.
fn expected(given: &[u32], members: usize) -> Vec<[u32; RESULTS]> {
    let teams = given.chunks(members).enumerate();
    teams
        .flat_map(|(number, team)| {
            let values: Vec<u32> = team
                .iter()
                .map(|value| {
                    let last =
                        (0..=number % 5).fold(*value, |v, _| v.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
                    if number % 2 == 0 { last } else { !last }
                })
                .collect();
            let floats: Vec<f32> = values.iter().map(|v| (v >> 12) as f32).collect();
            let sum = |values: &[u32]| values.iter().fold(0_u32, |sum, v| sum.wrapping_add(*v));
            let ballot = values.iter().enumerate().map(|(m, v)| u32::from(v & 4 != 0) << m).sum::<u32>();
            let results = |member: usize| {
                let named = values[member] as usize % members;
                [
                    sum(&values),
                    *values.iter().min().unwrap(),
                    *values.iter().max().unwrap(),
                    values.iter().fold(0, |or, v| or | v),
                    u32::from(values.iter().any(|v| v & 7 == 1)),
                    ballot,
                    (ballot & ((1 << member) - 1)).count_ones(),
                    sum(&values[..member]),
                    values[named],
                    values[member ^ 1],
                    values[member ^ (members - 1)],
                    floats.iter().sum::<f32>().to_bits(),
                    floats.iter().copied().fold(f32::MAX, f32::min).to_bits(),
                    floats.iter().copied().fold(0.0, f32::max).to_bits(),
                    floats[named].to_bits(),
                    floats[member ^ (members / 2)].to_bits(),
                ]
            };
            (0..members).map(results).collect::<Vec<_>>()
        })
        .collect()
}

/// Subgroups and workgroups of a dispatch.
struct Groups {
    subgroup: u32,
    workgroup: u32,
    /// Number of members of a team.
    members: u32,
}

/// What a shader of `tests/gpu/teams/shaders` leaves in a buffer of `words` words, which are 0 at first. `given` has a value for each
/// invocation.
fn written(gpu: &Arc<Gpu>, code: &[u8], given: &[u32], words: usize, groups: &Groups) -> Vec<u32> {
    let Groups { subgroup, workgroup, members } = *groups;
    // SAFETY: the commands that use objects in this memory are waited for.
    let memory = unsafe { memory(gpu, None) };
    let storage = vk::BufferUsageFlags::STORAGE_BUFFER;
    let mut values = memory.buffer("given", 4 * given.len() as u64, storage, MemoryUse::Upload).unwrap();
    values.bytes_mut()[..4 * given.len()].copy_from_slice(bytemuck::cast_slice(given));
    let mut made = memory.buffer("found", 4 * words as u64, storage, MemoryUse::Readback).unwrap();
    made.bytes_mut().fill(0);
    let device = gpu.device();
    // SAFETY: the handles are of one device, and are destroyed after the commands have run.
    unsafe {
        let ty = vk::DescriptorType::STORAGE_BUFFER;
        let bindings = [0, 1].map(|binding| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(binding)
                .descriptor_type(ty)
                .descriptor_count(1)
                .stage_flags(vk::ShaderStageFlags::COMPUTE)
        });
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        let set_layouts = [device.create_descriptor_set_layout(&info, None).unwrap()];
        let sizes = [vk::DescriptorPoolSize { ty, descriptor_count: 2 }];
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        let pool = device.create_descriptor_pool(&info, None).unwrap();
        let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&set_layouts);
        let sets = device.allocate_descriptor_sets(&info).unwrap();
        let buffers = [&values, &made]
            .map(|buffer| [vk::DescriptorBufferInfo::default().buffer(buffer.handle()).range(vk::WHOLE_SIZE)]);
        let writes = [0, 1].map(|binding: usize| {
            vk::WriteDescriptorSet::default()
                .dst_set(sets[0])
                .dst_binding(binding as u32)
                .descriptor_type(ty)
                .buffer_info(&buffers[binding])
        });
        device.update_descriptor_sets(&writes, &[]);
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&set_layouts);
        let layout = device.create_pipeline_layout(&info, None).unwrap();
        let code = ash::util::read_spv(&mut std::io::Cursor::new(code)).unwrap();
        let info = vk::ShaderModuleCreateInfo::default().code(&code);
        let module = device.create_shader_module(&info, None).unwrap();
        // The size of workgroups, the members of a team and the teams of a workgroup.
        let data = [workgroup, members, workgroup / members].map(u32::to_ne_bytes).concat();
        let map = [(0, 0), (1, 4), (24, 8)].map(|(constant_id, offset)| vk::SpecializationMapEntry {
            constant_id,
            offset,
            size: 4,
        });
        let specialization = vk::SpecializationInfo::default().map_entries(&map).data(&data);
        let mut size =
            vk::PipelineShaderStageRequiredSubgroupSizeCreateInfo::default().required_subgroup_size(subgroup);
        let mut stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module)
            .name(c"main")
            .specialization_info(&specialization);
        if gpu.limits().teams.preferred_subgroup.is_some() {
            stage = stage.push_next(&mut size);
        }
        let info = [vk::ComputePipelineCreateInfo::default().stage(stage).layout(layout)];
        let pipeline = device.create_compute_pipelines(vk::PipelineCache::null(), &info, None).unwrap()[0];
        submit(gpu, |commands| {
            let point = vk::PipelineBindPoint::COMPUTE;
            device.cmd_bind_pipeline(commands, point, pipeline);
            device.cmd_bind_descriptor_sets(commands, point, layout, 0, &sets, &[]);
            device.cmd_dispatch(commands, given.len() as u32 / workgroup, 1, 1);
        });
        device.destroy_pipeline(pipeline, None);
        device.destroy_shader_module(module, None);
        device.destroy_pipeline_layout(layout, None);
        device.destroy_descriptor_pool(pool, None);
        device.destroy_descriptor_set_layout(set_layouts[0], None);
    }
    made.read(words).unwrap().to_vec()
}

/// What the shader writes for teams of `members` in workgroups of one subgroup.
fn found(gpu: &Arc<Gpu>, given: &[u32], members: u32, subgroup: u32) -> Vec<[u32; RESULTS]> {
    let code = include_bytes!("teams/shaders/spirv/teams.spv");
    let groups = Groups { subgroup, workgroup: subgroup, members };
    let words = written(gpu, code, given, RESULTS * given.len(), &groups);
    words.chunks_exact(RESULTS).map(|results| results.try_into().unwrap()).collect()
}

/// Each operation gives what its twin gives, with teams of every size that fits into the device's subgroups.
#[test]
fn operations_give_what_their_twins_give() {
    let mut random = Random::new(6);
    let given: Vec<u32> = (0..INVOCATIONS).map(|_| random.below(1 << 32) as u32).collect();
    on_gpu(|gpu| {
        let teams = gpu.gpu().limits().teams;
        let subgroup = teams.members * teams.in_workgroup;
        println!("subgroups of {subgroup}");
        for members in [4, 8, 16, 32].into_iter().filter(|members| *members <= subgroup) {
            let expected = expected(&given, members as usize);
            let found = found(gpu.gpu(), &given, members, subgroup);
            for (invocation, (found, expected)) in found.iter().zip(&expected).enumerate() {
                assert_eq!(found, expected, "invocation {invocation}, teams of {members} in subgroups of {subgroup}");
            }
        }
        appended_entries_have_places_of_their_own(gpu.gpu(), &given);
    });
}

/// Invocations that append to a list get places that no others get, and the list has no gaps.
fn appended_entries_have_places_of_their_own(gpu: &Arc<Gpu>, given: &[u32]) {
    const MOST: usize = 5 * 7;
    let teams = gpu.limits().teams;
    let groups = Groups { subgroup: teams.members * teams.in_workgroup, workgroup: 64, members: teams.members };
    let code = include_bytes!("teams/shaders/spirv/append.spv");
    let written = written(gpu, code, given, 1 + MOST * given.len(), &groups);
    let of = |value: &u32| (0..=value % 5).map(|trip| (value >> (3 * trip) & 7) as usize).sum::<usize>();
    let length: usize = given.iter().map(of).sum();
    let (list, rest) = written[1..].split_at(length);
    assert_eq!(written[0] as usize, length);
    assert!(length > given.len() && list.iter().all(|times| *times == 1) && rest.iter().all(|times| *times == 0));
}

/// The same in the sizes of subgroups that lavapipe has with vectors of other widths. It reads the width once in a process. Subgroups of
/// 16 need AVX-512. Images are not compared there, since lavapipe crashes while it compiles kernels that read textures.
#[test]
fn subgroups_of_other_sizes_do_the_same() {
    let mut name = String::new();
    on_gpu(|gpu| name = gpu.gpu().limits().device_name.clone());
    if !name.starts_with("llvmpipe") || std::env::var_os("LP_NATIVE_VECTOR_WIDTH").is_some() {
        return;
    }
    #[cfg(target_arch = "x86_64")]
    let has_16 = std::arch::is_x86_feature_detected!("avx512f");
    #[cfg(not(target_arch = "x86_64"))]
    let has_16 = false;
    for (width, subgroup) in [(128, 4)].into_iter().chain(has_16.then_some((512, 16))) {
        let child = Command::new(std::env::current_exe().unwrap())
            .args(["teams::operations_give_what_their_twins_give", "--exact", "--nocapture"])
            .env("LP_NATIVE_VECTOR_WIDTH", width.to_string())
            // Mesa's cache does not tell widths apart.
            .env("MESA_SHADER_CACHE_DISABLE", "true")
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&child.stdout);
        let what = format!("{width} bits: {said}{}", String::from_utf8_lossy(&child.stderr));
        assert!(child.status.success(), "{what}");
        assert!(said.contains(&format!("subgroups of {subgroup}\n")), "{what}");
        assert!(said.contains("1 passed"), "{what}");
    }
}
