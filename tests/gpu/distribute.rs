//! Tiles, cells and groups that `distribute` makes of a list, compared with the CPU's.

use gpc::render::Headless;
use gpc::testing::Random;
use gpc::testing::{Buffer, Recorder};
use gpc::testing::{
    CellSizes, Cells, Counter, Data, Distribute, FrameUniform, ListRegion, ListedLocation, LocationSizes, ResourceSizes,
};
use twins::distribute::{ListBounds, PlacedLocation};

use crate::bare::{Bare, copy};
use crate::stage::on_gpu;
use crate::submit::submit;

const SAMPLES: u32 = 16;
/// Width and height of the region in tiles.
const TILES: [u32; 2] = [13, 21];

/// Output of the device for a list.
struct Found {
    counters: Vec<u32>,
    masks: Vec<u32>,
    loads: Vec<[u32; 4]>,
    order: Vec<u32>,
    cells: Vec<[[u32; 4]; 2]>,
    groups: Vec<[u32; 4]>,
}

fn distributed(gpu: &Headless, cells: Cells, list: &[PlacedLocation]) -> (Found, CellSizes) {
    let team = gpu.gpu().limits().teams.members;
    let cell_sizes = CellSizes::new(team, cells, SAMPLES);
    let tiles = TILES[0] * TILES[1];
    let limits = gpu.gpu().limits();
    let sizes = ResourceSizes {
        locations: Some(LocationSizes::new(list.len() as u32, tiles, &cell_sizes)),
        ..ResourceSizes::new([8 * TILES[0], 4 * TILES[1]], 1, limits)
    };
    let mut bare = Bare::new(gpu, sizes, 1);
    for (to, location) in bare.resources.listed_mut(list.len()).unwrap().iter_mut().zip(list) {
        *to = ListedLocation { pixel: location.pixel, within: location.within, jacobian: location.jacobian };
    }
    let resources = &bare.resources;
    let distribute = Distribute::new(&bare.layout, cells, cell_sizes, resources).unwrap();
    let kept =
        [Data::Counters, Data::Masks, Data::TileLoads, Data::LocationOrder, Data::LocationCells, Data::LocationGroups]
            .map(|data| (resources.buffer(data), bare.like(resources.buffer(data))));
    submit(gpu.gpu(), |commands| {
        // SAFETY: the commands are waited for, and everything to which they refer outlives them.
        let recorder = unsafe { Recorder::new(gpu.gpu(), commands, None) };
        let set = resources.set(0).unwrap();
        resources.record_upload(&recorder);
        resources.record_begin(&recorder, set, &FrameUniform::default());
        let region = ListRegion { tiles: TILES, count: list.len() as u32 };
        distribute.record(&recorder, resources, set, &region);
        drop(recorder);
        for (from, to) in &kept {
            copy(gpu, commands, from, to);
        }
    });
    let [counters, masks, loads, order, cells, groups] = &kept;
    let words = |(_, kept): &(&Buffer, Buffer)| kept.read(kept.size() as usize / 4).unwrap().to_vec();
    let found = Found {
        counters: words(counters),
        masks: words(masks),
        loads: loads.1.read(tiles as usize).unwrap().to_vec(),
        order: words(order),
        cells: cells.1.read(cells.1.size() as usize / 32).unwrap().to_vec(),
        groups: groups.1.read(groups.1.size() as usize / 16).unwrap().to_vec(),
    };
    (found, cell_sizes)
}

fn check(found: &Found, sizes: CellSizes, list: &[PlacedLocation], region: &ListBounds) {
    let counted = |counter: Counter| found.counters[counter as usize];
    let count = (TILES[0] * TILES[1]) as usize;
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); count];
    let mut reach = 0.5_f32;
    for (index, location) in (0..).zip(list) {
        if let Some(tile) = region.tile(location) {
            members[tile as usize].push(index);
            reach = reach.max(region.reach(location));
        }
    }
    let placed: usize = members.iter().map(Vec::len).sum();
    let cells = |members: &Vec<u32>| (members.len() as u32).div_ceil(sizes.in_cell);
    let all_cells: u32 = members.iter().map(cells).sum();
    let all_groups: u32 = members.iter().map(|m| cells(m).div_ceil(sizes.in_group)).sum();
    assert_eq!(counted(Counter::Placed), placed as u32);
    assert_eq!(counted(Counter::LeftOut) as usize, list.len() - placed);
    assert_eq!(counted(Counter::Cells), all_cells);
    assert_eq!(counted(Counter::Groups), all_groups);
    let busy = members.iter().filter(|members| !members.is_empty()).count();
    assert_eq!(counted(Counter::Tiles) as usize, busy);
    let superpixels = if region.points { 0 } else { all_cells };
    assert_eq!(counted(Counter::Superpixels), superpixels);
    let found_reach = f32::from_bits(counted(Counter::Reach));
    assert!((reach..=reach * 1.00001).contains(&found_reach), "{found_reach} for {reach}");

    let mut seen = vec![0_u32; list.len()];
    let mut groups: Vec<[u32; 4]> = found.groups[..all_groups as usize].to_vec();
    groups.sort_unstable_by_key(|[tile, _, _, number]| (*tile, *number));
    for (tile, members) in (0..).zip(&members) {
        let bit = |index: &u32| {
            let [x, y] = list[*index as usize].pixel;
            1_u32 << (8 * y.rem_euclid(4) + x.rem_euclid(8))
        };
        let mask = members.iter().fold(0, |mask, index| mask | bit(index));
        assert_eq!(found.masks[tile as usize], mask);
        let samples = if region.points { members.len() as u32 } else { cells(members) * SAMPLES };
        let [load_cells, load_samples, first_cell, _] = found.loads[tile as usize];
        assert_eq!([load_cells, load_samples], [cells(members), samples]);
        let mut next = 0;
        let mut along = 0;
        for [_, first, held, number] in groups.iter().filter(|group| group[0] == tile) {
            assert_eq!(*number, next);
            assert_eq!(*first, first_cell + next);
            let left = cells(members) - next;
            assert_eq!(*held, left.min(sizes.in_group));
            for cell in *first..first + held {
                let [square, [place, of_cell, ..]] = found.cells[cell as usize];
                let left = members.len() as u32 - (next * sizes.in_cell);
                assert_eq!(of_cell, left.min(sizes.in_cell));
                let indices: Vec<u32> = if region.points {
                    found.order[place as usize..(place + of_cell) as usize].to_vec()
                } else {
                    vec![place]
                };
                let mut own = Vec::new();
                for index in indices {
                    let location = list[index as usize];
                    assert_eq!(region.tile(&location), Some(tile));
                    assert!(location.place_on_curve() >= along);
                    along = location.place_on_curve();
                    seen[index as usize] += 1;
                    own.push(location);
                }
                let [x, y, width, height] = square.map(f32::from_bits);
                let [low, high] = region.bounds(&own);
                for (middle, half, axis) in [(x, width, 0), (y, height, 1)] {
                    assert!(middle - half < low[axis] && middle + half > high[axis]);
                    // The margin is a sixty-fourth of a pixel, and the rounding of large cells.
                    let most = 0.5 * (high[axis] - low[axis]) * 1.00001 + 0.016;
                    assert!(half <= most, "{half} for {low:?} to {high:?}");
                }
                next += 1;
            }
        }
        assert_eq!(next, cells(members));
    }
    for (location, seen) in list.iter().zip(seen) {
        assert_eq!(seen, u32::from(region.tile(location).is_some()));
    }
}

/// Locations all over and around the region, crowds in one pixel, cells of all sizes, and invalid locations.
fn list(random: &mut Random, count: usize) -> Vec<PlacedLocation> {
    let side = [0, 1].map(|axis| f64::from(TILES[axis] * [8, 4][axis]));
    let crowd = [random.below(side[0] as u64) as i32, random.below(side[1] as u64) as i32];
    let location = |_| {
        let mut number = |low: f64, high: f64| random.range(low, high) as f32;
        let wide = f64::from(number(-6.0, 5.0).exp2());
        let mut location = PlacedLocation {
            pixel: [0, 1].map(|axis| number(-8.0, side[axis] + 8.0).floor() as i32),
            within: [number(0.0, 1.0), number(0.0, 1.0)],
            jacobian: [0, 1].map(|_| [number(-wide, wide), number(-wide, wide)]),
        };
        match random.below(40) {
            0..8 => location.pixel = crowd,
            8 => location.within[0] = f32::NAN,
            9 => location.within[1] = 1.25,
            10 => location.jacobian[0][1] = f32::INFINITY,
            11 => location.jacobian[1][1] = f32::NAN,
            12 => location.jacobian[1][0] = 1e9,
            13 => location.pixel = [i32::MIN, 3],
            14 => location.pixel[1] = i32::MAX,
            15 => location.within = [1.0, 0.0],
            _ => {}
        }
        location
    };
    (0..count).map(location).collect()
}

#[test]
fn lists_come_to_the_tiles_and_cells_that_they_lie_in() {
    on_gpu(|gpu| {
        let mut random = Random::new(11);
        for (cells, points) in [(Cells::Points, true), (Cells::Superpixels, false)] {
            let region = ListBounds { tiles: TILES, points };
            // The last list is so long that a crowd makes more cells in its tile than CPU drivers allow iterations of
            // a loop.
            for count in [1, 63, 64, 65, 3_000, 400_000] {
                let list = list(&mut random, count);
                let (found, sizes) = distributed(gpu, cells, &list);
                check(&found, sizes, &list, &region);
            }
        }
    });
}
