//! Images with layers, and secondary command buffers.

use super::machine::{AROUND, Base, Machine};
use super::world::{PLACED, World};
use crate::stage::on_gpu;

/// A layer of an image with two layers gets the picture that an image of its own gets, and the other layer stays as it is,
/// whether the commands are in a primary or in a secondary buffer.
#[test]
fn a_layer_of_an_image_is_antialiased_alone() {
    on_gpu(|gpu| {
        let world = World::new();
        let machine = Machine::new(gpu, &world);
        let expected = machine.see(&PLACED, Base::Nothing).colors;
        for layer in [0, 1] {
            for is_secondary in [false, true] {
                let layers = machine.see_layer(&PLACED, layer, is_secondary);
                assert!(layers[layer as usize] == expected, "layer {layer}");
                assert!(layers[1 - layer as usize].iter().all(|color| *color == AROUND), "layer {layer}");
            }
        }
    });
}
