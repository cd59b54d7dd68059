//! Sampling sets: every sample is in exactly one cell; layouts, Jacobians, statistics and refused requests.

use glam::{DMat2, DVec2};
use gpc::camera::LocationMap;
use gpc::camera::set::{Layout, Sample, SamplingSet, SetError, mapped_locations};
use gpc::camera::zoom::{Shape, Transition, ZoomMap, ZoomRegion};

/// Deterministic pseudo-random numbers from 0 to 1.
fn random() -> impl FnMut() -> f64 {
    let mut state = 7_u64;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn scattered(count: u32, mut place: impl FnMut() -> [f64; 2]) -> Vec<Sample> {
    let sample = |col| Sample { uv: place(), row: 0, col };
    (0..count).map(sample).collect()
}

/// Asserts that each sample is in exactly one cell.
fn assert_partition(set: &SamplingSet) {
    let mut members: Vec<_> = set.cells().flatten().copied().collect();
    members.sort_unstable();
    assert!(members.into_iter().eq(0..set.samples().len() as u32));
}

/// A linear map that is close to the identity, or folds.
struct Sheared(DMat2);

impl LocationMap for Sheared {
    fn location(&self, place: DVec2) -> DVec2 {
        self.0 * place
    }

    fn jacobian(&self, _: DVec2) -> DMat2 {
        self.0
    }
}

#[test]
fn a_planar_set_is_the_offset_set_without_offsets() {
    let planar = SamplingSet::planar([13, 7]).unwrap();
    assert_partition(&planar);
    let fitted = SamplingSet::offset([13, 7], planar.samples().to_vec()).unwrap();
    assert_eq!(fitted, planar);
    for cell in planar.offsets().unwrap() {
        assert_eq!(cell, [[0.0, 0.0]]);
    }
    let statistics = planar.statistics();
    assert_eq!(statistics.lowest_rate, Some(1.0));
    assert_eq!(statistics.highest_rate, Some(1.0));
    assert_eq!((statistics.quads, statistics.folds), (72, 0));
    for (index, location) in planar.locations().iter().enumerate() {
        assert_eq!(location.output as usize, index);
        assert_eq!(location.jacobian, [[1.0, 0.0], [0.0, 1.0]]);
    }
}

#[test]
fn an_offset_grid_parts_all_samples_and_its_offsets_lead_back() {
    let mut random = random();
    // The samples are a regular grid in random order.
    let mut index = 0.0;
    let samples = scattered(400, || {
        index += 1.0;
        let (row, col) = ((index / 20.0_f64).floor(), index % 20.0);
        [4.0 * col + random() - 20.0, 3.0 * row + random() + 1000.0]
    });
    let set = SamplingSet::offset([400, 1], samples.clone()).unwrap();
    assert_partition(&set);
    let Layout::Grid(grid) = set.layout() else {
        panic!("an offset set has a grid");
    };
    assert!(set.cells().all(|cell| cell.len() <= 1));
    let offsets = set.offsets().unwrap();
    for ((index, members), offset) in set.cells().enumerate().zip(&offsets) {
        for (member, offset) in members.iter().zip(offset) {
            let (row, col) = (index / grid.columns as usize, index % grid.columns as usize);
            let centre = [col as f64 + 0.5, row as f64 + 0.5];
            for axis in 0..2 {
                let back = grid.origin[axis] + grid.pitch * centre[axis] + offset[axis];
                assert!((back - samples[*member as usize].uv[axis]).abs() < 1e-9);
                assert!(offset[axis].abs() <= 0.5 * grid.pitch + 1e-9);
            }
        }
    }
}

#[test]
fn no_grid_parts_samples_that_coincide() {
    for apart in [0.0, 1e-9] {
        let samples = vec![[0.0, 0.0], [5.0, 5.0], [9.0, 1.0], [5.0 + apart, 5.0]];
        let mut places = samples.into_iter();
        let samples = scattered(4, || places.next().unwrap());
        let error = SamplingSet::offset([4, 1], samples).unwrap_err();
        assert!(matches!(error, SetError::NoGrid { first: 1, second: 3, .. }), "{error}");
    }
    let error = SamplingSet::offset([3, 1], scattered(3, || [7.25, 7.25])).unwrap_err();
    assert!(matches!(error, SetError::NoGrid { first: 0, second: 1, .. }));
    assert!(SamplingSet::offset([1, 1], scattered(1, || [7.25, 7.25])).is_ok());
}

#[test]
fn superpixels_have_two_rates() {
    let marks = [false, true, false, false, false, true];
    let offsets = [[-0.25, -0.25], [0.25, -0.25], [0.0, 0.25]];
    let set = SamplingSet::superpixel([3, 2], &marks, &offsets).unwrap();
    assert_partition(&set);
    let counts: Vec<_> = set.cells().map(<[u32]>::len).collect();
    assert_eq!(counts, [1, 3, 1, 1, 1, 3]);
    assert_eq!(set.samples()[2].uv, [1.75, 0.25]);
    let colors: Vec<_> = (0..10).map(|i| [i as f32, 0.0, 0.0, 1.0]).collect();
    let reds: Vec<_> = set.image(&colors).iter().map(|color| color[0]).collect();
    assert_eq!(reds, [0.0, 2.0, 4.0, 5.0, 6.0, 8.0]);
    let error = SamplingSet::superpixel([3, 2], &marks[1..], &offsets);
    assert_eq!(error, Err(SetError::Marks { expected: 6, found: 5 }));
}

#[test]
fn leaves_tile_the_window_and_hold_no_more_than_asked() {
    let mut random = random();
    let samples = scattered(5000, || [random().powi(3) * 300.0, random() * 40.0]);
    let window = Some([[0.0, 0.0], [200.0, 40.0]]);
    let set = SamplingSet::no_pattern([5000, 1], samples.clone(), window, 9).unwrap();
    assert_partition(&set);
    let Layout::Tree(leaves) = set.layout() else {
        panic!("a no-pattern set has a tree");
    };
    assert!((leaves.iter().map(|leaf| leaf.side * leaf.side).sum::<f64>() - 4e4).abs() < 1e-6);
    for (leaf, members) in leaves.iter().zip(set.cells()) {
        assert!(members.len() <= 9);
        assert!(members.iter().all(|i| leaf.contains(samples[*i as usize].uv)));
    }
    // Samples to the right of the window are in a cell after the leaves.
    let outside = samples.iter().filter(|sample| sample.uv[0] >= 200.0).count();
    assert!(outside > 100);
    assert_eq!(set.cells().count(), leaves.len() + 1);
    assert_eq!(set.cells().last().unwrap().len(), outside);
}

#[test]
fn a_million_samples_in_one_spot_are_one_leaf() {
    let samples = scattered(1_000_000, || [3.5, 3.5]);
    let set = SamplingSet::no_pattern([1_000_000, 1], samples, None, 32).unwrap();
    assert_eq!(set.cells().count(), 1);
    // One more sample is elsewhere, and one is too close to be separated by the limit of depth.
    let mut places = [[0.0, 0.0], [3.5 + 1e-12, 3.5]].into_iter();
    let samples = scattered(100_000, || places.next().unwrap_or([3.5, 3.5]));
    let set = SamplingSet::no_pattern([100_000, 1], samples, None, 1).unwrap();
    assert_partition(&set);
    assert_eq!(set.statistics().fullest_cell, 99_999);
}

#[test]
fn jacobians_come_from_the_map_or_from_neighbours() {
    let matrix = DMat2::from_cols(DVec2::new(0.5, 0.125), DVec2::new(-0.25, 2.0));
    let mapped = SamplingSet::mapped([6, 5], &Sheared(matrix)).unwrap();
    let bare = SamplingSet::no_pattern([6, 5], mapped.samples().to_vec(), None, 4).unwrap();
    for set in [mapped, bare] {
        for location in set.locations() {
            let found = DMat2::from_cols_array_2d(&location.jacobian);
            assert!((found - matrix).determinant().abs() < 1e-12);
            assert!((found.x_axis - matrix.x_axis).length() < 1e-12);
        }
    }
    // A single row has a square footprint, a single sample that of a pixel.
    let mut place = 0.0;
    let row = scattered(3, || {
        place += 3.0;
        [place, 0.0]
    });
    let row = SamplingSet::no_pattern([3, 1], row, None, 4).unwrap();
    assert_eq!(row.locations()[1].jacobian, [[3.0, 0.0], [0.0, 3.0]]);
    let lone = SamplingSet::no_pattern([1, 1], scattered(1, || [4.0, 4.0]), None, 4).unwrap();
    assert_eq!(lone.locations()[0].jacobian, [[1.0, 0.0], [0.0, 1.0]]);
}

#[test]
fn mapped_locations_are_those_of_the_set() {
    let map = Sheared(DMat2::from_cols(DVec2::new(0.5, 0.125), DVec2::new(-0.25, 2.0)));
    let set = SamplingSet::mapped([6, 5], &map).unwrap();
    assert_eq!(mapped_locations([6, 5], &map).unwrap(), set.locations());
    let second_row = set.locations()[6];
    assert_eq!(second_row.output, 6);
    assert_eq!(second_row.uv, map.location(DVec2::new(0.5, 1.5)).to_array());
    for size in [[0, 5], [1 << 16, 1 << 16]] {
        let [columns, rows] = size;
        assert_eq!(mapped_locations(size, &map), Err(SetError::Size { columns, rows }));
    }
}

#[test]
fn cells_far_apart_cost_no_memory() {
    // The samples are at the corners of an output with a quarter of a billion cells, and beside the last one.
    let (last, far) = ((1 << 14) - 1, [0.5, 0.5]);
    let at = |row, col, uv| Sample { uv, row, col };
    let samples = vec![at(last, last, [9.0, 9.0]), at(0, 0, far), at(last, last - 1, [8.0, 8.5])];
    let set = SamplingSet::no_pattern([1 << 14; 2], samples, None, 4).unwrap();
    let jacobians: Vec<_> = set.locations().iter().map(|location| location.jacobian).collect();
    assert_eq!(jacobians[0], [[1.0, 0.5], [-0.5, 1.0]]);
    assert_eq!(jacobians[1], [[1.0, 0.0], [0.0, 1.0]]);
    assert_eq!(set.statistics().quads, 0);
}

#[test]
fn statistics_know_the_rates_of_a_zoom_and_see_folds() {
    let region = ZoomRegion {
        center: [40.0, 40.0],
        radius: [12.0, 12.0],
        multiplicity: 0.5,
        shape: Shape::Rectangle,
        transition: Transition::Linear,
    };
    let zoom = ZoomMap::new(vec![region]).unwrap();
    let statistics = SamplingSet::mapped([80, 80], &zoom).unwrap().statistics();
    assert_eq!(statistics.folds, 0);
    assert!((statistics.highest_rate.unwrap() - 4.0).abs() < 1e-9);
    // At the outer end of the transition, each pixel covers 2 - m^2 pixels of the plane in length.
    let lowest = statistics.lowest_rate.unwrap();
    assert!(lowest > 1.0 / 1.75 && lowest < 1.0 / 1.65, "{lowest}");

    let mirrored = DMat2::from_cols(DVec2::NEG_X, DVec2::Y);
    let folded = SamplingSet::mapped([10, 10], &Sheared(mirrored)).unwrap();
    assert_eq!(folded.statistics().folds, 81);
}

#[test]
fn impossible_samples_are_refused_by_name() {
    let with = |uv, row| {
        let mut samples = SamplingSet::planar([4, 4]).unwrap().samples().to_vec();
        samples[5] = Sample { uv, row, col: 1 };
        SamplingSet::no_pattern([4, 4], samples, None, 8)
    };
    assert!(with([2.0e5, 0.0], 3).is_ok());
    assert!(matches!(with([f64::NAN, 0.0], 1), Err(SetError::NotFinite { index: 5, .. })));
    assert!(matches!(with([0.0, f64::INFINITY], 1), Err(SetError::NotFinite { index: 5, .. })));
    assert!(matches!(with([0.0, -2e6], 1), Err(SetError::Far { index: 5, .. })));
    assert!(matches!(with([0.0, 0.0], 4), Err(SetError::Cell { index: 5, .. })));
    assert_eq!(SamplingSet::no_pattern([4, 4], vec![], None, 8), Err(SetError::Empty));
    assert_eq!(SamplingSet::offset([4, 4], vec![]), Err(SetError::Empty));
    assert!(matches!(SamplingSet::planar([0, 4]), Err(SetError::Size { .. })));
    assert!(matches!(SamplingSet::planar([60_000, 60_000]), Err(SetError::Size { .. })));
    let samples = scattered(4, || [0.0, 0.0]);
    assert_eq!(SamplingSet::no_pattern([4, 1], samples.clone(), None, 0), Err(SetError::LeafSize));
    let empty = Some([[0.0, 0.0], [0.0, 5.0]]);
    assert!(matches!(SamplingSet::no_pattern([4, 1], samples, empty, 3), Err(SetError::Window { .. })));
}
