//! Check that a host's shader was compiled with the includes of this library.

use crate::engine::spirv::GPC_SHADER_VERSION;

/// Reason for which the library rejects a shader.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ShaderError {
    /// Words that are no SPIR-V module.
    #[error("the shader is not SPIR-V: {0}")]
    NotSpirv(&'static str),
    /// Shader without the version of `gpc_visibility.glsl`.
    #[error(
        "the shader has no specialization constant {id}, which is the version of gpc_visibility.glsl: include that file, of this library or a later one, and call gpc_sample",
        id = GPC_SHADER_VERSION.0
    )]
    NoVersion,
    /// Shader with a version that this library does not support.
    #[error(
        "the shader was compiled with version {found} of gpc_visibility.glsl; this library takes version {taken}: compile the shader with the includes of this library",
        taken = GPC_SHADER_VERSION.1
    )]
    Version {
        /// Version of the include with which the shader was compiled.
        found: u32,
    },
}

/// First word of a SPIR-V module.
const MAGIC: u32 = 0x0723_0203;
/// Number of words before the first instruction.
const HEADER: usize = 5;
const OP_SPEC_CONSTANT: u32 = 50;
const OP_DECORATE: u32 = 71;
const SPEC_ID: u32 = 1;

/// Checks that a shader, given as SPIR-V words, was compiled with a supported version of `gpc_visibility.glsl`. Call
/// this for each shader that shades samples, where its pipeline is made.
///
/// # Errors
/// [`ShaderError`] names the defect.
pub fn check_shader(code: &[u32]) -> Result<(), ShaderError> {
    let body = match code {
        [MAGIC, ..] => code.get(HEADER..).ok_or(ShaderError::NotSpirv("it ends within its header"))?,
        _ => {
            return Err(ShaderError::NotSpirv("its first word is not 0x07230203 in this machine's order of bytes"));
        }
    };
    let mut version = None;
    let mut rest = body;
    while let Some(first) = rest.first() {
        let (words, operation) = ((first >> 16) as usize, first & 0xffff);
        if words == 0 || words > rest.len() {
            return Err(ShaderError::NotSpirv("it ends within an instruction"));
        }
        let (instruction, after) = rest.split_at(words);
        match *instruction {
            // Decorations come before constants.
            [_, target, SPEC_ID, id] if operation == OP_DECORATE && id == GPC_SHADER_VERSION.0 => {
                version = Some(target);
            }
            [_, _, result, found] if operation == OP_SPEC_CONSTANT && version == Some(result) => {
                return if found == GPC_SHADER_VERSION.1 { Ok(()) } else { Err(ShaderError::Version { found }) };
            }
            _ => {}
        }
        rest = after;
    }
    Err(ShaderError::NoVersion)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHADER: &[u8] = include_bytes!("../../../tests/hosts/shaders/spirv/samples.spv");

    fn words(bytes: &[u8]) -> Vec<u32> {
        let words = bytes.chunks_exact(4);
        words.map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect()
    }

    /// Index of the word that holds the value of a constant instruction.
    fn value(code: &[u32]) -> usize {
        let (id, version) = GPC_SHADER_VERSION;
        let decoration = code
            .windows(4)
            .position(|window| window[0] == 4 << 16 | OP_DECORATE && window[2..] == [SPEC_ID, id])
            .unwrap();
        let target = code[decoration + 1];
        let is_constant = |window: &[u32]| window[0] == 4 << 16 | OP_SPEC_CONSTANT && window[2..] == [target, version];
        code.windows(4).position(is_constant).unwrap() + 3
    }

    #[test]
    fn a_shader_of_another_version_is_refused_by_name() {
        let mut code = words(SHADER);
        assert_eq!(check_shader(&code), Ok(()));
        let value = value(&code);
        code[value] += 1;
        let refused = check_shader(&code).unwrap_err();
        assert_eq!(refused, ShaderError::Version { found: 2 });
        assert_eq!(
            refused.to_string(),
            "the shader was compiled with version 2 of gpc_visibility.glsl; this library takes version 1: compile the shader with the includes of this library"
        );
    }

    #[test]
    fn what_has_no_version_and_what_is_no_shader_are_refused() {
        let other = words(include_bytes!("../../../shaders/spirv/take.spv"));
        assert_eq!(check_shader(&other), Err(ShaderError::NoVersion));
        let code = words(SHADER);
        let not_spirv = |code: &[u32]| matches!(check_shader(code), Err(ShaderError::NotSpirv(_)));
        assert!(not_spirv(&[]) && not_spirv(&code[..3]) && not_spirv(&code[1..]));
        let mut endless = code.clone();
        endless[HEADER] = 0;
        assert!(not_spirv(&endless));
        let mut longer = code;
        longer[HEADER] |= 0xffff << 16;
        assert!(not_spirv(&longer));
    }
}
