//! A device with a scene, which makes images.

use crate::camera::{Camera, Surroundings};
use crate::error;
use crate::pixels::{self, Layer};
use crate::scene::Scene;
use crate::settings::{Kind, Request, named};
use glam::{DMat2, DVec3};
use gpc::camera::panorama::{Panorama, PanoramaProjection};
use gpc::camera::set::{SamplingSet, mapped_locations};
use gpc::camera::zoom::{Transition, ZoomMap, ZoomRegion};
use gpc::camera::{Pinhole, SampleLocation};
use gpc::output::{self, Picture};
use gpc::render::{
    CellOptions, Headless, HeadlessOptions, Pixel, PixelAttributes, PreparedScene, RenderError, Rendered, SceneFrame,
    SceneRequest, Settings, Shadows,
};
use gpc::scene::{PoseRequest, SceneCamera};
use numpy::{PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::{Arc, Mutex, MutexGuard};

/// A device with a scene on it. It may be used from several threads, one after the other.
#[pyclass(frozen, module = "gpc")]
pub struct Renderer {
    inner: Mutex<Inner>,
    /// Exception of a signal that arrived while the device worked.
    interruption: Arc<Mutex<Option<PyErr>>>,
    shadows: bool,
    max_memory: Option<u64>,
    /// Name of the device.
    #[pyo3(get)]
    device: String,
}

struct Inner {
    /// The last frame, with the settings that it was prepared for.
    frame: Option<(Settings, Kind, SceneFrame)>,
    prepared: PreparedScene,
    headless: Headless,
    bounds: (DVec3, DVec3),
    cameras: Vec<SceneCamera>,
}

/// Colours of an image in either kind.
enum Colors {
    Float32(Vec<[f32; 4]>),
    Uint8(Vec<[u8; 4]>),
}

/// An image before it is an array.
struct Image {
    /// Height and width.
    shape: [usize; 2],
    colors: Colors,
    attributes: Vec<PixelAttributes>,
}

impl Image {
    fn new<P>(rendered: Rendered<P>, wrap: impl FnOnce(Vec<P>) -> Colors) -> Self {
        let [width, height] = rendered.size.map(|side| side as usize);
        Self { shape: [height, width], colors: wrap(rendered.colors), attributes: rendered.attributes }
    }

    /// An image of linear light in the kind that is asked for.
    fn of_light(rendered: Rendered, kind: Kind) -> PyResult<Self> {
        if kind == Kind::Float32 {
            return Ok(Self::new(rendered, Colors::Float32));
        }
        let picture = Picture::new(rendered.size, &rendered.colors).map_err(error::usage)?;
        let codes = output::codes(&picture);
        let Rendered { size, attributes, statistics, .. } = rendered;
        Ok(Self::new(Rendered { size, colors: codes, attributes, statistics }, Colors::Uint8))
    }

    /// The colours alone, or a dictionary of colours and layers.
    fn into_python<'py>(self, py: Python<'py>, layers: &[Layer]) -> PyResult<Bound<'py, PyAny>> {
        let colors = match self.colors {
            Colors::Float32(colors) => pixels::array(py, &self.shape, colors)?,
            Colors::Uint8(colors) => pixels::array(py, &self.shape, colors)?,
        };
        if layers.is_empty() {
            return Ok(colors);
        }
        let all = PyDict::new(py);
        all.set_item("color", colors)?;
        for layer in layers {
            all.set_item(layer.name(), layer.array(py, &self.shape, &self.attributes)?)?;
        }
        Ok(all.into_any())
    }
}

impl Inner {
    fn surroundings(&self) -> Surroundings<'_> {
        Surroundings { bounds: self.bounds, cameras: &self.cameras }
    }

    fn render_pixels<P: Pixel>(
        &mut self,
        camera: &gpc::camera::Camera,
        settings: &Settings,
        kind: Kind,
    ) -> Result<Rendered<P>, RenderError> {
        let known = self.frame.take().filter(|(known, of, _)| known == settings && *of == kind);
        let (_, _, mut frame) = match known {
            Some(known) => known,
            None => (settings.clone(), kind, self.headless.prepare_pixels::<P>(&self.prepared, settings)?),
        };
        let rendered = self.headless.render_pixels(&mut frame, camera)?;
        self.frame = Some((settings.clone(), kind, frame));
        Ok(rendered)
    }

    fn render(&mut self, camera: &Camera, request: &Request) -> Result<Image, Failure> {
        let Request { settings, kind, .. } = request;
        if let Some(view) = camera.view(&self.surroundings(), settings.size)? {
            return Ok(match kind {
                Kind::Float32 => Image::new(self.render_pixels(&view, settings, *kind)?, Colors::Float32),
                Kind::Uint8 => Image::new(self.render_pixels(&view, settings, *kind)?, Colors::Uint8),
            });
        }
        let pinhole = camera.pinhole(&self.surroundings(), settings.size)?;
        let set = SamplingSet::planar(settings.size).map_err(error::usage)?;
        self.render_locations(&[(pinhole, set.locations())], request)
    }

    fn render_locations(
        &mut self,
        rig: &[(Pinhole, Vec<SampleLocation>)],
        request: &Request,
    ) -> Result<Image, Failure> {
        let rendered = self.headless.render_locations(&self.prepared, rig, &request.settings)?;
        Ok(Image::of_light(rendered, request.kind)?)
    }
}

/// Reason why an image was not made.
enum Failure {
    Python(PyErr),
    Render(RenderError),
}

impl From<PyErr> for Failure {
    fn from(error: PyErr) -> Self {
        Self::Python(error)
    }
}

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Self {
        Self::Render(error)
    }
}

impl Renderer {
    fn request(&self, size: [u32; 2], options: Option<&Bound<'_, PyDict>>) -> PyResult<Request> {
        Request::new(size, options, self.shadows, self.max_memory)
    }

    /// Works on the device while other threads of Python run.
    fn work<T: Send>(&self, py: Python<'_>, work: impl FnOnce(&mut Inner) -> Result<T, Failure> + Send) -> PyResult<T> {
        let done = py.detach(|| work(&mut lock(&self.inner)));
        done.map_err(|failure| match failure {
            Failure::Python(error) => error,
            Failure::Render(RenderError::Stopped) => {
                let interruption = lock(&self.interruption).take();
                interruption.unwrap_or_else(|| error::render(RenderError::Stopped))
            }
            Failure::Render(error) => error::render(error),
        })
    }
}

/// The value, also if a thread panicked with it: no method leaves it half changed.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

#[pymethods]
impl Renderer {
    /// Opens a device and puts a scene on it: a Scene, a file, or a mesh or scene of trimesh. `device` is a part of the device's name.
    #[new]
    #[pyo3(signature = (scene, *, shadows=false, time=0.0, animation=None, device=None, max_memory=None, validation=false))]
    fn new(
        scene: &Bound<'_, PyAny>,
        shadows: bool,
        time: f64,
        animation: Option<String>,
        device: Option<String>,
        max_memory: Option<u64>,
        validation: bool,
    ) -> PyResult<Self> {
        let py = scene.py();
        let scene = Scene::from_source(scene)?;
        let scene = &scene.get().content;
        let interruption = Arc::new(Mutex::new(None));
        let stop = interruption.clone();
        py.detach(move || {
            let pose = scene.pose(&PoseRequest { scene: None, animation, time }).map_err(error::scene)?;
            let options = HeadlessOptions::default().device(device).validation(validation);
            let mut headless = Headless::new(&options).map_err(error::device)?;
            headless.stop_when(move || {
                Python::attach(|py| match py.check_signals() {
                    Ok(()) => false,
                    Err(signal) => {
                        *lock(&stop) = Some(signal);
                        true
                    }
                })
            });
            let kind = if shadows { Shadows::Exact } else { Shadows::None };
            let request = SceneRequest::new(scene, &pose).shadowed(kind).within(max_memory);
            let prepared = headless.upload(request).map_err(error::render)?;
            let bounds = pose.geometry.bounds().unwrap_or((DVec3::splat(-1.0), DVec3::ONE));
            let device = headless.gpu().limits().device_name.clone();
            let inner = Inner { frame: None, prepared, headless, bounds, cameras: pose.cameras };
            Ok(Self { inner: Mutex::new(inner), interruption, shadows, max_memory, device })
        })
    }

    /// Renders an image of `size` = (width, height). Without a camera, it shows the view of the scene's first camera, or the whole
    /// scene.
    #[pyo3(signature = (camera=None, size=[1280, 720], **options))]
    pub fn render<'py>(
        &self,
        py: Python<'py>,
        camera: Option<&Camera>,
        size: [u32; 2],
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let request = self.request(size, options)?;
        let camera = camera.cloned().unwrap_or_default();
        let image = self.work(py, |inner| inner.render(&camera, &request))?;
        image.into_python(py, &request.layers)
    }

    /// Renders an image for each camera, as one array (cameras, height, width, 4). `progress(done, total)` is called after each.
    #[pyo3(signature = (cameras, size=[1280, 720], *, progress=None, **options))]
    fn render_views<'py>(
        &self,
        py: Python<'py>,
        cameras: Vec<Camera>,
        size: [u32; 2],
        progress: Option<&Bound<'py, PyAny>>,
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let request = self.request(size, options)?;
        if !request.layers.is_empty() {
            return Err(error::usage("layers: render_views gives colours alone; call render for each camera"));
        }
        let (mut floats, mut codes) = (Vec::new(), Vec::new());
        for (done, camera) in cameras.iter().enumerate() {
            match self.work(py, |inner| inner.render(camera, &request))?.colors {
                Colors::Float32(colors) => floats.extend(colors),
                Colors::Uint8(colors) => codes.extend(colors),
            }
            if let Some(progress) = progress {
                progress.call1((done + 1, cameras.len()))?;
            }
        }
        let [width, height] = request.settings.output_size().map(|side| side as usize);
        let shape = [cameras.len(), height, width];
        match request.kind {
            Kind::Float32 => pixels::array(py, &shape, floats),
            Kind::Uint8 => pixels::array(py, &shape, codes),
        }
    }

    /// Renders an image in which a region is enlarged where it is: `center` and `radius` in pixels, `magnify` at least 1. Nothing is
    /// resampled.
    #[pyo3(signature = (center, radius, magnify, camera=None, size=[1280, 720], *, shape="circle", smooth=false, **options))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn zoom<'py>(
        &self,
        py: Python<'py>,
        center: [f64; 2],
        radius: f64,
        magnify: f64,
        camera: Option<&Camera>,
        size: [u32; 2],
        shape: &str,
        smooth: bool,
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let request = self.request(size, options)?;
        let shape = named("shape", shape)?;
        let transition = if smooth { Transition::Smooth } else { Transition::Linear };
        let region = ZoomRegion { center, radius: [radius; 2], multiplicity: magnify.recip(), shape, transition };
        let map = ZoomMap::new(vec![region]).map_err(error::usage)?;
        let camera = camera.cloned().unwrap_or_default();
        let image = self.work(py, |inner| {
            let pinhole = camera.pinhole(&inner.surroundings(), size)?;
            let locations = mapped_locations(size, &map).map_err(error::usage)?;
            inner.render_locations(&[(pinhole, locations)], &request)
        })?;
        image.into_python(py, &request.layers)
    }

    /// Renders a panorama around the camera's eye. `projection` is "equirectangular", "cylindrical", "fisheye" or "cubemap"; `fov` its
    /// horizontal field of view in degrees, by default 360, of a fisheye 180.
    #[pyo3(signature = (projection, size=[1280, 640], camera=None, *, fov=None, **options))]
    fn panorama<'py>(
        &self,
        py: Python<'py>,
        projection: &str,
        size: [u32; 2],
        camera: Option<&Camera>,
        fov: Option<f64>,
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let projection: PanoramaProjection = named("projection", projection)?;
        let widest = if projection == PanoramaProjection::Fisheye { 180.0 } else { 360.0 };
        let panorama = Panorama::new(projection, fov.unwrap_or(widest), size).map_err(error::usage)?;
        let mut request = self.request(size, options)?;
        let camera = camera.cloned().unwrap_or_default();
        let image = self.work(py, |inner| {
            let view = camera.view(&inner.surroundings(), size)?;
            let view =
                view.ok_or_else(|| error::usage("this camera's pixels are not square: panoramas need square ones"))?;
            let locations = panorama.locations(&view).map_err(error::usage)?;
            request.settings = request.settings.clone().size(locations.size());
            let background = request.settings.scene.background;
            let rendered = inner.headless.render_locations(&inner.prepared, locations.rig(), &request.settings)?;
            let empty = background.map_or([0.0; 4], |[r, g, b]| [r, g, b, 1.0]);
            let cropped = Rendered {
                size: panorama.size(),
                colors: locations.crop(&rendered.colors, empty),
                attributes: locations.crop(&rendered.attributes, PixelAttributes::default()),
                statistics: rendered.statistics,
            };
            Ok(Image::of_light(cropped, request.kind)?)
        })?;
        image.into_python(py, &request.layers)
    }

    /// Samples the scene at any locations of the camera's image plane, which has `plane` = (width, height) pixels.
    ///
    /// `locations` of shape (height, width, 2) make an image: (u, v) of each pixel, with (0, 0) at the plane's upper left corner; NaN
    /// leaves a pixel empty. Locations of shape (N, 2) are superpixels of their own, averaged by the box filter alone, and the result is
    /// (N, 4). `jacobians` (..., 2, 2) have the change of (u, v) from one column (first column) and one row (second column) of the
    /// result to the next. Without them, images take differences of neighbours, and lists one pixel of the plane.
    #[pyo3(signature = (locations, plane, camera=None, *, jacobians=None, **options))]
    fn sample<'py>(
        &self,
        py: Python<'py>,
        locations: PyReadonlyArrayDyn<'py, f64>,
        plane: [u32; 2],
        camera: Option<&Camera>,
        jacobians: Option<PyReadonlyArrayDyn<'py, f64>>,
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let camera = camera.cloned().unwrap_or_default();
        let list = LocationList::new(&locations, jacobians.as_ref())?;
        let request = self.request(list.size().unwrap_or(plane), options)?;
        if list.size().is_some() {
            let image = self.work(py, |inner| {
                let pinhole = camera.pinhole(&inner.surroundings(), plane)?;
                inner.render_locations(&[(pinhole, list.locations)], &request)
            })?;
            return image.into_python(py, &request.layers);
        }
        if !request.layers.is_empty() || request.kind != Kind::Float32 {
            return Err(error::usage("dtype and layers: a list of locations gives colours of float32 alone"));
        }
        let filter = request.settings.pixel_filter;
        if !filter.is_box() {
            return Err(error::render(RenderError::LocationFilter { shape: filter.shape }));
        }
        let cells = CellOptions::new(request.settings.method.samples());
        let sampled = self.work(py, |inner| {
            let pinhole = camera.pinhole(&inner.surroundings(), plane)?;
            let scene = &request.settings.scene;
            Ok(inner.headless.sample_superpixels(&inner.prepared, &pinhole, &list.locations, &cells, scene)?)
        })?;
        pixels::array(py, &[sampled.values.len()], sampled.values)
    }

    /// Messages of the validation layer so far.
    #[getter]
    fn validation_messages(&self) -> Vec<String> {
        lock(&self.inner).headless.validation_messages()
    }
}

/// Locations of an array.
struct LocationList {
    shape: Vec<usize>,
    locations: Vec<SampleLocation>,
}

impl LocationList {
    fn new(array: &PyReadonlyArrayDyn<'_, f64>, jacobians: Option<&PyReadonlyArrayDyn<'_, f64>>) -> PyResult<Self> {
        let shape = match *array.shape() {
            [_, 2] | [_, _, 2] => array.shape()[..array.shape().len() - 1].to_vec(),
            ref other => {
                return Err(error::usage(format!(
                    "locations have the shape {other:?}; it must be (N, 2) or (height, width, 2)"
                )));
            }
        };
        let uv: Vec<f64> = array.as_array().iter().copied().collect();
        let uv = uv.as_chunks::<2>().0;
        let given: Option<Vec<f64>> = jacobians.map(|array| array.as_array().iter().copied().collect());
        if let Some(jacobians) = jacobians {
            let expected: Vec<usize> = shape.iter().copied().chain([2, 2]).collect();
            if jacobians.shape() != expected {
                let found = jacobians.shape();
                return Err(error::usage(format!("jacobians have the shape {found:?}; it must be {expected:?}")));
            }
        }
        let jacobian = |index: usize| match (&given, shape.as_slice()) {
            (Some(given), _) => {
                let at = |i: usize| given[4 * index + i];
                [[at(0), at(2)], [at(1), at(3)]]
            }
            (None, &[height, width]) => {
                let (row, column) = (index / width, index % width);
                [difference(uv, index, 1, column, width), difference(uv, index, width, row, height)]
            }
            (None, _) => DMat2::IDENTITY.to_cols_array_2d(),
        };
        let location = |(index, uv): (usize, &[f64; 2])| {
            let is_empty = shape.len() == 2 && uv.iter().any(|x| x.is_nan());
            (!is_empty).then(|| SampleLocation { uv: *uv, jacobian: jacobian(index), output: index as u32 })
        };
        let locations = uv.iter().enumerate().filter_map(location).collect();
        Ok(Self { shape, locations })
    }

    /// Width and height, if the locations make an image.
    fn size(&self) -> Option<[u32; 2]> {
        match *self.shape.as_slice() {
            [height, width] => Some([width as u32, height as u32]),
            _ => None,
        }
    }
}

/// Difference of the locations beside `index` along an axis on which they are `stride` apart; `place` of `length` is the place on
/// this axis. One pixel of the plane where there is no neighbour.
fn difference(uv: &[[f64; 2]], index: usize, stride: usize, place: usize, length: usize) -> [f64; 2] {
    let valid = |index: usize| uv.get(index).filter(|uv| uv.iter().all(|x| !x.is_nan()));
    let before = if place > 0 { valid(index - stride) } else { None };
    let after = if place + 1 < length { valid(index + stride) } else { None };
    let here = &uv[index];
    let over = |from: &[f64; 2], to: &[f64; 2], steps: f64| [(to[0] - from[0]) / steps, (to[1] - from[1]) / steps];
    match (before, after) {
        (Some(before), Some(after)) => over(before, after, 2.0),
        (Some(before), None) => over(before, here, 1.0),
        (None, Some(after)) => over(here, after, 1.0),
        (None, None) if stride == 1 => [1.0, 0.0],
        (None, None) => [0.0, 1.0],
    }
}

/// Renders one image of a scene: a Scene, a file, or a mesh or scene of trimesh. A Renderer is faster for several images.
#[pyfunction]
#[pyo3(signature = (scene, size=[1280, 720], camera=None, *, shadows=false, time=0.0, animation=None, device=None, max_memory=None, **options))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub fn render<'py>(
    scene: &Bound<'py, PyAny>,
    size: [u32; 2],
    camera: Option<&Camera>,
    shadows: bool,
    time: f64,
    animation: Option<String>,
    device: Option<String>,
    max_memory: Option<u64>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let renderer = Renderer::new(scene, shadows, time, animation, device, max_memory, false)?;
    renderer.render(scene.py(), camera, size, options)
}
