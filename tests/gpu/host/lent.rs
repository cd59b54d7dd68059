//! Ways in which a host can lend its buffers.

use super::machine::{AROUND, Base, Machine, Seen};
use super::world::{PLACED, SIZE, Way, World};
use crate::stage::on_gpu;
use gpc::host::Options;

fn bits(colors: &[[f32; 4]]) -> Vec<[u32; 4]> {
    let pixels = colors.iter();
    pixels.map(|color| color.map(f32::to_bits)).collect()
}

fn corners(world: &World) -> Vec<[u32; 4]> {
    let corners = world.corners();
    bits(corners.as_flattened())
}

const WAYS: [Way; 5] = [
    // The offset is not aligned for descriptors.
    Way { positions_offset: 20, ..PLACED },
    Way { stride: 28, short_indices: true, ..PLACED },
    Way { object_space: true, stride: 12, ..PLACED },
    Way { object_space: true, positions_offset: 36, stride: 20, short_indices: true, indices_offset: 6, ..PLACED },
    Way { object_space: true, stride: 16, indices_offset: 4, ..PLACED },
];

/// The picture is antialiased and uses the host's attributes; its bytes are the same for every way of lending.
#[test]
fn every_way_to_lend_gives_the_same_picture() {
    on_gpu(|gpu| {
        let world = World::new();
        let (machine, drawn) = (Machine::new(gpu, &world), world.drawn());
        let Seen { colors, outcome, .. } = machine.see(&PLACED, Base::All(&drawn));
        assert_eq!(outcome.left_over, 0);
        let pixels = drawn.colors.len() as u64;
        let superpixels = outcome.statistics.superpixels;
        assert!((pixels / 8..pixels).contains(&superpixels), "{superpixels}");
        let changed = (colors.iter().zip(&drawn.colors)).filter(|(now, before)| now != before);
        assert!(changed.count() > pixels as usize / 10);
        for way in WAYS {
            let found = machine.see(&way, Base::All(&drawn));
            assert!(bits(&found.colors) == bits(&colors), "{way:?}");
            let now = found.outcome.statistics.superpixels;
            assert_eq!(now, superpixels, "{way:?}");
        }
    });
}

/// An image that shaders can't read gives the same bytes: the library reads a copy, of the right part.
#[test]
fn an_image_of_colours_that_is_copied_gives_the_same_picture() {
    on_gpu(|gpu| {
        let world = World::new();
        let (machine, drawn) = (Machine::new(gpu, &world), world.drawn());
        for corner in [[0, 0], [13, 5]] {
            let read = Way { corner, ..PLACED };
            let copied = Way { copied: true, ..read };
            for base in [Base::All(&drawn), Base::Colors(&drawn), Base::Nothing] {
                let [read, copied] = [&read, &copied].map(|way| machine.see(way, base));
                assert!(read.outcome.statistics.superpixels > 0);
                assert!(bits(&read.colors) == bits(&copied.colors), "{corner:?}");
            }
        }
        let options = |way: &Way| {
            let drawn_behind = Options::new(SIZE[0], SIZE[1]).keep_alpha(true);
            machine.see_lent(way, &world.lent(way), Base::All(&drawn), drawn_behind).colors
        };
        let part = Way { corner: [13, 5], ..PLACED };
        assert!(bits(&options(&part)) == bits(&options(&Way { copied: true, ..part })));
    });
}

#[test]
fn positions_are_the_twins() {
    on_gpu(|gpu| {
        let world = World::new();
        let (machine, drawn) = (Machine::new(gpu, &world), world.drawn());
        for way in WAYS.iter().chain([&PLACED]) {
            let found = machine.see(way, Base::All(&drawn));
            assert!(bits(&found.corners) == corners(&world), "{way:?}");
        }
    });
}

/// An index out of range refers to the last vertex: of its draw if positions are in object space, otherwise of all.
#[test]
fn indices_out_of_range_are_the_last_vertex() {
    on_gpu(|gpu| {
        let world = World::new();
        let (machine, drawn) = (Machine::new(gpu, &world), world.drawn());
        let options = Options::new(SIZE[0], SIZE[1]);
        for way in &WAYS {
            let mut lent = world.lent(way);
            let size = if way.short_indices { 2 } else { 4 };
            // Place of the second corner of the first triangle.
            let place = way.indices_offset as usize + size;
            lent.indices[place..place + size].fill(0xf0);
            let corners = |draw: usize, vertex: usize| {
                let part = &world.parts[draw];
                world.meshes[part.mesh].clip(&part.to_clip).nth(vertex).unwrap()
            };
            let last = if way.object_space { 0 } else { world.parts.len() - 1 };
            let vertices = world.meshes[world.parts[last].mesh].vertex_count();
            let found = machine.see_lent(way, &lent, Base::All(&drawn), options.clone());
            assert_eq!(found.corners[0], corners(0, 0), "{way:?}");
            assert_eq!(found.corners[1], corners(last, vertices - 1), "{way:?}");
            assert_eq!(found.corners[2], corners(0, 2), "{way:?}");
        }
    });
}

/// Pixels around the picture in a larger image are neither read nor written.
#[test]
fn a_part_of_the_images_is_the_same_picture() {
    on_gpu(|gpu| {
        let world = World::new();
        let (machine, drawn) = (Machine::new(gpu, &world), world.drawn());
        let corner = [13, 5];
        let way = Way { corner, ..PLACED };
        for base in [Base::All(&drawn), Base::Colors(&drawn)] {
            let whole = machine.see(&PLACED, base);
            let part = machine.see(&way, base);
            let expected = way.framed(&whole.colors, SIZE, AROUND);
            assert!(bits(&part.colors) == bits(&expected));
        }
        // The library writes the colours of all pixels of the picture, and leaves the pixels around them unchanged.
        let whole = machine.see(&PLACED, Base::Ids(&drawn));
        let part = machine.see(&way, Base::Ids(&drawn));
        let width = way.around(SIZE)[0] as usize;
        let rows = part.colors.chunks_exact(width).skip(corner[1] as usize);
        let inner = rows.take(SIZE[1] as usize).flat_map(|row| {
            let row = row.iter().skip(corner[0] as usize);
            row.take(SIZE[0] as usize)
        });
        let inner: Vec<_> = inner.copied().collect();
        assert!(bits(&inner) == bits(&whole.colors));
    });
}
