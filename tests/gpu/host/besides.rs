//! What a host draws besides the triangles that it lends.

use super::machine::{Base, Machine};
use super::world::{Drawn, Mesh, PLACED, Part, SIZE, World, placed, product, projection};
use crate::difference::rmse;
use crate::stage::on_gpu;
use gpc::color::srgb;
use gpc::host::Options;
use std::path::Path;

type Colors = Vec<[f32; 4]>;

const CARD: [f32; 3] = [0.75, 0.7, 0.55];
const PAINT: [f32; 3] = [0.55, 0.03, 0.05];
const POST: [f32; 3] = [0.02, 0.03, 0.03];
/// Columns of the card: where each ends, and whether it is painted.
const COLUMNS: [(f32, bool); 7] =
    [(-0.62, false), (-0.5, true), (-0.26, false), (-0.2, true), (0.0, false), (0.05, true), (0.9, false)];

/// Part with a mesh of its own: a rectangle.
fn add_rectangle(world: &mut World, [left, top]: [f32; 2], [right, bottom]: [f32; 2], part: Part) {
    let corner = |x, y| [x, y, 0.0];
    world.parts.push(Part { mesh: world.meshes.len(), ..part });
    world.meshes.push(Mesh {
        positions: vec![corner(left, top), corner(right, top), corner(right, bottom), corner(left, bottom)],
        paints: vec![1.0; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    });
}

/// A card, and a post in front of it. `painted` says whether the card has its paint, `post` whether the post is there.
fn world(painted: bool, post: bool) -> World {
    let mut world = World { meshes: Vec::new(), parts: Vec::new(), maps: Vec::new(), projection: projection() };
    let part = |around, at, color| Part {
        mesh: 0,
        to_clip: product(&projection(), &placed(around, 0.0, at)),
        color,
        opacity: 1.0,
        alpha_map: None,
    };
    let mut left = -0.9;
    for (right, paint) in COLUMNS {
        let color = if paint && painted { PAINT } else { CARD };
        let part = part(0.13, [0.0, 0.0, -2.0], color);
        add_rectangle(&mut world, [left, -0.7], [right, 0.7], part);
        left = right;
    }
    if post {
        let part = part(-0.12, [0.42, 0.0, -1.8], POST);
        add_rectangle(&mut world, [-0.04, -1.6], [0.04, 1.6], part);
    }
    world
}

/// Draws the sky wherever no triangle is.
fn with_sky(mut drawn: Drawn) -> Drawn {
    for (pixel, (color, id)) in drawn.colors.iter_mut().zip(&drawn.ids).enumerate() {
        if *id == 0 {
            let down = (pixel / SIZE[0] as usize) as f32 / SIZE[1] as f32;
            *color = [0.1 + 0.3 * down, 0.3 + 0.3 * down, 0.8, 1.0];
        }
    }
    drawn
}

/// Draws a cloud of smoke over an image.
fn with_smoke(mut colors: Colors) -> Colors {
    for (pixel, color) in colors.iter_mut().enumerate() {
        let [x, y] = [pixel % SIZE[0] as usize, pixel / SIZE[0] as usize].map(|at| at as f32);
        let away = ((x - 13.0).powi(2) + (y - 46.0).powi(2)).sqrt() / 15.0;
        let opacity = 0.85 * (1.0 - away * away).max(0.0);
        for channel in &mut color[..3] {
            *channel += opacity * (0.9 - *channel);
        }
    }
    colors
}

/// Writes an image, each of its pixels six times as wide and high.
fn write(name: &str, colors: &Colors) {
    let code = |channel: f32| srgb::encode_u8(f64::from(channel));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/pictures");
    image::RgbImage::from_fn(6 * SIZE[0], 6 * SIZE[1], |x, y| {
        let [r, g, b, _] = colors[(y / 6 * SIZE[0] + x / 6) as usize];
        image::Rgb([r, g, b].map(code))
    })
    .save(path.join(name))
    .unwrap();
}

/// Paint belongs into the shading of samples, an occluder among the lent triangles, and smoke after the recording. What is
/// drawn before is lost wherever pixels alias. `tools/pictures.sh` has this test write the pictures of the manual.
#[test]
fn what_hides_lent_triangles_is_lost_if_it_is_only_drawn_before() {
    on_gpu(|gpu| {
        let see = |world: &World, drawn: &Drawn| {
            let options = Options::new(SIZE[0], SIZE[1]);
            let lent = world.lent(&PLACED);
            let seen = Machine::new(gpu, world).see_lent(&PLACED, &lent, Base::All(drawn), options);
            assert_eq!(seen.outcome.left_over, 0);
            seen.colors
        };
        let whole = world(true, true);
        let drawn = with_sky(whole.drawn());
        let right = with_smoke(see(&whole, &drawn));

        let bare = world(false, false);
        let shown = with_smoke(drawn.colors.clone());
        let Drawn { ids, depths, .. } = bare.drawn();
        let before = Drawn { ids, depths, colors: shown.clone() };
        let wrong = see(&bare, &before);

        // The right picture differs from the one with a sample a pixel at edges alone, the wrong one by whole stripes.
        let [right_apart, wrong_apart] = [&right, &wrong].map(|seen| rmse(seen, &shown));
        println!("right {right_apart}, wrong {wrong_apart}");
        assert!(wrong_apart > 2.0 * right_apart);
        if std::env::var_os("GPC_PICTURES").is_some_and(|mode| mode == "write") {
            write("besides-wrong.png", &wrong);
            write("besides-right.png", &right);
        }
    });
}
