//! Properties of the sample patterns.

use std::collections::HashSet;

use gpc::sampling::{MAX_SAMPLES, Pattern, PatternError, owen_sobol};

const NAMED: [Pattern; 6] =
    [Pattern::Lines, Pattern::Sobol, Pattern::Lattice, Pattern::Korobov, Pattern::Grid, Pattern::Rotated];

/// Offsets in whole units of 2^-16 pixel from the pixel's top left corner.
fn units(offsets: &[[f32; 2]]) -> Vec<[u32; 2]> {
    let unit = |v: f32| {
        let units = (f64::from(v) + 0.5) * 65536.0;
        assert!(units.fract() == 0.0 && (0.0..65536.0).contains(&units), "{v} is no location in a pixel");
        units as u32
    };
    offsets.iter().map(|offset| offset.map(unit)).collect()
}

/// Numbers of samples that a pattern supports.
fn counts(pattern: &Pattern) -> Vec<u32> {
    (1..=MAX_SAMPLES).filter(|&count| pattern.offsets(count).is_ok()).collect()
}

#[test]
fn every_count_gives_so_many_different_locations() {
    for pattern in NAMED {
        for count in counts(&pattern) {
            let offsets = pattern.offsets(count).unwrap();
            assert_eq!(offsets.len(), count as usize, "{pattern}");
            let different: HashSet<_> = units(&offsets).into_iter().collect();
            assert_eq!(different.len(), count as usize, "{pattern} {count}");
        }
    }
}

#[test]
fn patterns_can_have_the_counts_they_promise() {
    let all: Vec<u32> = (1..=1024).collect();
    for pattern in [Pattern::Sobol, Pattern::Lattice, Pattern::Korobov] {
        assert_eq!(counts(&pattern), all, "{pattern}");
    }
    let squares: Vec<u32> = (1..=32).map(|side| side * side).collect();
    assert_eq!(counts(&Pattern::Grid), squares);
    assert_eq!(counts(&Pattern::Rotated), [1, 2, 4, 8, 16]);
}

#[test]
fn one_sample_is_the_centre() {
    for pattern in NAMED {
        assert_eq!(pattern.offsets(1).unwrap(), [[0.0, 0.0]], "{pattern}");
    }
}

#[test]
fn offsets_are_the_same_each_time() {
    for pattern in NAMED {
        assert_eq!(pattern.offsets(16).unwrap(), pattern.offsets(16).unwrap(), "{pattern}");
    }
}

/// Asserts that each box of every shape holds one sample: the definition of a (0,m,2)-net in base 2.
fn assert_net(samples: &[[u32; 2]], what: &str) {
    let digits = samples.len().ilog2();
    for across in 0..=digits {
        let boxes: HashSet<_> =
            samples.iter().map(|&[x, y]| (x >> (16 - across), y >> (16 - (digits - across)))).collect();
        assert_eq!(boxes.len(), samples.len(), "{what}: boxes 2^-{across} wide");
    }
}

#[test]
fn sobol_points_are_nets() {
    for digits in 1..=10 {
        let count = 1 << digits;
        assert_net(&units(&Pattern::Sobol.offsets(count).unwrap()), &format!("{count} samples"));
    }
}

#[test]
fn scrambling_keeps_the_sequence_a_sequence_of_nets() {
    for seed in [0, 1, 77, u32::MAX] {
        let points = units(&owen_sobol(1024, seed));
        for length in [4, 16, 64, 256] {
            for run in points.chunks_exact(length) {
                assert_net(run, &format!("seed {seed}, a run of {length}"));
            }
        }
    }
    assert_ne!(owen_sobol(16, 0), owen_sobol(16, 1));
}

/// The columns and the rows of lattices are distinct and evenly spaced.
#[test]
fn lattices_project_evenly() {
    for pattern in [Pattern::Lattice, Pattern::Korobov] {
        for count in [2, 3, 7, 16, 63, 64, 100, 255, 256, 1000, 1023, 1024] {
            let samples = units(&pattern.offsets(count).unwrap());
            for axis in 0..2 {
                let mut projection: Vec<u32> = samples.iter().map(|sample| sample[axis]).collect();
                projection.sort_unstable();
                for (place, &found) in projection.iter().enumerate() {
                    let expected = (place as f64 + 0.5) / f64::from(count) * 65536.0;
                    assert!(
                        (f64::from(found) - expected).abs() <= 0.5,
                        "{pattern} {count}, axis {axis}, place {place}"
                    );
                }
            }
        }
    }
}

/// Rows of the square lattice are straight and evenly spaced, as the computation of spans requires.
#[test]
fn square_lattices_have_straight_rows() {
    for side in [2_u32, 4, 8, 16, 32] {
        let samples: HashSet<[u32; 2]> = units(&Pattern::Lattice.offsets(side * side).unwrap()).into_iter().collect();
        let step = 65536.0 / f64::from(side);
        let tilt = step / f64::from(side);
        // A power of two divides all vectors of the lattice, so that nothing is rounded.
        let first = samples.iter().copied().min_by_key(|&[x, _]| x).unwrap().map(f64::from);
        for row in 0..side {
            for column in 0..side {
                let (i, j) = (f64::from(column), f64::from(row));
                let expected = [first[0] + i * step + j * tilt, first[1] + j * step - i * tilt];
                assert!(samples.contains(&expected.map(|v| v as u32)), "side {side}, row {row}, column {column}");
            }
        }
    }
}

/// The standard patterns of Direct3D 11 ("D3D11_STANDARD_MULTISAMPLE_QUALITY_LEVELS"), which are also Vulkan's, in
/// sixteenths of a pixel from the centre.
#[test]
fn rotated_patterns_are_the_standard_ones() {
    let standard: [&[[i8; 2]]; 4] = [
        &[[4, 4], [-4, -4]],
        &[[-2, -6], [6, -2], [-6, 2], [2, 6]],
        &[[1, -3], [-1, 3], [5, 1], [-3, -5], [-5, 5], [-7, -1], [3, 7], [7, -7]],
        &[
            [1, 1],
            [-1, -3],
            [-3, 2],
            [4, -1],
            [-5, -2],
            [2, 5],
            [5, 3],
            [3, -5],
            [-2, 6],
            [0, -7],
            [-4, -6],
            [-6, 4],
            [-8, 0],
            [7, -4],
            [6, 7],
            [-7, -8],
        ],
    ];
    for set in standard {
        let offsets = Pattern::Rotated.offsets(set.len() as u32).unwrap();
        let found: HashSet<[i8; 2]> = offsets.iter().map(|offset| offset.map(|v| (v * 16.0) as i8)).collect();
        assert_eq!(found, set.iter().copied().collect());
    }
}

/// Longer side of a run's bounding box, in pixels.
fn extent(run: &[[f32; 2]]) -> f32 {
    (0..2)
        .map(|axis| {
            let values = run.iter().map(|sample| sample[axis]);
            values.clone().fold(f32::MIN, f32::max) - values.fold(f32::MAX, f32::min)
        })
        .fold(0.0, f32::max)
}

#[test]
fn runs_of_64_and_256_samples_are_compact() {
    for pattern in [Pattern::Sobol, Pattern::Lattice, Pattern::Korobov, Pattern::Grid] {
        let offsets = pattern.offsets(1024).unwrap();
        // The boxes have sides of 1/4 and 1/2; a turned lattice extends beyond them by its tilt.
        for (length, side) in [(64, 0.25), (256, 0.5)] {
            for run in offsets.chunks(length) {
                assert!(extent(run) < side * 1.15, "{pattern}: a run of {length} is {} wide", extent(run));
            }
        }
    }
    // For numbers that are no powers of two, full runs are no long strips, and the rest is shorter.
    for count in [100, 300, 520, 777, 1000, 1023] {
        let offsets = Pattern::Sobol.offsets(count).unwrap();
        for run in offsets.chunks_exact(64) {
            let side = (64.0 / count as f32).sqrt();
            assert!(extent(run) < 2.5 * side, "{count}: a run of 64 is {} wide", extent(run));
        }
    }
}

#[test]
fn names_go_both_ways() {
    for pattern in NAMED {
        assert_eq!(pattern.to_string().parse(), Ok(pattern));
    }
    let error = "hex".parse::<Pattern>().unwrap_err();
    assert_eq!(error, PatternError::Unknown("hex".to_owned()));
    for pattern in NAMED {
        assert!(error.to_string().contains(&pattern.to_string()), "{error}");
    }
}

#[test]
fn impossible_counts_are_refused_with_a_way_out() {
    for pattern in NAMED {
        for count in [0, 1025, u32::MAX] {
            assert_eq!(pattern.offsets(count), Err(PatternError::CountOutOfRange(count)));
        }
    }
    let grid = Pattern::Grid.offsets(50).unwrap_err().to_string();
    assert!(grid.contains("50") && grid.contains("49 or 64"), "{grid}");
    let top = Pattern::Grid.offsets(1023).unwrap_err().to_string();
    assert!(top.contains("961 or 1024"), "{top}");
    let rotated = Pattern::Rotated.offsets(64).unwrap_err().to_string();
    assert!(rotated.contains("1, 2, 4, 8 or 16"), "{rotated}");
}

#[test]
fn lists_are_rounded_and_ordered() {
    let list = Pattern::List(vec![[0.25, 0.3], [-0.5, -0.5], [0.499_999_97, -0.25]]);
    let offsets = list.offsets(3).unwrap();
    let found: HashSet<_> = units(&offsets).into_iter().collect();
    assert_eq!(found, HashSet::from([[49152, 52429], [0, 0], [65535, 16384]]));
    let turned = Pattern::List(vec![[0.499_999_97, -0.25], [0.25, 0.3], [-0.5, -0.5]]);
    assert_eq!(turned.offsets(3).unwrap(), offsets);
    assert_eq!(Pattern::List(vec![[0.125, 0.25]]).offsets(1).unwrap(), [[0.125, 0.25]]);
}

#[test]
fn invalid_lists_are_refused() {
    let refusal = |list: &[[f32; 2]], count| Pattern::List(list.to_vec()).offsets(count).unwrap_err();
    assert_eq!(refusal(&[[0.0, 0.0]], 2), PatternError::ListLength { count: 2, found: 1 });
    for bad in [f32::NAN, f32::INFINITY, 0.5, -0.500_001] {
        for offset in [[bad, 0.0], [0.0, bad]] {
            let error = refusal(&[[0.1, 0.1], offset], 2);
            assert!(matches!(error, PatternError::ListOutside { index: 1, .. }), "{error}");
        }
    }
    assert_eq!(
        refusal(&[[0.1, 0.1], [0.2, 0.2], [0.1, 0.100_000_01]], 3),
        PatternError::ListDuplicate { first: 0, second: 2 }
    );
}
