//! Scenes from files, bytes, arrays and objects of trimesh.

use crate::arrays::Mesh;
use crate::error;
use glam::DVec3;
use gpc::output::{DecodedLight, decode_light};
use gpc::scene::{Environment, Loaded, PoseRequest, Scene as Content};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// A scene: triangles, lines and points, materials, textures, lights, cameras and animations.
#[pyclass(frozen, module = "gpc")]
pub struct Scene {
    pub content: Content,
    /// Sentences about parts of the file that were left out or replaced.
    #[pyo3(get)]
    warnings: Vec<String>,
    /// What the properties tell, once one of them was asked for.
    overview: OnceLock<Overview>,
}

/// Figures of a scene at rest.
struct Overview {
    bounds: Option<([f64; 3], [f64; 3])>,
    triangles: u64,
    cameras: Vec<Option<String>>,
}

impl Scene {
    fn new(loaded: Loaded) -> Self {
        Self { content: loaded.scene, warnings: loaded.warnings, overview: OnceLock::new() }
    }

    /// Reads a file, or an object that can write itself as a .glb file.
    pub fn from_source(source: &Bound<'_, PyAny>) -> PyResult<Py<Self>> {
        let py = source.py();
        if let Ok(scene) = source.cast::<Self>() {
            return Ok(scene.clone().unbind());
        }
        let scene = match source.getattr("export") {
            Ok(_) => Self::from_trimesh(source)?,
            Err(_) => Self::load(py, source.extract()?, None, None)?,
        };
        Py::new(py, scene)
    }
}

#[pymethods]
impl Scene {
    /// Reads a glTF, OBJ, STL or PLY file. `variant` names a variant of its materials, `environment` an equirectangular .exr or .hdr
    /// file that lights the scene.
    #[staticmethod]
    #[pyo3(signature = (path, *, variant=None, environment=None))]
    pub fn load(py: Python<'_>, path: PathBuf, variant: Option<&str>, environment: Option<PathBuf>) -> PyResult<Self> {
        py.detach(|| {
            let loaded = match variant {
                Some(variant) => Content::load_variant(&path, variant),
                None => Content::load(&path),
            };
            let mut scene = Self::new(loaded.map_err(error::scene)?);
            if let Some(path) = environment {
                scene.add_environment(&path)?;
            }
            Ok(scene)
        })
    }

    /// Reads the bytes of such a file. `name` stands for the file in messages, and relative URIs start from the folder `base`.
    #[staticmethod]
    #[pyo3(signature = (data, name="scene", base=None))]
    fn from_bytes(data: &Bound<'_, PyBytes>, name: &str, base: Option<PathBuf>) -> PyResult<Self> {
        let bytes = data.as_bytes();
        let loaded = data.py().detach(|| Content::from_slice(bytes, name, base.as_deref()));
        Ok(Self::new(loaded.map_err(error::scene)?))
    }

    /// Makes a scene of one mesh: `vertices` (N, 3) and `faces` (M, 3) of indices. `normals` are (N, 3), `uvs` (N, 2) with (0, 0) at the
    /// texture's upper left corner, `colors` (N, 3 or 4) in linear light from 0 to 1, `texture` (height, width, 3 or 4) of uint8 sRGB codes.
    #[staticmethod]
    #[pyo3(signature = (vertices, faces, *, normals=None, uvs=None, colors=None, texture=None, base_color=[1.0, 1.0, 1.0, 1.0],
        metallic=0.0, roughness=0.7, unlit=false, double_sided=true))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn from_arrays(
        vertices: &Bound<'_, PyAny>,
        faces: &Bound<'_, PyAny>,
        normals: Option<&Bound<'_, PyAny>>,
        uvs: Option<&Bound<'_, PyAny>>,
        colors: Option<&Bound<'_, PyAny>>,
        texture: Option<numpy::PyReadonlyArray3<'_, u8>>,
        base_color: [f64; 4],
        metallic: f64,
        roughness: f64,
        unlit: bool,
        double_sided: bool,
    ) -> PyResult<Self> {
        let mut mesh = Mesh::new(vertices, faces)?;
        mesh.normals = normals.map(|array| mesh.stream(array, "normals")).transpose()?;
        mesh.uvs = uvs.map(|array| mesh.stream(array, "uvs")).transpose()?;
        mesh.colors = colors.map(|array| mesh.colors(array)).transpose()?;
        mesh.texture = texture.map(|array| crate::pixels::rgba(&array, 255)).transpose()?;
        let material = serde_json::json!({
            "pbrMetallicRoughness": { "baseColorFactor": base_color, "metallicFactor": metallic, "roughnessFactor": roughness },
            "doubleSided": double_sided,
            "extensions": if unlit { serde_json::json!({ "KHR_materials_unlit": {} }) } else { serde_json::json!({}) },
        });
        let glb = mesh.into_glb(material)?;
        Ok(Self::new(Content::from_slice(&glb, "arrays", None).map_err(error::scene)?))
    }

    /// Makes a scene of a mesh or scene of trimesh.
    #[staticmethod]
    fn from_trimesh(object: &Bound<'_, PyAny>) -> PyResult<Self> {
        let written = object.call_method(
            "export",
            (),
            Some(&pyo3::types::IntoPyDict::into_py_dict([("file_type", "glb")], object.py())?),
        )?;
        Self::from_bytes(written.cast::<PyBytes>()?, "trimesh", None)
    }

    /// The lowest and the highest corner of the box around the scene; None if it is empty.
    #[getter]
    fn bounds(&self) -> PyResult<Option<([f64; 3], [f64; 3])>> {
        Ok(self.overview()?.bounds)
    }

    /// Number of triangles.
    #[getter]
    fn triangles(&self) -> PyResult<u64> {
        Ok(self.overview()?.triangles)
    }

    /// Names of the cameras, in the order of their indices.
    #[getter]
    fn cameras(&self) -> PyResult<Vec<Option<String>>> {
        Ok(self.overview()?.cameras.clone())
    }
}

impl Scene {
    fn overview(&self) -> PyResult<&Overview> {
        if let Some(overview) = self.overview.get() {
            return Ok(overview);
        }
        let pose = self.content.pose(&PoseRequest::default()).map_err(error::scene)?;
        let bounds = pose.geometry.bounds().map(|(low, high): (DVec3, DVec3)| (low.into(), high.into()));
        let triangles = pose.geometry.triangle_count();
        let cameras = pose.cameras.into_iter().map(|camera| camera.name).collect();
        Ok(self.overview.get_or_init(|| Overview { bounds, triangles, cameras }))
    }

    /// Lights the scene by an equirectangular image.
    fn add_environment(&mut self, path: &Path) -> PyResult<()> {
        let file = path.display();
        let refuse = |error: &dyn std::fmt::Display| error::SceneError::new_err(format!("{file}: {error}"));
        let bytes = std::fs::read(path).map_err(|error| refuse(&error))?;
        let DecodedLight { size: [width, height], colors, warnings } =
            decode_light(&bytes, &file.to_string()).map_err(|error| error::SceneError::new_err(error.to_string()))?;
        self.warnings.extend(warnings);
        let environment = Environment::from_equirectangular(width, height, colors).map_err(|error| refuse(&error))?;
        self.content.environment = Some(Arc::new(environment));
        Ok(())
    }
}
