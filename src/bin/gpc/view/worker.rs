//! Pictures that the window's frames can't show: zooms, values other than colours, photographs, and pictures for files. A
//! separate thread makes them on the window's device.
//!
//! The thread shares the device's queue with the window, whose frames wait for at most one submission of the thread. A
//! submission is a draft, which takes about as long as the window's own drafts; a band of rows; or one of the short runs
//! over locations that [`Headless::stop_when`] describes.

use super::band::{BandHeights, ROW_STEP, Took};
use super::engine::Engine;
use super::overlay::{self, COUNT_SIDE, Overlay};
use super::photo::PhotoView;
use super::requests::Requests;
use super::source::LoadedScene;
use super::standpoint::Standpoint;
use super::stop::Stop;
use super::tint::tinted;
use crate::cli::render::view::bounds;
use anyhow::Context;
use glam::DVec2;
use gpc::camera::Pinhole;
use gpc::camera::set::mapped_locations;
use gpc::camera::zoom::ZoomMap;
use gpc::color::srgb;
use gpc::compare;
use gpc::output::{self, Aov, AovKind, DecodedImage, Format, Picture};
use gpc::render::{
    Headless, Method, PixelRect, PreparedScene, RenderError, Rendered, SceneRequest, Settings, Shadows, Statistics,
};
use gpc::resample::Zoomed;
use gpc::scene::{Pose, PoseRequest};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// Rows of the first band of a picture that takes long. Later bands depend on the time that the earlier ones took. Between
/// two bands the picture can be stopped.
const FIRST_BAND: u32 = 32;
// The rows of a band hold whole pixels of the count of triangles.
const _: () = assert!(ROW_STEP.is_multiple_of(COUNT_SIDE));
/// Smallest number of samples of the supersampled picture that serves as a reference.
const REFERENCE_SAMPLES: u32 = 256;

/// Kind of picture to make of a scene.
#[derive(Clone, Debug)]
pub enum Subject {
    /// The scene, for the window.
    Still,
    /// The scene with enlarged regions, for the window; `true` colours their transitions.
    Zoom(ZoomMap, bool),
    /// Values of pixels other than their colours, for the window.
    Overlay(Overlay),
    /// A PNG file with the same bytes that `gpc render` or, with enlarged regions, `gpc zoom` writes.
    File(PathBuf, Option<ZoomMap>),
}

/// A picture to make.
struct Order {
    /// Number of the order; 0 for files.
    number: u64,
    task: Task,
    stop: Stop,
}

/// Kind of picture or file to make.
pub enum Task {
    Scene(Box<SceneTask>),
    Photo(PhotoView),
    /// A PNG file with the same bytes that `gpc zoom` or `gpc unzoom` writes.
    PhotoFile(PhotoView, PathBuf),
}

/// A picture of a scene: scene, standpoint and settings.
pub struct SceneTask {
    pub stage: Arc<LoadedScene>,
    /// Time of the animation in seconds.
    pub time: f64,
    pub standpoint: Standpoint,
    pub settings: Settings,
    /// Whether the picture is a draft. A draft is finished and shown even if another picture has been ordered meanwhile, so
    /// that lenses that move show something.
    pub is_draft: bool,
    /// Whether the scene's environment is the background; pictures with enlarged regions have none.
    pub shows_environment: bool,
    pub subject: Subject,
}

impl Task {
    /// File that the task writes. Later orders do not stop the writing of files.
    fn file(&self) -> Option<&Path> {
        match self {
            Self::Scene(task) => match &task.subject {
                Subject::File(path, _) => Some(path),
                _ => None,
            },
            Self::Photo(_) => None,
            Self::PhotoFile(_, path) => Some(path),
        }
    }
}

impl SceneTask {
    /// Whether the window's scene shows the task's moment. A scene that moves is prepared for its motion, so that the
    /// images of frames may have other bytes than those of a pose; files need the bytes of the pose.
    fn is_on_device(&self) -> bool {
        let LoadedScene { source, motion, .. } = &*self.stage;
        let is_file = matches!(self.subject, Subject::File(..));
        motion.is_none() || (source.request.time == self.time && !is_file)
    }
}

/// A picture for the window.
pub struct Pixels {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// RGBA as sRGB codes, premultiplied, rows from the top.
    pub codes: Vec<[u8; 4]>,
    /// Text about the picture.
    pub figures: Option<String>,
    /// Time that a draft took.
    pub draft: Option<DraftTime>,
}

/// Time that a draft took.
#[derive(Clone, Copy, Debug)]
pub struct DraftTime {
    /// Samples a pixel.
    pub samples: u32,
    pub ms: f64,
}

impl Pixels {
    /// Picture with the codes of linear colours.
    fn new(size: [u32; 2], colors: &[[f32; 4]]) -> Self {
        let code = |[r, g, b, a]: &[f32; 4]| {
            let [r, g, b] = [*r, *g, *b].map(|v| srgb::encode_u8(f64::from(v)));
            [r, g, b, (a.clamp(0.0, 1.0) * 255.0).round() as u8]
        };
        Self { size, codes: colors.par_iter().map(code).collect(), figures: None, draft: None }
    }

    /// Replaces each code by `change` of the code and the pixel's centre.
    fn map(mut self, change: impl Fn([u8; 4], DVec2) -> [u8; 4]) -> Self {
        let width = self.size[0].max(1);
        for (index, code) in self.codes.iter_mut().enumerate() {
            let (x, y) = (index as u32 % width, index as u32 / width);
            *code = change(*code, DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
        }
        self
    }
}

/// Result of an order.
pub enum Made {
    Pixels(u64, anyhow::Result<Pixels>),
    File(PathBuf, anyhow::Result<()>),
}

impl Made {
    /// Whether the order was stopped before it was carried out.
    fn is_stopped(&self) -> bool {
        let error = match self {
            Self::Pixels(_, made) => made.as_ref().err(),
            Self::File(_, made) => made.as_ref().err(),
        };
        error.is_some_and(|error| matches!(error.downcast_ref(), Some(RenderError::Stopped)))
    }
}

/// Thread that carries out orders until this is dropped, which stops the current one.
pub struct PictureWorker {
    orders: Requests<Order>,
    /// Flag that stops the last picture for the window.
    picture: Stop,
    /// Files that were ordered and are not yet written, with the flags that stop them.
    files: Vec<(PathBuf, Stop)>,
}

impl PictureWorker {
    /// Starts the thread, which passes results to `deliver`. All scenes of its orders are on the same device.
    pub fn new(deliver: impl Fn(Made) + Send + 'static) -> Self {
        let mut maker = Maker::default();
        let orders = Requests::new(move |order: Order| {
            if order.stop.is_superseded() {
                return;
            }
            let made = maker.make(&order);
            if !made.is_stopped() {
                deliver(made);
            }
        });
        Self { orders, picture: Stop::default(), files: Vec::new() }
    }

    /// Orders a picture. An order for the window supersedes earlier ones.
    pub fn ask(&mut self, number: u64, task: Task) {
        let stop = Stop::default();
        match task.file() {
            Some(path) => self.files.push((path.to_owned(), stop.clone())),
            None => std::mem::replace(&mut self.picture, stop.clone()).supersede(),
        }
        self.orders.send(Order { number, task, stop });
    }

    /// Marks the last picture for the window as superseded.
    pub fn supersede(&mut self) {
        self.picture.supersede();
    }

    /// Removes a file from the list: it was written, or failed.
    pub fn delivered(&mut self, path: &Path) {
        self.files.retain(|(asked, _)| asked != path);
    }

    /// Stops all files that are being written, and returns their paths.
    pub fn stop_files(&mut self) -> Vec<PathBuf> {
        let stopped = |(path, stop): (PathBuf, Stop)| {
            stop.stop();
            path
        };
        self.files.drain(..).map(stopped).collect()
    }
}

impl Drop for PictureWorker {
    fn drop(&mut self) {
        self.picture.stop();
        self.stop_files();
    }
}

/// State of the thread. Fields are dropped in their order: users of the device come before the device.
#[derive(Default)]
struct Maker {
    /// The pose that was shown last, if the window's scene did not show it.
    posed: Option<PosedScene>,
    headless: Option<(Headless, Arc<Engine>)>,
}

/// A pose on the device.
struct PosedScene {
    stage: Arc<LoadedScene>,
    time: f64,
    pose: Pose,
    prepared: PreparedScene,
}

/// A pose that is on the device, and the renderer that shows it.
struct Shown<'a> {
    headless: &'a mut Headless,
    pose: &'a Pose,
    prepared: &'a PreparedScene,
}

impl Maker {
    /// Carries out an order.
    fn make(&mut self, order: &Order) -> Made {
        let number = order.number;
        let task = match &order.task {
            Task::Scene(task) => task,
            Task::Photo(view) => {
                let pixels = Pixels::new(view.window.size, &view.pixels());
                let pixels = pixels.map(|code, place| view.covered(code, place));
                return Made::Pixels(number, Ok(pixels));
            }
            Task::PhotoFile(view, path) => {
                let written = write_png(path, view.window.size, &view.pixels(), view.map.as_ref());
                return Made::File(path.clone(), written);
            }
        };
        if let Err(error) = self.listen(task, &order.stop) {
            return Made::Pixels(number, Err(error));
        }
        let start = Instant::now();
        let pixels = match &task.subject {
            Subject::File(path, map) => {
                return Made::File(path.clone(), self.write(task, path, map.as_ref()));
            }
            Subject::Still => self.scenery(task).map(|rendered| Pixels::new(rendered.size, &rendered.colors)),
            Subject::Zoom(map, tints) => self.zoom(task, map, *tints),
            Subject::Overlay(Overlay::Stored(kind)) => self.stored(task, *kind),
            Subject::Overlay(Overlay::Triangles) => self.triangles(task),
            Subject::Overlay(Overlay::Error) => self.error(task),
        };
        let draft = task
            .is_draft
            .then(|| DraftTime { samples: task.settings.method.samples(), ms: 1e3 * start.elapsed().as_secs_f64() });
        Made::Pixels(number, pixels.map(|pixels| Pixels { draft, ..pixels }))
    }

    /// Has the renderer check between submissions whether the task is still wanted.
    fn listen(&mut self, task: &SceneTask, stop: &Stop) -> anyhow::Result<()> {
        let engine = &task.stage.engine;
        let (headless, _) = match &mut self.headless {
            Some(open) => open,
            none => none.insert((engine.headless()?, engine.clone())),
        };
        let (stop, is_draft) = (stop.clone(), task.is_draft);
        headless.stop_when(move || stop.is_unwanted() || (!is_draft && stop.is_superseded()));
        Ok(())
    }

    fn write(&mut self, task: &SceneTask, path: &Path, map: Option<&ZoomMap>) -> anyhow::Result<()> {
        let rendered = match map {
            Some(map) => self.enlarged(task, map)?,
            None => self.scenery(task)?,
        };
        write_png(path, rendered.size, &rendered.colors, map)
    }

    /// The scene over its background.
    fn scenery(&mut self, task: &SceneTask) -> anyhow::Result<Rendered> {
        let mut rendered = self.render(task, &task.settings)?;
        if task.shows_environment {
            let Shown { pose, .. } = self.show(task)?;
            let environment = pose
                .environment(&task.stage.scene)
                .context("--background environment: there is none; name one by --environment FILE")?;
            rendered.show_behind(environment, &camera(task, pose)?, &task.settings)?;
        }
        Ok(rendered)
    }

    /// The scene with enlarged regions.
    fn enlarged(&mut self, task: &SceneTask, map: &ZoomMap) -> anyhow::Result<Rendered> {
        let size = task.settings.size;
        let Shown { headless, pose, prepared } = self.show(task)?;
        let camera = camera(task, pose)?;
        let rig = [(Pinhole::from_camera(&camera, size)?, mapped_locations(size, map)?)];
        Ok(headless.render_locations(prepared, &rig, &task.settings)?)
    }

    fn zoom(&mut self, task: &SceneTask, map: &ZoomMap, tints: bool) -> anyhow::Result<Pixels> {
        let rendered = self.enlarged(task, map)?;
        let pixels = Pixels::new(rendered.size, &rendered.colors);
        Ok(if tints { pixels.map(|code, place| tinted(code, place, map.regions())) } else { pixels })
    }

    fn stored(&mut self, task: &SceneTask, kind: AovKind) -> anyhow::Result<Pixels> {
        let settings = task.settings.clone().attributes(true).shadows(Shadows::None);
        let rendered = self.render(task, &settings)?;
        let aov = Aov::from_attributes(kind, &rendered.attributes);
        // The same colours as in files.
        let file = output::encode_aov(rendered.size, &aov)?;
        let image = image::load_from_memory(&file)?.to_rgba8();
        let codes = image.pixels().map(|pixel| pixel.0).collect();
        Ok(Pixels { size: rendered.size, codes, figures: None, draft: None })
    }

    /// Picture of the number of triangles in each pixel, counted at a grid of samples.
    fn triangles(&mut self, task: &SceneTask) -> anyhow::Result<Pixels> {
        let size = task.settings.size;
        let finer = task
            .settings
            .clone()
            .size(size.map(|side| side * COUNT_SIDE))
            .attributes(true)
            .shadows(Shadows::None)
            .method(Method::None);
        let side = COUNT_SIDE as usize;
        let width = size[0] as usize * side;
        let mut codes = Vec::new();
        self.render_bands(task, &finer, |band| {
            for row in band.attributes.chunks_exact(width * side) {
                for column in 0..size[0] as usize {
                    let ids = (0..side * side).map(|sample| {
                        let at = sample / side * width + column * side + sample % side;
                        row.get(at).map_or(0, |pixel| pixel.id)
                    });
                    codes.push(overlay::triangles(&mut ids.collect::<Vec<_>>()));
                }
            }
        })?;
        Ok(Pixels { size, codes, figures: None, draft: None })
    }

    /// Picture of the differences from supersampling.
    fn error(&mut self, task: &SceneTask) -> anyhow::Result<Pixels> {
        let side = task.settings.method.samples().max(REFERENCE_SAMPLES).isqrt();
        let brute = task.settings.clone().shadows(Shadows::None).method(Method::Ssaa { samples: side * side });
        let reference = self.render(task, &brute)?.colors;
        let rendered = task.settings.clone().shadows(Shadows::None);
        let rendered = self.render(task, &rendered)?;
        let size = rendered.size;
        let [first, second] = [&reference, &rendered.colors]
            .map(|colors| Picture::new(size, colors).map(|picture| DecodedImage::from(&picture)));
        let found = compare::compare(&first?, &second?)?;
        let reference = Pixels::new(size, &reference).codes;
        let rendered = Pixels::new(size, &rendered.colors).codes;
        let pairs = reference.iter().zip(&rendered);
        Ok(Pixels {
            size,
            codes: pairs.map(|(a, b)| overlay::error(*a, *b)).collect(),
            figures: Some(format!(
                "against {} samples everywhere: RMSE {:.5}, FLIP {:.5}",
                side * side,
                found.rmse,
                found.flip
            )),
            draft: None,
        })
    }

    /// Renders bands from the top, and passes each to `take`. The number of rows of a band is a multiple of 4; a draft is one
    /// band.
    fn render_bands(
        &mut self,
        task: &SceneTask,
        settings: &Settings,
        mut take: impl FnMut(Rendered),
    ) -> anyhow::Result<()> {
        let [width, height] = settings.size;
        let mut heights = BandHeights::new(height, FIRST_BAND);
        let mut first = 0;
        while first < height {
            let rows = if task.is_draft { 0..height } else { heights.band(first) };
            first = rows.end;
            let region = PixelRect { corner: [0, rows.start], size: [width, rows.end - rows.start] };
            let band = settings.clone().region(Some(region));
            let Shown { headless, pose, prepared } = self.show(task)?;
            let camera = camera(task, pose)?;
            let mut frame = headless.prepare(prepared, &band)?;
            let rendered = headless.render(&mut frame, &camera)?;
            heights.learn(rows.end - rows.start, Took::of(&rendered.statistics));
            take(rendered);
        }
        Ok(())
    }

    fn render(&mut self, task: &SceneTask, settings: &Settings) -> anyhow::Result<Rendered> {
        let mut whole = Rendered {
            size: settings.size,
            colors: Vec::new(),
            attributes: Vec::new(),
            statistics: Statistics::default(),
        };
        self.render_bands(task, settings, |band| {
            whole.colors.extend(band.colors);
            whole.attributes.extend(band.attributes);
            whole.statistics.append(band.statistics);
        })?;
        Ok(whole)
    }

    /// Uploads the task's pose, unless it is on the device already.
    fn show<'a>(&'a mut self, task: &'a SceneTask) -> anyhow::Result<Shown<'a>> {
        let (headless, _) = self.headless.as_mut().context("there is no device")?;
        let stage = &task.stage;
        if task.is_on_device() {
            self.posed = None;
            return Ok(Shown { headless, pose: &stage.pose, prepared: &stage.prepared });
        }
        let is_shown = |posed: &PosedScene| Arc::ptr_eq(&posed.stage, stage) && posed.time == task.time;
        // The memory of the pose before is freed first, so that this one can use it.
        let posed = match self.posed.take().filter(is_shown) {
            Some(posed) => posed,
            None => {
                let pose = stage.scene.pose(&PoseRequest { time: task.time, ..stage.source.request.clone() })?;
                let request = SceneRequest::new(&stage.scene, &pose)
                    .shadowed(task.settings.scene.shadows)
                    .within(task.settings.scene.max_memory);
                let prepared = headless.upload(request)?;
                PosedScene { stage: stage.clone(), time: task.time, pose, prepared }
            }
        };
        let PosedScene { pose, prepared, .. } = self.posed.insert(posed);
        Ok(Shown { headless, pose, prepared })
    }
}

/// Writes a PNG that also stores its enlarged regions.
fn write_png(path: &Path, size: [u32; 2], colors: &[[f32; 4]], map: Option<&ZoomMap>) -> anyhow::Result<()> {
    let mut bytes = output::encode(Format::Png8, &Picture::new(size, colors)?, &[])?;
    if let Some(map) = map {
        bytes = Zoomed::add_map(&bytes, size, map)?;
    }
    Ok(output::write_atomically(path, &bytes)?)
}

fn camera(task: &SceneTask, pose: &Pose) -> anyhow::Result<gpc::camera::Camera> {
    let [width, height] = task.settings.size.map(f64::from);
    Ok(task.standpoint.camera(&pose.cameras, bounds(pose), width / height)?)
}

#[cfg(test)]
mod tests {
    use super::super::photo::{Easel, Photo};
    use super::*;
    use std::sync::mpsc::channel;
    use std::time::Duration;

    const LONG: Duration = Duration::from_secs(60);

    #[test]
    fn the_last_picture_and_every_file_is_made() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let white = Picture::new([1, 1], &[[1.0; 4]]).unwrap();
        let png = output::encode(Format::Png8, &white, &[]).unwrap();
        std::fs::write(path("photo.png"), png).unwrap();
        let easel = Easel::new(Photo::open(&path("photo.png")).unwrap(), [1, 1]);
        let view = easel.view([1, 1], None, false, DVec2::ZERO);
        let (sender, made) = channel();
        let mut worker = PictureWorker::new(move |made| {
            let _ = sender.send(made);
        });
        for number in 1..20 {
            worker.ask(number, Task::Photo(view.clone()));
        }
        for name in ["a.png", "b.png"] {
            worker.ask(0, Task::PhotoFile(view.clone(), path(name)));
        }
        worker.ask(20, Task::Photo(view.clone()));
        let mut files = Vec::new();
        loop {
            match made.recv_timeout(LONG).unwrap() {
                Made::Pixels(20, pixels) => {
                    assert_eq!(pixels.unwrap().codes, [[255; 4]]);
                    break;
                }
                Made::Pixels(_, pixels) => drop(pixels.unwrap()),
                Made::File(path, written) => {
                    written.unwrap();
                    worker.delivered(&path);
                    files.push(path);
                }
            }
        }
        assert_eq!(files, [path("a.png"), path("b.png")]);
        assert!(files.iter().all(|file| file.exists()));
        assert_eq!(worker.stop_files(), Vec::<PathBuf>::new());
    }
}
