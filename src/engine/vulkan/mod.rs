//! A thin layer over Vulkan 1.3: devices, memory, pipelines, command recording. It knows nothing of rendering.

mod barriers;
mod commands;
mod error;
mod gpu;
mod instance;
mod memory;
mod pipeline;
mod requirements;

pub(crate) use commands::PUSH_STAGES;
pub use commands::{Recorder, Timings};
pub use error::VulkanError;
pub use gpu::{Gpu, Host, Limits, SharedAllocator};
pub use instance::{DeviceInfo, Instance, InstanceOptions};
pub(crate) use memory::TexelView;
pub use memory::{Buffer, BufferView, Image, Memory, MemoryUse};
pub(crate) use pipeline::GraphicsPipeline;
pub use pipeline::{Constants, Pipeline, Shader, compute_pipeline};
pub use requirements::{MISSING_DRIVER_HELP, Missing, Requirements};
