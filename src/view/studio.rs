//! Pictures that the window's frames can't make: of other sampling locations than the centres of pixels, of what pixels hold
//! beside their colours, and for files. They are made in a thread and a device of their own, so that the window never waits
//! for them.

use super::losses::is_lost;
use super::source::{Source, bounds};
use super::standpoint::Standpoint;
use anyhow::{Context, bail};
use gpc::camera::Pinhole;
use gpc::camera::set::SamplingSet;
use gpc::camera::zoom::ZoomMap;
use gpc::output::{self, Aov, AovKind, Format, Picture};
use gpc::reference::srgb;
use gpc::render::{Headless, HeadlessOptions, PreparedScene, Rendered, Settings, Shadows};
use gpc::scene::{Pose, PoseRequest, Scene};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

/// What is to be made.
#[derive(Clone, Debug)]
pub enum Subject {
    /// The scene, to look at.
    Still,
    /// The scene with regions enlarged, to look at.
    Zoom(ZoomMap),
    /// What pixels hold beside their colours, to look at.
    Attribute(AovKind),
    /// A PNG file as `gpc render` writes it, to the same bytes.
    File(PathBuf),
}

/// A picture to be made.
pub struct Order {
    /// Tells what is made from what was asked for since.
    pub number: u64,
    pub source: Source,
    pub scene: Arc<Scene>,
    /// Moment of the animation in seconds.
    pub time: f64,
    pub standpoint: Standpoint,
    pub settings: Settings,
    pub subject: Subject,
}

/// A picture to look at.
pub struct Pixels {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Rows of RGBA from the top: sRGB codes, premultiplied.
    pub codes: Vec<[u8; 4]>,
}

impl Pixels {
    /// Codes of what was rendered.
    fn new(rendered: &Rendered) -> Self {
        let code = |[r, g, b, a]: &[f32; 4]| {
            let [r, g, b] = [*r, *g, *b].map(|v| srgb::encode_u8(f64::from(v)));
            [r, g, b, (a.clamp(0.0, 1.0) * 255.0).round() as u8]
        };
        Self {
            size: rendered.size,
            codes: rendered.colors.iter().map(code).collect(),
        }
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
    /// Starts a thread that opens a device with the first order, and delivers what it makes.
    pub fn new(options: HeadlessOptions, deliver: impl Fn(Made) + Send + 'static) -> Self {
        let (orders, received) = channel();
        let thread = std::thread::spawn(move || {
            Maker {
                shown: None,
                headless: None,
                options,
            }
            .run(&received, deliver);
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
}

/// A pose on the device.
struct Shown {
    scene: Arc<Scene>,
    time: f64,
    pose: Pose,
    prepared: PreparedScene,
}

impl Maker {
    fn run(&mut self, orders: &Receiver<Order>, deliver: impl Fn(Made)) {
        while let Ok(first) = orders.recv() {
            let waiting: Vec<_> = std::iter::once(first).chain(orders.try_iter()).collect();
            let is_file = |order: &Order| matches!(order.subject, Subject::File(_));
            let last = waiting.iter().rposition(|order| !is_file(order));
            for (index, order) in waiting.iter().enumerate() {
                if is_file(order) || Some(index) == last {
                    let made = self.make(order);
                    if made.error().is_some_and(is_lost) {
                        // The next order opens another device.
                        self.shown = None;
                        self.headless = None;
                    }
                    deliver(made);
                }
            }
        }
    }

    fn make(&mut self, order: &Order) -> Made {
        match &order.subject {
            Subject::File(path) => Made::File(path.clone(), self.write(order, path.clone())),
            Subject::Still => Made::Pixels(order.number, self.still(order)),
            Subject::Zoom(map) => Made::Pixels(order.number, self.zoom(order, map)),
            Subject::Attribute(kind) => Made::Pixels(order.number, self.attribute(order, *kind)),
        }
    }

    fn write(&mut self, order: &Order, path: PathBuf) -> anyhow::Result<()> {
        let rendered = self.render(order, &order.settings)?;
        let picture = Picture::new(rendered.size, &rendered.colors)?;
        let bytes = output::encode(Format::Png8, &picture, &[])?;
        Ok(output::write_atomically(&path, &bytes)?)
    }

    fn still(&mut self, order: &Order) -> anyhow::Result<Pixels> {
        let rendered = self.render(order, &order.settings)?;
        Ok(Pixels::new(&rendered))
    }

    fn zoom(&mut self, order: &Order, map: &ZoomMap) -> anyhow::Result<Pixels> {
        let size = order.settings.size;
        let (headless, shown) = self.show(order)?;
        let camera = camera(order, shown)?;
        let set = SamplingSet::mapped(size, map)?;
        let rig = [(Pinhole::from_camera(&camera, size)?, set.sites())];
        let rendered = headless.render_sites(&shown.prepared, &rig, size, &order.settings)?;
        check(headless)?;
        Ok(Pixels::new(&rendered))
    }

    fn attribute(&mut self, order: &Order, kind: AovKind) -> anyhow::Result<Pixels> {
        let settings = Settings {
            attributes: true,
            shadows: Shadows::None,
            ..order.settings.clone()
        };
        let rendered = self.render(order, &settings)?;
        let aov = Aov::from_attributes(kind, &rendered.attributes);
        // The same colours as in files.
        let file = output::encode_aov(rendered.size, &aov)?;
        let image = image::load_from_memory(&file)?.to_rgba8();
        Ok(Pixels {
            size: rendered.size,
            codes: image.pixels().map(|pixel| pixel.0).collect(),
        })
    }

    fn render(&mut self, order: &Order, settings: &Settings) -> anyhow::Result<Rendered> {
        let (headless, shown) = self.show(order)?;
        let camera = camera(order, shown)?;
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

    /// Puts what the order is of on the device, unless it is there.
    fn show(&mut self, order: &Order) -> anyhow::Result<(&mut Headless, &Shown)> {
        if self.headless.is_none() {
            self.headless = Some(Headless::new(&self.options)?);
        }
        let headless = self.headless.as_mut().context("there is no device")?;
        let is_shown =
            |shown: &Shown| Arc::ptr_eq(&shown.scene, &order.scene) && shown.time == order.time;
        if !self.shown.as_ref().is_some_and(is_shown) {
            // The memory of the pose before is free for this one.
            self.shown = None;
            let pose = order.scene.pose(&PoseRequest {
                time: order.time,
                ..order.source.request.clone()
            })?;
            let max_memory = order.settings.max_memory;
            let mut prepared = headless.upload(&order.scene, &pose, max_memory)?;
            if order.settings.shadows == Shadows::Exact {
                headless.prepare_shadows(&mut prepared, &order.scene, &pose, max_memory)?;
            }
            self.shown = Some(Shown {
                scene: order.scene.clone(),
                time: order.time,
                pose,
                prepared,
            });
        }
        let shown = self.shown.as_ref().context("there is no scene")?;
        Ok((headless, shown))
    }
}

fn camera(order: &Order, shown: &Shown) -> anyhow::Result<gpc::camera::Camera> {
    let [width, height] = order.settings.size.map(f64::from);
    let pose = &shown.pose;
    Ok(order
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
