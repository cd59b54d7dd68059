//! A host whose draws are decided on the device: a compute shader culls 20,000 objects, and the library antialiases what is
//! left.
//!
//! ```text
//! cargo run --release --no-default-features --example culling [OUT.png]
//! ```
//!
//! In one command buffer, `cull` writes a command and an instance for each object in the view, the host draws them with
//! `vkCmdDrawIndexedIndirect`, and the library reads the same buffers. The CPU does not know what is drawn. The picture is
//! compared with the host's own brute force.

#[path = "../common/arguments.rs"]
mod arguments;
#[path = "../common/device.rs"]
mod device;
mod host;
mod scene;
#[path = "../common/vulkan.rs"]
mod vulkan;

use device::{Device, Image};
use gpc::host::Antialiaser;
use host::Host;

type Failure = Box<dyn std::error::Error>;

const SIZE: [u32; 2] = [240, 135];
/// Samples along a pixel's side: `BRUTE` for as many samples as the library takes.
const BRUTE: u32 = 8;
const REFERENCE: u32 = 24;

fn main() -> Result<(), Failure> {
    let [out] = arguments::paths("culling [OUT.png]");
    let out = out.unwrap_or_else(|| "culling.png".into());
    let device = Device::new()?;
    // SAFETY: the handles belong together, the features are enabled, and the device outlives the antialiaser.
    let antialiaser = unsafe { Antialiaser::new(device.lent()) }?;
    let objects = scene::objects();
    let host = Host::new(&device, antialiaser.samples_layout(), &objects)?;

    let mut frame = host.frame(&antialiaser, SIZE)?;
    let antialiased = host.picture(SIZE, 1, Some(&mut frame))?;
    let outcome = frame.outcome()?;
    println!("objects in the view: {}", scene::in_view(&objects, scene::camera(SIZE).0));
    println!("objects drawn: {}", outcome.indirect.draws);
    println!("left out: {}", outcome.indirect.left_out + outcome.indirect.impossible);
    println!("{} superpixels, {} left over", outcome.statistics.superpixels, outcome.left_over);

    let reference = host.picture(SIZE, REFERENCE, None)?;
    let pictures: [(&str, &Image); 3] = [
        ("one sample", &host.picture(SIZE, 1, None)?),
        ("brute force", &host.picture(SIZE, BRUTE, None)?),
        ("superpixels", &antialiased),
    ];
    for (what, picture) in pictures {
        println!("error of {what}: {:.6}", picture.error(&reference));
    }
    antialiased.save(&out)?;
    println!("{}", out.display());
    Ok(())
}
