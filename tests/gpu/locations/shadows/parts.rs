//! Images with shadows, rendered in parts.

use gpc::render::{EngineError, PixelRect, RenderError, Settings, Shadows, SuperpixelOptions};
use gpc::scene::{AlphaMode, Material};

use super::{OVER, floor, lamp, lit, render, spot, sun, upload};
use crate::stage::on_gpu;

const SIZE: [u32; 2] = [640, 400];

/// The planes of lights are computed for the whole image, so that its parts have bit-identical shadows.
#[test]
fn parts_of_an_image_have_the_shadows_of_the_whole() {
    on_gpu(|gpu| {
        let dim = Material { base_color: [1.0, 1.0, 1.0, 0.5], ..lit(AlphaMode::Blend) };
        let mut stage = floor(vec![lit(AlphaMode::Opaque), dim]);
        stage.add(0, OVER);
        stage.add(1, OVER.map(|[x, y, z]| [x - 0.5, y + 0.2, z]));
        let settings =
            Settings::new(SIZE[0], SIZE[1]).shadows(Shadows::Exact).attributes(true).method(SuperpixelOptions::new(16));
        let prepared = upload(gpu, &stage, &[sun(), lamp(spot(40.0))]);
        let whole = render(gpu, &prepared, &settings);
        assert!(whole.statistics.superpixels > 200);
        assert_eq!(whole.statistics.regions, 1);

        // The least memory for the image differs between devices, which say how much it is.
        let within = |bytes| settings.clone().max_memory(Some(bytes));
        let refused = gpu.prepare(&prepared, &within(0)).map(|_| ());
        let Err(RenderError::Engine(EngineError::Memory { needed, .. })) = refused else {
            panic!("{refused:?}");
        };
        let bound = needed + needed / 8;
        assert!(bound < whole.statistics.memory_bytes, "{bound}");
        let in_parts = render(gpu, &prepared, &within(bound));
        assert!(in_parts.statistics.regions > 1);
        assert!(in_parts.statistics.memory_bytes <= bound);
        assert!(in_parts.colors == whole.colors);

        let part = settings.region(Some(PixelRect { corner: [33, 47], size: [61, 50] }));
        let part = render(gpu, &prepared, &part);
        for (row, colors) in part.colors.chunks_exact(61).enumerate() {
            let first = (47 + row) * SIZE[0] as usize + 33;
            assert!(*colors == whole.colors[first..first + 61], "row {row}");
        }
    });
}
