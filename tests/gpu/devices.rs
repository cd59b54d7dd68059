//! One device that simulates others: several teams in a subgroup, and the limits that Vulkan guarantees.

use gpc::render::{EngineError, Headless, RenderError, SceneRequest, Settings, Shading, Shadows};
use gpc::sampling::Pattern;
use gpc::scene::{AlphaMode, Material, MeshInstance};
use gpc::vulkan::{Limits, Teams, VulkanError};

use crate::detect::mosaic;
use crate::rounds::render;
use crate::scenes::{ball_over_checker, layered};
use crate::stage::{Stage, as_cpu, as_gpu, camera, everywhere, flat, on_cpu, on_gpu, open, run_once};

/// Runs a test on a device with lower limits; fails if the validation layer reports a message.
pub fn within(lower: impl FnOnce(&mut Limits), test: impl FnOnce(&mut Headless)) {
    run_once(open(lower), test);
}

/// Gives a device as few texel elements as Vulkan guarantees: lists have room for 16,384 candidates.
pub fn few_texel_elements(limits: &mut Limits) {
    limits.max_texel_elements = limits.max_texel_elements.min(1 << 16);
}

/// The same number of invocations as `teams` has, in teams of 4. So subgroups of 8 or more have several teams, which take
/// different branches.
fn in_teams_of_four(teams: &mut Teams) {
    teams.in_workgroup *= teams.members / 4;
    teams.members = 4;
    // No kernel takes larger teams then.
    teams.known_subgroup = None;
}

/// Every image has the same bytes with teams of 4 as with teams of 8, whether each subgroup samples the cells of a tile or several
/// single cells.
#[test]
fn several_teams_in_a_subgroup_make_the_same_image() {
    const SIZE: [u32; 2] = [64, 48];
    let settings = |pattern: &Pattern, samples, shading| {
        everywhere(SIZE, pattern.clone(), samples).map_superpixels(|options| options.shading(shading))
    };
    let cases = [
        settings(&Pattern::Lines, 64, Shading::Part),
        settings(&Pattern::Lines, 1024, Shading::Part),
        settings(&Pattern::Sobol, 8, Shading::Part),
        settings(&Pattern::Sobol, 64, Shading::Part),
        settings(&Pattern::Sobol, 16, Shading::Sample),
        settings(&Pattern::Sobol, 64, Shading::Part).shadows(Shadows::Exact),
    ];
    // Only samples of scenes without BLEND triangles are merged.
    let unshadowed = &cases[..cases.len() - 1];
    let stages = [(ball_over_checker(), &cases[..]), (layered(), unshadowed), (mosaic(5, SIZE), unshadowed)];
    let mut images = Vec::new();
    on_gpu(|gpu| {
        for (stage, cases) in &stages {
            images.extend(cases.iter().map(|settings| render(gpu, stage, settings).colors));
        }
    });
    for (kind, policy) in [("CPU", as_cpu as fn(&mut Limits)), ("GPU", as_gpu as fn(&mut Limits))] {
        let lower = |limits: &mut Limits| {
            policy(limits);
            in_teams_of_four(&mut limits.teams);
        };
        within(lower, |gpu| {
            let mut expected = images.iter();
            for (number, (stage, cases)) in stages.iter().enumerate() {
                for settings in *cases {
                    let found = render(gpu, stage, settings);
                    assert!(Some(&found.colors) == expected.next(), "{kind}, stage {number}, {:?}", settings.method);
                }
            }
        });
    }
}

/// On a GPU a team samples a single cell. The image is that of teams that sample the cells of a tile.
#[test]
fn single_cells_make_the_same_image() {
    let test = |several: &mut Headless, single: &mut Headless| {
        for stage in [ball_over_checker(), layered()] {
            for (pattern, samples) in [
                (Pattern::Lines, 4),
                (Pattern::Lines, 64),
                (Pattern::Lines, 256),
                (Pattern::Lines, 1024),
                (Pattern::Sobol, 16),
                (Pattern::Sobol, 256),
            ] {
                let settings = everywhere([64, 48], pattern.clone(), samples);
                let expected = stage.render(several, &settings);
                let found = stage.render(single, &settings);
                assert!(found.colors == expected.colors, "{pattern:?}, {samples} samples");
            }
        }
    };
    on_cpu(|several| within(as_gpu, |single| test(several, single)));
}

/// On a device that may be reset, an image is submitted in parts, which are smaller for more samples a pixel; the
/// image is the same.
#[test]
fn long_work_is_submitted_in_parts() {
    let stage = layered();
    let test = |gpu: &mut Headless, bounded: &mut Headless| {
        for (samples, regions) in [(16, 1), (64, 2), (256, 16)] {
            let settings = everywhere([320, 192], Pattern::Sobol, samples);
            let whole = stage.render(gpu, &settings);
            assert_eq!(whole.statistics.regions, 1);
            let found = stage.render(bounded, &settings);
            assert_eq!(found.statistics.regions, regions);
            assert!(found.colors == whole.colors);
        }
    };
    let lower = |limits: &mut Limits| limits.max_submitted_samples = 1 << 21;
    on_gpu(|gpu| within(lower, |bounded| test(gpu, bounded)));
}

/// Limits that Vulkan guarantees on every device.
fn guaranteed(limits: &mut Limits) {
    limits.max_texel_elements = 1 << 16;
    limits.max_storage_bytes = 1 << 27;
}

/// An image with more pixels, visibility samples and candidates than a texel buffer holds is rendered in regions.
#[test]
fn small_texel_buffers_make_the_same_image() {
    let stage = layered();
    let settings = everywhere([320, 240], Pattern::Sobol, 64);
    let mut expected = None;
    on_gpu(|gpu| expected = Some(stage.render(gpu, &settings)));
    let expected = expected.unwrap();
    assert_eq!(expected.statistics.regions, 1);
    within(guaranteed, |gpu| {
        let found = stage.render(gpu, &settings);
        assert!(found.statistics.regions > 1);
        assert!(found.colors == expected.colors);
    });
}

/// A scene that no texel buffer can hold is refused with an error, not drawn in part.
#[test]
fn scenes_beyond_texel_buffers_are_refused() {
    let mut stage = Stage::new(vec![Material::default()]);
    for _ in 0..=1 << 16 {
        stage.add(0, [[-1.0, -1.0, -5.0], [1.0, -1.0, -5.0], [0.0, 1.0, -5.0]]);
    }
    let (scene, pose) = stage.build();
    within(guaranteed, |gpu| {
        let refused = gpu.upload(SceneRequest::new(&scene, &pose)).err();
        assert!(
            matches!(
                refused,
                Some(RenderError::Engine(EngineError::Vulkan(VulkanError::TooLarge { limit: 65_536, .. })))
            ),
            "{refused:?}"
        );
    });
}

/// Dispatches over more than 32,768 workgroups have a second row.
#[test]
fn the_last_of_many_triangles_is_sampled() {
    // There are a few more triangles than 32,768 workgroups of 64 invocations with 8 triangles each process.
    const MANY: u32 = (1 << 24) + 64;
    const MESH: u32 = 1 << 16;
    let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
    stage.add(0, [[-1.0, -1.0, -5.0], [1.0, -1.0, -5.0], [0.1, 1.0, -5.0]]);
    for _ in 1..MESH {
        stage.add(0, [[0.0, 0.0, 9.0], [1.0, 0.0, 9.0], [0.0, 1.0, 9.0]]);
    }
    let (scene, mut pose) = stage.build();
    let instance = |first_triangle, triangle_count, first_index| MeshInstance {
        first_triangle,
        triangle_count,
        first_index,
        transform: glam::DAffine3::IDENTITY,
    };
    // The visible triangle is the last one.
    let mut first_index = 0;
    while first_index < MANY {
        let some = instance(64, MESH - 64, first_index);
        pose.geometry.instances.push(some);
        first_index += (MESH - 64).next_multiple_of(MeshInstance::ALIGNMENT);
    }
    pose.geometry.instances.push(instance(0, 1, first_index));
    on_gpu(|gpu| {
        let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
        let mut frame = gpu.prepare(&prepared, &Settings::new(48, 32)).unwrap();
        let rendered = gpu.render(&mut frame, &camera()).unwrap();
        assert_eq!(rendered.statistics.triangles.drawn, 1);
        assert!(rendered.statistics.superpixels > 20);
        let partly = rendered.colors.iter().filter(|c| c[3] > 0.1 && c[3] < 0.9);
        assert!(partly.count() > 10);
    });
}
