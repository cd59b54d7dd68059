//! Front faces, whose orientation hosts choose.

use super::machine::{Base, Machine};
use super::world::{PLACED, SIZE, Way, World};
use crate::difference::rmse;
use crate::stage::on_gpu;
use ash::vk::FrontFace;
use gpc::host::Topology;

/// Draws whose back faces are dark where they are visible.
const ONE_SIDED: Way = Way { double_sided: false, back: 0.4, ..PLACED };

/// The world with the second and third corner of each triangle exchanged.
fn reversed(mut world: World) -> World {
    for mesh in &mut world.meshes {
        for triangle in mesh.indices.chunks_exact_mut(3) {
            triangle.swap(1, 2);
        }
    }
    world
}

/// The world with y negated after each part's transform, whose determinant then has the other sign.
fn mirrored(mut world: World) -> World {
    for part in &mut world.parts {
        for column in &mut part.to_clip {
            column[1] = -column[1];
        }
    }
    world
}

#[test]
fn clockwise_front_faces_show_what_reversed_indices_show() {
    on_gpu(|gpu| {
        for topology in [Topology::List, Topology::Strip, Topology::Fan] {
            let world = World::of(topology);
            let other = reversed(World::of(topology));
            let (machine, machine_of_other) = (Machine::new(gpu, &world), Machine::new(gpu, &other));
            for double_sided in [false, true] {
                for y_up in [false, true] {
                    let listed = Way { double_sided, y_up, ..ONE_SIDED };
                    let see = |front_face| {
                        let way = Way { topology, front_face, ..listed };
                        machine.see(&way, Base::Nothing)
                    };
                    let expected = machine_of_other.see(&listed, Base::Nothing);
                    assert!(expected.outcome.statistics.superpixels > 100);
                    let clockwise = see(FrontFace::CLOCKWISE);
                    assert!(clockwise.colors == expected.colors, "{listed:?}");
                    assert!(clockwise.corners == expected.corners, "{listed:?}");
                    let apart = rmse(&see(FrontFace::COUNTER_CLOCKWISE).colors, &expected.colors);
                    assert!(apart > 0.05, "{listed:?}: {apart}");
                }
            }
        }
    });
}

/// The orientation in the image decides, not that in object space.
#[test]
fn a_mirroring_transform_and_a_flipped_viewport_each_exchange_front_and_back() {
    on_gpu(|gpu| {
        let (world, mirrored) = (World::new(), mirrored(World::new()));
        let (machine, mirror) = (Machine::new(gpu, &world), Machine::new(gpu, &mirrored));
        for front_face in [FrontFace::COUNTER_CLOCKWISE, FrontFace::CLOCKWISE] {
            for double_sided in [false, true] {
                let way = Way { front_face, double_sided, ..ONE_SIDED };
                let flipped = Way { y_up: true, ..way };
                let expected = machine.see(&way, Base::Nothing).colors;
                let both = mirror.see(&flipped, Base::Nothing).colors;
                assert!(both == expected, "{way:?}");
                let upside_down = |colors: Vec<[f32; 4]>| {
                    let rows = colors.chunks_exact(SIZE[0] as usize).rev();
                    rows.flatten().copied().collect::<Vec<_>>()
                };
                let opposite = match front_face {
                    FrontFace::CLOCKWISE => FrontFace::COUNTER_CLOCKWISE,
                    _ => FrontFace::CLOCKWISE,
                };
                for (machine, way) in [(&mirror, way), (&machine, flipped)] {
                    let see = |front_face| {
                        let way = Way { front_face, ..way };
                        let colors = machine.see(&way, Base::Nothing).colors;
                        rmse(&upside_down(colors), &expected)
                    };
                    let (apart, far) = (see(opposite), see(front_face));
                    assert!(far > 10.0 * apart, "{way:?}: {apart} {far}");
                }
            }
        }
    });
}
