//! Check of the application's shaders.

use super::error::{Error, GpcResult, answer};
use crate::host::check_shader;

/// Checks that a shader was compiled with a supported version of gpc_visibility.glsl. Call this for each shader that
/// shades samples, where its pipeline is made. The arguments are those of VkShaderModuleCreateInfo: `code_size` is in
/// bytes.
///
/// Threads: any.
/// Errors: GPC_RESULT_NULL; GPC_RESULT_VALUE if the code is not SPIR-V; GPC_RESULT_SHADER_VERSION.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_check_shader(code: *const u32, code_size: usize) -> GpcResult {
    answer(|| {
        if code.is_null() {
            return Err(Error::Null("code"));
        }
        if !code_size.is_multiple_of(size_of::<u32>()) {
            return Err(Error::ShaderSize(code_size));
        }
        // SAFETY: passed on to the caller; the pointer is not null.
        let words = unsafe { std::slice::from_raw_parts(code, code_size / size_of::<u32>()) };
        Ok(check_shader(words)?)
    })
}
