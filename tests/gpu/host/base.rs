//! Frames of hosts that draw only some of their images; the library draws the others.

use super::machine::{Base, Machine};
use super::world::{PLACED, World};
use crate::stage::on_gpu;
use gpc::host::Options;

/// Number of pixels whose colours differ by more than rounding, and the root mean squared difference.
fn difference(a: &[[f32; 4]], b: &[[f32; 4]]) -> (usize, f64) {
    let mut square = 0.0;
    let mut pixels = 0;
    for (a, b) in a.iter().zip(b) {
        let apart = [0, 1, 2].map(|channel| f64::from(a[channel] - b[channel]));
        square += apart.iter().map(|d| d * d).sum::<f64>();
        pixels += usize::from(apart.iter().any(|d| d.abs() > 1e-4));
    }
    (pixels, (square / (3 * a.len()) as f64).sqrt())
}

/// The library draws what the host would draw. The host's renderer is the exact twin, whereas the device rounds
/// vertices to a fraction of a pixel; so a few pixel centres may see another triangle, and be found to alias or not.
#[test]
fn what_is_drawn_for_the_host_is_what_it_would_draw() {
    on_gpu(|gpu| {
        let world = World::new();
        let (machine, drawn) = (Machine::new(gpu, &world), world.drawn());
        let all = machine.see(&PLACED, Base::All(&drawn));
        let bare = difference(&drawn.colors, &all.colors);
        assert!(bare.0 > 400, "{bare:?}");
        for base in [Base::Colors(&drawn), Base::Ids(&drawn), Base::Nothing] {
            let found = machine.see(&PLACED, base);
            assert_eq!(found.outcome.left_over, 0);
            let (pixels, error) = difference(&found.colors, &all.colors);
            assert!(pixels <= 4 && 1000.0 * error < bare.1, "{pixels} pixels, {error}");
        }
    });
}

/// If not all pixels fit into memory at once, they are shaded in bands.
#[test]
fn bands_of_centres_make_the_same_picture() {
    on_gpu(|gpu| {
        let world = World::new();
        let machine = Machine::new(gpu, &world);
        let options = |max_memory| Options::new(512, 256).max_memory(max_memory);
        let see = |max_memory| {
            let lent = world.lent(&PLACED);
            machine.see_lent(&PLACED, &lent, Base::Nothing, options(max_memory))
        };
        let whole = see(None);
        let much = whole.outcome.statistics.memory_bytes;
        let parts = see(Some(much / 2));
        assert!(parts.outcome.statistics.memory_bytes <= much / 2);
        assert_eq!(parts.outcome.left_over, 0);
        assert!(parts.colors == whole.colors);
        let lit = whole.colors.iter().filter(|color| color[0] > 0.2).count();
        assert!(lit > whole.colors.len() / 10, "{lit}");
    });
}
