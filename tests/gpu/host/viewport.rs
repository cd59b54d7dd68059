//! Viewports, and the depth to which they map clip space.

use super::machine::{Base, Machine};
use super::world::{Drawn, PLACED, SIZE, Way, World};
use crate::difference::rmse;
use crate::stage::on_gpu;
use gpc::host::{Options, Viewport};
use gpc::render::Detection;

/// The part of a picture that begins at `corner`.
fn part<T: Copy>(picture: &[T], corner: [u32; 2], size: [u32; 2]) -> Vec<T> {
    let rows = picture.chunks_exact(SIZE[0] as usize);
    let rows = rows.skip(corner[1] as usize).take(size[1] as usize);
    let columns = corner[0] as usize..(corner[0] + size[0]) as usize;
    rows.flat_map(|row| row[columns.clone()].to_vec()).collect()
}

/// A frame that covers a part of the viewport shows that part of the viewport's picture.
#[test]
fn a_part_of_a_viewport_is_that_part_of_the_picture() {
    on_gpu(|gpu| {
        let world = World::new();
        let (machine, drawn) = (Machine::new(gpu, &world), world.drawn());
        let options = |size: [u32; 2]| Options::new(size[0], size[1]).flat_background(true).detection(Detection::Every);
        let corner = [13, 11];
        let size = [0, 1].map(|axis| SIZE[axis] - 2 * corner[axis]);
        let viewport = Viewport { x: 0.0, y: 0.0, width: SIZE[0] as f32, height: SIZE[1] as f32 };
        let way = Way { corner, viewport: Some(viewport), ..PLACED };
        let lent = world.lent(&PLACED);
        let whole = machine.see_lent(&PLACED, &lent, Base::All(&drawn), options(SIZE));
        let cut = Drawn {
            ids: part(&drawn.ids, corner, size),
            depths: part(&drawn.depths, corner, size),
            colors: part(&drawn.colors, corner, size),
        };
        let expected = part(&whole.colors, corner, size);
        for base in [Base::All(&cut), Base::Nothing] {
            let seen = machine.see_lent(&way, &lent, base, options(size));
            let around = way.around(size);
            assert_eq!(around, SIZE);
            let found = part(&seen.colors, corner, size);
            let apart = rmse(&found, &expected);
            assert!(apart < 1e-6, "{apart}");
        }
    });
}

/// A viewport that is larger than the frame has the effect of a matrix that scales and moves clip space.
#[test]
fn a_viewport_scales_and_moves_clip_space() {
    on_gpu(|gpu| {
        let mut world = World::new();
        let viewport = Viewport { x: -20.5, y: -7.25, width: 96.0, height: 80.5 };
        let in_viewport = Way { viewport: Some(viewport), ..PLACED };
        let options = Options::new(SIZE[0], SIZE[1]).flat_background(true);
        let see = |world: &World, way: &Way| {
            let machine = Machine::new(gpu, world);
            let lent = world.lent(way);
            machine.see_lent(way, &lent, Base::Nothing, options.clone()).colors
        };
        let found = see(&world, &in_viewport);
        let unmoved = see(&world, &PLACED);
        let sizes = [viewport.width, viewport.height];
        let firsts = [viewport.x, viewport.y];
        for part in &mut world.parts {
            for axis in 0..2 {
                let half = 0.5 * SIZE[axis] as f32;
                let scale = 0.5 * sizes[axis] / half;
                let shift = (firsts[axis] + 0.5 * sizes[axis] - half) / half;
                for column in &mut part.to_clip {
                    column[axis] = scale * column[axis] + shift * column[3];
                }
            }
        }
        let expected = see(&world, &PLACED);
        let (apart, far) = (rmse(&found, &expected), rmse(&unmoved, &expected));
        assert!(apart < 0.002 && far > 50.0 * apart, "{apart} {far}");
    });
}

/// A projection of OpenGL, with depth from -w to w, shows what one of Vulkan does, behind the place where depth is 0.
#[test]
fn projections_of_opengl_show_the_same_picture() {
    on_gpu(|gpu| {
        let way = Way { reversed_depth: false, ..PLACED };
        let options = Options::new(SIZE[0], SIZE[1]).flat_background(true);
        let see = |depth: fn(f32, f32) -> f32| {
            let mut world = World::new();
            for column in world.parts.iter_mut().flat_map(|part| &mut part.to_clip) {
                column[2] = depth(column[2], column[3]);
            }
            for column in &mut world.projection {
                column[2] = depth(column[2], column[3]);
            }
            let machine = Machine::new(gpu, &world);
            let lent = world.lent(&way);
            let seen = machine.see_lent(&way, &lent, Base::Nothing, options.clone());
            (seen.outcome.statistics.superpixels, seen.colors)
        };
        // The world's own depth is reversed.
        let (expected_count, expected) = see(|z, w| w - z);
        let (count, found) = see(|z, w| w - 2.0 * z);
        assert!(count > 200 && count.abs_diff(expected_count) <= 4, "{count} {expected_count}");
        let apart = rmse(&found, &expected);
        assert!(apart < 0.002, "{apart}");
    });
}

/// Thin blades are found by depth: the same blades in every range of depths as in the range from 0 to 1.
#[test]
fn depth_ranges_do_not_change_the_picture() {
    on_gpu(|gpu| {
        let world = World::new();
        let (machine, drawn) = (Machine::new(gpu, &world), world.drawn());
        let see = |depth_range| {
            let way = Way { depth_range, ..PLACED };
            let seen = machine.see(&way, Base::All(&drawn));
            (seen.outcome.statistics.superpixels, seen.colors)
        };
        let (superpixels, colors) = see([0.0, 1.0]);
        for depth_range in [[0.25, 0.75], [1.0, 0.0], [0.5, 0.0]] {
            let (found, seen) = see(depth_range);
            assert!(found.abs_diff(superpixels) <= 2, "{found} {superpixels}");
            let apart = rmse(&seen, &colors);
            assert!(apart < 0.005, "{depth_range:?}: {apart}");
        }
        // Without the search for thin triangles there are fewer superpixels, so that depth matters.
        let options = Options::new(SIZE[0], SIZE[1]).flat_background(true);
        let lent = world.lent(&PLACED);
        let seen = machine.see_lent(&PLACED, &lent, Base::All(&drawn), options.thin(false));
        let found = seen.outcome.statistics.superpixels;
        assert!(found + 10 < superpixels, "{found} {superpixels}");
    });
}
