//! Pictures that the window's frames can't make: of other sampling locations than the centres of pixels, of what pixels hold
//! beside their colours, of photographs, and for files. They are made in a thread and a device of their own, so that the
//! window never waits for them.

use super::inbox::Inbox;
use super::losses::is_lost;
use super::overlay::{self, COUNT_SIDE, Overlay};
use super::photo;
use super::source::{Source, bounds};
use super::standpoint::Standpoint;
use super::tint::tinted;
use anyhow::{Context, bail};
use glam::DVec2;
use gpc::camera::Pinhole;
use gpc::camera::set::SamplingSet;
use gpc::camera::zoom::ZoomMap;
use gpc::compare;
use gpc::output::{self, Aov, AovKind, DecodedImage, Format, Picture};
use gpc::reference::srgb;
use gpc::render::{
    Headless, HeadlessOptions, Method, PixelRect, PreparedScene, Rendered, Settings, Shadows,
};
use gpc::resample::Zoomed;
use gpc::scene::{Pose, PoseRequest, Scene};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;

/// Rows of a picture that are made between two looks at the orders.
const BAND: u32 = 32;
/// Brute force that pictures are compared with has at least so many samples.
const REFERENCE_SAMPLES: u32 = 256;

/// What is to be made of a scene.
#[derive(Clone, Debug)]
pub enum Subject {
    /// The scene, to look at.
    Still,
    /// The scene with regions enlarged, to look at, with or without colours over the transitions.
    Zoom(ZoomMap, bool),
    /// What pixels hold beside their colours, to look at.
    Overlay(Overlay),
    /// A PNG file as `gpc render` writes it, to the same bytes.
    File(PathBuf),
}

/// A picture to be made.
pub struct Order {
    /// Tells what is made from what was asked for since.
    pub number: u64,
    pub task: Task,
}

/// Of what.
pub enum Task {
    Scene(Box<SceneTask>),
    Photo(photo::View),
    /// A PNG file as `gpc zoom` and `gpc unzoom` write it, to the same bytes.
    PhotoFile(photo::View, PathBuf),
}

/// What of a scene, and from where.
pub struct SceneTask {
    pub source: Source,
    pub scene: Arc<Scene>,
    /// Moment of the animation in seconds.
    pub time: f64,
    pub standpoint: Standpoint,
    pub settings: Settings,
    pub subject: Subject,
}

impl Order {
    /// Whether it is made whatever else is asked for.
    pub fn is_file(&self) -> bool {
        match &self.task {
            Task::Scene(task) => matches!(task.subject, Subject::File(_)),
            Task::Photo(_) => false,
            Task::PhotoFile(..) => true,
        }
    }
}

/// A picture to look at.
pub struct Pixels {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Rows of RGBA from the top: sRGB codes, premultiplied.
    pub codes: Vec<[u8; 4]>,
    /// What there is to say of it.
    pub figures: Option<String>,
}

impl Pixels {
    /// Codes of linear light.
    fn new(size: [u32; 2], colors: &[[f32; 4]]) -> Self {
        let code = |[r, g, b, a]: &[f32; 4]| {
            let [r, g, b] = [*r, *g, *b].map(|v| srgb::encode_u8(f64::from(v)));
            [r, g, b, (a.clamp(0.0, 1.0) * 255.0).round() as u8]
        };
        Self {
            size,
            codes: colors.iter().map(code).collect(),
            figures: None,
        }
    }

    /// The same with other codes, each made of the old one and the pixel's centre.
    fn map(mut self, change: impl Fn([u8; 4], DVec2) -> [u8; 4]) -> Self {
        let width = self.size[0].max(1);
        for (index, code) in self.codes.iter_mut().enumerate() {
            let (x, y) = (index as u32 % width, index as u32 / width);
            *code = change(*code, DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
        }
        self
    }
}

/// What became of an order.
pub enum Made {
    Pixels(u64, anyhow::Result<Pixels>),
    File(PathBuf, anyhow::Result<()>),
}

impl Made {
    /// Why there is nothing.
    fn error(&self) -> Option<&anyhow::Error> {
        match self {
            Self::Pixels(_, made) => made.as_ref().err(),
            Self::File(_, made) => made.as_ref().err(),
        }
    }
}

/// Takes orders until it is dropped, which waits for what it is at and for files that were asked for: a driver can't be
/// left in the middle of its work when the process ends.
pub struct Studio {
    /// `None` only while dropping.
    orders: Option<Sender<Order>>,
    thread: Option<JoinHandle<()>>,
}

impl Studio {
    /// Starts a thread that opens a device with the first order of a scene, and delivers what it makes.
    pub fn new(options: HeadlessOptions, deliver: impl Fn(Made) + Send + 'static) -> Self {
        let (orders, received) = channel();
        let thread = std::thread::spawn(move || {
            Maker {
                shown: None,
                headless: None,
                options,
                inbox: Inbox::new(received),
            }
            .run(deliver);
        });
        Self {
            orders: Some(orders),
            thread: Some(thread),
        }
    }

    /// Asks for a picture. Of those to look at that wait for their turn, the last alone is made.
    pub fn ask(&self, order: Order) {
        if let Some(orders) = &self.orders {
            // The thread ends with this sender, and not before.
            let _ = orders.send(order);
        }
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        self.orders = None;
        if let Some(thread) = self.thread.take() {
            // A panic has been reported by the thread itself.
            let _ = thread.join();
        }
    }
}

/// The thread's own.
struct Maker {
    /// First, since it goes before the device.
    shown: Option<Shown>,
    headless: Option<Headless>,
    options: HeadlessOptions,
    inbox: Inbox,
}

/// A pose on the device.
struct Shown {
    scene: Arc<Scene>,
    time: f64,
    pose: Pose,
    prepared: PreparedScene,
}

impl Maker {
    fn run(&mut self, deliver: impl Fn(Made)) {
        while let Some(order) = self.inbox.next() {
            let Some(made) = self.make(&order) else {
                continue;
            };
            if made.error().is_some_and(is_lost) {
                // The next order opens another device.
                self.shown = None;
                self.headless = None;
            }
            deliver(made);
        }
    }

    /// Makes a picture, unless another one is asked for meanwhile.
    fn make(&mut self, order: &Order) -> Option<Made> {
        let number = order.number;
        let task = match &order.task {
            Task::Scene(task) => task,
            Task::Photo(view) => {
                let pixels = Pixels::new(view.window.size, &view.pixels());
                let pixels = pixels.map(|code, place| view.covered(code, place));
                return Some(Made::Pixels(number, Ok(pixels)));
            }
            Task::PhotoFile(view, path) => {
                return Some(Made::File(path.clone(), write_photo(view, path)));
            }
        };
        let pixels = match &task.subject {
            Subject::File(path) => {
                return Some(Made::File(path.clone(), self.write(task, path)));
            }
            Subject::Still => self.still(task).map(Some),
            Subject::Zoom(map, tints) => self.zoom(task, map, *tints).map(Some),
            Subject::Overlay(Overlay::Stored(kind)) => self.stored(task, *kind).map(Some),
            Subject::Overlay(Overlay::Triangles) => self.triangles(task),
            Subject::Overlay(Overlay::Error) => self.error(task),
        };
        let made = |pixels| Made::Pixels(number, pixels);
        pixels.transpose().map(made)
    }

    fn write(&mut self, task: &SceneTask, path: &Path) -> anyhow::Result<()> {
        let rendered = self.render(task, &task.settings)?;
        let picture = Picture::new(rendered.size, &rendered.colors)?;
        let bytes = output::encode(Format::Png8, &picture, &[])?;
        Ok(output::write_atomically(path, &bytes)?)
    }

    fn still(&mut self, task: &SceneTask) -> anyhow::Result<Pixels> {
        let rendered = self.render(task, &task.settings)?;
        Ok(Pixels::new(rendered.size, &rendered.colors))
    }

    fn zoom(&mut self, task: &SceneTask, map: &ZoomMap, tints: bool) -> anyhow::Result<Pixels> {
        let size = task.settings.size;
        let (headless, shown) = self.show(task)?;
        let camera = camera(task, shown)?;
        let set = SamplingSet::mapped(size, map)?;
        let rig = [(Pinhole::from_camera(&camera, size)?, set.sites())];
        let rendered = headless.render_sites(&shown.prepared, &rig, size, &task.settings)?;
        check(headless)?;
        let pixels = Pixels::new(size, &rendered.colors);
        Ok(if tints {
            pixels.map(|code, place| tinted(code, place, map.regions()))
        } else {
            pixels
        })
    }

    fn stored(&mut self, task: &SceneTask, kind: AovKind) -> anyhow::Result<Pixels> {
        let settings = Settings {
            attributes: true,
            shadows: Shadows::None,
            ..task.settings.clone()
        };
        let rendered = self.render(task, &settings)?;
        let aov = Aov::from_attributes(kind, &rendered.attributes);
        // The same colours as in files.
        let file = output::encode_aov(rendered.size, &aov)?;
        let image = image::load_from_memory(&file)?.to_rgba8();
        Ok(Pixels {
            size: rendered.size,
            codes: image.pixels().map(|pixel| pixel.0).collect(),
            figures: None,
        })
    }

    /// Counts triangles at a grid of samples in every pixel.
    fn triangles(&mut self, task: &SceneTask) -> anyhow::Result<Option<Pixels>> {
        let size = task.settings.size;
        let finer = Settings {
            method: Method::None,
            samples: 1,
            size: size.map(|side| side * COUNT_SIDE),
            attributes: true,
            shadows: Shadows::None,
            ..task.settings.clone()
        };
        let side = COUNT_SIDE as usize;
        let width = size[0] as usize * side;
        let mut codes = Vec::new();
        let done = self.render_bands(task, &finer, BAND * COUNT_SIDE, |band| {
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
        Ok(done.then_some(Pixels {
            size,
            codes,
            figures: None,
        }))
    }

    /// Compares with brute force.
    fn error(&mut self, task: &SceneTask) -> anyhow::Result<Option<Pixels>> {
        let side = task.settings.samples.max(REFERENCE_SAMPLES).isqrt();
        let brute = Settings {
            method: Method::Ssaa,
            samples: side * side,
            shadows: Shadows::None,
            ..task.settings.clone()
        };
        let mut reference = Vec::new();
        let done = self.render_bands(task, &brute, BAND, |band| {
            reference.extend_from_slice(&band.colors);
        })?;
        if !done {
            return Ok(None);
        }
        let rendered = self.render(
            task,
            &Settings {
                shadows: Shadows::None,
                ..task.settings.clone()
            },
        )?;
        let size = rendered.size;
        let [first, second] = [&reference, &rendered.colors]
            .map(|colors| Picture::new(size, colors).map(|picture| DecodedImage::from(&picture)));
        let found = compare::compare(&first?, &second?)?;
        let reference = Pixels::new(size, &reference).codes;
        let rendered = Pixels::new(size, &rendered.colors).codes;
        let pairs = reference.iter().zip(&rendered);
        Ok(Some(Pixels {
            size,
            codes: pairs.map(|(a, b)| overlay::error(*a, *b)).collect(),
            figures: Some(format!(
                "against {} samples everywhere: RMSE {:.5}, FLIP {:.5}",
                side * side,
                found.rmse,
                found.flip
            )),
        }))
    }

    /// Renders bands of so many rows from the top, and hands each to `take`. Ends where another picture is asked for; says
    /// whether it came to the bottom.
    fn render_bands(
        &mut self,
        task: &SceneTask,
        settings: &Settings,
        rows: u32,
        mut take: impl FnMut(&Rendered),
    ) -> anyhow::Result<bool> {
        let [width, height] = settings.size;
        for first in (0..height).step_by(rows as usize) {
            if self.inbox.is_superseded() {
                return Ok(false);
            }
            let region = PixelRect {
                corner: [0, first],
                size: [width, rows.min(height - first)],
            };
            let band = Settings {
                region: Some(region),
                ..settings.clone()
            };
            take(&self.render(task, &band)?);
        }
        Ok(true)
    }

    fn render(&mut self, task: &SceneTask, settings: &Settings) -> anyhow::Result<Rendered> {
        let (headless, shown) = self.show(task)?;
        let camera = camera(task, shown)?;
        let rendered = match settings.shadows {
            Shadows::None => {
                let mut frame = headless.prepare(&shown.prepared, settings)?;
                headless.render(&mut frame, &camera)?
            }
            Shadows::Exact => headless.render_with_shadows(&shown.prepared, &camera, settings)?,
        };
        check(headless)?;
        Ok(rendered)
    }

    /// Puts what the task is of on the device, unless it is there.
    fn show(&mut self, task: &SceneTask) -> anyhow::Result<(&mut Headless, &Shown)> {
        if self.headless.is_none() {
            self.headless = Some(Headless::new(&self.options)?);
        }
        let headless = self.headless.as_mut().context("there is no device")?;
        let is_shown =
            |shown: &Shown| Arc::ptr_eq(&shown.scene, &task.scene) && shown.time == task.time;
        if !self.shown.as_ref().is_some_and(is_shown) {
            // The memory of the pose before is free for this one.
            self.shown = None;
            let pose = task.scene.pose(&PoseRequest {
                time: task.time,
                ..task.source.request.clone()
            })?;
            let max_memory = task.settings.max_memory;
            let mut prepared = headless.upload(&task.scene, &pose, max_memory)?;
            if task.settings.shadows == Shadows::Exact {
                headless.prepare_shadows(&mut prepared, &task.scene, &pose, max_memory)?;
            }
            self.shown = Some(Shown {
                scene: task.scene.clone(),
                time: task.time,
                pose,
                prepared,
            });
        }
        let shown = self.shown.as_ref().context("there is no scene")?;
        Ok((headless, shown))
    }
}

fn write_photo(view: &photo::View, path: &Path) -> anyhow::Result<()> {
    let size = view.window.size;
    let pixels = view.pixels();
    let mut bytes = output::encode(Format::Png8, &Picture::new(size, &pixels)?, &[])?;
    if let Some(map) = &view.map {
        bytes = Zoomed::add_map(&bytes, size, map)?;
    }
    Ok(output::write_atomically(path, &bytes)?)
}

fn camera(task: &SceneTask, shown: &Shown) -> anyhow::Result<gpc::camera::Camera> {
    let [width, height] = task.settings.size.map(f64::from);
    let pose = &shown.pose;
    Ok(task
        .standpoint
        .camera(&pose.cameras, bounds(pose), width / height)?)
}

/// Fails if the validation layer was asked, and has said anything.
fn check(headless: &Headless) -> anyhow::Result<()> {
    match headless.validation_messages().first() {
        Some(message) => bail!("the validation layer says: {message}"),
        None => Ok(()),
    }
}
