//! Draws as hosts have them: of several buffers, without indices, in strips and fans.

use super::machine::{Base, Machine, Seen};
use super::world::{PLACED, Way, World};
use crate::stage::on_gpu;
use gpc::host::Topology;

const OBJECT: Way = Way { object_space: true, stride: 20, positions_offset: 36, ..PLACED };

/// Ways of lending that differ in the data that draws read, but show the same picture.
const WAYS: [Way; 7] = [
    Way { apart: true, ..PLACED },
    Way { apart: true, short_indices: true, indices_offset: 6, ..OBJECT },
    Way { bare: true, ..PLACED },
    Way { bare: true, ..OBJECT },
    Way { bare: true, apart: true, positions_offset: 20, ..PLACED },
    Way { bare: true, apart: true, ..OBJECT },
    OBJECT,
];

fn bits(seen: &Seen) -> [Vec<[u32; 4]>; 2] {
    [&seen.colors, &seen.corners].map(|vectors| {
        let vectors = vectors.iter();
        vectors.map(|vector| vector.map(f32::to_bits)).collect()
    })
}

/// The twin makes a list of the triangles of strips and fans; the library draws these as they are.
#[test]
fn buffers_and_topologies_do_not_change_the_picture() {
    on_gpu(|gpu| {
        for topology in [Topology::List, Topology::Strip, Topology::Fan] {
            let world = World::of(topology);
            let (machine, drawn) = (Machine::new(gpu, &world), world.drawn());
            for base in [Base::All(&drawn), Base::Nothing] {
                let seen = machine.see(&PLACED, base);
                let superpixels = seen.outcome.statistics.superpixels;
                assert!(superpixels > drawn.colors.len() as u64 / 16, "{superpixels}");
                let listed = bits(&seen);
                for way in WAYS.into_iter().chain([PLACED]) {
                    let way = Way { topology, ..way };
                    assert!(bits(&machine.see(&way, base)) == listed, "{way:?}");
                }
            }
        }
    });
}
