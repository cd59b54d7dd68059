//! A host with a visibility buffer, materials and an animation of its own, antialiased by the library's engine.
//!
//! ```text
//! cargo run --release --no-default-features --example visibility [OUT.png [LENS.png]]
//! ```
//!
//! The host poses its meshes by a compute shader into clip space, draws triangle IDs and depth, and shades the centres of
//! pixels from these. The library then samples the pixels that alias, and has the host shade what the samples see. Two
//! frames are in flight, and half way through the images change their size. At the end, the last frame is compared with
//! the host's own brute force. With a second path, the host then shows the same scene through a magnifying glass: it
//! writes the locations that are seen, has the library sample these, and compares the picture in the same way.

#[path = "../common/arguments.rs"]
mod arguments;
#[path = "../common/device.rs"]
mod device;
mod lens;
mod meshes;
mod pipelines;
mod slot;
mod textures;
mod view;
#[path = "../common/vulkan.rs"]
mod vulkan;

use device::{Device, Image};
use gpc::host::{Antialiaser, Options};
use gpc::render::Shading;
use gpc::sampling::Pattern;
use lens::Lens;
use meshes::World;
use pipelines::Pipelines;
use slot::{Antialiasing, Slot};
use view::{camera, options, time};

type Failure = Box<dyn std::error::Error>;

const SIZE: [u32; 2] = [320, 180];
/// Size of the images at the start.
const FIRST_SIZE: [u32; 2] = [200, 150];
const FRAMES: usize = 6;
const IN_FLIGHT: usize = 2;
/// Samples along a pixel's side: `BRUTE` for supersampling with as many samples as the library takes.
const BRUTE: u32 = 8;
const REFERENCE: u32 = 32;
/// Pictures that are compared with the reference, for each view.
const COMPARED: [&str; 5] = [
    "one sample",
    "brute force",
    "superpixels",
    "superpixels, samples where brute force has them",
    "superpixels, each of these samples shaded",
];

fn main() -> Result<(), Failure> {
    let [out, lens_out] = arguments::paths("visibility [OUT.png [LENS.png]]");
    let out = out.unwrap_or_else(|| "visibility.png".into());
    let device = Device::new()?;
    // SAFETY: the handles belong together, the features are enabled, and the device outlives the antialiaser.
    let antialiaser = unsafe { Antialiaser::new(device.lent()) }?;
    let world = World::new(&device)?;
    let pipelines = Pipelines::new(&device, antialiaser.samples_layout())?;

    let mut slots: Vec<Slot<'_>> = Vec::new();
    let mut superpixels = 0;
    for frame in 0..FRAMES {
        let size = if frame < FRAMES / 2 { FIRST_SIZE } else { SIZE };
        let index = frame % IN_FLIGHT;
        if let Some(slot) = slots.get_mut(index) {
            slot.wait()?;
            if slot.size() != size {
                slot.resize(&pipelines, size)?;
            }
        } else {
            slots.push(Slot::new(&device, &world, &pipelines, size, Some((&antialiaser, &options(size))))?);
        }
        let slot = &mut slots[index];
        slot.show(&world, time(frame), camera(size))?;
        slot.submit(&world, &pipelines)?;
    }
    for slot in &mut slots {
        slot.wait()?;
        let Antialiasing { frame, .. } = slot.antialiasing().ok_or("a slot without the library")?;
        let outcome = frame.outcome()?;
        superpixels = outcome.statistics.superpixels;
        println!(
            "{superpixels} superpixels, {} left over, {:.1} ms of the library on the GPU",
            outcome.left_over,
            outcome.statistics.gpu_ms()
        );
    }

    let own = slots[(FRAMES - 1) % IN_FLIGHT].pixels(1)?;
    // These samples are in the same places as those of supersampling.
    let placed = options(SIZE).pattern(Pattern::Grid);
    // Like supersampling, this shades every sample; the low threshold leaves almost no contrast unsampled.
    let each = placed.clone().shading(Shading::Sample).contrast(Some(2));
    let last = |side: u32, options: Option<&Options>| -> Result<Image, Failure> {
        let size = SIZE.map(|pixels| pixels * side);
        let antialiasing = options.map(|options| (&antialiaser, options));
        let mut slot = Slot::new(&device, &world, &pipelines, size, antialiasing)?;
        slot.show(&world, time(FRAMES - 1), camera(SIZE))?;
        slot.submit(&world, &pipelines)?;
        slot.wait()?;
        slot.pixels(side)
    };
    let reference = last(REFERENCE, None)?;
    let images = [&last(1, None)?, &last(BRUTE, None)?, &own, &last(1, Some(&placed))?, &last(1, Some(&each))?];
    print_errors("", &reference, images);
    println!("share of superpixels: {:.4}", superpixels as f64 / f64::from(SIZE[0] * SIZE[1]));
    own.save(&out)?;
    println!("{}", out.display());

    if let Some(out) = lens_out {
        let shown = (&world, &pipelines, &slots[(FRAMES - 1) % IN_FLIGHT]);
        let lens = Lens::new(&device, &antialiaser, shown)?;
        let points = options(SIZE).samples(1);
        let reference = lens.picture(&points, REFERENCE)?;
        let own = lens.picture(&options(SIZE), 1)?;
        let images = [
            &lens.picture(&points, 1)?,
            &lens.picture(&points, BRUTE)?,
            &own,
            &lens.picture(&placed, 1)?,
            &lens.picture(&each, 1)?,
        ];
        print_errors("through the lens, ", &reference, images);
        own.save(&out)?;
        println!("{}", out.display());
    }
    Ok(())
}

fn print_errors(view: &str, reference: &Image, images: [&Image; COMPARED.len()]) {
    for (what, image) in COMPARED.iter().zip(images) {
        println!("{view}error of {what}: {:.6}", image.error(reference));
    }
}
