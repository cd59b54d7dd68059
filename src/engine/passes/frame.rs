//! The uniform block `Frame` of `shaders/include/frame.glsl`.

/// The uniform block `Frame`; the shader's comments say what the fields are.
pub use super::spirv::Frame as FrameUniform;
