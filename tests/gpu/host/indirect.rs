//! Draws that the device reads from buffers: the same pictures as of the same draws of the CPU.

use super::machine::{Base, Machine, Seen};
use super::world::{Drawn, Indirect, Lent, PLACED, Part, SIZE, SKY, Way, World, placed, product, projection};
use super::{blend, mask};
use crate::stage::on_gpu;
use ash::vk;
use ash::vk::Handle;
use gpc::host::{Draw, IndirectCounts, IndirectDraws, Instance, Options, Topology};
use gpc::render::Detection;
use gpc::scene::{Filter, Sampler, Wrap};

const OBJECT: Way = Way { object_space: true, stride: 20, positions_offset: 36, ..PLACED };

/// Instances before those of a list's draws, which no draw has.
const UNUSED: usize = 3;
/// Places in a list beyond those that its draws need.
const SLACK: u32 = 70;

fn bits(colors: &[[f32; 4]]) -> Vec<[u32; 4]> {
    colors.iter().map(|color| color.map(f32::to_bits)).collect()
}

fn options() -> Options {
    Options::new(SIZE[0], SIZE[1]).flat_background(true)
}

fn instance(draw: &Draw) -> Instance {
    let number = u32::from(draw.material);
    Instance {
        to_clip: draw.to_clip,
        vertex_count: draw.vertex_count,
        key: draw.key,
        material: (number + 1) << 16 | number,
        alpha_map: draw.alpha_map.map_or(0, |map| u32::from(map) + 1),
        detailed: u32::from(draw.detailed),
        ..Instance::default()
    }
}

/// Words of a command that draws `instances` instances of a draw.
fn command(draw: &Draw, is_indexed: bool, instances: u32, first_instance: u32) -> Vec<u32> {
    let corners = draw.topology.corners(draw.triangle_count) as u32;
    let offset = draw.vertex_offset as u32;
    if is_indexed {
        vec![corners, instances, draw.first_index, offset, first_instance]
    } else {
        vec![corners, instances, offset + draw.first_index, first_instance]
    }
}

/// A list of draws that have the same state. Successive draws that differ in their instances alone are one command.
fn list(way: &Way, draws: &[Draw]) -> Indirect {
    let first = &draws[0];
    let mut commands: Vec<Vec<u32>> = Vec::new();
    let mut instances = vec![Instance { vertex_count: u32::MAX, key: 99, ..Instance::default() }; UNUSED];
    for draw in draws {
        let next = command(draw, !way.bare, 1, instances.len() as u32);
        match commands.last_mut() {
            Some(last) if (last[0], &last[2..4]) == (next[0], &next[2..4]) && !way.bare => last[1] += 1,
            _ => commands.push(next),
        }
        instances.push(instance(draw));
        if way.bare {
            // Vertices count from the first one.
            instances.last_mut().unwrap().vertex_count -= draw.first_index;
        }
    }
    // A command without instances draws nothing; those after the counted ones are not read.
    let at = commands.len() / 2;
    let mut empty = commands[at].clone();
    empty[1] = 0;
    commands.insert(at, empty);
    let count = commands.len() as u32;
    commands.push(vec![u32::MAX; commands[0].len()]);
    let stride = 4 * commands[0].len() as u32 + 8;
    let mut bytes = vec![0xff_u8; 12];
    for words in &commands {
        let end = bytes.len() + stride as usize;
        bytes.extend(bytemuck::cast_slice::<u32, u8>(words));
        bytes.resize(end, 0xff);
    }
    let sum = |of: fn(&Draw) -> u32| draws.iter().map(of).sum::<u32>();
    Indirect {
        list: IndirectDraws {
            commands: vk::Buffer::null(),
            commands_offset: 12,
            command_stride: stride,
            command_capacity: commands.len() as u32,
            count: Some((vk::Buffer::null(), 4)),
            instances: vk::Buffer::null(),
            instances_offset: 0,
            instance_capacity: instances.len() as u32,
            draw_capacity: draws.len() as u32 + SLACK,
            triangle_capacity: sum(|draw| draw.triangle_count) + SLACK,
            position_capacity: sum(|draw| draw.vertex_count) + SLACK,
            mesh: first.mesh,
            topology: first.topology,
            front_face: first.front_face,
            double_sided: first.double_sided,
            alpha_tested: first.alpha_map.is_some(),
            blended: first.blended,
        },
        commands: bytes,
        count: Some(bytemuck::cast_slice(&[u32::MAX, count]).to_vec()),
        instances,
    }
}

/// The draws from number `from` on as lists, one for each run of draws with the same state.
fn listed(way: &Way, mut lent: Lent, from: usize) -> Lent {
    let draws = lent.draws.split_off(from);
    let state = |draw: &Draw| (draw.mesh, draw.alpha_map.is_some(), draw.blended);
    let runs = draws.chunk_by(|a, b| state(a) == state(b));
    lent.indirect = runs.map(|run| list(way, run)).collect();
    lent.triangle_count = slots(&lent);
    lent
}

/// Places for triangles.
fn slots(lent: &Lent) -> u32 {
    let lists: u32 = lent.indirect.iter().map(|indirect| indirect.list.triangle_capacity).sum();
    lists + lent.draws.iter().map(|draw| draw.triangle_count).sum::<u32>()
}

fn see(machine: &Machine<'_>, way: &Way, lent: &Lent) -> Seen {
    let seen = machine.see_lent(way, lent, Base::Nothing, options());
    assert_eq!(seen.outcome.left_over, 0);
    seen
}

/// Counts of lists of which nothing was left out.
fn counts(draws: u64, triangles: u64) -> IndirectCounts {
    let mut counts = IndirectCounts::default();
    (counts.draws, counts.triangles) = (draws, triangles);
    counts
}

#[test]
fn draws_of_the_device_make_the_picture_of_those_of_the_cpu() {
    on_gpu(|gpu| {
        for (topology, way) in [
            (Topology::List, PLACED),
            (Topology::List, OBJECT),
            (Topology::Strip, Way { short_indices: true, indices_offset: 6, ..OBJECT }),
            (Topology::Fan, Way { apart: true, ..OBJECT }),
            (Topology::List, Way { apart: true, front_face: vk::FrontFace::CLOCKWISE, double_sided: false, ..PLACED }),
            (Topology::Strip, Way { bare: true, ..OBJECT }),
            (Topology::List, Way { bare: true, ..PLACED }),
        ] {
            let world = World::of(topology);
            let way = Way { topology, ..way };
            let machine = Machine::new(gpu, &world);
            let expected = see(&machine, &way, &world.lent(&way));
            assert!(expected.outcome.statistics.superpixels > 200 || !way.double_sided);
            for from in [0, 3] {
                let lent = listed(&way, world.lent(&way), from);
                let seen = see(&machine, &way, &lent);
                assert!(bits(&seen.colors) == bits(&expected.colors), "{topology:?}, {way:?}, from {from}");
                let triangles = expected.outcome.statistics.triangles.total;
                assert_eq!(seen.outcome.statistics.triangles.total, triangles);
                let cpu: u32 = lent.draws.iter().map(|draw| draw.triangle_count).sum();
                let listed = counts((world.parts.len() - from) as u64, triangles - u64::from(cpu));
                assert_eq!(seen.outcome.indirect, listed);
            }
        }
    });
}

/// Alpha-tested and blended draws follow the opaque ones, whichever of the two lists each is in.
#[test]
fn lists_have_alpha_maps_and_blended_draws() {
    on_gpu(|gpu| {
        let sampler = Sampler {
            mag: Filter::Linear,
            min: Filter::Linear,
            mip: Some(Filter::Linear),
            wrap_u: Wrap::Repeat,
            wrap_v: Wrap::MirroredRepeat,
        };
        let pixels = (SIZE[0] * SIZE[1]) as usize;
        let [r, g, b] = SKY;
        let sky = Drawn { ids: Vec::new(), depths: Vec::new(), colors: vec![[r, g, b, 1.0]; pixels] };
        for world in [mask::world(&sampler), blend::world()] {
            let machine = Machine::new(gpu, &world);
            let see = |lent: &Lent| {
                let every = options().detection(Detection::Every);
                machine.see_lent(&OBJECT, lent, Base::Colors(&sky), every)
            };
            let expected = see(&world.lent(&OBJECT));
            let shown = expected.colors.iter().filter(|color| color[..3] != SKY).count();
            assert!(shown > pixels / 4, "{shown}");
            for from in 0..world.parts.len() {
                let mut lent = listed(&OBJECT, world.lent(&OBJECT), from);
                // The order of lists of different kinds does not matter.
                lent.indirect.reverse();
                let seen = see(&lent);
                assert!(bits(&seen.colors) == bits(&expected.colors), "from {from}");
            }
        }
    });
}

/// Thousands of draws, so that all sums have several parts.
#[test]
fn lists_are_long() {
    on_gpu(|gpu| {
        let mut world = World::new();
        let part = |number: u32| {
            let n = number as f32;
            let at = [(2.3 * n).sin() * 3.0, (1.7 * n).cos() * 3.0, -6.0 - 0.01 * n];
            Part {
                mesh: usize::from(number.is_multiple_of(5)),
                to_clip: product(&projection(), &placed(0.31 + n, 0.4 * n, at)),
                color: [1.0, (0.3 * n).sin().abs(), (0.7 * n).cos().abs()],
                opacity: 1.0,
                alpha_map: None,
            }
        };
        world.parts = (0..3000).map(part).collect();
        let machine = Machine::new(gpu, &world);
        let expected = see(&machine, &OBJECT, &world.lent(&OBJECT));
        let lent = listed(&OBJECT, world.lent(&OBJECT), 5);
        let seen = see(&machine, &OBJECT, &lent);
        assert_eq!(seen.outcome.indirect.draws, 2995);
        assert!(bits(&seen.colors) == bits(&expected.colors));
    });
}

/// A list that is larger than a capacity shows the draws before the first one that does not fit, and the other lists are whole.
#[test]
fn what_does_not_fit_is_left_out_and_counted() {
    on_gpu(|gpu| {
        let world = World::new();
        let machine = Machine::new(gpu, &world);
        for way in [PLACED, OBJECT] {
            let whole = world.lent(&way);
            // The draws 2, 3 and 4 are in the first of two lists, of which two fit.
            let mut fewer = world.lent(&way);
            fewer.draws[4].triangle_count = 0;
            let expected = see(&machine, &way, &fewer);
            let sum = |of: fn(&Draw) -> u32| whole.draws[2..4].iter().map(of).sum::<u32>();
            let [triangles, positions] = [sum(|draw| draw.triangle_count), sum(|draw| draw.vertex_count)];
            let shrinks: [fn(&mut IndirectDraws, [u32; 2]); 3] = [
                |list, _| list.draw_capacity = 2,
                |list, [triangles, _]| list.triangle_capacity = triangles,
                |list, [_, positions]| list.position_capacity = positions,
            ];
            for shrink in &shrinks[..if way.object_space { 3 } else { 2 }] {
                let mut lent = world.lent(&way);
                let mut draws = lent.draws.split_off(2);
                let last = draws.split_off(3);
                lent.indirect = vec![list(&way, &draws), list(&way, &last)];
                shrink(&mut lent.indirect[0].list, [triangles, positions]);
                lent.triangle_count = slots(&lent);
                let seen = see(&machine, &way, &lent);
                let found = &seen.outcome.indirect;
                assert_eq!((found.draws, found.left_out, found.impossible), (5, 1, 0));
                assert!(bits(&seen.colors) == bits(&expected.colors), "{way:?}");
            }
        }
    });
}

/// A draw that no mesh has shows nothing and is counted; the others of its list are shown.
#[test]
fn impossible_draws_are_counted_and_show_nothing() {
    on_gpu(|gpu| {
        let world = World::new();
        let machine = Machine::new(gpu, &world);
        let way = OBJECT;
        let mut without = world.lent(&way);
        without.draws[1].triangle_count = 0;
        let expected = see(&machine, &way, &without);
        let number = UNUSED + 1;
        let spoils: [fn(&mut Indirect, usize, u32); 7] = [
            |of, number, _| of.instances[number].key = 1,
            |of, number, _| of.instances[number].alpha_map = 1,
            |of, number, _| of.instances[number].vertex_count = 0,
            |of, number, _| of.instances[number].vertex_count = u32::MAX,
            |of, _, at| word(of, at, 2, 1 << 31),
            |of, _, at| word(of, at, 3, u32::MAX),
            |of, _, at| word(of, at, 4, u32::MAX),
        ];
        for (case, spoil) in spoils.iter().enumerate() {
            let mut lent = world.lent(&way);
            let draws = std::mem::take(&mut lent.draws);
            // Each draw has a command of its own, so that a wrong one does not move others.
            let lists: Vec<_> = draws.chunks(1).map(|draw| list(&way, draw)).collect();
            let mut all = list(&way, &draws);
            all.commands.truncate(12);
            for (i, one) in lists.iter().enumerate() {
                let stride = one.list.command_stride as usize;
                // The first command of a list of one is the one without instances.
                let mut bytes = one.commands[12 + stride..12 + 2 * stride].to_vec();
                bytes[16..20].copy_from_slice(&((UNUSED + i) as u32).to_ne_bytes());
                all.commands.extend(bytes);
            }
            all.list.command_capacity = draws.len() as u32;
            all.list.count = None;
            all.count = None;
            spoil(&mut all, number, 1);
            lent.indirect = vec![all];
            lent.triangle_count = slots(&lent);
            let seen = see(&machine, &way, &lent);
            let found = &seen.outcome.indirect;
            assert_eq!((found.draws, found.left_out, found.impossible), (7, 0, 1), "case {case}");
            assert!(bits(&seen.colors) == bits(&expected.colors), "case {case}");
        }
    });
}

/// Sets a word of command number `command` of a list.
fn word(of: &mut Indirect, command: u32, word: u32, value: u32) {
    let at = (12 + command * of.list.command_stride + 4 * word) as usize;
    of.commands[at..at + 4].copy_from_slice(&value.to_ne_bytes());
}

/// Lists that can't be read are refused, each by the number of the list and the name of what is wrong.
#[test]
fn lists_that_do_not_fit_are_named() {
    on_gpu(|gpu| {
        let world = World::new();
        let machine = Machine::new(gpu, &world);
        let refused = |spoil: &dyn Fn(&mut IndirectDraws)| {
            let lent = listed(&OBJECT, world.lent(&OBJECT), 3);
            machine.refused(&OBJECT, &lent, |geometry| spoil(&mut geometry.indirect[0]))
        };
        let at = "Geometry::indirect[0]: ";
        type Spoil = dyn Fn(&mut IndirectDraws);
        let cases: [(&Spoil, &str); 12] = [
            (&|list| list.commands = vk::Buffer::null(), "IndirectDraws::commands is VK_NULL_HANDLE"),
            (&|list| list.instances = vk::Buffer::from_raw(0), "IndirectDraws::instances is VK_NULL_HANDLE"),
            (
                &|list| list.count = Some((vk::Buffer::null(), 0)),
                "the buffer of IndirectDraws::count is VK_NULL_HANDLE",
            ),
            (&|list| list.mesh = 1, "IndirectDraws::mesh is 1; it can be 0 to 0, by Geometry::meshes"),
            (
                &|list| list.command_stride = 16,
                "IndirectDraws::command_stride is 16 bytes; it can be any multiple of 4 from 20 on",
            ),
            (&|list| list.commands_offset = 2, "IndirectDraws::commands_offset is 2 bytes; it can be a multiple of 4"),
            (
                &|list| list.command_capacity = 1 << 21,
                "IndirectDraws::command_capacity is 2097152; it can be 1 to 1048576",
            ),
            (&|list| list.draw_capacity = 0, "IndirectDraws::draw_capacity is 0; it can be 1 to 16777216"),
            (&|list| list.position_capacity = 0, "IndirectDraws::position_capacity is 0; it can be 1 to 4294967294"),
            (
                &|list| list.front_face = vk::FrontFace::from_raw(2),
                "IndirectDraws::front_face is 2; it can be VK_FRONT_FACE_COUNTER_CLOCKWISE (0) or VK_FRONT_FACE_CLOCKWISE (1)",
            ),
            (&|list| list.blended = true, "it is blended; make the frame with Geometry::blended"),
            (&|list| list.alpha_tested = true, "it is alpha-tested, and there are no Geometry::alpha_maps"),
        ];
        for (spoil, message) in cases {
            assert_eq!(refused(spoil), format!("{at}{message}"));
        }
        let instances = refused(&|list| list.instances_offset = 8);
        assert!(
            instances.starts_with(&format!("{at}IndirectDraws::instances_offset is 8 bytes; it can be a multiple of ")),
            "{instances}"
        );
        let much = refused(&|list| list.triangle_capacity = u32::MAX / 3);
        assert!(much.starts_with("triangles of all draws needs "), "{much}");
    });
}
