//! The window: loading scenes, and drawing what is due.

use super::app::Event;
use super::canvas::{Canvas, Seen};
use super::compose::{self, Magnifier};
use super::cover::Cover;
use super::device::Device;
use super::engine::Engine;
use super::fly::Flight;
use super::layer::Layer;
use super::look::Look;
use super::losses::is_lost;
use super::notes::Notes;
use super::painter::Painting;
use super::panel::{self, Facts, PictureFacts, SceneFacts, Wishes};
use super::picture::Picture;
use super::player::Player;
use super::pointer::Pointer;
use super::source::{Appearance, Source, Stage};
use super::standpoint::{Standpoint, Start};
use super::studio::{Made, Order, Pixels, Studio, Subject};
use super::watch::Watch;
use super::{NoDisplay, Options};
use gpc::render::{HeadlessOptions, Shadows};
use gpc::scene::{Moment, SceneCamera};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use winit::dpi::PhysicalSize;
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy};
use winit::keyboard::ModifiersState;
use winit::window::Window;

/// How long to wait before asking again whether the device is done.
const POLL: Duration = Duration::from_millis(3);
/// How long a file has to be left alone before it is loaded again: it may be written in parts.
const SETTLE: Duration = Duration::from_millis(300);

/// What is being loaded.
pub struct Loading {
    number: u64,
    pub source: Source,
    since: Instant,
    /// Whether it is seen from where the scene before was.
    keeps_view: bool,
}

/// The window with all that is in it.
pub struct View {
    pub proxy: EventLoopProxy<Event>,
    pub canvas: Canvas,
    pub interface: egui_winit::State,
    pub window: Arc<Window>,

    /// Files that the arrow keys go through, and which of them was asked for.
    pub scenes: Vec<PathBuf>,
    pub scene: usize,
    /// What was asked for.
    pub source: Source,
    pub loading: Option<Loading>,
    /// Loads that were begun, and the threads of those that have not ended.
    pub loads: u64,
    pub loaders: Vec<JoinHandle<()>>,
    /// Tells when the scene's file changes.
    pub watch: Option<Watch>,
    /// When to load the scene again.
    pub reload: Option<Instant>,

    /// Where the scene has animations.
    pub player: Option<Player>,
    /// What is shown of the animation, unless it is the first pose.
    pub moment: Option<Arc<Moment>>,

    pub standpoint: Standpoint,
    /// Where the first scene is seen from at first.
    start: Option<Start>,
    /// While keys move the eye.
    pub flight: Option<Flight>,
    /// How the pictures are antialiased, left first.
    pub looks: Vec<Look>,
    /// What scenes are shown with.
    appearance: Arc<Appearance>,
    /// The options of the command line that say the same, and what is behind the scene.
    pub appearance_options: Vec<String>,
    /// Column of the split, as a share of the width.
    pub split: f64,
    /// Enlargement of the magnifier, where it is on.
    pub magnifier: Option<u32>,

    pub pointer: Pointer,
    pub modifiers: ModifiersState,
    /// What is looked at in the stead of the frames.
    pub cover: Cover,
    /// Makes it, and files.
    pub studio: Studio,
    pub notes: Notes,
    pub shows_keys: bool,
    pub shows_panel: bool,
    /// Whether the window has to be drawn again.
    pub is_dirty: bool,
    /// When the panel has to be drawn again.
    pub repaint: Option<Instant>,
    /// Whether the picture was said to be at rest.
    pub rests: bool,
    pub wants_to_quit: bool,

    /// How devices are opened.
    device: HeadlessOptions,
    /// What the validation layer said of devices that were lost.
    messages: Vec<String>,
}

impl View {
    pub fn new(
        events: &ActiveEventLoop,
        options: Options,
        proxy: EventLoopProxy<Event>,
    ) -> anyhow::Result<Self> {
        let [width, height] = options.look.settings.size;
        let attributes = Window::default_attributes()
            .with_title("gpc")
            .with_inner_size(PhysicalSize::new(width, height));
        let window = events
            .create_window(attributes)
            .map_err(|error| NoDisplay(error.to_string()))?;
        let window = Arc::new(window);
        let canvas = canvas(&window, &options.device)?;
        let interface = interface(&window);
        let deliver = proxy.clone();
        let studio = Studio::new(options.device.clone(), move |made| {
            // Nobody waits for it once the window is closed.
            let _ = deliver.send_event(Event::Made(made));
        });
        let cover = Cover::new(options.look.settings.shadows == Shadows::Exact);
        let mut view = Self {
            scenes: std::iter::once(options.source.path.clone())
                .chain(options.others)
                .collect(),
            looks: vec![options.look],
            standpoint: Standpoint::Camera(0),
            start: Some(options.start),
            source: options.source,
            appearance: Arc::new(options.appearance),
            appearance_options: options.appearance_options,
            device: options.device,
            proxy,
            canvas,
            interface,
            window,
            scene: 0,
            loading: None,
            loads: 0,
            loaders: Vec::new(),
            watch: None,
            reload: None,
            player: None,
            moment: None,
            flight: None,
            split: 0.5,
            magnifier: None,
            pointer: Pointer::default(),
            modifiers: ModifiersState::empty(),
            cover,
            studio,
            notes: Notes::default(),
            shows_keys: false,
            shows_panel: true,
            is_dirty: true,
            repaint: None,
            rests: false,
            wants_to_quit: false,
            messages: Vec::new(),
        };
        view.canvas.refines = view.cover.subject().is_none();
        view.load(false);
        Ok(view)
    }

    /// The same view on a device that was opened again, after the one before was lost.
    pub fn reopened(self) -> anyhow::Result<Self> {
        let mut messages = self.messages;
        messages.extend(self.canvas.engine.device.validation_messages());
        let keeps_view = match &self.loading {
            Some(loading) => loading.keeps_view,
            None => self.canvas.stage().is_some(),
        };
        // The window's images go before it has others.
        drop(self.canvas);
        let mut view = Self {
            canvas: canvas(&self.window, &self.device)?,
            interface: interface(&self.window),
            messages,
            moment: None,
            ..self
        };
        view.canvas.refines = view.cover.subject().is_none();
        view.source.request.time = view.time();
        view.notes
            .say("the device was lost; everything is made again");
        view.load(keeps_view);
        Ok(view)
    }

    /// Ends everything, and hands over what the validation layer said. Threads are waited for, with the window out of sight:
    /// a driver can't be left in the middle of its work when the process ends.
    pub fn close(mut self) -> Vec<String> {
        self.window.set_visible(false);
        let device = self.canvas.engine.device.clone();
        let loaders = std::mem::take(&mut self.loaders);
        let mut messages = std::mem::take(&mut self.messages);
        drop(self);
        for loader in loaders {
            // A panic has been reported by the thread itself.
            let _ = loader.join();
        }
        messages.extend(device.validation_messages());
        messages
    }

    /// Loads what was asked for, in the background.
    pub fn load(&mut self, keeps_view: bool) {
        let source = self.source.clone();
        self.loads += 1;
        let number = self.loads;
        self.loading = Some(Loading {
            number,
            source: source.clone(),
            since: Instant::now(),
            keeps_view,
        });
        self.is_dirty = true;
        self.reload = None;
        self.watch(&source.path);
        let engine = self.canvas.engine.clone();
        let proxy = self.proxy.clone();
        let appearance = self.appearance.clone();
        let max_memory = self.looks[0].settings.max_memory;
        self.loaders.retain(|loader| !loader.is_finished());
        self.loaders.push(std::thread::spawn(move || {
            let stage = source.open(engine, &appearance, max_memory);
            // Nobody waits for it once the window is closed.
            let _ = proxy.send_event(Event::Opened(number, Box::new(stage)));
        }));
    }

    /// Watches the file of the scene, whether it can be loaded or not.
    fn watch(&mut self, path: &Path) {
        let proxy = self.proxy.clone();
        let watch = Watch::new(path, move || {
            // Nobody waits for it once the window is closed.
            let _ = proxy.send_event(Event::Changed);
        });
        if let Err(error) = &watch {
            log::warn!("{} is not watched: {error}", path.display());
        }
        self.watch = watch.ok();
    }

    /// Takes what another thread has done.
    pub fn on_done(&mut self, event: Event) -> anyhow::Result<()> {
        self.is_dirty = true;
        match event {
            Event::Opened(number, stage) => {
                // Another one was asked for meanwhile, or none.
                let Some(loading) = self.loading.take_if(|loading| loading.number == number) else {
                    return Ok(());
                };
                match *stage {
                    Ok(stage) => self.set_stage(stage, loading.keeps_view)?,
                    Err(error) => self.notes.fail(&error),
                }
            }
            Event::Changed => self.reload = Some(Instant::now() + SETTLE),
            Event::Made(Made::File(path, Ok(()))) => {
                self.notes.say(format!("wrote {}", path.display()));
            }
            Event::Made(Made::Pixels(number, Ok(pixels))) => self.show_made(number, &pixels)?,
            Event::Made(Made::File(_, Err(error)) | Made::Pixels(_, Err(error))) => {
                self.notes.fail(&error);
            }
        }
        Ok(())
    }

    fn set_stage(&mut self, stage: Stage, keeps_view: bool) -> anyhow::Result<()> {
        self.notes.clear_errors();
        self.window
            .set_title(&format!("{} - gpc", stage.source.name()));
        if !keeps_view {
            let aspect = self.aspect();
            let start = self.start.take().unwrap_or_default();
            let asked = start.standpoint(&stage.cameras, stage.bounds, aspect);
            self.standpoint = asked.unwrap_or_else(|error| {
                self.notes.fail(&error.into());
                Standpoint::first(&stage.cameras, stage.bounds, aspect)
            });
            self.flight = None;
        }
        log::debug!("shows {}", stage.source.path.display());
        self.player = stage.motion.as_ref().map(|_| {
            let animation = stage.animations.get(stage.animation());
            let duration = animation.map_or(0.0, |animation| animation.duration);
            Player::new(stage.source.request.time, duration)
        });
        self.moment = None;
        self.canvas.set_stage(stage)?;
        self.renew_layers()
    }

    /// Makes pictures of the window's size anew.
    pub fn renew_layers(&mut self) -> anyhow::Result<()> {
        self.is_dirty = true;
        self.rests = false;
        let Some(size) = self.canvas.size() else {
            return Ok(());
        };
        let now = Instant::now();
        for look in &mut self.looks {
            look.settings.size = size;
        }
        let layer = |look: &Look| Layer::new(&self.canvas.engine, look.clone(), now);
        let layers = self
            .looks
            .iter()
            .map(layer)
            .collect::<anyhow::Result<_>>()?;
        self.canvas.set_layers(layers)?;
        self.view_changed()
    }

    /// What was made of another view is no longer seen, and asked for anew.
    pub fn view_changed(&mut self) -> anyhow::Result<()> {
        self.is_dirty = true;
        self.canvas.set_cover(None)?;
        self.order_cover(|cover| cover.begin(true));
        Ok(())
    }

    /// Asks for another cover of the same view, or for none.
    pub fn cover_changed(&mut self) -> anyhow::Result<()> {
        self.is_dirty = true;
        self.canvas.refines = self.cover.subject().is_none();
        if self.canvas.refines {
            self.canvas.set_cover(None)?;
        }
        self.order_cover(|cover| cover.begin(false));
        Ok(())
    }

    /// Shows what the studio has made.
    fn show_made(&mut self, number: u64, pixels: &Pixels) -> anyhow::Result<()> {
        let arrival = self.cover.arrived(number);
        if arrival.is_shown {
            let picture = Picture::from_pixels(&self.canvas.engine.device, pixels)?;
            self.canvas.set_cover(Some(picture))?;
        }
        if arrival.refines {
            self.order_cover(Cover::refine);
        }
        Ok(())
    }

    /// Orders what is wanted in the stead of the frames, if anything is.
    fn order_cover(&mut self, step: impl FnOnce(&mut Cover) -> (u64, u32)) {
        if let Some(subject) = self.cover.subject() {
            let (number, samples) = step(&mut self.cover);
            let look = &self.looks[self.layer_under_pointer()];
            let samples = if look.can_have(samples) {
                samples.min(look.settings.samples)
            } else {
                look.settings.samples
            };
            self.order(number, samples, subject);
        }
    }

    /// Asks the studio for a picture of what is seen, antialiased like that under the pointer.
    pub fn order(&self, number: u64, samples: u32, subject: Subject) {
        let Some(stage) = self.canvas.stage() else {
            return;
        };
        let look = &self.looks[self.layer_under_pointer()];
        self.studio.ask(Order {
            number,
            source: stage.source.clone(),
            scene: stage.scene.clone(),
            time: self.time(),
            standpoint: self.standpoint,
            settings: look.at(samples, None),
            subject,
        });
    }

    /// Width / height of the picture.
    pub fn aspect(&self) -> f64 {
        let [width, height] = self.size();
        width / height
    }

    /// Width and height of the picture in pixels.
    pub fn size(&self) -> [f64; 2] {
        self.canvas.size().unwrap_or([1, 1]).map(f64::from)
    }

    /// Column of the split, where there is one.
    pub fn split_column(&self) -> Option<u32> {
        (self.looks.len() > 1).then(|| (self.split * self.size()[0]).round() as u32)
    }

    /// Does what is due, and says when to be asked again.
    ///
    /// # Errors
    /// If the device is lost or memory runs out.
    pub fn advance(&mut self, now: Instant) -> anyhow::Result<ControlFlow> {
        match self.canvas.collect() {
            Ok(any) => self.is_dirty |= any,
            Err(error) => self.report(error)?,
        }
        let due = self.canvas.due();
        let is_due = |at: Option<Instant>| at.is_some_and(|at| at <= now);
        if is_due(self.reload) {
            self.source.request.time = self.time();
            self.load(true);
        }
        self.is_dirty |= self.player.as_ref().is_some_and(Player::is_playing);
        self.is_dirty |= self.flight.as_ref().is_some_and(Flight::is_moving);
        self.is_dirty |= is_due(due) || is_due(self.repaint) || self.canvas.has_again();
        self.is_dirty |= is_due(self.notes.next_change());
        if self.is_dirty {
            self.draw(now)?;
        }
        self.note_rest();
        if self.is_dirty || self.canvas.is_busy() {
            return Ok(ControlFlow::WaitUntil(now + POLL));
        }
        let next = [
            self.canvas.due(),
            self.repaint,
            self.reload,
            self.notes.next_change(),
        ];
        Ok(next
            .into_iter()
            .flatten()
            .min()
            .map_or(ControlFlow::Wait, ControlFlow::WaitUntil))
    }

    /// Draws the window, if one of its images is free.
    fn draw(&mut self, now: Instant) -> anyhow::Result<()> {
        let Some(acquired) = self.canvas.acquire()? else {
            return Ok(());
        };
        self.is_dirty = false;
        if let Some(player) = &mut self.player
            && player.is_playing()
        {
            player.advance(now);
            self.show_time();
        }
        self.fly(now);
        let (painting, wishes) = self.lay_out(now);
        let aspect = self.aspect();
        let camera = match self.canvas.stage() {
            Some(stage) => Some(
                self.standpoint
                    .camera(self.cameras(), stage.bounds, aspect)?,
            ),
            None => None,
        };
        let size = self.canvas.size().unwrap_or([1, 1]);
        let split = self.split_column();
        let magnified = self.magnifier.map_or_else(Vec::new, |factor| {
            let place = self.pointer.place().max(glam::DVec2::ZERO);
            let magnifier = Magnifier {
                centre: [
                    (place.x as u32).min(size[0].saturating_sub(1)),
                    (place.y as u32).min(size[1].saturating_sub(1)),
                ],
                factor,
            };
            compose::magnified(size, split, magnifier)
        });
        let seen = Seen {
            camera: camera.as_ref(),
            moment: self.moment.as_ref(),
            pieces: &compose::pictures(size, split),
            magnified: &magnified,
        };
        if let Err(error) = self.canvas.draw(&acquired, &seen, painting, now) {
            self.report(error)?;
        }
        self.fulfil(wishes)
    }

    /// Lays out the panel.
    fn lay_out(&mut self, now: Instant) -> (Painting, Wishes) {
        let input = self.interface.take_egui_input(&self.window);
        let context = self.interface.egui_ctx().clone();
        let names = self.loading.as_ref().map(|loading| {
            let since = now.saturating_duration_since(loading.since);
            (loading.source.name(), since)
        });
        let split = self.split_column();
        let facts = Facts {
            notes: self.notes.seen(now),
            loading: names.as_ref().map(|(name, since)| (name.as_str(), *since)),
            shows_keys: self.shows_keys,
            shows_panel: self.shows_panel,
            split,
            lens: self.cover.lens,
            attribute: self.cover.attribute,
            scene: self.canvas.stage().map(|stage| SceneFacts {
                name: stage.source.name(),
                triangles: stage.prepared.triangle_count(),
                motion: self
                    .player
                    .as_ref()
                    .map(|player| (stage.animations.as_slice(), stage.animation(), player)),
            }),
            pictures: self
                .canvas
                .layers()
                .iter()
                .map(|layer| PictureFacts {
                    look: &layer.look,
                    shown: layer.shown,
                    statistics: &layer.statistics,
                })
                .collect(),
        };
        let mut wishes = Wishes::default();
        let output = context.run(input, |context| wishes = panel::show(context, &facts));
        self.interface
            .handle_platform_output(&self.window, output.platform_output);
        let again = output
            .viewport_output
            .get(&egui::ViewportId::ROOT)
            .and_then(|viewport| now.checked_add(viewport.repaint_delay));
        self.repaint = again;
        let painting = Painting {
            textures: output.textures_delta,
            primitives: context.tessellate(output.shapes, output.pixels_per_point),
            pixels_per_point: output.pixels_per_point,
        };
        (painting, wishes)
    }

    /// The cameras of the scene, where they are now.
    pub fn cameras(&self) -> &[SceneCamera] {
        match (&self.moment, self.canvas.stage()) {
            (Some(moment), _) => &moment.cameras,
            (None, Some(stage)) => &stage.cameras,
            (None, None) => &[],
        }
    }

    /// Moment of the animation in seconds.
    pub fn time(&self) -> f64 {
        self.player
            .as_ref()
            .map_or(self.source.request.time, Player::time)
    }

    /// Shows the scene at the player's time.
    pub fn show_time(&mut self) {
        let time = self.time();
        let Some((stage, motion)) = self
            .canvas
            .stage()
            .and_then(|stage| Some((stage, stage.motion.as_ref()?)))
        else {
            return;
        };
        match motion.at(&stage.scene, time) {
            Ok(Some(moment)) => {
                self.moment = Some(Arc::new(moment));
                self.canvas.restart(Instant::now());
                if let Err(error) = self.view_changed() {
                    self.notes.fail(&error);
                }
            }
            // A light moves, or a mesh turns inside out: the scene is posed anew, which takes a while.
            Ok(None) => {
                if let Some(player) = &mut self.player
                    && player.is_playing()
                {
                    player.toggle(Instant::now());
                    self.notes.say(
                        "this animation moves lights and can't be played; choose its times by hand",
                    );
                }
                self.source.request.time = time;
                self.load(true);
            }
            Err(error) => self.notes.fail(&error.into()),
        }
    }

    /// Says what went wrong in the window. What nothing can go on after is handed back.
    fn report(&mut self, error: anyhow::Error) -> anyhow::Result<()> {
        if is_lost(&error) {
            return Err(error);
        }
        self.notes.fail(&error);
        self.is_dirty = true;
        Ok(())
    }

    /// Says when the picture has all samples.
    fn note_rest(&mut self) {
        let rests = self.canvas.rests() && self.cover.is_done();
        if rests && !self.rests {
            log::debug!("at rest");
        }
        self.rests = rests;
    }
}

/// Opens a device that shows pictures in the window.
fn canvas(window: &Arc<Window>, options: &HeadlessOptions) -> anyhow::Result<Canvas> {
    let device = Device::new(
        window.clone(),
        options.device.as_deref(),
        options.validation,
    )?;
    let engine = Engine::new(Arc::new(device))?;
    Canvas::new(Arc::new(engine), window.inner_size().into())
}

/// Lays out the panel, from nothing: the device has none of its textures.
fn interface(window: &Window) -> egui_winit::State {
    let context = egui::Context::default();
    context.set_visuals(egui::Visuals::dark());
    egui_winit::State::new(
        context,
        egui::ViewportId::ROOT,
        window,
        Some(window.scale_factor() as f32),
        window.theme(),
        None,
    )
}
