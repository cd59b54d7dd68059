//! Python module of the renderer: scenes, cameras and images as NumPy arrays.

mod arrays;
mod camera;
mod compare;
mod error;
mod pixels;
mod renderer;
mod scene;
mod settings;

use pyo3::prelude::*;

#[pymodule]
#[pyo3(name = "_native")]
fn native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    error::register(module)?;
    module.add_class::<camera::Camera>()?;
    module.add_class::<scene::Scene>()?;
    module.add_class::<renderer::Renderer>()?;
    module.add_class::<compare::Comparison>()?;
    module.add_function(wrap_pyfunction!(renderer::render, module)?)?;
    module.add_function(wrap_pyfunction!(compare::compare, module)?)
}
