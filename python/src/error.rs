//! Exceptions: `GpcError` with its subclasses `SceneError` and `DeviceError`. A request that is impossible whatever the scene
//! is a `ValueError`.

use gpc::render::{EngineError, RenderError};
use gpc::scene::SceneError as FileError;
use gpc::vulkan::VulkanError;
use pyo3::create_exception;
use pyo3::exceptions::{PyException, PyValueError};
use pyo3::prelude::*;

create_exception!(gpc, GpcError, PyException, "An error of the renderer.");
create_exception!(gpc, SceneError, GpcError, "A scene that can't be read or shown.");
create_exception!(gpc, DeviceError, GpcError, "No suitable device, a lost device, or too little memory.");

/// Adds the exceptions to the module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("GpcError", py.get_type::<GpcError>())?;
    module.add("SceneError", py.get_type::<SceneError>())?;
    module.add("DeviceError", py.get_type::<DeviceError>())
}

/// Exception for a scene that can't be read or posed.
pub fn scene(error: FileError) -> PyErr {
    match error {
        FileError::NoSuchScene { .. } | FileError::NoSuchAnimation { .. } | FileError::NoSuchVariant { .. } => {
            usage(error)
        }
        _ => SceneError::new_err(error.to_string()),
    }
}

/// Exception for an impossible request.
pub fn usage(error: impl ToString) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Exception for a device that can't be opened.
pub fn device(error: VulkanError) -> PyErr {
    DeviceError::new_err(error.to_string())
}

/// Exception for an image that can't be made.
pub fn render(error: RenderError) -> PyErr {
    let text = error.to_string();
    match &error {
        error if error.is_usage() => PyValueError::new_err(text),
        RenderError::Engine(EngineError::Vulkan(_) | EngineError::Memory { .. }) => DeviceError::new_err(text),
        error if error.is_device_failure() => DeviceError::new_err(text),
        _ => GpcError::new_err(text),
    }
}
