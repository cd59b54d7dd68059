//! The words of `shaders/include/shadows.glsl`, which say what lights reach places.

use crate::vulkan::Constants;

/// Adds the constant of the include, where places have so many words.
pub(crate) fn constants(constants: Constants, words: u32) -> Constants {
    constants.with(25, words)
}
