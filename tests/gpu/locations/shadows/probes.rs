//! The places of a pixel that are probed for shadows besides its centre.

use glam::DVec2;
use gpc::render::{Detection, Rendered, Shadows};
use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;
use twins::shadow::PROBES;

use super::super::planar;
use super::{FLOOR, floor, lit, pinhole, render, sun, upload, within};
use crate::stage::{everywhere, on_gpu};

const SIZE: [u32; 2] = [256, 192];
/// Radius of a shadow's dot, in pixels.
const RADIUS: f64 = 1.0 / 40.0;
/// Distance in pixels between pixels with dots, so that no dot affects another dot's pixel.
const APART: usize = 4;

/// Places of dots relative to their pixel's centre: on and around every probe, and on a grid over the pixel. The
/// centre is left out, because it determines the pixel's own colour.
fn dots() -> Vec<DVec2> {
    let steps = |from: i32| (from..=-from).flat_map(move |y| (from..=-from).map(move |x| (x, y)));
    let place = |(x, y): (i32, i32)| DVec2::new(f64::from(x), f64::from(y)) / 16.0;
    let around = |probe| steps(-1).map(move |step| DVec2::from_array(probe) + place(step));
    let grid = steps(-7).filter(|step| *step != (0, 0)).map(place);
    PROBES.into_iter().flat_map(around).chain(grid).collect()
}

/// Dots of shadow are smaller than the gaps between them. A pixel is a superpixel if and only if its dot covers a
/// probe of the twin.
#[test]
fn pixels_are_probed_where_the_twin_has_it() {
    on_gpu(|gpu| {
        let mut stage = floor(vec![lit(AlphaMode::Opaque)]);
        let pinhole = pinhole(SIZE);
        // The casters are high above the camera, out of view.
        let above = |uv: DVec2| {
            let ray = pinhole.ray(uv);
            let to_floor = (FLOOR - ray.start.y) / ray.direction.y;
            let on_floor = ray.start + ray.direction * to_floor;
            (on_floor - sun().direction * 20.0).as_vec3().to_array()
        };
        let columns = (2..SIZE[0] - 2).step_by(APART);
        let pixels = (124..SIZE[1] - 2).step_by(APART).flat_map(|y| columns.clone().map(move |x| [x, y]));
        let mut expected = Vec::new();
        for (pixel, dot) in pixels.zip(dots()) {
            let middle = dot + DVec2::from_array(pixel.map(f64::from)) + 0.5;
            let corners = [0.0, 2.1, 4.2].map(|angle| middle + DVec2::from_angle(angle) * RADIUS);
            stage.add(0, corners.map(above));
            let centre = middle - dot;
            let covers = |probe| within(centre + DVec2::from_array(probe), corners).0;
            expected.push((pixel, dot, PROBES.into_iter().any(covers)));
        }
        assert_eq!(expected.len(), dots().len());
        let probed = expected.iter().filter(|(_, _, probed)| *probed).count();
        assert!(probed >= PROBES.len() && probed < 10, "{probed}");

        let prepared = upload(gpu, &stage, &[sun()]);
        let settings = everywhere(SIZE, Pattern::Sobol, 16)
            .shadows(Shadows::Exact)
            .attributes(true)
            .map_superpixels(|options| options.detection(Detection::Edges));
        let frame = render(gpu, &prepared, &settings);
        let rig = [(pinhole, planar(SIZE))];
        let list = gpu.render_locations(&prepared, &rig, &settings);
        let is_superpixel =
            |image: &Rendered, x: u32, y: u32| image.attributes[(y * SIZE[0] + x) as usize].superpixel == 1;
        for (name, image) in [("frame", &frame), ("list", &list.unwrap())] {
            for ([x, y], dot, probed) in &expected {
                assert_eq!(is_superpixel(image, *x, *y), *probed, "{name}: {x}, {y}, {dot}");
            }
        }
    });
}
