//! Bytes that the table of buffers promises, compared with those of the buffers that are made from it; contents of new memory.

use crate::bare::Bare;
use crate::stage::{hold_filling, on_cpu, on_gpu};
use ash::vk;
use gpc::testing::{CellSizes, Cells, Data, LocationSizes, MemoryUse, ResourceSizes, memory};

/// Plans take the bytes from the table, so that no frame exceeds a limit for memory.
#[test]
fn buffers_have_the_bytes_that_are_planned() {
    on_gpu(|gpu| {
        let limits = gpu.gpu().limits();
        let pixels = ResourceSizes {
            survivor_capacity: 10_001,
            filtered_triangles: 5_000,
            pair_capacity: 33_331,
            list_capacity: 7_777,
            fragment_capacity: 12_345,
            filtered: 999,
            shadow_words: 3,
            attributes: true,
            encoded: 4_321,
            ..ResourceSizes::new([323, 145], 7, limits)
        };
        let cells = CellSizes::new(limits.teams.members, Cells::Points, 1);
        let list = LocationSizes::new(50_000, pixels.tiles(), &cells);
        let own = ResourceSizes { locations: Some(list), ..pixels };
        let lent = ResourceSizes { locations: Some(LocationSizes { lent: true, ..list }), ..pixels };
        for sizes in [pixels, own, lent] {
            let bare = Bare::new(gpu, sizes, 16);
            let made: u64 = Data::ALL.iter().map(|data| bare.resources.buffer(*data).size()).sum();
            assert_eq!(sizes.bytes(), made);
            let allocated = bare.memory.used();
            assert!((made..=sizes.planned_bytes()).contains(&allocated), "{made} of {allocated} bytes");
        }
        let difference = own.bytes() - lent.bytes();
        assert_eq!(difference, 32 * 50_000 - 16);
    });
}

/// All tests run with memory that holds no zeros when it is allocated, as on a GPU.
#[test]
fn new_memory_is_not_zero() {
    /// Blocks of this size are not shared with other buffers, so that no earlier contents are found in them.
    const BYTES: u64 = 300 << 20;
    on_cpu(|gpu| {
        // SAFETY: no commands use the memory.
        let memory = unsafe { memory(gpu.gpu(), None) };
        let _held = hold_filling();
        let buffer = memory.buffer("new", BYTES, vk::BufferUsageFlags::TRANSFER_DST, MemoryUse::Readback).unwrap();
        let words: &[u32] = buffer.read((BYTES / 4) as usize).unwrap();
        assert!(words.iter().step_by(1024).all(|word| *word != 0));
    });
}
