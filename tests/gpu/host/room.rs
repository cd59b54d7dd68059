//! Room of a host's frames and lists: a first frame is whole, and what does not fit has room in the next recording.

use super::machine::{Base, Machine, Seen};
use super::world::{Drawn, Mesh, PLACED, Part, SIZE, SKY, World};
use crate::devices::within;
use crate::stage::{NEAR, on_gpu, seen_at};
use ash::vk;

use gpc::host::{Location, Options};
use gpc::render::{Detection, Headless, Shading};
use gpc::vulkan::Limits;
use std::fmt::Write;

/// A device that computes on the CPU.
fn cpu(limits: &mut Limits) {
    limits.device_type = vk::PhysicalDeviceType::CPU;
}

/// A GPU with `bytes` bytes of its own, as far as rounds and room depend on it.
fn gpu_of(bytes: u64) -> impl FnOnce(&mut Limits) {
    move |limits| {
        limits.device_type = vk::PhysicalDeviceType::DISCRETE_GPU;
        limits.local_bytes = bytes;
    }
}

fn bits(colors: &[[f32; 4]]) -> Vec<[u32; 4]> {
    let pixels = colors.iter();
    pixels.map(|color| color.map(f32::to_bits)).collect()
}

/// A first frame in which all pixels are superpixels is whole, on GPUs with little and with much memory, and has the bytes of a
/// frame on a CPU.
#[test]
fn first_frames_are_whole_on_gpus() {
    let world = World::new();
    let lent = world.lent(&PLACED);
    let see = |gpu: &mut Headless| {
        let machine = Machine::new(gpu, &world);
        let of = |(size, samples, shading): ([u32; 2], u32, Shading)| {
            let options = Options::new(size[0], size[1]).detection(Detection::Every).samples(samples).shading(shading);
            let seen = machine.see_lent(&PLACED, &lent, Base::Nothing, options);
            let what = format!("{size:?}, {samples} samples, {shading:?}");
            assert_eq!(seen.outcome.left_over, 0, "{what}");
            let statistics = &seen.outcome.statistics;
            let pixels = u64::from(size[0] * size[1]);
            assert_eq!(statistics.superpixels, pixels, "{what}");
            assert!(u64::from(seen.rounds) >= statistics.rounds, "{what}");
            (bits(&seen.colors), what)
        };
        [
            ([40, 24], 64, Shading::Part),
            ([320, 180], 64, Shading::Part),
            ([160, 90], 64, Shading::Sample),
            ([96, 64], 1024, Shading::Sample),
        ]
        .map(of)
    };
    let mut of_cpu = None;
    within(cpu, |gpu| of_cpu = Some(see(gpu)));
    for local in [2, 128] {
        within(gpu_of(local << 30), |gpu| {
            for ((found, what), (expected, _)) in see(gpu).iter().zip(of_cpu.iter().flatten()) {
                assert!(found == expected, "{what}, {local} GiB");
            }
        });
    }
}

/// Number of blended panes, more than a first frame has room for.
const PANES: usize = 24;

/// Panes behind each other in all of the image, each with another colour.
fn panes() -> World {
    let mut camera = [[0.0; 4]; 4];
    (camera[0][0], camera[1][1]) = (1.0, -1.0);
    (camera[2][3], camera[3][2]) = (-1.0, NEAR as f32);
    let corner = |number: usize, [x, y]: [f64; 2]| seen_at([x, y], 2.0 + number as f64, SIZE[1]);
    let mesh = |number| Mesh {
        positions: [[-99.0, -98.0], [97.0, -99.0], [98.0, 99.0], [-97.0, 98.0]].map(|at| corner(number, at)).to_vec(),
        paints: vec![1.0; 4],
        coordinates: vec![[0.0; 2]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    };
    let part = |number: usize| Part {
        mesh: number,
        to_clip: camera,
        color: [0.04 * number as f32, 1.0 - 0.03 * number as f32, 0.5],
        opacity: 0.125,
        alpha_map: None,
    };
    World {
        meshes: (0..PANES).map(mesh).collect(),
        parts: (0..PANES).map(part).collect(),
        maps: Vec::new(),
        projection: camera,
    }
}

/// Colours of a host that no superpixel of the panes has.
fn drawn(size: [u32; 2]) -> Drawn {
    let pixels = size[0] * size[1];
    let color = |pixel: u32| [2.0 + (pixel % 7) as f32, 0.25, (pixel % 5) as f32, 1.0];
    Drawn { ids: Vec::new(), depths: Vec::new(), colors: (0..pixels).map(color).collect() }
}

/// Options with which the panes need more room than they first have.
fn crowded(size: [u32; 2]) -> Options {
    Options::new(size[0], size[1])
        .detection(Detection::Every)
        .shading(Shading::Sample)
        .thin(false)
        .flat_background(true)
}

fn left(seen: &Seen) -> u64 {
    seen.outcome.left_over
}

fn has_room_later(gpu: &mut Headless) {
    let world = panes();
    let machine = Machine::new(gpu, &world);
    let lent = world.lent(&PLACED);
    let drawn = drawn(SIZE);
    let see = |options: Options, times| {
        let base = Base::Colors(&drawn);
        machine.see_again(&PLACED, &lent, base, options, times)
    };
    let growing = see(crowded(SIZE), 4);
    assert!(left(&growing[0]) > 0);
    assert_eq!(left(&growing[3]), 0);
    let whole = &growing[3].colors;
    assert!(whole.iter().all(|color| color[0] < 2.0));
    let fixed = see(crowded(SIZE).fixed_memory(true), 2);
    for seen in growing.iter().chain(&fixed) {
        // Pixels have all of their samples, or keep what the host has drawn.
        let pixels = seen.colors.iter().zip(whole.iter().zip(&drawn.colors));
        let mut kept = 0;
        for (found, (whole, drawn)) in pixels {
            assert!(found == whole || found == drawn, "{found:?}");
            kept += u64::from(found == drawn);
        }
        assert_eq!(kept > 0, left(seen) > 0);
    }
    let bytes = |seen: &Seen| seen.outcome.statistics.memory_bytes;
    // A whole frame does not grow any more.
    let last = growing.iter().position(|seen| left(seen) == 0).unwrap();
    assert!(growing[last..].iter().all(|seen| bytes(seen) == bytes(&growing[last])));

    for seen in &fixed {
        assert!(left(seen) > 0);
        assert_eq!(bytes(seen), bytes(&growing[0]));
    }
}

/// The next recording of a frame has room for what was left, unless the host forbids it.
#[test]
fn the_next_recording_has_more_room() {
    on_gpu(has_room_later);
}

#[test]
fn the_next_recording_has_more_room_on_gpus() {
    within(gpu_of(8 << 30), has_room_later);
}

#[test]
fn the_next_recording_of_a_list_has_more_room() {
    on_gpu(|gpu| {
        let world = panes();
        let machine = Machine::new(gpu, &world);
        let location = |pixel: u32| Location {
            pixel: [pixel % SIZE[0], pixel / SIZE[0]].map(|at| at as i32),
            within: [0.5, 0.5],
            jacobian: [[1.0, 0.0], [0.0, 1.0]],
        };
        let locations: Vec<_> = (0..SIZE[0] * SIZE[1]).map(location).collect();
        let see = |options, times| machine.see_list_again(&PLACED, &locations, options, times);
        let growing = see(crowded(SIZE), 4);
        let left = |(_, outcome): &(_, gpc::host::ListOutcome)| outcome.left_over;
        assert!(left(&growing[0]) > 0);
        assert_eq!(left(&growing[3]), 0);
        let whole = &growing[3].0;
        let [r, g, b] = SKY;
        let background = [r, g, b, 1.0];
        let fixed = see(crowded(SIZE).fixed_memory(true), 2);
        for seen in growing.iter().chain(&fixed) {
            let mut kept = 0;
            for (found, whole) in seen.0.iter().zip(whole) {
                assert!(found == whole || *found == background, "{found:?}");
                kept += u64::from(*found == background);
            }
            assert_eq!(kept > 0, left(seen) > 0);
        }
        for seen in &fixed {
            assert!(left(seen) > 0);
            assert_eq!(seen.1.statistics.memory_bytes, growing[0].1.statistics.memory_bytes);
        }
    });
}

/// Sizes of images, and numbers of samples, for which the table says what a frame takes.
const SIZES: [[u32; 2]; 4] = [[640, 360], [1280, 720], [1920, 1080], [3840, 2160]];
const SAMPLES: [u32; 3] = [64, 256, 1024];
/// Number of triangles of a frame of the table.
const TRIANGLES: u32 = 1_000_000;

/// Memory and number of rounds of a first frame with the default options.
fn taken(machine: &Machine<'_>, [width, height]: [u32; 2], samples: u32) -> (u64, u32) {
    let options = Options::new(width, height).samples(samples);
    machine.prepared(&PLACED, TRIANGLES, &options)
}

/// A first frame of any of the sizes takes at most 1 GiB on a GPU with very much memory.
#[test]
fn first_frames_take_at_most_a_gibibyte_on_gpus() {
    let world = World::new();
    within(gpu_of(141 << 30), |gpu| {
        let machine = Machine::new(gpu, &world);
        for size in SIZES {
            for samples in SAMPLES {
                let (bytes, _) = taken(&machine, size, samples);
                let what = format!("{size:?}, {samples} samples: {bytes} bytes");
                assert!(bytes <= 1 << 30, "{what}");
            }
        }
    });
}

/// The table of what frames take, in `docs/bench`. With `GPC_ROOM=write` it is written.
#[test]
fn the_table_says_what_frames_take() {
    let world = World::new();
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/bench/room-lavapipe-22.3.csv");
    let mut rows = String::from("device,width,height,samples,bytes,rounds\n");
    let mut driver = String::new();
    let mut add = |device: &str, gpu: &mut Headless| {
        let limits = gpu.gpu().limits();
        driver = limits.driver.clone();
        let machine = Machine::new(gpu, &world);
        for size @ [width, height] in SIZES {
            for samples in SAMPLES {
                let (bytes, rounds) = taken(&machine, size, samples);
                writeln!(rows, "{device},{width},{height},{samples},{bytes},{rounds}").unwrap();
            }
        }
    };
    within(gpu_of(8 << 30), |gpu| add("gpu", gpu));
    within(cpu, |gpu| add("cpu", gpu));
    if std::env::var_os("GPC_ROOM").is_some_and(|value| value == "write") {
        let said = |program: &str, words: &[&str]| {
            let mut command = std::process::Command::new(program);
            let output = command.args(words).output().unwrap().stdout;
            String::from_utf8(output).unwrap().trim().to_owned()
        };
        let head = format!(
            "# driver: {driver}\n# machine: simulated GPU with 8 GiB\n# date: {}\n# commit: {}\n# size: several\n",
            said("date", &["+%F"]),
            said("git", &["rev-parse", "--short=8", "HEAD"]),
        );
        std::fs::write(path, head + &rows).unwrap();
        return;
    }
    let known = std::fs::read_to_string(path).unwrap();
    let known: Vec<_> = known.lines().filter(|line| !line.starts_with('#')).collect();
    if known[..] == rows.lines().collect::<Vec<_>>()[..] {
        return;
    }
    // Drivers round sizes up, and wider subgroups have shorter work lists.
    let [known, found] = [known, rows.lines().collect()].map(|lines| {
        let numbers = |line: &str| line.rsplit(',').take(2).map(str::parse).collect::<Result<Vec<f64>, _>>();
        lines.iter().skip(1).map(|line| numbers(line).unwrap()).collect::<Vec<_>>()
    });
    assert_eq!(known.len(), found.len());
    for (known, found) in known.iter().zip(&found) {
        for (known, found) in known.iter().zip(found) {
            assert!((known / found - 1.0).abs() < 0.02, "{known} is {found} now; see GPC_ROOM");
        }
    }
}
