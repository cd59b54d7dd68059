//! What happens to the alpha of the host's image.

use super::machine::{Base, Machine};
use super::world::{Drawn, PLACED, SIZE, World};
use crate::stage::on_gpu;
use gpc::host::Options;

/// Alpha that the host keeps in its image, for its own purposes.
fn with_alpha(mut drawn: Drawn) -> Drawn {
    for (number, color) in drawn.colors.iter_mut().enumerate() {
        color[3] = (number % 7) as f32 / 8.0;
    }
    drawn
}

/// The host's alpha stays where it asks for that; the colours are the same. Otherwise opaque surfaces write 1.
#[test]
fn alpha_of_the_image_stays_where_the_host_says_so() {
    on_gpu(|gpu| {
        let world = World::new();
        let machine = Machine::new(gpu, &world);
        let drawn = with_alpha(world.drawn());
        let lent = world.lent(&PLACED);
        let see = |keep_alpha| {
            let options = Options::new(SIZE[0], SIZE[1]).flat_background(true).keep_alpha(keep_alpha);
            machine.see_lent(&PLACED, &lent, Base::All(&drawn), options).colors
        };
        let (written, kept) = (see(false), see(true));
        let mut antialiased = 0;
        for ((before, written), kept) in drawn.colors.iter().zip(&written).zip(&kept) {
            assert_eq!(kept[3], before[3]);
            assert_eq!(kept[..3], written[..3]);
            if written[..3] != before[..3] {
                assert!((written[3] - 1.0).abs() < 1e-6, "{written:?}");
                antialiased += 1;
            }
        }
        assert!(antialiased > drawn.colors.len() / 10, "{antialiased}");
    });
}
