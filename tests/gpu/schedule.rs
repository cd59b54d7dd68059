//! Rounds that `tally`, `schedule` and `enlist` make, compared with the CPU's.

use gpc::render::Headless;
use gpc::testing::Random;
use gpc::testing::{
    Argument, Buffer, Cells, Counter, Data, FragmentRate, FrameUniform, Load, LongLists, Pass, Recorder, ResourceSizes,
    SampleBlocks, SampleOptions, load_passes,
};
use twins::schedule::{Placed, Round, Rounds, ScheduledList, Tile};

use crate::bare::{Bare, copy};
use crate::stage::on_gpu;
use crate::submit::submit;

const LAYERS: u32 = 4;

/// Tiles to schedule, and the room of a round.
struct Case {
    name: &'static str,
    /// Width and height of the region in tiles.
    size: [u32; 2],
    samples: u32,
    fragments_are: FragmentRate,
    triangles: u32,
    /// Whether the scene has BLEND triangles.
    blends: bool,
    candidates: u32,
    fragments: u32,
    /// Reciprocal of the share of tiles that have superpixels.
    sparseness: u64,
    /// Reciprocal of the share of these tiles that have more candidates than fit. An equal share has dropped pairs.
    rarity: u64,
    /// Whether tiles without a list are sampled.
    unlisted: bool,
}

const USUAL: Case = Case {
    name: "usual",
    size: [160, 180],
    samples: 64,
    fragments_are: FragmentRate::Triangle,
    triangles: 30_000,
    blends: false,
    candidates: 20_000,
    fragments: 200_000,
    sparseness: 5,
    rarity: 2_000,
    unlisted: true,
};

impl Case {
    /// Mask of superpixels of each tile, and the words that `bin` leaves there: candidates, 0, 0, flags.
    fn tiles(&self, random: &mut Random) -> Vec<(u32, [u32; 4])> {
        let count = self.size[0] * self.size[1];
        let tile = |_| {
            if random.below(self.sparseness) != 0 {
                return (0, [0; 4]);
            }
            let mask = (random.bits() & random.bits()) as u32 | 1;
            let kind = random.below(8);
            let flags = match kind {
                0 => MASK,
                1 if self.blends => BLEND,
                2 if self.blends => MASK | BLEND,
                _ => 0,
            };
            let (candidates, overflow) = match random.below(self.rarity) {
                0 => (u64::from(self.candidates) + 1 + random.below(9), 0),
                1 => (random.below(50), OVERFLOW),
                2 => (u64::from(self.candidates), 0),
                _ => (random.below(60), 0),
            };
            (mask, [candidates as u32, 0, 0, flags | overflow])
        };
        (0..count).map(tile).collect()
    }
}

/// Flags of tiles: the same numbers as in `shaders/include/tiles.glsl`.
const MASK: u32 = 1;
const BLEND: u32 = 2;
const LISTED: u32 = 4;
const OVERFLOW: u32 = 8;

/// Buffers after a round on the device.
struct Found {
    counters: Vec<u32>,
    tiles: Vec<[u32; 4]>,
    work: Vec<u32>,
}

/// Buffers in host memory to which those of rounds are copied.
struct Kept {
    counters: Buffer,
    tiles: Buffer,
    work: Buffer,
}

impl Kept {
    fn new(bare: &Bare) -> Self {
        let (resources, like) = (&bare.resources, |buffer| bare.like(buffer));
        Self {
            counters: like(resources.buffer(Data::Counters)),
            tiles: like(resources.buffer(Data::Tiles)),
            work: like(resources.buffer(Data::TileLists)),
        }
    }

    fn read(&self, tiles: usize) -> Found {
        let all = |buffer: &Buffer| buffer.read(buffer.size() as usize / 4).unwrap().to_vec();
        Found { counters: all(&self.counters), tiles: self.tiles.read(tiles).unwrap().to_vec(), work: all(&self.work) }
    }
}

/// The passes and their memory, and the twin with the same room.
struct Passes<'a> {
    gpu: &'a Headless,
    bare: Bare,
    load: Load,
    passes: [Pass; 2],
    sizes: ResourceSizes,
    uniform: FrameUniform,
    twin: Rounds,
}

impl<'a> Passes<'a> {
    fn new(gpu: &'a Headless, case: &Case) -> Self {
        let sizes = ResourceSizes {
            pair_capacity: 1,
            list_capacity: case.candidates,
            fragment_capacity: case.fragments,
            ..ResourceSizes::new([8 * case.size[0], 4 * case.size[1]], 1, gpu.gpu().limits())
        };
        let bare = Bare::new(gpu, sizes, case.samples);
        let options = SampleOptions {
            cells: Cells::Pixels,
            samples: case.samples,
            lines: false,
            fragments: case.fragments_are,
            one_cell: false,
            long_lists: LongLists::Scattered,
            samples_unlisted: case.unlisted,
            has_mask: false,
            has_blend: case.blends,
            always_blends: false,
            spread: None,
        };
        let limits = gpu.gpu().limits();
        let blocks = SampleBlocks::new(limits.teams, options);
        let load = Load::new(limits, blocks, LAYERS);
        let passes = load_passes(&bare.layout, options.cells, &load).unwrap();
        let uniform = FrameUniform {
            size: sizes.region,
            tiles: case.size,
            triangle_count: case.triangles,
            first_mask: 10,
            first_blend: if case.blends { 20 } else { case.triangles },
            sample_count: case.samples,
            pair_capacity: 1,
            list_capacity: case.candidates,
            fragment_capacity: case.fragments,
            ..FrameUniform::default()
        };
        let twin = Rounds {
            samples: case.samples,
            block: blocks.block,
            per_sample: case.fragments_are == FragmentRate::Sample,
            parts: blocks.parts(),
            layers: LAYERS,
            triangles: case.triangles,
            team: sizes.team,
            longest_list: 2_500,
            longest_layered: 160,
            blends: case.blends,
            candidates: case.candidates,
            fragments: case.fragments,
        };
        Self { gpu, bare, load, passes, sizes, uniform, twin }
    }

    /// Number of rounds that are recorded for tiles with `candidates` candidates in total.
    fn recorded(&self, candidates: u32) -> usize {
        let sizes = ResourceSizes { pair_capacity: candidates, ..self.sizes };
        self.load.most_rounds(&sizes, self.uniform.triangle_count) as usize
    }

    /// Buffers after each of `count` rounds on the device.
    fn run(&self, content: &[(u32, [u32; 4])], count: usize) -> Vec<Found> {
        let Self { gpu, bare: Bare { memory, resources, .. }, passes: [tally, schedule], uniform, .. } = self;
        let masks: Vec<u32> = content.iter().map(|tile| tile.0).collect();
        let tiles: Vec<[u32; 4]> = content.iter().map(|tile| tile.1).collect();
        let busy = masks.iter().filter(|&&mask| mask != 0).count() as u32;
        let upload = |words: &[u32]| memory.upload("upload", bytemuck::cast_slice(words)).unwrap();
        let (mask_upload, tile_upload) = (upload(&masks), upload(tiles.as_flattened()));
        let mut counters = [0; Counter::COUNT];
        counters[Counter::Tiles as usize] = busy;
        let mut arguments = [0; 4 * Argument::Shade as usize];
        let stretches = (content.len() as u32).div_ceil(256);
        arguments[4 * Argument::Tally as usize..][..4].copy_from_slice(&[stretches, 1, 1, 0]);
        let (counter_upload, argument_upload) = (upload(&counters), upload(&arguments));
        let kept: Vec<Kept> = (0..count).map(|_| Kept::new(&self.bare)).collect();
        submit(gpu.gpu(), |commands| {
            // SAFETY: the commands are waited for, and everything to which they refer outlives them.
            let recorder = || unsafe { Recorder::new(gpu.gpu(), commands, None) };
            let set = resources.set(0).unwrap();
            let shown = || {
                let recorder = recorder();
                set.show(&recorder);
                recorder
            };
            resources.record_upload(&recorder());
            resources.record_begin(&recorder(), set, uniform);
            copy(gpu, commands, &mask_upload, resources.buffer(Data::Masks));
            copy(gpu, commands, &tile_upload, resources.buffer(Data::Tiles));
            copy(gpu, commands, &counter_upload, resources.buffer(Data::Counters));
            copy(gpu, commands, &argument_upload, resources.buffer(Data::Arguments));
            tally.record(&shown());
            for kept in &kept {
                schedule.record(&shown());
                copy(gpu, commands, resources.buffer(Data::Counters), &kept.counters);
                copy(gpu, commands, resources.buffer(Data::Tiles), &kept.tiles);
                copy(gpu, commands, resources.buffer(Data::TileLists), &kept.work);
            }
        });
        kept.iter().map(|kept| kept.read(content.len())).collect()
    }
}

/// The tiles in the form of the twin.
fn twins_of(content: &[(u32, [u32; 4])]) -> Vec<Tile> {
    let tile = |&(mask, [candidates, _, _, flags]): &(u32, [u32; 4])| Tile {
        cells: mask.count_ones(),
        candidates,
        overflows: flags & OVERFLOW != 0,
        has_mask: flags & MASK != 0,
        has_blend: flags & BLEND != 0,
    };
    content.iter().map(tile).collect()
}

/// Entries of each list, in order.
fn entries(round: &Round, tiles: &[Tile], team: u32) -> [Vec<u32>; 4] {
    [ScheduledList::Plain, ScheduledList::Masked, ScheduledList::Blended, ScheduledList::Unlisted].map(|list| {
        let placed = round.placed.iter().filter(|placed| placed.list == list);
        let parts = |placed: &Placed| {
            let cells = tiles[placed.tile].cells;
            let item = (placed.tile as u32) << 3;
            (0..cells.div_ceil(team)).map(move |part| item | part)
        };
        placed.flat_map(parts).collect()
    })
}

fn assert_rounds_are_the_twins(passes: &Passes<'_>, case: &Case, seed: u64) -> usize {
    let content = case.tiles(&mut Random::new(seed));
    let twins = twins_of(&content);
    // Idle rounds follow, which find nothing.
    const IDLE: usize = 2;
    let expected = passes.twin.of(&twins);
    // Pairs are dropped only if they have filled all the room that the device allows.
    let most_pairs = ResourceSizes::most_pairs(passes.gpu.gpu().limits());
    let recorded = passes.recorded(most_pairs as u32);
    assert!(expected.len() <= recorded, "{}: {} of {recorded}", case.name, expected.len());
    let found = passes.run(&content, expected.len() + IDLE);
    let team = passes.gpu.gpu().limits().teams.members;
    let mut tiles: Vec<[u32; 4]> = content.iter().map(|tile| tile.1).collect();
    let (mut busy_rounds, mut candidates, mut unlisted) = (0, 0, 0);
    for (number, found) in found.iter().enumerate() {
        let what = format!("{}, seed {seed}, round {number}", case.name);
        let round = expected
            .get(number)
            .cloned()
            .unwrap_or_else(|| Round { tiles: content.len()..content.len(), placed: Vec::new() });
        let counter = |counter: Counter| found.counters[counter as usize];
        assert_eq!(counter(Counter::RoundFirst), round.tiles.start as u32, "{what}");
        assert_eq!(counter(Counter::NextTile), round.tiles.end as u32, "{what}");
        for placed in &round.placed {
            let tile = &mut tiles[placed.tile];
            let listed = placed.list != ScheduledList::Unlisted;
            let length = if listed { tile[0] } else { 0 };
            let flags = tile[3] & (MASK | BLEND | OVERFLOW) | if listed { LISTED } else { 0 };
            tile[1] = placed.first_candidate as u32;
            tile[2] = placed.first_header as u32;
            tile[3] = flags | length << 8;
            candidates += length;
            unlisted += u32::from(!listed);
        }
        assert!(found.tiles == tiles, "{what}: {:?}", {
            let differs = (0..tiles.len()).find(|&tile| tiles[tile] != found.tiles[tile]);
            differs.map(|tile| (tile, tiles[tile], found.tiles[tile]))
        });
        let first_of_list = content.len() * (32 / team) as usize;
        for (list, entries) in entries(&round, &twins, team).iter().enumerate() {
            let length = found.counters[Counter::PlainTiles as usize + list] as usize;
            let entered = &found.work[list * first_of_list..][..length];
            assert_eq!(entered, entries, "{what}, list {list}");
        }
        busy_rounds += u32::from(!round.placed.is_empty());
        assert_eq!(counter(Counter::Rounds), busy_rounds, "{what}");
        assert_eq!(counter(Counter::CandidatesTotal), candidates, "{what}");
        assert_eq!(counter(Counter::UnlistedTotal), unlisted, "{what}");
    }
    expected.len()
}

/// Rounds over many stretches of tiles and over parts of one, rounds that end within a stretch and at its end, and
/// tiles that fit into no round.
#[test]
fn rounds_are_the_twins() {
    on_gpu(|gpu| {
        let cases = [
            USUAL,
            Case { name: "one tile", size: [1, 1], sparseness: 1, ..USUAL },
            Case {
                name: "all in one round",
                size: [240, 270],
                candidates: 400_000,
                fragments: 4_000_000,
                sparseness: 20,
                rarity: 1 << 40,
                ..USUAL
            },
            Case {
                name: "little room",
                size: [33, 31],
                candidates: 500,
                fragments: 4_000,
                sparseness: 2,
                rarity: 60,
                ..USUAL
            },
            Case {
                name: "layers by part",
                samples: 256,
                fragments_are: FragmentRate::Part,
                blends: true,
                fragments: 1_000_000,
                rarity: 500,
                ..USUAL
            },
            Case {
                name: "many triangles to try",
                size: [60, 40],
                triangles: 350_000,
                fragments: 1_000_000,
                sparseness: 1,
                rarity: 2,
                ..USUAL
            },
            Case {
                name: "more triangles than are tried",
                size: [60, 40],
                triangles: 350_001,
                fragments: 4_000_000,
                candidates: 1 << 17,
                rarity: 2,
                ..USUAL
            },
            Case {
                name: "fragments of samples",
                samples: 16,
                fragments_are: FragmentRate::Sample,
                blends: true,
                ..USUAL
            },
        ];
        let counts = cases.map(|case| {
            let passes = Passes::new(gpu, &case);
            [1, 2].map(|seed| assert_rounds_are_the_twins(&passes, &case, seed))[0]
        });
        // A single tile, tiles that fit together, and tiles that are skipped take one round; the others take several.
        assert_eq!([counts[1], counts[2], counts[6]], [1, 1, 1]);
        assert!([0, 3, 4, 5, 7].iter().all(|&case| counts[case] > 3), "{counts:?}");
    });
}

/// All tiles have equal needs, so that rounds end at the ends of stretches, which are then taken as a whole.
#[test]
fn rounds_end_with_stretches() {
    on_gpu(|gpu| {
        let case = Case { name: "even", size: [256, 40], samples: 4, candidates: 9 * 256, fragments: 1 << 20, ..USUAL };
        let content = vec![(1, [3, 0, 0, 0]); 256 * 40];
        let passes = Passes::new(gpu, &case);
        let expected = passes.twin.of(&twins_of(&content));
        let found = passes.run(&content, expected.len());
        for (round, found) in expected.iter().zip(&found) {
            assert_eq!(round.tiles.len() % 256, 0);
            let next = found.counters[Counter::NextTile as usize];
            assert_eq!(next as usize, round.tiles.end);
        }
        assert_eq!(expected.len(), 14);
    });
}

/// Each tile needs the most that it may ask for: at most twice as many rounds are recorded as these tiles take.
#[test]
fn as_many_rounds_are_recorded_as_tiles_may_take() {
    on_gpu(|gpu| {
        const MUCH: u32 = 8_000_000;
        for (name, triangles, fragments, fragments_are, tile) in [
            ("fragments", 1000, 200_000, FragmentRate::Part, [2, 0, 0, 0]),
            ("samples", 1000, 200_000, FragmentRate::Sample, [0; 4]),
            ("candidates", 1000, MUCH, FragmentRate::Triangle, [60, 0, 0, 0]),
            ("dense", 350_000, MUCH, FragmentRate::Triangle, [2501, 0, 0, 0]),
        ] {
            let case =
                Case { name, size: [60, 40], triangles, fragments_are, fragments, unlisted: tile[0] > 2500, ..USUAL };
            let passes = Passes::new(gpu, &case);
            let content = vec![(u32::MAX, tile); 60 * 40];
            let taken = passes.twin.of(&twins_of(&content)).len();
            let recorded = passes.recorded(60 * 40 * tile[0]);
            assert!(taken > 5, "{name}: {taken}");
            // More rounds are recorded for dense tiles, because it is not known beforehand that these tiles have no
            // lists.
            let most = if case.unlisted { recorded } else { 2 * taken };
            assert!((taken..=most).contains(&recorded), "{name}: {taken} of {recorded}");
        }
    });
}
