//! Thin layer over Vulkan 1.3: devices, memory, pipelines, command recording. This layer knows nothing of rendering.
//!
//! Only devices are visible to hosts. Memory, pipelines and commands are internal to the crate, because their
//! functions trust their arguments.

mod allocation;
mod barriers;
pub(crate) mod commands;
mod completion;
mod conditions;
pub(crate) mod descriptor_set;
mod error;
mod gpu;
mod instance;
mod interface;
mod loader;
pub(crate) mod memory;
mod pass_layout;
pub(crate) mod pipeline;
mod requirements;
pub(crate) mod timings;
mod trace;

pub use allocation::{AllocateMemory, HostMemory, MemoryRequest, MemorySource, SharedAllocator};
pub(crate) use commands::Recorder;
pub(crate) use completion::Completion;
pub(crate) use descriptor_set::{BoundDescriptor, Descriptor, DescriptorSets, Texels, read_image};
pub use error::VulkanError;
pub use gpu::{Gpu, Host, Limits, SharedQueue, Teams};
pub use instance::{DeviceInfo, Instance, InstanceOptions};
pub(crate) use interface::{Access, Binding, Compiled, Interface, Invocations, Specialized, Use};
pub(crate) use loader::alone;
pub use memory::MemoryUse;
pub(crate) use memory::{Buffer, Image, Memory, TexelBuffer, TexelView, flat_image};
pub(crate) use pass_layout::{PassLayout, SetLayout, SharedLayout};
pub(crate) use pipeline::{Constants, GraphicsPipeline, Pipeline, compute_pipeline};
pub use requirements::{MISSING_DRIVER_HELP, Missing, Requirements};
pub(crate) use timings::{PassTime, Timings};
pub(crate) use trace::{Dispatched, Traced, TracedDispatch};
