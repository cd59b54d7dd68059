//! Blended draws of a host, compared with scenes of files that have the same triangles.

use super::machine::{Base, Machine};
use super::world::{Drawn, Mesh, PLACED, Part, SIZE, Way, World};
use crate::stage::{NEAR, Stage, flat, ids, on_gpu, once, seen_at};

use gpc::host::Options;
use gpc::render::{Shading, SuperpixelOptions};
use gpc::scene::AlphaMode;

/// A wall, and panes that intersect it and each other: places and distances of their corners, and their colours.
const QUADS: [([[f64; 3]; 4], [f32; 4]); 4] = [
    ([[-25.0, -22.0, 4.0], [-28.0, 24.0, 4.5], [26.0, 21.0, 3.5], [24.0, -27.0, 4.0]], [0.5, 0.25, 0.125, 1.0]),
    ([[-30.0, -9.0, 2.0], [-12.0, 29.0, 6.0], [11.0, 12.0, 6.0], [20.0, -11.0, 2.0]], [1.0, 0.5, 0.0, 0.25]),
    ([[-9.0, -30.0, 5.0], [-21.0, 9.0, 3.0], [29.0, 20.0, 3.0], [17.0, -16.0, 5.0]], [0.0, 0.5, 1.0, 0.5]),
    ([[2.0, -29.0, 3.0], [-1.5, 30.0, 4.0], [3.0, 28.0, 4.0], [5.0, -28.0, 3.0]], [0.25, 1.0, 0.5, 0.75]),
];

fn corners(number: usize) -> [[f32; 3]; 4] {
    let place = |[x, y, distance]: [f64; 3]| seen_at([x, y], distance, SIZE[1]);
    QUADS[number].0.map(place)
}

fn stage() -> Stage {
    let mode = |opacity| {
        if opacity < 1.0 { AlphaMode::Blend } else { AlphaMode::Opaque }
    };
    let material = |(_, look): ([[f64; 3]; 4], [f32; 4])| flat(look, mode(look[3]));
    let mut stage = Stage::new(QUADS.map(material).into());
    for number in 0..QUADS.len() {
        stage.add_quad(number, corners(number));
    }
    stage
}

pub fn world() -> World {
    let mut camera = [[0.0; 4]; 4];
    (camera[0][0], camera[1][1]) = (1.0, -1.0);
    (camera[2][3], camera[3][2]) = (-1.0, NEAR as f32);
    let part = |number: usize| {
        let [r, g, b, opacity] = QUADS[number].1;
        Part { mesh: number, to_clip: camera, color: [r, g, b], opacity, alpha_map: None }
    };
    let mesh = |number| Mesh {
        positions: corners(number).to_vec(),
        paints: vec![1.0; 4],
        coordinates: vec![[0.0; 2]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    };
    World {
        meshes: (0..QUADS.len()).map(mesh).collect(),
        parts: (0..QUADS.len()).map(part).collect(),
        maps: Vec::new(),
        projection: camera,
    }
}

#[test]
fn blended_draws_are_composited_as_those_of_files() {
    on_gpu(|gpu| {
        let (stage, world) = (stage(), world());
        let machine = Machine::new(gpu, &world);
        let bare = once(SIZE).background(Some(super::world::SKY));
        let drawn = stage.render(gpu, &bare);
        let drawn = Drawn { ids: ids(&drawn), depths: vec![0.0; (SIZE[0] * SIZE[1]) as usize], colors: drawn.colors };
        let object = Way { object_space: true, stride: 12, ..PLACED };
        for shading in [Shading::Part, Shading::Sample] {
            for samples in [16, 64] {
                let settings = bare.clone().method(SuperpixelOptions::new(samples).shading(shading).thin(false));
                let expected = stage.render(gpu, &settings);
                for (way, base) in
                    [(PLACED, Base::All(&drawn)), (object, Base::All(&drawn)), (object, Base::Colors(&drawn))]
                {
                    let options = Options::new(SIZE[0], SIZE[1])
                        .thin(false)
                        .samples(samples)
                        .shading(shading)
                        .flat_background(true);
                    let found = machine.see_lent(&way, &world.lent(&way), base, options);
                    assert_eq!(found.outcome.left_over, 0);
                    let superpixels = found.outcome.statistics.superpixels;
                    assert_eq!(superpixels, expected.statistics.superpixels);
                    assert!(superpixels > 300, "{superpixels}");
                    let pairs = found.colors.iter().zip(&expected.colors);
                    let channels = pairs.flat_map(|(a, b)| (0..4).map(|i| (a[i] - b[i]).abs()));
                    let worst = channels.fold(0.0, f32::max);
                    assert!(worst < 1e-5, "{way:?}, {shading:?}: {worst}");
                }
            }
        }
    });
}
