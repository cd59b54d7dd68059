//! The Rust code of docs/embedding-reference.md, with what it needs besides what it shows.
#![allow(dead_code, reason = "compiled, never run")]

use ash::vk;
use gpc::host::{
    Antialiaser, Draw, Geometry, HostError, ImageKinds, Images, LentImage, Options, Scenery, ShadeSamples,
    VisibilitySamples,
};

struct Application {
    antialiaser: Antialiaser,
    format: vk::Format,
    size: [u32; 2],
    sky: [f32; 3],
    draws: Vec<Draw>,
    projection: [[f32; 4]; 4],
    materials: Materials,
}

impl Application {
    fn frame(self, geometry: Geometry, color: LentImage, commands: vk::CommandBuffer) -> Result<(), HostError> {
        let Self { antialiaser, format, size: [width, height], sky, draws, projection, materials } = self;
        let kinds =
            ImageKinds { ids: false, depth: false, color_format: format, color_encoded: false, color_copied: false };
        // color.before is ImageState { layout: vk::ImageLayout::UNDEFINED, .. }
        let images = Images { ids: None, depth: None, color, corner: [0, 0], layer: 0 };
        let options = Options::new(width, height).shade_all(true).background(Some(sky));
        let mut frame = unsafe { antialiaser.prepare(&geometry, &kinds, &options) }?;
        unsafe { frame.record(commands, &images, &Scenery::new(&draws, projection), &materials) }?;
        Ok(())
    }
}

struct Materials {
    device: ash::Device,
    layout: vk::PipelineLayout,
    my_set: vk::DescriptorSet,
    pipelines: Vec<vk::Pipeline>,
}

impl ShadeSamples for Materials {
    fn record(&self, commands: vk::CommandBuffer, samples: &VisibilitySamples) {
        let (device, bind) = (&self.device, vk::PipelineBindPoint::COMPUTE);
        let sets = [samples.descriptor_set(), self.my_set];
        unsafe { device.cmd_bind_descriptor_sets(commands, bind, self.layout, 0, &sets, &[]) };
        for key in 0..samples.keys() {
            if let Some((arguments, offset)) = samples.dispatch(key) {
                unsafe {
                    device.cmd_bind_pipeline(commands, bind, self.pipelines[key as usize]);
                    device.cmd_dispatch_indirect(commands, arguments, offset);
                }
            }
        }
    }
}
