//! Images for which `filter` chose the triangles, and images for which `raster` drew all of them.

use ash::vk;
use gpc::render::{Headless, Method, PixelRect, Rendered, Settings};
use gpc::scene::{AlphaMode, Material};

use crate::devices::within;
use crate::meshes::Random;
use crate::stage::{Stage, flat, on_gpu, seen_at};
use crate::visibility::soup;

const SIZE: [u32; 2] = [97, 61];

/// Triangles of each kind: enough for `filter` to run.
const EACH: usize = 3000;

/// Large and intersecting triangles, some of which cross the eye's plane, and triangles of about a pixel: one-sided, two-sided,
/// alpha-tested and blended ones. Many of them face away, lie outside of the image or between centres.
fn stage() -> Stage {
    let mut stage = soup(5, EACH, false, [-3.0, 5.0]);
    let two_sided = Material { double_sided: true, ..flat([1.0; 4], AlphaMode::Opaque) };
    stage.materials.extend([
        two_sided,
        flat([1.0; 4], AlphaMode::Mask { cutoff: 0.5 }),
        flat([1.0, 1.0, 1.0, 0.5], AlphaMode::Blend),
    ]);
    let mut random = Random::new(17);
    for material in 0..4 {
        for number in 0..EACH {
            let middle = [random.range(-60.0, 60.0), random.range(-40.0, 40.0)];
            let distance = random.range(0.5, 9.0);
            // Few triangles have a corner behind the eye. Their corners project to one pixel, but they cover many.
            let last = if number % 500 == 0 { -1.0 } else { 1.0 };
            let corners = [1.0, 1.0, last].map(|side| {
                let place = middle.map(|middle| middle + random.range(-0.8, 0.8));
                seen_at(place, side * distance, SIZE[1])
            });
            stage.add(material, corners);
        }
    }
    stage.color_by_code();
    stage
}

fn is_filtered(rendered: &Rendered) -> bool {
    let mut passes = rendered.statistics.passes.iter();
    passes.any(|time| time.pass == "filter")
}

#[test]
fn filtering_changes_no_pixel() {
    let stage = stage();
    let [width, height] = SIZE;
    let region = PixelRect { corner: [33, 21], size: [40, 17] };
    let superpixels = Settings::new(width, height).attributes(true);
    let all = [
        superpixels.clone().method(Method::None),
        superpixels.clone().method(Method::Ssaa { samples: 9 }),
        superpixels.clone().region(Some(region)),
        superpixels,
    ];
    let render = |gpu: &mut Headless| all.each_ref().map(|settings| stage.render(gpu, settings));
    let mut filtered = None;
    on_gpu(|gpu| {
        if gpu.gpu().limits().device_type == vk::PhysicalDeviceType::CPU {
            filtered = Some(render(gpu));
        }
    });
    let Some(filtered) = filtered else {
        return;
    };
    within(
        |limits| limits.device_type = vk::PhysicalDeviceType::DISCRETE_GPU,
        |gpu| {
            for (found, expected) in filtered.iter().zip(&render(gpu)) {
                assert!(is_filtered(found) && !is_filtered(expected));
                assert!(found.attributes == expected.attributes);
                assert!(found.colors == expected.colors);
            }
        },
    );
}
