//! Formats of positions.

use super::machine::{Base, Machine, Seen};
use super::world::{PLACED, Way, World};
use crate::stage::on_gpu;
use ash::vk;
use gpc::host::VertexFormat;

fn bits(seen: &Seen) -> [Vec<[u32; 4]>; 2] {
    [&seen.colors, &seen.corners].map(|vectors| vectors.iter().map(|vector| vector.map(f32::to_bits)).collect())
}

/// The same positions as floats, and in another format, make the same picture.
#[test]
fn formats_of_positions_do_not_change_the_picture() {
    on_gpu(|gpu| {
        let scaled = |format| VertexFormat { scale: [1.1, 1.25, 0.75], ..VertexFormat::of(format) };
        let moved =
            |format| VertexFormat { scale: [2.2, 2.5, 1.5], bias: [-1.1, -1.25, -0.75], ..VertexFormat::of(format) };
        for (format, positions_offset, stride) in [
            (VertexFormat::of(vk::Format::R16G16B16A16_SFLOAT), 0, 8),
            (VertexFormat::of(vk::Format::R16G16B16_SFLOAT), 6, 10),
            (scaled(vk::Format::R16G16B16A16_SNORM), 4, 12),
            (moved(vk::Format::R16G16B16_UNORM), 2, 6),
        ] {
            let world = World::rounded(format);
            let (machine, drawn) = (Machine::new(gpu, &world), world.drawn());
            let floats = Way { object_space: true, stride: 12, ..PLACED };
            for (base, bare) in [(Base::All(&drawn), false), (Base::Nothing, true)] {
                let expected = machine.see(&Way { bare, ..floats }, base);
                assert!(expected.outcome.statistics.superpixels > 200);
                let way = Way { format, positions_offset, stride, bare, ..floats };
                let found = machine.see(&way, base);
                assert!(bits(&found) == bits(&expected), "{way:?}");
            }
        }
    });
}
