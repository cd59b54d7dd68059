//! Frames in flight, the images that they are recorded with, and the memory that they share.

use super::machine::Machine;
use super::world::{PLACED, Way, World};
use crate::stage::on_gpu;
use gpc::host::Draw;

const IN_OBJECT_SPACE: Way = Way { object_space: true, stride: 12, ..PLACED };

/// The draws of a world seen in a mirror.
fn mirrored(draws: &[Draw]) -> Vec<Draw> {
    let mut mirrored = draws.to_vec();
    for draw in &mut mirrored {
        for column in &mut draw.to_clip {
            column[0] = -column[0];
        }
    }
    mirrored
}

/// A frame does not see what another frame has left in the memory that both use.
#[test]
fn frames_share_memory_and_nothing_else() {
    on_gpu(|gpu| {
        let world = World::new();
        let machine = Machine::new(gpu, &world);
        let lent = world.lent(&IN_OBJECT_SPACE);
        let mirror = mirrored(&lent.draws);
        let see = |shown: &[&[Draw]]| machine.see_at_once(&IN_OBJECT_SPACE, &lent, shown);
        let together = see(&[&lent.draws, &mirror, &lent.draws]);
        for (found, draws) in together.iter().zip([&lent.draws, &mirror]) {
            let alone = &see(&[draws])[0];
            assert!(found.colors == alone.colors);
            assert_eq!(found.memory_bytes, alone.memory_bytes);
            assert_eq!(found.shared_bytes, alone.shared_bytes);
            let own = found.memory_bytes - found.shared_bytes;
            assert!(own > 0 && 8 * own < found.shared_bytes, "{own}");
        }
        assert!(together[0].colors == together[2].colors);
        assert!(together[0].colors != together[1].colors);
    });
}

#[test]
fn resized_frames_show_what_new_ones_do() {
    on_gpu(|gpu| {
        let world = World::new();
        let machine = Machine::new(gpu, &world);
        let lent = world.lent(&PLACED);
        let sizes = [[64, 64], [40, 48], [96, 80], [64, 64]];
        let resized = machine.see_resized(&PLACED, &lent, &sizes);
        let fresh = sizes.map(|size| machine.see_resized(&PLACED, &lent, &[size]));
        for (found, fresh) in resized.iter().zip(&fresh) {
            assert!(found.colors == fresh[0].colors);
        }
        let shared: Vec<_> = resized.iter().map(|shown| shown.shared_bytes).collect();
        assert_eq!(shared[0], shared[1]);
        assert_eq!(shared[2], shared[3]);
        assert!(shared[2] > shared[1] && fresh[1][0].shared_bytes < shared[1]);
    });
}
